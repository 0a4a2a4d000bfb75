"""What every layer uses: checks of input, progress of long work."""
