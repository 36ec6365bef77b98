#!/usr/bin/python3
"""Names and texts of jobs, files, printers and programs are shown as text, whatever stands in them."""

import json
import unittest

from bench import PROFILE, Bench, Browser, until
import page_faults

MARKUP = "<img src=x onerror=document.title='owned'><script>document.title='owned'</script>"
SAID = "<img src=x onerror=owned()>"  # a command has at most 80 characters
TURNED = "leaf\u202etxt.toml"  # reads backwards after the mark
LONG = "n" * 10_000


class Hostile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bench = Bench()
        cls.addClassCleanup(cls.bench.__exit__)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        bench = cls.bench
        profile = PROFILE.replace('"Test bench"', json.dumps(f"Bench {MARKUP}")).replace('"blue PLA"', json.dumps(MARKUP)) \
            .replace('"red PLA"', json.dumps(LONG))
        said = [f"M118 {word} {SAID}" for word in ("E1", "A1 action:notification", "A1 action:prompt_begin", "A1 action:prompt_button")]
        said.append("M118 A1 action:prompt_show")  # the simulated printer says all that
        bench.write("jobs/bench.profile", profile + "[gcode]\nstart = " + json.dumps("\n".join(said)) + "\n")
        job = (bench.folder / "jobs/plate.toml").read_text()
        cls.named = "<img src=x onerror=alert(1)>.toml"
        for name in (cls.named, TURNED, "l" * 240 + ".toml"):
            bench.write(f"jobs/{name}", job.replace('"sea"', '"<b>sea</b>"').replace("sea =", '"<b>sea</b>" =') if name == cls.named else job)
        bench.start_printer(60)
        bench.serve()
        for name in (cls.named, TURNED, "l" * 240 + ".toml"):
            bench.queue(name)

    def sound(self, what):
        """Nothing ran, nothing was made from the texts, nothing is wider than the screen."""
        browser = self.browser
        self.assertNotIn("owned", browser.js("return document.title"), what)
        made = browser.js("return [...document.querySelectorAll('main img[src=x], main script, main b, [onerror], header img')].length")
        self.assertEqual(made, 0, what)
        self.assertEqual([fault for fault in page_faults.of_page(browser) if "contrast" not in fault], [], what)

    def test_on_all_pages(self):
        browser, bench = self.browser, self.bench
        browser.open(bench)
        browser.view((320, 640))
        for page in ("print", "queue", "dry-run", "history", "printer"):
            browser.go(page)
            self.sound(page)
        browser.go("queue")
        until(lambda: len(browser.find("main ol li")) == 3, "all jobs are shown")
        self.assertIn("<img src=x onerror=alert(1)>.toml", browser.text("main"))
        self.assertEqual(browser.js("return document.title.includes('owned')"), False)

    def test_texts_of_a_print_and_of_its_printer(self):
        browser, bench = self.browser, self.bench
        browser.open(bench)
        browser.view()
        bench.ask("POST", "/api/print/start", {})
        bench.until_state("printing", "paused")  # the question may hold it
        until(lambda: browser.text("body").count(SAID) >= 2, "the question and its answer are shown as they are")
        self.assertIn(self.named, browser.text("main"))
        self.sound("a print")
        bench.ask("POST", "/api/print/cancel", {})
        bench.until_state("idle")
        browser.go("history")
        self.sound("history")

    def test_the_answer_of_an_api_is_no_page(self):
        """A name in an address or an answer cannot become a page of this origin."""
        browser, bench = self.browser, self.bench
        browser.open(bench)
        for path in ("/api/status", "/assets/none", "/api/files"):
            browser.driver.get(f"http://127.0.0.1:{bench.port}{path}")
            self.assertNotIn("owned", browser.js("return document.title"))
            self.assertEqual(browser.js("return document.images.length + document.scripts.length"), 0, path)


if __name__ == "__main__":
    unittest.main()
