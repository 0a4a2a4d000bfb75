"""Status of a static state at one cage angle."""

from __future__ import annotations

import enum
import math

from bearingcore.common import scientific
from bearingcore.model import _kernels as kernels


@enum.unique
class StaticStatus(enum.IntEnum):
    """The codes of `status` in `Equilibrium`, `Maps` and `BallPositions`.

    From NOT_CARRIED on, nothing of a state is known.
    """

    NOT_COMPUTED = kernels.OPEN
    CONVERGED = kernels.CONVERGED
    NOTHING_TOUCHES = kernels.NOTHING_TOUCHES
    FREE_DIRECTION = kernels.FREE_DIRECTION
    NOT_CARRIED = kernels.NOT_CARRIED
    NOT_CONVERGED = kernels.NOT_CONVERGED
    REFUSED = kernels.REFUSED
    TOO_MANY_CONTACTS = kernels.TOO_MANY
    BEYOND_GEOMETRY = kernels.BEYOND

    def sentence(self, free: str = "some direction", residual: float = math.nan) -> str:
        """Return the status in words, without a full stop.

        Parameters
        ----------
        free
            directions without resistance.
        residual
            size of the unbalanced load over the size of the load; NaN is left out.
        """
        if self is StaticStatus.NOT_CONVERGED and math.isfinite(residual):
            return f"not converged: relative residual {scientific(residual, 2)}"
        if self is StaticStatus.FREE_DIRECTION:
            return f"the ring can move without resistance along {free}"
        return _SENTENCES.get(self, self.name.replace("_", " ").lower())


_SENTENCES = {
    StaticStatus.NOTHING_TOUCHES: "nothing touches: no load presses a ball",
    StaticStatus.NOT_CARRIED: "no contact can carry this load: the ring would move without end",
    StaticStatus.BEYOND_GEOMETRY: "no equilibrium that the geometry of the contacts allows",
    StaticStatus.REFUSED: "this extent is not possible in this scene",
}
