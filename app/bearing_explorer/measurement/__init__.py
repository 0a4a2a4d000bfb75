"""The measured signal of a session: file or simulation, questions about it, its spectra."""
