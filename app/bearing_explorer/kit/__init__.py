"""The ground that both halves of the page stand on: neither is known here."""
