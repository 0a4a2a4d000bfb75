"""Signals as such, measured or simulated: reading, spectra, envelopes, averages."""
