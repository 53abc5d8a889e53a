"""Functions of Python that the library calls.

Each kind has one function for C, which finds the one of Python by its `user_data`. What it raises
is kept, and raised again by the call that needed it.
"""

from collections import namedtuple

import numpy

from ._abi import ffi
from ._call import RAISED, Error

Callback = namedtuple("Callback", "function data")


def _failing(what):
    """What to do with an exception; to C it is told as failure. Where it was is kept for a note:
    which function, `what` it is, and the shapes of arrays `given` to it and `wanted` of it."""

    def failed(kind, value, traceback):
        RAISED.exception = value if isinstance(value, BaseException) else kind(value)
        names = traceback.tb_frame.f_locals if traceback else {}
        function = ffi.from_handle(names["data"]) if "data" in names else None
        RAISED.where = f"{getattr(function, '__qualname__', function)} is {what}"
        if "wanted" in names:
            RAISED.where += f": given {_arrays(names['given'])}; to fill {_arrays(names['wanted'])}"

    return failed


def _arrays(of):
    """Names and shapes of arrays."""
    return ", ".join(f"{name} {value.shape}" for name, value in vars(of).items()
                     if isinstance(value, numpy.ndarray))


def _taker(name, for_c):
    """What makes a callback of a function of Python, and keeps it alive in a list."""

    def take(function, kept, _name=None):
        if not callable(function):
            raise Error(f"{name}: expected a function, got {function!r}")
        handle = ffi.new_handle(function)
        kept.append(handle)
        return Callback(for_c, handle)

    return take


def view(pointer, *shape):
    """The numbers behind a pointer, as long as the call lasts."""
    if pointer == ffi.NULL:
        return None
    size = 8
    for length in shape:
        size *= length
    return numpy.frombuffer(ffi.buffer(pointer, size)).reshape(shape)


@ffi.callback("int32_t(double, double *, void *)", error=1,
              onerror=_failing("a signal, which returns a number"))
def _signal(time, value, data):
    value[0] = ffi.from_handle(data)(time)
    return 0


@ffi.callback("int32_t(double, double *, double *, void *)", error=1,
              onerror=_failing("a curve, which returns a position (3,) and axis 2 (3,)"))
def _curve(fraction, position, axis_2, data):
    place, axis = ffi.from_handle(data)(fraction)
    view(position, 3)[:] = place
    view(axis_2, 3)[:] = axis
    return 0


@ffi.callback("int32_t(double, double, double *, void *)", error=1,
              onerror=_failing("a surface, which returns a position (3,)"))
def _surface(u, v, position, data):
    view(position, 3)[:] = ffi.from_handle(data)(u, v)
    return 0


@ffi.callback("int32_t(double, double, double, double *, double *, void *)", error=1,
              onerror=_failing("a law of a coordinate, which returns an effort, or that and its "
                               "derivatives (2,)"))
def _coordinate_law(time, coordinate, rate, effort, derivatives, data):
    told = ffi.from_handle(data)(time, coordinate, rate)
    if isinstance(told, tuple):
        told, slopes = told
        if derivatives != ffi.NULL:
            view(derivatives, 2)[:] = slopes
    effort[0] = told
    return 0


class ForceState:
    """What forces on nodes may depend on: `time`, `positions` (nodes x 3), `rotations` (nodes x 3
    x 3) and `velocities` (nodes x 6), along the axes that were asked for; during the call only."""

    def __init__(self, c):
        count = c.node_count
        self.time = c.time
        self.positions = view(c.positions, count, 3)
        self.rotations = view(c.rotations, count, 3, 3).swapaxes(1, 2)
        self.velocities = view(c.velocities, count, 6)


class ForceValues:
    """Where forces go: `forces` (nodes x 6), all zero at first; `by_motion` and `by_velocity`
    (6 nodes x 6 nodes, row: force, column: motion; nodes x 6 x 6, of each node, where nodes were
    declared apart), None where they are not wanted."""

    def __init__(self, c, count, columns):
        self.forces = view(c.forces, count, 6)

        def tangents(pointer):
            if pointer == ffi.NULL:
                return None
            if columns < count:
                return view(pointer, 6, count, 6).transpose(1, 2, 0)
            return view(pointer, 6 * count, 6 * count).T

        self.by_motion, self.by_velocity = tangents(c.by_motion), tangents(c.by_velocity)


@ffi.callback("int32_t(pdn_force_state *, pdn_force_values *, void *)", error=1,
              onerror=_failing("a force on nodes"))
def _user_force(state, values, data):
    given = ForceState(state)
    wanted = ForceValues(values, state.node_count, state.column_count)
    ffi.from_handle(data)(given, wanted)
    return 0


