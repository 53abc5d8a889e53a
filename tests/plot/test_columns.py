"""Columns of CSV files drawn by script/plot.py."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "script"))
import plot


class Columns(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.directory = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def written(self, text):
        path = self.directory / "curves.csv"
        path.write_text(text)
        return path

    def test_draws_an_image_of_several_files(self):
        names = ["t [s]", "a [m]", "b [N]"]
        files = {
            "one": (names, [[0, 1], [2, 3], [4, 5]], [], []),
            "two": (names, [[0, 1], [3, 2], [5, 4]], [(1, "fold")], ["stable", "unstable"]),
        }
        image = self.directory / "figure.png"
        plot.draw(files, image)
        self.assertEqual(image.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_draws_charts_of_exponents(self):
        names = "frequency,period,growth,mode_frequency,frequency_from_ground,multiplier,error,"
        lines = ["3,2,-0.1,5,8,0.8,0,1,diameter 1 progressive", "4,1.6,0.2,5,9,1.3,0,0.9,node 1"]
        path = self.written("\n".join([names + "share,content", *lines]) + "\n")
        chart, parameter = plot.read_chart(path)
        self.assertEqual((parameter, len(chart)), ("frequency", 2))
        self.assertEqual(chart[1]["content"], "node 1")
        self.assertEqual([line["frequency_from_ground"] for line in chart], [8, 9])
        image = self.directory / "chart.png"
        plot.draw_chart(chart, parameter, image)
        self.assertEqual(image.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertIsNone(plot.read_chart(self.written("t,x\n0,2\n1,3\n")))
        with self.assertRaisesRegex(ValueError, "expected 9 columns, got 2"):
            plot.read_chart(self.written(names + "share,content\n1,2\n"))

    def test_reads_names_and_numbers(self):
        self.assertEqual(
            plot.read_columns(self.written("t,x\n0,2\n1,3\n")),
            (["t", "x"], [[0, 1], [2, 3]], [], []),
        )

    def test_reads_motions_and_events_of_branches(self):
        names = "frequency,period,slope,step,angle,grid_points,event,x.max\n"
        text = names + "1,6,1,0,0,7,,2\n2,3,0,1,1,7,fold,3\n"
        self.assertEqual(
            plot.read_columns(self.written(text)),
            (["frequency", "period", "x.max"], [[1, 2], [6, 3], [2, 3]], [(1, "fold")], []),
        )

    def test_tells_parts_of_branches_that_are_stable(self):
        names = "load,event,stability,outside,largest_multiplier,x.max\n"
        rows = ["1,,stable,0,0.5,1", "2,,stable,0,0.9,2", "3,fold,not known,0,1,3",
                "2,,unstable,1,1.5,4", "1,,unstable,1,1.6,5"]
        names, columns, events, stability = plot.read_columns(
            self.written(names + "\n".join(rows) + "\n"))
        self.assertEqual((names, len(columns)), (["load", "x.max"], 2))
        self.assertEqual(plot.parts_of(5, events, stability), [[0, 3, True], [2, 5, False]])
        self.assertEqual(plot.parts_of(5, [], []), [[0, 5, True]])

    def test_refuses_what_cannot_be_drawn(self):
        for text, complaint in [
            ("", "expected a line of names"),
            ("t,x\n0,1\n1\n", "line 3: expected 2 columns"),
        ]:
            with self.assertRaisesRegex(ValueError, complaint):
                plot.read_columns(self.written(text))
        with self.assertRaisesRegex(ValueError, "its columns are"):
            plot.draw(
                {"one": (["t", "x"], [[0, 1]] * 2, [], []),
                 "two": (["t", "y"], [[0, 1]] * 2, [], [])},
                "unused",
            )


if __name__ == "__main__":
    unittest.main()
