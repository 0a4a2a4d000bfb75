"""A container that comes with one child, and with the next in a message that follows at once."""

from typing import ClassVar

import panel as pn
import param
from bearing_explorer.assets import asset_text

TEMPLATE = """
{% extends base %}
{% block inner_head %}{{ super() }}<script>{{ order_script }}</script>{% endblock %}
{% block contents %}{{ embed(roots.main) }}{% endblock %}
"""


class Word(pn.custom.JSComponent):
    """A component, whose script the browser loads as a module before its view stands."""

    text = param.String()

    _esm: ClassVar[str] = """
    export function render({ model }) {
      const word = document.createElement("p")
      word.className = "word"
      word.textContent = model.text
      return word
    }"""


main = pn.Column()
boxes = [pn.Column(), pn.Column()]


async def fill() -> None:
    """Each `append` is a message of its own."""
    for number, box in enumerate(boxes):
        box.append(Word(text=f"{number}a"))
        main.append(box)
        box.append(Word(text=f"{number}b"))
        box.append(Word(text=f"{number}c"))


pn.state.onload(fill)
template = pn.Template(TEMPLATE)
template.add_variable("order_script", asset_text("in_order.js"))
template.add_panel("main", main)
template.servable()
