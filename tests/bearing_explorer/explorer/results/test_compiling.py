"""Pages are open while kernels are compiled: what comes along is drawn, the rest comes later."""

import asyncio
import threading
from collections.abc import Iterator

import numpy as np
import pytest
from bearing_explorer.default_results import TABS, draw_all
from bearing_explorer.explorer.results import default_results
from bearing_explorer.kit.compute import cache, compiling
from bearing_explorer.kit.compute.compiling import Compilation, StillCompiling
from bearing_explorer.page import SECTIONS

from bearingcore.model import PARTS
from tests.helpers.loops import run
from tests.helpers.served import wait_until
from tests.helpers.sessions import SceneSession


@pytest.fixture
def compilation(monkeypatch: pytest.MonkeyPatch) -> Iterator[Compilation]:
    """A process that has not begun; nothing is on disk, and nothing is in the cache."""
    made = Compilation()
    for name in ("begin", "wait", "left", "need", "progress", "drawn"):
        monkeypatch.setattr(compiling, name, getattr(made, name))
    monkeypatch.setattr(compiling, "FIRST_PICTURE", 0.0)
    monkeypatch.setattr(compiling, "all_on_disk", lambda: False)
    cache.clear()
    yield made
    cache.clear()


def test_parts_are_ready_one_after_the_other(
    compilation: Compilation, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on = {part: threading.Event() for part in PARTS}
    said: list[str] = []

    def warm(report: object, parts: tuple[str]) -> None:
        assert go_on[parts[0]].wait(60.0)
        said.append(parts[0])

    monkeypatch.setattr(compiling, "warm", warm)
    assert compilation.left() == ()
    over = threading.Event()
    compilation.begin(done=over.set)
    compilation.begin()
    for part in PARTS:
        assert compilation.left()[0] == part
        assert compilation.progress()["done"] == len(said)
        assert compilation.progress()["still"] == (part == compiling.STATICS)
        with pytest.raises(StillCompiling):
            compilation.need(part)
        go_on[part].set()
        wait_until(lambda part=part: part not in compilation.left())
        compilation.need(part)
    assert over.wait(60.0)
    assert said == list(PARTS)
    assert compilation.progress() == {}


async def until_drawn(explorer: SceneSession) -> None:
    async with asyncio.timeout(60.0):
        while not explorer._loop.drawn:
            await asyncio.sleep(0.01)
    explorer.stop()


def test_the_first_picture_comes_before(
    compilation: Compilation, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compiling, "FIRST_PICTURE", 600.0)
    monkeypatch.setattr(compiling, "warm", lambda *_: None)

    async def live() -> None:
        explorer = SceneSession(SECTIONS)
        assert not compilation.wait(0.2)
        explorer.draw()
        await until_drawn(explorer)

    compilation.begin()
    run(live())
    assert compilation.wait(60.0)


def test_an_error_ends_it_and_kernels_are_compiled_where_they_are_needed(
    compilation: Compilation, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def warm(*_: object) -> None:
        raise OSError("no compiler")

    monkeypatch.setattr(compiling, "warm", warm)
    compilation.begin()
    assert compilation.wait(60.0)
    assert compilation.left() == ()
    assert "no compiler" in caplog.text


def test_pictures_of_the_default_scene_need_no_kernel(compilation: Compilation) -> None:
    default_results.keep()
    compilation._left = tuple(PARTS)
    pictures = draw_all()
    assert len(pictures) == 2 * len(TABS)
    for picture in pictures:
        assert picture.warnings is not None
        for drawing in picture.drawings:
            assert drawing.data is not None, f"{drawing.view.name}: {drawing.sentence}"
        assert picture.status["mood"] == "good", picture.status


def test_pictures_of_other_scenes_say_that_they_are_not_ready(compilation: Compilation) -> None:
    default_results.keep()
    compilation._left = tuple(PARTS)

    async def live() -> tuple[str, str]:
        explorer = SceneSession(SECTIONS)
        before = explorer.scene
        explorer.change_scene({"set": {"extent_deg": 33.0}})
        assert explorer.scene == before, "sliders do not move yet"
        explorer.editor.set({"extent_deg": 33.0})  # as a link does
        explorer.draw()
        await until_drawn(explorer)
        view = explorer._views["overview"][0]
        return explorer.status.line["words"], view._sentence.text

    words, sentence = run(live())
    assert "still being compiled" in words
    assert "still being compiled" in sentence


def test_what_comes_along_is_what_is_computed() -> None:
    """`python -m bearing_explorer.default_results` makes it anew."""
    cache.clear()
    draw_all()
    shipped, computed = default_results.read(), default_results.collect()
    assert set(shipped) == set(computed)
    for key, types in computed.items():
        for path, (one, other) in numbers_of(shipped[key], types):
            size = np.nanmax(np.abs(other), initial=1e-300)
            np.testing.assert_allclose(
                one, other, rtol=0.0, atol=1e-6 * size, err_msg=f"{key[0]}{path}"
            )
    cache.clear()


def numbers_of(
    one: object, other: object, path: str = ""
) -> Iterator[tuple[str, tuple[np.ndarray, np.ndarray]]]:
    """Pairs of arrays at the same places of two results; the rest has to be equal."""
    if isinstance(other, np.ndarray | float):
        yield path, (np.asarray(one, dtype=float), np.asarray(other, dtype=float))
    elif isinstance(other, dict):
        for name, value in other.items():
            yield from numbers_of(one[name], value, f"{path}.{name}")  # type: ignore[index]
    elif isinstance(other, tuple | list):
        for index, value in enumerate(other):
            yield from numbers_of(one[index], value, f"{path}.{index}")  # type: ignore[index]
    elif hasattr(other, "__dict__") and path.count(".") < 4:
        for name in getattr(other, "__dataclass_fields__", ()):
            yield from numbers_of(getattr(one, name), getattr(other, name), f"{path}.{name}")
