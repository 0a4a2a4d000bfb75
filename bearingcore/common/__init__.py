"""Used by every layer: checks of input, progress of long work."""

from bearingcore.common.checks import choice, real_number, refuse
from bearingcore.common.lazy import cached_property
from bearingcore.common.numbers import (
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
from bearingcore.common.progress import Progress
from bearingcore.common.scene_file import LARGEST_TEXT
from bearingcore.common.table import ResultTable, as_csv, table_of

__all__ = [
    "LARGEST_TEXT",
    "PREFIXES",
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
    "real_number",
    "refuse",
    "scientific",
    "span",
    "table_of",
    "thousands",
    "with_deviation",
    "with_prefix",
]
