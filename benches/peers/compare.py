"""Compares the examples forced_cantilever and rotor_blade with Exudyn, and prints the tables of
README.md.

    compare.py DIRECTORY_OF_EXAMPLES [EXAMPLE]...

Exudyn marches in time, to second order in the step and of the order of its elements in the mesh;
both errors are taken out by Richardson's extrapolation, and what that leaves is estimated from its
last change.
"""

import csv
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import numpy as np

import exudyn_models

# For each example: Exudyn's meshes (at the middle step) and steps to a period (at the middle mesh),
# the order of its elements, and our options from coarse to fine, the first being those of the
# example.
CASES = {
    "forced_cantilever": dict(meshes=(4, 8, 16), steps=(200, 400, 800), order=4,
                              ours=[(41, 4, 4), (51, 4, 4), (41, 6, 5)]),
    "rotor_blade": dict(meshes=(8, 16, 32), steps=(100, 200, 400), order=2,
                        ours=[(31, 4, 4), (41, 4, 4), (31, 6, 5)]),
}


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def solve(program, grid, elements, degree):
    """Names and curves of an example at Exudyn's times, and the processor's seconds for all of it,
    on one thread."""
    with tempfile.TemporaryDirectory() as directory:
        out = pathlib.Path(directory) / "curves.csv"
        options = ["--grid", grid, "--elements", elements, "--order", degree, "--out", out]
        start = processor_seconds()
        subprocess.run([program, *map(str, options)], check=True, stdout=subprocess.DEVNULL,
                       env=os.environ | {"RAYON_NUM_THREADS": "1"})
        seconds = processor_seconds() - start
        with open(out, newline="") as file:
            names, *rows = csv.reader(file)
    values = np.array(rows, float)[:-1, 1:]  # the last time repeats the first
    return names[1:], values[::len(values) // exudyn_models.SAMPLES], seconds


def largest(difference):
    return np.abs(difference).max(axis=0)


def extrapolated(coarse, middle, fine, order):
    """Richardson's limit of halving steps, its last change, and the order that was observed."""
    def limit(a, b):
        return b + (b - a) / (2**order - 1)
    observed = np.log2(largest(coarse - middle) / largest(middle - fine))
    return limit(middle, fine), largest(limit(middle, fine) - limit(coarse, middle)), observed


def compare(directory, name, meshes, steps, order, ours):
    march = getattr(exudyn_models, name)
    marched = {}
    for key in [(mesh, steps[1]) for mesh in meshes] + [
        (meshes[1], step) for step in (steps[0], steps[2])
    ]:
        curves, seconds = march(*key)
        unsettled = exudyn_models.unsettled(curves)
        print(f"{name}: Exudyn, {key[0]} elements, {key[1]} steps to a period: {seconds:.1f} s, "
              f"last two periods differ by {unsettled:.0e}", flush=True)
        marched[key] = curves[-1]
    solved = [solve(pathlib.Path(directory) / name, *options) for options in ours]
    for options, (_, _, seconds) in zip(ours, solved):
        print(
            f"{name}: Periodyn, {options[0]} grid points, "
            f"{options[1]} elements of degree {options[2]}: {seconds:.2f} s"
        )

    names, own, _ = solved[0]
    # What the example does not write, velocities, comes last.
    marched = {key: curves[:, :len(names)] for key, curves in marched.items()}
    span = np.ptp(own, axis=0)
    base = marched[meshes[1], steps[1]]
    mesh, mesh_error, mesh_order = extrapolated(*(marched[m, steps[1]] for m in meshes), order)
    step, step_error, step_order = extrapolated(*(marched[meshes[1], s] for s in steps), 2)
    finest = marched[meshes[2], steps[1]]
    columns = {
        "range": span,
        "difference, finest mesh": largest(finest - own) / span,
        "difference, extrapolated": largest(mesh + step - base - own) / span,
        "Exudyn, mesh": mesh_error / span,
        "order": mesh_order,
        "Exudyn, step": step_error / span,
        "order ": step_order,
        "Periodyn, grid": largest(solved[1][1] - own) / span,
        "Periodyn, mesh": largest(solved[2][1] - own) / span,
    }
    print(f"\n| {name} | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1))
    for i, curve in enumerate(names):
        cells = [f"{v[i]:.3g}" if k == "range" else f"{v[i]:.1f}" if "order" in k else f"{v[i]:.1e}"
                 for k, v in columns.items()]
        print(f"| {curve} | " + " | ".join(cells) + " |")
    print(flush=True)


if __name__ == "__main__":
    for case in sys.argv[2:] or CASES:
        compare(sys.argv[1], case, **CASES[case])
