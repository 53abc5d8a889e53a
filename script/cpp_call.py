"""A function of C as one of C++, for script/cpp_interface."""

import re
from math import prod

from c_header import Binding, class_name, filled

# Roles of constants, by the hundreds of their values.
ROLES = dict.fromkeys(range(1, 7), "Kind") | {
    10: "ObjectKind", 11: "ForceKind", 13: "JointKind", 14: "Coordinate", 16: "Frame",
    17: "Component", 19: "ShellFrames", 20: "ShellPlace", 21: "BushingAngles", 22: "Tangents",
    23: "Tangent", 24: "Outcome", 25: "Decay", 29: "Feature", 31: "Filter", 32: "Stage",
    33: "Start", 34: "TimeMap", 35: "Linear", 36: "Number", 38: "SignalPart",
    39: "SensitivityMethod", 40: "BranchEnd", 41: "BranchEvent", 42: "Verdict"}
# What functions that return a number or a negative status tell.
TOLD = {"outcome": "Outcome", "end": "BranchEnd", "components": "std::size_t"}
NUMBERS = {"int32_t": "std::int32_t", "size_t": "std::size_t", "double": "double",
           "pdn_status": "pdn_status"}
VECTOR = "std::vector<double>"
VERSION_CHECK = "detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));"
FIXED = {3: "Vector3", 6: "Vector6", 9: "Matrix3", 36: "Matrix6"}


def fixed(extents):
    length = prod(map(int, extents))
    return FIXED.get(length, f"std::array<double, {length}>")


def common(names, may_be_empty):
    """The call for the length that arrays have in common."""
    pairs = ", ".join(f'{{"{name.rstrip("_")}",\0{name}.size()}}' for name in names)
    return f"detail::common({{{pairs}}}, {'true' if may_be_empty else 'false'})"


def comment(said, pad="    "):
    """A comment for Doxygen."""
    said = said.rstrip(".:; ")
    return filled(f"{pad}/** {said[0].upper()}{said[1:]}.\0*/", 100, "", f"{pad} * ")


