"""The page for ``panel serve app/app.py``."""

import sys
from pathlib import Path

# `panel serve` puts this file's folder first on the path, where this file hides the package.
_here = Path(__file__).resolve().parent
sys.path[:] = [str(_here.parent), *(p for p in sys.path if Path(p or ".").resolve() != _here)]
if not hasattr(sys.modules.get("app"), "__path__"):
    sys.modules.pop("app", None)

from app.page import page, warm_once  # noqa: E402

warm_once()
page().servable()
