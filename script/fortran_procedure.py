"""A procedure of the module periodyn of include/periodyn.f90, by what periodyn.h says of its
function.

What may be left out stands behind what must be there, each in the order of C; lengths of arrays
need not be told.
"""

import re
import textwrap
from itertools import groupby

from c_header import DEFAULTS

NUMBERS = {"int32_t": "integer(c_int32_t)", "pdn_status": "integer(c_int32_t)",
           "size_t": "integer(c_size_t)", "double": "real(c_double)",
           "char": "character(kind=c_char)"}
# How many numbers a function gives: the function that tells before, and what it says.
COUNTS = {
    "pdn_solution_history": ("pdn_solution_diagnostics", "asked%iterations"),
    "pdn_solution_decay": ("pdn_solution_diagnostics", "(asked%grid_points + 1)/2"),
    "pdn_solution_grid_times": ("pdn_solution_diagnostics", "asked%grid_points"),
    "pdn_solution_floquet": ("pdn_solution_floquet_count", "asked"),
    "pdn_solution_sharp_events": ("pdn_solution_sharp_event_count", "asked"),
}
GRID_POINTS = \
    "int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0))"
SUFFIX = {int: "_c_int32_t", float: "_c_double"}
# What is said of numbers that are true or false.
LOGICAL = re.compile(r"1 if |1, or 0 |1: |0 or 1,")


def wrapped(start, items, end=""):
    """One statement, continued where lines would get long."""
    lines, line = [], start
    for i, item in enumerate(items):
        item += ", " if i + 1 < len(items) else end
        if len(line) + len(item.rstrip()) > 96:
            lines.append(line.rstrip() + " &")
            line = " " * (len(start) - len(start.lstrip()) + 4)
        line += item
    return "\n".join(lines + [line])


def comment(text, pad="    "):
    return textwrap.fill(text, 98, initial_indent=f"{pad}! ", subsequent_indent=f"{pad}! ",
                         break_long_words=False, break_on_hyphens=False)


def block(condition, lines):
    """What is done if a condition holds."""
    if len(lines) == 1 and not lines[0].startswith("if"):
        return [f"if ({condition}) {lines[0]}"]
    return [f"if ({condition}) then", *(f"    {line}" for line in lines), "end if"] if lines else []


def given(p, *lines):
    """What is done with an argument, if it is there."""
    return block(f"present({p['name']})", lines) if p["optional"] else lines


def refusal(name, extents):
    return (f"if (.not. fits('{name}', shape({name}), [{', '.join(extents)}], stat, errmsg)) "
            "return")


def colons(rank):
    return f"({', '.join(':' * rank)})" if rank else ""


