"""Many solves, on several processes, of this machine or of many."""

import os
import pickle

from ._call import Error


def sweep(function, values, processes=None, store=None, progress=None, executor=None):
    """What `function` gives for each of `values`, in their order.

    The function builds a model and solves it; it may return a Solution, or whatever else can be
    pickled. It must be one that processes can import (of a module, not a lambda). What it raises
    ends the sweep: what has not begun by then is not done.

    Args:
        function: called with a value
        values: the values, each of which can be pickled
        processes: how many at a time; None for as many as there are processors, 1 for this one
        store: directory where results are kept; a sweep that was cut off goes on from there
        progress: called with the number of results that are there, and of all
        executor: whatever has the interface of concurrent.futures.Executor, such as
            mpi4py.futures.MPIPoolExecutor or what get_executor() of a client of Dask gives; it is
            not shut down. None for processes of this machine
    """
    if processes is not None and executor is not None:
        raise Error("processes, executor: expected one of them, got both")
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise Error(f"executor: expected one of the interface of concurrent.futures.Executor, got "
                    f"{executor!r}")
    values = list(values)
    kept = _Kept(store, values)
    open_places = [i for i in range(len(values)) if i not in kept.results]
    told = progress or (lambda _done, _all: None)
    told(len(kept.results), len(values))

    def keep(i, result):
        kept.keep(i, values[i], result)
        told(len(kept.results), len(values))

    if processes == 1:
        for i in open_places:
            keep(i, function(values[i]))
    elif open_places and executor is not None:
        _spread(executor, function, values, open_places, keep)
    elif open_places:
        # Loaded here, as it takes longer than the rest of the package.
        import concurrent.futures
        import multiprocessing

        # A process that was forked would share the threads of this one.
        context = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(processes, context) as pool:
            _spread(pool, function, values, open_places, keep)
    return [kept.results[i] for i in range(len(values))]


def _spread(executor, function, values, places, keep):
    """Has an executor do the values at these places, and keeps results as they come."""
    import concurrent.futures

    tasks = {executor.submit(function, values[i]): i for i in places}
    try:
        for task in concurrent.futures.as_completed(tasks):
            keep(tasks[task], task.result())
    finally:
        # Nothing is left to do after the last; otherwise it ends here.
        for task in tasks:
            task.cancel()


class _Kept:
    """Results, in a directory if there is one."""

    def __init__(self, store, values):
        self.directory, self.results = None, {}
        if store is None:
            return
        import pathlib  # loaded where it is needed, as it takes long

        self.directory = pathlib.Path(store)
        self.directory.mkdir(parents=True, exist_ok=True)
        for i, value in enumerate(values):
            path = self.directory / f"{i}.pickle"
            if path.exists():
                of, self.results[i] = pickle.loads(path.read_bytes())
                if pickle.dumps(of) != pickle.dumps(value):
                    raise Error(f"store: expected results of these values, got other values in "
                                f"{path}: {of!r}, not {value!r}")

    def keep(self, i, value, result):
        self.results[i] = result
        if self.directory is not None:
            path = self.directory / f"{i}.pickle"
            part = path.with_suffix(".part")
            part.write_bytes(pickle.dumps((value, result)))
            os.replace(part, path)
