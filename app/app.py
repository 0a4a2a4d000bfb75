"""The page for ``panel serve app/app.py``."""

from bearing_explorer.page import page, warm_once

warm_once()
page().servable()
