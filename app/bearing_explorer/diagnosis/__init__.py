"""The measured signal: its form, session, views and report."""
