# SPDX-License-Identifier: MIT
"""The sites that a mutation operator may change in a C++ source, and the texts each one may become.

libclang (Debian's python3-clang-16) parses the source, so bodies of templates in headers are sites
like all others. A site is a range of bytes; its alternatives are texts that may stand there instead.
Code out of reach of a run-time switch (evaluated by the compiler, conditions of `if constexpr`,
macros) is counted in `left_out` and gets no site.
"""

import hashlib
import re
from dataclasses import dataclass, field

import clang.cindex as ci

Kind = ci.CursorKind
KNOWN_KIND = Kind.from_id


def kind_of_number(number):
    """Concepts and the cursors below them have no name in the binding: nothing is changed there."""
    try:
        return KNOWN_KIND(number)
    except ValueError:
        return Kind.UNEXPOSED_ATTR


Kind.from_id = staticmethod(kind_of_number)
RELATIONAL = {"<": ["<=", "!=", "false"], "<=": ["<", "==", "true"], ">": [">=", "!=", "false"],
              ">=": [">", "==", "true"], "==": ["!=", "<=", ">=", "false"],
              "!=": ["==", "<", ">", "true"]}
ARITHMETIC = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "&": ["|"], "|": ["&"],
              "^": ["|"], "<<": [">>"], ">>": ["<<"]}
COMPOUND = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "%=": "*=", "|=": "&=", "&=": "|=",
            "^=": "|=", "<<=": ">>=", ">>=": "<<="}
CALLS = {}
for one, other in [("min", "max"), ("min_element", "max_element"), ("all_of", "any_of"),
                   ("lower_bound", "upper_bound"), ("floor", "ceil"), ("front", "back")]:
    CALLS[one], CALLS[other] = other, one
CALLS["none_of"] = "any_of"
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.FUNCTION_TEMPLATE, Kind.CXX_METHOD, Kind.CONSTRUCTOR,
             Kind.DESTRUCTOR, Kind.CONVERSION_FUNCTION}
CLASSES = {Kind.CLASS_DECL, Kind.STRUCT_DECL, Kind.CLASS_TEMPLATE,
           Kind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION}
UNSIGNED = {ci.TypeKind.UCHAR, ci.TypeKind.USHORT, ci.TypeKind.UINT, ci.TypeKind.ULONG, ci.TypeKind.ULONGLONG}
LARGEST = re.compile(r"(numeric_limits<[^=]*>::max\(\)|UINT32_MAX|~0U|0xffffffffU?)$")
RESERVES = "a vector's reserve changes how it grows, not what it holds"
AT_LEAST, AT_MOST = {">": "!=", "==": "<=", "!=": ">"}, {"<": "!=", "==": ">=", "!=": "<"}
LOOPS = {Kind.FOR_STMT, Kind.WHILE_STMT, Kind.DO_STMT, Kind.CXX_FOR_RANGE_STMT}


@dataclass
class Site:
    """A range of bytes with its alternatives."""
    start: int
    end: int
    function: str
    kind: str          # "expression", "statement" (end is behind its `;`) or "return"
    is_bool: bool = False
    at_compile_time: bool = False  # in a constexpr function: the switch must not be asked there
    alternatives: list = field(default_factory=list)  # (operator, text)
    same: dict = field(default_factory=dict)  # text: why it says the same, by the types alone


@dataclass
class Place:
    """The walk's knowledge of its place."""
    function: str = ""
    at_compile_time: bool = False
    last: frozenset = frozenset()  # starts of the statements behind which the function's body ends
    is_void: bool = False
    gives_reference: bool = False
    in_for_condition: bool = False
    breaks: str = ""    # the statement that a `break` leaves: "loop" or "switch"


def masked(source):
    """The source with comments, strings and characters blanked: same length."""
    pattern = rb'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])\''
    return re.sub(pattern, lambda m: re.sub(rb"[^\n]", b" ", m.group()), source, flags=re.S)


def code_of(source):
    """The text without comments and with each blank of one character, as a compiler sees it."""
    pattern = r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*")'
    return re.sub(r"\s+", " ", re.sub(pattern, lambda m: m.group(1) or " ", source, flags=re.S))


