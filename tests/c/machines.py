"""The same calls give the same numbers on another kind of processor, to rounding: on this one, on
that which valgrind has (without the widest vectors of some), and on an old one that qemu makes up,
where it is there.

usage: machines.py PROGRAM [VALGRIND]
"""

import shutil
import subprocess
import sys

# Of numbers of the size of the mechanism, or smaller: some thousand roundings. 3e-15 was found.
TOLERANCE = 1e-12


def numbers(command):
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    lines = [line.split() for line in done.stdout.splitlines()]
    return [(line[0], [float(word) for word in line[1:]]) for line in lines]


def main():
    program, *valgrind = sys.argv[1:]
    here = numbers([program])
    assert len(here) == 12 and all(any(values) for _, values in here), here
    assert numbers([program]) == here, "not the same twice"
    machines = {}
    if valgrind:
        machines["valgrind"] = [valgrind[0], "--tool=none", "--quiet", program]
    if shutil.which("qemu-x86_64"):
        machines["qemu, Nehalem"] = ["qemu-x86_64", "-cpu", "Nehalem", program]
    for name, command in machines.items():
        there = numbers(command)
        worst, bits = 0.0, 0
        for (what, ours), (other, theirs) in zip(here, there, strict=True):
            assert what == other and len(ours) == len(theirs)
            for a, b in zip(ours, theirs):
                worst = max(worst, abs(a - b))
                bits += a == b
        total = sum(len(values) for _, values in here)
        print(f"{name}: {worst:.1e} apart at most, {bits} of {total} numbers the same")
        if not worst < TOLERANCE:
            sys.exit(f"{name} differs by {worst}, more than {TOLERANCE}")
    # Numbers of threads, likewise: two lines of one, then two lines of two.
    for start in (0, 4):
        for k in range(2):
            one, two = here[start + k][1], here[start + 2 + k][1]
            worst = max(abs(a - b) for a, b in zip(one, two))
            print(f"{here[start][0]}, one thread and two: {worst:.1e} apart at most")
            if not worst < TOLERANCE:
                sys.exit(f"threads make a difference of {worst}")


if __name__ == "__main__":
    main()
