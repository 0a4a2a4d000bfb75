"""From a scene to results: what is computed, when, in which thread, and what is kept."""
