#!/usr/bin/env python3
"""The model of costs of docs/cluster.md: constants from what petsc/costs.c measured, how far they
tell what was measured, and what they predict for more ranks.

    costs.py show [DATA]         constants, comparison with runs, predictions, as tables
    costs.py draw FILE [DATA]    predictions as a picture
    costs.py check               bytes and messages of the lines `send` on stdin are those of the
                                 model; fails where they are not

DATA is costs.txt beside this file unless given.
"""

import math
import pathlib
import sys

# Of the rotor of costs.c, with beams of degree 3.
NODES_OF_ELEMENT = 3
# Pairs of coupled nodes for each node, and numbers of a pair's means.
PAIRS, MEANS = 5, 144
# Numbers at a grid point that a rank sends of its halo, at most: nodes and stations at two cuts.
HALO = 6 * (2 * NODES_OF_ELEMENT + 2)
# Harmonics that are factored and solved for side by side.
LANES = 8
# Own unknowns of the rotor's joints, which are averaged with the motions.
OWN = 24
# Linear solves of an iteration: the increment, and the simplified one after it.
SOLVES = 2

# Assumed of a cluster: InfiniBand HDR100, 100 Gbit/s a node for 16 ranks on it; messages of MPI
# take 2 microseconds.
LATENCY, BANDWIDTH = 2e-6, 12.5e9 / 16

# Elements of a blade and grid points of what is predicted.
MODELS = {
    "rotor, 3.0e6": (445, 63),
    "rotor, 1.0e7": (1480, 63),
    "many harmonics, 1.0e8": (3630, 255),
}
RANKS = [2**i for i in range(11)]
ITERATIONS, PRODUCTS = 6, 81


def nodes_of(elements):
    return 1 + 3 * (NODES_OF_ELEMENT * elements + 1)


def unknowns_of(elements, points):
    """Motions and stress resultants, three stations an element."""
    return 6 * points * (nodes_of(elements) + 9 * elements)


def chunks(points, ranks):
    """Bundles of harmonics that the rank with most of them has."""
    harmonics = (points + 1) // 2
    return math.ceil(math.ceil(harmonics / ranks) / LANES)


def bytes_and_messages(part, nodes, points, ranks):
    """What the rank that sends most sends in this part: as rows are its nodes, as columns its
    harmonics, which others have the rows of."""
    harmonics = (points + 1) // 2
    others = ranks - 1
    if part in ("residual", "linearise"):  # that nothing has failed
        return 8 * others, others
    halo = 8 * HALO * points
    neighbours = min(3, others)  # of the hub's
    if part == "product":
        return halo, neighbours
    own = nodes / ranks
    rows, columns = 6 * own + OWN, math.ceil(harmonics / ranks)
    there = 16 * rows * (harmonics - columns)
    back = 16 * columns * (6 * nodes + OWN - rows)
    if part == "precondition":
        return 2 * halo + there + back, 2 * neighbours + 2 * min(others, harmonics)
    assert part == "factor"
    once = bytes_and_messages("precondition", nodes, points, ranks)
    return 8 * PAIRS * MEANS * own * others + once[0], None


def read(path):
    lines = [line.split() for line in path.read_text().splitlines() if line[:1] != "#"]
    return [[word if i < 2 and not word.isdigit() else float(word) for i, word in enumerate(line)]
            for line in lines]


def least_squares(rows, values):
    """Coefficients that leave the least relative errors, and the largest of these."""
    import numpy as np

    rows, values = np.array(rows), np.array(values)
    weighted = rows / values[:, None]
    found, *_ = np.linalg.lstsq(weighted, np.ones(len(values)), rcond=None)
    return found, float(abs(weighted @ found - 1).max())


