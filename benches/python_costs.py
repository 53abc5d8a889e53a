"""What Python costs: import, and functions of Python at every node and grid point of a blade.

    python benches/python_costs.py

Processor time, medians of several runs. The blade: 8 elements of degree 3, 25 nodes, in gravity, on
41 points; air resists each node. docs/python.md has what was found.
"""

import statistics
import subprocess
import sys
import time

import numpy as np

import periodyn as pdn

RUNS, POINTS, DRAG = 5, 41, 5.0


def blade():
    model = pdn.Model()
    model.set_gravity([0, 0, -9.81])
    profile = pdn.Section().set_diagonal([1e9, 2e8, 2e8, 1e6, 2e6, 8e6], [30, 2, 1, 1])
    beam = model.add_straight_beam([0, 0, 0], [10, 0, 0], [0, 1, 0], profile, 8, 3)
    shaft = model.add_revolute(pdn.GROUND, beam.first, [0, 0, 0], [0, 1, 0])
    model.prescribe(shaft, pdn.ROTATION, pdn.Signal().set_harmonics(rate=2.0))
    return model, list(range(beam.first, beam.last + 1))


def drag(state, values):
    drag.calls += 1
    values.forces[:, :3] = -DRAG * state.velocities[:, :3]
    if values.by_velocity is None:
        return
    if values.by_velocity.ndim == 3:  # a block for each node
        values.by_velocity[:, range(3), range(3)] = -DRAG
    else:
        diagonal = np.arange(len(values.by_velocity))
        values.by_velocity[diagonal, diagonal] = np.where(diagonal % 6 < 3, -DRAG, 0)


def cost(kind, size, tangents):
    """Seconds of a solve, and calls of the function."""
    model, nodes = blade()
    drag.calls = 0
    if kind == "dampers":
        for node in nodes:
            model.add_viscous_damper(pdn.GROUND, node, np.diag([DRAG, DRAG, DRAG, 0, 0, 0]))
    elif kind != "none":
        for i in range(0, len(nodes), size):
            force = model.add_user_force(nodes[i:i + size], pdn.FRAME_SPACE, tangents, drag)
            if kind == "apart":
                model.declare_nodes_apart(force)
    start = time.process_time()
    solution = model.solve_periodic(np.pi, grid_points=POINTS)
    assert solution.converged
    return time.process_time() - start, drag.calls


def import_time(modules):
    """Seconds that importing the last of some modules takes."""
    script = (f"import time, sys\nfor name in {modules[:-1]}: __import__(name)\n"
              f"start = time.process_time()\n__import__('{modules[-1]}')\n"
              f"print(time.process_time() - start)")
    done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True,
                          text=True)
    return float(done.stdout)


def main():
    taken = statistics.median(import_time(["numpy", "periodyn"]) for _ in range(15))
    print(f"import beyond numpy's: {1e3 * taken:.1f} ms")
    cases = [("no air", "none", 1, 0), ("dampers", "dampers", 1, 0)]
    for told, tangents in (("tangents given", pdn.TANGENTS_GIVEN),
                           ("differenced", pdn.TANGENTS_DIFFERENCED)):
        cases += [(f"{size} nodes a function, {told}", "functions", size, tangents)
                  for size in (1, 4, 25)]
        cases += [(f"25 nodes apart, {told}", "apart", 25, tangents)]
    for told, *case in cases:
        runs = [cost(*case) for _ in range(RUNS)]
        seconds = statistics.median(run[0] for run in runs)
        print(f"{told:34s} {seconds:7.3f} s, {runs[0][1]:6d} calls")


if __name__ == "__main__":
    main()
