"""The public names of the model itself; its packages list their own."""

from ._kernels import (
    all_on_disk as all_on_disk,
)
from ._kernels import (
    kept_on_disk as kept_on_disk,
)
from ._warm_up import (
    BALLS_WITH_MASS as BALLS_WITH_MASS,
)
from ._warm_up import (
    MOTION as MOTION,
)
from ._warm_up import (
    ORBITS as ORBITS,
)
from ._warm_up import (
    PARTS as PARTS,
)
from ._warm_up import (
    STATICS as STATICS,
)
from ._warm_up import (
    warm as warm,
)
