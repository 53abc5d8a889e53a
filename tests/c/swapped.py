"""Every function with two or more integers of different roles is tried with them exchanged: by
swapped_calls.h of test_swapped.c, or by the program that is named here.

Lengths of arrays (size_t) are no part of this, nor are bodies that a joint connects, which may
well be meant the other way round."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Where others are tried, as they need handles that test_swapped.c does not make.
ELSEWHERE = {
    "pdn_follow_locus": ("test_branches.c", "pdn_follow_locus(branch, load, fold,"),
    "pdn_stability_shape": ("test_stability.c", "pdn_stability_shape(stability, body, 0,"),
}
# Parameters of one role.
ROLES = {
    "body": ["first", "second"],
    "number": ["major", "minor", "blade", "index", "u", "v"],
}


def main():
    header = re.sub(r"/\*.*?\*/", "", (ROOT / "include/periodyn.h").read_text(), flags=re.S)
    role_of = {name: role for role, names in ROLES.items() for name in names}
    wrong, count = [], 0
    for function, parameters in re.findall(r"PDN_API\s+[\w ]+?\*?(pdn_\w+)\(([^;]*)\);", header):
        integers = re.findall(r"\bint32_t (\w+)", parameters)
        if len({role_of.get(name, name) for name in integers}) < 2:
            continue
        count += 1
        program, call = ELSEWHERE.get(function, ("swapped_calls.h", f"{function}("))
        if call not in (ROOT / "tests/c" / program).read_text():
            wrong.append(f"{function}: its integers ({', '.join(integers)}) are not tried "
                         f"exchanged in {program}")
    print("\n".join(wrong) or f"{count} functions are tried")
    return 1 if wrong or count < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
