"""Results of a scene: each module holds one computation, which is cached and runs in a thread."""
