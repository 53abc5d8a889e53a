"""The demo's figure from made-up curves. Give a directory to keep the image."""

import math
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "script"))
import plot_spatial_four_bar as plot

GRIDS = [3, 5, 7, 11, 21]
HEADER = "t,x3_B,v3_B,torque_D\n"


def write_curves(directory, n):
    """A periodic function cut off after the harmonics that N points carry."""
    rows = [HEADER]
    for i in range(401):
        x = 2 * math.pi * i / 400
        sums = [0.0, 0.0, 0.0]
        for k in range(1, (n - 1) // 2 + 1):
            sums[0] += 0.6**k * math.cos(k * x - k)
            sums[1] -= 0.6**k * k * math.sin(k * x - k)
            sums[2] -= 0.6**k * k * k * math.cos(k * x - k)
        rows.append(f"{x / 10:.17g},{sums[0]:.17g},{sums[1]:.17g},{sums[2]:.17g}\n")
    path = pathlib.Path(directory) / f"spatial_four_bar_{n}.csv"
    path.write_text("".join(rows))
    return path


class Plot(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.directory = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def refused(self, text, complaint):
        path = self.directory / "bad.csv"
        path.write_text(text)
        with self.assertRaisesRegex(ValueError, complaint):
            plot.read_curves(path)

    def test_draws_an_image(self):
        curves = {n: plot.read_curves(write_curves(self.directory, n)) for n in GRIDS}
        image = self.directory / "figure.png"
        plot.draw(curves, image)
        self.assertEqual(image.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_reads_what_was_written(self):
        curves = plot.read_curves(write_curves(self.directory, 5))
        self.assertEqual(len(curves["t"]), 401)
        self.assertEqual(curves["t"][0], 0.0)
        self.assertAlmostEqual(curves["t"][-1], math.pi / 5)

    def test_refuses_what_cannot_be_drawn(self):
        self.refused("", "expected the header")
        self.refused("t,x\n0,1\n1,2\n", "expected the header")
        self.refused(HEADER + "0,1,2,3\n", "at least two rows")
        self.refused(HEADER + "0,1,2,3\n1,2,3\n", "line 3: expected 4 numbers")
        self.refused(HEADER + "0,1,2,3\n1,nan,2,3\n", "line 3: x3_B is nan")
        self.refused(HEADER + "0,1,2,3\n0,1,2,3\n", "do not increase")

    def test_markers_lie_on_the_curve(self):
        self.assertEqual(plot.value_at([0, 1, 3], [0, 2, 4], 2), 3)
        self.assertEqual(plot.value_at([0, 1, 3], [0, 2, 4], 9), 4)


if __name__ == "__main__":
    unittest.main()
