"""Containers that come with one child, and with the next in messages that follow at once.

Their views take a while, as those do whose script is loaded as a module.
"""

import panel as pn
from bearing_explorer.kit.assets import asset_text

TEMPLATE = """
{% extends base %}
{% block inner_head %}
{{ super() }}
<script>{{ order_script }}</script>
<script>
  const spacer = Bokeh.Models.get("Spacer").prototype.default_view.prototype
  const begin = spacer.lazy_initialize
  spacer.lazy_initialize = async function () {
    await begin.call(this)
    await new Promise((done) => setTimeout(done, 300))
  }
</script>
{% endblock %}
{% block contents %}{{ embed(roots.main) }}{% endblock %}
"""
NUMBERS = (3, 1, 4)


def child(name: str) -> pn.Spacer:
    """Something to look for."""
    return pn.Spacer(width=10, height=10, name=name, css_classes=["child", name])


number = pn.widgets.IntInput(value=0, css_classes=["number"])
number.jscallback(value="(window.heard ??= []).push(cb_obj.value)")
main = pn.Column(number)
given = pn.state.session_args or {}
boxes = [pn.Column() for _ in range(int(given.get("boxes", [b"1"])[0]))]


async def fill() -> None:
    """Each `append` to what is on the page is a message of its own."""
    for place, box in enumerate(boxes):
        box.append(child(f"first-{place}"))
        main.append(box)
        box.append(child(f"second-{place}"))
        box.append(child(f"third-{place}"))
    for value in NUMBERS:
        number.value = value


pn.state.onload(fill)
template = pn.Template(TEMPLATE)
template.add_variable("order_script", asset_text("in_order.js"))
template.add_panel("main", main)
template.servable()
