#!/usr/bin/env python3
"""Draws the spatial four-bar's response on several grids, like figures 8 to 10 of Han & Bauchau
(2018).

Reads DIRECTORY/spatial_four_bar_N.csv (columns t, x3_B, v3_B, torque_D over one period) for each N,
writes DIRECTORY/spatial_four_bar.png.
"""

import argparse
import csv
import math
import pathlib

import matplotlib

matplotlib.use("Agg")  # no display needed
import matplotlib.pyplot as plt

PANELS = [
    ("x3_B", "Position of B\n$x_3$ [m]"),
    ("v3_B", "Velocity of B\n$v_3$ [m/s]"),
    ("torque_D", "Driving torque at D\n$M$ [N·m]"),
]
# Coarse to fine: distinct also in grey and to the colour-blind (Okabe and Ito's colours).
COLOURS = ["#E69F00", "#56B4E9", "#009E73", "#CC79A7", "#D55E00", "#0072B2"]
MARKERS = ["o", "s", "^", "D", "v", "P"]
FINEST = "#202020"


def read_curves(path):
    """The columns of a CSV file as {name: list of floats}; complains about what cannot be drawn."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    names = ["t"] + [name for name, _ in PANELS]
    if not rows or rows[0] != names:
        raise ValueError(f"{path}: expected the header {','.join(names)}")
    if len(rows) < 3:
        raise ValueError(f"{path}: expected at least two rows of numbers, got {len(rows) - 1}")
    columns = {name: [] for name in names}
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(names):
            raise ValueError(
                f"{path}, line {number}: expected {len(names)} numbers, got {len(row)}"
            )
        for name, text in zip(names, row):
            value = float(text)
            if not math.isfinite(value):
                raise ValueError(f"{path}, line {number}: {name} is {text}")
            columns[name].append(value)
    if any(b <= a for a, b in zip(columns["t"], columns["t"][1:])):
        raise ValueError(f"{path}: times do not increase")
    return columns


def value_at(times, values, t):
    """Linear interpolation; only places markers on a curve that is drawn by straight lines too."""
    for i in range(len(times) - 1):
        if t <= times[i + 1]:
            share = (t - times[i]) / (times[i + 1] - times[i])
            return values[i] + share * (values[i + 1] - values[i])
    return values[-1]


def draw(curves, path):
    """Draws {N: columns} to an image file, a marker on each grid point t_k = kT/N."""
    grids = sorted(curves)
    start, end = curves[grids[-1]]["t"][0], curves[grids[-1]]["t"][-1]
    period = end - start
    plt.rcParams.update({"font.size": 11, "axes.labelsize": 11, "mathtext.fontset": "dejavusans"})
    figure, axes = plt.subplots(3, 1, figsize=(7.2, 9.2), sharex=True)

    for axis, (column, label) in zip(axes, PANELS):
        for order, n in enumerate(grids):
            times, values = curves[n]["t"], curves[n][column]
            finest = n == grids[-1]
            colour = FINEST if finest else COLOURS[order % len(COLOURS)]
            marks = [start + k * period / n for k in range(n + 1)]
            # The finest goes below, so that coarser grids show where they leave it.
            depth = 2 if finest else 3 + len(grids) - order
            axis.plot(times, values, color=colour, linewidth=2.2 if finest else 1.4, zorder=depth)
            axis.plot(
                marks,
                [value_at(times, values, t) for t in marks],
                linestyle="none",
                marker="*" if finest else MARKERS[order % len(MARKERS)],
                markersize=8 if finest else 6,
                markerfacecolor=colour if finest else "white",
                markeredgecolor=colour,
                markeredgewidth=0.6 if finest else 1.3,
                zorder=depth + 0.5,
                clip_on=False,
            )
        axis.set_ylabel(label)
        axis.margins(x=0, y=0.08)
        axis.grid(True, color="#e4e4e4", linewidth=0.8)
        axis.set_axisbelow(True)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)

    axes[-1].set_xlim(start, end)
    axes[-1].set_xticks([start + k * period / 4 for k in range(5)])
    axes[-1].set_xticklabels(["0", "T/4", "T/2", "3T/4", "T"])
    axes[-1].set_xlabel("Time")
    figure.align_ylabels(axes)
    figure.suptitle("Flexible spatial four-bar mechanism: periodic response on N grid points",
                    fontsize=12.5, y=0.988)
    figure.legend(handles=legend_handles(grids), loc="upper center", bbox_to_anchor=(0.5, 0.965),
                  ncol=len(grids), frameon=False, handlelength=2.2, columnspacing=1.6)
    figure.subplots_adjust(left=0.17, right=0.97, bottom=0.06, top=0.91, hspace=0.12)
    figure.savefig(path, dpi=160)
    plt.close(figure)


def legend_handles(grids):
    """One line with its marker for each grid, as drawn."""
    handles = []
    for order, n in enumerate(grids):
        finest = n == grids[-1]
        colour = FINEST if finest else COLOURS[order % len(COLOURS)]
        handles.append(plt.Line2D(
            [], [], color=colour, linewidth=2.2 if finest else 1.4,
            marker="*" if finest else MARKERS[order % len(MARKERS)],
            markersize=9 if finest else 6.5, markeredgecolor=colour,
            markerfacecolor=colour if finest else "white", label=f"N = {n}"))
    return handles


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "directory", type=pathlib.Path, help="where the CSV files are, and the image goes"
    )
    parser.add_argument("grid", type=int, nargs="+", help="numbers of grid points N")
    arguments = parser.parse_args()
    name = "spatial_four_bar"
    curves = {n: read_curves(arguments.directory / f"{name}_{n}.csv") for n in arguments.grid}
    image = arguments.directory / f"{name}.png"
    draw(curves, image)
    print(f"wrote {image}")


if __name__ == "__main__":
    main()
