"""Front of the measured signal's half for the page: its tab and its session."""

from __future__ import annotations

from bearing_explorer.diagnosis.half import DiagnosisOfSignal
from bearing_explorer.diagnosis.views.diagnosis import PartDiagnosis
from bearing_explorer.diagnosis.views.extent import SpallExtent
from bearing_explorer.diagnosis.views.measured_envelope import MeasuredEnvelope
from bearing_explorer.diagnosis.views.measured_indicators import MeasuredIndicators
from bearing_explorer.diagnosis.views.measured_kurtogram import MeasuredKurtogram
from bearing_explorer.diagnosis.views.measured_spectrogram import MeasuredSpectrogram
from bearing_explorer.diagnosis.views.measured_spectrum import MeasuredSpectrum
from bearing_explorer.diagnosis.views.measurement import MeasuredSignal
from bearing_explorer.diagnosis.views.signal_figure import figure_of
from bearing_explorer.diagnosis.views.trend import TrendOfFiles
from bearing_explorer.diagnosis.views.which_length import WhichLength
from bearing_explorer.kit.session import Section

__all__ = ["SECTIONS", "DiagnosisOfSignal", "figure_of"]

SECTIONS = (
    Section(
        "diagnosis",
        "Diagnosis",
        (
            MeasuredSignal,
            PartDiagnosis,
            SpallExtent,
            WhichLength,
            TrendOfFiles,
            MeasuredIndicators,
            MeasuredSpectrum,
            MeasuredEnvelope,
            MeasuredKurtogram,
            MeasuredSpectrogram,
        ),
    ),
)
"""The tab of the measured signal."""
