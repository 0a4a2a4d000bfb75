"""Signals out of files: columns of numbers, their meaning by the file, open questions."""
