"""Measured and simulated signals: their state, their whitening and their envelopes."""
