"""Scenes to start from, and where their numbers come from."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType

from bearingcore.bearings.bearing import Bearing
from bearingcore.scene import row_presets
from bearingcore.scene.assumed import ASSUMED, FAN_RIG_SUPPORT, below, conforming, rpm
from bearingcore.scene.defect import Defect
from bearingcore.scene.load import Load
from bearingcore.scene.scene import Scene


def _7208(contact_angle_deg: float, thrust: float) -> Scene:
    return Scene(
        bearing=Bearing.from_drawing(
            n_balls=14,
            pitch_diameter=60e-3,
            contact_angle=math.radians(contact_angle_deg),
            **conforming(15.0 / 32.0 * 25.4e-3),
        ),
        defect=below(8.0, 100e-6),
        load=Load(fy=-1500.0, fz=thrust),
        shaft_speed=rpm(3000.0),
        support=FAN_RIG_SUPPORT,
        dofs=("x", "y", "z"),
    )


class UnknownPresetError(KeyError):
    """A name that no preset has; its words name those that there are."""

    def __str__(self) -> str:
        """The words themselves: a KeyError would put them in quotes."""
        return str(self.args[0])


class _Presets(Mapping[str, Scene]):
    """Scenes by name, each made when it is first asked for.

    Those from drawings need SciPy's elliptic integrals, which take longer to import than the rest
    of this package together.
    """

    def __init__(self, makers: Mapping[str, Callable[[], Scene]]) -> None:
        self._makers = makers
        self._made: dict[str, Scene] = {}

    def __getitem__(self, name: str) -> Scene:
        if name not in self._makers:
            known = ", ".join(self._makers)
            raise UnknownPresetError(f"there is no preset {name!r}; there are {known}")
        if name not in self._made:
            self._made[name] = self._makers[name]()
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)

    def __contains__(self, name: object) -> bool:
        return name in self._makers


presets: Mapping[str, Scene] = _Presets(
    {
        "liew-lim": lambda: Scene(
            bearing=Bearing(
                n_balls=12,
                ball_diameter=6e-3,
                pitch_diameter=39.3e-3,
                contact_angle=math.radians(30.0),
                groove_center_radius=19.65e-3,
                groove_center_distance=50e-6,
                radial_clearance=0.05e-6,
                load_deflection_factor=1.45e10,
                outer_raceway_radius=22.65e-3,
                inner_raceway_radius=16.65e-3,
            ),
            defect=Defect(extent=math.radians(40.0), depth=50e-6, center=math.radians(270.0)),
            load=Load(fy=-2000.0, fz=500.0),
            shaft_speed=2.0 * math.pi * 7.0,
            support=FAN_RIG_SUPPORT,
        ),
        "fan-rig": lambda: Scene(
            bearing=Bearing(
                n_balls=14,
                ball_diameter=8e-3,
                pitch_diameter=45e-3,
                contact_angle=0.0,
                groove_center_radius=22.5e-3,
                groove_center_distance=50e-6,
                radial_clearance=3e-6,
                load_deflection_factor=5453e6,
                outer_raceway_radius=26.5e-3,
                inner_raceway_radius=18.5e-3,
            ),
            defect=Defect(extent=math.radians(12.9), depth=50e-6, center=math.radians(270.0)),
            load=Load(fy=-100.0),
            shaft_speed=2.0 * math.pi * 7.0,
            support=FAN_RIG_SUPPORT,
        ),
        "6205": lambda: Scene(
            bearing=Bearing.from_drawing(
                n_balls=9,
                pitch_diameter=39.04e-3,
                diametral_clearance=10e-6,
                **conforming(7.94e-3),
            ),
            defect=below(1.3, 279e-6),
            load=Load(fy=-1000.0),
            shaft_speed=rpm(1797.0),
            support=FAN_RIG_SUPPORT,
        ),
        "6206": lambda: Scene(
            bearing=Bearing.from_drawing(
                n_balls=9,
                pitch_diameter=46e-3,
                diametral_clearance=10e-6,
                **conforming(9.525e-3),
            ),
            defect=below(6.0, 100e-6),
            load=Load(fy=-1500.0),
            shaft_speed=rpm(1470.0),
            support=FAN_RIG_SUPPORT,
        ),
        "7208-15deg": lambda: _7208(15.0, 1000.0),
        "7208-25deg": lambda: _7208(25.0, 1500.0),
        "7208-40deg": lambda: _7208(40.0, 2500.0),
        "seven-ball": lambda: Scene(
            bearing=Bearing.from_drawing(
                n_balls=7,
                pitch_diameter=43.5e-3,
                diametral_clearance=10e-6,
                groove_center_radius=0.5 * 43.5e-3,
                **conforming(11.5e-3),
            ),
            defect=below(10.0, 50e-6),
            load=Load(fy=-1000.0),
            shaft_speed=rpm(1500.0),
            support=FAN_RIG_SUPPORT,
        ),
        **row_presets.MAKERS,
    }
)
"""Scenes by name."""


def _note_7208(contact_angle_deg: int, rating_kn: int, thrust: str) -> str:
    return (
        f"An angular-contact bearing of 40 mm bore and 80 mm outside diameter, at "
        f"{contact_angle_deg}°. From catalogues: bore, outside diameter, contact angle. Assumed, "
        "as makers do not print it: 14 balls of 15/32 inch (11.906 mm) on the mean of bore and "
        "outside diameter (60 mm), which by ISO 281 give a dynamic rating of about "
        f"{rating_kn} kN, as catalogues do; no clearance on top of the contact angle; load 1.5 kN "
        f"down and {thrust} kN along the shaft, an equivalent load of 5 to 6 % of that rating; a "
        "shaft kept from tilting, as a second bearing does, without which this one would tilt by "
        f"some milliradian; the defect; {ASSUMED}"
    )


preset_notes: Mapping[str, str] = MappingProxyType(
    {
        "liew-lim": (
            "The angular-contact bearing of Liew and Lim that Section 3 of Petersen, Howard and "
            "Prime (2014) studies. Printed: balls, groove radius, groove distance, contact angle, "
            "clearance, load-deflection factor, loads. Assumed: pitch diameter (twice the groove "
            "centre radius), raceway radii (that radius plus and minus a ball radius), speed; it "
            "has no published rotor, so that of the fan rig is used."
        ),
        "fan-rig": (
            "The fan rig's deep-groove bearing of Section 4 and Table 1 of Petersen, Howard and "
            "Prime (2014). Printed: balls, radii, clearance, load-deflection factor, masses, "
            "radial support, load, speed. Assumed: groove centre distance 50 µm (without effect "
            "on radial answers), raceway radii (pitch radius plus and minus a ball radius), and "
            "support along z and against tilt."
        ),
        "6205": (
            "The deep-groove bearing at the drive end of the Case Western Reserve University rig, "
            "the best-known public fault data (there 6205-2RS JEM SKF). Published with the data: 9 "
            "balls of 7.94 mm on 39.04 mm (0.3126 and 1.537 inch), which give its defect "
            "frequencies of 3.5848 and 5.4152 times the shaft's; 1797 rpm; a fault of 0.021 inch, "
            "here 1.3° long, and 0.011 inch deep. Assumed: diametral clearance 10 µm, the middle "
            "of the normal class of ISO 5753; a load of 1 kN, 7 % of the dynamic rating of 14 kN; "
            f"{ASSUMED}"
        ),
        "6206": (
            "A deep-groove bearing of 30 mm bore and 62 mm outside diameter. Commonly given for "
            "it, though catalogues do not print the inside: 9 balls of 3/8 inch (9.525 mm) on the "
            "mean of bore and outside diameter (46 mm), which by ISO 281 give the catalogue's "
            "dynamic rating of 19.5 kN. Assumed: diametral clearance 10 µm, load 1.5 kN (8 % of "
            f"that rating), the defect, {ASSUMED}"
        ),
        "7208-15deg": _note_7208(15, 38, "1.0"),
        "7208-25deg": _note_7208(25, 36, "1.5"),
        "7208-40deg": _note_7208(40, 32, "2.5"),
        "seven-ball": (
            "The bearing with which a commercial code's values for ISO/TS 16281 are published "
            "(GitHub, minzhun/ISO16281). Published: 7 balls of 11.5 mm on 43.5 mm, groove radii of "
            "0.52 and 0.53 ball diameters, 210 GPa and 0.3, diametral clearance 10 µm, load 1 kN; "
            "the lever of a tilt is half the pitch diameter there, and so it is here. Assumed: "
            "the defect, the speed, and the rotor and support of the fan rig."
        ),
        **row_presets.NOTES,
    }
)
"""Where each preset's numbers come from, and which of them are assumed."""
