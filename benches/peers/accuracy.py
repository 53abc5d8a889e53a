"""Error against time of Exudyn, for the models of benches/accuracy.rs, whose exact curves it
compares its own with.

    accuracy.py DIRECTORY [MODEL]...

Reads DIRECTORY/exact_*.csv and writes DIRECTORY/accuracy_exudyn.csv. Exudyn's errors are those of
its steps and of what has not died out of its start: they are measured against its own solution,
extrapolated from two steps, or against Periodyn's where both have the same discretisation; the
error of its mesh does not count. Its sparse solver and modified Newton's method are the quicker
choice here. Of each march the error of every period is found, and the time until its end. Times are
the processor's.
"""

import csv
import pathlib
import sys

import exudyn as exu
import numpy as np

import exudyn_models

# Number of elements; steps to a period; the two of them for the reference, the second half as long,
# or none where the discretisation is that of Periodyn; periods; spectral radii tried; the columns
# to compare, in the order of benches/accuracy.rs.
CASES = {
    "spatial four-bar": dict(
        model="spatial_four_bar",
        elements=8,
        steps=(300, 400, 600, 800),
        reference=None,
        periods=3,
        radii=(0.5,),
        columns=[0, 1, 2],
    ),
    "forced cantilever": dict(
        model="forced_cantilever",
        elements=4,
        steps=(100, 200, 400, 800, 1600, 3200),
        reference=(1600, 3200),
        periods=30,
        radii=(0.5, 0.9),
        columns=[0, 1, 3, 2],
    ),
    "rotor blade": dict(
        model="rotor_blade",
        elements=16,
        steps=(100, 200, 400, 800, 1600),
        reference=(800, 1600),
        periods=20,
        radii=(0.5, 0.9),
        columns=[0, 1, 5, 2, 3],
    ),
}


def exact_curves(path):
    with open(path, newline="") as file:
        _, *rows = csv.reader(file)
    return np.array(rows, float)[:, 1:]


def largest(difference, span):
    return float((np.abs(difference).max(axis=0) / span).max())


def run(directory, name, model, elements, steps, reference, periods, radii, columns):
    exact = exact_curves(directory / f"exact_{name.replace(' ', '_').replace('-', '_')}.csv")
    span = np.ptp(exact, axis=0)
    every = exudyn_models.SAMPLES // len(exact)
    march = getattr(exudyn_models, model)
    marched = {}
    for radius in radii:
        for count in steps if radius == radii[-1] else steps[:-1]:
            try:
                curves, seconds = march(elements, count, periods, radius=radius, sparse=True)
            except exu.SolverError:
                print(f"{name}: {count} steps, radius {radius}: fails", flush=True)
                continue
            marched[radius, count] = curves[:, ::every][:, :, columns], seconds
            print(f"{name}: {count} steps, radius {radius}: {seconds:.2f} s", flush=True)
    last = {key: curves[-1] for key, (curves, _) in marched.items()}
    best = radii[-1]
    own = exact
    if reference:
        middle, fine = (last[best, count] for count in reference)
        own = fine + (fine - middle) / 3
        print(
            f"{name}: the shorter step is {largest(fine - own, span):.1e} from the reference, "
            f"{largest(middle - own, span):.1e} the longer one; "
            "the reference from Periodyn's exact curves: "
            + ", ".join(f"{e:.1e}" for e in np.abs(own - exact).max(axis=0) / span),
            flush=True,
        )
    for (radius, count), (curves, seconds) in marched.items():
        for period in range(periods):
            yield [
                name,
                "Exudyn",
                f"{count} steps; radius {radius}",
                period + 1,
                f"{seconds * (period + 1) / periods:.6f}",
                f"{largest(curves[period] - own, span):.3e}",
            ]


def main():
    directory = pathlib.Path(sys.argv[1])
    with open(directory / "accuracy_exudyn.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["model", "method", "parameter", "periods", "seconds", "error"])
        for name in sys.argv[2:] or CASES:
            writer.writerows(run(directory, name, **CASES[name]))


if __name__ == "__main__":
    main()
