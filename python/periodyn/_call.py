"""Calls of the library: its file, and exceptions for its statuses."""

import os.path  # not pathlib, which takes half as long to load as all of this package
import sys
import threading

from ._abi import ffi

_HERE = os.path.dirname(os.path.abspath(__file__))
_FILES = [os.path.join(_HERE, name)
          for name in ("libperiodyn.so", "libperiodyn.dylib", "periodyn.dll")]
LIBRARY = ffi.dlopen(next(filter(os.path.exists, _FILES), _FILES[0]))


class Error(Exception):
    """A call that failed: `status` has its name, such as "PDN_ERR_VALUE"."""

    def __init__(self, message, status="PDN_ERR_VALUE"):
        super().__init__(message)
        self.status = status


class _Raised(threading.local):
    """What callbacks on this thread have raised, and where, until the call that needed them is
    over."""

    exception = None
    where = None


RAISED = _Raised()


def call(function, *arguments):
    """Calls a function that returns a status.

    Raises:
        what a callback raised, or Error
    """
    RAISED.exception = None
    try:
        status = function(*arguments)
    except (TypeError, OverflowError) as error:
        raise Error(_unfit(function, arguments, error, sys._getframe(1))) from None
    raised, RAISED.exception = RAISED.exception, None
    if raised is not None:
        _note(raised, filled(LIBRARY.pdn_last_error) if status else "")
        raise raised
    if status != 0:
        name = ffi.string(LIBRARY.pdn_status_name(status)).decode()
        message = filled(LIBRARY.pdn_last_error)
        raise Error(message or ffi.string(LIBRARY.pdn_status_message(status)).decode(), name)


def _note(raised, message):
    """Adds to an exception of a function which one it was: as the library names it, and as Python
    does; before Python 3.11 as its cause."""
    told = "; ".join(text for text in (message, RAISED.where) if text)
    if not isinstance(raised, Exception) or not told:
        return
    if hasattr(raised, "add_note"):
        raised.add_note(told)
    elif raised.__cause__ is None:
        raised.__cause__ = Error(told, "PDN_ERR_CALLBACK")


def _unfit(function, arguments, error, caller):
    """Which argument of a call is none of the type that C wants, by its name in the caller."""
    for kind, argument in zip(ffi.typeof(function).args, arguments):
        try:
            if kind.kind == "primitive":
                ffi.new(ffi.getctype(kind, "*"))[0] = argument
        except (TypeError, OverflowError):
            names = (name for name, value in caller.f_locals.items() if value is argument)
            wanted = "a number" if kind.cname == "double" else "a whole number"
            return f"{next(names, 'argument')}: expected {wanted}, got {argument!r}"
    return str(error)


def filled(function, *first):
    """The text that a function writes into a buffer."""
    size = function(*first, ffi.NULL, 0) + 1
    buffer = ffi.new("char[]", size)
    function(*first, buffer, size)
    return ffi.string(buffer).decode()


def text(string):
    """A text as an argument; None stands for NULL."""
    return ffi.NULL if string is None else ffi.new("char[]", str(string).encode())


text.of = filled
