"""The physics of a damaged ball bearing, after Petersen, Howard & Prime (2014). SI units, rad.

The stub beside this file lists the public names; each is imported when it is first used.
"""

import lazy_loader

__version__ = "0.3.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
