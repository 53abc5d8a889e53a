#!/usr/bin/env python3
"""Tables and pictures of what the benchmarks wrote.

    script/bench_report.py build/bench [docs/performance.md]

Writes DIRECTORY/report.md and DIRECTORY/*.png. With a page, also replaces its tables, each between
the lines `<!-- table NAME -->` or `<!-- picture NAME -->` and `<!-- end -->`, and draws its
pictures in the directory images/ beside it.
"""

import argparse
import csv
import math
import pathlib
import platform
import re

import matplotlib

matplotlib.use("Agg")  # no display needed
import matplotlib.pyplot as plt

# Okabe and Ito's colours, with a marker each.
STYLES = [("#0072B2", "o"), ("#D55E00", "s"), ("#009E73", "^"), ("#CC79A7", "D"), ("#000000", "v")]
METHODS = ["collocation", "adaptive", "shooting", "marching", "Exudyn"]
PICTURES = {"performance_accuracy": "Error against time",
            "performance_scaling": "Time and memory against unknowns",
            "performance_sharp": "Error against grid points"}
TOLERANCES = [1e-3, 1e-4, 1e-5]


def read(directory, name):
    """Rows of a CSV file; none if it is not there."""
    path = directory / f"{name}.csv"
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def markdown(titles, rows):
    """A table; numbers to the right."""
    lines = ["| " + " | ".join(titles) + " |"]
    numeric = [
        all(re.match(r"^([-−+\d.]|$)", str(row[i])) for row in rows) for i in range(len(titles))
    ]
    lines.append("|" + "|".join("---:" if n else "---" for n in numeric) + "|")
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def plain(rows, leave_out=()):
    """A table of all columns."""
    if not rows:
        return "(not measured)"
    titles = [title for title in rows[0] if title not in leave_out]
    return markdown(titles, [[row[title].replace("NaN", "") for title in titles] for row in rows])


def shown(seconds):
    """A time with its unit."""
    return f"{1e3 * seconds:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"


def machine_table(directory):
    """The machine, as it calls itself and as measured."""
    name = platform.processor() or platform.machine()
    information = pathlib.Path("/proc/cpuinfo")
    if information.exists():
        models = re.findall(r"model name\s*: (.*)", information.read_text())
        name = f"{models[0]}, {len(models)} cores" if models else name
    rows = [["processor", name, ""]]
    rows += [[row["quantity"], row["value"], row["unit"]] for row in read(directory, "machine")]
    return markdown(["", "", ""], rows)


def accuracy(directory):
    """(seconds, error, what) of each model and method."""
    found = {}
    for row in read(directory, "accuracy") + read(directory, "accuracy_exudyn"):
        of_model = found.setdefault(row["model"], {method: [] for method in METHODS})
        what = row["parameter"] + (f"; {row['periods']} periods" if row["periods"] != "1" else "")
        of_model[row["method"]].append((float(row["seconds"]), float(row["error"]), what))
    return found


def cheapest(points, tolerance):
    """The quickest that is as exact as this."""
    return min((point for point in points if point[1] <= tolerance), default=None)


def accuracy_table(directory):
    """The quickest of each method for each tolerance, and how many times longer it takes than
    collocation."""
    rows = []
    for model, methods in accuracy(directory).items():
        for tolerance in TOLERANCES:
            ours = cheapest(methods["collocation"], tolerance)
            cells = [model, f"{tolerance:.0e}"]
            for method in METHODS:
                best = cheapest(methods[method], tolerance)
                if best is None:
                    cells.append("not reached" if methods[method] else "not measured")
                elif method == "collocation" or ours is None:
                    cells.append(f"{shown(best[0])} ({best[2]})")
                else:
                    cells.append(f"{shown(best[0])} ({best[2]}): {best[0] / ours[0]:.3g} ×")
            rows.append(cells)
    return markdown(["model", "error", *METHODS], rows) if rows else "(not measured)"


def style(axis):
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.grid(True, color="#e4e4e4", linewidth=0.8)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)


def draw_accuracy(directory, image):
    """Error against time: of each method what no other of its points betters."""
    found = accuracy(directory)
    if not found:
        return
    figure, axes = plt.subplots(
        1, len(found), figsize=(4.0 * len(found), 4.4), sharey=True, squeeze=False
    )
    for axis, (model, methods) in zip(axes[0], found.items()):
        for (method, points), (colour, marker) in zip(methods.items(), STYLES):
            front, least = [], math.inf
            for seconds, error, _ in sorted(points):
                if error < 0.97 * least:
                    front.append((seconds, error))
                    least = error
            if front:
                axis.plot(
                    *zip(*front),
                    "-",
                    marker=marker,
                    color=colour,
                    markersize=4.5,
                    linewidth=1.4,
                    markerfacecolor="white",
                    label=method if method == "Exudyn" else f"Periodyn, {method}",
                )
        style(axis)
        axis.set_title(model, loc="left", fontsize=10.5)
        axis.set_xlabel("time [s]")
        axis.set_ylim(1e-13, 3)
    axes[0, 0].set_ylabel("largest error, relative to the range")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=len(handles), frameon=False)
    figure.subplots_adjust(left=0.075, right=0.985, bottom=0.12, top=0.85, wspace=0.08)
    figure.savefig(image, dpi=130)
    plt.close(figure)


