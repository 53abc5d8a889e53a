"""Animations of solutions by PyVista: beams as tubes, shells as surfaces, bodies as points.

    film = Animation(solution, times, "moment", component=1)
    film.show()                 # in a window or a notebook, with a slider over the times
    film.write("motion.gif")    # or "motion.mp4", with imageio-ffmpeg
"""

import tempfile
from pathlib import Path

import numpy
import pyvista

from ._call import Error


class Animation:
    """A solution at some times; `plotter`, a pyvista.Plotter, shows one of them.

    Args:
        result: what colours show, by its name in the files of solution.write_vtk: `displacement`,
            of beams `moment` ..., of shells `von_mises_top` ..., of bodies `velocity` ...
        component: 0, 1, 2 of a result that is a vector; its length by default
        radius: of the tubes; by default a hundredth of the size of all
        options: those of pyvista.Plotter, such as off_screen=True where there is no screen
    """

    def __init__(self, solution, times, result="displacement", component=None, radius=None,
                 points_per_element=5, **options):
        self.times = numpy.asarray(times, dtype=float)
        with tempfile.TemporaryDirectory() as directory:
            solution.write_vtk(times, points_per_element, f"{directory}/all.pvd")
            parts = {part: list(map(pyvista.read, sorted(Path(directory, "all").glob(f"{part}_*"))))
                     for part in ("beams", "shells", "bodies")}
        everything = pyvista.MultiBlock(sum(parts.values(), []))
        having = [mesh for mesh in everything if result in mesh.point_data]
        values = [_shown(mesh, result, component) for mesh in having]
        if not values:
            names = ", ".join(sorted({name for mesh in everything for name in mesh.point_data}))
            raise Error(f"result: expected one of {names}, got {result}")
        title = result if component is None else f"{result} {component + 1}"
        self._colours = {"scalars": "shown", "scalar_bar_args": {"title": title},
                         "clim": [min(map(numpy.min, values)), max(map(numpy.max, values))]}
        radius = radius or everything.length / 100
        self._parts = {"beams": [mesh.tube(radius=radius) for mesh in parts["beams"]],
                       "shells": [mesh.extract_surface(nonlinear_subdivision=2, algorithm=None)
                                  for mesh in parts["shells"]], "bodies": parts["bodies"]}
        self.plotter = pyvista.Plotter(**options)
        self.draw(0)
        self.plotter.view_isometric(bounds=everything.bounds)

    def draw(self, number):
        """Draws the time of this number in place of another."""
        for part, meshes in self._parts.items():
            for mesh in meshes[number:number + 1]:
                style = self._colours if "shown" in mesh.point_data else {"color": "lightgrey"}
                self.plotter.add_mesh(mesh, name=part, reset_camera=False, point_size=12,
                                      render_points_as_spheres=part == "bodies", **style)
        self.plotter.add_text(f"t = {self.times[number]:.5g}", name="time", font_size=10)

    def show(self, **options):
        """Shows the plotter, with a slider over the times; options are those of its `show`."""
        self.plotter.add_slider_widget(lambda time: self.draw(abs(self.times - time).argmin()),
                                       self.times[[0, -1]], value=self.times[0], title="time")
        return self.plotter.show(**options)

    def write(self, path, frames_per_second=20):
        """Writes all times as a film, .gif or .mp4, and closes the plotter."""
        if str(path).endswith(".gif"):
            self.plotter.open_gif(path, fps=frames_per_second)
        else:
            self.plotter.open_movie(path, framerate=frames_per_second)
        for number in range(len(self.times)):
            self.draw(number)
            self.plotter.write_frame()
        self.plotter.close()


def _shown(mesh, result, component):
    """Gives a mesh the values that colours show, and returns them."""
    values = mesh.point_data[result].reshape(mesh.n_points, -1)
    if component not in (None, *range(values.shape[1])):
        raise Error(f"component: expected 0 to {values.shape[1] - 1}, got {component}")
    by_length = component is None and values.shape[1] > 1
    values = numpy.linalg.norm(values, axis=1) if by_length else values[:, component or 0]
    mesh.point_data["shown"] = values
    return values
