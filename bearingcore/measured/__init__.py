"""Measured signals: reading them from files, analysing them, and naming the damaged part.

It knows no model of motion and no compiled code.
"""
