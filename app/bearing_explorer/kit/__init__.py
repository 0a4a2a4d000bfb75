"""Modules that both halves of the page share; they import neither half."""
