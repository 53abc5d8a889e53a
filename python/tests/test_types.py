"""The types that the package tells: of every function, with its parameters, and checked by mypy."""

import ast
import inspect
import pathlib
import subprocess
import sys

import pytest

import periodyn as pdn
from periodyn import _interface

STUBS = pathlib.Path(_interface.__file__).with_suffix(".pyi")
PROGRAM = """
import numpy as np
import periodyn as pdn

model = pdn.Model()
body: int = model.add_rigid_body(1, [0, 0, 0], np.eye(3))
hinge = model.add_revolute(pdn.GROUND, body, [0, 0, 0], [0, 0, 1])
model.prescribe(hinge, pdn.ROTATION, pdn.Signal().set_harmonics(rate=1.0))
model.add_load(body, pdn.FRAME_SPACE, pdn.FORCE_1, lambda time: 2 * time)
solution = model.solve_periodic(1.0, progress=True)
print(solution.sample(pdn.Quantity(pdn.NODE_POSITION, body), np.linspace(0, 1)).shape)
"""


def parameters_of(function):
    given = function.args
    names = [a.arg for a in (*given.posonlyargs, *given.args, *given.kwonlyargs)]
    return [name for name in names if name != "self"]


def compare(definitions, owner):
    """How many functions there are, all with the parameters that they have."""
    for function in definitions:
        real = inspect.signature(getattr(owner, function.name)).parameters
        assert parameters_of(function) == [name for name in real if name != "self"], function.name
    return len(definitions)


def test_every_function_and_parameter_has_a_type():
    tree = ast.parse(STUBS.read_text())
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    count = compare(functions, _interface)
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
    for made in classes:
        methods = [node for node in made.body if isinstance(node, ast.FunctionDef)]
        count += compare(methods, getattr(_interface, made.name))
        fields = [node.target.id for node in made.body if isinstance(node, ast.AnnAssign)]
        assert fields == list(getattr(_interface, made.name)._fields()) if fields else True
    assert count > 200
    told = {node.name for node in (*classes, *functions)}
    there = {name for name, value in vars(_interface).items()
             if getattr(value, "__module__", None) == _interface.__name__}
    assert told == there
    assert (STUBS.parent / "py.typed").exists()


def test_mypy_takes_them(tmp_path):
    pytest.importorskip("mypy")

    def check(program):
        file = tmp_path / "program.py"
        file.write_text(program)
        return subprocess.run([sys.executable, "-m", "mypy", file], cwd=tmp_path, check=False,
                              capture_output=True, text=True)

    assert check(PROGRAM).returncode == 0, check(PROGRAM).stdout
    wrong = check(PROGRAM.replace("pdn.GROUND, body", "'ground', body"))
    assert 'Argument 1 to "add_revolute"' in wrong.stdout
    assert pdn.Model().node_count() == 0
