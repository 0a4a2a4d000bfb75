"""Recognition of tables that hold no vibration over time, and sentences that ask for one.

Tables of spectra, envelopes, currents and displacements look like tables of signals. A diagnosis of
them as the acceleration of a housing would be a guess.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np

from bearingcore.common import Array
from bearingcore.measured.files._channels import OTHER, QUANTITIES, SIGNAL, Column, words_of
from bearingcore.recordings import FEWEST_SAMPLES

_ENVELOPE = re.compile(
    r"(?i:peak ?vue|pk-?vue|envelop|h[üu]llkurve|demod|spike energy)|\bg?SE\b|\bgE\b|\benv\b"
)
_SPECTRUM = re.compile(r"(?i)spe[ck]tr[aue]|\bfft\b|\bpsd\b|auto ?power")
_OFF = re.compile(r"(?i)\b(off|none|no|false|disabled|0|aus)\W*$")

BRING = "bring the acceleration of the bearing's housing over time"
ENVELOPE = (
    f"{{}} an envelope: {BRING} (the waveform before demodulation), or look for "
    "the lines of the bearing's parts in the spectrum of this envelope."
)
SPECTRUM = f"{{}} a spectrum{{}}, not a signal over time: export the waveform, or {BRING}."

NEAR_ZERO, LOPSIDED = 0.5, 0.3
"""Limits for numbers of one sign, which are no vibration about a mean if they are below both. The
first is for the least size over the median, the second for the median between both extremes."""


def is_lopsided(values: Array) -> bool:
    """Return True if numbers never change their sign and are mostly near zero.

    So are spectra, envelopes and trends. A vibration swings about its mean, even with an offset.
    """
    finite = values[np.isfinite(values)]
    if finite.size < FEWEST_SAMPLES or finite.min() < 0.0 < finite.max():
        return False
    least, middle, most = np.quantile(np.abs(finite), (0.0, 0.5, 0.999))
    return bool(least <= NEAR_ZERO * middle and middle - least < LOPSIDED * (most - least))


def leave_out_spectra(columns: Sequence[Column], values: Array, axis: int | None) -> list[Column]:
    """Return the columns of a table; those of spectra are no longer marked as signals.

    A spectrum never changes its sign, or is shorter than the waveform and follows its own `axis`.
    """
    counts = np.isfinite(values).sum(axis=0)
    return [
        Column(column.name, OTHER, column.unit)
        if column.role == SIGNAL
        and (
            is_lopsided(values[:, index])
            or (axis is not None and index > axis and counts[index] == counts[axis] < len(values))
        )
        else column
        for index, column in enumerate(columns)
    ]


def kind_in_words(
    columns: Sequence[Column],
    values: Array,
    lines: Iterable[str],
    file_name: str,
    frequencies: str,
) -> str:
    """Return a sentence for a table without a vibration over time; empty if it may hold one.

    Parameters
    ----------
    columns
        columns of the table; lopsided ones are not marked as signals.
    values : (n, c)
        their numbers.
    lines
        remarks and texts of the file.
    file_name
        name of the file; it counts only if no column is a signal.
    frequencies
        name of a column that rises like the axis of a spectrum; empty if there is none or the table
        has times.
    """
    signals, others = (
        [column.name for column in columns if column.role == role] for role in (SIGNAL, OTHER)
    )
    remarks = [line for line in lines if not _OFF.search(line)]
    if signals:  # without lines about another column
        remarks = [line for line in remarks if not any(name in line for name in others)]
    else:
        remarks.append(file_name)
    named = list(filter(_ENVELOPE.search, signals or others))
    envelopes = [f"“{name}” is" for name in named if len(named) >= len(signals)]
    envelopes += [f"“{line[:60]}”: this is" for line in filter(_ENVELOPE.search, remarks)]
    if frequencies:
        axis = f"“{frequencies}” rises like the axis of a spectrum: this is"
        return SPECTRUM.format(axis, " of an envelope" if envelopes else "")
    if envelopes:
        return ENVELOPE.format(envelopes[0])
    if signals:
        return ""
    for line in filter(_SPECTRUM.search, remarks):
        return SPECTRUM.format(f"“{line[:60]}”: this is", "")
    other_columns = [index for index, column in enumerate(columns) if column.role == OTHER]
    for column in (columns[index] for index in other_columns):
        for quantity, (units, names) in QUANTITIES.items():
            by_name = column.unit is None and words_of(column.name) & {*names.split()}
            if by_name or column.unit in units.split():
                return f"“{column.name}” is {quantity}, not a vibration: {BRING}."
    for index in other_columns:
        if is_lopsided(values[:, index]):
            words = "never changes its sign, like a spectrum, an envelope or a trend"
            return f"“{columns[index].name}” {words}: {BRING}."
    return ""
