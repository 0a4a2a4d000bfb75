"""Random scenes within what the page's sliders allow, from a seed."""

import math
from collections.abc import Iterator

import numpy as np

from bearingcore import Scene, presets


def random_scenes(count: int, seed: int = 20141121) -> Iterator[Scene]:
    """Scenes spread over presets and sliders."""
    random = np.random.default_rng(seed)
    for k in range(count):
        base = presets[("fan-rig", "liew-lim")[k % 2]]
        size = base.load
        force = max(abs(size.fy), 100.0)
        flat = base.bearing.contact_angle == 0.0
        yield base.replace(
            n_balls=int(base.bearing.n_balls + random.integers(-4, 1)),
            radial_clearance=float(random.uniform(0.0, 12e-6)),
            contact_angle=0.0 if flat else math.radians(random.uniform(10.0, 40.0)),
            extent=math.radians(random.uniform(1.0, 100.0)),
            depth=float(10.0 ** random.uniform(-6.0, -4.0)),
            center=math.radians(random.uniform(0.0, 360.0)),
            edge=str(random.choice(["published", "chord", "exact"])),
            fx=float(force * random.uniform(-0.5, 0.5)),
            fy=float(-force * random.uniform(0.3, 2.5)),
            fz=0.0 if flat else float(force * random.uniform(0.1, 1.0)),
            shaft_speed=2.0 * math.pi * float(random.uniform(3.0, 30.0)),
            contact_law="no tension" if random.random() < 0.2 else "published",
        )
