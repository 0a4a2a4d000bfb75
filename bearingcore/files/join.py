"""One signal that is in several files, one after another."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from bearingcore.common import checks
from bearingcore.files.channels import TIME
from bearingcore.files.child import MOST_NUMBERS
from bearingcore.files.table import RATE_DOUBT, Table


def join_tables(tables: Sequence[Table]) -> Table:
    """The table of all rows of several files that hold the parts of one signal, in their order.

    Times that go on from file to file show what is missing between two, as in one file. Where they
    begin anew in each, or there are none, a note says that nothing is taken to be missing.

    Raises
    ------
    FieldError
        for files whose columns or sample rates differ, that are not in the order of their times, or
        that are too many numbers together.
    """
    if not tables:
        raise checks.refuse("tables", "none", "one or more")
    first = tables[0]
    for one in tables[1:]:
        if one.names != first.names:
            raise checks.refuse(
                f"columns of {one.name}", ", ".join(one.names), f"those of {first.name}"
            )
        rates = [part.contents.sample_rate for part in (first, one)]
        known = [rate.value for rate in rates if rate is not None]
        if len(known) == 1 or (len(known) == 2 and abs(known[1] / known[0] - 1.0) > RATE_DOUBT):
            raise checks.refuse(f"sample rate of {one.name}", known[-1], "that of the first", "Hz")
    if sum(one.columns.size for one in tables) > MOST_NUMBERS:
        raise checks.refuse("count of numbers in all files", "more", f"at most {MOST_NUMBERS}")
    columns = np.concatenate([one.columns for one in tables])
    ends = np.cumsum([len(one.columns) for one in tables])
    timed = [i for i, column in enumerate(first.contents.columns) if column.role == TIME]
    anew = len(timed) != 1
    for start, end in pairwise(ends) if len(timed) == 1 else ():
        time = columns[:, timed[0]]
        step = float(np.nanmedian(np.diff(time[:start])))
        if abs(time[start] - time[0]) < 0.5 * step or timed[0] in first.stamps:
            time[start:end] += time[start - 1] + step - time[start]
            anew = True
        elif time[start] <= time[start - 1]:
            raise checks.refuse("tables", "not in their order", "files in the order of their times")
    notes = [note for one in tables for note in one.notes]
    if len(tables) > 1:
        gap = " as if nothing were missing between them" if anew else ""
        notes.append(f"{len(tables)} files are joined{gap}.")
    name = first.name if len(tables) == 1 else f"{first.name} to {tables[-1].name}"
    return dataclasses.replace(first, columns=columns, name=name, notes=tuple(notes))
