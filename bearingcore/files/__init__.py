"""Signals out of files: columns of numbers, what the file says about them, what is to be asked."""
