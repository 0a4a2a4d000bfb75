"""The scripts of Bokeh's models, run without a browser, by V8.

In the browser, scripts make labels with prefixes, words and pictures from the numbers. A figure
that is drawn elsewhere runs the same scripts, so that both show the same.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from bokeh.model import Model
from bokeh.models import ColorBar, ColorMapper, ColumnDataSource, Label, Plot, Range1d

_EVENTS = [f"change:{name}" for name in ("start", "end", "inner_width", "inner_height", "data")]
_KEPT: dict[type[Model], tuple[str, ...]] = {
    Range1d: ("start", "end", "reset_start", "reset_end"),
    Plot: ("min_border_right", "x_range", "y_range"),
    ColorMapper: ("low", "high", "palette"),
    ColorBar: ("title",),
    Label: ("y",),
    Model: ("axis_label", "ticks", "visible"),
}
_WORLD = """
class Grid {  // Bokeh's arrays of two dimensions
  constructor(values, shape) {
    this.shape = shape
    this.values = values instanceof ArrayBuffer ? new Uint32Array(values) : values
  }
}
const bits = (numbers) => new Float32Array(Uint32Array.from(numbers).buffer)
const M = {}
const add = (id, properties) => {
  M[id] = {id, setv(news) { Object.assign(this, news) }, ...properties}
  M[id].change = {emit() { M[id].was = null }}
}
globalThis.window = globalThis
globalThis.addEventListener = () => {}
globalThis.matchMedia = () => ({matches: false})
globalThis.document = {documentElement: {hasAttribute: () => false, dataset: {}}}
const plain = (key, value) => value instanceof Grid
  ? {shape: value.shape, values: [...value.values]}
  : ArrayBuffer.isView(value) ? [...value].map((x) => isFinite(x) ? x : null)
  : typeof value === "number" && !isFinite(value) ? null : value
const toJson = (value) => JSON.stringify(value, plain)
"""


class Scripts:
    """The scripts of some models; `size` is that of the frame of each figure [px].

    `follow` runs the scripts that react to numbers, and updates the models. ImportError without V8.
    """

    def __init__(self, models: Iterable[Model], size: Mapping[str, tuple[float, float]]) -> None:
        from py_mini_racer import MiniRacer

        self._models = {model.id: model for model in models}
        self._v8 = MiniRacer()
        self._v8.eval(_WORLD)
        for name in self._models:  # all of them first, because properties refer to each other
            self._v8.eval(f"add({name!r}, {{}})")
        for model in self._models.values():
            self._v8.eval(f"M[{model.id!r}].setv({{{self._properties(model, size)}}})")
            if isinstance(model, ColumnDataSource):
                columns = (f"{json.dumps(k)}: {self._code(v)}" for k, v in model.data.items())
                data = f"{{{', '.join(columns)}}}"
                self._v8.eval(f"M[{model.id!r}].was = M[{model.id!r}].data = {data}")

    def _properties(self, model: Model, size: Mapping[str, tuple[float, float]]) -> str:
        kind = next(kind for kind in _KEPT if isinstance(model, kind))
        known = {name: getattr(model, name) for name in _KEPT[kind] if hasattr(model, name)}
        if isinstance(model, Plot):
            width, height = size.get(model.id, (0.0, 0.0))
            known |= {"inner_width": width, "inner_height": height, "outer_width": width}
        return ", ".join(f"{name}: {self._code(value)}" for name, value in known.items())

    def _code(self, value: Any) -> str:
        """Write a value as JavaScript; a model is named by its id."""
        if isinstance(value, Model):
            return f"M[{value.id!r}]"
        if isinstance(value, np.ndarray) and value.ndim == 2:
            return f"new Grid({self._code(value.ravel())}, {json.dumps(value.shape)})"
        if isinstance(value, np.ndarray) and value.dtype == np.float32:
            return f"bits({json.dumps(value.view(np.uint32).tolist())})"
        if isinstance(value, Mapping):
            pairs = (f"{json.dumps(str(name))}: {self._code(v)}" for name, v in value.items())
            return "{" + ", ".join(pairs) + "}"
        if isinstance(value, list | tuple):
            return "[" + ", ".join(self._code(v) for v in value) + "]"
        return json.dumps(value.tolist() if isinstance(value, np.ndarray | np.generic) else value)

    def follow(self) -> None:
        """Run the scripts that react to numbers and sizes; ignore those that need a page."""
        for event in _EVENTS:
            for model in list(self._models.values()):
                for script in model.js_property_callbacks.get(event, []):
                    body = f"(({{{', '.join(script.args)}}}, cb_obj) => {{{script.code}}})"
                    call = f"{body}({self._code(script.args)}, M[{model.id!r}])"
                    self._v8.eval(f"try {{ {call} }} catch (error) {{}}")
        for model in self._models.values():
            kind = next(kind for kind in _KEPT if isinstance(model, kind))
            names = [name for name in _KEPT[kind] if not isinstance(model, Plot)]
            if isinstance(model, ColumnDataSource):
                names = ["data"]
            for name in names:
                before = f"M[{model.id!r}].{name}"
                kept = f"{before} === M[{model.id!r}].was"  # no script has changed these numbers
                value = json.loads(self._v8.eval(f"toJson({kept} ? null : {before} ?? null)"))
                if value is not None and hasattr(model, name):
                    setattr(model, name, _arrays(value) if name == "data" else value)

    def run(self, code: str, args: Mapping[str, Any], **more: Any) -> Any:
        """Run the body of a function of `args` and `more`, and return its result."""
        names = {**args, **more}
        body = f"(({{{', '.join(names)}}}) => {{{code}}})({self._code(names)})"
        return json.loads(self._v8.eval(f"toJson({body})"))


def _arrays(data: Mapping[str, list[Any]]) -> dict[str, Any]:
    """Return columns with their pictures as arrays, and NaN for null."""
    return {
        name: [np.array(v["values"], dtype=float).reshape(v["shape"]) for v in values]
        if values and isinstance(values[0], dict)
        else [np.nan if v is None else v for v in values]
        for name, values in data.items()
    }
