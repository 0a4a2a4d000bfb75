"""Balls with mass: their motion, and their place at high speed."""
