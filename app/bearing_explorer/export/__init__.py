"""Lines of Python that make what a view shows."""
