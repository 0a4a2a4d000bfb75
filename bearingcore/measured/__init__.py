"""Measured signals: reading them from files, analysing them, and naming the damaged part.

This package uses neither a model of motion nor compiled code.
"""
