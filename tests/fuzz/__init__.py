"""Broken inputs of parsers and hostile messages."""
