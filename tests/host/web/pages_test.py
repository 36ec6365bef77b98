#!/usr/bin/python3
"""Every page: no error in the console, no fault of accessibility, in two sizes, two themes and two languages."""

import unittest

import page_faults
from bench import DESK, PHONE, Bench, Browser, until

PAGES = ["print", "queue", "dry-run", "history", "printer"]
NARROWEST = (320, 640)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bench = Bench()
        cls.addClassCleanup(cls.bench.__exit__)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.bench.start_printer(100)
        cls.bench.serve()

    def check(self, what):
        self.none(page_faults.of_page(self.browser), what)

    def none(self, faults, what):
        if faults:
            self.fail("\n  ".join([f"{what}:", *faults]))

    def look_everywhere(self, pages, languages=("en", "de")):
        """Themes and sizes of each page; German, which has long words, on the phone and on a narrower screen."""
        for language in languages:
            self.browser.speak(language)
            for page in pages:
                self.browser.go(page)
                self.assertEqual(self.browser.js("return document.documentElement.lang"), language)
                views = [(PHONE, False), (PHONE, True), (DESK, False), (DESK, True), (NARROWEST, False)]
                for size, dark in views if language == "en" else [(PHONE, False), (NARROWEST, True)]:
                    with self.subTest(page=page, language=language, width=size[0], dark=dark):
                        self.browser.view(size, dark)
                        self.browser.settled()
                        self.check(f"{page} {language} {size} {'dark' if dark else 'light'}")
        self.none(self.browser.errors(), "the console")

    def test_1_an_idle_printer(self):
        self.browser.open(self.bench)
        self.bench.queue(layers=[0, 1])
        self.bench.queue()
        self.look_everywhere(PAGES)
        self.browser.speak("en")
        self.browser.go("printer")
        for tab in range(len(self.browser.find("[role=tab]"))):
            for size, dark in ((PHONE, True), (DESK, False)):
                self.browser.view(size, dark)
                self.browser.find("[role=tab]")[tab].click()
                self.browser.settled()
                with self.subTest(page="printer", tab=self.browser.find("[role=tab]")[tab].text, width=size[0]):
                    self.check("a part of the page of the printer")
        self.none(self.browser.errors(), "the console")

    def test_2_the_focus_is_seen_and_comes_round(self):
        self.browser.open(self.bench)
        for size in (PHONE, DESK):
            self.browser.view(size)
            for page in PAGES:
                self.browser.go(page)
                with self.subTest(page=page, width=size[0]):
                    self.none(page_faults.of_focus(self.browser), "focus")

    def test_3_a_print(self):
        self.browser.open(self.bench)
        self.bench.ask("POST", "/api/print/start", {"id": self.bench.queue()})
        self.bench.until_state("printing")
        until(lambda: self.browser.button("Pause"), "the page shows the print")
        self.bench.ask("POST", "/api/print/pause", {})
        self.bench.until_state("paused")
        self.look_everywhere(["print"])
        self.browser.speak("en")
        self.browser.go("print")
        self.browser.press("Cancel")
        with self.subTest("a dialog"):
            self.check("the dialog that asks")
            self.assertTrue(self.browser.js("return document.activeElement.closest('dialog, [role=dialog], [role=alertdialog]') !== null"))
        self.browser.press("Cancel the print")
        self.bench.until_state("idle")
        until(lambda: self.browser.button("Bed is clear"), "the page shows the queue again")
        for page in ("print", "history"):
            self.browser.go(page)
            with self.subTest(page=page, after="a cancelled print"):
                self.check(page)
        self.none(self.browser.errors(), "the console")

    def test_4_the_login(self):
        self.browser.driver.get("about:blank")
        self.browser.driver.get(f"http://127.0.0.1:{self.bench.port}/#token=wrong")
        until(lambda: self.browser.link() == "locked", "the page asks for a token")
        self.assertNotIn("token", self.browser.js("return location.href"))
        for size, dark in ((PHONE, False), (NARROWEST, True)):
            self.browser.view(size, dark)
            self.browser.settled()
            self.check("login")
        self.browser.errors()  # 401 is shown there
        self.browser.open(self.bench)

    def test_5_an_upload_says_how_far_it_is(self):
        file = self.bench.write("large.gcode", "G1 X1 Y1 E1\n" * 100_000)
        bar = "document.querySelector('.drop progress')"
        self.browser.open(self.bench, "queue")
        self.browser.cdp("Network.enable")
        slowly = {"offline": False, "latency": 0, "downloadThroughput": -1}
        self.browser.cdp("Network.emulateNetworkConditions", uploadThroughput=600_000, **slowly)
        self.browser.find("#files")[0].send_keys(str(file))
        until(lambda: self.browser.js(f"return !{bar}.hidden && {bar}.value > 0 && {bar}.value < 100"), "a part of the file is sent")
        self.check("an upload")
        until(lambda: self.browser.js(f"return {bar}.hidden"), "the upload has ended")
        self.browser.cdp("Network.emulateNetworkConditions", uploadThroughput=-1, **slowly)
        until(lambda: self.browser.find(".message"), "the page says what has become of it")

    def test_6_what_the_daemon_refuses_is_said_in_german(self):
        self.bench.queue(layers=[0, 1])
        self.bench.stop_printer()
        self.browser.open(self.bench, language="de")
        self.browser.press("Bett ist frei")
        until(lambda: "Der Anschluss des Druckers ist nicht da" in self.browser.text(".messages"), "the page says why")


if __name__ == "__main__":
    unittest.main()
