#!/usr/bin/env python3
"""Draws the columns of CSV files against their first column: a panel for each, a curve for each
file. Of branches, which have a column "event", those of the motions only, with events marked; with
a column "stability", parts that are not stable are dotted.

    script/plot.py output/rotor_blade.csv output/rotor_blade.png
    script/plot.py output/rigid.csv output/flexible.csv output/both.png

Names of the columns are the labels; all files must have the same. With --group, columns of the
same name but for a number at its end share a panel, and are drawn as points:

    script/plot.py --group output/stability.csv output/stability.png

Charts of exponents along a branch, which have a column "content", are drawn as points, by what
moves in each mode; over a frequency with lines of its multiples:

    script/plot.py output/chart.csv output/chart.png
"""

import argparse
import csv
import pathlib

import matplotlib

matplotlib.use("Agg")  # no display needed
import matplotlib.pyplot as plt

# Columns of a branch that tell of its steps.
STEPS = {"slope", "step", "angle", "grid_points", "outside", "largest_multiplier"}
# Distinct also in grey and to the colour-blind (Okabe and Ito's colours).
STYLES = [("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", "-."), ("#CC79A7", ":")]
MARKERS = ["o", "^", "v", "s", "D", "P", "X"]


def read_columns(path):
    """Names and columns of a CSV file of numbers, events, and what is told of stability; complains
    about what cannot be drawn."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if len(rows) < 3 or len(rows[0]) < 2:
        raise ValueError(
            f"{path}: expected a line of names and lines of numbers, two columns at least"
        )
    for number, row in enumerate(rows, start=1):
        if len(row) != len(rows[0]):
            raise ValueError(
                f"{path}, line {number}: expected {len(rows[0])} columns, got {len(row)}"
            )
    names, columns, events, stability = [], [], [], []
    for name, column in zip(rows[0], zip(*rows[1:])):
        if name == "event":
            events = [(row, text) for row, text in enumerate(column) if text]
        elif name == "stability" and "event" in rows[0]:
            stability = list(column)
        elif "event" not in rows[0] or name not in STEPS:
            names.append(name)
            columns.append([float(text) for text in column])
    return names, columns, events, stability


def read_chart(path):
    """Lines of a chart of exponents as dictionaries, and the parameter's name; None of others."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    if not rows or not {"content", "growth", "frequency_from_ground"} <= set(rows[0]):
        return None
    if len(rows) < 2:
        raise ValueError(f"{path}: expected lines of exponents behind that of names")
    names = ["parameter", *rows[0][1:]]
    lines = []
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(names):
            raise ValueError(
                f"{path}, line {number}: expected {len(names)} columns, got {len(row)}"
            )
        line = dict(zip(names, row))
        lines.append({name: text if name == "content" else float(text)
                      for name, text in line.items()})
    return lines, rows[0][0]


def draw_chart(lines, parameter, image):
    """Draws frequencies, from the ground, and rates of growth over the parameter."""
    figure, axes = plt.subplots(2, 1, figsize=(7.2, 6.4), sharex=True, layout="constrained",
                                height_ratios=[3, 2])
    contents = sorted({line["content"] for line in lines})
    for i, content in enumerate(contents):
        of_it = [line for line in lines if line["content"] == content]
        # Those that grow are filled.
        for grows in (True, False):
            some = [line for line in of_it if (line["growth"] > 0) == grows]
            colour = STYLES[i % len(STYLES)][0]
            style = {"linestyle": "", "marker": MARKERS[i % len(MARKERS)], "markersize": 4.5,
                     "color": colour, "markerfacecolor": colour if grows else "none"}
            for axis, name in zip(axes, ("frequency_from_ground", "growth")):
                axis.plot([line["parameter"] for line in some], [line[name] for line in some],
                          **style)
        axes[0].plot([], [], linestyle="", marker=MARKERS[i % len(MARKERS)], markersize=4.5,
                     color=STYLES[i % len(STYLES)][0], markerfacecolor="none", label=content)
    values = [line["parameter"] for line in lines]
    top = max(line["frequency_from_ground"] for line in lines)
    ends = [min(values), max(values)]
    if parameter == "frequency":
        multiple = 1
        while multiple * ends[0] < top and multiple <= 6:
            axes[0].plot(ends, [multiple * end for end in ends], color="#b0b0b0", linewidth=0.8)
            multiple += 1
        axes[0].set_ylim(0, 1.05 * top)
    axes[1].axhline(0, color="#808080", linewidth=0.8)
    for axis, title in zip(axes, ("frequency from the ground", "rate of growth")):
        axis.set_title(title, loc="left", fontsize=10.5)
        axis.grid(True, color="#e4e4e4", linewidth=0.8)
        axis.spines[["top", "right"]].set_visible(False)
    axes[1].set_xlabel(parameter)
    axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=len(contents), frameon=False,
                   fontsize=8.5)
    figure.savefig(image, dpi=160)
    plt.close(figure)


