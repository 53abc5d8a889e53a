"""The notebook with the paper's figures runs, and finds what the examples in C find."""

import pathlib
import re

import nbclient
import nbformat
import numpy as np
import pytest

BOOK = pathlib.Path(__file__).parents[1] / "examples/paper.ipynb"


@pytest.fixture(scope="module")
def outputs():
    """What the cells put out, in their order."""
    book = nbformat.read(BOOK, as_version=4)
    nbclient.NotebookClient(book, timeout=300).execute()
    return [output for cell in book.cells for output in cell.get("outputs", [])]


@pytest.fixture(scope="module")
def printed(outputs):
    """All that the cells print."""
    return "".join(output.text for output in outputs if output.get("name") == "stdout")


def test_it_is_stored_without_what_it_puts_out():
    code = [cell for cell in nbformat.read(BOOK, as_version=4).cells if cell.cell_type == "code"]
    assert len(code) > 5
    assert not any(cell.outputs or cell.execution_count for cell in code)


def test_figures(outputs):
    drawn = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(drawn) == len([5, 6, 8, 9, 10, 12, 13, 14, 15, 16])


def test_damped_mechanism(printed):
    # The table of the page: eigenvalue, and marched with steps of 3 ms.
    page = (BOOK.parents[2] / "docs/paper.md").read_text(encoding="utf-8")
    wanted = re.findall(r"^\| \d/\d+ \| ([\d.]+) \| ([\d.]+) \|", page, re.M)
    found = re.findall(r"^\d?T/\d+ +(\d+) +(\S+) +(\S+) +(\S+)$", printed, re.M)
    assert len(found) == len(wanted) == 6
    for rates, (iterations, largest, *mine) in zip(wanted, found):
        assert iterations == "1" and float(largest) < 1e-12
        np.testing.assert_allclose(np.float64(mine), np.float64(rates), atol=2e-4)


def test_spatial_four_bar(printed):
    # what c_examples/spatial_four_bar prints
    assert "\nTorque of the motor: -10.6654 N m at 0.718 T to 8.5642 N m at 0.390 T" in printed


def test_planar_four_bar(printed):
    # what c_examples/planar_four_bar prints, with --march 2000 and without
    peak = r"(\S+) kN at (\S+) T"
    found = re.findall(rf"^Axial force in the crank, (\w+): {peak} to {peak}", printed, re.M)
    assert [name for name, *_ in found] == ["marching", "21"]
    np.testing.assert_allclose(np.float64([numbers for _, *numbers in found]),
                               [[-5.9522, 0.7500, 0.0028, 0.0420],
                                [-0.5492, 0.7590, 0.0341, 0.4995]], atol=2e-4)