def constants(lines):
    """Seconds: of a node and grid point (`point`), of a node and bundle of harmonics (`bundle`), of
    a node (`node`); of a number of a vector; of messages."""
    found, errors = {}, {}
    shapes = {
        "residual": ["point"], "linearise": ["point"], "product": ["point"],
        "precondition": ["point", "bundle"], "factor": ["point", "bundle", "node"],
        "make": ["point", "node"],
    }
    for part, shape in shapes.items():
        # Small grids are in the cache.
        of_part = [(n, grid, s) for _, name, n, grid, s in (x for x in lines if x[0] == "time")
                   if name == part and grid >= 7]
        terms = {"point": lambda n, grid: n * grid, "bundle": lambda n, grid: n * chunks(grid, 1),
                 "node": lambda n, _: n}
        rows = [[terms[name](n, grid) for name in shape] for n, grid, _ in of_part]
        values, errors[part] = least_squares(rows, [s for *_, s in of_part])
        found.update({(part, name): value for name, value in zip(shape, values)})
    vectors = min(s / n for _, name, n, _, s in (x for x in lines if x[0] == "time")
                  if name == "vectors")
    found["vectors"] = vectors
    links = [(n, s) for kind, _, n, s in (x for x in lines if x[0] == "link")]
    found["latency"], found["bandwidth"] = links[0][1], max(n / s for n, s in links)
    # What the first run on one rank says of what is not measured apart.
    run = next(x for x in lines if x[0] == "run" and x[3] == 1)
    elements, points = run[1], run[2]
    nodes, unknowns = nodes_of(elements), unknowns_of(elements, points)
    found["start"] = run[7] / nodes
    found["passes"] = 0.0
    left = run[10] - run[5] * product_time(found, nodes, points, 1, (0.0, math.inf))
    found["passes"] = left / run[5] / (vectors * unknowns)
    found["rest"] = 0.0
    found["rest"] = (run[6] - sum(times(found, elements, points, 1).values())) / (nodes * points)
    return found, errors


def product_time(c, nodes, points, ranks, network):
    """Seconds of a product, its preconditioner and what GMRES does with it."""
    latency, bandwidth = network
    own = nodes / ranks * points
    time = own * (c["product", "point"] + c["precondition", "point"])
    time += nodes * chunks(points, ranks) * c["precondition", "bundle"]
    # As many unknowns of stress resultants as of motions.
    time += c["passes"] * c["vectors"] * 12 * own
    if ranks > 1:
        for part in ("product", "precondition"):
            numbers, messages = bytes_and_messages(part, nodes, points, ranks)
            time += numbers / bandwidth + messages * latency
        time += 2 * 2 * math.log2(ranks) * latency  # two sums over all ranks
    return time


def times(c, elements, points, ranks, network=None):
    """Seconds of a solve, of its parts."""
    latency, bandwidth = network or (c["latency"], c["bandwidth"])
    nodes = nodes_of(elements)
    own = nodes / ranks * points
    evaluated = own + (2 * NODES_OF_ELEMENT * points if ranks > 1 else 0)
    factor = own * c["factor", "point"] + nodes * c["factor", "node"]
    factor += nodes * chunks(points, ranks) * c["factor", "bundle"]
    if ranks > 1:
        factor += 8 * PAIRS * MEANS * nodes / bandwidth + ranks * latency
    of_product = product_time(c, nodes, points, ranks, (latency, bandwidth))
    return {
        "start": c["start"] * nodes,
        "make": c["make", "node"] * nodes + c["make", "point"] * evaluated,
        "linearisations": ITERATIONS * evaluated * c["linearise", "point"],
        "residuals": (ITERATIONS + 1) * evaluated * c["residual", "point"],
        "factors": ITERATIONS * factor,
        "solves": PRODUCTS * of_product,
        "rest": c["rest"] * own,
    }


