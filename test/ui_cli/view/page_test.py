"""The viewer's page in a real browser: looks at pixels, clicks. Usage: page_test.py FOLDER_OF_PROGRAMS

Skipped (77) where there is no Chromium, no python3-websocket, or no way to a network of its own."""

import atexit
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path


def skip(why: str):
    print(f"skipped: {why}")
    sys.exit(77)


try:
    import browser
except ImportError:
    skip("there is no python3-websocket; ./run test --page installs it")

BIN = Path(sys.argv[1])
IN_OWN_NETWORK = "MRROC_IN_OWN_NETWORK"
ORANGE = "r > 150 && g > 50 && g < 150 && b < 90"
BLUE = "b > 180 && r < 90"
GREEN = "g > 110 && r < 90 && b < 120"
AMBER = "r > 150 && r < 225 && g > 110 && g < 190 && b < 100"
INK = "r < 100 && g < 105 && b < 120"
DARK = "r < 50 && g < 55 && b < 65"


def enter_own_network():
    """Starts again where multicast works and nobody is disturbed."""
    if IN_OWN_NETWORK not in os.environ:
        if not shutil.which("unshare") or subprocess.run(["unshare", "-rn", "true"], capture_output=True).returncode:
            skip("no network namespaces")
        os.environ[IN_OWN_NETWORK] = "1"
        os.execvp("unshare", ["unshare", "-rn", sys.executable, "-B", *sys.argv])
    up = ["ip link set lo up", "ip route add 224.0.0.0/4 dev lo"]
    if any(subprocess.run(c.split(), capture_output=True).returncode for c in up):
        skip("cannot set up a network")


class Viewer:
    def __init__(self, *arguments: str):
        command = [BIN / "ui_cli", "view", *arguments]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        atexit.register(self._process.kill)  # also when the test fails
        line = self._process.stdout.readline()
        assert line.startswith("view: http://127.0.0.1:"), line
        self.url = line.removeprefix("view: ").strip()

    def end(self):
        self._process.terminate()
        assert self._process.wait(10) == 0, "Ctrl-C is no error"


def clock(page, key: str):
    return page.value(f"document.querySelector('#clock').dataset.{key}")


def check(condition, what: str):
    if not condition:
        raise AssertionError(what)
    print("ok:", what)


def loaded(page, rows: int):
    page.wait(f"Number(document.querySelector('#clock')?.dataset.rows) === {rows}")
    time.sleep(0.5)


def look_at_a_run(page, folder: Path):
    viewer = Viewer(str(folder))
    page.go(viewer.url)
    loaded(page, 1000)
    check(page.share("#stage", ORANGE) > 0.01, "the arms are drawn")
    check(page.share("#timeline", BLUE) > 0.02 and page.share("#timeline", "r > 180 && b < 110") > 0.02, "two behaviours have colours")
    check(page.share("#charts", BLUE) > 0.001, "the charts have curves")
    check(page.value("document.querySelector('#timeline').getAttribute('aria-valuemax')") == "10.00", "the time-line ends with the run")
    check(page.value("document.querySelector('#messages').innerText").find("operator: start") >= 0, "messages are told")
    check(page.value("document.querySelector('#sheets').hidden"), "there is no ink in the beginning")
    page.click("#timeline", 0.9, 0.4)
    page.wait("Number(document.querySelector('#clock').dataset.t) > 7")
    check(8 < float(clock(page, "t")) < 9.9, "a click on the time-line goes there")
    page.wait("!document.querySelector('#sheets').hidden")
    page.click("#sheets canvas")
    page.wait("document.querySelector('#sheets canvas').clientWidth === 300")
    check(page.share("#sheets canvas", INK) > 0.002, "the ink is on the sheet, and a click makes it larger")
    page.click("#sheets canvas")
    check(page.value("document.querySelector('#behaviour').innerText") == "m = 2 arm1 does: draw", "the behaviour has its name")
    play_and_pause(page)
    turn_the_cube(page)
    check(page.share("#charts", BLUE) > 0, "the charts show the arm")
    page.click("#arms button:nth-child(2)")
    page.wait("document.querySelector('#clock').dataset.arm === 'arm2'")
    check(page.value("document.querySelector('#clock').dataset.arm") == "arm2", "another arm can be chosen")
    orange = page.share("#stage", ORANGE)
    page.click("#views button:nth-child(2)")
    time.sleep(1.5)
    above = page.share("#stage", ORANGE)
    check(abs(above - orange) > 0.002, f"the cell can be seen from elsewhere {orange} {above}")
    page.prefer("dark")
    time.sleep(1)
    check(page.share("aside", DARK) > 0.5, "the page is dark where the system is")
    page.prefer("light")
    check(all(a.startswith((viewer.url, "data:", "about:")) for a in page.addresses), "nothing comes from outside")
    check(not page.errors, f"the page complains of nothing {page.errors}")
    viewer.end()
    page.wait("document.querySelector('#state').innerText === 'viewer has ended'")
    check(page.share("#stage", ORANGE) > 0.005, "what was shown stays when the viewer has ended")


