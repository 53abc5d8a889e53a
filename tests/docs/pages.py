"""What the pages say, as far as it can be checked: links, pictures, blocks of code, names.

    pages.py [--cc "CC FLAGS"] [--petsc "CC FLAGS"] [--sensitivities PROGRAM]

--cc: a C compiler, for blocks of C; --petsc: one with the flags of MPI and PETSc, for those that
use these; --sensitivities: the example, whose output a page shows. Without them these are left
out. Every block must be of a kind that is checked here, or be run by the test that BLOCKS names.
"""

import argparse
import re
import shlex
import struct
import subprocess
import sys
import xml.etree.ElementTree
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/languages"))

from same_text import differences  # noqa: E402

FENCE = re.compile(r"^```(\w*|\{\w+\} *[^\n]*)\n(.*?)^```$", re.M | re.S)
# Blocks of these languages on these pages are run or compared by these tests, as they stand there.
BLOCKS = {
    ("README.md", "c"): "tests/readme/CMakeLists.txt",
    ("docs/cpp_and_fortran.md", "cpp"): "tests/languages/docs.cmake",
    ("docs/cpp_and_fortran.md", "fortran"): "tests/languages/docs.cmake",
    ("docs/guide.md", "python"): "python/tests/test_guide.py",
    ("docs/guide.md", "text"): "python/tests/test_guide.py",
    ("docs/guide.md", "report"): "python/tests/test_guide.py",
    ("docs/python.md", "python"): "python/tests/test_examples.py",
    ("python/README.md", "python"): "python/tests/test_examples.py",
    ("docs/cluster.md", "python"): "python/tests/test_executors.py",
}
# These run the first block of a language alone.
OF_ONE_BLOCK = {"tests/readme/CMakeLists.txt"}
# What blocks of C on a page take for granted, in their order.
AROUND = {
    "docs/families.md": [
        "void f(pdn_model *model, int32_t force) { %s }",
        "void f(pdn_branch *branch, int32_t fold, int32_t load, pdn_branch_options options,"
        " pdn_branch *locus) { %s }",
        "void f(pdn_sensitivities *s, pdn_quantity moment, int32_t stiffness,"
        " pdn_solution *solution, double *derivatives) { %s }",
    ],
    "docs/cluster.md": [
        "pdn_model *make_model(void); static const double period = 1;\n%s",
        "void f(pdn_petsc_options options, pdn_solution *solution, pdn_model *model, double period,"
        " double *real, double *imaginary, double *errors, size_t found) { %s }",
        "pdn_model *make_model(double speed); double speed_of(size_t task);"
        "static const double amplitude;\n%s",
    ],
}
OF_PETSC = {"docs/cluster.md"}
# Names of an interface that is gone, which these pages are about.
OLD_NAMES = {"docs/abi.md", "CHANGELOG.md"}


