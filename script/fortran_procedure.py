"""A procedure of the module periodyn of include/periodyn.f90, by what periodyn.h says of its
function.

What may be left out stands behind what must be there, each in the order of C; lengths of arrays
need not be told.
"""

import re
from itertools import groupby

from c_header import Binding, filled, folded

NUMBERS = {"int32_t": "integer(c_int32_t)", "pdn_status": "integer(c_int32_t)",
           "size_t": "integer(c_size_t)", "double": "real(c_double)",
           "char": "character(kind=c_char)"}
GRID_POINTS = \
    "int(merge(2*chosen%harmonics + 1, chosen%grid_points, chosen%harmonics > 0))"


def wrapped(statement):
    """One statement, continued where lines would get long."""
    return folded(statement, 96).replace("\n", " &\n")


def comment(text, pad="    "):
    return filled(text, 98, f"{pad}! ", f"{pad}! ")


def block(condition, lines):
    """What is done if a condition holds."""
    if len(lines) == 1 and not lines[0].startswith("if"):
        return [f"if ({condition}) {lines[0]}"]
    return [f"if ({condition}) then", *(f"    {line}" for line in lines), "end if"] if lines else []


def given(p, *lines):
    """What is done with an argument, if it is there."""
    return block(f"present({p['name']})", lines) if p["optional"] else lines


def shown(p):
    """The type that a number has here."""
    return "logical" if p["is_flag"] else NUMBERS[p["base"].replace("size_t", "int32_t")]


def refusal(name, extents):
    return (f"if (.not. fits('{name}', shape({name}), [{', '.join(extents)}], stat, errmsg)) "
            "return")


def colons(rank):
    return "(" + ",\0".join(":" * rank) + ")" if rank else ""


