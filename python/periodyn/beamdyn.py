"""Blades from the files of BeamDyn (OpenFAST): reference line, twist, sections, damping.

    blade = beamdyn.read_blade("NRELOffshrBsline5MW_BeamDyn.dat")
    beam = model.add_beam(blade.line, blade.stations, elements=4, degree=4)

BeamDyn's axes are x downwind, y edgewise, z from root to tip; axis 1 of the beam is along z, axes 2
and 3 are x and y, turned by the twist.

    beamdyn.write_c_header(blade, "blade.h")    # for programs in C
"""

import pathlib
import textwrap
from dataclasses import dataclass

import numpy

from ._call import Error
from ._interface import Line, Model, Section, Stations

# BeamDyn's force along z and x and y, then moments, in the order of Section.
ORDER = numpy.array([2, 0, 1, 5, 3, 4])


@dataclass
class Blade:
    """A blade that a file describes."""

    line: Line
    """Its reference line."""
    stations: Stations
    """Sections and twist along it, linear in between."""
    length: float
    """Length of the reference line."""


def read_blade(path, position=(0, 0, 0), axes=None):
    """Reads a blade from BeamDyn's main input file, which names the file of the sections.

    One member; stiffness-proportional damping or none (damp_type 0 or 1).

    Args:
        path: the main input file
        position: where the root is, global coordinates
        axes: BeamDyn's axes x, y, z as the columns of a matrix, in global coordinates; the global
            axes by default
    """
    path = pathlib.Path(path)
    axes = numpy.eye(3) if axes is None else numpy.asarray(axes, dtype=float)
    rows = path.read_text(encoding="utf-8", errors="replace").splitlines()
    if int(_value(path, rows, "member_total")) != 1:
        raise Error(f"{path}: expected one member, got {_value(path, rows, 'member_total')}")
    count = int(_value(path, rows, "kp_total"))
    start = next(i for i, row in enumerate(rows) if row.split()[:1] == ["kp_xr"]) + 2
    points = _table(path, rows[start:start + count], 4)
    if len(points) != count:
        raise Error(f"{path}: expected {count} key points, got {len(points)}")
    name = _value(path, rows, "BldFile").strip('"')
    fractions, sections = _sections(path.parent / name)

    along = points[:, :3]
    arc = numpy.concatenate([[0], numpy.cumsum(numpy.linalg.norm(numpy.diff(along, axis=0),
                                                                axis=1))])
    line, length = _line(along @ axes.T + position, arc, axes)
    twists = -numpy.radians(numpy.interp(fractions, arc / arc[-1], points[:, 3]))
    return Blade(line, Stations(fractions=fractions, sections=sections, twists=twists), length)


def write_c_header(blade, path, source=""):
    """Writes a blade as a header of C: constant arrays of what its stations have.

    Their names begin with that of the file: of `blade.h` they are BLADE_STATIONS, the number, and
    `blade_fractions` and `blade_twists` for pdn_stations, `blade_stiffness`, `blade_mass` and
    `blade_damping` for pdn_section, and places on the reference line, `blade_positions`, with the
    sections' axes, `blade_axes`. Matrices are column by column.

    Args:
        blade: the blade, whose stations have fractions
        path: the file
        source: lines of text for its head, such as source and licence of the data
    """
    path, stations = pathlib.Path(path), blade.stations
    if not (path.stem.isascii() and path.stem.isidentifier()):
        raise Error(f"path: expected the name of a file that may begin names in C, got {path.name}")
    if stations.fractions is None:
        raise Error("blade: expected stations with fractions")
    name, count, places = path.stem, stations.count, numpy.unique(stations.fractions)
    model = Model()
    beam = model.add_beam_between(blade.line, stations, places, 1)
    nodes = beam.first + numpy.searchsorted(places, stations.fractions)
    frames = [model.node_frame(int(node)) for node in nodes]
    twists = numpy.zeros(count) if stations.twists is None else stations.twists
    arrays = [
        ("fractions", "Of the length, from the root to the tip.", stations.fractions),
        ("twists", "Structural twist about axis 1 [radian].", twists),
        ("positions", "On the reference line [length].", [frame.position for frame in frames]),
        ("axes", "Of the sections, twisted: axes 1, 2, 3.", [f.rotation.T for f in frames]),
        *((matrix, f"{matrix.capitalize()} along these axes, column by column.",
           [getattr(section, matrix).T for section in stations.sections])
          for matrix in ("stiffness", "mass", "damping")),
    ]
    lines = [f"{count} stations of a blade, by periodyn.beamdyn.write_c_header.",
             *source.replace("*/", "* /").strip().splitlines()]
    guard = f"{name.upper()}_H"
    head = "\n".join(f" * {line}".rstrip() for line in lines)
    text = f"""/*{head[2:]} */

#ifndef {guard}
#define {guard}

enum {{ {name.upper()}_STATIONS = {count} }};
"""
    for what, meaning, values in arrays:
        values = numpy.asarray(values).reshape(count, -1)
        of_each = f"[{values.shape[1]}]" if values.shape[1] > 1 else ""
        text += f"\n/* {meaning} */\nstatic const double {name}_{what}[{count}]{of_each} = {{\n"
        rows = [f"{{{_numbers(row)}}}" for row in values] if of_each else [_numbers(values.ravel())]
        wrap = textwrap.TextWrapper(99, initial_indent="    ", break_on_hyphens=False,
                                    subsequent_indent="     " if of_each else "    ")
        text += "".join(f"{wrap.fill(row)},\n" for row in rows) + "};\n"
    path.write_text(f"{text}\n#endif\n", encoding="utf-8")


