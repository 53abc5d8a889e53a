"""A program prints a text, with numbers that differ by a unit of their last digit at most; those
with exponents tell how accurate something is, and may be any.

usage: same_text.py FILE COMMAND [ARGUMENT...]
"""

import re
import subprocess
import sys
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


def differences(expected, printed):
    """What is not the same, line by line."""
    pairs = list(zip(expected.splitlines(), printed.splitlines()))
    wrong = []
    for line, other in pairs:
        numbers = list(zip(NUMBER.findall(line), NUMBER.findall(other)))
        near = all(abs(float(a) - float(b)) < 1.1 * unit_of(a) for a, b in numbers if "e" not in a)
        if not near or NUMBER.split(line) != NUMBER.split(other):
            wrong.append(f"expected: {line}\nprinted:  {other}")
    if len(expected.splitlines()) != len(printed.splitlines()):
        wrong.append(f"printed as a whole:\n{printed}")
    return wrong


def unit_of(number):
    """A unit of its last digit behind the point; next to nothing for a whole number."""
    _, point, behind = number.partition(".")
    return 10.0 ** -len(behind) if point else 1e-9


def main():
    expected = Path(sys.argv[1]).read_text(encoding="utf-8")
    printed = subprocess.run(sys.argv[2:], check=True, capture_output=True, text=True).stdout
    wrong = differences(expected, printed)
    if wrong:
        sys.exit("\n".join(wrong))
    print(printed)


if __name__ == "__main__":
    main()
