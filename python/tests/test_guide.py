"""The guide's blocks run in their order and print what it says; so do the tutorial's programs."""

import contextlib
import io
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
GUIDE = ROOT / "docs/guide.md"
PROGRAMS = sorted(path.stem for path in (ROOT / "docs/tutorial").glob("*.c"))


def masked(text):
    """Lines without their numbers, and without repetitions: what differs by rounding and time."""
    lines = []
    for line in text.strip().splitlines():
        line = " ".join(re.sub(r"-?\d[\d.]*(e[-+]?\d+)?", "#", line).split())
        if line not in lines:
            lines.append(line)
    return lines


def test_the_guide_tells_what_happens(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where a block writes its picture
    monkeypatch.setenv("MPLBACKEND", "Agg")
    blocks = re.findall(r"```(\w+)\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)
    names, printed, compared = {}, "", 0
    for kind, block in blocks:
        if kind == "python":
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compile(block, str(GUIDE), "exec"), names)  # the guide's own program
            printed = out.getvalue()
        elif kind == "text":
            assert printed.rstrip() == block.rstrip()
            compared += 1
        elif kind == "report":
            assert masked(printed) == masked(block)
            compared += 1
    assert (tmp_path / "rotor.png").read_bytes().startswith(b"\x89PNG")
    assert compared == len([kind for kind, _ in blocks if kind != "python"]) > 8


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_tutorial_tells_what_happens(name):
    stem = ROOT / "docs/tutorial" / name
    same = ROOT / "tests/languages/same_text.py"
    program = [sys.executable, stem.with_suffix(".py")]
    subprocess.run([sys.executable, same, stem.with_suffix(".txt"), *program], check=True)


def test_the_tutorial_has_five_programs():
    assert len(PROGRAMS) == 5


def test_the_rotor_takes_less_than_twenty_lines():
    blocks = re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)
    rotor, = (block for block in blocks if "rotor.png" in block)
    assert "import" in rotor  # by itself, as a program
    assert len([line for line in rotor.splitlines() if line.strip()]) < 20
