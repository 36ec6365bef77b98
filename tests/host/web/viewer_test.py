#!/usr/bin/python3
"""The page of a dry run, index.html: from a folder without a network, and served by the daemon under its policy."""

import json
import subprocess
import unittest

import page_faults
from bench import DESK, PHONE, PROGRAM, Bench, Browser, Keys, until

HOSTILE = "<img src=x onerror=document.title='owned'>"


class Viewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bench = Bench()
        cls.addClassCleanup(cls.bench.__exit__)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        bench = cls.bench
        job = bench.write(f"jobs/{HOSTILE.replace('/', '')}.toml", (bench.folder / "jobs/plate.toml").read_text())
        profile = bench.folder / "jobs/bench.profile"
        profile.write_text(profile.read_text().replace('"red PLA"', json.dumps(HOSTILE)))
        cls.pictures = bench.folder / "pictures"
        subprocess.run([PROGRAM, "dry-run", job, "--layers", "2:4", "--picture", cls.pictures, "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)

    def setUp(self):
        self.browser.view(PHONE)

    def open(self, address):
        self.browser.driver.get("about:blank")
        self.browser.driver.get(address)
        self.until_shown("deposit-0000.png")

    def until_shown(self, file):
        until(lambda: self.browser.js("""
          const image = document.querySelector('.stage img');
          return image?.src.endsWith(arguments[0]) && image.naturalWidth > 0;""", file), f"{file} is shown")

    def middle(self):
        """Of the picture, in pixels of the frame."""
        return self.browser.js("""
          const image = document.querySelector('.stage img').getBoundingClientRect(), frame = document.querySelector('.stage').getBoundingClientRect();
          return [image.x - frame.x + image.width / 2, image.y - frame.y + image.height / 2, image.width];""")

    def test_from_a_folder(self):
        browser = self.browser
        self.open(f"file://{self.pictures}/index.html")
        self.assertIn("Layer 3 (1 of 3)", browser.text(".which"))
        middle = self.middle()
        for key, file in (("1", "curve-0002.png"), ("3", "gaps-0002.png"), ("4", "mixtures-0002.png"), ("2", "deposit-0000.png")):
            browser.key(key)
            self.until_shown(file)
            for now, before in zip(self.middle()[:2], middle[:2]):
                self.assertAlmostEqual(now, before, delta=3, msg=f"{file} lies where the others do")
        browser.key(Keys.ARROW_RIGHT)
        self.until_shown("deposit-0001.png")
        self.assertIn("Layer 4", browser.js("return document.querySelector('.stage img').alt"))
        browser.key("+", "+")
        until(lambda: self.middle()[2] > 3.5 * middle[2], "the picture is larger")
        browser.key("0")
        until(lambda: abs(self.middle()[2] - middle[2]) < 2, "the whole layer is shown again")
        for place in range(len(browser.find(".worst button"))):
            browser.find(".worst button")[place].click()
            until(lambda: browser.find(".ring:not([hidden])"), "the place is marked")
            ring = browser.js("""
              const ring = document.querySelector('.ring').getBoundingClientRect(), frame = document.querySelector('.stage').getBoundingClientRect();
              return [ring.x + ring.width / 2 - frame.x - frame.width / 2, ring.y + ring.height / 2 - frame.y - frame.height / 2];""")
            self.assertTrue(max(map(abs, ring)) < 3, "the place is in the middle of the frame")
        self.assertEqual(browser.js("return document.title"), f"{HOSTILE.replace('/', '')}.toml")
        self.assertEqual(browser.js("return document.querySelectorAll('main img:not(.stage img)').length"), 0)
        self.assertEqual(browser.errors(), [])

    def test_accessible_in_both_languages_sizes_and_themes(self):
        browser = self.browser
        self.open(f"file://{self.pictures}/index.html")
        for language in ("de", "en"):
            browser.js("const one = document.querySelector('select'); one.value = arguments[0]; one.dispatchEvent(new Event('change'))", language)
            until(lambda: browser.js("return document.documentElement.lang") == language, "the language has changed")
            for size, dark in ((PHONE, False), (DESK, True), ((320, 640), False)):
                with self.subTest(language=language, size=size, dark=dark):
                    browser.view(size, dark)
                    browser.settled()
                    self.assertEqual(page_faults.of_page(browser), [])
        browser.view(PHONE)
        self.assertEqual(page_faults.of_focus(browser), [])
        self.assertEqual(browser.errors(), [])

    def test_from_the_daemon(self):
        browser, bench = self.browser, self.bench
        bench.serve()
        browser.open(bench)
        run = bench.ask("POST", "/api/dry-runs", {"job": "plate.toml", "layers": [0, 0]})["id"]
        until(lambda: bench.ask("GET", f"/api/dry-runs/{run}")["state"] == "done", "the dry run has ended")
        browser.errors()
        self.open(f"http://127.0.0.1:{bench.port}/api/dry-runs/{run}/index.html")
        self.assertIn("Layer 1 (1 of 1)" if False else "Layer 1 of 1", browser.text(".which"))
        browser.key("3")
        self.until_shown("gaps-0000.png")
        self.assertEqual(browser.errors(), [])


if __name__ == "__main__":
    unittest.main()