def play_and_pause(page):
    page.click("#timeline", 0.3, 0.4)
    page.wait("Number(document.querySelector('#clock').dataset.t) < 5")
    begin = float(clock(page, "t"))
    page.click("#play")
    page.wait(f"Number(document.querySelector('#clock').dataset.t) > {begin + 0.5}")
    check(clock(page, "playing") == "true", "it plays")
    page.click("#play")
    page.wait("document.querySelector('#clock').dataset.playing === 'false'")
    held = clock(page, "t")
    time.sleep(0.7)
    check(clock(page, "t") == held, "it pauses")


def go_anew(page, url: str):
    """Goes to a viewer after one that has ended, which the page may still have looked for."""
    page.go("about:blank")
    page.errors.clear()
    page.go(url)


def follow_a_task(page, folder: Path):
    viewer = Viewer()
    go_anew(page, viewer.url)
    page.wait("document.querySelector('#empty')?.innerText.includes('./run')")
    check("No session" in page.value("document.querySelector('#empty').innerText"), "without a task it says how to start one")
    task = subprocess.Popen([BIN / "view_sample", "task", folder, "demo", "8"], stdout=subprocess.PIPE, text=True)
    page.wait("Number(document.querySelector('#clock').dataset.t) > 1")
    check(page.value("document.querySelector('#state').innerText") == "running", "a task that comes is followed")
    check(page.value("document.querySelector('#empty').hidden"), "the text gives way to the cell")
    page.wait("document.querySelector('#cameras img')?.naturalWidth === 320")
    check(page.share("#cameras img", "g > 100 && r < 40 && b < 40") > 0.2, "pictures of the camera come")
    # A picture that is being loaded has no size.
    page.wait("(i => Math.abs(i.clientWidth / i.clientHeight - i.naturalWidth / i.naturalHeight) < 0.05 && i.clientHeight >= 120)(document.querySelector('#cameras img'))")
    check(True, "a picture is shown whole, and not too small to be read")
    page.click("#play")
    page.wait("document.querySelector('#clock').dataset.live === 'false'")
    held, rows = clock(page, "t"), int(clock(page, "rows"))
    page.wait(f"Number(document.querySelector('#clock').dataset.rows) > {rows + 50} || document.querySelector('#state').innerText !== 'running'")
    check(clock(page, "t") == held, "the picture can stand while the task goes on")
    page.click("#live")
    page.wait("document.querySelector('#state').innerText === 'ended'")
    said = int(task.communicate()[0])
    loaded(page, said)
    check("lost" not in page.value("document.querySelector('#count').innerText"), "no message is lost")
    page.wait("Number(document.querySelector('#clock').dataset.t) > 7.9")
    check(page.value("document.querySelector('#clock').innerText").strip() == "8.00 s of 8.00 s", "it shows the end")
    check(not page.errors, f"the page complains of nothing {page.errors}")
    viewer.end()


