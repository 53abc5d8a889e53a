"""The examples run, and show what they are to show."""

import pathlib
import re
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLES = ROOT / "python/examples"


def run(name, *arguments):
    done = subprocess.run([sys.executable, EXAMPLES / name, *arguments], check=True,
                          capture_output=True, text=True)
    return done.stdout


def test_pendulum():
    assert "converged" in run("pendulum.py")


def test_rotor_blade(tmp_path):
    picture = tmp_path / "blade.png"
    assert "converged" in run("rotor_blade.py", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_spatial_four_bar():
    # what c_examples/spatial_four_bar prints
    assert run("spatial_four_bar.py").splitlines()[-1] == (
        "Torque of the motor: -10.6654 N m at 0.718 T to 8.5642 N m at 0.390 T")


def test_engine(tmp_path):
    picture = tmp_path / "engine.png"
    rows = np.genfromtxt(run("engine.py", picture, "2").splitlines(), skip_header=1)
    np.testing.assert_array_equal(rows[:, 0], [1000, 2000, 3000, 4000, 5000, 6000])
    # c_examples/engine.c at three of these speeds; what is left is the tolerance
    wanted = [[132.61, 233.69, 0.2219, 11.643], [132.62, 23.98, 0.2049, 6.261],
              [132.42, 807.39, 0.3269, 24.327]]
    np.testing.assert_allclose(rows[[0, 2, 5], 1:3], np.array(wanted)[:, :2], atol=0.05)
    np.testing.assert_allclose(rows[[0, 2, 5], 3:], np.array(wanted)[:, 2:], rtol=0.02)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_nrel_5mw_campbell(tmp_path):
    printed = run("nrel_5mw_campbell.py", tmp_path / "campbell.png").splitlines()
    at_rest = [float(word) for word in printed[1].split()]
    # those of 48 elements of degree 3, and the same at rest
    for found, wanted in zip(at_rest, [0, 0.68576, 1.08051, 1.94643]):
        assert abs(found - wanted) <= 3e-3 * wanted


def test_nrel_5mw_rotor(tmp_path):
    picture = tmp_path / "rotor.png"
    printed = run("nrel_5mw_rotor.py", picture).splitlines()
    assert printed[0].startswith("CONVERGED")
    # docs/wind_turbine.md
    for line, wanted in zip(printed[2:], ([1073.60, 3558.20, 71.25], [8982.46, 949.28, 290.54])):
        np.testing.assert_allclose([float(word) for word in line.split()[1:4]], wanted, atol=0.05)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_shells(tmp_path):
    picture = tmp_path / "shells.png"
    printed = dict(line.split(": ") for line in run("shells.py", picture).splitlines())
    told = {name: [float(word) for word in text.replace(";", "").split()]
            for name, text in printed.items()}
    # docs/shells.md: a beam; 5 nodes a side on 4 x 4 elements
    assert abs(told["Cantilever"][2] - 6.70013) < 5e-4
    assert abs(told["Hemisphere, a quarter"][0] - 4.0495) < 1e-3
    assert abs(told["Hemisphere, a quarter"][4] + 8.1061) < 1e-3
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_page_shows_the_examples():
    shown = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    files = [(EXAMPLES / name).read_text() for name in ("pendulum.py", "rotor_blade.py")]
    assert shown == [file.partition('"""\n\n')[2] for file in files]
    # That of python/README.md is the first of them.
    text = (ROOT / "python/README.md").read_text()
    assert re.findall(r"```python\n(.*?)```", text, re.S) == shown[:1]
