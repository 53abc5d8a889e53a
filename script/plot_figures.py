#!/usr/bin/env python3
"""Draws figures of Han & Bauchau (2018) from the CSV files that script/figures makes in
DIRECTORY."""

import argparse
import csv
import math
import pathlib

import matplotlib

matplotlib.use("Agg")  # no display needed
import matplotlib.pyplot as plt

# Distinct also in grey and to the colour-blind (Okabe and Ito's colours).
STYLES = [("#E69F00", "o"), ("#56B4E9", "s"), ("#009E73", "^"), ("#CC79A7", "D"), ("#D55E00", "*"),
          ("#0072B2", "v")]
TAUS = [("0.05", "T/20"), ("0.10", "T/10"), ("0.15", "3T/20"), ("0.20", "T/5"), ("0.25", "T/4"),
        ("0.30", "3T/10")]
SPATIAL = [3, 5, 7, 11, 21]
PLANAR = [5, 7, 11, 15, 21]


def read(path):
    """The columns of a CSV file of numbers, by name."""
    with open(path, newline="") as file:
        names, *rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}


def figure(number, label_x, label_y):
    """A new drawing in the style of all of them."""
    drawing, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    axes.set_xlabel(label_x)
    axes.set_ylabel(label_y)
    axes.set_title(f"Figure {number}", loc="left", fontsize=11)
    axes.grid(True, color="#e4e4e4", linewidth=0.8)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return drawing, axes


def finish(directory, number, drawing, axes, period=None, turns=1):
    """Legend, ticks in parts of the period, file."""
    if period:
        parts = 4 if turns == 1 else turns
        ticks = [turns * period * k / parts for k in range(parts + 1)]
        names = (
            ["0", "T/4", "T/2", "3T/4", "T"]
            if turns == 1
            else ["0", "T"] + [f"{k}T" for k in range(2, turns + 1)]
        )
        axes.set_xticks(ticks, names)
        axes.set_xlim(0, turns * period)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False, fontsize=9, ncols=2)
    path = directory / f"figure_{number:02}.png"
    drawing.savefig(path, dpi=110)
    plt.close(drawing)
    print(f"wrote {path}")


def over_period(directory, number, column, label, cases, scale=1.0, limits=None):
    """One curve for each case (name, style, columns) over a period."""
    drawing, axes = figure(number, "Time", label)
    period = 0
    for name, (colour, marker), columns in cases:
        t, values = columns["t"], [scale * value for value in columns[column]]
        period = t[-1]
        every = max(1, len(t) // 24)
        axes.plot(
            t,
            values,
            color=colour,
            marker=marker,
            markevery=every,
            markersize=4,
            linewidth=1.2,
            label=name,
        )
    if limits:
        axes.set_ylim(limits)
    finish(directory, number, drawing, axes, period)


def interpolation(directory):
    """Figure 3: errors of rotation and angular velocity."""
    errors = read(directory / "interpolation.csv")
    drawing, axes = figure(3, "Number of grid points N", "Error")
    axes.loglog(errors["N"], errors["e_R"], "o-", color="#0072B2", label="rotation, $e_R$")
    axes.loglog(
        errors["N"], errors["e_omega"], "^-", color="#D55E00", label="angular velocity, $e_\\omega$"
    )
    finish(directory, 3, drawing, axes)


def damped(directory):
    """Figures 5 and 6: vibration of bar 2 after a start from rest, with the last turn enlarged."""
    for number, column, label in [
        (5, "u2_B", "Displacement of B across bar 1 [ft]"),
        (6, "theta2", "Angle $\\theta_2$ [rad]"),
    ]:
        drawing, axes = figure(number, "Time", label)
        inset = axes.inset_axes([0.52, 0.66, 0.46, 0.32])
        period = 2 * math.pi / 50
        for (name, title), (colour, _) in zip(TAUS, STYLES):
            columns = read(directory / f"damped_{name}.csv")
            axes.plot(
                columns["t"],
                columns[column],
                color=colour,
                linewidth=1.1,
                label=f"$\\tau_b$ = {title}",
            )
            late = [i for i, t in enumerate(columns["t"]) if t >= 7 * period]
            inset.plot(
                [columns["t"][i] for i in late],
                [columns[column][i] for i in late],
                color=colour,
                linewidth=0.9,
            )
        inset.set_xticks([7 * period, 8 * period], ["7T", "8T"])
        inset.tick_params(labelsize=7)
        bottom, top = axes.get_ylim()
        axes.set_ylim(bottom, top + 0.9 * (top - bottom))
        axes.legend(loc="upper left", ncols=2, frameon=False, fontsize=8)
        period_ticks = [k * period for k in range(9)]
        axes.set_xticks(period_ticks, ["0", "T"] + [f"{k}T" for k in range(2, 9)])
        axes.set_xlim(0, 8 * period)
        path = directory / f"figure_{number:02}.png"
        drawing.savefig(path, dpi=110)
        plt.close(drawing)
        print(f"wrote {path}")


def spatial(directory):
    """Figures 8 to 10."""
    cases = [
        (f"N = {n}", style, read(directory / f"spatial_{n}.csv"))
        for n, style in zip(SPATIAL, STYLES)
    ]
    over_period(directory, 8, "x3_B", "$x_3$ of B [m]", cases)
    over_period(directory, 9, "v3_B", "$v_3$ of B [m/s]", cases)
    over_period(directory, 10, "torque_D", "Driving torque at D [N m]", cases)


def planar(directory):
    """Figures 12 to 16."""
    cases = [("marching", ("#202020", None), read(directory / "planar_march.csv"))]
    cases += [
        (f"N = {n}", style, read(directory / f"planar_{n}.csv")) for n, style in zip(PLANAR, STYLES)
    ]
    over_period(directory, 12, "u1_C", "$u_1$ of C [m]", cases)
    over_period(
        directory, 13, "phi_C", "$\\varphi$ of bar 2 at C [deg]", cases, scale=180 / math.pi
    )
    over_period(directory, 14, "theta_D", "Relative rotation $\\theta$ at D [rad]", cases)
    # As far as the paper's: marching goes on to -5.5 kN and -6 kN.
    over_period(directory, 15, "F1", "Axial force $F_1$ [N]", cases, limits=(-1000, 250))
    over_period(directory, 16, "M2", "Bending moment $M_2$ [N m]", cases)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", type=pathlib.Path)
    directory = parser.parse_args().directory
    interpolation(directory)
    damped(directory)
    spatial(directory)
    planar(directory)


if __name__ == "__main__":
    main()