class Procedure:
    """A procedure that calls a function of C.

    `this`: what is passed for the first parameter. Each kind of parameter has a function here,
    which says what of it is declared, prepared, passed and, after success, taken.
    """

    def __init__(self, header, function, this=None, flat=False):
        self.header, self.function, self.this = header, function, this
        self.dummies, self.locals, self.prepared, self.passed, self.taken = [], [], [], [], []
        self.asks = COUNTS.get(function["name"])
        parameters = function["parameters"]
        if function["result"] == "size_t":
            # A buffer for a text, and its capacity.
            parameters = parameters[:-2]
        # Components and times may also stand in one dimension.
        self.extents = {p["name"]: ["*".join(p["extents"])] if flat and "C" in p["extents"]
                        else p["extents"] for p in parameters}
        self.defining = {}
        self.count_all(parameters)
        for i, p in enumerate(parameters):
            if i == 0 and this:
                self.passed.append(this)
            else:
                self.kind(p)(p)

    def count_all(self, parameters):
        """Prepares counts, by the arrays that have them."""
        if self.asks:
            told = self.header.named[self.asks[0]]["parameters"][-1]
            self.locals.append((self.header.declared(told), "asked"))
            struct = told["base"] in self.header.structs
            self.prepared += ["call pdn_init(asked)" if struct else "asked = 0",
                              f"status = {self.asks[0]}(self%c, asked)"]
        for p in parameters:
            having = [q for q in parameters
                      if re.search(rf"\b{p['name']}\b", " ".join(self.extents[q["name"]]))]
            if p["base"] == "size_t" and p["stars"] == 0 and having:
                self.count_by(p["name"], having)
        if "C" in " ".join(sum(self.extents.values(), [])):
            self.locals.append(("integer", "components"))
            self.prepared.append("components = pdn_quantity_components(quantity)")

    def count_by(self, count, having):
        """Prepares a count by one array that must be there, or by any that is."""
        sure = [q for q in having if not q["optional"]][:1]
        self.defining[count] = (sure or having)[0]["name"]
        if self.asks:
            return
        self.locals.append((NUMBERS["size_t"], count))
        if not sure:
            self.prepared.append(f"{count} = 0")
        for q in sure or reversed(having):
            extents = self.extents[q["name"]]
            place = next(i for i, e in enumerate(extents) if count in e.split())
            size = f"size({q['name']}, {place + 1}, c_size_t)"
            if extents[place].endswith("+ 1"):
                size = f"max({size} - 1, 0_c_size_t)"
            self.prepared += given(q, f"{count} = {size}")

    def kind(self, p):
        """The function for a parameter."""
        base, const = p["base"], p["const"]
        named = {"void": self.user_data, "char": self.text, "pdn_signal": self.signals}
        if base in named:
            return named[base]
        if base in self.header.callback_names:
            return self.callback
        if base in self.header.opaque:
            return self.handle if p["stars"] == 1 else self.new_handle
        if base in self.header.structs:
            made = self.built if self.header.pointers(base) else self.struct
            return made if const else self.new_struct
        if p["stars"] == 0:
            return self.count if p["name"] in self.defining else self.number
        if not p["extents"] and not const:
            return self.new_number
        return self.asked_array if self.asks else self.array

    def dummy(self, p, declared, shape="", optional=None):
        optional = p["optional"] if optional is None else optional
        late = optional or p["name"] == "options"
        self.dummies.append((late, declared + ", optional" * optional, p["name"] + shape))

    # Inputs.

    def perhaps(self, p, declared, value, otherwise=None):
        """Passes a value; what stands for it, or nothing, if the argument is not there."""
        own = f"raw_{p['name']}"
        if p["optional"]:
            self.locals.append((declared, own))
            self.prepared += [f"{own} = {otherwise}"] * bool(otherwise)
            self.prepared += given(p, f"{own} = {value}")
        self.passed.append(own if p["optional"] else value)

    def user_data(self, p):
        self.dummy(p, "type(c_ptr), intent(in)")
        self.perhaps(p, "type(c_ptr)", p["name"], "c_null_ptr")

    def callback(self, p):
        self.dummy(p, f"procedure({p['base']})")
        self.perhaps(p, "type(c_funptr)", f"c_funloc({p['name']})", "c_null_funptr")

    def text(self, p):
        self.dummy(p, "character(*), intent(in)")
        self.perhaps(p, "character(:), allocatable", f"trim({p['name']})//c_null_char")

    def handle(self, p):
        self.dummy(p, f"type({p['base']}), intent(in)")
        self.perhaps(p, "type(c_ptr)", f"{p['name']}%c", "c_null_ptr")

    def signals(self, p):
        own = p["name"]
        self.dummy(p, "type(pdn_signal), intent(in), target", colons(len(self.extents[own])))
        self.check(p)
        self.perhaps(p, "type(c_signal), allocatable", f"raw_of({own})")

    def struct(self, p):
        self.dummy(p, f"type({p['base']}), intent(in)", colons(len(p["extents"])))
        self.passed.append(p["name"])

    def built(self, p):
        """A struct whose pointers are set to arguments."""
        options = p["name"] == "options"
        self.locals.append((f"type({p['base']})", "chosen"))
        if p["optional"] or not options:
            self.prepared.append("call pdn_init(chosen)")
        if options:
            self.dummy(p, f"type({p['base']}), intent(in)")
            self.prepared += given(p, "chosen = options")
        fields = [{**field, "optional": options or "NULL" in field["said"]}
                  for field in self.header.pointers(p["base"])]
        counted = set()
        for field in sorted(fields, key=lambda field: field["optional"]):
            self.pointer(field, counted)
        self.passed.append("chosen")

    def pointer(self, field, counted):
        """An argument that a pointer of a struct is set to; `counted` are the counts so far."""
        own, declared = field["name"], f"{self.header.declared(field)}, intent(in)"
        if field["base"] in self.header.opaque:
            self.dummy(field, declared)
            self.prepared += given(field, f"chosen%{own} = {own}%c")
            return
        count = re.search(r"of length \[(\w+)\]", field["said"])
        nodes = re.search(r"(\d) x (N x )?nodes", field["said"])
        extents = [f"int(chosen%{count[1]})"] if count else \
            [nodes[1], *[GRID_POINTS] * bool(nodes[2]), "nodes_of(self)"] if nodes else []
        contiguous = ", contiguous" * bool(extents)
        self.dummy(field, f"{declared}, target{contiguous}", colons(len(extents)))
        before = [refusal(own, extents)] if extents else []
        if count and count[1] not in counted:
            counted.add(count[1])
            before = [f"chosen%{count[1]} = size({own}, kind=c_size_t)"]
        self.prepared += given(field, *before, f"chosen%{own} = c_loc({own})")

    def count(self, p):
        self.passed.append(f"int({self.asks[1]}, c_size_t)" if self.asks else p["name"])

    def number(self, p):
        own, is_size, logical = p["name"], p["base"] == "size_t", LOGICAL.match(p["said"])
        default = DEFAULTS.get(self.function["name"], {}).get(own)
        p = {**p, "optional": default is not None}
        kind = "logical" if logical else NUMBERS["int32_t" if is_size else p["base"]]
        self.dummy(p, f"{kind}, intent(in)")
        # Of a negative count the library tells what it expects.
        value = f"merge(1_c_int32_t, 0_c_int32_t, {own})" if logical else \
            f"int(max({own}, 0), c_size_t)" if is_size else own
        self.perhaps(p, NUMBERS[p["base"]], value, str(default) + SUFFIX.get(type(default), ""))

    # Arrays, given or to be filled.

    def check(self, p):
        """Checks the shape of an array, unless it is what tells its length."""
        extents = self.extents[p["name"]]
        if any(self.defining.get(e.removesuffix(" + 1")) != p["name"] for e in extents):
            expected = [re.sub(r"[a-z]\w*", r"int(\g<0>)", e).replace("C", "components")
                        for e in extents]
            self.prepared += given(p, refusal(p["name"], expected))

    def array(self, p):
        own, extents = p["name"], self.extents[p["name"]]
        if not extents:
            raise ValueError(f"{self.function['name']}: no shape in: {p['said']}")
        fixed = all(e.isdigit() for e in extents)
        shape = f"({', '.join(extents)})" if fixed else colons(len(extents))
        kind = f"{NUMBERS[p['base']]}, intent({'in' if p['const'] else 'inout'})"
        self.dummy(p, kind + ", contiguous" * (not fixed), shape)
        if not fixed:
            self.check(p)
        if self.this == "signal%raw":
            self.prepared += given(p, f"signal%{own} = {own}")
        self.passed.append(own)

    def asked_array(self, p):
        own, kind = p["name"], f"{NUMBERS[p['base']]}, allocatable"
        self.dummy(p, f"{kind}, intent(inout)", "(:)", optional=False)
        self.locals.append((kind, f"found_{own}(:)"))
        self.prepared.append(f"allocate (found_{own}({self.asks[1]}))")
        self.passed.append(f"found_{own}")
        self.taken.append(f"call move_alloc(found_{own}, {own})")

    # Outputs.

    def take(self, p, declared, local, value):
        """An output that is not what C writes."""
        self.dummy(p, f"{declared}, intent(inout)")
        self.locals.append((local, f"found_{p['name']}"))
        self.passed.append(f"found_{p['name']}")
        self.taken += given(p, f"{p['name']} = {value}")

    def new_handle(self, p):
        name = p["base"].removeprefix("pdn_") if p["name"] == "out" else p["name"]
        self.dummy({**p, "name": name}, f"type({p['base']}), intent(inout)", optional=False)
        self.adopt(name, p["base"])

    def adopt(self, name, base):
        self.locals.append(("type(c_ptr)", "made"))
        self.passed.append("made")
        self.taken.append(f"call {name}%adopt(made, {base}_free)")

    def new_struct(self, p):
        own, kind = p["name"], f"type({p['base']})"
        if p["base"] in self.header.initialised:
            self.prepared.append(f"call pdn_init(found_{own})")
            self.take(p, kind, kind, f"found_{own}")
        else:
            self.dummy(p, f"{kind}, intent(inout)")
            self.passed.append(own)

    def new_number(self, p):
        own, kind = p["name"], NUMBERS[p["base"]]
        # Ids of what is added need not be taken.
        wanted = {**p, "optional": p["optional"] or "_add_" in self.function["name"]}
        if LOGICAL.match(p["said"]):
            self.take(wanted, "logical", kind, f"found_{own} /= 0")
        elif p["base"] == "size_t":
            self.take(wanted, NUMBERS["int32_t"], kind, f"int(found_{own}, c_int32_t)")
        elif wanted["optional"] > p["optional"]:
            self.take(wanted, kind, kind, f"found_{own}")
        else:
            self.dummy(p, f"{kind}, intent(inout)")
            self.passed.append(own)

    # The procedure.

    def written(self, name, first=(), result=None):
        """The definition; `first` are declarations of what stands before the dummies."""
        dummies = [*first, *(d[1:] for d in sorted(self.dummies, key=lambda d: d[0]))]
        kind, c_name = self.function["result"], self.function["name"]
        called = f"{self.header.renamed.get(c_name, c_name)}({', '.join(self.passed)}"
        if kind not in ("pdn_status", "int32_t"):
            return self.text_function(name, dummies, called)
        condition, status = "status == PDN_OK", "status"
        if kind == "int32_t":
            own = name.split("_", 1)[1]
            dummies.append(("integer(c_int32_t), intent(inout)", own))
            self.taken.append(f"{own} = status")
            condition, status = "status >= 0", "min(status, PDN_OK)"
        dummies += [("integer, intent(out), optional", "stat"),
                    ("character(*), intent(inout), optional", "errmsg")]
        asked = any(line.startswith("status =") for line in self.prepared)
        body = [*self.prepared, "if (status == PDN_OK) " * asked + f"status = {called})",
                *block(condition, self.taken), f"call report({status}, stat, errmsg)"]
        declared = [*dummies, *([result] if result else []), *self.locals,
                    ("integer(c_int32_t)", "status")]
        return self.framed(name, dummies, declared, body, result and result[1])

    def text_function(self, name, dummies, called):
        """A function that gives a text."""
        declared = [*dummies, ("character(:), allocatable", "text")]
        if self.function["result"].startswith("const char"):
            return self.framed(name, dummies, declared, [f"text = text_at({called}))"], "text")
        called += ", " * bool(self.passed)
        body = [f"allocate (character({called}capacity=0_c_size_t) + 1) :: text)",
                f"length = {called}text, len(text, c_size_t))",
                "text = text(:length)"]
        declared.append((NUMBERS["size_t"], "length"))
        return self.framed(name, dummies, declared, body, "text")

    def framed(self, name, dummies, declared, body, result):
        """Comment, head, declarations, body and end; a function if there is a result."""
        kind, pad = "function" if result else "subroutine", " " * 8
        names = [name.partition("(")[0] for _, name in dummies]
        end = f") result({result})" if result else ")"
        lines = [comment(self.header.fortran_text(self.function["summary"]) + "."),
                 wrapped(f"    {kind} {name}(", names or [""], end)]
        for declaration, group in groupby(declared, key=lambda d: d[0]):
            lines.append(wrapped(f"{pad}{declaration} :: ", [n for _, n in group]))
        lines += ["", *(wrapped(pad + re.match(" *", line)[0], line.strip().split(", "))
                        for line in body)]
        return "\n".join([*lines, f"    end {kind} {name}"])
