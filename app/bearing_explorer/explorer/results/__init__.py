"""Results of a scene: one computation each, in threads, cached."""
