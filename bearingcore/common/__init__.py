"""Helpers of every layer: checks of input, tables, numbers in text, progress of long work."""

from bearingcore.common._arrays import (
    Array as Array,
    runs as runs,
    summit as summit,
    weighted_quantile as weighted_quantile,
)
from bearingcore.common._checks import choice as choice, refuse as refuse
from bearingcore.common._lazy import cached_property as cached_property
from bearingcore.common._numbers import (
    PREFIXES as PREFIXES,
    count as count,
    decibels as decibels,
    level_difference as level_difference,
    number as number,
    percent as percent,
    percent_off as percent_off,
    prefix_power as prefix_power,
    prefixed_span as prefixed_span,
    probability as probability,
    scientific as scientific,
    span as span,
    thousands as thousands,
    with_deviation as with_deviation,
    with_prefix as with_prefix,
)
from bearingcore.common._progress import Progress as Progress
from bearingcore.common._scene_file import LARGEST_TEXT as LARGEST_TEXT
from bearingcore.common._table import (
    ResultTable as ResultTable,
    as_csv as as_csv,
    shown_as_table as shown_as_table,
    table_of as table_of,
)