class Sites:
    """The sites of one file, found by a walk over its cursors in libclang."""

    def __init__(self, path, translation_unit):
        self.path = str(path)
        self.source = path.read_bytes()
        self.blank = masked(self.source)
        self.sites = {}
        self.left_out = {}
        self.code = {}  # of all functions, members and variables of a name
        self.macros = [(c.extent.start.offset, c.extent.end.offset)
                       for c in translation_unit.cursor.get_children()
                       if c.kind == Kind.MACRO_INSTANTIATION and self.is_here(c)]
        for child in translation_unit.cursor.get_children():
            if child.kind.is_preprocessing() or not self.is_here(child):
                continue
            self.walk(child, Place())

    def mark_of(self, function):
        """Changes with the code of the function, or of the member or variable with a value."""
        return hashlib.sha256(self.code[function].encode()).hexdigest()[:8]

    def note_code(self, name, cursor):
        self.code[name] = self.code.get(name, "") + code_of(self.text_of(cursor))

    # Text.
    def is_here(self, cursor):
        return cursor.location.file is not None and cursor.location.file.name == self.path

    def text(self, start, end):
        return self.source[start:end].decode()

    def text_of(self, cursor):
        return self.text(*self.span(cursor))

    @staticmethod
    def span(cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def leave_out(self, why):
        self.left_out[why] = self.left_out.get(why, 0) + 1

    def close(self, opening):
        """Place of the bracket that closes the one at `opening`."""
        depth = 0
        for i in range(opening, len(self.blank)):
            if self.blank[i:i + 1] in b"([{" and self.blank[i:i + 1]:
                depth += 1
            elif self.blank[i:i + 1] in b")]}":
                depth -= 1
                if depth == 0:
                    return i
        return len(self.blank)

    def is_template_argument(self, at):
        """Whether the byte at `at` is inside the <...> of a name."""
        depth, i = 0, at - 1
        while i >= 0 and self.blank[i:i + 1] not in b";{}":
            c = self.blank[i:i + 1]
            if c in b")]":
                depth += 1
            elif c in b"([":
                if depth == 0:
                    return False
                depth -= 1
            elif c == b"<" and depth == 0:
                before, after = self.blank[i - 1:i], self.blank[i + 1:i + 2]
                return before != b"<" and not before.isspace() and not after.isspace() and after not in b"<="
            i -= 1
        return False

    # Sites.
    def add(self, cursor_or_span, place, alternatives, kind="expression", is_bool=False):
        start, end = cursor_or_span if isinstance(cursor_or_span, tuple) else self.span(cursor_or_span)
        if any(a <= start and end <= b for a, b in self.macros):
            self.leave_out("macro")
            return
        key = (start, end, kind)
        site = self.sites.setdefault(key, Site(start, end, place.function, kind,
                                               at_compile_time=place.at_compile_time))
        site.is_bool = site.is_bool or is_bool
        for operator, text in alternatives:
            if text not in [t for _, t in site.alternatives]:
                site.alternatives.append((operator, text))

    def binary_operator(self, left, right):
        return self.text(left.extent.end.offset, right.extent.start.offset).strip()

    def operands(self, cursor):
        """(left, operator, right) where the cursor is a binary operation, else None."""
        children = list(cursor.get_children())
        if len(children) < 2:
            return None
        left, right = children[0], children[-1]
        if self.span(left)[0] != self.span(cursor)[0] or self.span(right)[1] != self.span(cursor)[1]:
            return None
        operator = self.binary_operator(left, right)
        if operator in RELATIONAL or operator in ARITHMETIC or operator in ("&&", "||"):
            return left, operator, right
        return None

    def is_decided(self, cursor):
        """Whether operators inside a condition decide it, so that it needs no negation."""
        while cursor.kind in (Kind.UNEXPOSED_EXPR, Kind.PAREN_EXPR) and self.operands(cursor) is None:
            children = list(cursor.get_children())
            if len(children) != 1:
                return False
            cursor = children[0]
        operands = self.operands(cursor)
        if operands:
            return operands[1] in RELATIONAL or operands[1] in ("&&", "||")
        return cursor.kind in (Kind.CXX_BOOL_LITERAL_EXPR,)

    def condition(self, cursor, place, constant=True):
        """A condition that no operator decides: negated, and true or false for good."""
        if self.is_decided(cursor):
            return
        text = self.text_of(cursor)
        if text.startswith("!"):
            negated = [("negation", f"static_cast<bool>({text[1:]})")]
        else:
            negated = [("negation", f"!({text})")]
        always = [("condition", "true"), ("condition", "false")] if constant else []
        self.add(cursor, place, negated + always, is_bool=True)

    def binary(self, cursor, operands, place):
        left, operator, right = operands
        a, b = self.text_of(left), self.text_of(right)
        if operator in ("&&", "||"):
            other = "||" if operator == "&&" else "&&"
            self.add(cursor, place, [("logical", f"({a}) {other} ({b})"),
                                     ("operand", f"static_cast<bool>({a})"),
                                     ("operand", f"static_cast<bool>({b})")], is_bool=True)
        elif operator in RELATIONAL:
            become = RELATIONAL[operator]
            if place.in_for_condition:
                become = [o for o in become if o != "!="]
            texts = {o: o if o in ("true", "false") else f"({a}) {o} ({b})" for o in become}
            self.add(cursor, place, [("relation", text) for text in texts.values()])
            other, why = self.same_relation(left, operator, right)
            if other in texts:
                self.sites[(*self.span(cursor), "expression")].same[texts[other]] = why
        else:
            self.add(cursor, place, [("arithmetic", f"({a}) {o} ({b})") for o in ARITHMETIC[operator]])

    def same_relation(self, left, operator, right):
        """(operator, why) where another relation says the same, by the values of the types."""
        kind = left.type.get_canonical().kind
        if kind in UNSIGNED and right.type.get_canonical().kind in UNSIGNED:
            if re.fullmatch(r"0[uUlLzZ]*", self.text_of(right)):
                return AT_LEAST.get(operator), "nothing without a sign is below 0"
            value = self.named(right)
            if value is not None and LARGEST.search("".join(t.spelling for t in value.get_tokens())):
                return AT_MOST.get(operator), "nothing of its type is above the largest number"
        if re.fullmatch(r"[\w.\[\]]+\.end\(\)", self.text_of(right)):
            return {"==": ">=", "!=": "<"}.get(operator), "no iterator of a range is beyond its end"
        value = self.named(right)
        if kind == ci.TypeKind.ENUM and value is not None and value.kind == Kind.ENUM_CONSTANT_DECL:
            values = [c.enum_value for c in value.semantic_parent.get_children()
                      if c.kind == Kind.ENUM_CONSTANT_DECL]
            if value.enum_value == min(values):
                return AT_LEAST.get(operator), "nothing is below the first of an enumeration"
            if value.enum_value == max(values):
                return AT_MOST.get(operator), "nothing is above the last of an enumeration"
        return None, ""

    @staticmethod
    def named(cursor):
        """The declaration of a name; None where the expression is more than a name."""
        while cursor.kind == Kind.UNEXPOSED_EXPR:
            children = list(cursor.get_children())
            if len(children) != 1:
                return None
            cursor = children[0]
        if cursor.kind not in (Kind.DECL_REF_EXPR, Kind.MEMBER_REF_EXPR):
            return None
        value = cursor.referenced
        if value is not None and value.kind == Kind.VAR_DECL and "constexpr" not in [
                t.spelling for t in value.get_tokens()] and not value.type.is_const_qualified():
            return None
        return value

    def unary(self, cursor, place):
        text = self.text_of(cursor)
        if text.startswith(("++", "--")):
            self.add(cursor, place, [("increment", {"++": "--", "--": "++"}[text[:2]] + text[2:])])
        elif text.endswith(("++", "--")):
            self.add(cursor, place, [("increment", text[:-2] + {"++": "--", "--": "++"}[text[-2:]])])
        elif text.startswith("!") and not text.startswith("!="):  # != may be a rewritten ==
            self.add(cursor, place, [("negation", f"static_cast<bool>({text[1:]})")], is_bool=True)
        elif text.startswith("-") and not re.fullmatch(r"-[\d.]+(e-?\d+)?", text):
            self.add(cursor, place, [("sign", f"({text[1:]})")])

    def literal(self, cursor, place):
        start, end = self.span(cursor)
        text = self.text(start, end)
        if not text:
            return
        if self.is_template_argument(start):
            self.leave_out("template argument")
            return
        if cursor.kind == Kind.CXX_BOOL_LITERAL_EXPR:
            self.add(cursor, place, [("constant", "false" if text == "true" else "true")])
            return
        if cursor.kind == Kind.INTEGER_LITERAL:
            found = re.fullmatch(r"(0x[0-9a-fA-F]+|[0-9]+)([uUlLzZ]*)", text.replace("'", ""))
            if found is None:  # the compiler's own, as in a pack expansion
                return
            number, suffix = found.groups()
            n = int(number, 0)
            if n > 2**31:
                self.leave_out("number of a hash")
                return
            become = [1] if n == 0 else [n - 1, n + 1]
            self.add(cursor, place, [("constant", f"{m}{suffix}") for m in become])
        else:
            become = ["1.0"] if (float.fromhex(text) if "0x" in text else float(text)) == 0 else [f"({text} + 1)", f"({text} - 1)"]
            self.add(cursor, place, [("constant", m) for m in become])

    def call(self, cursor, place):
        text = self.text_of(cursor)
        found = re.match(r"((?:std::(?:ranges::)?)|.*(?:\.|->))(\w+)(<[^()]*>)?\(", text.split("(")[0] + "(", re.S)
        if found and found.group(2) in CALLS:
            at = found.start(2)
            self.add(cursor, place, [("call", text[:at] + CALLS[found.group(2)] + text[found.end(2):])])
        elif text.startswith("std::abs("):
            self.add(cursor, place, [("call", text[len("std::abs"):])])

    def statement(self, cursor, place):
        """Removal of a statement, and replacements of break, continue and return."""
        start, end = self.span(cursor)
        end = self.blank.index(b";", end) + 1
        kind = cursor.kind
        if kind == Kind.RETURN_STMT:
            # Without one that a body ends with, nothing would be returned: the compiler may take
            # such a way for one that is never gone.
            if start not in place.last:
                self.add((start, end), place, [("removal", ";")], "statement")
            self.returned(cursor, start, end, place)
        elif kind == Kind.BREAK_STMT:
            if place.breaks == "loop":
                self.add((start, end), place, [("removal", ";"), ("jump", "continue;")], "statement")
        elif kind == Kind.CONTINUE_STMT:
            more = [("jump", "break;")] if place.breaks == "loop" else []
            self.add((start, end), place, [("removal", ";")] + more, "statement")
        elif kind.is_expression() or kind in (Kind.UNEXPOSED_STMT,):
            text = self.text(start, end)
            if not text.startswith(("static_cast<void>", "SUNDER_ASSERT")):
                self.add((start, end), place, [("removal", ";")], "statement")
                if self.is_reserve(cursor):
                    self.sites[(start, end, "statement")].same[";"] = RESERVES

    @staticmethod
    def is_reserve(cursor):
        """Whether it is a call of std::vector::reserve: how much room there is changes no value."""
        callee = next(cursor.get_children(), None) if cursor.kind == Kind.CALL_EXPR else None
        if callee is None or callee.kind != Kind.MEMBER_REF_EXPR or callee.spelling != "reserve":
            return False
        holder = next(callee.get_children(), None)
        return holder is not None and holder.type.get_canonical().spelling.removeprefix("const ").startswith("std::vector<")

    def returned(self, cursor, start, end, place):
        value = next(cursor.get_children(), None)
        if value is None or place.gives_reference:
            return
        text = self.text_of(value)
        if text in ("", "{}", "std::nullopt", "nullptr", "0", "true", "false") or text.endswith("::none()"):
            return
        if text.startswith("{"):
            self.add((start, end), place, [("return", "return {};")], "statement")
        elif not self.is_decided(value):
            self.add((start, end), place,
                     [("return", f"return std::decay_t<decltype({text})>{{}};")], "statement")

    # The walk.
    def walk(self, cursor, place):
        kind = cursor.kind
        if kind in CLASSES or kind == Kind.NAMESPACE or kind == Kind.LINKAGE_SPEC:
            for child in cursor.get_children():
                self.walk(child, Place(cursor.spelling if kind in CLASSES else ""))
        elif kind in FUNCTIONS:
            self.function(cursor, place)
        elif kind == Kind.FIELD_DECL:
            inside = Place(f"{place.function}::{cursor.spelling}", at_compile_time=True)
            self.note_code(inside.function, cursor)
            for child in cursor.get_children():
                if child.extent.start.offset > cursor.location.offset:
                    self.expression(child, inside)
        elif kind == Kind.VAR_DECL:
            self.note_code(cursor.spelling, cursor)
            self.variable(cursor, Place(cursor.spelling, at_compile_time=True))
        elif kind == Kind.STATIC_ASSERT:
            self.leave_out("static_assert")

    def function(self, cursor, place):
        children = list(cursor.get_children())
        bodies = [c for c in children if c.kind == Kind.COMPOUND_STMT]
        if not bodies:
            return
        body = bodies[-1]
        if self.source[body.extent.start.offset:][:1] != b"{":
            return  # defaulted: the body is the compiler's own
        head = self.text(cursor.extent.start.offset, body.extent.start.offset)
        owner = place.function
        if cursor.semantic_parent is not None and cursor.semantic_parent.kind in CLASSES:
            owner = cursor.semantic_parent.spelling
        name = f"{owner}::{cursor.spelling}" if owner else cursor.spelling
        if re.search(r"\bconsteval\b", head):
            self.leave_out("consteval function")
            return
        self.note_code(name, cursor)
        result = cursor.result_type.spelling
        inside = Place(name, at_compile_time=bool(re.search(r"\bconstexpr\b", head)),
                       is_void=result == "void", gives_reference=result.endswith("&"))
        if cursor.kind == Kind.CONSTRUCTOR or cursor.kind == Kind.FUNCTION_TEMPLATE:
            for child in children:
                if child.kind.is_expression() and child.extent.start.offset > cursor.location.offset:
                    self.expression(child, inside)
        self.body(body, inside)

    def body(self, compound, place):
        place.last = frozenset(self.ends(compound))
        for child in compound.get_children():
            self.visit_statement(child, place)

    def ends(self, cursor):
        """Starts of the statements behind which `cursor`, the last one of a body, ends."""
        children = list(cursor.get_children())
        if cursor.kind == Kind.IF_STMT:
            children = self.parts(cursor, 2)[1]
            return [start for child in children for start in self.ends(child)]
        inside = (Kind.COMPOUND_STMT, Kind.SWITCH_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT)
        if cursor.kind in inside:
            return self.ends(children[-1]) if children else []
        return [cursor.extent.start.offset]

    def variable(self, cursor, place):
        """A declared variable: its initial value."""
        start, _ = self.span(cursor)
        if re.search(r"\b(constexpr|constinit)\b", self.text(start, cursor.location.offset)):
            self.leave_out("constexpr variable")
            return
        for child in cursor.get_children():
            if child.extent.start.offset > cursor.location.offset:
                self.expression(child, place)
            elif child.kind == Kind.INTEGER_LITERAL:
                self.leave_out("array bound")

    def visit_statement(self, cursor, place):
        kind = cursor.kind
        if kind == Kind.COMPOUND_STMT:
            for child in cursor.get_children():
                self.visit_statement(child, place)
        elif kind == Kind.IF_STMT:
            self.if_statement(cursor, place)
        elif kind in LOOPS:
            self.loop(cursor, place)
        elif kind == Kind.SWITCH_STMT:
            children = list(cursor.get_children())
            for child in children[:-1]:
                self.expression(child, place)
            self.visit_statement(children[-1], Place(**{**vars(place), "breaks": "switch"}))
        elif kind in (Kind.CASE_STMT, Kind.DEFAULT_STMT):
            children = list(cursor.get_children())
            if kind == Kind.CASE_STMT:
                self.leave_out("case label")
            self.visit_statement(children[-1], place)
        elif kind == Kind.DECL_STMT:
            for child in cursor.get_children():
                if child.kind == Kind.VAR_DECL:
                    self.variable(child, place)
                elif child.kind == Kind.STATIC_ASSERT:
                    self.leave_out("static_assert")
                elif child.kind in CLASSES:
                    self.walk(child, Place())
                elif child.kind == Kind.UNEXPOSED_DECL:  # structured bindings
                    for inner in child.get_children():
                        if inner.kind.is_expression():
                            self.expression(inner, place)
        elif kind == Kind.NULL_STMT:
            pass
        else:
            self.statement(cursor, place)
            for child in cursor.get_children() if kind == Kind.RETURN_STMT else [cursor]:
                self.expression(child, place)

    def parts(self, cursor, after):
        """Children inside the brackets behind `after`, those behind them, and the brackets' text."""
        opening = self.blank.index(b"(", cursor.extent.start.offset + after)
        closing = self.close(opening)
        children = list(cursor.get_children())
        inside = [c for c in children if c.extent.end.offset <= closing]
        behind = [c for c in children if c.extent.start.offset > closing]
        return inside, behind, self.blank[opening + 1:closing].decode()

    def if_statement(self, cursor, place):
        head = self.blank[cursor.extent.start.offset:cursor.extent.start.offset + 20]
        inside, behind, text = self.parts(cursor, 2)
        if re.match(rb"if\s+constexpr", head):
            self.leave_out("if constexpr")
        else:
            declares = inside and inside[0].kind in (Kind.VAR_DECL, Kind.DECL_STMT)
            if declares:
                if inside[0].kind == Kind.VAR_DECL:
                    self.variable(inside[0], place)
                else:
                    self.visit_statement(inside[0], place)
            if not declares or ";" in text:
                self.condition(inside[-1], place)
                self.expression(inside[-1], place)
        for child in behind:
            self.visit_statement(child, place)

    def loop(self, cursor, place):
        inner = Place(**{**vars(place), "breaks": "loop"})
        if cursor.kind == Kind.DO_STMT:
            body, condition = list(cursor.get_children())
            self.visit_statement(body, inner)
            self.condition(condition, place, constant=False)
            self.expression(condition, place)
            return
        inside, behind, text = self.parts(cursor, 3)
        if cursor.kind == Kind.WHILE_STMT:
            if inside[0].kind == Kind.VAR_DECL:
                self.variable(inside[0], place)
            else:
                self.condition(inside[0], place, constant=False)
                self.expression(inside[0], place)
        elif cursor.kind == Kind.CXX_FOR_RANGE_STMT:
            for child in inside:
                if child.kind.is_expression():
                    self.expression(child, place)
        else:
            at = cursor.extent.start.offset + self.blank[cursor.extent.start.offset:].index(b"(") + 1
            first = at + text.index(";")
            second = first + 1 + text[first - at + 1:].index(";")
            for child in inside:
                start = child.extent.start.offset
                if child.kind == Kind.DECL_STMT:
                    self.visit_statement(child, place)
                elif first < start < second:
                    self.condition(child, place, constant=False)
                    self.expression(child, Place(**{**vars(place), "in_for_condition": True}))
                else:
                    self.expression(child, place)
        for child in behind:
            self.visit_statement(child, inner)

    def lambda_expression(self, cursor, place):
        opening = [c for c in cursor.get_children() if c.kind == Kind.COMPOUND_STMT]
        if not opening:
            return
        for child in cursor.get_children():
            if child.kind.is_expression():
                self.expression(child, place)  # captures with a value
        head = self.text(cursor.extent.start.offset, opening[-1].extent.start.offset)
        inside = Place(place.function, gives_reference="&" in head.split("->")[-1] if "->" in head else False)
        self.body(opening[-1], inside)

    def expression(self, cursor, place):
        kind = cursor.kind
        if kind == Kind.LAMBDA_EXPR:
            self.lambda_expression(cursor, place)
            return
        if kind in (Kind.CXX_UNARY_EXPR, Kind.SIZE_OF_PACK_EXPR, Kind.CXX_TYPEID_EXPR):
            return
        if kind == Kind.CALL_EXPR and self.text_of(cursor).startswith("__builtin_"):
            return  # its arguments must be constants
        operands = self.operands(cursor)
        if operands:
            self.binary(cursor, operands, place)
        elif kind == Kind.COMPOUND_ASSIGNMENT_OPERATOR or kind == Kind.CALL_EXPR:
            children = list(cursor.get_children())
            operator = self.binary_operator(children[0], children[-1]) if len(children) > 1 else ""
            if operator in COMPOUND:
                self.add(cursor, place, [("assignment", f"{self.text_of(children[0])} {COMPOUND[operator]} "
                                                        f"({self.text_of(children[-1])})")])
            elif cursor.spelling in ("operator++", "operator--", "operator!"):
                self.unary(cursor, place)
            elif kind == Kind.CALL_EXPR:
                self.call(cursor, place)
        elif kind == Kind.UNARY_OPERATOR:
            self.unary(cursor, place)
        elif kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL, Kind.CXX_BOOL_LITERAL_EXPR):
            self.literal(cursor, place)
        elif kind == Kind.CONDITIONAL_OPERATOR:
            self.condition(next(cursor.get_children()), place)
        inner = Place(**{**vars(place), "in_for_condition":
                         place.in_for_condition and operands is not None and operands[1] in ("&&", "||")})
        for child in cursor.get_children():
            if child.kind.is_expression() or child.kind == Kind.UNEXPOSED_EXPR:
                self.expression(child, inner)
            elif child.kind == Kind.COMPOUND_STMT:
                self.body(child, inner)
