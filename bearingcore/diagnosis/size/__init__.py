"""Estimation of the size of a defect."""