def draw_scaling(directory, image):
    """Time and memory against unknowns."""
    rows = read(directory, "scaling")
    if not rows:
        return
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
    exponents = {(row["series"], row["threads"]): row for row in read(directory, "exponents")}
    groups = list(dict.fromkeys((row["series"], row["threads"]) for row in rows))
    for axis, column, quantity in zip(axes, ("seconds", "MiB"), ("time", "memory")):
        names = list(dict.fromkeys(group[0] for group in groups))
        for group in groups:
            colour, marker = STYLES[names.index(group[0]) % len(STYLES)]
            points = [(float(row["unknowns"]), float(row[column])) for row in rows
                      if (row["series"], row["threads"]) == group]
            fit = exponents.get(group, {}).get(quantity, "")
            label = f"{group[0]}, {group[1]} thread{'s' if group[1] != '1' else ''}"
            label += f": exponent {fit}" if fit else ""
            axis.plot(
                *zip(*points),
                "-" if group[1] == "1" else "--",
                marker=marker,
                color=colour,
                markersize=5,
                linewidth=1.4,
                markerfacecolor="white",
                label=label,
            )
        style(axis)
        axis.set_xlabel("unknowns 6 n N")
        axis.legend(frameon=False, fontsize=8, loc="upper left")
        axis.set_ylim(top=axis.get_ylim()[1] * 30)
    axes[0].set_ylabel("time [s]")
    axes[1].set_ylabel("largest memory [MiB]")
    figure.savefig(image, dpi=130)
    plt.close(figure)


def draw_sharp(directory, image):
    """Errors of sharp motions against the number of grid points."""
    rows = read(directory, "sharp")
    if not rows:
        return
    models = list(dict.fromkeys(row["model"] for row in rows))
    figure, axes = plt.subplots(
        1, len(models), figsize=(4.0 * len(models), 4.0), squeeze=False, layout="constrained"
    )
    rates = {(row["model"], row["grid"]): row["rate"] for row in read(directory, "sharp_rates")}
    for axis, model in zip(axes[0], models):
        for grid, (colour, marker) in zip(("equispaced", "mapped"), STYLES):
            points = [(float(row["N"]), float(row["error"])) for row in rows
                      if (row["model"], row["grid"]) == (model, grid)
                      and row["error"] != "not converged"]
            axis.plot(
                *zip(*points),
                "-",
                marker=marker,
                color=colour,
                markersize=5,
                linewidth=1.4,
                markerfacecolor="white",
                label=f"{grid}: exp(−{rates[model, grid]} N)",
            )
        style(axis)
        axis.set_xscale("linear")
        axis.set_xlim(left=0)
        axis.set_title(model, loc="left", fontsize=10.5)
        axis.set_xlabel("grid points N")
        axis.legend(frameon=False, fontsize=9, loc="upper right")
    axes[0, 0].set_ylabel("largest error of positions [m]")
    figure.savefig(image, dpi=130)
    plt.close(figure)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path, nargs="?")
    arguments = parser.parse_args()
    directory = arguments.directory

    tables = {
        "machine": machine_table(directory),
        "accuracy": accuracy_table(directory),
        "floors": plain(read(directory, "floors")),
        "krylov": plain(read(directory, "krylov")),
        "multipliers": plain(read(directory, "multipliers")),
        "branches": plain(read(directory, "branches")),
        "sensitivities": plain(read(directory, "sensitivities")),
        "scaling": plain(read(directory, "scaling")),
        "exponents": plain(read(directory, "exponents")),
        "sharp": plain(read(directory, "sharp")),
        "sharp_rates": plain(read(directory, "sharp_rates")),
        "sharp_drawn": plain(read(directory, "sharp_drawn")),
    }
    report = "\n\n".join(f"## {name}\n\n{table}" for name, table in tables.items())
    (directory / "report.md").write_text(report + "\n", encoding="utf-8")
    places = [directory]
    if arguments.page:
        text = arguments.page.read_text(encoding="utf-8")
        for name, table in tables.items():
            pattern = rf"(<!-- table {name} -->\n).*?(<!-- end -->)"
            text = re.sub(
                pattern, lambda m, table=table: f"{m[1]}{table}\n{m[2]}", text, flags=re.DOTALL
            )
        for name, title in PICTURES.items():
            pattern = rf"(<!-- picture {name} -->\n).*?(<!-- end -->)"
            shown_there = f"![{title}](images/{name}.png)"
            text = re.sub(
                pattern, lambda m, line=shown_there: f"{m[1]}{line}\n{m[2]}", text, flags=re.DOTALL
            )
        arguments.page.write_text(text, encoding="utf-8")
        places.append(arguments.page.parent / "images")
    for place in places:
        draw_accuracy(directory, place / "performance_accuracy.png")
        draw_scaling(directory, place / "performance_scaling.png")
        draw_sharp(directory, place / "performance_sharp.png")
    print(report)


if __name__ == "__main__":
    main()
