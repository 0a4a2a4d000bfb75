"""The views of the page, one file each. `base.View` says what a view is."""
