"""A measured signal held against the model: how long a spall is, and how it grows."""

from bearingcore.sizing._measure_extent import ExtentStatus as ExtentStatus
from bearingcore.sizing._measure_extent import MeasuredExtent as MeasuredExtent
from bearingcore.sizing._measure_extent import measure_extent as measure_extent
from bearingcore.sizing._size_defect import Candidate as Candidate
from bearingcore.sizing._size_defect import Sizing as Sizing
from bearingcore.sizing._size_defect import SizingStatus as SizingStatus
from bearingcore.sizing._size_defect import size_defect as size_defect
from bearingcore.sizing._trend import LINES as LINES
from bearingcore.sizing._trend import Trend as Trend
from bearingcore.sizing._trend import TrendPoint as TrendPoint
from bearingcore.sizing._trend import trend as trend
from bearingcore.sizing._trend import trend_point as trend_point