class Call(Binding):
    """A function of C++ that calls one of C.

    `this`: what stands for the first parameter, if that is the object. `before` is done first.
    """

    def __init__(self, header, function, this=""):
        super().__init__(header, function)
        self.this, self.function_of_caller, self.made = this, None, None
        self.required, self.optional, self.before, self.passed = [], [], [], []
        self.signals, self.kept, self.results, self.counts = [], [], [], []
        # None of the names hides a field of the object or a constant.
        fields = header.structs.get(self.parameters[0]["base"], []) if this else []
        hidden = {field["name"] for field in fields} | header.single
        self.parameters = [{**p, "name": p["name"] + "_" * (p["name"] in hidden)}
                           for p in self.parameters]
        self.makes_this = self.name.endswith("_new")
        self.hands_over = any(p["base"] == "pdn_destroy_fn" for p in self.parameters)
        for p in self.parameters:
            if p["base"] == "size_t" and not p["stars"]:
                self.count(p)
        for i, p in enumerate(self.parameters):
            kind = self.kind(p)
            if i == 0 and this or kind == "buffer":
                self.passed.append(this if i == 0 else "buffer, capacity")
            elif kind == "callback":
                self.callback(p)
            elif kind.startswith("new_"):
                self.output(p, kind)
            elif kind != "data" and p["name"] != "capacity":
                self.input(p, kind)

    def count(self, p):
        """A number of entries that C++ knows."""
        count = p["name"]
        given = [q for q in self.having(count) if q["const"]]
        if len(given) > 1:
            known = common([q["name"] for q in given], all(q["optional"] for q in given))
        elif p["told"]:
            known = re.sub(r"pdn_((solution|stability|equations)_)?(\w+)", r"\3()", p["told"], 1)
            known = f"static_cast<std::size_t>({known})" if "diagnostics" in known else known
        elif given:
            known = f"{given[0]['name']}.size()"
        else:
            return
        self.before.append(f"const std::size_t {count} = {known};")
        self.counts.append(count)

    def input(self, p, kind):
        """A parameter that is asked for, and how it is passed."""
        name, base, optional, role = p["name"], p["base"], p["optional"], self.header.role(p)
        extents, passed, default = p["extents"], f"detail::in({name})", "{}" if optional else None
        by_value = boxed = False
        if name in self.counts:
            self.passed.append(name)
            return
        if self.name == "pdn_model_add_coordinate_law" and name == "tangents":
            self.passed.append("detail::in(detail::tangents_of<Function>)")
            return
        if kind == "number":
            taken, by_value = role or ("bool" if p["is_flag"] else NUMBERS[base]), True
            passed = passed if role or p["is_flag"] else name
            default = p["default"]
        elif base in self.header.prepared:
            # Options may have arrays of all nodes of a model.
            nodes = "static_cast<std::size_t>(model.node_count())" \
                if self.parameters[0]["base"] == "pdn_model" and not self.this else ""
            taken, by_value, passed = class_name(base), True, f"{name}.get({nodes})"
        elif kind == "handle" and optional:
            taken, by_value, default = f"const {class_name(base)} *", True, "nullptr"
            passed = f'detail::in({name}, "{name}")'
        elif kind == "handle":
            taken, passed = class_name(base), f"{name}.get()"
        elif kind in ("struct", "signal"):
            taken, boxed = class_name(base) if base in self.header.wrapped else base, optional
            passed = f"{name} ? &*{name} : nullptr" if optional else f"&{name}"
        elif kind == "text" or p["is_fixed"]:
            taken, boxed = "std::string" if kind == "text" else fixed(extents), optional
        elif kind == "several_signals":
            taken = "std::vector<std::array<Signal, 6>>"
        elif self.name.startswith("pdn_signal_"):
            taken, by_value, passed = VECTOR, True, f"std::get<{len(self.kept)}>(*owned).data()"
            self.kept.append(name)
        else:
            taken = f"std::vector<{role or NUMBERS.get(base) or class_name(base)}>" \
                if len(extents) == 1 else f"Series<{extents[0]}>"
            passed = f"detail::in_or_null({name})" if optional and not role else passed
        self.passed.append(passed)
        self.signals += [name] * (base == "pdn_signal")
        taken = f"std::optional<{taken}>" if boxed else taken
        declared = f"{taken} {name}".replace("* ", "*") if by_value else f"const {taken} &{name}"
        if default is None or self.hands_over:
            self.required.append(declared)
        else:
            self.optional.append(f"{declared} = {'true' if taken == 'bool' else default}")
            self.optional.sort(key=lambda taken: "Options " in taken)

    def callback(self, p):
        if p["base"] == "pdn_destroy_fn":
            self.passed.append("destroy")
        else:
            self.function_of_caller = p["name"]
            self.passed += [f"&detail::{p['base'].removeprefix('pdn_')}<Function>",
                            "owned" if self.hands_over else "owned.get()"]

    def output(self, p, kind):
        """An output: where the library writes it, and what is returned."""
        name, base, role, extents = p["name"], p["base"], self.header.role(p), p["extents"]
        passed, start, returned = f"&{name}", "{}", name
        if kind == "new_handle":
            made, declared = class_name(base), f"{base} *"
            given = [q for q in self.parameters if q["base"] in self.header.opaque and q["const"]]
            kept = "{}" if not given else "kept()" if self.this else f"{given[0]['name']}.kept()"
            self.made = f"*this = {made}({name}, {kept});" if self.makes_this \
                else f"{made} made({name}, {kept});"
            returned, start = "made", " = nullptr"
            if p["optional"]:
                made = f"std::optional<{made}>"
                returned = f"made.get() ? {made}(std::move(made)) : std::nullopt"
        elif kind == "new_struct":
            made = declared = base
            start = f" = detail::initialised({base}_init)" if base in self.header.initialised \
                else start
        elif kind == "new_number":
            declared, start = NUMBERS[base], " = 0"
            made = role or ("bool" if p["is_flag"] else declared)
            returned = f"static_cast<{made}>({name})" if role else name + " != 0" * p["is_flag"]
        elif p["is_fixed"]:
            made = declared = fixed(extents)
            passed = f"{name}.data()"
        else:
            numbers = [e.replace("C", "quantity.components()") for e in reversed(extents)]
            is_series = numbers[-1].isdigit()
            made = declared = f"Series<{numbers.pop()}>" if is_series \
                else f"std::vector<{NUMBERS[base]}>"
            start = f"({' * '.join(numbers)})"
            passed = f"detail::flat({name})" if is_series else f"{name}.data()"
            returned = f"std::move({name})"
        self.before.append(f"{declared} {name}{start};".replace("* ", "*"))
        self.passed.append(passed)
        named = base.removeprefix("pdn_") if kind == "new_struct" else self.name.rpartition("_")[2]
        self.results.append((made, named if name == "out" else name.rstrip("_"), returned,
                             p["said"]))

    # What is written.

    def result(self, struct):
        """The type that is returned."""
        if self.function["result"].startswith("const char") or "buffer, capacity" in self.passed:
            return "std::string"
        if self.function["result"] == "int32_t":
            return TOLD.get(self.name.rpartition("_")[2], "std::int32_t")
        if not self.results:
            return "void"
        return self.results[0][0] if len(self.results) == 1 else struct

    def written(self, name, pad="    ", struct="", sets=""):
        """The definition; `sets`: the struct that is changed, and returned."""
        function = [f"Function {self.function_of_caller}"] if self.function_of_caller else []
        template = [f"{pad}template <class Function>"] if function else []
        taken = self.required + function + self.optional
        before = "inline " if not pad else "" if self.this else "static "
        before += f"{sets} &" if sets else self.result(struct) + " "
        after = " const" if self.this and self.parameters[0]["const"] else ""
        if self.makes_this:
            before, after = "explicit " if len(taken) == 1 else "", " : Handle(nullptr, {})"
        return "\n".join([
            comment(self.function["summary"], pad), *template,
            f"{pad}{before}{name}({', '.join(taken)}){after}", f"{pad}{{",
            *self.body(pad + "    ", "*this" if sets else ""), f"{pad}}}"])

    def body(self, pad, returned=""):
        """The statements."""
        result, call = self.function["result"], f"{self.name}({', '.join(self.passed)})"
        lines = self.called(call) if result == "pdn_status" else []
        if "buffer, capacity" in self.passed:
            # Throws where there is nothing to write: a text has no status.
            lines = ["summary();" if self.name == "pdn_model_describe" else
                     f'detail::in(this, "{self.parameters[0]["name"]}");',
                     "return detail::text([&](char *buffer, std::size_t capacity) {",
                     f"    return {call};", "});"]
        elif result == "void":
            lines = [f"{call};"]
        elif result != "pdn_status" and not self.this:
            returned = call
        elif result != "pdn_status":
            lines = [f"const std::int32_t told = {call};", "detail::check(told);"]
            returned = f"static_cast<{self.result('')}>(told)"
        elif len(self.results) > 1:
            returned = f"{{{', '.join(result[2] for result in self.results)}}}"
        elif self.results and not self.makes_this:
            returned = re.sub(r"^std::move\((\w+)\)$", r"\1", self.results[0][2])
        lines += [f"return {returned};"] if returned else []
        return [pad + line for line in lines]

    def called(self, call):
        """The call after what is done before, and the check of its status."""
        checked = f"detail::check({call});"
        if self.hands_over:
            lines = ["detail::hand_over([&](void *owned, pdn_destroy_fn destroy) {",
                     f"    return {call};", f"}}, std::move({self.function_of_caller}));"]
        elif self.signals:
            lines = ["take([&] {", f"    return {call};", f"}}, {', '.join(self.signals)});"]
        elif self.function_of_caller or self.kept:
            kind = f"std::tuple<{', '.join([VECTOR] * len(self.kept))}>" if self.kept \
                else "Function"
            moved = ", ".join(f"std::move({n})" for n in self.kept or [self.function_of_caller])
            lines = [f"auto owned = std::make_shared<{kind}>({moved});", checked,
                     "kept = std::move(owned);"]
        elif self.made:
            # It is owned before anything is thrown.
            lines = [f"const pdn_status status = {call};", self.made, "detail::check(status);"]
            lines[:0] = [VERSION_CHECK] * self.makes_this
        elif self.name == "pdn_solution_harmonics":
            # Too many are refused before there is memory for them.
            return [re.sub(r"\w+\.data\(\)", "nullptr", checked), *self.before, checked]
        else:
            lines = [checked]
        return self.before + lines
