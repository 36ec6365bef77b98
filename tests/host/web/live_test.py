#!/usr/bin/python3
"""The line as it grows: the canvas shows the bytes of the layer's path, and the nozzle stands where the daemon says."""

import math
import struct
import unittest

from bench import DESK, PHONE, Bench, Browser, until

COARSE = 16  # the page rounds colours to 5 bits; where they change, a pixel may be the next bead's
# Where things are on the canvas that is shown, by the parts of the page that paint it.
PIXELS = """
const view = document.querySelector('curve-view'), canvas = view.shown, {scale, left, top} = view.drawn;
const brush = canvas.getContext('2d');
return arguments[0].map(([x, y]) => [Math.round(x * scale + left), Math.round(top - y * scale)])
  .map(([x, y]) => x < 0 || y < 0 || x >= canvas.width || y >= canvas.height ? null : [...brush.getImageData(x, y, 1, 1).data]);
"""


def beads_of(data):
    """Middles, widths and colours of the beads that a path holds, mm on the bed."""
    assert data[:4] == b"UCL1", data[:40]
    layer, first, count, x, y, top = struct.unpack_from("<IIIiif", data, 4)
    x, y, beads = x / 1000, y / 1000, []
    for place in range(count):
        dx, dy, width, _asked, *colour = struct.unpack_from("<hhBBBBB", data, 32 + 9 * place)
        beads.append(((x + dx / 200, y + dy / 200), width * 0.02, tuple(colour), math.hypot(dx, dy) / 100))
        x, y = x + dx / 100, y + dy / 100
    return layer, first, beads


class Line(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bench = Bench()
        cls.addClassCleanup(cls.bench.__exit__)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.__exit__)
        cls.bench.start_printer(40)
        cls.bench.serve()
        cls.bench.start(layers=[0, 9])
        until(lambda: cls.layer_and_bead() > (1, 150), "beads are laid above the line that primes the nozzle")
        cls.bench.ask("POST", "/api/print/pause", {})
        cls.bench.until_state("paused")

    @classmethod
    def layer_and_bead(cls):
        at = cls.bench.ask("GET", "/api/print/position")
        return at.get("layer", -1), at.get("bead", -1)

    def open(self, size):
        self.browser.view(size)
        self.browser.open(self.bench)
        return until(lambda: self.browser.js("const view = document.querySelector('curve-view'); return view.work === null && view.painted"),
                     "the layer is painted")

    def painted(self):
        """Beads in full colour."""
        return self.browser.js("return document.querySelector('curve-view').painted")

    def pixels_of(self, beads):
        """The colour on the canvas and the path's, of each bead that lies on the canvas."""
        pixels = self.browser.js(PIXELS, [list(one[0]) for one in beads])
        return [(pixel, one[2]) for pixel, one in zip(pixels, beads) if pixel]

    @staticmethod
    def alike(pairs):
        return sum(all(abs(a - b) <= COARSE for a, b in zip(*pair)) for pair in pairs)

    def test_the_canvas_shows_what_leaves_the_nozzle(self):
        for size in (PHONE, DESK):
            self.open(size)
            until(lambda: abs(self.painted() - self.layer_and_bead()[1]) <= 2, "what is laid is in full colour")
            painted, (layer, _) = self.painted(), self.layer_and_bead()
            _, _, beads = beads_of(self.bench.ask("GET", f"/api/print/layers/{layer}/path?from=0"))
            laid = [one for one in beads[:painted] if one[1] > 0 and one[3] > 0.2]
            self.assertGreater(len(laid), 50)
            shown = self.pixels_of(laid)
            self.assertGreater(len(shown), 0.3 * len(laid), "the part fills the canvas; the line that primes the nozzle need not be on it")
            self.assertGreater(self.alike(shown) / len(shown), 0.95, "colours under the canvas are the path's")
            later = [one for one in beads[painted + 5:] if one[1] > 0 and one[3] > 0.2]
            self.assertLess(self.alike(self.pixels_of(later)), 0.3 * len(later) + 1, "what is not laid yet is pale")
        self.assertEqual(self.browser.errors(), [])

    def test_the_nozzle_and_its_colours_are_the_daemon_s(self):
        self.open(DESK)
        at = self.bench.ask("GET", "/api/print/position")
        dot = self.browser.js("""
          const view = document.querySelector('curve-view'), dot = view.querySelector('.nozzle').getBoundingClientRect(),
                canvas = view.shown.getBoundingClientRect(), k = view.ratio, {scale, left, top} = view.drawn;
          return [((dot.x + dot.width / 2 - canvas.x) * k - left) / scale, (top - (dot.y + dot.height / 2 - canvas.y) * k) / scale];""")
        _, _, beads = beads_of(self.bench.ask("GET", f"/api/print/layers/{at['layer']}/path?from=0"))
        bead = beads[at["bead"]][0]
        self.assertLess(math.dist(dot, bead), 1.5, "the dot stands at the bead that is being laid")
        self.assertIn(at["leaving"]["nearest"], self.browser.text(".colours"))
        self.assertIn(f"Layer {at['layer'] + 1}", self.browser.text(".layer-label"))
        self.assertEqual(self.browser.errors(), [])

    def test_while_the_printer_heats_the_planned_layers_are_shown(self):
        with Bench() as cold:
            cold.start_printer(1)  # minutes until it is hot
            cold.serve()
            cold.ask("POST", "/api/print/start", {"id": cold.queue(layers=[0, 9])})
            self.browser.view(PHONE)
            self.browser.open(cold)
            until(lambda: self.browser.js("const view = document.querySelector('curve-view'); return view && view.work === null && view.known"),
                  "the plan of the first layer is painted")
            until(lambda: not self.browser.js("return document.querySelector('input.layers').disabled"), "the next one can be chosen")
            self.assertIn("Layer 1, planned", self.browser.text(".layer-label"))
            self.assertEqual(self.painted(), 0, "nothing is laid")
            _, _, beads = beads_of(cold.ask("GET", "/api/print/layers/0/path"))
            shown = self.pixels_of([one for one in beads if one[1] > 0])
            self.assertGreater(sum(pixel[3] > 0 for pixel, _ in shown), 0.9 * len(beads), "the canvas is not empty")
            self.assertLess(self.alike(shown), 0.3 * len(shown), "it is paler than what is laid")
            self.assertIn(cold.state(), ("connecting", "heating"))
        self.assertEqual(self.browser.errors(but=("network",)), [])


if __name__ == "__main__":
    unittest.main()
