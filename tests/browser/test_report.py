"""Report in the browser: no console errors, no blank picture, and a heart that rotates and beats."""

from io import BytesIO

import numpy as np
import pytest
from matplotlib.image import imread
from playwright.sync_api import Locator

from tests.browser.conftest import SCREEN, Opened

pytestmark = pytest.mark.long
VISIBLE = 8.0
"""Standard deviation of the brightness, of 255, from which a picture shows something."""
BLANK = """async (image) => {
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: 300, height: 200 });
  const brush = canvas.getContext("2d");
  brush.fillStyle = "#fff";
  brush.fillRect(0, 0, 300, 200);
  brush.drawImage(image, 0, 0, 300, 200);
  const light = brush.getImageData(0, 0, 300, 200).data.filter((_, i) => i % 4 === 1);
  const mean = light.reduce((sum, each) => sum + each, 0) / light.length;
  return Math.sqrt(light.reduce((sum, each) => sum + (each - mean) ** 2, 0) / light.length);
}"""
WIDE = """() => [...document.querySelectorAll("main *")].filter((each) =>
  !each.closest(".scroll, pre, .js-plotly-plot") && each.getBoundingClientRect().right > innerWidth + 1
).map((each) => each.outerHTML.slice(0, 80))"""


@pytest.fixture
def heart(opened: Opened) -> Locator:
    """The first case's viewer, drawn."""
    viewer = opened.page.locator(".heart").first
    viewer.scroll_into_view_if_needed()
    opened.page.locator(".heart.drawn").first.wait_for(timeout=60_000)
    return viewer


def pixels(scene: Locator) -> np.ndarray:
    """Brightness (rows, columns) of the screen."""
    return 255.0 * np.asarray(imread(BytesIO(scene.screenshot()), "png"))[..., :3].mean(axis=2)


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """Share of the pixels that changed."""
    return float((np.abs(before - after) > VISIBLE).mean())


def test_the_report_opens_without_console_errors_or_network_requests(opened: Opened, heart: Locator) -> None:
    assert opened.errors == []
    assert opened.requests == [opened.page.url]


def test_no_picture_is_blank(opened: Opened) -> None:
    spread = [image.evaluate(BLANK) for image in opened.page.locator("main img").all()]
    assert len(spread) > 5
    assert min(spread) > VISIBLE


def test_no_element_is_wider_than_the_screen(opened: Opened) -> None:
    assert opened.page.evaluate(WIDE) == []
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= SCREEN["width"]


@pytest.mark.parametrize("side", [0, 1])
def test_the_ventricles_are_drawn_turn_and_beat(heart: Locator, side: int) -> None:
    scene, slider = heart.locator(".scene").nth(side), heart.locator(".time")
    first = pixels(scene)
    heart.get_by_role("button", name="the left").click()
    turned = pixels(scene)
    slider.fill(str(int(slider.get_attribute("max") or 0) // 2))
    later = pixels(scene)
    slider.fill("0")
    heart.get_by_role("button", name="the front").click()
    assert first.std() > VISIBLE
    assert changed(first, turned) > 0.02
    assert changed(turned, later) > 0.01
    assert changed(first, pixels(scene)) < 0.001, "back where it was"


def test_both_views_rotate_with_the_pointer(opened: Opened, heart: Locator) -> None:
    left, right = (heart.locator(".scene").nth(side) for side in (0, 1))
    before = pixels(right)
    box = left.bounding_box() or {}
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    opened.page.mouse.move(x, y)
    opened.page.mouse.down()
    opened.page.mouse.move(x + 80, y + 10, steps=4)
    opened.page.mouse.up()
    opened.page.wait_for_timeout(500)
    assert changed(before, pixels(right)) > 0.02
    eyes = [
        scene.evaluate("(each) => Object.values(each.layout.scene.camera.eye)") for scene in (left, right)
    ]
    assert eyes[0] == pytest.approx(eyes[1])
    heart.get_by_role("button", name="the front").click()


@pytest.mark.parametrize("shade", ["activation", "distance", "strain", "segment"])
def test_every_colour_is_shown_with_its_scale(heart: Locator, shade: str) -> None:
    heart.locator(".time").fill("3")
    heart.locator(".shade").select_option(shade)
    heart.page.wait_for_timeout(300)
    assert pixels(heart.locator(".scene").nth(1)).std() > VISIBLE
    assert heart.locator(".high").inner_text() != heart.locator(".low").inner_text()
    heart.locator(".time").fill("0")
    heart.locator(".shade").select_option("activation")


def test_the_inside_is_visible_through_the_outside(heart: Locator) -> None:
    scene, box = heart.locator(".scene").first, heart.locator(".through")
    closed = pixels(scene)
    box.check()
    heart.page.wait_for_timeout(300)
    assert changed(closed, pixels(scene)) > 0.02
    box.uncheck()


def test_playing_moves_the_cursor_of_the_curves(opened: Opened, heart: Locator) -> None:
    mark = opened.page.locator(".traced .line").first
    still = mark.evaluate("(each) => each.style.left")
    play = heart.get_by_role("button", name="Play")
    play.click()
    opened.page.wait_for_function(
        "(still) => document.querySelector('.traced .line').style.left !== still", arg=still
    )
    heart.get_by_role("button", name="Pause").click()
    assert play.is_visible()
    heart.locator(".time").fill("0")


def test_playing_starts_where_a_frame_is_older_than_the_click(opened: Opened, heart: Locator) -> None:
    """Frames carry the time at which they began, which may lie before the clock at the click."""
    ahead = "performance.now = ((now) => () => now() + 500)(performance.now.bind(performance))"
    opened.page.evaluate(ahead)
    heart.get_by_role("button", name="Play").click()
    opened.page.wait_for_timeout(300)
    heart.get_by_role("button", name="Pause").click()
    opened.page.evaluate("delete performance.now")
    assert opened.errors == []
    heart.locator(".time").fill("0")


def test_pictures_out_of_sight_release_their_context_and_are_redrawn(opened: Opened, heart: Locator) -> None:
    opened.page.locator("#provenance").scroll_into_view_if_needed()
    opened.page.wait_for_function("() => !document.querySelector('.heart').classList.contains('drawn')")
    heart.scroll_into_view_if_needed()
    opened.page.locator(".heart.drawn").first.wait_for()
    opened.page.wait_for_timeout(300)
    assert pixels(heart.locator(".scene").first).std() > VISIBLE


def test_the_report_prints(opened: Opened) -> None:
    assert len(opened.page.pdf()) > 100_000


def test_the_page_has_no_console_errors(opened: Opened) -> None:
    assert opened.errors == []
    assert opened.requests == [opened.page.url]
