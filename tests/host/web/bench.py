"""The real daemon and a simulated printer in a folder of their own, and a Chromium that shows their page.

Nothing here waits for a fixed time: `until` looks again and again until something is so, or fails at its deadline.
UNICURSAL_PROGRAM names the program. See tests/README.md.
"""

import http.client
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

try:
    from selenium import webdriver
except ImportError:
    sys.exit("selenium is missing: host/install-packages --with-tests installs it, and chromium")
from selenium.common.exceptions import WebDriverException
from selenium.webdriver import ActionChains
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

HERE = pathlib.Path(__file__).resolve().parent
SOURCES = HERE.parents[2]
PROGRAM = os.environ.get("UNICURSAL_PROGRAM") or next(
    (str(found) for found in sorted(SOURCES.glob("build/*/host/unicursal"))), "unicursal")
PATIENCE = 30  # s; generous, for a computer that does other things as well
PHONE, DESK = (390, 844), (1280, 800)

PROFILE = """[printer]
name = "Test bench"
firmware = "marlin"
baud = 115200
bed = [120.0, 100.0, 80.0]
nozzle = 0.6
bead_width_range = [0.4, 1.2]
[extruder]
feeders = 3
max_flow = 5.0
[temperature]
nozzle = 210
bed = 60
[[filament]]
name = "blue PLA"
colour = "#2660c4"
[[filament]]
name = "red PLA"
colour = "#d63430"
[[filament]]
name = "white PLA"
colour = "#f6f0e2"
"""
JOB = """printer = "bench.profile"
[part]
file = "plate.svg"
height = 20.0
layer_height = 0.2
bead_width = 1.0
flow = 3.0
[[zone]]
select = "#0000ff"
pattern = "isotropic"
mixture = "sea"
[[zone]]
select = "#ff0000"
pattern = "isotropic"
mixture = "sun"
[mixture]
sea = [0.8, 0.0, 0.2]
sun = [0.0, 0.8, 0.2]
"""
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="16mm" viewBox="0 0 20 16">
<rect x="0" y="0" width="20" height="16" fill="#0000ff"/><rect x="12" y="0" width="8" height="16" fill="#ff0000"/></svg>
"""


def until(so, what, patience=PATIENCE):
    """The first true value of `so`."""
    end = time.monotonic() + patience
    while True:
        value = so()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {patience} s in vain until {what}")
        time.sleep(0.04)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Bench:
    """A folder with a job, a daemon, and perhaps a printer."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="unicursal-web-"))
        self.printer = self.daemon = None
        self.port = free_port()
        (self.folder / "jobs").mkdir()
        self.write("jobs/bench.profile", PROFILE)
        self.write("jobs/plate.toml", JOB)
        self.write("jobs/plate.svg", DRAWING)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in (self.daemon, self.printer):
            end(process)
        shutil.rmtree(self.folder, ignore_errors=True)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def run(self, *words):
        environment = dict(os.environ, XDG_STATE_HOME=str(self.folder / "home"))
        with open(self.folder / f"{words[0]}.log", "ab") as errors:
            return subprocess.Popen([PROGRAM, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                    stderr=errors, env=environment, text=True)

    def start_printer(self, speed=100, *more):
        """`speed`: printer seconds per second."""
        link = self.folder / "port"
        self.printer = self.run("simulate", "--profile", self.folder / "jobs/bench.profile", "--link", link, "--speed",
                                speed, *more)
        until(link.exists, "the simulated printer has its port")

    def stop_printer(self):
        end(self.printer)
        self.printer = None

    def serve(self, *more):
        self.daemon = self.run("serve", "--listen", f"127.0.0.1:{self.port}", "--state", self.folder / "state", "--spool",
                               self.folder / "spool", "--port", self.folder / "port", "--jobs", self.folder / "jobs",
                               "--profile", self.folder / "jobs/bench.profile", *more)
        line = self.daemon.stdout.readline()
        assert line, (self.folder / "serve.log").read_text()
        self.token = (self.folder / "state/token").read_text().strip()

    def kill_daemon(self):
        end(self.daemon)

    def signal(self, number):
        self.daemon.send_signal(number)

    def address(self, port=None):
        return f"http://127.0.0.1:{port or self.port}/#token={self.token}"

    def ask(self, method, path, body=None):
        """The answer as JSON; None if it is not."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        headers = {"Authorization": f"Bearer {self.token}", "Content-Type": "application/json"}
        connection.request(method, path, None if body is None else json.dumps(body), headers)
        answer = connection.getresponse().read()
        connection.close()
        try:
            return json.loads(answer)
        except ValueError:
            return answer

    def state(self):
        status = self.ask("GET", "/api/status")
        return status.get("print", {}).get("state") or status["state"]

    def until_state(self, *states):
        until(lambda: self.state() in states, f"the print is {' or '.join(states)}")

    def queue(self, job="plate.toml", layers=None):
        body = {"job": job} if layers is None else {"job": job, "layers": layers}
        answer = self.ask("POST", "/api/jobs", body)
        assert "id" in answer, answer
        return answer["id"]

    def start(self, job="plate.toml", layers=None):
        """Queues a job and lays its first beads."""
        number = self.queue(job, layers)
        self.ask("POST", "/api/print/start", {"id": number})
        self.until_state("printing")
        return number


def end(process):
    if process is None or process.poll() is not None:
        return
    process.send_signal(signal.SIGCONT)
    process.kill()
    process.wait()
    process.stdout.close()


class Browser:
    """One Chromium. Its pages are emulated in the size and theme that a test asks for."""

    FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
             "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
             "--disable-dev-shm-usage", "--hide-scrollbars", "--mute-audio", "--renderer-process-limit=1"]

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="unicursal-chromium-")
        options = Options()
        options.binary_location = shutil.which("chromium") or "chromium"
        for flag in [*self.FLAGS, f"--user-data-dir={self.folder}"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver") or "chromedriver"), options=options)
        self.driver.set_script_timeout(PATIENCE)
        self.view()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.driver.quit()
        except WebDriverException:
            pass
        shutil.rmtree(self.folder, ignore_errors=True)

    def cdp(self, command, **parameters):
        return self.driver.execute_cdp_cmd(command, parameters)

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def view(self, size=PHONE, dark=False):
        self.cdp("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1,
                 mobile=size[0] < 600)
        features = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                    {"name": "prefers-reduced-motion", "value": "reduce"}]
        self.cdp("Emulation.setEmulatedMedia", media="screen", features=features)

    def open(self, bench, page="print", port=None, language="en"):
        """Comes with the token in the address, as `serve` prints it, and waits for the connection."""
        self.driver.get("about:blank")
        self.driver.get(bench.address(port))
        self.until_up()
        self.speak(language)
        self.go(page)

    def speak(self, language):
        if self.js("return localStorage.getItem('language')") != language:
            self.js("localStorage.setItem('language', arguments[0])", language)
            self.driver.refresh()
            self.until_up()

    def link(self):
        return self.js("return document.body.dataset.link")

    def until_up(self, patience=PATIENCE):
        until(lambda: self.link() == "up", "the page is connected", patience)

    def go(self, page):
        self.js("location.hash = '#/' + arguments[0]", page)
        until(lambda: self.js("return document.body.dataset.page") == page, f"the page {page} is shown")
        self.settled()

    def settled(self):
        """Nothing has changed in the page for six frames."""
        self.driver.execute_async_script("""
          const done = arguments[0], end = performance.now() + 1500;
          let quiet = 0;
          const watch = new MutationObserver(() => { quiet = 0; });
          watch.observe(document.body, {subtree: true, childList: true, attributes: true, characterData: true});
          const frame = () => {
            if (++quiet < 6 && performance.now() < end) return requestAnimationFrame(frame);
            watch.disconnect();
            done();
          };
          requestAnimationFrame(frame);""")

    def text(self, selector="body"):
        return self.js("return document.querySelector(arguments[0])?.innerText ?? ''", selector)

    def find(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def button(self, name):
        """The visible button or link whose accessible name begins so."""
        return self.js("""
          const name = (one) => (one.getAttribute('aria-label') ?? one.innerText).trim();
          return [...document.querySelectorAll('button, a[href], [role=button]')]
            .find((one) => one.checkVisibility() && name(one).startsWith(arguments[0])) ?? null;""", name)

    def press(self, name):
        """Waits until the button can be pressed."""
        def ready():
            found = self.button(name)
            return found if found is not None and found.is_enabled() else None
        until(ready, f"the button {name} can be pressed").click()

    def key(self, *keys):
        for one in keys:
            ActionChains(self.driver, duration=0).send_keys(one).perform()

    def tab_to(self, name, most=120):
        """With the keyboard alone, until what has the focus is called so."""
        for _ in range(most):
            if self.js("""
              const one = document.activeElement;
              const label = one.labels?.[0]?.innerText;
              return (one.getAttribute('aria-label') ?? label ?? one.innerText ?? '').trim().startsWith(arguments[0]);""", name):
                return
            self.key(Keys.TAB)
        raise AssertionError(f"{most} presses of Tab do not lead to {name}")

    def errors(self, but=()):
        """What the console has complained about since the last call, without the sources in `but`."""
        return [f"{entry['source']}: {entry['message'][:400]}" for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING") and entry["source"] not in but]

    def picture(self, file, whole=True):
        import base64
        parameters = {"captureBeyondViewport": whole}
        if whole:
            size = self.cdp("Page.getLayoutMetrics")["cssContentSize"]
            parameters["clip"] = {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}
        pathlib.Path(file).write_bytes(base64.b64decode(self.cdp("Page.captureScreenshot", **parameters)["data"]))
