"""Pictures of solutions, by matplotlib. Each function draws into `axes`, new ones by default, and
returns them."""

import numpy
from matplotlib import pyplot

from ._interface import NODE_POSITION, Quantity


def _axes(axes, **options):
    return pyplot.figure().add_subplot(**options) if axes is None else axes


def decay(solution, axes=None):
    """How large each harmonic of the motions is: to fall to rounding, or to the tolerance."""
    axes = _axes(axes)
    amplitudes = solution.decay()
    axes.semilogy(numpy.where(amplitudes > 0, amplitudes, numpy.nan), ".-")
    axes.set_xlabel("harmonic")
    axes.set_ylabel("largest amplitude of a motion")
    return axes


def iterations(solution, axes=None):
    """Residual and increment of each iteration of Newton's method on the last grid."""
    axes = _axes(axes)
    residuals, increments, _ = solution.history()
    numbers = numpy.arange(1, len(residuals) + 1)
    axes.semilogy(numbers, residuals, ".-", label="residual")
    axes.semilogy(numbers, increments, ".-", label="increment")
    axes.set_xlabel("iteration")
    axes.legend()
    return axes


def harmonics(mean, cosines, sines, axes=None, **options):
    """Amplitudes of one component, as the functions for harmonics give it; number 0 is the mean."""
    axes = _axes(axes)
    amplitudes = numpy.hypot(cosines, sines)
    if amplitudes.ndim != 1:
        raise ValueError(f"expected one component, got {amplitudes.shape[1]}: choose a column")
    axes.bar(numpy.arange(len(amplitudes) + 1), [abs(mean), *amplitudes], **options)
    axes.set_xlabel("harmonic")
    axes.set_ylabel("amplitude")
    return axes


def lines(solution, paths, times, axes=None, **options):
    """Lines through nodes (each path: their ids, such as range(beam.first, beam.last + 1)) at some
    times, in space."""
    axes = _axes(axes, projection="3d")
    for path in paths:
        positions = numpy.array(
            [solution.sample(Quantity(NODE_POSITION, node), times) for node in path]
        )
        for k in range(positions.shape[1]):
            axes.plot(*positions[:, k, :].T, **options)
    axes.set_aspect("equal")
    return axes