def show(lines):
    c, errors = constants(lines)
    print("| constant | value | largest deviation of what was measured |\n|---|---|---|")
    for (part, name), value in ((k, v) for k, v in c.items() if isinstance(k, tuple)):
        of = "a node" if name == "node" else f"a node and {name}"
        error = f"{100 * errors[part]:.0f} %"
        print(f"| {part}, of {of} | {1e6 * value:.3g} µs | {error} |")
    print(f"| start on 5 points, of a node | {1e6 * c['start']:.3g} µs | |")
    print(f"| y += a x and x · y, of a number | {1e9 * c['vectors']:.3g} ns | |")
    print(f"| such passes in a product | {c['passes']:.0f} | |")
    print(f"| a message between two ranks here | {1e6 * c['latency']:.2g} µs, "
          f"{c['bandwidth'] / 1e9:.1f} GB/s | |")
    print("\n| run | measured | model | deviation | start, linearisations, factors, solves "
          "| model |\n|---|---|---|---|---|---|")
    for run in (x for x in lines if x[0] == "run"):
        _, elements, points, ranks, _, _, total, start, linearised, factored, solved, _ = run
        parts = times(c, elements, points, int(ranks))
        model = sum(parts.values())
        of_parts = [parts[name] for name in ("start", "linearisations", "factors", "solves")]
        measured = [start, linearised, factored, solved]
        in_words = [", ".join(f"{x:.1f}" for x in both) for both in (measured, of_parts)]
        print(f"| {unknowns_of(elements, points):.3g}, {ranks:.0f} ranks | {total:.1f} s | "
              f"{model:.1f} s | {100 * (model / total - 1):+.0f} % | {in_words[0]} | {in_words[1]} |")
    print("\nSeconds, without the start, and how much faster that is than on one rank:\n")
    print("| ranks |" + "".join(f" {name} |" for name in MODELS))
    print("|---|" + "---|" * len(MODELS))
    for ranks in RANKS:
        row = []
        for elements, points in MODELS.values():
            parts, alone = (times(c, elements, points, p, (LATENCY, BANDWIDTH)) for p in (ranks, 1))
            all_parts = sum(parts.values())
            without = all_parts - parts["start"]
            speed = (sum(alone.values()) - alone["start"]) / without
            row.append(f"{all_parts:.3g} s, {without:.3g} s, {speed:.3g}")
        print(f"| {ranks} | " + " | ".join(row) + " |")


def draw(lines, path):
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "periodyn"
    from matplotlib import pyplot

    c, _ = constants(lines)
    figure, axes = pyplot.subplots(figsize=(7, 4.5))
    for (name, (elements, points)), colour in zip(MODELS.items(), ("C0", "C1", "C2")):
        of_ranks = [times(c, elements, points, p, (LATENCY, BANDWIDTH)) for p in RANKS]
        without = [sum(parts.values()) - parts["start"] for parts in of_ranks]
        axes.loglog(RANKS, without, colour, marker="o", markersize=3, label=f"{name} unknowns")
        axes.loglog(RANKS, [without[0] / p for p in RANKS], colour, linestyle=":", linewidth=1)
    runs = [x for x in lines if x[0] == "run"]
    axes.loglog([x[3] for x in runs], [x[6] - x[7] for x in runs], "k+", label="measured")
    axes.set(xlabel="ranks", ylabel="seconds, without the start")
    axes.set_xticks(RANKS, RANKS)
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def check(lines):
    """Whether lines are as the model has them."""
    wrong = []
    for _, part, ranks, nodes, points, sent, messages in lines:
        ranks, points = int(ranks), int(points)
        model, model_messages = bytes_and_messages(part, nodes, points, ranks)
        print(f"{part} on {ranks} ranks: {sent:.0f} bytes, model {model:.0f}; "
              f"{messages:.0f} messages")
        # Halos, two of them with the preconditioner, are at most as large, and at least half of
        # that; nodes, harmonics and means are not divided quite evenly.
        least, most = {"product": (1, 2.01), "precondition": (0.95, 1.2)}.get(part, (0.9, 1.1))
        if not least * sent <= model <= most * sent:
            wrong.append(f"{part}: {sent:.0f} bytes on {ranks} ranks, the model says {model:.0f}")
        if model_messages is not None and messages > model_messages:
            wrong.append(f"{part}: {messages:.0f} messages on {ranks} ranks, the model says "
                         f"{model_messages}")
    if not lines or wrong:
        sys.exit("\n".join(wrong or ["nothing was sent"]))


def main():
    what, *rest = sys.argv[1:] or ["help"]
    if what == "check":
        check([[word if i < 2 else float(word) for i, word in enumerate(line.split())]
               for line in sys.stdin if line.startswith("send ")])
        return
    files = rest[1:] if what == "draw" else rest
    lines = read(pathlib.Path(files[0]) if files else pathlib.Path(__file__).with_suffix(".txt"))
    if what == "show":
        show(lines)
    elif what == "draw" and rest:
        draw(lines, rest[0])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
