"""Every function that the library exports is in the header, called in periodyn.hpp and in Python,
bound in module periodyn_c of periodyn.f90, and called in its module periodyn; and every constant
is in all."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def read(name, comment):
    """A file without its comments."""
    return re.sub(comment, "", (ROOT / name).read_text(), flags=re.S)


def called_in_python():
    """Functions that the package calls, and those that Python needs no name for: exceptions stand
    for the message of an error, and are kept by the package itself."""
    package = (ROOT / "python/periodyn").glob("*.py")
    texts = [path.read_text() for path in package if path.name != "_abi.py"]
    return set(re.findall(r"\b(?:lib|LIBRARY)\.(pdn_\w+)", "\n".join(texts))) | {
        "pdn_set_last_error", "pdn_set_callback_error", "pdn_last_callback_code",
        "pdn_set_panic_printing", "pdn_version_check",
    }


def main():
    header = read("include/periodyn.h", r"/\*.*?\*/")
    cpp = read("include/periodyn.hpp", r"/\*.*?\*/|//[^\n]*")
    fortran = read("include/periodyn.f90", r"![^\n]*")
    raw, mark, objects = fortran.partition("end module periodyn_c\n")
    assert mark

    exported = set((ROOT / "tests/abi/symbols.txt").read_text().split())
    # Names of the raw layer that have another one in module periodyn.
    renamed = dict(re.findall(r"\b(c_\w+) => (pdn_\w+)", objects))
    used = re.sub(r"\bc_\w+ => pdn_\w+", "", objects)
    # Generic names of the module's own are no calls.
    used = re.sub(r"^\s*(?:end )?interface pdn_\w+$", "", used, flags=re.M)
    called = set(re.findall(r"\bpdn_\w+", used)) - set(renamed.values())
    called |= {renamed[name] for name in set(re.findall(r"\bc_\w+", used)) & set(renamed)}

    # These take and give single numbers only, and are passed on as they are.
    called |= {"pdn_last_callback_code", "pdn_set_panic_printing"}

    lists = {
        "tests/abi/symbols.txt": exported,
        "periodyn.h": set(re.findall(r"PDN_API\s+[\w ]+?\*?(pdn_\w+)\(", header)),
        "periodyn.hpp": exported & set(re.findall(r"\bpdn_\w+", cpp)),
        "python/periodyn": exported & called_in_python(),
        "periodyn.f90, module periodyn_c": set(re.findall(r'bind\(C, name="(\w+)"\)', raw)),
        "periodyn.f90, module periodyn": exported & called,
    }
    all_of_them = set().union(*lists.values())
    wrong = [f"functions not in {name}: {sorted(all_of_them - found)}"
             for name, found in lists.items() if found != all_of_them]

    constants = set(re.findall(r"^#define (PDN_\w+) -?\d+$", header, re.M))
    # Statuses, which are left as they are, and kinds that wrappers set.
    kinds = r"PDN_(OK$|ERR_|LINE_|SURFACE_|SIGNAL_|VERSION_PATCH)"
    not_wrapped = {
        name for name in constants if re.match(kinds, name)
    }
    interface = (ROOT / "python/periodyn/_interface.py").read_text()
    python = re.sub(r"^([A-Z]\w+) = -?\d+$", r"PDN_\1", interface, flags=re.M)
    for name, text, wanted in [("periodyn.hpp", cpp, constants - not_wrapped),
                               ("periodyn.f90", raw, constants),
                               ("python/periodyn", python, constants)]:
        missing = wanted - set(re.findall(r"\bPDN_\w+", text))
        if missing:
            wrong.append(f"constants not in {name}: {sorted(missing)}")

    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(all_of_them)} functions, {len(constants)} constants")


if __name__ == "__main__":
    main()
