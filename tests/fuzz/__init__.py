"""Inputs from strangers, by the hundred thousand: ``python -m tests.fuzz``."""
