"""The measured signal of a session: file or simulation, what is asked about it, its spectra."""
