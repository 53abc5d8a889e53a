"""Sweeps on executors: those of concurrent.futures, MPI's and Dask's."""

import concurrent.futures
import multiprocessing
import os
import pathlib
import re
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest
from models import response, solution_for

import periodyn as pdn

VALUES = [2.0, 4.0, 9.0]
EXPECTED = [1 / abs(k - 1 + 0.1j) for k in VALUES]
EXAMPLE = pathlib.Path(__file__).parents[1] / "examples/study_on_ranks.py"
# The stiffness that is resonant, 2 kg (2 rad/s)², is among those of the example: F / (c ω).
LARGEST = "largest amplitude 2.500000 m"
# Open MPI asks for that where root runs it, or on fewer processors than ranks.
LENIENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
}


def processes():
    return concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn"))


@pytest.mark.parametrize("make", [concurrent.futures.ThreadPoolExecutor, processes])
def test_results_come_in_order(make):
    told = []
    with make() as executor:
        found = pdn.sweep(response, VALUES, executor=executor,
                          progress=lambda *counts: told.append(counts))
        # It is the caller's, and still open.
        assert executor.submit(int).result() == 0
    np.testing.assert_allclose(found, EXPECTED, rtol=1e-10)
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]


def test_a_study_goes_on_and_ends_with_what_fails(tmp_path):
    calls, first_is_kept = [], threading.Event()

    def solve(value):
        calls.append(value)
        if value == 4.0 and len(calls) == 2:
            assert first_is_kept.wait(60)
            raise ValueError("too stiff")
        return response(value)

    def told(done, _of):
        if done == 1:
            first_is_kept.set()

    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        executor.submit(int).result()
        values = VALUES + [16.0 + i for i in range(50)]
        with pytest.raises(ValueError, match="too stiff"):
            pdn.sweep(solve, values, store=tmp_path, progress=told, executor=executor)
        # The thread may have taken one more before the rest was cancelled.
        assert calls[:2] == VALUES[:2] and len(calls) < len(values)
    before = len(list(tmp_path.glob("*.pickle")))
    assert before >= 1
    calls.clear()
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        found = pdn.sweep(response, values, store=tmp_path, executor=executor)
    assert calls == []
    np.testing.assert_allclose(found, [1 / abs(k - 1 + 0.1j) for k in values], rtol=1e-10)
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        assert pdn.sweep(solve, values, store=tmp_path, executor=executor) == found
    assert calls == []


def test_what_is_no_executor_is_refused():
    with pytest.raises(pdn.Error, match="executor: expected .* got 4"):
        pdn.sweep(response, VALUES, executor=4)
    with concurrent.futures.ThreadPoolExecutor() as executor:
        with pytest.raises(pdn.Error, match="one of them"):
            pdn.sweep(response, VALUES, processes=2, executor=executor)


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                  worker_dashboard_address=None) as cluster:
        yield cluster


def test_dask(cluster):
    distributed = pytest.importorskip("distributed")
    with distributed.Client(cluster) as client:
        executor = client.get_executor()
        np.testing.assert_allclose(pdn.sweep(response, VALUES, executor=executor), EXPECTED,
                                   rtol=1e-10)
        assert all(s.converged for s in pdn.sweep(solution_for, VALUES[:2], executor=executor))
        with pytest.raises(pdn.Error, match="no number"):
            pdn.sweep(fails, VALUES, executor=executor)


def fails(_value):
    raise pdn.Error("no number")


def run_example(launcher, *arguments, directory):
    done = subprocess.run([*launcher, EXAMPLE, *arguments], cwd=directory, timeout=120,
                          env=os.environ | LENIENT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def check_example(launcher, *arguments, directory):
    lines = run_example(launcher, *arguments, directory=directory)
    assert lines == [f"{i} of 41" for i in range(42)] + [LARGEST]
    # Cut off after some, it solves only what is missing.
    kept = sorted((directory / "study").glob("*.pickle"))
    for path in kept[30:]:
        path.unlink()
    lines = run_example(launcher, *arguments, directory=directory)
    assert lines == [f"{i} of 41" for i in range(30, 42)] + [LARGEST]


def test_the_page_shows_the_example():
    page = (EXAMPLE.parents[2] / "docs/cluster.md").read_text()
    shown, = re.findall(r"```python\n(.*?)```", page, re.S)
    assert shown == EXAMPLE.read_text().partition('"""\n\n')[2]


def test_the_example_on_dask(cluster, tmp_path):
    check_example([sys.executable], cluster.scheduler_address, directory=tmp_path)


def test_the_example_on_mpi(tmp_path):
    pytest.importorskip("mpi4py")
    if shutil.which("mpirun") is None:
        pytest.skip("no mpirun")
    launcher = ["mpirun", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    check_example(launcher, directory=tmp_path)
