"""Parts of the page around the figures: controls, tabs, status, share bar."""
