"""Views that draw the scene beside others: the reference in grey, compared scenes dashed."""

from __future__ import annotations

import re
from collections.abc import Mapping

from bearing_explorer.explorer.plots.compared_curves import CurveKey
from bearing_explorer.explorer.results.results import Results
from bearing_explorer.explorer.state.references import WITHOUT_DEFECT
from bearing_explorer.kit.serve.packed_source import PackedSource
from bearing_explorer.kit.views.base import View

_OF_DEFECT = re.compile(r" (Grey[ a-z]*: \{grey\}|Shaded: the defect)\.")


class ComparingView(View[Results]):
    """A view with layers of `compared_curves`; ``{grey}`` in `about` is the reference's name."""

    def __init__(self, packed: PackedSource) -> None:
        super().__init__(packed)
        #: keys of the figures that draw compared scenes
        self._keys = [key for plot in self.figures if (key := CurveKey(plot)).items]

    @classmethod
    def caption(cls, content: Results | None = None) -> str:
        if content is not None and not content.grey.label:  # no defect: the scene itself is grey
            return _OF_DEFECT.sub("", cls.about)
        return cls.about.replace("{grey}", content.grey.name if content else WITHOUT_DEFECT)

    def say(self, results: Results | None, sentence: str) -> None:
        super().say(results, sentence)
        if results is not None:
            for key in self._keys:
                key.show([reference.name for reference in results.compared])

    def arguments(self, results: Results) -> Mapping[str, str]:
        return {**super().arguments(results), **results.compared_argument}
