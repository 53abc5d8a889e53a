"""The tests that a build tree runs are those of ctests.txt: none was left out, none forgotten in
the list.

usage: ctests.py BUILD [WITHOUT...]

Each line of ctests.txt is the name of a test and, if it is not there without them, what it needs.
Give what the build tree was configured without. PDN_BLESS=1 appends new tests to the list.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

LIST = Path(__file__).with_suffix(".txt")


def main():
    build, *without = sys.argv[1:]
    shown = subprocess.run(
        ["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True
    )
    found = {test["name"] for test in json.loads(shown.stdout)["tests"]}
    lines = [line.split() for line in LIST.read_text().splitlines()]
    unknown = set(without) - {need for _, *needs in lines for need in needs}
    if unknown:
        sys.exit(f"no test in {LIST} needs {', '.join(sorted(unknown))}")
    expected = {name for name, *needs in lines if not set(needs) & set(without)}

    missing, added = sorted(expected - found), sorted(found - expected)
    if added and os.environ.get("PDN_BLESS"):
        LIST.write_text("\n".join(sorted([" ".join(line) for line in lines] + added)) + "\n")
        added = []
    if missing:
        print(f"left out of {build}: {', '.join(missing)}", file=sys.stderr)
    if added:
        print(f"not in {LIST}: {', '.join(added)}\nPDN_BLESS=1 {' '.join(sys.argv)} adds them; "
              "what they need is for you to add", file=sys.stderr)
    if missing or added:
        sys.exit(1)
    print(f"{len(found)} tests" + (f" without {', '.join(without)}" if without else ""))


if __name__ == "__main__":
    main()
