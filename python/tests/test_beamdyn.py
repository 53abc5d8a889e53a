"""Blades from files of BeamDyn: the NREL 5-MW blade, and a curved one."""

import csv
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest

import periodyn as pdn
from periodyn import beamdyn

DATA = pathlib.Path(__file__).parents[2] / "tests/data/nrel_5mw_blade.csv"
HEADER = pathlib.Path(__file__).parents[2] / "c_examples/nrel_5mw_blade.h"
SOURCE = """
The NREL 5-MW reference turbine's. Metres, newtons, kilograms, seconds; axis 1 from root to tip,
axes 2 and 3 downwind and edgewise, turned by the twist.

Source: OpenFAST/r-test, glue-codes/openfast/5MW_Baseline: matrices and damping of
NRELOffshrBsline5MW_BeamDyn_Blade.dat, key points of NRELOffshrBsline5MW_BeamDyn.dat. Licence:
Apache-2.0 (OpenFAST); numbers only. Design: J. Jonkman et al., NREL/TP-500-38060, 2009.

Written by PDN_BLESS=1 pytest python/tests/test_beamdyn.py."""
NUMBER = re.compile(r"(?<![\w.])-?\d[\d.]*(?:e[-+]?\d+)?")
DAMPING = "1.0E-03 1.0E-03 1.0E-03 0.0014 0.0022 0.0022"


def write(directory, points, fractions, matrices, damping=1):
    """Writes the two files of a blade: key points with twist, and stations."""
    sections = "\n".join(
        f"  {fraction}\n{rows(stiffness)}\n\n{rows(mass)}\n"
        for fraction, (stiffness, mass) in zip(fractions, matrices))
    (directory / "blade.dat").write_text(
        f" a blade\n{len(fractions)} station_total - number of stations\n"
        f"{damping} damp_type - damping\n mu1 mu2 mu3 mu4 mu5 mu6\n (-) (-) (-) (-) (-) (-)\n"
        f"{DAMPING}\n ------ Distributed Properties ------\n{sections}")
    (directory / "main.dat").write_text(
        f" a blade\n1 member_total - members\n{len(points)} kp_total - key points\n"
        f"1 {len(points)} - member\n kp_xr kp_yr kp_zr initial_twist\n (m) (m) (m) (deg)\n"
        f"{rows(points)}\n\"blade.dat\" BldFile - sections\n")
    return directory / "main.dat"


def rows(matrix):
    return "\n".join(" ".join(f"{x:.17e}" for x in row) for row in matrix)


def symmetric(upper):
    matrix = np.zeros((6, 6))
    matrix[np.triu_indices(6)] = upper
    return matrix + np.triu(matrix, 1).T


def nrel_blade(directory):
    with open(DATA, encoding="utf-8") as file:
        table = np.array(list(csv.reader(file))[1:], dtype=float)
    matrices = [(symmetric(row[5:26]), symmetric(row[26:47])) for row in table]
    return write(directory, table[:, 1:5], table[:, 0], matrices)


def test_the_nrel_blade(tmp_path):
    blade = beamdyn.read_blade(nrel_blade(tmp_path), position=[0, 0, 1.5])
    assert blade.length == pytest.approx(61.5)
    model = pdn.Model()
    beam = model.add_beam(blade.line, blade.stations, 4, 4)
    model.add_rigid_joint(pdn.GROUND, beam.first, [0, 0, 1.5])
    mass, centre = model.mass()
    # linear in between; 20.521 m from the root
    assert mass == pytest.approx(16844.75, abs=0.01)
    assert centre[2] == pytest.approx(1.5 + 20.521, abs=1e-3)
    # those of 48 elements of degree 3
    frequencies = model.solve_modes(count=3).frequencies
    np.testing.assert_allclose(frequencies, [0.68576, 1.08051, 1.94643], rtol=3e-3)
    # the first mode is flapwise, along x, so that axis 2 of the beam, less the twist, is x
    real, _ = model.solve_modes(count=1).shape(0, [beam.last])
    assert abs(real[0][1]) > 5 * abs(real[0][2])


def test_matrices_in_the_order_of_sections(tmp_path):
    stiffness = np.diag([1, 2, 3, 4, 5, 6]) + 0.1 * (np.eye(6, k=1) + np.eye(6, k=-1))
    path = write(tmp_path, [[0, 0, 0, 0], [0, 0, 2, -10]], [0, 1], [(stiffness, stiffness)] * 2)
    section = beamdyn.read_blade(path).stations.sections[1]
    np.testing.assert_array_equal(np.diag(section.stiffness), [3, 1, 2, 6, 4, 5])
    assert section.stiffness[0, 2] == 0.1  # z by y
    assert section.stiffness[1, 2] == 0.1  # x by y
    assert section.damping[0, 0] == pytest.approx(3e-3)
    assert section.damping[3, 3] == pytest.approx(6 * 0.0022)
    np.testing.assert_allclose(beamdyn.read_blade(path).stations.twists, [0, np.radians(10)])


def test_a_curved_blade_keeps_its_length(tmp_path):
    angles = np.linspace(0, 0.5, 30)
    points = np.column_stack([10 - 10 * np.cos(angles), 0 * angles, 10 * np.sin(angles),
                              0 * angles])
    path = write(tmp_path, points, [0, 1], [(np.diag([1e6] * 6), np.diag([3.0] * 6))] * 2, 0)
    blade = beamdyn.read_blade(path)
    assert blade.length == pytest.approx(5, rel=1e-5)
    model = pdn.Model()
    beam = model.add_beam(blade.line, blade.stations, 4, 3)
    assert model.mass()[0] == pytest.approx(15, rel=1e-5)
    end = model.node_frame(beam.last)
    np.testing.assert_allclose(end.position, points[-1, :3], atol=1e-8)
    np.testing.assert_allclose(end.rotation[:, 0], [np.sin(0.5), 0, np.cos(0.5)], atol=2e-2)


