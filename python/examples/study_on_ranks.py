"""A study on the processes of MPI, or of a Dask cluster.

    mpirun -n 3 python -m mpi4py.futures study_on_ranks.py
    python study_on_ranks.py tcp://scheduler:8786
"""

import sys

import numpy as np

import periodyn as pdn


def amplitude(stiffness):
    """Amplitude of a mass of 2 kg on a damped spring under a force of 1.5 N at 2 rad/s."""
    model = pdn.Model()
    body = model.add_rigid_body(2, [0, 0, 0], np.eye(3))
    slide = model.add_prismatic(pdn.GROUND, body, [0, 0, 0], [1, 0, 0])
    model.add_spring_damper(slide, pdn.DISPLACEMENT, stiffness, damping=0.3, rest=0)
    push = pdn.Signal().set_harmonics(cosines=[1.5], sines=[0])
    model.add_load(body, pdn.FRAME_SPACE, pdn.FORCE_1, push)
    solution = model.solve_periodic(np.pi)
    _, _, cosines, sines = solution.harmonics(pdn.Quantity(pdn.NODE_POSITION, body), 1)
    return float(np.hypot(cosines[0, 0], sines[0, 0]))


def study(executor):
    stiffnesses = np.linspace(5, 25, 41)
    found = pdn.sweep(amplitude, stiffnesses, executor=executor, store="study",
                      progress=lambda done, of: print(f"{done} of {of}"))
    print(f"largest amplitude {max(found):.6f} m")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        from dask.distributed import Client

        with Client(sys.argv[1]) as client:
            study(client.get_executor())
    else:
        from mpi4py.futures import MPIPoolExecutor

        with MPIPoolExecutor() as executor:
            study(executor)
