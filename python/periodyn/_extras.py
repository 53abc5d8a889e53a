"""What handles have in Python beyond the functions of C."""

import os

import numpy

from ._abi import ffi


class Handle:
    """What the library has made, freed with the object."""

    _free = None

    def __new__(cls, *_arguments, **_options):
        handle = super().__new__(cls)
        # Callbacks of the model, which whatever is made of it needs, too.
        handle._kept = []
        return handle

    def _own(self, c):
        self._c = ffi.gc(c, type(self)._free)

    @classmethod
    def _made(cls, c, kept):
        handle = cls.__new__(cls)
        handle._kept = kept
        handle._own(c)
        return handle


class Saved(Handle):
    """What can be saved can be pickled, without functions of the user."""

    def __reduce__(self):
        import tempfile  # loaded where it is needed, as it takes long

        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "saved")
            self.save(path)
            with open(path, "rb") as file:
                return _loaded, (type(self), file.read())


def _loaded(kind, saved):
    import tempfile

    with tempfile.TemporaryDirectory() as directory:
        path = os.path.join(directory, "saved")
        with open(path, "wb") as file:
            file.write(saved)
        return kind.load(path)


class ModelExtras(Saved):
    """A model, in Python."""

    def __repr__(self):
        return f"<periodyn.Model: {self.node_count()} nodes, {self.joint_count()} joints>"


class Outcome:
    """What solves have in common."""

    @property
    def converged(self) -> bool:
        """Whether this is a solution: converged, on the last grid tried at least."""
        return self.outcome_name in ("CONVERGED", "TOLERANCE_NOT_MET")

    @property
    def outcome_name(self) -> str:
        """Name of the outcome, such as "CONVERGED"."""
        from ._interface import OUTCOMES

        return OUTCOMES.get(self.outcome(), str(self.outcome()))

    def __repr__(self):
        return f"<periodyn.{type(self).__name__}: {self.outcome_name}>"

    def __str__(self):
        return self.report()


class ModesExtras(Outcome, Handle):
    """Modes, in Python: a sequence of Mode."""

    def __len__(self):
        return self.count()[0]

    def __getitem__(self, mode):
        if not 0 <= mode < len(self):
            raise IndexError(mode)
        return self.get(mode)

    @property
    def frequencies(self) -> numpy.ndarray:
        """Oscillations per unit of time of each mode."""
        return numpy.array([mode.frequency for mode in self])


class StabilityExtras(Outcome, Handle):
    """Floquet multipliers, in Python: a sequence of Multiplier."""

    def __len__(self):
        return self.count()[0]

    def __getitem__(self, number):
        if not 0 <= number < len(self):
            raise IndexError(number)
        return self.get(number)

    @property
    def multipliers(self) -> numpy.ndarray:
        """The multipliers as complex numbers."""
        return numpy.array([complex(m.real, m.imaginary) for m in self])


class SolutionExtras(Outcome, Saved):
    """A solution, in Python."""

    def as_dict(self) -> dict:
        """What the report says, as numbers and texts that `json.dump` writes (`report_json`); what
        is not known, or not finite, is None."""
        import json

        return json.loads(self.report_json())


class BranchExtras(Handle):
    """A branch, in Python: a sequence of BranchPoint."""

    def __len__(self):
        return self.count()

    def __getitem__(self, point):
        if not 0 <= point < len(self):
            raise IndexError(point)
        return self.get(point)

    @property
    def parameters(self) -> numpy.ndarray:
        """The parameter at each point."""
        return numpy.array([point.parameter for point in self])


class TableExtras(Handle):
    """A table, in Python."""

    def to_frame(self):
        """The table as a pandas.DataFrame."""
        import tempfile

        import pandas

        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "table.csv")
            self.write_csv(path)
            return pandas.read_csv(path)
