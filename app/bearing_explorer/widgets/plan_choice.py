"""What the program has planned for the views on screen, and a way to overrule it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar

import param

from bearing_explorer.assets import asset_text, scripts
from bearing_explorer.results import compiling
from bearing_explorer.results.planning import CHOICES, by_hand, chosen
from bearing_explorer.serve.live_component import LiveComponent
from bearingcore.plan import SETTLED

if TYPE_CHECKING:
    from bearing_explorer.results.results import Results

TITLES = {
    "load": "Loads of the balls",
    "stiffness": "Stiffness",
    "modes": "Natural frequencies",
    SETTLED: "Settled vibration",
}
"""What plans are for, as the page calls it."""


class PlanChoice(LiveComponent):
    """A button beside the status line, and what opens above it: plans, and choices by hand.

    `asked` gets {name: value} of CHOICES, or {"own": true} for the program's own choices, of the
    browser, from strangers too: judge them.
    """

    spec = param.Dict(default={})
    #: {"tab": name, "plans": [[title, sentence]], "resting": bool, "compiling": bool,
    #: "chosen": {name: value}, "by_hand": [words]}
    state = param.Dict(default={"plans": [], "resting": False, "chosen": {}, "by_hand": []})

    _esm = scripts("element.js", "plan_choice.js")
    _stylesheets: ClassVar[list[str]] = [
        asset_text("button.css"),
        asset_text("footer.css"),
        asset_text("plan_choice.css"),
    ]

    def __init__(self, asked: Callable[[Any], None], **params: Any) -> None:
        spec = {
            "choices": [
                {"name": name, "label": label, "options": list(options.items())}
                for name, (label, options) in CHOICES.items()
            ]
        }
        super().__init__(spec=spec, margin=0, **params)
        self.on_msg(lambda event: asked(event.data))

    @property
    def says_compiling(self) -> bool:
        """Whether the page says that kernels are being compiled."""
        return bool(self.state.get("compiling", False))

    def show(self, results: Results, tab: str) -> None:
        """What these results, drawn on a tab, are drawn by. On the event loop only."""
        state = {
            "tab": tab,
            "plans": [[TITLES[view], made.sentence()] for view, made in results.plans.items()],
            "resting": not results.moving,
            "compiling": not compiling.ready(),
            "chosen": chosen(results.settings),
            "by_hand": by_hand(results.settings),
        }
        self.put(state=state)
