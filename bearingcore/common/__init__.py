"""Helpers of every layer: checks of input, tables, numbers in text, progress of long work."""

from bearingcore.common._arrays import Array, runs, summit, weighted_quantile
from bearingcore.common._checks import choice, refuse
from bearingcore.common._lazy import cached_property
from bearingcore.common._numbers import (
    PREFIXES,
    count,
    decibels,
    level_difference,
    number,
    percent,
    percent_off,
    prefix_power,
    prefixed_span,
    probability,
    scientific,
    span,
    thousands,
    with_deviation,
    with_prefix,
)
from bearingcore.common._progress import Progress
from bearingcore.common._scene_file import LARGEST_TEXT
from bearingcore.common._table import ResultTable, as_csv, shown_as_table, table_of

__all__ = [
    "LARGEST_TEXT",
    "PREFIXES",
    "Array",
    "Progress",
    "ResultTable",
    "as_csv",
    "cached_property",
    "choice",
    "count",
    "decibels",
    "level_difference",
    "number",
    "percent",
    "percent_off",
    "prefix_power",
    "prefixed_span",
    "probability",
    "refuse",
    "runs",
    "scientific",
    "shown_as_table",
    "span",
    "summit",
    "table_of",
    "thousands",
    "weighted_quantile",
    "with_deviation",
    "with_prefix",
]