def anchor(heading):
    """The name that a heading is linked by."""
    words = re.sub(r"[`*]|\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def links(text):
    """Links and pictures, outside of code."""
    text = re.sub(r"`[^`\n]*`", "", FENCE.sub("", text))
    return re.findall(r"(!?)\[[^]]*\]\(([^)\s]+)\)", text)


def broken_links(path, text, shown):
    for is_picture, target in links(text):
        if re.match(r"https?://", target):
            continue
        place, _, name = target.partition("#")
        file = (path.parent / place).resolve() if place else path
        if is_picture:
            shown.add(file)
        if not file.exists():
            yield f"{target}: is not there"
        elif name and name not in map(anchor, re.findall(r"^#+ (.*)$", FENCE.sub(
                "", file.read_text(encoding="utf-8")), re.M)):
            yield f"{target}: no such heading"


def picture_fault(file):
    """What is wrong with a picture, which must be whole, and not of one colour."""
    data = file.read_bytes()
    if file.suffix == ".svg":
        try:
            drawn = list(xml.etree.ElementTree.fromstring(data).iter())
        except xml.etree.ElementTree.ParseError as error:
            return str(error)
        return None if len(drawn) > 10 else "nothing is drawn"
    if not data.startswith(b"\x89PNG\r\n\x1a\n"):
        return "neither PNG nor SVG"
    at, pixels, ended = 8, b"", False
    while at + 8 <= len(data) and not ended:
        length, kind = struct.unpack_from(">I4s", data, at)
        if at + 12 + length > len(data):
            return "cut off"
        body = data[at + 8:at + 8 + length]
        if zlib.crc32(kind + body) != struct.unpack_from(">I", data, at + 8 + length)[0]:
            return "damaged"
        pixels += body if kind == b"IDAT" else b""
        ended = kind == b"IEND"
        at += 12 + length
    if not ended:
        return "cut off"
    return None if len(set(zlib.decompress(pixels))) > 8 else "of one colour"


def compile_fault(compiler, program):
    """What a compiler says of a program, as far as it is an error."""
    done = subprocess.run(
        [*shlex.split(compiler), "-std=c99", "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
         "-Wno-unused-parameter", "-Wno-unused-variable", "-Wno-unused-function",
         "-Wno-unused-but-set-variable", "-I", ROOT / "include", "-I", ROOT / "petsc",
         "-x", "c", "-"], input=program, capture_output=True, text=True, check=False)
    return done.stderr if done.returncode else None


def fault_of_c(page, number, block, options):
    """Of a piece of C that is no whole program."""
    if page not in AROUND or number >= len(AROUND[page]):
        return "no test runs it, and AROUND does not say what it takes for granted"
    compiler = options.petsc if page in OF_PETSC else options.cc
    if not compiler:
        return None
    # What is left out in it; calls of a piece that follow its functions are put into one.
    block = re.sub(r"^\s*\.\.\.$", "", block, flags=re.M)
    body, _, calls = block.partition("\n}\n")
    if calls.strip():
        block = f"{body}\n}}\nvoid g(void) {{ {calls} }}"
    includes = "".join(re.findall(r"^#include.*\n", block, re.M))
    block = re.sub(r"^#include.*\n", "", block, flags=re.M)
    if page in OF_PETSC:
        includes += "#include <periodyn_petsc.h>\n#include <petscsys.h>\n"
    whole = AROUND[page][number].replace("%s", block)
    return compile_fault(compiler, f"#include <periodyn.h>\n{includes}{whole}\n")


def fault_of_block(page, language, number, block, options):
    """What is wrong with a block of a language, by its number among those of the page."""
    if (page, language) in BLOCKS:
        test = BLOCKS[page, language]
        if number > 0 and test in OF_ONE_BLOCK:
            return f"{test} runs the first alone"
        there = page in (ROOT / test).read_text(encoding="utf-8")
        return None if there else f"{test} does not read the page"
    if language == "c":
        return fault_of_c(page, number, block, options)
    if language.startswith("{"):  # directives of the site, which script/docs makes
        _, _, included = language.partition("{literalinclude} ")
        return f"{included} is not there" if not (ROOT / "docs" / included).exists() else None
    if language == "sh":
        done = subprocess.run(["sh", "-n"], input=block, capture_output=True, text=True,
                              check=False)
        return done.stderr or None
    if language == "math":
        opened = re.findall(r"\\begin\{(\w+)\}", block), re.findall(r"\\end\{(\w+)\}", block)
        even = block.replace(r"\{", "").count("{") == block.replace(r"\}", "").count("}")
        return None if even and sorted(opened[0]) == sorted(opened[1]) else "braces do not match"
    if (page, language) == ("README.md", "cmake"):
        used = (ROOT / "tests/consumers/find_package/CMakeLists.txt").read_text()
        used = re.sub(r"\$\{WANTED\} |\$\{KIND\}", "", used).replace("(program ", "(my_program ")
        lines = [line.split("#")[0].strip() for line in block.splitlines()]
        return "; ".join(f"no consumer has {line}" for line in lines
                         if line.replace("::periodyn)", "::)") not in used) or None
    if (page, language) == ("docs/families.md", "text"):
        if not options.sensitivities:
            return None
        printed = subprocess.run([options.sensitivities], capture_output=True, text=True,
                                 check=True).stdout
        return "\n".join(differences(block, printed)) or None
    if (page, language) == ("ARCHITECTURE.md", "text"):
        names = re.findall(r"^[│├└─ ]*(?:[a-z_]+ ─+ )?([a-z_]+)  ", block, re.M)
        there = {path.stem for path in (ROOT / "src").rglob("*")}
        missing = [name for name in names if name not in there]
        return f"no modules: {missing}" if missing or len(names) < 5 else None
    return "no test runs it"


def wrong_names(page, text, known):
    """Functions, types and constants that are none, and files that are not there."""
    if page not in OLD_NAMES:
        for name in sorted(set(re.findall(r"\b(?:pdn|PDN)_\w*[A-Za-z0-9]\b(?!_?\*|\.\.\.|_\b)",
                                          text))):
            if name not in known and not any(other.startswith(f"{name}_") for other in known):
                yield f"{name}: is not in the headers"
    for name in re.findall(r"`((?:docs|src|tests|script|c_examples|petsc|python|include|benches)"
                           r"/[\w./]*\w)[` ]", text):
        if not (ROOT / name).exists():
            yield f"{name}: is not there"


def commands(text):
    """Lines of shell that are set off by four spaces."""
    text = FENCE.sub("", text)
    return re.findall(r"(?<=\n\n)(?:    .*\n)+|(?<=\n)    (?:script|c_examples)/.*\n", text)


def wrong_commands(text):
    """Scripts and examples that are not there, and options that they do not take."""
    for line in "".join(commands(text)).splitlines():
        words = line.split("#")[0].split()
        name = words[0].removeprefix("./") if words else ""
        if name.startswith("script/") and not (ROOT / name).exists():
            yield f"{name}: is not there"
        source = ROOT / "c_examples" / f"{Path(name).name}.c"
        if words and source.exists() and "." not in name:
            taken = " ".join(re.findall(r'check_options\(argc, argv,\s*((?:"[^"]*"\s*)+)\)',
                                        source.read_text(encoding="utf-8")))
            for word in words[1:]:
                if word.startswith("--") and word not in taken:
                    yield f"{name} takes no {word}"


def faults(options):
    tracked = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True,
                             check=False).stdout.split()
    pages = tracked or [str(path.relative_to(ROOT)) for path in (
        *ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), ROOT / "python/README.md")]
    headers = [*ROOT.glob("include/periodyn*"), *ROOT.glob("petsc/*.h"), *ROOT.rglob("CMake*.txt")]
    others = [ROOT / "script", ROOT / "build.rs", ROOT / "tests"]
    sources = [*headers, *(file for place in others for file in (
        place.rglob("*") if place.is_dir() else [place]) if file.is_file()
        and file.suffix in ("", ".rs", ".py", ".txt", ".sh", ".cmake"))]
    known = set()
    for source in sources:
        known |= set(re.findall(r"\b(?:pdn|PDN)_\w+", source.read_text(errors="replace")))
    shown, blocks = set(), 0
    for page in pages:
        path = ROOT / page
        text = path.read_text(encoding="utf-8")
        told = [*broken_links(path, text, shown), *wrong_commands(text),
                *wrong_names(page, text, known)]
        if text.count("```") % 2 or len(FENCE.findall(text)) * 2 != text.count("```"):
            told.append("a block of code without its beginning or end")
        numbers = {}
        for language, block in FENCE.findall(text):
            number = numbers[language] = numbers.get(language, -1) + 1
            blocks += 1
            fault = fault_of_block(page, language, number, block, options)
            if fault:
                told.append(f"block {number + 1} of {language or 'no language'}: {fault}")
        yield from (f"{page}: {fault}" for fault in told)
    for file in sorted(shown):
        if file.exists() and picture_fault(file):
            yield f"{file.relative_to(ROOT)}: {picture_fault(file)}"
    for file in sorted((ROOT / "docs/images").rglob("*.*")):
        if file not in shown:
            yield f"{file.relative_to(ROOT)}: no page shows it"
    print(f"{len(pages)} pages, {blocks} blocks, {len(shown)} pictures")


def main():
    parser = argparse.ArgumentParser()
    for option in ("--cc", "--petsc", "--sensitivities"):
        parser.add_argument(option)
    found = list(faults(parser.parse_args()))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