class Procedure(Binding):
    """A procedure that calls a function of C.

    `this`: what is passed for the first parameter. Each kind of parameter has a function here,
    which says what of it is declared, prepared, passed and, after success, taken.
    """

    def __init__(self, header, function, this=None, flat=False):
        super().__init__(header, function)
        self.dummies, self.locals, self.prepared, self.passed, self.taken = [], [], [], [], []
        self.this, self.asks, self.defining = this, False, {}
        if function["result"] == "size_t":
            # A buffer for a text, and its capacity.
            self.parameters = self.parameters[:-2]
        if flat:
            # Components and times in one dimension.
            self.parameters = [{**p, "extents": ["*".join(p["extents"])]}
                               if "C" in p["extents"] else p for p in self.parameters]
        for p in self.parameters:
            if p["base"] == "size_t" and not p["stars"] and self.having(p["name"]):
                self.count(p)
        if self.having("C"):
            self.locals.append(("integer", "components"))
            self.prepared.append("components = pdn_quantity_components(quantity)")
        for i, p in enumerate(self.parameters):
            if i == 0 and this:
                self.passed.append(this)
            else:
                getattr(self, self.kind(p))(p)

    def count(self, p):
        """Prepares a count: the library tells it of arrays that are then allocated, else one array
        that must be there, or any that is."""
        count, told, having = p["name"], p["told"] or "", self.having(p["name"])
        sure = [q for q in having if not q["optional"]][:1]
        self.defining[count] = (sure or having)[0]["name"]
        self.locals.append((NUMBERS["size_t"], count))
        self.asks = self.this == "self%c" and bool(re.search("diagnostics|_count", told))
        if not sure or self.asks:
            self.prepared.append(f"{count} = 0")
        if "diagnostics" in told:
            self.locals.append(("type(pdn_diagnostics)", "asked"))
            self.prepared += ["call pdn_init(asked)",
                              "status = pdn_solution_diagnostics(self%c, asked)",
                              f"{count} = {told.replace('pdn_diagnostics.', 'asked%')}"]
        elif self.asks:
            self.prepared.append(f"status = {told}(self%c, {count})")
        for q in [] if self.asks else sure or reversed(having):
            place = next(i for i, e in enumerate(q["extents"], 1) if count in e.split("*"))
            self.prepared += given(q, f"{count} = size({q['name']}, {place}, c_size_t)")

    def dummy(self, p, declared, shape=""):
        late = p["optional"] or p["name"] == "options"
        self.dummies.append((late, declared + ", optional" * p["optional"], p["name"] + shape))

    # Inputs.

    def perhaps(self, p, declared, value, otherwise=None):
        """Passes a value; what stands for it, or nothing, if the argument is not there."""
        own = f"raw_{p['name']}"
        if p["optional"]:
            self.locals.append((declared, own))
            self.prepared += [f"{own} = {otherwise}"] * bool(otherwise)
            self.prepared += given(p, f"{own} = {value}")
        self.passed.append(own if p["optional"] else value)

    def data(self, p):
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

    def signal(self, p):
        self.dummy(p, "type(pdn_signal), intent(in), target", colons(len(p["extents"])))
        self.check(p)
        self.perhaps(p, "type(c_signal), allocatable", f"raw_of({p['name']})")

    several_signals = signal

    def struct(self, p):
        if self.header.pointers(p["base"]):
            self.built(p)
            return
        self.dummy(p, f"type({p['base']}), intent(in)", colons(len(p["extents"])))
        self.passed.append(p["name"])

    several_structs = options = struct

    def built(self, p):
        """A struct whose pointers are set to arguments."""
        options = p["name"] == "options"
        self.locals.append((f"type({p['base']})", "chosen"))
        if p["optional"] or not options:
            self.prepared.append("call pdn_init(chosen)")
        if options:
            self.dummy(p, f"type({p['base']}), intent(in)")
            self.prepared += given(p, "chosen = options")
        counted, fields = set(), self.header.pointers(p["base"])
        for field in sorted(fields, key=lambda field: field["optional"]):
            self.pointer(field, counted)
        self.passed.append("chosen")

    def pointer(self, field, counted):
        """An argument that a pointer of a struct is set to; `counted` are the counts so far."""
        own, extents = field["name"], field["extents"]
        declared = f"{self.header.declared(field)}, intent(in)"
        if field["base"] in self.header.opaque:
            self.dummy(field, declared)
            self.prepared += given(field, f"chosen%{own} = {own}%c")
            return
        contiguous = ", contiguous" * bool(extents)
        self.dummy(field, f"{declared}, target{contiguous}", colons(len(extents)))
        known = {"N": GRID_POINTS, "nodes": "nodes_of(self)"}
        before = [refusal(own, [e if e.isdigit() else known.get(e, f"int(chosen%{e})")
                                for e in extents])] if extents else []
        if len(extents) == 1 and extents[0] not in counted:
            counted.add(extents[0])
            before = [f"chosen%{extents[0]} = size({own}, kind=c_size_t)"]
        self.prepared += given(field, *before, f"chosen%{own} = c_loc({own})")

    def number(self, p):
        own, default = p["name"], p["default"]
        if own in self.defining:
            self.passed.append(own)
            return
        p = {**p, "optional": default is not None}
        self.dummy(p, f"{shown(p)}, intent(in)")
        # Of a negative count the library tells what it expects.
        value = f"merge(1_c_int32_t, 0_c_int32_t, {own})" if p["is_flag"] else \
            f"int(max({own}, 0), c_size_t)" if p["base"] == "size_t" else own
        kind = NUMBERS[p["base"]]
        self.perhaps(p, kind, value, f"{default}_{kind[:-1].split('(')[1]}")

    # Arrays, given or to be filled.

    def check(self, p):
        """Checks the shape of an array, unless it is what tells its length."""
        extents = p["extents"]
        if any(self.defining.get(e) != p["name"] for e in extents):
            expected = [re.sub(r"[a-z]\w*", r"int(\g<0>)", e).replace("C", "components")
                        for e in extents]
            self.prepared += given(p, refusal(p["name"], expected))

    def array(self, p):
        """An array that is given, or filled as it is."""
        own, extents = p["name"], p["extents"]
        if not extents:
            raise ValueError(f"{self.function['name']}: no shape in: {p['said']}")
        shape = f"({', '.join(extents)})" if p["is_fixed"] else colons(len(extents))
        kind = f"{NUMBERS[p['base']]}, intent({'in' if p['const'] else 'inout'})"
        self.dummy(p, kind + ", contiguous" * (not p["is_fixed"]), shape)
        if not p["is_fixed"]:
            self.check(p)
        if self.this == "signal%raw":
            self.prepared += given(p, f"signal%{own} = {own}")
        self.passed.append(own)

    def new_array(self, p):
        """An array that is filled; allocated if the library tells its length."""
        if not self.asks:
            self.array(p)
            return
        own, kind = p["name"], f"{NUMBERS[p['base']]}, allocatable"
        self.dummy(p, f"{kind}, intent(inout)", colons(len(p["extents"])))
        self.locals.append((kind, f"found_{own}{colons(len(p['extents']))}"))
        self.prepared.append(f"allocate (found_{own}({', '.join(p['extents'])}))")
        self.passed.append(f"found_{own}")
        self.taken += given(p, f"call move_alloc(found_{own}, {own})")

    # Outputs.

    def take(self, p, declared, local, value):
        """An output that is not what C writes."""
        self.dummy(p, f"{declared}, intent(inout)")
        self.locals.append((local, f"found_{p['name']}"))
        self.passed.append(f"found_{p['name']}")
        self.taken += given(p, f"{p['name']} = {value}")

    def new_handle(self, p):
        name = p["base"].removeprefix("pdn_") if p["name"] == "out" else p["name"]
        self.dummy({**p, "name": name, "optional": False}, f"type({p['base']}), intent(inout)")
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

    def new_number(self, p):
        found = f"found_{p['name']}"
        # Ids of what is added need not be taken.
        wanted = {**p, "optional": p["optional"] or "_add_" in self.name}
        value = f"{found} /= 0" if p["is_flag"] else \
            f"int({found}, c_int32_t)" if p["base"] == "size_t" else found
        self.take(wanted, shown(p), NUMBERS[p["base"]], value)

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
                 wrapped(f"    {kind} {name}({', '.join(names)}{end}")]
        for declaration, group in groupby(declared, key=lambda d: d[0]):
            lines.append(wrapped(f"{pad}{declaration} :: {', '.join(n for _, n in group)}"))
        lines += ["", *(wrapped(pad + line) for line in body)]
        return "\n".join([*lines, f"    end {kind} {name}"])
