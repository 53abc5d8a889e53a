"""Quantities over a period for vibration and fatigue: histories, root mean squares, cycles.

    from periodyn import loads

    moment = pdn.Quantity(pdn.JOINT_REACTION, clamp, 4, frame=pdn.FRAME_FIRST)
    print(loads.rms(solution, moment))
    ranges, means = loads.rainflow(loads.history(solution, moment)[1])
"""

import numpy

from ._call import Error
from ._interface import FREQUENCY


def history(solution, quantity, points=None):
    """Times, and the values of a quantity there, evenly over a period; the last is a step before
    its end, where the first comes again.

    Args:
        solution: a periodic solution
        quantity: what is asked for
        points: how many; None for 16 for each grid point, with which peaks between points are met
            to half a percent of the highest harmonic's amplitude
    """
    count = 16 * solution.diagnostics().grid_points if points is None else points
    times = 2 * numpy.pi / solution.parameter(FREQUENCY) * numpy.arange(count) / count
    return times, solution.sample(quantity, times)


def rms(solution, quantity, about_mean=False):
    """Root mean square of a quantity over a period, of each component; with `about_mean` that of
    what it differs from its mean: its standard deviation."""
    _, values = history(solution, quantity)
    if about_mean:
        values = values - values.mean(axis=0)
    return numpy.sqrt((values**2).mean(axis=0))


def turning_points(values):
    """Where a history that repeats itself turns back, from its largest value to that again; no more
    than that value if it is constant."""
    values = numpy.asarray(values, dtype=float)
    if values.ndim != 1 or not len(values):
        raise Error(f"values: expected those of one component, got the shape {values.shape}",
                    "PDN_ERR_SIZE")
    first = values.argmax()
    values = numpy.append(numpy.roll(values, -first), values[first])
    values = values[numpy.append(True, numpy.diff(values) != 0)]
    turns = numpy.diff(numpy.sign(numpy.diff(values))) != 0
    return values[numpy.concatenate(([True], turns, [True]))[:len(values)]]


def rainflow(values):
    """Ranges and means of the cycles of a history that repeats itself, by rainflow counting (ASTM
    E1049-85, 5.4.5): all are whole cycles, each once a period."""
    ranges, means, open_ones = [], [], []

    def close(a, b):
        ranges.append(abs(a - b))
        means.append((a + b) / 2)

    for value in turning_points(values):
        open_ones.append(value)
        while len(open_ones) >= 4:
            a, b, c, d = open_ones[-4:]
            if abs(b - c) > min(abs(a - b), abs(c - d)):
                break
            close(b, c)
            del open_ones[-3:-1]
    if len(open_ones) == 3:  # from the largest to the smallest and back
        close(*open_ones[:2])
    return numpy.array(ranges), numpy.array(means)
