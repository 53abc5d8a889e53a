"""Structs of C as objects with attributes."""

import math

import numpy

from ._abi import ffi
from ._call import Error
from ._numbers import like, reals


def pointer(value, kept=None, name="argument"):
    """What C is given for an array, a handle or a struct; None stands for NULL."""
    if value is None:
        return ffi.NULL
    if isinstance(value, numpy.ndarray):
        return ffi.from_buffer("double[]", value)
    if not hasattr(value, "_c"):
        raise Error(f"{name}: expected a handle of this package, got {value!r}")
    return value._c


class Struct:
    """A struct of the library. Fields are attributes, and arguments of the constructor, by keyword
    or in their order, where None stands for the default."""

    _type = ""
    _initialise = None
    _classes = {}

    def __init_subclass__(cls):
        Struct._classes[cls.__name__] = cls

    def __init__(self, *values, **fields):
        self._c = ffi.new(f"{self._type} *")
        self._kept = []
        self._arrays = {}
        if self._initialise is not None:
            self._initialise(self._c, ffi.sizeof(self._type))
        names = list(self._fields())
        if len(values) > len(names):
            raise TypeError(f"{type(self).__name__} has {len(names)} fields, not {len(values)}")
        for name, value in zip(names, values):
            if name in fields:
                raise TypeError(f"{type(self).__name__} was given its field {name} twice")
            fields[name] = value
        for name, value in fields.items():
            if name not in names:
                raise TypeError(f"{type(self).__name__} has no field {name}")
            if value is not None or name == "progress":
                setattr(self, name, value)

    @classmethod
    def _fields(cls):
        return {name: field for name, field in vars(cls).items() if isinstance(field, Field)}

    def _require_lengths(self):
        """Arrays are as long as the count that goes with them."""
        for name, field in self._fields().items():
            if getattr(field, "counted", None) and name in self._arrays:
                like(name, self._arrays[name], (getattr(self._c, field.counted),))

    def as_dict(self):
        """The fields and their values."""
        return {name: getattr(self, name) for name in self._fields()}

    def __repr__(self):
        fields = ", ".join(f"{name}={value!r}" for name, value in self.as_dict().items())
        return f"{type(self).__name__}({fields})"


class Field:
    """An attribute that is a field of the struct."""

    def __init__(self, name):
        self.name = name


class Number(Field):
    """A number."""

    def __get__(self, owner, _class):
        return self if owner is None else getattr(owner._c, self.name)

    def __set__(self, owner, value):
        try:
            setattr(owner._c, self.name, value)
        except (TypeError, OverflowError) as error:
            raise Error(f"{self.name}: {error}") from None


class Array(Field):
    """Numbers in the struct, or those that it points to, of a length that another field has."""

    def __init__(self, name, shape=None, pointed=False, turned=False, counted=None):
        super().__init__(name)
        self.shape, self.pointed, self.turned, self.counted = shape, pointed, turned, counted

    def __get__(self, owner, _class):
        if owner is None:
            return self
        if self.pointed:
            return owner._arrays.get(self.name)
        # A view of the whole struct, which it keeps alive; one of the member would not.
        offset = ffi.offsetof(ffi.typeof(owner._c).item, self.name)
        count = math.prod(self.shape)
        values = numpy.frombuffer(ffi.buffer(owner._c), count=count, offset=offset)
        values = values.reshape(self.shape)
        return values.T if len(self.shape) == 2 else values

    def __set__(self, owner, value):
        if not self.pointed:
            like(self.name, value, self.shape)
            self.__get__(owner, None)[...] = value
            return
        owner._arrays[self.name] = None if value is None else numpy.asarray(value, dtype=float)
        shape = numpy.shape(owner._arrays[self.name])
        values = reals(self.name, owner._arrays[self.name], shape, self.turned)
        owner._kept.append(values)
        setattr(owner._c, self.name, pointer(values))


class Reference(Field):
    """A pointer to something else that is kept: a handle, a struct, a function with its data."""

    def __init__(self, name, taken_by, data=None):
        super().__init__(name)
        self.taken_by, self.data = taken_by, data

    def __get__(self, owner, _class):
        return self if owner is None else owner._arrays.get(self.name)

    def __set__(self, owner, value):
        taken = self.taken_by(value, owner._kept, self.name)
        owner._arrays[self.name] = value
        owner._kept.append(value)
        if self.data is None:
            setattr(owner._c, self.name, taken)
        else:
            setattr(owner._c, self.name, taken.function)
            setattr(owner._c, self.data, taken.data)


class Structs(Field):
    """An array of structs; their number is another field."""

    def __init__(self, name, of, count):
        super().__init__(name)
        self.of, self.count = of, count

    def __get__(self, owner, _class):
        return self if owner is None else owner._arrays.get(self.name)

    def __set__(self, owner, values):
        values = list(values)
        array, _ = as_structs(self.of, values, owner._kept, self.name)
        owner._arrays[self.name] = values
        owner._kept.append(array)
        setattr(owner._c, self.name, array)
        setattr(owner._c, self.count, len(values))


def of_type(kind):
    """What takes a struct of this class, or its fields as a dictionary; None stands for NULL."""

    def take(value, kept, name):
        if value is None:
            return ffi.NULL
        wanted = Struct._classes[kind]
        if isinstance(value, dict):
            value = wanted(**value)
        if not isinstance(value, wanted):
            raise Error(f"{name}: expected a {kind}, got {value!r}")
        value._require_lengths()
        kept.append(value._kept)
        kept.append(value)
        return value._c

    return take


def points_of(options):
    """The number of grid points that options ask for."""
    return options.grid_points or 2 * options.harmonics + 1


def as_signal(value, kept, name):
    """A signal: one that was made, a number, or a function of time."""
    if value is None:
        return ffi.NULL
    made = Struct._classes["Signal"]
    if not isinstance(value, made):
        value = made().set_function(value) if callable(value) else made().set_constant(
            _number(value, name))
    return of_type("Signal")(value, kept, name)


def _number(value, name):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Error(f"{name}: expected a signal, a number or a function, got {value!r}") from None


def as_structs(kind, values, kept, name):
    """An array of structs, and their number."""
    values = list(values)
    array = ffi.new(f"{Struct._classes[kind]._type}[]", max(len(values), 1))
    for i, value in enumerate(values):
        array[i] = of_type(kind)(value, kept, f"{name}[{i}]")[0]
    return array, len(values)


def as_signals(values, shape, kept):
    """Many signals, one after the other."""
    rows = [list(row) for row in values]
    like("signals", [[0] * len(row) for row in rows] or [[]], shape)
    array = ffi.new("pdn_signal[]", max(shape[0] * shape[1], 1))
    for i, value in enumerate(value for row in rows for value in row):
        array[i] = as_signal(value, kept, f"signals[{i // shape[1]}][{i % shape[1]}]")[0]
    return array

