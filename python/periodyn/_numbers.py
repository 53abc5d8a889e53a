"""Arrays as arguments and results."""

import operator

import numpy

from ._call import Error


def _shape_told(shape):
    return " x ".join("any number" if n is None else str(n) for n in shape)


def like(name, array, shape):
    """Requires that `array`, unless None, has this shape; None in it stands for any length."""
    if array is None:
        return
    got = numpy.shape(array)
    fits = len(got) == len(shape) and all(n in (None, m) for n, m in zip(shape, got))
    if not fits:
        raise Error(f"{name}: expected an array of {_shape_told(shape)}, got {_shape_told(got)}",
                    "PDN_ERR_SIZE")


def reals(name, values, shape, turned=False):
    """Numbers in the order that the library wants them in; None stays None.

    `turned`: the last two axes are rows and columns, and the library has columns together.
    """
    if values is None:
        return None
    try:
        array = numpy.asarray(values, dtype=numpy.float64)
    except (TypeError, ValueError) as error:
        raise Error(f"{name}: expected numbers ({error})", "PDN_ERR_VALUE") from None
    if array.ndim == 0 and len(shape) == 1:
        array = array[None]
    like(name, array, shape)
    return numpy.ascontiguousarray(array.swapaxes(-1, -2) if turned else array)


reals.empty = numpy.empty


def whole(name, value):
    """How many there are to be, a whole number that is not negative."""
    try:
        number = operator.index(value)
    except TypeError:
        raise Error(f"{name}: expected a whole number, got {value!r}", "PDN_ERR_SIZE") from None
    if number < 0:
        raise Error(f"{name}: expected at least 0, got {number}", "PDN_ERR_SIZE")
    return number


def ids(name, values):
    """Ids, as the library wants them; None stands for none."""
    array = numpy.atleast_1d(numpy.asarray([] if values is None else values))
    if array.ndim != 1 or not (array.size == 0 or numpy.issubdtype(array.dtype, numpy.integer)):
        raise Error(f"{name}: expected a list of ids, got {values!r}", "PDN_ERR_ID")
    return numpy.ascontiguousarray(array, dtype=numpy.int32)


def together(**arrays):
    """Arrays that may be left out and have one length, and that length.

    Those left out are None if all are, else zero.
    """
    given = {name: reals(name, values, (None,)) for name, values in arrays.items()}
    count = next((len(array) for array in given.values() if array is not None), 0)
    for name, array in given.items():
        like(name, array, (count,))
    filled = (numpy.zeros(count) if array is None and count else array for array in given.values())
    return *filled, count
