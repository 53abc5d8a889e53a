"""The examples of the spatial four-bar in C, C++ and Fortran print the same text and write the same
numbers, to the last of 17 digits; only times spent may differ.

usage: same_digits.py DIRECTORY PROGRAM...
"""

import subprocess
import sys
from pathlib import Path


def results(directory, program):
    """Lines printed, and rows written, of a program."""
    out = directory / (Path(program).stem + ".csv")
    done = subprocess.run([program, "--grid", "15", "--elements", "4", "--out", out], check=True,
                          capture_output=True, text=True)
    lines = [
        line.rstrip()
        for line in done.stdout.splitlines()
        if not line.startswith(("  time:", "    of it "))
    ]
    head, *rows = out.read_text().splitlines()
    return lines, head, [[float(number) for number in row.split(",")] for row in rows]


def main():
    directory = Path(sys.argv[1])
    first, *others = sys.argv[2:]
    lines, head, rows = results(directory, first)
    assert "converged" in lines[0] and any(line.startswith("Torque") for line in lines), lines
    assert len(rows) == 401 and any(row[3] < -10 for row in rows)
    for program in others:
        other_lines, other_head, other_rows = results(directory, program)
        wrong = [f"{a!r} and {b!r}" for a, b in zip(lines, other_lines) if a != b]
        wrong += [
            f"{a} and {b}" for a, b in zip([head] + rows, [other_head] + other_rows) if a != b
        ]
        if wrong or len(lines) != len(other_lines) or len(rows) != len(other_rows):
            sys.exit(f"{first} and {program} differ: " + "\n".join(wrong))
    print("\n".join(lines))


if __name__ == "__main__":
    main()
