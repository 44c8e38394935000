#!/usr/bin/python3
"""Makes a film strip of a run, as the viewer shows it: docs/pictures/*_strip.png. Needs Chromium and python3-websocket.

Usage: film_strip.py PROGRAMS RUN PICTURE VIEW SHARE...
PROGRAMS  folder of ui_cli, build/release/bin
VIEW      a button of the page: cell or room, top, an arm such as arm1, a platform such as rex, or cube, which is followed
SHARE     instants as shares of the run, each a picture of the strip: 0.1 0.4 0.7 0.95"""

import base64
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/ui_cli/view"))
sys.dont_write_bytecode = True
try:
    import browser  # noqa: E402
except ImportError as missing:
    sys.exit(
        f"error: {sys.executable} has no module {missing.name}; type "
        "apt-get install chromium python3-websocket, and start this with /usr/bin/python3"
    )
if not browser.program():
    sys.exit("error: there is no Chromium; type apt-get install chromium")

WIDTH, HEIGHT = 330, 300  # of one picture
ONLY_THE_CELL = """
for (const e of document.querySelectorAll('aside, #readout, #views, #sheets, #legend')) e.style.display = 'none';
document.querySelector('main').style.display = 'block';
for (const e of document.querySelectorAll('#stage, #cell')) { e.style.width = '100%'; e.style.height = '100%'; }
document.querySelector('#stage').style.height = '600px';
"""
MARGINS = 64, 14  # of the time-line, left and right

COMPOSE = """(async () => {
  const pictures = %s, width = %d, height = %d, gap = 6;
  const canvas = document.createElement('canvas');
  canvas.width = pictures.length * (width + gap) - gap;
  canvas.height = height + 24;
  const c = canvas.getContext('2d');
  c.fillStyle = 'white'; c.fillRect(0, 0, canvas.width, canvas.height);
  c.fillStyle = '#333'; c.font = '13px sans-serif'; c.textAlign = 'center';
  for (let k = 0; k < pictures.length; ++k) {
    const image = new Image();
    image.src = 'data:image/png;base64,' + pictures[k][0];
    await image.decode();
    const scale = Math.max(width / image.width, height / image.height), w = width / scale, h = height / scale;
    c.drawImage(image, (image.width - w) / 2, (image.height - h) / 2, w, h, k * (width + gap), 0, width, height);
    c.fillText(pictures[k][1], k * (width + gap) + width / 2, height + 17);
  }
  // Fewer shades of each colour: a third of the size, and nobody sees it.
  const data = c.getImageData(0, 0, canvas.width, canvas.height);
  for (let k = 0; k < data.data.length; ++k) data.data[k] = Math.min(255, 8 * Math.round(data.data[k] / 8));
  c.putImageData(data, 0, 0);
  return canvas.toDataURL('image/png').split(',')[1];
})()"""


def picture(page) -> str:
    box = page.value("(r => [r.x, r.y, r.width, r.height])(document.querySelector('#stage').getBoundingClientRect())")
    clip = dict(zip(("x", "y", "width", "height"), box), scale=1)
    return page.call("Page.captureScreenshot", format="png", clip=clip)["data"]


def look(page, view: str):
    page.value(f"[...document.querySelectorAll('#views button')].find(b => b.textContent === {view!r}).click()")


def instant(page, share: float, view: str):
    """Goes there, and looks from there: the cube moves. Gives the instant and the behaviour, as the page tells them."""
    width = page.value("document.querySelector('#timeline').clientWidth")
    page.click("#timeline", (MARGINS[0] + share * (width - sum(MARGINS))) / width)
    time.sleep(1.5)
    look(page, view)
    time.sleep(0.5)
    taken = picture(page)  # before the words: they change with the frame
    shown = page.value("[document.querySelector('#clock').textContent, document.querySelector('#behaviour').textContent]")
    return taken, f"{shown[0].split(' of ')[0].strip()}   {shown[1]}".strip()


def main():
    programs, run, target, view, *shares = sys.argv[1:]
    viewer = subprocess.Popen([Path(programs) / "ui_cli", "view", run], stdout=subprocess.PIPE, text=True)
    try:
        address = viewer.stdout.readline().removeprefix("view: ").strip()
        with browser.Browser(2 * WIDTH, 2 * HEIGHT + 190) as page:
            page.prefer("light")
            page.go(address)
            page.wait("Number(document.querySelector('#clock')?.dataset.rows) > 0")
            time.sleep(3)
            page.value(ONLY_THE_CELL)
            time.sleep(1)
            taken = [list(instant(page, float(s), view)) for s in shares]
            page.go("about:blank")
            time.sleep(0.5)
            Path(target).write_bytes(base64.b64decode(page.value(COMPOSE % (taken, WIDTH, HEIGHT))))
    finally:
        viewer.terminate()


if __name__ == "__main__":
    main()
