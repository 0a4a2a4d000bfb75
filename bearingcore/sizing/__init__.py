"""Comparison of measured signals with the model: length and growth of a spall."""

from bearingcore.sizing._measure_extent import ExtentStatus, MeasuredExtent, measure_extent
from bearingcore.sizing._read_floor import read_floor
from bearingcore.sizing._size_defect import Candidate, Sizing, SizingStatus, size_defect
from bearingcore.sizing._trend import LINES, Trend, TrendPoint, trend, trend_point

__all__ = [
    "LINES",
    "Candidate",
    "ExtentStatus",
    "MeasuredExtent",
    "Sizing",
    "SizingStatus",
    "Trend",
    "TrendPoint",
    "measure_extent",
    "read_floor",
    "size_defect",
    "trend",
    "trend_point",
]
