#!/usr/bin/python3
"""What the page does when the daemon, the printer, the network or the computer itself goes away, and comes back."""

import os
import signal
import threading
import time
import unittest

from bench import Bench, Browser, free_port, until
from slow_network import SlowNetwork

AT_MOST = 5  # s, until the page says that it has lost the daemon
ALLOWANCE = 3  # s, for a computer that does other things as well


def commands_off(browser):
    """Every button that would give a command is off, also to the keyboard."""
    return browser.js("""
      return [...document.querySelectorAll('main button')]
        .filter((one) => one.checkVisibility() && /Pause|Resume|Cancel|Stop|print|Add|Connect/.test(one.innerText) && !one.disabled)
        .map((one) => one.innerText);""") == []


class Lost(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)

    def setUp(self):
        self.bench = Bench()
        self.addCleanup(self.bench.__exit__)
        self.addCleanup(self.browser.driver.get, "about:blank")
        self.bench.start_printer(100)
        self.bench.serve()

    def until_lost(self, since, what):
        until(lambda: self.browser.link() == "lost", f"the page says that {what}", AT_MOST + ALLOWANCE)
        print(f"{what}: said after {time.monotonic() - since:.1f} s", flush=True)
        self.assertIn("No connection", self.browser.text(".banner"))
        self.assertTrue(commands_off(self.browser))

    def until_back(self):
        since = time.monotonic()
        self.browser.until_up()
        print(f"back after {time.monotonic() - since:.1f} s", flush=True)
        until(lambda: not self.browser.find(".banner:not([hidden])"), "the banner goes")

    def test_a_daemon_that_hangs(self):
        self.bench.start()
        self.browser.open(self.bench)
        until(lambda: self.browser.button("Pause"), "the print is shown")
        self.bench.signal(signal.SIGSTOP)
        self.until_lost(time.monotonic(), "the daemon hangs")
        self.bench.signal(signal.SIGCONT)
        self.until_back()
        self.browser.press("Pause")
        self.bench.until_state("paused")

    def test_a_daemon_that_is_killed_and_started_again(self):
        self.browser.open(self.bench)
        self.bench.queue()
        until(lambda: self.browser.button("Bed is clear"), "the job is shown")
        self.bench.kill_daemon()
        self.until_lost(time.monotonic(), "the daemon was killed")
        self.bench.serve()
        self.until_back()
        self.assertTrue(until(lambda: self.browser.button("Bed is clear"), "the queue is shown again").is_enabled())

    def test_a_printer_that_is_pulled(self):
        self.bench.start()
        self.browser.open(self.bench)
        until(lambda: "Printing" in self.browser.text("main"), "the print is shown")
        self.bench.stop_printer()
        until(lambda: self.bench.ask("GET", "/api/status")["state"] != "printing", "the daemon has noticed it")
        until(lambda: "Printing" not in self.browser.text("main"), "the page says so", AT_MOST + ALLOWANCE)
        self.assertEqual(self.browser.link(), "up")
        self.assertFalse(self.browser.button("Pause") and self.browser.button("Pause").is_enabled())

    def test_a_network_that_delays_cuts_and_stalls(self):
        with SlowNetwork(free_port(), self.bench.port) as network:
            self.bench.start()
            network.delay = 0.4
            self.browser.open(self.bench, port=network.port)
            until(lambda: self.browser.button("Pause"), "the print is shown over a slow network")
            network.cut()  # every connection ends; the next ones work
            until(lambda: network.accepted_since_cut > 0, "the page connects again by itself")
            self.browser.until_up()
            network.stalled = True  # packets vanish
            self.until_lost(time.monotonic(), "packets vanish")
            network.stalled = False
            self.until_back()
            self.browser.press("Pause")
            self.bench.until_state("paused")

    def test_a_computer_that_slept(self):
        self.bench.start()
        self.browser.open(self.bench)
        until(lambda: self.browser.button("Pause"), "the print is shown")
        asleep = processes_of(self.browser.folder)
        for number in asleep:
            os.kill(number, signal.SIGSTOP)
        waking = threading.Timer(30, lambda: [os.kill(number, signal.SIGCONT) for number in asleep])
        waking.start()  # in case that something fails here
        try:
            self.bench.ask("POST", "/api/print/cancel", {})
            self.bench.until_state("idle")
            time.sleep(11)  # how long it sleeps; the page takes shorter gaps for a busy computer
        finally:
            waking.cancel()
            for number in asleep:
                os.kill(number, signal.SIGCONT)
        since = time.monotonic()
        until(lambda: self.browser.button("Pause") is None and self.browser.link() == "up", "the page shows what is so now")
        print(f"awake: right after {time.monotonic() - since:.1f} s", flush=True)
        self.assertEqual(self.browser.errors(but=("network",)), [])


def processes_of(folder):
    """The browser's own processes, by the folder of its profile, and their descendants."""
    parents, roots = {}, set()
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/cmdline", "rb") as words, open(f"/proc/{name}/stat", encoding="utf-8") as stat:
                if f"--user-data-dir={folder}".encode() in words.read().split(b"\0"):
                    roots.add(int(name))
                parents[int(name)] = int(stat.read().rpartition(")")[2].split()[1])
        except OSError:
            continue
    found = set(roots)
    while more := {child for child, parent in parents.items() if parent in found and child not in found}:
        found |= more
    return found


if __name__ == "__main__":
    unittest.main()
