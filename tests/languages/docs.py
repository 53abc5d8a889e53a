"""The pages say nothing that is not there: files, links, names of the C interface and numbers of
their arguments; and each block of code belongs to a test, or to one of the checks here.

usage: docs.py
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [*sorted(ROOT.glob("docs/*.md")), *sorted(ROOT.glob("*.md")), ROOT / "python/README.md"]
BLOCK = re.compile(r"^(`{3,}|:{3,})(\S*)[^\n]*\n(.*?)^\1$", re.S | re.M)

# What runs or compares blocks, and names the page to do so; "" is for the checks of this file.
TESTED = {
    ("README.md", "c"): "tests/readme/CMakeLists.txt",
    ("README.md", "cmake"): "",
    ("docs/cluster.md", "c"): "",
    ("docs/cluster.md", "python"): "python/tests/test_executors.py",
    ("docs/cluster.md", "sh"): "",
    ("docs/cpp_and_fortran.md", "cpp"): "tests/languages/docs.cmake",
    ("docs/cpp_and_fortran.md", "fortran"): "tests/languages/docs.cmake",
    ("docs/families.md", "c"): "",
    ("docs/families.md", "text"): "tests/languages/docs.cmake",
    ("docs/guide.md", "python"): "python/tests/test_guide.py",
    ("docs/guide.md", "text"): "python/tests/test_guide.py",
    ("docs/guide.md", "report"): "python/tests/test_guide.py",
    ("docs/python.md", "python"): "python/tests/test_examples.py",
    ("docs/python.md", "sh"): "",
    ("python/README.md", "python"): "",
}
# Directives of the site, formulas, and the plan of directories, which the check of files reads.
OTHER_KINDS = {"math", "{toctree}", "{tab-set}", "{literalinclude}"}


def faults_of_blocks(name, text, header):
    for _, kind, block in BLOCK.findall(text):
        if kind in OTHER_KINDS or (name, kind) == ("ARCHITECTURE.md", "text"):
            continue
        if (name, kind) not in TESTED:
            yield f"a block of {kind or 'no language'} that no test runs: {block.strip()[:60]}"
        elif kind == "c":
            yield from faults_of_calls(block, header)
        elif kind == "cmake":
            tried = (ROOT / "tests/consumers/find_package/CMakeLists.txt").read_text()
            for call in set(re.findall(r"^\w+\(\w+ ", block, re.M)):
                if call.replace("my_program", "program") not in tried:
                    yield f"{call}...), which no test does"
        elif kind == "python":
            compile(block.replace("    ...\n", "    pass\n"), name, "exec")
        elif kind == "sh":
            subprocess.run(["sh", "-n"], input=block, text=True, check=True)


def faults_of_calls(block, header):
    """Calls with another number of arguments than the function has."""
    code = re.sub(r"/\*.*?\*/", "", block, flags=re.S)
    for call in re.finditer(r"\b(pdn_\w+)\(", code):
        function = call.group(1)
        if function not in header:
            continue
        depth, commas, at = 1, 0, call.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(code[at], 0)
            commas += code[at] == "," and depth == 1
            at += 1
        if commas + 1 != header[function]:
            yield f"{function} takes {header[function]} arguments, not {commas + 1}"


def names_in(text):
    return set(re.findall(r"\b(?:pdn|PDN)_\w+", text))


def faults_of_text(page, text, known):
    links = re.findall(r"\]\(([^)\s#]+)[^)]*\)", BLOCK.sub("", text))
    for link in links:
        if not link.startswith(("http:", "https:")) and not (page.parent / link).exists():
            yield f"a link to {link}, which is not there"
    kinds = "src tests docs script c_examples cpp_examples fortran_examples python petsc benches"
    for path in re.findall(r"`((?:%s)/[\w./-]+)`" % kinds.replace(" ", "|"), text):
        if not (ROOT / path).exists():
            yield f"the file {path}, which is not there"
    for name in sorted(names_in(text) - known):
        if not name.endswith("_"):
            yield f"the name {name}, which is not there"


def sources():
    """The text of everything that is no page."""
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True)
    for name in listed.stdout.decode().split():
        if Path(name).suffix in {".h", ".f90", ".rs", ".txt", ".cmake", ".c", ".py", ""}:
            yield (ROOT / name).read_text(encoding="utf-8", errors="ignore")


def arguments_of(header_text):
    """Numbers of arguments of the functions of a header, by their names."""
    return {
        name: 0 if arguments.strip() == "void" else arguments.count(",") + 1
        for name, arguments in re.findall(r"\b(pdn_\w+)\(([^()]*)\);", header_text)
    }


def main():
    text_of = {page: page.read_text(encoding="utf-8") for page in PAGES}
    names = "".join(sources())
    known = names_in(names)
    header = arguments_of((ROOT / "include/periodyn.h").read_text())
    header.update(arguments_of((ROOT / "petsc/periodyn_petsc.h").read_text()))
    faults, blocks = [], 0
    for page, text in text_of.items():
        name = str(page.relative_to(ROOT))
        blocks += len(BLOCK.findall(text))
        # Names of before are in the lists of changes.
        is_past = name in ("CHANGELOG.md", "docs/abi.md")
        found = [*faults_of_text(page, text, names_in(text) if is_past else known)]
        found += faults_of_blocks(name, text, header)
        faults += [f"{name}: {fault}" for fault in found]
    for (name, kind), test in TESTED.items():
        if not any(kind == found for _, found, _ in BLOCK.findall(text_of[ROOT / name])):
            faults.append(f"{name}: no block of {kind}")
        if test and Path(name).name not in (ROOT / test).read_text(encoding="utf-8"):
            faults.append(f"{test} does not read {name}")
    if faults:
        sys.exit("\n".join(faults))
    print(f"{len(PAGES)} pages with {blocks} blocks")


if __name__ == "__main__":
    main()
