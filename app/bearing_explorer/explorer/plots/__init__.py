"""Drawing that is of scenes alone."""