def attach_late(page, folder: Path):
    task = subprocess.Popen([BIN / "view_sample", "task", folder, "late", "10"], stdout=subprocess.PIPE, text=True)
    time.sleep(4)
    viewer = Viewer()
    go_anew(page, viewer.url)
    page.wait("document.querySelector('#cameras img')?.naturalWidth === 320")
    check(page.share("#cameras img", "g > 100 && r < 40 && b < 40") > 0.2, "a viewer that comes late has pictures of the camera")
    task.communicate()
    check(not page.errors, f"the page complains of nothing {page.errors}")
    viewer.end()


def turn_the_cube(page):
    page.click("#timeline", 0.005, 0.4)
    page.wait("Number(document.querySelector('#clock').dataset.t) < 0.5")
    page.value("[...document.querySelectorAll('#views button')].find((b) => b.innerText === 'cube').click()")
    time.sleep(1)
    red, white = "r > 110 && g < 60 && b < 80", "r > 175 && g > 175 && b > 165"
    check(page.share("#stage", red) > 0.01 and page.share("#stage", white) > 0.01, "the cube has its colours")
    before = page.share("#stage", "g > 70 && r < 60 && b < 110"), page.share("#stage", DARK)
    page.click("#timeline", 0.995, 0.4)
    page.wait("Number(document.querySelector('#clock').dataset.t) > 9.5")
    time.sleep(1)
    after = page.share("#stage", "g > 70 && r < 60 && b < 110"), page.share("#stage", DARK)
    check(abs(after[0] - before[0]) + abs(after[1] - before[1]) > 0.002, f"its layers turn {before} {after}")
    page.click("#views button:first-child")
    time.sleep(0.5)


def start_beside_a_task(page):
    command = [BIN / "view_sample", "beside", "demo"]
    line = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True, timeout=30).stdout
    url = line.removeprefix("view: ").strip()
    check(url.startswith("http://127.0.0.1:"), "a task starts a viewer and goes on")
    page.go(url)
    page.wait("document.querySelector('#state')?.innerText === 'waiting for a task'")
    page.go("about:blank")
    end = time.monotonic() + 60
    while answers(url):
        assert time.monotonic() < end, "the viewer stays"
        time.sleep(0.5)
    check(True, "it ends when no task runs and nobody looks")


def press(page, view: str):
    page.value(f"[...document.querySelectorAll('#views button')].find(b => b.textContent === {view!r}).click()")


def look_at_a_wild_run(page, folder: Path):
    subprocess.run([BIN / "view_sample", "wild", folder], check=True)
    viewer = Viewer(str(folder))
    go_anew(page, viewer.url)
    page.wait("Number(document.querySelector('#clock')?.dataset.rows) > 100")
    for name in ("arm1", "rex"):
        page.value(f"[...document.querySelectorAll('#arms button')].find(b => b.textContent === {name!r}).click()")
        for view in ("cell", name, "top"):
            press(page, view)
        for place in (0.1, 0.5, 0.99):
            page.click("#timeline", place, 0.4)
            time.sleep(0.5)
    check("<img src=x" in page.value("document.querySelector('#messages').innerText"), "texts of a log are texts")
    check(page.value("document.querySelectorAll('#messages img, header img').length") == 0, "and no part of the page")
    check(page.value("document.title") != "bad", "nothing of a log is executed")
    check(not page.errors, f"the page bears any numbers {page.errors}")
    viewer.end()


