"""Used by every layer: checks of input, progress of long work."""

from bearingcore.common.checks import choice as choice
from bearingcore.common.checks import refuse as refuse
from bearingcore.common.lazy import cached_property as cached_property
from bearingcore.common.numbers import PREFIXES as PREFIXES
from bearingcore.common.numbers import count as count
from bearingcore.common.numbers import decibels as decibels
from bearingcore.common.numbers import level_difference as level_difference
from bearingcore.common.numbers import number as number
from bearingcore.common.numbers import percent as percent
from bearingcore.common.numbers import percent_off as percent_off
from bearingcore.common.numbers import prefix_power as prefix_power
from bearingcore.common.numbers import prefixed_span as prefixed_span
from bearingcore.common.numbers import probability as probability
from bearingcore.common.numbers import scientific as scientific
from bearingcore.common.numbers import span as span
from bearingcore.common.numbers import thousands as thousands
from bearingcore.common.numbers import with_deviation as with_deviation
from bearingcore.common.numbers import with_prefix as with_prefix
from bearingcore.common.scene_file import LARGEST_TEXT as LARGEST_TEXT
from bearingcore.common.table import ResultTable as ResultTable
from bearingcore.common.table import as_csv as as_csv
from bearingcore.common.table import table_of as table_of