@pytest.mark.parametrize("change, message", [
    (("1 member_total", "2 member_total"), "expected one member, got 2"),
    (("kp_total", "points"), "expected a line with kp_total"),
    (("0.00000000000000000e+00 0.0", "here 0.0"), "expected a number, got here"),
])
def test_wrong_files(tmp_path, change, message):
    path = write(tmp_path, [[0, 0, 0, 0], [0, 0, 2, 0]], [0, 1], [(np.eye(6), np.eye(6))] * 2)
    path.write_text(path.read_text().replace(*change, 1))
    with pytest.raises(pdn.Error, match=message):
        beamdyn.read_blade(path)


def test_a_wrong_number_of_stations(tmp_path):
    path = write(tmp_path, [[0, 0, 0, 0], [0, 0, 2, 0]], [0, 1], [(np.eye(6), np.eye(6))] * 2)
    sections = tmp_path / "blade.dat"
    sections.write_text(sections.read_text().replace("2 station_total", "3 station_total"))
    with pytest.raises(pdn.Error, match="expected 3 stations"):
        beamdyn.read_blade(path)


def test_the_header_of_the_examples_is_that_of_the_blade(tmp_path):
    path = HEADER if os.environ.get("PDN_BLESS") else tmp_path / HEADER.name
    beamdyn.write_c_header(beamdyn.read_blade(nrel_blade(tmp_path)), path, SOURCE)
    written, kept = path.read_text(), HEADER.read_text()
    assert NUMBER.sub("#", written).split() == NUMBER.sub("#", kept).split()
    # 15 digits, less what functions of angles may differ by from one machine to another.
    numbers = [np.array(NUMBER.findall(text), dtype=float) for text in (written, kept)]
    assert len(numbers[0]) > 49 * (2 + 3 + 9 + 3 * 36)
    np.testing.assert_allclose(*numbers, rtol=2e-14, atol=1e-15)


def test_a_header_in_c(tmp_path):
    """Of a curved blade with a jump: a program reads what the blade has."""
    angles = np.linspace(0, 0.5, 30)
    points = np.column_stack([10 - 10 * np.cos(angles), 0 * angles, 10 * np.sin(angles),
                              60 * angles])
    law = 1e6 * (np.diag([1.0, 2, 3, 4, 5, 6]) + 0.1 * (np.eye(6, k=1) + np.eye(6, k=-1)))
    matrices = [(law * factor, np.diag([3.0] * 6)) for factor in (1, 2, 3, 4)]
    blade = beamdyn.read_blade(write(tmp_path, points, [0, 0.5, 0.5, 1], matrices))
    path = tmp_path / "curved.h"
    beamdyn.write_c_header(blade, path, "of */ mine")
    (tmp_path / "main.c").write_text("""
#include <stdio.h>
#include "curved.h"
#define PRINT(array) print((const double *)array, sizeof array / sizeof(double))
static void print(const double *values, size_t count)
{
    for (size_t i = 0; i < count; ++i) printf("%.17g ", values[i]);
    printf("\\n");
}
int main(void)
{
    PRINT(curved_fractions); PRINT(curved_twists); PRINT(curved_positions); PRINT(curved_axes);
    PRINT(curved_stiffness); PRINT(curved_mass); PRINT(curved_damping);
    return CURVED_STATIONS - 4;
}
""")
    subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "main.c", "-o",
                    "main"], cwd=tmp_path, check=True)
    done = subprocess.run([tmp_path / "main"], check=True, capture_output=True, text=True)
    rows = [np.array(line.split(), dtype=float) for line in done.stdout.splitlines()]
    fractions, twists, positions, axes = *rows[:2], rows[2].reshape(4, 3), rows[3].reshape(4, 3, 3)
    np.testing.assert_array_equal(fractions, [0, 0.5, 0.5, 1])
    np.testing.assert_allclose(twists, -np.radians(60 * 0.5) * fractions, atol=1e-4)
    np.testing.assert_allclose(positions, np.column_stack([
        10 - 10 * np.cos(0.5 * fractions), 0 * fractions, 10 * np.sin(0.5 * fractions)]), atol=1e-3)
    for k, (of_station, turn) in enumerate(zip(axes, twists)):
        # What a natural spline's ends are off by is within 2e-2.
        along = np.array([np.sin(0.5 * fractions[k]), 0, np.cos(0.5 * fractions[k])])
        across = np.cross([0, 1, 0], along)
        second = np.cos(turn) * across + np.sin(turn) * np.array([0, 1, 0])
        np.testing.assert_allclose(of_station[0], along, atol=2e-2)
        np.testing.assert_allclose(of_station[1], second, atol=2e-2)
    for section, values in zip(blade.stations.sections, zip(*(r.reshape(4, 36) for r in rows[4:]))):
        for name, value in zip(("stiffness", "mass", "damping"), values):
            np.testing.assert_allclose(value.reshape(6, 6).T, getattr(section, name), rtol=1e-14)


def test_a_header_that_cannot_be(tmp_path):
    blade = beamdyn.read_blade(nrel_blade(tmp_path))
    with pytest.raises(pdn.Error, match="path: expected .* got 5mw-blade.h"):
        beamdyn.write_c_header(blade, tmp_path / "5mw-blade.h")
    blade.stations = pdn.Stations(sections=blade.stations.sections[:1])
    with pytest.raises(pdn.Error, match="blade: expected stations with fractions"):
        beamdyn.write_c_header(blade, tmp_path / "blade.h")
