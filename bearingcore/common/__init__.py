"""Used by every layer: checks of input, progress of long work."""
