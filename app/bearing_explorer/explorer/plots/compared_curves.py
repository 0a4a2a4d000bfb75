"""Curves of compared scenes: a colour and a dash for each, and a key with their names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeVar

import numpy as np
from bokeh.models import GlyphRenderer, Legend, LegendItem, Plot

from bearing_explorer.explorer.state.references import MOST_COMPARED
from bearing_explorer.kit.plots import style
from bearing_explorer.kit.plots.layers import Glyph, curve, strips

Other = TypeVar("Other")

COLORS = ("#009E73", "#AA3377", "#661100", "#56B4E9")
DASHES: tuple[tuple[int, ...], ...] = ((8, 3), (3, 2), (9, 3, 2, 3), (14, 4))

THIN = "thin: x, horizontal"
"""Tag of a figure with two curves for each scene, the horizontal one thin; its key says so."""

_SLOT = "_compared_"
_LONGEST_NAME = 28


def curves(name: str, x: str, *ys: str, width: float = 1.6, thin: str = "") -> list[Glyph]:
    """Layers that draw the columns `ys` over `x` for each compared scene; see `sources`.

    `thin`: the column of `ys` that is drawn with half the width.
    """
    return [
        curve(f"{name}{_SLOT}{slot}", x, y, color, 0.5 * width if y == thin else width, dash)
        for slot, (color, dash) in enumerate(zip(COLORS, DASHES, strict=True))
        for y in ys
    ]


def bands(name: str, *, level: bool = False) -> list[Glyph]:
    """Layers that draw strips from ``low`` to ``high`` for each compared scene."""
    return [
        strips(f"{name}{_SLOT}{slot}", color, 0.10, level=level)
        for slot, color in enumerate(COLORS)
    ]


def sources(
    name: str,
    columns: Sequence[str],
    compared: Iterable[Other],
    compute: Callable[[Other], Mapping[str, np.ndarray]],
) -> dict[str, dict[str, np.ndarray]]:
    """Sources of the layers, with the `columns` of `compute`; empty if that raises ValueError."""
    nothing = dict.fromkeys(columns, np.zeros(0))
    curves: list[dict[str, np.ndarray]] = []
    for other in compared:
        try:
            computed = compute(other)
            curves.append({column: computed[column] for column in columns})
        except ValueError:
            curves.append(nothing)
    curves += [nothing] * (MOST_COMPARED - len(curves))
    return {f"{name}{_SLOT}{slot}": values for slot, values in enumerate(curves)}


def numbers(drawn: Mapping[str, Mapping[str, np.ndarray]], column: str) -> np.ndarray:
    """A column of all compared scenes, for the range of an axis."""
    return np.concatenate([curve[column] for curve in drawn.values()])


class CurveKey:
    """Key above a figure: the names of the compared scenes with their lines.

    It is part of the figure, so exported figures have it too. A figure without such curves has
    no `items`.
    """

    def __init__(self, plot: Plot) -> None:
        self._note = f" ({THIN})" if THIN in plot.tags else ""
        lines: dict[int, GlyphRenderer] = {}
        for drawn in plot.renderers:
            named = (isinstance(drawn, GlyphRenderer) and drawn.data_source.name) or ""
            slot = named.rpartition(_SLOT)[2] if _SLOT in named else ""
            if slot and drawn.glyph.__class__.__name__ == "Line":
                lines.setdefault(int(slot), drawn)
        self.items = [
            LegendItem(label="", renderers=[lines[slot]], visible=False) for slot in sorted(lines)
        ]
        if self.items:
            self._legend = _legend(self.items)
            plot.add_layout(self._legend, "above")

    def show(self, names: Sequence[str]) -> None:
        """Show the names of the compared scenes; without names the key is hidden."""
        shown = [_short(name) + self._note for name in names]
        if shown == [item.label.value for item in self.items if item.visible]:
            return
        for slot, item in enumerate(self.items):
            visible = slot < len(shown)
            item.update(label={"value": shown[slot] if visible else ""}, visible=visible)
        self._legend.visible = bool(shown)


def _legend(items: list[LegendItem]) -> Legend:
    return Legend(
        items=items,
        visible=False,
        orientation="horizontal",
        location="top_left",
        ncols=2,
        border_line_color=None,
        background_fill_color=style.PAPER,
        label_text_font=style.FONT,
        label_text_font_size=style.TEXT_SIZE,
        label_text_color=style.INK,
        glyph_width=26,
        glyph_height=12,
        label_height=12,
        padding=2,
        margin=2,
        spacing=8,
    )


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST_NAME else name[: _LONGEST_NAME - 1] + "…"
