"""The public names of the model itself; its packages list their own."""

from ._kernels import all_on_disk as all_on_disk, kept_on_disk as kept_on_disk
from ._warm_up import (
    BALLS_WITH_MASS as BALLS_WITH_MASS,
    MOTION as MOTION,
    ORBITS as ORBITS,
    PARTS as PARTS,
    STATICS as STATICS,
    warm as warm,
)
