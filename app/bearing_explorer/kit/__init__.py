"""What both halves of the page stand on: neither is known here."""
