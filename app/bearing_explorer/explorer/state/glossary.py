"""The glossary of the help: terms of the field with symbol, unit and meaning."""

from __future__ import annotations

import html
from collections.abc import Iterator
from typing import NamedTuple

from bearing_explorer.explorer.state.field_values import SHOWN_FIELDS

GROUPS = ("Defect", "Turning", "Load", "Balls", "Rows", "Drawing", "Contact", "Races", "Bodies")
"""Groups of fields that are explained here; the others are springs and dampers, one a direction."""


class Term(NamedTuple):
    """A term: its name, symbol as HTML, unit, and meaning in a sentence."""

    name: str
    symbol: str
    unit: str
    meaning: str


TERMS = (
    Term("Ball pass frequency, outer race", "BPFO", "Hz", "Balls past a point of it a second."),
    Term("Ball pass frequency, inner race", "BPFI", "Hz", "Balls past a point of it a second."),
    Term("Ball spin frequency", "BSF", "Hz", "Turns of a ball about its own axis a second."),
    Term("Cage frequency", "FTF", "Hz", "Turns of the cage a second."),
    Term("Contact load", "Q", "N", "Force between a ball and a race."),
    Term("Demodulation band", "", "Hz", "Frequency range from which the envelope is taken."),
    Term("Envelope spectrum", "", "", "Frequencies at which a vibration swells."),
    Term("Film parameter", "Λ", "", "Oil film over the roughness of both surfaces."),
    Term("Floquet multiplier", "", "", "Growth of a small disturbance in a period."),
    Term("Harmonic", "", "Hz", "A whole multiple of a frequency."),
    Term("Hertz contact", "", "", "Curved bodies: load grows as compression<sup>1.5</sup>."),
    Term("Life", "L<sub>10r</sub>", "10⁶ turns", "Turns that nine of ten bearings reach."),
    Term("Load zone", "", "°", "The part of the race in which balls carry load."),
    Term("Mode", "", "", "A shape of vibration, named after the direction that moves most."),
    Term("Natural frequency", "f", "Hz", "Frequency at which rotor and housing vibrate freely."),
    Term("Power spectral density", "", "(m/s²)²/Hz", "Power of a vibration in each hertz."),
    Term("Sidebands", "", "Hz", "Lines at equal distances from a line that is modulated."),
    Term("Steady orbit", "", "", "Motion that is the same in each period."),
    Term(
        "Stiffness", "k", "N/m", "Load for a unit of displacement: k<sub>xy</sub> is the load "
        "along x for a displacement along y; θ stands for a tilt."
    ),
)  # fmt: skip


def terms() -> Iterator[Term]:
    """All terms by their names: those above, and the fields of a scene."""
    fields = (
        Term(field.read_label, field.read_symbol_html, field.shown_unit, html.escape(field.meaning))
        for field in SHOWN_FIELDS
        if field.group in GROUPS
    )
    yield from sorted((*TERMS, *fields), key=lambda term: term.name.casefold())


def glossary_html() -> str:
    """All terms as the rows of a table."""
    return "".join(
        f"<tr><th scope=row>{html.escape(term.name)}</th><td><i>{term.symbol}</i></td>"
        f"<td>{term.unit}</td><td>{term.meaning}</td></tr>"
        for term in terms()
    )
