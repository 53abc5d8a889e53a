"""Sweeps on processes, and from where they were cut off."""

import numpy as np
import pytest
from models import response, solution_for

import periodyn as pdn

VALUES = [2.0, 4.0, 9.0]


@pytest.mark.parametrize("processes", [1, 2])
def test_results_come_in_order(processes):
    told = []
    found = pdn.sweep(response, VALUES, processes, progress=lambda *counts: told.append(counts))
    np.testing.assert_allclose(found, [1 / abs(k - 1 + 0.1j) for k in VALUES], rtol=1e-10)
    assert told == [(0, 3), (1, 3), (2, 3), (3, 3)]


def test_solutions_come_from_processes():
    found = pdn.sweep(solution_for, VALUES[:2], 2)
    assert all(solution.converged for solution in found)


def test_a_sweep_goes_on_where_it_was_cut_off(tmp_path):
    def until(limit):
        def solve(value):
            if value > limit:
                raise KeyboardInterrupt
            calls.append(value)
            return response(value)

        return solve

    calls = []
    with pytest.raises(KeyboardInterrupt):
        pdn.sweep(until(5), VALUES, 1, store=tmp_path)
    found = pdn.sweep(until(10), VALUES, 1, store=tmp_path)
    assert calls == VALUES
    np.testing.assert_allclose(found, [1 / abs(k - 1 + 0.1j) for k in VALUES], rtol=1e-10)
    with pytest.raises(pdn.Error, match="other values"):
        pdn.sweep(until(10), [1.0, 2.0, 3.0], 1, store=tmp_path)
