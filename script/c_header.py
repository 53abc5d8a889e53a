"""What include/periodyn.h declares, as data: bindings of other languages are written from it."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADER = ROOT / "include/periodyn.h"

# What those who do not say it mean, in languages where parameters may be left out.
DEFAULTS = {
    "pdn_sensitivities_add_quantity": {"at": 0.0},
    "pdn_conditions_add_quantity": {"scale": 0.0},
    "pdn_shell_section_set_isotropic": {"drilling": 1.0, "drilling_gradient": 0.1},
    "pdn_model_add_shell": {"join": 1},
    "pdn_model_add_shell_grid": {"join": 1},
    "pdn_signal_set_harmonics": {"mean": 0.0, "rate": 0.0},
    "pdn_signal_set_samples": {"rate": 0.0},
    "pdn_model_add_spring_damper": {"damping": 0.0, "rest": 0.0},
    "pdn_model_add_nonlinear_spring_damper": {"rest": 0.0},
    "pdn_equations_update": {"step": 1.0},
    "pdn_equations_solution": {"root": -1},
}

DOCUMENTED = r"/\*\*((?:(?!\*/).)*?)\*/\s*"
ARGUMENTS = r"\(([^()]*)\);"


def class_name(c_name):
    """A name of C as that of a class."""
    return "".join(part.capitalize() for part in c_name.removeprefix("pdn_").split("_"))


def write(*files):
    """Writes files, paths and texts; with --check only says whether they are what would be
    written."""
    changed = [(path, text) for path, text in files
               if not path.exists() or path.read_text() != text]
    if sys.argv[1:] == ["--check"]:
        names = ", ".join(str(path.relative_to(ROOT)) for path, _ in changed)
        script = Path(sys.argv[0]).name
        sys.exit(f"{names}: not what periodyn.h says: run script/{script}" if changed else 0)
    for path, text in changed:
        path.write_text(text)


def text_of(comment):
    """The text of a comment, its lines without stars."""
    return re.sub(r"^\s*\* ?", "", comment, flags=re.M).strip()


def extents_of(said):
    """Extents of an array by what is said of it, fastest first: numbers, counts, and C for the
    components of a quantity; none if it is no array."""
    if "matrix of 6 N x 6 N" in said:
        return ["6 * points", "6 * points"]
    found = re.search(r"array of (?:length|shape) (?:(\d+|C|\[\w+\]) x )?(\d+|C|\[[^\]]*\])", said)
    first, last = [part and part.strip("[]") for part in found.groups()] if found else (None, None)
    if not first and (last == "36" or last == "9" and re.search("symmetric|rotation matri", said)):
        return {"36": ["6", "6"], "9": ["3", "3"]}[last]
    inner = re.fullmatch(r"(\d+) (?:x )?(\w+)", last or "")
    return [*inner.groups()] if inner else [e for e in (first, last) if e]


class Header:
    """What periodyn.h declares, in its order; `docs` has what it says of each name."""

    def __init__(self, text):
        self.constants = re.findall(r"^#define (PDN_[A-Z0-9_]+) (-?\d+)$", text, re.M)
        self.opaque = re.findall(r"^typedef struct (\w+) \1;", text, re.M)
        self.structs = {
            name: [
                {**self.declaration(declared), "said": " ".join(text_of(said).split())}
                for said, declared in re.findall(DOCUMENTED + r"([^;/]+);", body, re.S)
            ]
            for name, body in re.findall(
                r"^typedef struct (\w+) \{\n(.*?)^\} \1;", text, re.M | re.S)
        }
        named = r"(?:#define (PDN_\w+) -?\d+$|typedef struct (\w+)|" \
            r"(?:PDN_API\s)?[\w ]*?[ *](pdn_\w+)\()"
        self.docs = {
            "".join(names): text_of(said)
            for said, *names in re.findall(DOCUMENTED + named, text, re.S | re.M)
        }
        self.callbacks = [self.prototype(*found) for found in re.findall(
            DOCUMENTED + r"typedef (\w+) \(\*(\w+)\)" + ARGUMENTS, text, re.S)]
        self.functions = [
            self.prototype(doc, kind + star, name, arguments)
            for doc, kind, star, name, arguments in re.findall(
                DOCUMENTED + r"PDN_API\s+((?:const )?\w+) (\*?)(\w+)" + ARGUMENTS, text, re.S
            )
        ]
        self.callback_names = {function["name"] for function in self.callbacks}

    @staticmethod
    def declaration(text):
        """Base type, number of stars, const, name, length of an array in a struct."""
        text = " ".join(text.split())
        const = text.startswith("const ")
        text = re.sub(r"\b(const|struct) ", "", text)
        base, stars, name, length = re.fullmatch(r"(\w+) (\**)(\w+)(?:\[(\d+)\])?", text).groups()
        return {"base": base, "stars": len(stars), "const": const, "name": name, "length": length}

    def prototype(self, doc, result, name, arguments):
        doc = " ".join(text_of(doc).split())
        told = dict(re.findall(r"@param (\w+) +(.*?)(?= @|$| Threads:)", doc))
        parameters = []
        for text in [] if arguments.strip() == "void" else arguments.split(","):
            parameter = self.declaration(text)
            said = told.get(parameter["name"], "")
            inherited = parameters[-1]["optional"] if "likewise" in said and parameters else False
            # "likewise" and "as cosines" refer to the one before.
            if re.match(r"as cosines|array of length \[\w+\]; likewise", said):
                said = parameters[-1]["said"]
            parameter["optional"] = inherited or ("NULL" in said and "not NULL" not in said)
            parameter["said"] = said
            parameter["extents"] = extents_of(said) if parameter["stars"] else []
            parameters.append(parameter)
        return {"name": name, "result": result, "summary": re.split(r"\.(?: |$)", doc)[0],
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
