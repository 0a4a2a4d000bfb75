"""The packed source: everything drawn goes to the browser as one float32 array a scene.

Replacing the data of many sources costs one message, one serialisation and one repaint each.
Here the server assigns ONE array on ONE small source; a callback in the browser cuts it into
the sources the figures draw from and sets the ranges. Those sources are made with
``syncable=False``: a source that syncs would echo each update back to the server.

The array is, in float32:

    mark, seconds of work, number of sources, number of ranges,
    (source, columns, length) for each source sent,
    (range, start, end) for each range sent,
    the columns of the sources sent, one after the other.

A range that is zoomed stays where it is; only the range that a reset goes back to is new.

Whole numbers up to 2**24 pass through float32 unharmed; NaN passes as NaN, a gap in a line.
A source whose numbers have not changed is not sent again, so its figure is not repainted.

The controls read ``window.__mark`` (the `mark` of the newest packet: which inputs it belongs to),
``window.__worked`` (the time that computing it took [s], without waiting) and ``window.__arrived``
(the time when its first packet came [ms]); tests and benchmarks read ``window.__frames`` (packets
received) too.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, Range1d, Spacer

from bearing_explorer.kit.serve.bokeh_internals import PLAIN

Columns = Mapping[str, np.ndarray]

_UNPACK = """
const t = cb_obj.data.packed
const p = new Float32Array(t.buffer, t.byteOffset, t.length)
const n_sources = p[2], n_ranges = p[3]
let head = 4, body = 4 + 3*(n_sources + n_ranges)
const blocks = []
for (let i = 0; i < n_sources; i++, head += 3) {
  const names = columns[p[head]], length = p[head + 2], data = {}
  for (const name of names) {
    data[name] = p.subarray(body, body + length)
    body += length
  }
  blocks.push([sources[p[head]], data])
}
// Ranges first: a figure then paints its new lines once, at their new places.
for (let i = 0; i < n_ranges; i++, head += 3) {
  const range = ranges[p[head]], start = p[head + 1], end = p[head + 2]
  const {reset_start, reset_end} = range
  const zoomed = reset_start !== null && (range.start !== reset_start || range.end !== reset_end)
  const home = {reset_start: start, reset_end: end}
  range.setv(zoomed ? home : {start, end, ...home})
}
for (const [source, data] of blocks)
  source.data = data
