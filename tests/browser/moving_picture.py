"""The moving picture of the README: the end of the spall is dragged past two ball spacings.

    python -m tests.browser.moving_picture [FILE]

It opens the page as a person would, and photographs it after each step of the slider.
"""

import io
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from tests.browser.explorer_page import can_be_used, rest, slider
from tests.browser.helpers import ROOT, chromium, explorer_server, move, serving

FILE = ROOT / "assets" / "figures" / "explorer.webp"
EXTENTS = np.linspace(10.0, 58.0, 25)  # [deg]; a ball spacing of the fan rig is 25.7
STEP, HOLD = 180, 1600  # [ms] that a picture stands, and the first and last
MOST_BYTES = 1_500_000


def pictures() -> list[Image.Image]:
    """Return a photograph of the page for each extent."""
    frames = []
    with (
        serving(explorer_server()) as server,
        sync_playwright() as play,
        chromium(play, 1200, 675) as browser,
    ):
        page = browser.new_page()
        page.goto(server.url)
        can_be_used(page)
        page.get_by_role("button", name="Close this introduction").click()
        for extent in EXTENTS:
            move(slider(page, "extent_deg"), float(extent))
            rest(page)
            frames.append(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
    return frames


def main(file: Path) -> None:
    """Photograph the page and write the moving picture, there and back."""
    there = pictures()
    frames = [*there, *there[-2:0:-1]]
    times = [STEP] * len(frames)
    times[0] = times[len(there) - 1] = HOLD
    frames[0].save(
        file, save_all=True, append_images=frames[1:], duration=times, loop=0, quality=60, method=4
    )
    size = file.stat().st_size
    print(f"{file}: {len(frames)} pictures, {size / 1e6:.2f} MB")
    if size > MOST_BYTES:
        raise SystemExit("It is too large for the README.")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FILE)