def _numbers(values):
    """15 digits, and no -0."""
    return ", ".join(f"{value + 0.0:.15g}" for value in values)


def _line(points, arc, axes):
    """The line through key points: straight, or a natural cubic spline; and its length."""
    length = numpy.linalg.norm(points[-1] - points[0])
    straight = points[0] + numpy.outer(arc / arc[-1], points[-1] - points[0])
    if abs(points - straight).max() < 1e-9 * length:
        return Line().set_straight(points[0], points[-1], axes[:, 0]), length
    place, length = _spline(points, arc)
    return Line().set_curve(lambda fraction: (place(fraction), axes[:, 0])), length


def _spline(points, arc):
    """Where the spline is, by the fraction of its length; and its length."""
    steps = numpy.diff(arc)
    matrix, right = numpy.eye(len(arc)), numpy.zeros_like(points)
    slopes = numpy.diff(points, axis=0) / steps[:, None]
    for i in range(1, len(arc) - 1):
        matrix[i, i - 1:i + 2] = steps[i - 1], 2 * (steps[i - 1] + steps[i]), steps[i]
        right[i] = 6 * (slopes[i] - slopes[i - 1])
    bends = numpy.linalg.solve(matrix, right)

    def at(s):
        i = numpy.clip(numpy.searchsorted(arc, s) - 1, 0, len(steps) - 1)
        h, a, b = steps[i], arc[i + 1] - s, s - arc[i]
        bent = (bends[i] * a**3 + bends[i + 1] * b**3) / (6 * h)
        return bent + (points[i] / h - bends[i] * h / 6) * a \
            + (points[i + 1] / h - bends[i + 1] * h / 6) * b

    fine = numpy.linspace(0, arc[-1], 100 * len(arc))
    lengths = numpy.linalg.norm(numpy.diff([at(s) for s in fine], axis=0), axis=1)
    passed = numpy.concatenate([[0], numpy.cumsum(lengths)])
    return lambda fraction: at(numpy.interp(fraction * passed[-1], passed, fine)), passed[-1]


def _sections(path):
    """Places and sections of a blade's file."""
    rows = path.read_text(encoding="utf-8", errors="replace").splitlines()
    count = int(_value(path, rows, "station_total"))
    kind = int(_value(path, rows, "damp_type"))
    if kind not in (0, 1):
        raise Error(f"{path}: expected damp_type 0 or 1, got {kind}")
    start = next(i for i, row in enumerate(rows) if row.split()[:1] == ["mu1"]) + 2
    seconds = _table(path, rows[start:start + 1], 6)[0]
    first = next(i for i, row in enumerate(rows) if "distributed properties" in row.lower()) + 1
    numbers = numpy.array([_number(path, word) for row in rows[first:] for word in row.split()])
    if len(numbers) != 73 * count:
        raise Error(f"{path}: expected {count} stations of 73 numbers, got {len(numbers)} numbers")
    numbers = numbers.reshape(count, 73)
    return numbers[:, 0], [_section(row, seconds if kind else None) for row in numbers]


def _section(numbers, seconds):
    """A section of a place, stiffness and mass."""
    stiffness, mass = (m.reshape(6, 6)[numpy.ix_(ORDER, ORDER)]
                       for m in (numbers[1:37], numbers[37:73]))
    section = Section(stiffness=stiffness, mass=mass)
    if seconds is not None:
        section.set_component_damping(seconds[ORDER])
    return section


def _value(path, rows, name):
    """The value in front of a name."""
    for row in rows:
        words = row.split()
        if len(words) > 1 and words[1] == name:
            return words[0]
    raise Error(f"{path}: expected a line with {name}, found none")


def _number(path, word):
    try:
        return float(word.replace("D", "E").replace("d", "e"))
    except ValueError:
        raise Error(f"{path}: expected a number, got {word}") from None


def _table(path, rows, columns):
    """Rows of numbers."""
    rows = [[_number(path, word) for word in row.split()[:columns]] for row in rows]
    if any(len(row) != columns for row in rows):
        raise Error(f"{path}: expected rows of {columns} numbers")
    return numpy.array(rows)
