"""Figures of bearingcore's results for notebooks, as HoloViews objects.

``from bearing_explorer import plotting`` and hand a result to the function that is called like it:

    plotting.load_distribution(equilibrium(scene), healthy=equilibrium(scene.healthy()))

Every object has dimensions with names and units, lies on the page's colours, and can be laid out,
overlaid, sliced and saved as any HoloViews object can (``+``, ``*``, ``.select``, ``hv.save``; with
``resources="inline"`` what it saves needs nothing from outside).
Numbers are in SI units, with the prefix of the axis chosen as one zooms; angles are in degrees, and
their dimensions say so: ``cage_angle_deg``.
"""

import holoviews as hv

if "bokeh" not in hv.Store.loaded_backends():
    hv.extension("bokeh", logo=False, inline=True)  # exported notebooks need nothing from outside

from bearing_explorer.plotting.maps import maps
from bearing_explorer.plotting.motion import motion, orbit, spectrum
from bearing_explorer.plotting.notebook import bring_style_sheets
from bearing_explorer.plotting.plane import plane
from bearing_explorer.plotting.sizing import sizing
from bearing_explorer.plotting.statics import load_distribution, modes, stiffness

bring_style_sheets()

__all__ = [
    "load_distribution",
    "maps",
    "modes",
    "motion",
    "orbit",
    "plane",
    "sizing",
    "spectrum",
    "stiffness",
]