class ControllerState:
    """What a controller may depend on: `time`, `inputs` (the coordinates that it reads), their
    `input_rates`, and its `states`; during the call only."""

    def __init__(self, c):
        self.time = c.time
        self.inputs = view(c.inputs, c.input_count)
        self.input_rates = view(c.input_rates, c.input_count)
        self.states = view(c.states, c.state_count)


class ControllerValues:
    """Where a controller writes: `efforts` and `state_rates`, all zero at first; `by_inputs`,
    `by_input_rates` and `by_states`, None where they are not wanted, with a row for each effort
    and then for each state rate."""

    def __init__(self, c, state, outputs):
        inputs, states = state.input_count, state.state_count
        self.efforts = view(c.efforts, outputs)
        self.state_rates = view(c.state_rates, states)
        tangents = (c.by_inputs, inputs), (c.by_input_rates, inputs), (c.by_states, states)
        self.by_inputs, self.by_input_rates, self.by_states = (
            None if c.by_inputs == ffi.NULL else view(tangent, columns, outputs + states).T
            for tangent, columns in tangents
        )


@ffi.callback("int32_t(pdn_controller_state *, pdn_controller_values *, void *)", error=1,
              onerror=_failing("a controller"))
def _controller(state, values, data):
    given, wanted = ControllerState(state), ControllerValues(values, state, values.output_count)
    ffi.from_handle(data)(given, wanted)
    return 0


class SurfaceState:
    """What forces on a shell or beam element may depend on: `time`, the id of the `element`, and
    of its points `places` (points x 2), `sizes` (the area or length that each stands for),
    `positions` (points x 3), `rotations` (points x 3 x 3, a normal last) and `velocities`
    (points x 6), along the axes that were asked for; during the call only."""

    def __init__(self, c):
        count = c.point_count
        self.time, self.element = c.time, c.element
        self.places = view(c.places, count, 2)
        self.sizes = view(c.sizes, count)
        self.positions = view(c.positions, count, 3)
        self.rotations = view(c.rotations, count, 3, 3).swapaxes(1, 2)
        self.velocities = view(c.velocities, count, 6)


class SurfaceValues:
    """Where forces on an element go: `forces` (points x 6) for each unit of area or length,
    all zero at first; `by_motion` and `by_velocity` (points x 6 x 6, row: force, column: motion),
    None where they are not wanted."""

    def __init__(self, c, count):
        self.forces = view(c.forces, count, 6)
        self.by_motion, self.by_velocity = (
            None if tangent == ffi.NULL else view(tangent, count, 6, 6).swapaxes(1, 2)
            for tangent in (c.by_motion, c.by_velocity)
        )


@ffi.callback("int32_t(pdn_surface_state *, pdn_surface_values *, void *)", error=1,
              onerror=_failing("a force on an element"))
def _surface_force(state, values, data):
    given, wanted = SurfaceState(state), SurfaceValues(values, state.point_count)
    ffi.from_handle(data)(given, wanted)
    return 0


@ffi.callback("int32_t(pdn_progress *, void *)", error=1,
              onerror=_failing("told of progress"))
def _progress(told, data):
    return 1 if ffi.from_handle(data)(told) else 0


@ffi.callback("int32_t(pdn_branch_point *, int32_t, void *)", error=1,
              onerror=_failing("told of progress"))
def _branch(point, number, data):
    return 1 if ffi.from_handle(data)(point, number) else 0


signal = _taker("function", _signal)
curve = _taker("curve", _curve)
surface = _taker("surface", _surface)
coordinate_law = _taker("function", _coordinate_law)
user_force = _taker("function", _user_force)
controller = _taker("function", _controller)
surface_force = _taker("function", _surface_force)
_told = _taker("progress", _progress)
_followed = _taker("progress", _branch)


def progress(function, kept, _name=None):
    """Progress for nobody still lets a solve be interrupted by Ctrl-C; True prints it."""
    if function is None or function is False:
        return _told(_nobody, kept)
    return _told(Printed() if function is True else function, kept)


def branch(function, kept, _name=None):
    """As progress, of a branch: told of each point, with its number."""
    if function is None or function is False:
        return _followed(_nobody, kept)
    return _followed(_printed_point if function is True else function, kept)


def _nobody(*_told):
    return False


def _printed_point(point, number):
    print(f"point {number:5d}  parameter {point.parameter:.6g}", end="\r", flush=True)
    return False


class Printed:
    """Prints how far a solve is, on one line."""

    def __call__(self, told):
        line = f"{told.elapsed:7.1f} s  {told.grid_points:5d} points  "
        line += f"iteration {told.iteration:3d}  increment {told.increment:8.1e}"
        print(line, end="\r", flush=True)
        return False

