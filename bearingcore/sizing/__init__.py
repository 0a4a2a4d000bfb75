"""Comparison of measured signals with the model: length and growth of a spall."""

from bearingcore.measured.diagnosis import ExtentStatus as ExtentStatus
from bearingcore.sizing._measure_extent import (
    MeasuredExtent as MeasuredExtent,
    measure_extent as measure_extent,
)
from bearingcore.sizing._read_floor import read_floor as read_floor
from bearingcore.sizing._size_defect import (
    Candidate as Candidate,
    Sizing as Sizing,
    SizingStatus as SizingStatus,
    size_defect as size_defect,
)
from bearingcore.sizing._trend import (
    LINES as LINES,
    Trend as Trend,
    TrendPoint as TrendPoint,
    trend as trend,
    trend_point as trend_point,
)
