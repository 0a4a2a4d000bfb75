"""The page for ``panel serve app/app.py``."""

from bearing_explorer.page import page

page().servable()
