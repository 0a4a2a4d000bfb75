"""Computing off the event loop: threads, cache, jobs, the drawing loop."""