def look_at_damaged_bytes(page, folder: Path):
    log = folder / "events.lcmlog"
    damaged = bytearray(log.read_bytes())
    chance = random.Random(5)
    for _ in range(len(damaged) // 2000):
        damaged[chance.randrange(len(damaged))] = chance.randrange(256)
    log.write_bytes(damaged)
    viewer = Viewer(str(folder))
    go_anew(page, viewer.url)
    page.wait("Number(document.querySelector('#clock')?.dataset.rows) > 10")
    press(page, "rex")
    page.click("#timeline", 0.5, 0.4)
    time.sleep(1)
    check(not page.errors, f"the page bears a damaged log {page.errors}")
    viewer.end()


def look_at_a_platform(page, folder: Path):
    if not (BIN / "rex_drive").exists():
        return print("left out: the platform Rex is not part of this build")
    plan = Path(folder.parent) / "plan.txt"
    plan.write_text("0 0\n0.6 0\n1.2 0.3\n")
    run = [BIN / "rex_drive", "--processes", "one", "--eyes", "off", "--plan", plan, "--run-dir", folder]
    subprocess.run(run, check=True, capture_output=True)
    viewer = Viewer(str(folder))
    go_anew(page, viewer.url)
    page.wait("Number(document.querySelector('#clock')?.dataset.rows) > 100")
    page.wait("[...document.querySelectorAll('#views button')].some(b => b.textContent === 'rex')")
    time.sleep(1)
    page.click("#timeline", 0.6, 0.4)
    time.sleep(1)
    room = page.share("#stage", ORANGE)
    check(room > 0.001, f"the platform is drawn {room}")
    check(page.share("#stage", GREEN) > 0.0002, "the points of its plan are drawn")
    check(page.share("#stage", AMBER) > 0.0002, "the fragments are drawn")
    check("of" in page.value("document.querySelector('#readout').innerText"), "which fragment it drives is told")
    check(not page.value("document.querySelector('#legend').hidden"), "the colours of the lines are told")
    check(page.value("document.querySelector('#sheets').hidden || !document.querySelector('#sheets').children.length"), "there are no sheets")
    charts = page.value("[...document.querySelectorAll('#charts .chart:not([hidden]) canvas')].map(c => c.title.split(' [')[0]).join()")
    check(charts == "Tracking error,Estimation error,Slip,Torque", f"the charts are those of a platform {charts}")
    check(page.share("#charts", BLUE) > 0.001, "the charts have its curves")
    hover = "const t = document.querySelector('#timeline'), b = t.getBoundingClientRect(); t.dispatchEvent(new PointerEvent('pointermove', {clientX: b.left + 0.5 * b.width, clientY: b.top + y})); return t.title.split(',')[0];"
    lanes = page.value(f"[...new Set(Array.from({{length: 200}}, (_, y) => {{ {hover} }}))].filter(name => name).join()")
    check(lanes == "rex,map,mp", f"the time-line has a lane for each agent {lanes}")
    check("rex" in page.value("document.querySelector('#readout').innerText"), "its place is told")
    press(page, "rex")
    time.sleep(1.5)
    near = page.share("#stage", ORANGE)
    check(near > 1.5 * room, f"it can be looked at from near {room} {near}")
    page.click("#timeline", 0.3, 0.4)
    time.sleep(1.5)
    followed = page.share("#stage", ORANGE)
    check(abs(followed - near) < 0.4 * near, f"the view goes with it {near} {followed}")
    check(not page.errors, f"the page complains of nothing {page.errors}")
    viewer.end()
    look_at_damaged_bytes(page, folder)


def answers(url: str) -> bool:
    try:
        return urllib.request.urlopen(url, timeout=5).status == 200
    except OSError:
        return False


def main():
    if browser.program() is None:
        skip("there is no Chromium; ./run test --page installs it")
    enter_own_network()
    with tempfile.TemporaryDirectory() as home, browser.Browser(1280, 800) as page:
        os.environ["XDG_RUNTIME_DIR"] = home
        run = Path(home) / "run"
        subprocess.run([BIN / "view_sample", "run", run], check=True)
        look_at_a_run(page, run)
        follow_a_task(page, Path(home) / "live")
        attach_late(page, Path(home) / "late")
        start_beside_a_task(page)
        look_at_a_wild_run(page, Path(home) / "wild")
        look_at_a_platform(page, Path(home) / "drive")


main()
