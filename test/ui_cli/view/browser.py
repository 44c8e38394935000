"""A headless Chromium, driven over its DevTools protocol."""

import base64
import json
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import websocket

_FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    "--disable-background-timer-throttling",
    "--disable-features=CalculateNativeWinOcclusion,Translate,MediaRouter",
    "--remote-debugging-port=0",
    "--remote-allow-origins=*",
]


def program() -> str | None:
    """The browser, or None where there is none."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


class Browser:
    """One page. Use it in a with statement: the browser ends with it."""

    def __init__(self, width: int = 1280, height: int = 800):
        self._size = (width, height)
        self._number = 0
        self.errors: list[str] = []  # what the page complained about
        self.addresses: list[str] = []  # whatever the page asked for

    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        size = "--window-size={},{}".format(*self._size)
        self._process = subprocess.Popen(
            [program(), *_FLAGS, size, f"--user-data-dir={self._folder.name}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        port = self._port()
        self._socket = websocket.create_connection(f"ws://127.0.0.1:{port[0]}{port[1]}", timeout=300)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        self.resize(*self._size)
        self.call("Page.bringToFront")
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()

    def _port(self) -> list[str]:
        file = Path(self._folder.name) / "DevToolsActivePort"
        for _ in range(600):
            if file.is_file() and len(lines := file.read_text().split()) == 2:
                return lines
            time.sleep(0.1)
        raise RuntimeError("the browser did not start")

    def call(self, method: str, **parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if hasattr(self, "_session"):
            message["sessionId"] = self._session
        self._socket.send(json.dumps(message))
        while True:
            answer = json.loads(self._socket.recv())
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self._note(answer)

    def _note(self, event: dict):
        parameters = event.get("params", {})
        if event.get("method") == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif event.get("method") == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(f"{parameters['entry']['text']} {parameters['entry'].get('url', '')}")
        elif event.get("method") == "Network.requestWillBeSent":
            self.addresses.append(parameters["request"]["url"])

    def resize(self, width: int, height: int):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def prefer(self, scheme: str):
        """scheme: light or dark."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def go(self, url: str):
        self.call("Page.navigate", url=url)

    def value(self, expression: str):
        """What an expression in the page gives."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait(self, expression: str, seconds: float = 180):
        """Waits until an expression is true."""
        end = time.monotonic() + seconds
        while not self.value(expression):
            if time.monotonic() > end:
                raise AssertionError(f"never came true: {expression}; errors of the page: {self.errors}")
            time.sleep(0.1)

    def click(self, selector: str, across: float = 0.5, down: float = 0.5):
        """Presses the mouse at a place of an element, given in shares of its size."""
        box = self.value(f"(r => [r.x, r.y, r.width, r.height])(document.querySelector({selector!r}).getBoundingClientRect())")
        at = {"x": box[0] + across * box[2], "y": box[1] + down * box[3], "button": "left", "clickCount": 1}
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, **at)

    def share(self, selector: str, condition: str) -> float:
        """The share of an element's pixels on the screen for which a condition on r, g and b holds."""
        box = self.value(f"(r => [r.x, r.y, r.width, r.height])(document.querySelector({selector!r}).getBoundingClientRect())")
        clip = dict(zip(("x", "y", "width", "height"), box), scale=1)
        picture = self.call("Page.captureScreenshot", format="png", clip=clip)["data"]
        return self.value(
            f"""(async () => {{
              const image = new Image();
              image.src = 'data:image/png;base64,{picture}';
              await image.decode();
              const canvas = new OffscreenCanvas(image.width, image.height), c = canvas.getContext('2d');
              c.drawImage(image, 0, 0);
              const bytes = c.getImageData(0, 0, image.width, image.height).data;
              let count = 0;
              for (let k = 0; k < bytes.length; k += 4) {{
                const r = bytes[k], g = bytes[k + 1], b = bytes[k + 2];
                if ({condition}) ++count;
              }}
              return (4 * count) / bytes.length;
            }})()"""
        )

    def screenshot(self) -> bytes:
        """A PNG of the page."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
