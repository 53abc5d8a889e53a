"""Shells of the literature under their loads, as pictures.

    shells.py [PICTURE]

Displacements of the loaded points are printed; docs/shells.md has what is known of them.
"""

import sys

import numpy as np
from matplotlib import pyplot
from matplotlib.ticker import MaxNLocator

import periodyn as pdn

DEGREE = 4


def section(thickness, young, poisson):
    return pdn.ShellSection().set_isotropic(thickness, young, poisson, 1.0)


def shell(surface, elements, law, join=1, frames=pdn.SHELL_PARALLEL):
    """A model of a surface, its nodes in rows along u."""
    model = pdn.Model()
    if not isinstance(surface, pdn.Surface):
        surface = pdn.Surface().set_function(surface)
    placement = pdn.ShellPlacement()
    placement.frames = frames
    made = model.add_shell(surface, *elements, DEGREE, DEGREE, law, join, placement)
    nodes = np.array([[model.shell_patch_node(made, u, v) for v in range(made.nodes_v)]
                      for u in range(made.nodes_u)])
    return model, nodes


def clamp(model, nodes):
    for node in nodes:
        model.add_rigid_joint(pdn.GROUND, node, model.node_frame(node).position)


def pull(model, nodes, component, force):
    """A dead force on an edge of whole elements, spread by Lobatto's rule."""
    parts = np.array([1 / 10, 49 / 90, 32 / 45, 49 / 90, 1 / 10]) / 2
    count = (len(nodes) - 1) // DEGREE
    for element in range(count):
        for part, node in zip(parts, nodes[element * DEGREE:]):
            model.add_load(node, pdn.FRAME_SPACE, component, force * part / count)


def cantilever():
    flat = pdn.Surface().set_parallelogram([0, 0, 0], [10, 0, 0], [0, 1, 0])
    model, nodes = shell(flat, (4, 1), section(0.1, 1.2e6, 0))
    clamp(model, nodes[0])
    pull(model, nodes[-1], pdn.FORCE_3, 4)
    return "Cantilever", model, nodes, [nodes[-1, 0]], 1


def roll_up():
    flat = pdn.Surface().set_parallelogram([0, 0, 0], [12, 0, 0], [0, 1, 0])
    model, nodes = shell(flat, (6, 1), section(0.1, 1.2e6, 0))
    clamp(model, nodes[0])
    last = pdn.FIRST_SHELL_ELEMENT + 5
    model.add_shell_load(last, 1, pdn.SHELL_EDGE_END_XI, pdn.FRAME_MATERIAL, pdn.MOMENT_1,
                         -2 * np.pi * 1.2e6 * 0.1**3 / 12 / 12)
    return "Rolled up", model, nodes, [nodes[-1, 0]], 4


def slit_ring():
    ring = pdn.Surface().set_annulus([0, 0, 0], [0, 0, 1], [1, 0, 0], 6, 10, 2 * np.pi)
    model, nodes = shell(ring, (1, 10), section(0.03, 21e6, 0), join=0)
    clamp(model, nodes[:, 0])
    pull(model, nodes[:, -1], pdn.FORCE_3, 3.2)
    return "Slit ring", model, nodes, [nodes[0, -1], nodes[-1, -1]], 7


def hemisphere():
    def surface(u, v):
        polar, around = np.pi / 2 - np.radians(72) * v, np.pi / 2 * u
        return 10 * np.array([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around),
                              np.cos(polar)])

    model, nodes = shell(surface, (4, 4), section(0.04, 6.825e7, 0.3))
    for edge, across in ((nodes[0], [0, 1, 0]), (nodes[-1], [1, 0, 0])):
        for node in edge:  # a plane of symmetry
            model.add_planar(pdn.GROUND, node, model.node_frame(node).position, across)
    middle = nodes[nodes.shape[0] // 2, 0]
    free = model.add_free_joint(pdn.GROUND, middle, model.node_frame(middle).position)
    model.prescribe(free, pdn.DISPLACEMENT_3, 0.0)
    model.add_load(nodes[0, 0], pdn.FRAME_SPACE, pdn.FORCE_1, 200.0)
    model.add_load(nodes[-1, 0], pdn.FRAME_SPACE, pdn.FORCE_2, -200.0)
    return "Hemisphere, a quarter", model, nodes, [nodes[0, 0], nodes[-1, 0]], 4


def twisted_beam():
    def surface(u, v):
        angle, across = np.pi / 2 * u, 1.1 * (v - 0.5)
        return np.array([12 * u, across * np.cos(angle), across * np.sin(angle)])

    model, nodes = shell(surface, (4, 1), section(0.32, 29e6, 0.22))
    clamp(model, nodes[0])
    pull(model, nodes[-1], pdn.FORCE_3, 1)
    return "Twisted beam (displacements × 200)", model, nodes, [nodes[-1, 2]], 1


def hook():
    def surface(u, v):
        corner = np.pi / 3
        turned = min(2 * u, 1.0) * corner
        place = 14 * np.array([np.sin(turned), 0, 1 - np.cos(turned)])
        if u > 0.5:
            turned = corner - (2 * u - 1) * np.radians(150)
            place += 46 * np.array([np.sin(corner) - np.sin(turned), 0,
                                    np.cos(turned) - np.cos(corner)])
        return place + np.array([0, 20 * v, 0])

    model, nodes = shell(surface, (6, 2), section(2, 3300, 0.35), frames=pdn.SHELL_NORMALS)
    clamp(model, nodes[0])
    pull(model, nodes[-1], pdn.FORCE_2, 1e-3)
    return "Raasch's hook (displacements × 2000)", model, nodes, [nodes[-1, 4]], 1


def draw(axes, title, before, after):
    for places, colour, strength in ((before, "#bbbbbb", 0.5), (after, "#56B4E9", 1.0)):
        x, y, z = np.moveaxis(places, -1, 0)
        axes.plot_surface(x, y, z, color=colour, alpha=strength, edgecolor="#333333",
                          linewidth=0.2 * strength, rstride=1, cstride=1)
    everything = np.concatenate([before.reshape(-1, 3), after.reshape(-1, 3)])
    extents = np.ptp(everything, axis=0)
    axes.set_box_aspect(np.maximum(extents, 0.1 * extents.max()))
    for axis, extent in zip((axes.xaxis, axes.yaxis, axes.zaxis), extents):
        axis.set_major_locator(MaxNLocator(1 + round(5 * extent / extents.max())))
    axes.set_title(title, fontsize=10)
    axes.tick_params(labelsize=6)


def position(solution, node):
    return solution.sample(pdn.Quantity(pdn.NODE_POSITION, node), [0])[0]


figure = pyplot.figure(figsize=(11, 7), layout="constrained")
for k, made in enumerate((cantilever, roll_up, slit_ring, hemisphere, twisted_beam, hook)):
    title, model, nodes, points, load_steps = made()
    solution = model.solve_static(load_steps=load_steps)
    assert solution.converged, solution.report()
    before = np.array([[model.node_frame(n).position for n in row] for row in nodes])
    after = np.array([[position(solution, n) for n in row] for row in nodes])
    told = [position(solution, n) - model.node_frame(n).position for n in points]
    print(f"{title}:", "; ".join(" ".join(f"{x:.5g}" for x in one) for one in told))
    larger = float(title.split("×")[1].rstrip(")")) if "×" in title else 1.0
    draw(figure.add_subplot(2, 3, k + 1, projection="3d"), title, before,
         before + larger * (after - before))
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=110)
