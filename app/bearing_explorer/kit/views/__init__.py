"""Parts of the views of both halves."""
