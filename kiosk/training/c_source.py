"""Writes rules of the kernel as one text in C.

It knows the part of Python that the rules are written in, and refuses everything else with ``NotARule``. Numbers keep
their meaning: a division of whole numbers rounds down, every other one is of floating-point numbers.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterator, Sequence
from typing import Any, get_type_hints

Typed = tuple[str, Any]
"""An expression in C, and its type: int, float, bool, list[int], list[float], a named tuple, or None."""

WHOLE, REAL = list[int], list[float]
HEAD = """\
typedef long long whole;
typedef struct { whole *at; whole size; } wholes;
typedef struct { double *at; whole size; } reals;
static inline whole floor_div(whole a, whole b) { return a / b - (a % b != 0 && (a < 0) != (b < 0)); }
static inline whole floor_mod(whole a, whole b) { return a - floor_div(a, b) * b; }
static inline whole min_whole(whole a, whole b) { return b < a ? b : a; }
static inline whole max_whole(whole a, whole b) { return b > a ? b : a; }
static inline double min_real(double a, double b) { return b < a ? b : a; }
static inline double max_real(double a, double b) { return b > a ? b : a; }
"""
_ARITHMETIC: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.BitAnd: "&",
    ast.BitXor: "^",
    ast.RShift: ">>",
}
_COMPARED: dict[type[ast.AST], str] = {
    ast.Eq: "==",
    ast.NotEq: "!=",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
}
_ROUNDED: dict[type[ast.AST], str] = {ast.FloorDiv: "floor_div", ast.Mod: "floor_mod"}


class NotARule(ValueError):
    """A function is not written in the part of Python that can be written as C."""


def is_record(kind: object) -> bool:
    """Whether a type is a named tuple."""
    return isinstance(kind, type) and issubclass(kind, tuple) and hasattr(kind, "_fields")


def in_c(kind: Any) -> str:
    """Return the name of a type in C."""
    if is_record(kind):
        return f"struct {kind.__name__}"
    names = {int: "whole", bool: "whole", float: "double", type(None): "void"}
    return names.get(kind, "wholes" if kind == WHOLE else "reals")


def plain_function(rule: Callable[..., Any]) -> Any:
    """Return the Python function of a rule that numba may have wrapped."""
    return inspect.unwrap(getattr(rule, "py_func", inspect.unwrap(rule)))


def flat(kind: Any) -> Iterator[Any]:
    """List the arrays and numbers that a parameter of this type consists of."""
    if is_record(kind):
        for each in get_type_hints(kind).values():
            yield from flat(each)
    else:
        yield kind


def c_source(entries: Sequence[Callable[..., Any]]) -> str:
    """Return a text in C with these rules and all that they call; the entries can be called from outside.

    An entry takes a pointer and a length for each array, and the fields of a named tuple one by one.
    """
    text = _Text()
    outside = [text.entry(plain_function(entry)) for entry in entries]
    return "\n".join([HEAD, *text.records.values(), *text.constants.values(), *text.rules.values(), *outside])


class _Text:
    """What has been written so far, by name."""

    def __init__(self) -> None:
        self.records: dict[str, str] = {}
        self.constants: dict[str, str] = {}
        self.rules: dict[str, str] = {}

    def record(self, kind: Any) -> None:
        if is_record(kind) and kind.__name__ not in self.records:
            fields = " ".join(f"{in_c(each)} {name};" for name, each in get_type_hints(kind).items())
            self.records[kind.__name__] = f"struct {kind.__name__} {{ {fields} }};"

    def constant(self, name: str, numbers: Sequence[float]) -> str:
        listed = ", ".join(number(each) for each in numbers)
        self.constants[name] = f"static const {in_c(type(numbers[0]))} c_{name}[] = {{ {listed} }};"
        return f"c_{name}"

    def rule(self, function: Any) -> None:
        if function.__name__ not in self.rules:
            written = _Rule(self, function).text()
            self.rules[function.__name__] = written

    def entry(self, function: Any) -> str:
        """Write the way in from outside."""
        self.rule(function)
        hints = get_type_hints(function)
        back = hints.pop("return")
        parameters, given = [], []
        for at, kind in enumerate(hints.values()):
            parts = []
            for number_, each in enumerate(flat(kind)):
                name = f"a{at}_{number_}"
                array = each in (WHOLE, REAL)
                item = "double" if each in (REAL, float) else "whole"
                parameters.append(f"{item} *{name}, whole {name}_size" if array else f"{item} {name}")
                parts.append(f"{{ {name}, {name}_size }}" if array else name)
            braced = f"{{ {', '.join(parts)} }}" if is_record(kind) else parts[0]
            given.append(f"({in_c(kind)}) {braced}")
        call = f"f_{function.__name__}({', '.join(given)});"
        way = call if in_c(back) == "void" else f"return {call}"
        return f"{in_c(back)} {function.__name__}({', '.join(parameters)}) {{ {way} }}"


def number(value: int | float) -> str:
    """Return a number as C reads it, to the last bit."""
    return value.hex() if isinstance(value, float) else f"{int(value)}LL"


class _Rule:
    """One function while it is written."""

    def __init__(self, text: _Text, function: Any) -> None:
        self.all, self.function = text, function
        self.hints = get_type_hints(function)
        self.back = self.hints.pop("return")
        self.known: dict[str, Any] = dict(self.hints)
        self.used = 0
        for kind in (*self.hints.values(), self.back):
            text.record(kind)

    def text(self) -> str:
        tree = ast.parse(textwrap.dedent(inspect.getsource(self.function)))
        body = "\n".join(line for each in tree.body for line in self.block(getattr(each, "body", [])))
        own = [f"{in_c(kind)} v_{name};" for name, kind in self.known.items() if name not in self.hints]
        parameters = ", ".join(f"{in_c(kind)} v_{name}" for name, kind in self.hints.items())
        head = f"static inline {in_c(self.back)} f_{self.function.__name__}({parameters})"
        return "\n".join([head, "{", *own, body, "}"])

    def refuse(self, node: ast.AST) -> NotARule:
        return NotARule(f"{self.function.__name__}, line {getattr(node, 'lineno', '?')}: {ast.unparse(node)}")

    def statement(self, node: ast.stmt) -> Iterator[str]:  # noqa: C901 - one case for each kind
        match node:
            case ast.Expr(value=ast.Constant()):
                pass  # a docstring
            case ast.Expr(value=ast.Call() as call):
                yield f"{self.value(call)[0]};"
            case ast.Return(value=value):
                yield "return;" if value is None else f"return {self.value(value)[0]};"
            case ast.Assign(targets=targets, value=value):
                yield from self.assign(targets, value)
            case ast.AugAssign(target=target, op=op, value=value):
                read = ast.copy_location(ast.BinOp(target, op, value), node)
                yield from self.assign([target], read)
            case ast.If(test=test, body=body, orelse=orelse):
                yield f"if ({self.value(test)[0]}) {{"
                yield from self.block(body)
                yield "} else {"
                yield from self.block(orelse)
                yield "}"
            case ast.While(test=test, body=body, orelse=[]):
                yield f"while ({self.value(test)[0]}) {{"
                yield from self.block(body)
                yield "}"
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range")) as call, orelse=[]):
                yield from self.loop(name, call, node.body)
            case _:
                raise self.refuse(node)

    def block(self, body: Sequence[ast.stmt]) -> Iterator[str]:
        for statement in body:
            yield from self.statement(statement)

    def loop(self, name: str, call: ast.Call, body: Sequence[ast.stmt]) -> Iterator[str]:
        """Count as range does: the end is worked out once, and the body cannot change the counter."""
        numbers = [self.value(each)[0] for each in call.args]
        first, stop, step = (["0LL", *numbers, "1LL"] if len(numbers) == 1 else [*numbers, "1LL"])[:3]
        counter, end = self.temporary(int), self.temporary(int)
        self.know(name, int, call)
        compared = ">" if step.startswith(("-", "(-")) else "<"
        yield f"{end} = {stop};"
        yield f"for ({counter} = {first}; {counter} {compared} {end}; {counter} += {step}) {{ v_{name} = {counter};"
        yield from self.block(body)
        yield "}"

    def assign(self, targets: Sequence[ast.expr], value: ast.expr) -> Iterator[str]:
        """Work out all values first, as Python does, then put them where they belong from left to right."""
        several = isinstance(value, ast.Tuple) and all(isinstance(target, ast.Tuple) for target in targets)
        values = value.elts if isinstance(value, ast.Tuple) and several else [value]
        worked = []
        for each in values:
            code, kind = self.value(each)
            if len(values) == len(targets) == 1:
                worked.append((code, kind))
            else:
                kept = self.temporary(kind)
                yield f"{kept} = {code};"
                worked.append((kept, kind))
        for target in targets:
            places = target.elts if isinstance(target, ast.Tuple) else [target]
            if len(places) != len(worked):
                raise self.refuse(target)
            for place, (code, kind) in zip(places, worked, strict=True):
                yield f"{self.place(place, kind)} = {code};"

    def place(self, target: ast.expr, kind: Any) -> str:
        if isinstance(target, ast.Name):
            self.know(target.id, kind, target)
            return f"v_{target.id}"
        if isinstance(target, ast.Subscript) and not any(isinstance(each, ast.Call) for each in ast.walk(target)):
            return self.value(target)[0]
        raise self.refuse(target)

    def know(self, name: str, kind: Any, node: ast.AST) -> None:
        before = self.known.setdefault(name, kind)
        if in_c(before) != in_c(kind):
            raise self.refuse(node)

    def temporary(self, kind: Any) -> str:
        self.used += 1
        self.known[f"t{self.used}_"] = kind
        return f"v_t{self.used}_"

    def value(self, node: ast.expr) -> Typed:  # noqa: C901, PLR0911, PLR0912 - one case for each kind
        match node:
            case ast.Constant(value=bool() | int() | float() as value):
                return number(value), type(value)
            case ast.Name(id=name):
                return self.name(name, node)
            case ast.Attribute(value=whole, attr=attr):
                code, kind = self.value(whole)
                return f"{code}.{attr}", get_type_hints(kind)[attr]
            case ast.Subscript(value=array, slice=index):
                return self.item(array, index, node)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                code, kind = self.value(operand)
                return f"(-{code})", kind
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"(!{self.value(operand)[0]})", bool
            case ast.BinOp(left=left, op=op, right=right):
                self.in_any_order(left, right)
                return self.sum_of(self.value(left), op, self.value(right), node)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                self.in_any_order(left, right)
                return f"({self.value(left)[0]} {_COMPARED[type(op)]} {self.value(right)[0]})", bool
            case ast.BoolOp(op=op, values=values):
                parts = [self.value(each) for each in values]
                if any(kind is not bool for _, kind in parts):
                    raise self.refuse(node)  # the value of "and" would be that of one side
                return "(" + (" && " if isinstance(op, ast.And) else " || ").join(code for code, _ in parts) + ")", bool
            case ast.IfExp(test=test, body=body, orelse=orelse):
                (one, kind), (other, same) = self.value(body), self.value(orelse)
                if in_c(kind) != in_c(same):
                    raise self.refuse(node)
                return f"({self.value(test)[0]} ? {one} : {other})", kind
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
                self.in_any_order(*args)
                return self.call(name, [self.value(each) for each in args], node)
        raise self.refuse(node)

    def name(self, name: str, node: ast.expr) -> Typed:
        if name in self.known:
            return f"v_{name}", self.known[name]
        value = self.function.__globals__.get(name)
        if isinstance(value, int | float):
            return number(value), float if isinstance(value, float) else int
        raise self.refuse(node)

    def item(self, array: ast.expr, index: ast.expr, node: ast.expr) -> Typed:
        at, kind = self.value(index)
        if kind not in (int, bool):
            raise self.refuse(node)
        if isinstance(array, ast.Name) and isinstance(numbers := self.function.__globals__.get(array.id), tuple):
            return f"{self.all.constant(array.id, numbers)}[{at}]", type(numbers[0])
        code, of = self.value(array)
        if of not in (WHOLE, REAL):
            raise self.refuse(node)
        return f"{code}.at[{at}]", int if of == WHOLE else float

    def sum_of(self, left: Typed, op: ast.operator, right: Typed, node: ast.expr) -> Typed:
        (one, kind), (other, same) = left, right
        both = float if float in (kind, same) else int
        if isinstance(op, ast.Div):
            return f"((double) {one} / (double) {other})", float
        if type(op) in _ROUNDED and both is int:
            return f"{_ROUNDED[type(op)]}({one}, {other})", int
        if type(op) in _ARITHMETIC:
            return f"({one} {_ARITHMETIC[type(op)]} {other})", both
        raise self.refuse(node)

    def call(self, name: str, given: list[Typed], node: ast.expr) -> Typed:
        codes = ", ".join(code for code, _ in given)
        if name == "len" and len(given) == 1:
            return f"{codes}.size", int
        if name in {"min", "max"}:
            kinds = {in_c(kind) for _, kind in given}
            if len(kinds) != 1 or len(given) != len(("one", "other")):
                raise self.refuse(node)
            kind = float if kinds == {"double"} else int
            return f"{name}_{'real' if kind is float else 'whole'}({codes})", kind
        found = self.function.__globals__.get(name)
        if is_record(found):
            self.all.record(found)
            return f"(({in_c(found)}) {{ {codes} }})", found
        if found is None:
            raise self.refuse(node)
        rule = plain_function(found)
        hints = get_type_hints(rule)
        back = hints.pop("return")
        if [in_c(kind) for kind in hints.values()] != [in_c(kind) for _, kind in given]:
            raise self.refuse(node)
        self.all.rule(rule)
        return f"f_{name}({codes})", back

    def in_any_order(self, *parts: ast.expr) -> None:
        """Refuse operands whose order counts: C may work out either first."""
        for at, part in enumerate(parts):
            touched = {root for call in ast.walk(part) if self.changes(call) for root in _roots(call)}
            for other in (*parts[:at], *parts[at + 1 :]):
                reads = {root for each in ast.walk(other) if isinstance(each, ast.Subscript) for root in _roots(each)}
                reads |= {root for call in ast.walk(other) if self.changes(call) for root in _roots(call)}
                if touched & reads:
                    raise self.refuse(part)

    def changes(self, node: ast.AST) -> bool:
        """Whether a part of an expression is a call that may write into an array."""
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
            return False
        found = self.function.__globals__.get(node.func.id)
        return found is not None and not is_record(found) and writes(plain_function(found))


def writes(function: Any) -> bool:
    """Whether a rule, or one that it calls, writes into an array."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    for node in ast.walk(tree):
        if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store):
            return True
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            found = function.__globals__.get(node.func.id)
            if found is not None and not is_record(found) and writes(plain_function(found)):
                return True
    return False


def _roots(node: ast.AST) -> set[str]:
    """Return the names in a part of an expression."""
    return {each.id for each in ast.walk(node) if isinstance(each, ast.Name)} - {"len", "min", "max"}
