"""The first minute: what stands on the first screen, what moves, and no nonsense in words."""

from typing import Any

from playwright.sync_api import Page, expect

from tests.browser.explorer_page import SEEN, number, rest, settle, slider, value
from tests.browser.helpers import Server

#: words and type sizes outside of figures, words and sizes in figures, and controls
COUNTS = """() => {
  const counts = { words: [], drawn: [], sizes: {}, controls: [] }
  const size = (px, of) => { (counts.sizes[px] ??= []).push(of.slice(0, 30)) }
  const words_of = (text) => text?.match(/[\\p{L}\\p{N}.,−–]*\\p{L}[\\p{L}\\p{N}.,−–]*/gu) ?? []
  const add = (text, element) => {
    counts.words.push(...words_of(text))
    const { fontSize } = getComputedStyle(element)
    if (words_of(text).length) size(parseFloat(fontSize) * element.currentCSSZoom, text)
  }
  const clipped = (element) => {
    for (let at = element; at; at = at.parentElement ?? at.getRootNode().host)
      if (getComputedStyle(at).clipPath !== "none") return true
  }
  for (const element of deep(document.body)) {
    if (element.matches("script, style, option, optgroup, template") || !seen(element)) continue
    if (clipped(element)) continue
    if (element.matches("button, input, select, textarea, a[href], summary"))
      counts.controls.push(element.id || element.getAttribute("aria-label") || element.textContent)
    if (element.matches("select")) add(element.selectedOptions[0]?.textContent ?? "", element)
    for (const node of element.childNodes)
      if (node.nodeType === Node.TEXT_NODE) add(node.textContent, element)
  }
  for (const { model, el } of Bokeh.index.query((view) => view.model.type === "Figure")) {
    if (!seen(el)) continue
    for (const axis of [...model.left, ...model.below]) {
      if (!axis.visible || !axis.axis_label) continue
      counts.drawn.push(...words_of(axis.axis_label))
      for (const name of ["axis_label", "major_label"])
        size(parseFloat(axis[`${name}_text_font_size`]), axis.axis_label)
    }
    for (const { glyph, data_source } of model.renderers) {
      if (glyph?.type !== "Text") continue
      const { expr, field, value } = glyph.text
      const texts = [...(expr?.v_compute(data_source) ?? data_source.data[field] ?? [value])]
      counts.drawn.push(...texts.flatMap(words_of))
      size(parseFloat(glyph.text_font_size.value ?? glyph.text_font_size), texts.join(" "))
    }
  }
  return counts
}"""


_SAMPLE = (
    SEEN
    + """
window.__nonsense = new Set()
window.__samples = 0
setInterval(() => {
  if (!document.body) return
  window.__samples++
  for (const element of deep(document.body)) {
    if (element.matches("script, style, pre")) continue
    for (const node of element.childNodes)
      if (node.nodeType === Node.TEXT_NODE && /\\b(undefined|NaN|null)\\b/.test(node.textContent))
        window.__nonsense.add(node.textContent)
  }
}, 100)
"""
)


def samples(page: Page, server: Server) -> list[str]:
    """Look for nonsense in the text of the page, ten times a second until it rests."""
    page.add_init_script(_SAMPLE)
    page.goto(server.url)
    page.wait_for_function("window.__samples >= 3")
    rest(page)
    return list(page.evaluate("[...window.__nonsense]"))


def test_the_first_screen_is_seen_at_a_glance_and_a_figure_is_near_its_top(
    page: Page, explorer: Server
) -> None:
    page.set_viewport_size({"width": 1440, "height": 900})
    page.goto(explorer.url + "liveness")  # of the same origin, and quickly there
    page.evaluate("localStorage.clear()")
    assert samples(page, explorer) == []
    counts: dict[str, Any] = page.evaluate(COUNTS)
    assert len(counts["controls"]) <= 30, counts["controls"]
    assert len(counts["words"]) <= 120, counts["words"]
    sizes = sorted(float(size) for size in counts["sizes"])
    assert len(sizes) <= 4, counts["sizes"]
    assert sizes[0] >= 11.0, counts["sizes"]
    expect(page.get_by_text("Bearing explorer", exact=True).first).to_be_visible()
    expect(page.get_by_role("region", name="Introduction")).to_be_visible()
    for width in (768, 1199):
        page.set_viewport_size({"width": width, "height": 900})
        rest(page)
        top = page.locator("main canvas").first.evaluate("one => one.getBoundingClientRect().top")
        assert top <= 450.0, width
    # the nonsense that is looked for is seen
    page.evaluate("document.querySelector('footer').append(String(undefined))")
    page.wait_for_function("window.__nonsense.size === 1")


# --- it moves -------------------------------------------------------------------------------------


def test_the_bearing_keeps_turning_after_a_change(page: Page, explorer: Server) -> None:
    page.emulate_media(reduced_motion="no-preference")
    page.goto(explorer.url)
    undo = page.locator("#undo")  # hidden while there is nothing to undo
    turns = "document.querySelector('main').getAttribute('aria-busy') === 'true'"

    def turns_on() -> None:
        page.wait_for_function(turns)
        now = value(page, "cage_angle_deg")
        page.wait_for_function(
            "mark => (window.__mark || 0) > mark",
            arg=page.evaluate("window.__mark || 0") + 5,
        )
        assert value(page, "cage_angle_deg") != now

    turns_on()
    expect(undo).to_be_disabled()
    page.mouse.click(5, 300)
    page.wait_for_function(f"!({turns})")  # what a hand does is seen at rest, and read out
    turns_on()
    expect(undo).to_be_disabled()
    extent = value(page, "extent_deg")
    page.get_by_role("button", name="Make the defect longer").click()
    expect(undo).to_be_enabled()
    turns_on()
    assert value(page, "extent_deg") > extent + 10.0
    page.get_by_role("button", name="Stop turning").click()
    settle(page)
    stopped = value(page, "cage_angle_deg")
    page.wait_for_timeout(300)
    assert value(page, "cage_angle_deg") == stopped


# --- controls that are folded ---------------------------------------------------------------------


def test_what_is_folded_and_changed_is_counted(page: Page, explorer: Server) -> None:
    page.goto(f"{explorer.url}?v=1&preset=fan-rig&center_deg=250&edge=exact&tab=load")
    page.wait_for_function("window.__frames >= 1")
    more = page.locator("aside .more")
    expect(more).to_have_text("All settings (2 changed)")
    expect(slider(page, "center_deg")).to_be_hidden()
    more.press("Enter")
    expect(slider(page, "center_deg")).to_be_visible()
    number(page, "center_deg").fill("270")
    number(page, "center_deg").press("Enter")
    expect(more).to_have_text("All settings (1 changed)")
    # a value that is typed back is no error any more
    refusal = page.locator(".control-extent_deg .refusal")
    field = number(page, "extent_deg")
    field.fill("999")
    field.press("Enter")
    expect(refusal).to_contain_text("0 to 360")
    field.fill("12.9")
    expect(refusal).to_be_hidden()
