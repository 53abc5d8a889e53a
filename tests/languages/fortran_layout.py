"""The derived types and constants of module periodyn_c are those of C: sizes, offsets and sizes of
all fields, and values, as the two compilers see them.

usage: fortran_layout.py C_COMPILER FORTRAN_COMPILER DIRECTORY
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def structs(header):
    """Names of the fields of each struct."""
    header = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    found = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", header, re.S):
        found[name] = [re.search(r"(\w+)(?:\[\d+\])?\s*$", field).group(1)
                       for field in body.split(";") if field.strip()]
    return found


def c_program(types, constants):
    lines = ["#include <periodyn.h>", "#include <stdio.h>", "int main(void)", "{"]
    for name, fields in types.items():
        lines.append(f'    printf("{name} %d\\n", (int)sizeof({name}));')
        for field in fields:
            lines.append(f'    printf("{name}.{field} %d %d\\n", (int)offsetof({name}, {field}), '
                         f"(int)sizeof((({name} *)0)->{field}));")
    lines += [f'    printf("{name} %d\\n", {name});' for name in constants]
    return "\n".join(lines + ["    return 0;", "}", ""])


def fortran_program(types, constants):
    lines = ["program layout", "    use periodyn_c", "    implicit none"]
    lines += [f"    type({name}), target :: x_{name}" for name in types]
    for name, fields in types.items():
        lines.append(f"    print '(a, 1x, i0)', '{name}', c_sizeof(x_{name})")
        for field in fields:
            lines.append(f"    print '(a, 2(1x, i0))', '{name}.{field}', &")
            lines.append(f"        transfer(c_loc(x_{name}%{field}), 0_c_intptr_t) - &")
            lines.append(f"        transfer(c_loc(x_{name}), 0_c_intptr_t), &")
            lines.append(f"        storage_size(x_{name}%{field}) / 8 * &")
            lines.append(f"        size([x_{name}%{field}])")
    lines += [f"    print '(a, 1x, i0)', '{name}', {name}" for name in constants]
    return "\n".join(lines + ["end program layout", ""])


def main():
    c_compiler, fortran_compiler, directory = sys.argv[1:]
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    header = (ROOT / "include/periodyn.h").read_text()
    types = structs(header)
    constants = re.findall(r"^#define (PDN_\w+) -?\d+$", header, re.M)
    (directory / "layout.c").write_text(c_program(types, constants))
    (directory / "layout.f90").write_text(fortran_program(types, constants))

    include = ROOT / "include"
    subprocess.run(
        [c_compiler, f"-I{include}", "layout.c", "-o", "c_layout"], cwd=directory, check=True
    )
    subprocess.run(
        [fortran_compiler, str(include / "periodyn.f90"), "layout.f90", "-c"],
        cwd=directory,
        check=True,
    )
    # Only the raw module, whose functions are not called, goes into the program.
    subprocess.run(
        [fortran_compiler, "layout.o", "-o", "fortran_layout"], cwd=directory, check=True
    )
    c, fortran = (
        subprocess.run(
            [directory / name], cwd=directory, check=True, capture_output=True, text=True
        ).stdout.splitlines()
        for name in ["c_layout", "fortran_layout"]
    )
    wrong = [f"C: {a}, Fortran: {b}" for a, b in zip(c, fortran) if a != b]
    if wrong or len(c) != len(fortran) or not c:
        sys.exit("\n".join(wrong) or "different numbers of lines")
    print(f"{len(types)} types, {len(constants)} constants, {len(c)} lines")


if __name__ == "__main__":
    main()