window.__frames = (window.__frames || 0) + 1
if (p[0] !== window.__mark) {  // or it is the same inputs, drawn finely at rest
  window.__worked = p[1]
  window.__arrived = performance.now()
}
window.__mark = p[0]
window.dispatchEvent(new Event("explorer-drawn"))
"""


class PackedSource:
    """Browser-side sources and ranges of one session, fed by one packed array."""

    def __init__(self) -> None:
        self._sources: dict[str, ColumnDataSource] = {}
        #: the columns of each source
        self.columns: dict[str, tuple[str, ...]] = {}
        self._ranges: dict[str, Range1d] = {}
        #: shape and bytes that were last sent of each source and range
        self._sent: dict[ColumnDataSource | Range1d, tuple[tuple[int, ...], bytes]] = {}
        self._packet = ColumnDataSource(data={"packed": np.zeros(4, np.float32)})
        self._unpack = CustomJS(args=self._args(), code=_UNPACK)
        self._known = 0  # number of sources and ranges that the browser's callback has
        self._packet.js_on_change("data", self._unpack)
        #: an invisible model that carries the packet into the document; put it on the page once
        self.anchor = Spacer(width=0, height=0, visible=False, tags=[self._packet])

    def source(self, name: str, *columns: str) -> ColumnDataSource:
        """Declare a source that lives in the browser; `name` is what `send` calls it."""
        if name in self._sources:
            raise ValueError(f"source {name!r} is declared twice; names are one per session")
        if not columns:
            raise ValueError(f"source {name!r} has no columns; it needs at least one")
        source = ColumnDataSource(
            data={column: [] for column in columns}, name=name, syncable=PLAIN
        )
        self._sources[name], self.columns[name] = source, columns
        return source

    def range(self, name: str, start: float, end: float) -> Range1d:
        """Declare a range that `send` can move; also its bounds for the reset tool."""
        if name in self._ranges:
            raise ValueError(f"range {name!r} is declared twice; names are one per session")
        moved = Range1d(start, end, syncable=PLAIN)
        self._ranges[name] = moved
        return moved

    def send(
        self,
        data: Mapping[str, Columns],
        ranges: Mapping[str, tuple[float, float]] | None = None,
        mark: int = 0,
        worked: float = 0.0,
    ) -> int:
        """Send what changed to the browser in one message; return its size [bytes].

        `mark` travels with the packet, so that the browser knows which inputs are drawn; `worked`
        is the time that computing them took [s], without waiting.
        """
        if PLAIN:
            self._assign(data, ranges or {})
            data, ranges = {}, {}
        packed = self.pack(data, ranges or {}, mark, worked)
        self.introduce()
        self._packet.data = {"packed": packed}
        return packed.nbytes

    def _assign(
        self, data: Mapping[str, Columns], ranges: Mapping[str, tuple[float, float]]
    ) -> None:
        """Change sources and ranges by Bokeh's own messages; the packet holds the mark alone."""
        for name, columns in data.items():
            self._sources[name].data = dict(columns)
        for name, (start, end) in ranges.items():
            moved = self._ranges[name]
            home = moved.reset_start, moved.reset_end
            if home in ((None, None), (moved.start, moved.end)):  # otherwise it is zoomed
                moved.update(start=start, end=end)
            moved.update(reset_start=start, reset_end=end)

    def introduce(self) -> None:
        """Give all declared sources and ranges to the browser's callback.

        Call it when their figures are in the document, in the same message: each time that a
        callback gets models, Bokeh counts all models of the document.
        """
        if self._known != (known := len(self._sources) + len(self._ranges)):
            self._unpack.args = self._args()
            self._known = known

    def pack(
        self,
        data: Mapping[str, Columns],
        ranges: Mapping[str, tuple[float, float]],
        mark: int = 0,
        worked: float = 0.0,
    ) -> np.ndarray:
        """Pack what changed since the last packet into one float32 array."""
        heads: list[tuple[float, float, float]] = []
        blocks: list[np.ndarray] = []
        order = {name: index for index, name in enumerate(self._sources)}
        for name, columns in data.items():
            block = self._block(name, columns)
            if self._is_new(self._sources[name], block):
                heads.append((order[name], block.shape[0], block.shape[1]))
                blocks.append(block.ravel())
        n_sources = len(heads)
        range_order = {name: index for index, name in enumerate(self._ranges)}
        for name, (start, end) in ranges.items():
            if name not in range_order:
                raise ValueError(f"range {name!r} was not declared; known: {sorted(range_order)}")
            if self._is_new(self._ranges[name], np.array([start, end], np.float32)):
                heads.append((range_order[name], start, end))
        head = np.array([mark, worked, n_sources, len(heads) - n_sources], np.float32)
        return np.concatenate([head, np.array(heads, np.float32).ravel(), *blocks])

    def _is_new(self, model: ColumnDataSource | Range1d, numbers: np.ndarray) -> bool:
        """Return True if a model had other numbers before, bit for bit, so that NaN equals NaN."""
        now = numbers.shape, numbers.tobytes()
        if self._sent.get(model) == now:
            return False
        self._sent[model] = now
        return True

    def _block(self, name: str, columns: Columns) -> np.ndarray:
        """Return the columns of a source as rows of one array, in the order of declaration."""
        if name not in self._sources:
            raise ValueError(f"source {name!r} was not declared; known: {sorted(self._sources)}")
        wanted = self.columns[name]
        if set(columns) != set(wanted):
            raise ValueError(f"source {name!r} has columns {wanted}, not {tuple(columns)}")
        rows = [np.asarray(columns[column]) for column in wanted]
        if len({row.size for row in rows}) > 1:
            sizes = {column: row.size for column, row in zip(wanted, rows, strict=True)}
            raise ValueError(f"columns of source {name!r} differ in length: {sizes}")
        block = np.empty((len(rows), rows[0].size), np.float32)
        for packed, row in zip(block, rows, strict=True):
            packed[:] = row.ravel()
        return block

    def _args(self) -> dict[str, list]:
        return {
            "sources": list(self._sources.values()),
            "columns": [list(columns) for columns in self.columns.values()],
            "ranges": list(self._ranges.values()),
        }
