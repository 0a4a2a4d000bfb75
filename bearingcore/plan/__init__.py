"""The cheapest settings that keep a picture inside an error budget."""
