"""Formulas of Macro B: `#1`, `[#2+3.5*SIN[#4]]`, `#[#5+1]`, `[#1 EQ #0]`.

A formula is kept as it was written and worked out when its block runs. Two dialects differ, and the setting `macros` chooses
(`Formula.worth`). A variable that was never given a value is *vacant*: Fanuc takes it for 0 in arithmetic, but not where EQ
and NE compare, and leaves an address out whose value is vacant; LinuxCNC takes it for 0 everywhere. On one level of brackets
Fanuc joins AND as tight as `*` and OR and XOR as tight as `+`, LinuxCNC joins them last, and takes them for true and false.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from mnclab.text.alarm import Alarm, Span
from mnclab.text.expression import Expression, Orderer, Token, finite, refuse, split

_TOKEN = re.compile(
    r"\s*(?:(\d+(?:\.\d*)?|\.\d+)|(#[ \t]*(?:\d{1,9}|<[^<>\[\]#]{0,80}>)?)"
    r"|(MOD|AND|XOR|OR|EQ|NE|GT|GE|LT|LE|A?(?:SIN|COS|TAN)|SQRT?|ABS|BIN|BCD|ROUND|RND|FIX|FUP|LN|EXP|POW|EXISTS)|(\*\*|[-+*/,\[\]]))",
    re.IGNORECASE | re.ASCII,
)
_MACHINE = re.compile(r"#[ \t]*<[ \t]*_(?:hal|ini)[ \t]*\[", re.IGNORECASE)
_VARIABLE = "a variable is a number, #101, or a name of LinuxCNC, #<depth>"
KINDS = ("number", "variable", "name", "mark")
FANUC, LINUXCNC = "fanuc", "linuxcnc"
ORDINARY = 999  # variables above it belong to the control
MOST_OF_LINUXCNC = 5601  # the greatest number there; those that the control does not keep are free
EQUAL = 1e-4  # numbers that differ by less are equal to LinuxCNC
MOST = 2.0**31

COMPARISONS: dict[str, Callable[[float, float], bool]] = {
    "EQ": lambda a, b: a == b, "NE": lambda a, b: a != b, "GT": lambda a, b: a > b,
    "GE": lambda a, b: a >= b, "LT": lambda a, b: a < b, "LE": lambda a, b: a <= b,
}  # fmt: skip
LOGIC: dict[str, Callable[[int, int], int]] = {
    "AND": lambda a, b: a & b, "OR": lambda a, b: a | b, "XOR": lambda a, b: a ^ b,
}  # fmt: skip
_LEVELS = dict.fromkeys(COMPARISONS, 1) | {"+": 2, "-": 2, "*": 3, "/": 3, "MOD": 3, "**": 4}
LEVELS = {
    FANUC: _LEVELS | {"OR": 2, "XOR": 2, "AND": 3},
    LINUXCNC: _LEVELS | {"OR": 0, "XOR": 0, "AND": 0},
}


def _tangent(degrees: float) -> float:
    if abs(math.cos(math.radians(degrees))) < 1e-12:
        raise ValueError
    return math.tan(math.radians(degrees))


def _away(value: float) -> float:
    """The nearest whole number, of two the one that is farther from 0."""
    return math.copysign(math.floor(abs(value) + 0.5), value)


def _to_decimal(value: float) -> float:
    return float(int(f"{_whole(value):x}"))


def _from_decimal(value: float) -> float:
    return float(int(str(_whole(value)), 16))


def _whole(value: float) -> int:
    if value != int(value) or not 0 <= value < 1e8:
        raise ValueError
    return int(value)


#: Functions of one number, angles in degrees, that all dialects have alike.
FUNCTIONS: dict[str, Callable[[float], float]] = {
    "SIN": lambda a: math.sin(math.radians(a)), "COS": lambda a: math.cos(math.radians(a)), "TAN": _tangent,
    "ACOS": lambda a: math.degrees(math.acos(a)), "SQRT": math.sqrt, "SQR": math.sqrt, "ABS": abs,
    "LN": math.log, "EXP": math.exp, "BIN": _to_decimal, "BCD": _from_decimal,
}  # fmt: skip
#: Those that they have differently: Fanuc cuts off, LinuxCNC rounds down and up; angles from 0 or from -180 degrees.
OWN: dict[str, dict[str, Callable[[float], float]]] = {
    FANUC: {
        "FIX": lambda a: float(math.trunc(a)), "FUP": lambda a: math.copysign(math.ceil(abs(a)), a),
        "ASIN": lambda a: math.degrees(math.asin(a)) % 360, "ATAN": lambda a: math.degrees(math.atan(a)),
    },
    LINUXCNC: {
        "FIX": lambda a: math.copysign(math.floor(a), a), "FUP": lambda a: math.copysign(math.ceil(a), a),
        "ASIN": lambda a: math.degrees(math.asin(a)),
    },
}  # fmt: skip
ROUNDING = ("ROUND", "RND")
#: What LinuxCNC does not know (rs274: Unknown word where unary operation could be), and what to write there instead.
NOT_OF_LINUXCNC = {
    "SQR": "write SQRT", "RND": "write ROUND", "BIN": "", "BCD": "", "POW": "write a ** b", "ATAN": "write ATAN[y]/[x]",
}  # fmt: skip
NAMES = {*FUNCTIONS, *OWN[FANUC], *ROUNDING, "POW", "EXISTS"}


@dataclass(frozen=True)
class Formula(Expression):
    """Tokens with their places, and for each dialect the order in which they are worked out.

    Among the tokens, a variable without a name is one whose number is worked out: which one it is nobody can say before.
    """

    orders: tuple[tuple[str, tuple[Token, ...]], ...] = ()
    unclear: Token | None = None  # a comparison beside AND, OR or XOR without brackets

    def evaluate(self, variables: Mapping[str, Any]) -> float:
        return self.worth(variables) or 0.0

    def worth(self, variables: Mapping[str, Any], dialect: str = "", unit: float = 1.0) -> float | None:
        """The value with these variables, None if it is vacant; an Alarm at the part that has none.

        `unit` is what ROUND rounds to. Without a `dialect` it is the one that a history holds.
        """
        return self.stack(self.order(dialect or variables.get("macros", FANUC)), variables, dialect, unit)[0]

    def sides(self, variables: Mapping[str, Any], dialect: str) -> tuple[float, float] | None:
        """What a condition compares: the numbers left and right of its comparison; None if it is put together otherwise."""
        order = self.order(dialect)
        if order[-1].text not in COMPARISONS:
            return None
        left, right = self.stack(order[:-1], variables, dialect, 1.0)
        return left or 0.0, right or 0.0

    def name(self, variables: Mapping[str, Any], dialect: str) -> str:
        """The variable that a formula names, which is nothing but one."""
        if (last := self.tokens[0]).text:
            return last.text
        number = self.stack(self.order(dialect)[:-1], variables, dialect, 1.0)[0]
        return f"#{_index(number or 0.0, last)}"

    def order(self, dialect: str) -> tuple[Token, ...]:
        if dialect == FANUC and self.unclear:
            message = f"{self.unclear.text} stands beside a comparison without brackets"
            raise Alarm(message, self.unclear.span, hint="write [#1 EQ 1] AND [#2 EQ 2]")
        return dict(self.orders)[dialect]

    def stack(
        self, order: tuple[Token, ...], variables: Mapping[str, Any], dialect: str, unit: float
    ) -> list[float | None]:
        values: list[float | None] = []
        dialect = dialect or variables.get("macros", FANUC)
        for token in order:
            if token.kind == "number":
                values.append(finite(float(token.text), token))
            elif token.kind == "variable":
                if not token.text:
                    token = token._replace(text=f"#{_index(values.pop() or 0.0, token)}")
                values.append(fetch(variables, token, dialect))
            elif token.kind == "existence":
                if dialect == FANUC:
                    raise Alarm("EXISTS is LinuxCNC's", token.span, hint="a variable without a value is EQ #0")
                values.append(float(token.text[1:2] != "<" or variables.get(token.text) is not None))
            elif token.kind == "sign":
                values[-1] = None if values[-1] is None else -values[-1]
            elif token.kind in ("pair", "joint"):
                right = values.pop()
                values[-1] = _joined(values[-1], token, right, dialect)
            else:
                values[-1] = finite(_function(token, _plain(values[-1]), dialect, unit), token)
        return values


def fetch(variables: Mapping[str, Any], token: Token, dialect: str) -> float | None:
    """The value of a variable, None if it is vacant."""
    name = token.text
    if name == "#0" and dialect == LINUXCNC:
        refuse("LinuxCNC has no variable", token)
    known = variables.get(name)
    if known is None and (name.startswith("#<_") or name[1:2] != "<" and int(name[1:]) > ORDINARY):
        try:
            known = variables[name]
        except KeyError:
            if name[1] != "<" and (dialect != LINUXCNC or int(name[1:]) > MOST_OF_LINUXCNC):
                raise Alarm(f"{name} is a variable of the control that is not built, or has no value", token.span) from None
    if known is None and name[1:2] == "<":
        refuse("no value was given to", token)
    return 0.0 if known is None and dialect == LINUXCNC else None if known is None else float(known)


def parse(text: str, span: Span) -> Formula:
    """Read a formula that starts at `span`; an Alarm at the first character that is no part of one."""
    if found := _MACHINE.search(text):
        place = span._replace(column=span.column + found.start(), length=len(found.group()) - 1)
        raise Alarm("a HAL pin or an INI entry has a value on the machine alone", place, hint="write its number")
    tokens = split(text, _TOKEN, KINDS, span, "an expression", _spelt, _VARIABLE)
    orders = {dialect: _ordered(tokens, levels) for dialect, levels in LEVELS.items()}
    return Formula(tuple(tokens), text.strip(), 1.0, orders[FANUC], tuple(orders.items()), _unclear(tokens))


def variable_name(text: str) -> str:
    """How a variable is called in tables: `#7`, `#<depth>`."""
    inside = re.sub(r"[ \t]", "", text[1:]).lower()
    return f"#{inside}" if inside[:1] in ("", "<") else f"#{int(inside)}"


def _spelt(part: str) -> str:
    return variable_name(part).rstrip("#") if part[0] == "#" else part.upper()


def _unclear(tokens: list[Token]) -> Token | None:
    """The first AND, OR or XOR on a level of brackets with a comparison."""
    levels: list[tuple[list[Token], list[Token]]] = [([], [])]
    for token in [*tokens, None]:
        if token is not None and token.text == "[":
            levels.append(([], []))
        elif token is None or token.text == "]":
            logic, comparisons = levels.pop()
            if logic and comparisons:
                return logic[0]
        elif token.text in LOGIC or token.text in COMPARISONS:
            levels[-1][token.text in COMPARISONS].append(token)
    return None


def _ordered(tokens: list[Token], levels: Mapping[str, int]) -> tuple[Token, ...]:
    return _Reader(tokens, levels).ordered()


class _Reader(Orderer):
    """That of brackets, functions of two numbers and EXISTS."""

    def __init__(self, tokens: list[Token], levels: Mapping[str, int]) -> None:
        super().__init__(tokens)
        self.levels = levels  # type: ignore[misc]

    def bracketed(self) -> None:
        """What stands between the brackets that come next."""
        opening = self.take()
        if opening.text != "[":
            refuse("'[' was expected before", opening)
        self.climb()

    def close(self) -> None:
        if self.peek() != "]":
            if self.at < len(self.tokens):
                refuse("']' was expected before", self.tokens[self.at])
            raise Alarm("a bracket is not closed: ']' is missing", self.tokens[-1].span)
        self.at += 1

    def operand(self, level: int) -> None:
        token = self.take()
        self.deeper()
        if token.text == "[":
            self.climb()
            self.close()
        elif token.kind == "variable" and not token.text:
            self.indirect(token)
        elif token.text in ("+", "-"):
            self.operand(level)
            if token.text == "-":
                self.steps.append(token._replace(kind="sign"))
        elif token.kind in ("number", "variable"):
            self.steps.append(token)
        elif token.text == "EXISTS":
            self.existence(token)
        elif token.text in NAMES:
            self.function(token)
        else:
            refuse("a number or a variable was expected, found", token)
        self.depth -= 1

    def indirect(self, token: Token) -> None:
        following = self.tokens[self.at] if self.at < len(self.tokens) else token
        if following is token or (following.text != "[" and following.kind != "variable"):
            raise Alarm("'#' needs the number of a variable", token.span, hint="for example #101 or #[#1+1]")
        self.operand(0)
        self.steps.append(token)

    def existence(self, token: Token) -> None:
        """EXISTS asks for a variable, not for its value (LinuxCNC)."""
        if [t.text for t in self.tokens[self.at : self.at + 1]] != ["["] or self.tokens[self.at + 1 : self.at + 2] == []:
            raise Alarm("EXISTS needs a variable in brackets", token.span, hint="for example EXISTS[#<depth>]")
        variable = self.tokens[self.at + 1]
        if variable.kind != "variable" or not variable.text:
            raise Alarm("EXISTS needs a variable in brackets", variable.span, hint="for example EXISTS[#<depth>]")
        self.at += 2
        self.close()
        self.steps.append(variable._replace(kind="existence"))

    def function(self, token: Token) -> None:
        """ATAN and POW take two numbers: `ATAN[1]/[2]`, `ATAN[1,2]`, `POW[2,3]`."""
        self.bracketed()
        comma = two = token.text in ("ATAN", "POW") and self.peek() == ","
        if comma:
            self.at += 1
            self.climb()
        self.close()
        if token.text == "ATAN" and not two and [t.text for t in self.tokens[self.at : self.at + 2]] == ["/", "["]:
            self.at += 1
            self.bracketed()
            self.close()
            two = True
        if token.text == "POW" and not two:
            raise Alarm("POW needs two numbers", token.span, hint="for example POW[2,3]")
        self.steps.append(token._replace(kind="pair" if comma else "joint") if two else token)

    def join(self, mark: str, left: None, first: int) -> None:
        super().join(mark, left, first)
        self.steps[-1] = self.steps[-1]._replace(kind="joint")


def _joined(left: float | None, operator: Token, right: float | None, dialect: str) -> float:
    """The value of two operands, or of a function of two numbers."""
    text = operator.text
    if dialect == LINUXCNC and operator.kind == "pair":
        message = f"{text} of two numbers in one bracket is not known to LinuxCNC"
        raise Alarm(message, operator.span, hint=NOT_OF_LINUXCNC[text])
    if text in ("EQ", "NE") and (left is None or right is None):
        return float((left is right) == (text == "EQ"))
    a, b = _plain(left), _plain(right)
    if text in COMPARISONS:
        if dialect == LINUXCNC and text in ("EQ", "NE"):
            return float((abs(a - b) < EQUAL) == (text == "EQ"))
        return float(COMPARISONS[text](a, b))
    if text in LOGIC:
        if dialect == LINUXCNC:
            return float(LOGIC[text](bool(a), bool(b)))
        return float(LOGIC[text](_bits(a, operator), _bits(b, operator)))
    if text == "ATAN":
        if a == b == 0 and dialect == FANUC:
            refuse("two sides of length 0 have no angle at", operator)
        angle = math.degrees(math.atan2(a, b))
        return angle % 360 if dialect == FANUC else angle
    if text in ("**", "POW"):
        try:
            return finite(float(a**b), operator)
        except (ZeroDivisionError, OverflowError, TypeError):
            refuse("no real power at", operator)
    if text in ("/", "MOD") and b == 0:
        refuse("division by zero at", operator)
    if text == "MOD":
        return _remainder(a, b, operator, dialect)
    return finite(a + b if text == "+" else a - b if text == "-" else a * b if text == "*" else a / b, operator)


def _plain(value: float | None) -> float:
    """A number in arithmetic, where a vacant one is 0; -0 stays, for an angle depends on it."""
    return 0.0 if value is None else value


def _remainder(a: float, b: float, operator: Token, dialect: str) -> float:
    """The sign is that of the first number, LinuxCNC never has a minus; Fanuc divides whole numbers."""
    if dialect == FANUC:
        return math.fmod(_bits(a, operator), _bits(b, operator))
    rest = math.fmod(a, b)
    return rest + abs(b) if rest < 0 else rest


def _bits(value: float, operator: Token) -> int:
    near = _away(value)
    if abs(value - near) > 1e-6 or abs(value) >= MOST:
        hint = "write ROUND, FIX or FUP; the setting macros can choose LinuxCNC"
        raise Alarm(f"{operator.text} takes whole numbers, got {value:.10g}", operator.span, hint=hint)
    return int(near)


def _function(name: Token, argument: float, dialect: str, unit: float) -> float:
    if dialect == LINUXCNC and name.text in NOT_OF_LINUXCNC:
        raise Alarm(f"{name.text} of one number is not known to LinuxCNC", name.span, hint=NOT_OF_LINUXCNC[name.text])
    if name.text in ROUNDING:
        return _away(argument / unit) * unit + 0.0  # never -0
    function = FUNCTIONS.get(name.text) or OWN[dialect][name.text]
    try:
        return function(argument)
    except (ValueError, OverflowError):
        raise Alarm(f"{name.text} of {argument:g} has no value", name.span) from None


def _index(value: float, token: Token) -> int:
    near = _away(value)
    if abs(value - near) > 1e-6 or not 0 <= near < 1e6:
        raise Alarm(f"the number of a variable must be a whole number from 0, got {value:.10g}", token.span)
    return int(near)
