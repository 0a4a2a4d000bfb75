"""Balls with mass: their motion, and their static positions at high speed."""
