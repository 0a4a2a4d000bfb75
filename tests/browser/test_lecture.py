"""What a lecture needs: slow motion with sound, enlarged figures, projector, exports."""

from __future__ import annotations

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.explorer_page import rest, slider, source
from tests.browser.helpers import Server, Watch

SOUNDS = """
window.sounds = []
const start = AudioBufferSourceNode.prototype.start
AudioBufferSourceNode.prototype.start = function (when, from) {
  const { buffer, loop } = this, rate = this.playbackRate.value
  window.sounds.push({ rate, from, loop, seconds: buffer.duration,
    peak: Math.max(...buffer.getChannelData(0).map(Math.abs)) })
  start.call(this, when, from)
}
"""


def open_tab(page: Page, server: Server, tab: str, more: str = "") -> None:
    """A tab of the default scene, or of one by more of the link, drawn finely."""
    page.goto(f"{server.url}?v=1&tab={tab}{more}")
    page.wait_for_function(f"window.__tab == '{tab}'")
    rest(page)


def test_a_ball_crosses_the_defect_slowly_and_is_heard(
    watch: tuple[Page, Watch], explorer: Server
) -> None:
    page, _ = watch
    page.add_init_script(SOUNDS)
    open_tab(page, explorer, "vibration")
    view = page.locator(".view-slow-passage")
    instant = view.get_by_role("slider", name="Instant")
    frames, start = source(page, "slow_frames"), source(page, "slow_start")
    n = len(start["angle"])
    loads = np.reshape(source(page, "slow_path")["load"], (-1, n))

    def shown() -> int:
        """The frame that the figures show."""
        at = int(instant.input_value())
        assert source(page, "slow_cursor")["now"][0] == pytest.approx(frames["time"][at], abs=1e-8)
        balls = source(page, "slow_balls")
        np.testing.assert_allclose(balls["load"], loads[at], rtol=1e-6, atol=1e-6)
        angles = np.arctan2(balls["y"], balls["x"]) - start["angle"] - frames["turned"][at]
        np.testing.assert_allclose(np.exp(1j * angles), 1.0, atol=1e-6)
        return at

    first = shown()
    assert abs(frames["time"][first]) < 2e-4  # a ball enters
    instant.press("ArrowRight")
    instant.press("ArrowRight")
    instant.press("ArrowLeft")
    assert shown() == first + 1
    play = view.get_by_role("button", name="Play")
    play.press("ArrowRight")
    assert shown() == first + 2
    play.click()
    page.wait_for_function("before => Bokeh.documents[0].get_model_by_name('slow_cursor')"
                           ".data.now[0] > before", arg=frames["time"][first + 2])  # fmt: skip
    assert page.evaluate("sounds") == []  # it is off
    view.get_by_role("combobox", name="Speed").select_option("1/10")
    view.get_by_role("slider", name="Volume").fill("40")
    heard = page.evaluate("sounds")[-1]
    assert heard["loop"]
    assert heard["peak"] == pytest.approx(1.0)
    length = frames["time"][-1] - frames["time"][0]
    assert heard["seconds"] / heard["rate"] == pytest.approx(10.0 * length, rel=1e-3)
    view.get_by_role("combobox", name="Speed").select_option("1/1000")
    expect(view.get_by_text("too low to hear")).to_be_visible()
    view.get_by_role("button", name="Pause").click()
    play.press("ArrowLeft")  # to a whole frame
    shown()
    # another defect: its motion is there as soon as it is drawn
    slider(page, "extent_deg").press("PageUp")
    rest(page)
    after = source(page, "slow_path")
    assert np.abs(np.reshape(after["load"], (-1, n)) - loads).max() > 1.0
    loads = np.reshape(after["load"], (-1, n))
    frames, start = source(page, "slow_frames"), source(page, "slow_start")
    shown()