def panels_of(names, group):
    """Titles of panels, each with the numbers of its columns."""
    panels = {}
    for i, name in enumerate(names[1:], start=1):
        stem, _, end = name.rpartition(" ")
        title = stem if group and end.isdigit() else name
        panels.setdefault(title, []).append(i)
    return panels


def parts_of(count, events, stability):
    """Ranges of rows that are drawn as one line, each with whether it is stable. At events a
    multiplier is on the unit circle: they belong to what is on both sides."""
    told = [verdict == "stable" for verdict in stability] or [True] * count
    parts, marked = [], {row for row, _ in events}
    for row in range(count - 1):
        ends = [end for end in (row, row + 1) if end not in marked]
        stable = all(told[end] for end in ends) if ends else parts[-1][2] if parts else True
        if parts and parts[-1][2] == stable:
            parts[-1][1] = row + 2
        else:
            parts.append([row, row + 2, stable])
    return parts


def draw(files, image, group=False):
    """Draws {label: (names, columns, events, stability)} to an image file."""
    names = next(iter(files.values()))[0]
    for label, (others, *_) in files.items():
        if others != names:
            raise ValueError(f"{label}: its columns are {others}, not {names}")
    panels = panels_of(names, group)
    figure, axes = plt.subplots(len(panels), 1, figsize=(7.2, 0.8 + 1.7 * len(panels)), sharex=True,
                                squeeze=False, layout="constrained")
    for axis, (name, members) in zip(axes[:, 0], panels.items()):
        for (label, (_, columns, events, stability)), (colour, line) in zip(files.items(), STYLES):
            for i in members:
                style = {"linestyle": "", "marker": "."} if group else {"linestyle": line}
                label_once = label if i == members[0] else None
                for first, end, stable in parts_of(len(columns[0]), events, stability):
                    dotted = {} if stable or group else {"linestyle": ":"}
                    axis.plot(columns[0][first:end], columns[i][first:end], color=colour,
                              linewidth=1.8, label=label_once, **{**style, **dotted})
                    label_once = None
                for row, event in events:
                    at = (columns[0][row], columns[i][row])
                    axis.plot(*at, "o", color=colour, markersize=4)
                    axis.annotate(event, at, xytext=(4, 4), textcoords="offset points", fontsize=8)
        axis.set_title(name, loc="left", fontsize=10.5)
        axis.margins(x=0)
        axis.grid(True, color="#e4e4e4", linewidth=0.8)
        axis.spines[["top", "right"]].set_visible(False)
    axes[-1, 0].set_xlabel(names[0])
    if len(files) > 1:
        axes[0, 0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=len(files), frameon=False)
    figure.savefig(image, dpi=160)
    plt.close(figure)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("csv", type=pathlib.Path, nargs="+", help="at most four files")
    parser.add_argument("image", type=pathlib.Path, help="where the picture goes")
    parser.add_argument("--group", action="store_true", help="columns of one name in one panel")
    arguments = parser.parse_args()
    if len(arguments.csv) > len(STYLES):
        parser.error(f"at most {len(STYLES)} CSV files")
    chart = read_chart(arguments.csv[0]) if len(arguments.csv) == 1 else None
    if chart:
        draw_chart(*chart, arguments.image)
        print(f"wrote {arguments.image}")
        return
    draw({path.stem: read_columns(path) for path in arguments.csv}, arguments.image,
         arguments.group)
    print(f"wrote {arguments.image}")


if __name__ == "__main__":
    main()
