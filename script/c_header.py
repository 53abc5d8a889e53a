"""What include/periodyn.h declares, as data: bindings of other languages are written from it."""

import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = ROOT / "include/periodyn.h"

DOCUMENTED = r"/\*\*((?:(?!\*/).)*?)\*/\s*"


def class_name(c_name):
    """A name of C as that of a class."""
    return "".join(part.capitalize() for part in c_name.removeprefix("pdn_").split("_"))


def write(*files):
    """Writes files, paths and texts; with --check only says whether they are what would be
    written."""
    changed = [file for file in files if not file[0].exists() or file[0].read_text() != file[1]]
    if sys.argv[1:] == ["--check"]:
        names = ", ".join(str(path.relative_to(ROOT)) for path, _ in changed)
        script = Path(sys.argv[0]).name
        sys.exit(f"{names}: not what periodyn.h says: run script/{script}" if changed else 0)
    for path, text in changed:
        path.write_text(text)


def text_of(comment):
    """The text of a comment, its lines without stars."""
    return re.sub(r"^\s*\* ?", "", comment, flags=re.M).strip()


def filled(text, width, first, rest):
    """Text in lines that begin with `first` and `rest`; a NUL is a blank where none is broken."""
    return textwrap.fill(text, width, initial_indent=first, subsequent_indent=rest,
                         break_long_words=False, break_on_hyphens=False).replace("\0", " ")


def folded(line, width):
    """A line of code, broken after commas if it is too long."""
    pad = re.match(" *", line)[0]
    return filled(re.sub("(?<!,) ", "\0", line[len(pad):]), width, pad, pad + "    ")


def extents_of(said):
    """Extents of an array by what is said of it, fastest first: numbers, counts, and C for the
    components of a quantity; none if it is no array."""
    extent = r"(?:\d+|C|\[[^]]*\])"
    found = re.search(rf"rray of (?:length|shape) ({extent}(?: x {extent})*)", said)
    return re.sub(r"[][]", "", found[1]).split(" x ") if found else []


class Header:
    """What periodyn.h declares, in its order; `docs` has what it says of each name."""

    def __init__(self, text):
        self.constants = re.findall(r"^#define (PDN_[A-Z0-9_]+) (-?\d+)$", text, re.M)
        self.opaque = re.findall(r"^typedef struct (\w+) \1;", text, re.M)
        self.structs = {
            name: [self.declaration(declared, " ".join(text_of(said).split()))
                   for said, declared in re.findall(DOCUMENTED + r"([^;/]+);", body, re.S)]
            for name, body in re.findall(
                r"^typedef struct (\w+) \{\n(.*?)^\} \1;", text, re.M | re.S)
        }
        named = r"(?:#define (PDN_\w+) -?\d+$|typedef struct (\w+)|" \
            r"(?:PDN_API\s)?[\w ]*?[ *(]+(pdn_\w+)\)?\()"
        self.docs = {
            "".join(names): text_of(said)
            for said, *names in re.findall(DOCUMENTED + named, text, re.S | re.M)
        }
        self.callbacks = self.prototypes(r"typedef (\w+) \(\*(\w+)\)", text)
        self.functions = self.prototypes(r"PDN_API\s+((?:const )?\w+) \*?(\w+)", text)
        self.callback_names = {function["name"] for function in self.callbacks}

    @staticmethod
    def declaration(text, said):
        """Base type, number of stars, const, name, length of an array in a struct; and of what is
        said of it whether it may be NULL, the extents of an array, whether it is 0 or 1, what those
        mean who leave it out, where a language lets them, and what tells it."""
        text = " ".join(text.split())
        const = text.startswith("const ")
        text = re.sub(r"\b(const|struct) ", "", text)
        base, stars, name, length = re.fullmatch(r"(\w+) (\**)(\w+)(?:\[(\d+)\])?", text).groups()
        extents = extents_of(said) if stars else []
        usual = re.search(r"usually (-?[\d.]*\d)", said)
        told = re.search(r"\(?(::pdn_\w+|pdn_\w+\.\w+)( \+ 1\) / 2)?", said)
        return {"base": base, "stars": len(stars), "const": const, "name": name, "length": length,
                "said": said, "optional": "NULL" in said and "not NULL" not in said,
                "extents": extents, "is_fixed": bool(extents) and all(map(str.isdigit, extents)),
                "is_flag": bool(re.match("1 if |1, or 0 |1: |0 or 1,", said)),
                "default": usual and (float if base == "double" else int)(usual[1]),
                "told": told and told[0].replace("::", "")}

    def first_of(self, name):
        """The first sentence of what is said of a name."""
        return re.split(r"\.(?: |$)", " ".join(self.docs[name].split()))[0]

    def prototypes(self, declared, text):
        return [self.prototype(*found) for found in re.findall(
            rf"{DOCUMENTED}{declared}\(([^()]*)\);", text, re.S)]

    def prototype(self, doc, result, name, arguments):
        doc = " ".join(text_of(doc).split())
        told = dict(re.findall(r"@param (\w+) +(.*?)(?= @|$| Threads:)", doc))
        parameters = [self.declaration(text, told.get(re.search(r"\w+$", text)[0], ""))
                      for text in arguments.split(",") if text.strip() != "void"]
        return {"name": name, "result": result, "summary": self.first_of(name),
                "parameters": parameters, "arguments": " ".join(arguments.split())}


class Binding:
    """A function of C, for another language: a subclass has a method for each kind of parameter."""

    def __init__(self, header, function):
        self.header, self.function = header, function
        self.name, self.parameters = function["name"], function["parameters"]

    def having(self, count):
        """The arrays whose length or shape a parameter tells."""
        return [p for p in self.parameters
                if re.search(rf"\b{count}\b", " ".join(p["extents"]))]

    def kind(self, p):
        """The kind of a parameter."""
        base, const, new = p["base"], p["const"], "" if p["const"] else "new_"
        if base == "void":
            return "data"
        if base in self.header.callback_names:
            return "callback"
        if base == "char":
            return "text" if const else "buffer"
        if base in self.header.opaque:
            return "handle" if p["stars"] == 1 else "new_handle"
        if base == "pdn_signal" and const:
            return "several_signals" if p["extents"] else "signal"
        if base in self.header.structs:
            kind = "several_structs" if p["extents"] else "struct"
            return "options" if p["name"] == "options" else f"{new}{kind}"
        if p["stars"] == 0:
            return "number"
        return f"{new}{'array' if const or p['extents'] else 'number'}"
