"""Dynamics: natural frequencies, simulated motion, the periodic steady state, speed runs."""
