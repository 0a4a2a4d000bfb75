"""The physics: scenes, statics, dynamics, sweeps of scenes and experiments on methods.

It reads no files and diagnoses nothing. Its packages are imported when they are used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
