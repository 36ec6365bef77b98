#!/usr/bin/python3
"""The keyboard alone: a job is queued, started, paused, resumed, cancelled, started again and stopped."""

import unittest

from bench import DESK, PHONE, Bench, Browser, Keys, until


# Whether a connection was lost meanwhile, as a slow computer makes it: then commands were off, and the focus is elsewhere.
WATCH_LINK = """
window.wasLost = false;
new MutationObserver(() => { if (document.body.dataset.link !== 'up') window.wasLost = true; })
  .observe(document.body, {attributes: true, attributeFilter: ['data-link']});
"""


def has_focus(browser, name):
    return browser.js("return document.activeElement.innerText.trim()") == name


class Keyboard(unittest.TestCase):
    def use(self, size):
        with Bench() as bench, Browser() as browser:
            bench.start_printer(60)
            bench.serve()
            browser.view(size)
            browser.open(bench)
            browser.js(WATCH_LINK)
            browser.tab_to("Queue")
            browser.key(Keys.ENTER)
            until(lambda: browser.js("return document.body.dataset.page") == "queue", "the queue is shown")
            browser.tab_to("Job or model")
            for _ in range(10):
                if browser.js("return document.activeElement.value") == "plate.toml":
                    break
                browser.key(Keys.ARROW_DOWN)
            browser.tab_to("Layers")
            browser.key("1-90")
            browser.tab_to("Add to the queue")
            browser.key(Keys.ENTER)
            until(lambda: bench.ask("GET", "/api/jobs")["jobs"], "the job is queued")
            self.assertEqual(bench.ask("GET", "/api/jobs")["jobs"][0]["layers"], [0, 89])
            self.assertEqual(bench.ask("GET", "/api/jobs")["jobs"][0]["job"], "plate.toml")
            until(lambda: browser.button("Bed is clear"), "the job can be printed")
            browser.tab_to("Bed is clear")
            browser.key(Keys.ENTER)
            bench.until_state("printing")
            browser.tab_to("Print")
            browser.key(Keys.ENTER)
            until(lambda: browser.button("Pause"), "the print is shown")
            browser.tab_to("Pause")
            browser.key(Keys.SPACE)
            bench.until_state("paused")
            until(lambda: browser.button("Resume"), "the print can be resumed")
            until(lambda: browser.button("Resume").is_enabled(), "resuming is possible")
            until(lambda: has_focus(browser, "Resume"), "the focus is on the button that has replaced Pause")
            browser.key(Keys.ENTER)
            bench.until_state("printing")
            until(lambda: has_focus(browser, "Pause"), "the focus is on the button that has replaced Resume")
            browser.tab_to("Cancel")
            browser.key(Keys.ENTER)
            until(lambda: browser.find("dialog[open]"), "the page asks")
            browser.key(Keys.ESCAPE)
            until(lambda: not browser.find("dialog[open]"), "Escape closes the question")
            if not browser.js("return window.wasLost"):
                self.assertEqual(browser.js("return document.activeElement.innerText.trim()"), "Cancel", "and the focus comes back")
            self.assertEqual(bench.state(), "printing")
            browser.tab_to("Cancel")
            browser.key(Keys.ENTER)
            until(lambda: browser.find("dialog[open]"), "the page asks again")
            browser.tab_to("Cancel the print", most=5)
            browser.key(Keys.ENTER)
            bench.until_state("idle")
            self.assertEqual(bench.ask("GET", "/api/jobs")["jobs"][0]["state"], "stopped")
            bench.start()
            until(lambda: browser.button("Stop"), "the page shows the next print by itself")
            until(lambda: browser.button("Stop").is_enabled(), "it can be stopped")
            browser.tab_to("Stop")
            browser.key(Keys.ENTER)
            bench.until_state("idle")
            self.assertIn(bench.ask("GET", "/api/jobs")["jobs"][-1]["state"], ("failed", "stopped", "interrupted"))

    def test_on_a_phone(self):
        self.use(PHONE)

    def test_on_a_desk(self):
        self.use(DESK)


if __name__ == "__main__":
    unittest.main()
