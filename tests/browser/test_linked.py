"""What belongs together lights up together."""

from playwright.sync_api import Page

from tests.browser.visitor import Visitor

LIT = """name => {
  const { data, inspected } = Bokeh.documents[0].get_model_by_name(name)
  return [...inspected.indices].map((i) => Math.abs(data.element[i]))
}"""


def test_a_ball_that_is_named_or_pointed_at_lights_up_everywhere(desk: Visitor) -> None:
    desk.begin("Load")
    page: Page = desk.page
    page.locator(".view-bearing .sentence p").hover()
    balls = page.evaluate(LIT, "bearing_balls")
    assert balls == page.evaluate(LIT, "load_distribution_balls") == [11, 12]
    page.locator(".view-bearing h2").hover()
    assert page.evaluate(LIT, "bearing_balls") == []
