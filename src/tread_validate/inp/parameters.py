"""``*PARAMETER``: names with values from simple arithmetic, put in place of ``<name>``. No code is run.

An expression is parsed, and only numbers, strings, earlier names, ``+ - * / **``, parentheses and a few functions of
one or two numbers are evaluated; anything else is refused.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping

Value = float | int | str

FUNCTIONS: dict[str, Callable[..., float]] = {
    "abs": abs, "acos": math.acos, "asin": math.asin, "atan": math.atan, "cos": math.cos, "cosh": math.cosh,
    "exp": math.exp, "float": float, "int": int, "log": math.log, "log10": math.log10, "max": max, "min": min,
    "pow": math.pow, "round": round, "sin": math.sin, "sinh": math.sinh, "sqrt": math.sqrt, "tan": math.tan,
    "tanh": math.tanh,
}  # fmt: skip
OPERATORS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
NAME = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)
MARK = re.compile(r"<\s*([A-Za-z_]\w*)\s*>", re.ASCII)
LONGEST = 1000  # characters of an expression
MOST_PARAMETERS = 10_000
LARGEST_INTEGER = 10**18


def assign(line: str, known: dict[str, Value]) -> None:
    """Evaluate one line ``name = expression`` into `known`; ``;`` ends an expression, what follows ``#`` is a comment.

    Raises
    ------
    ValueError
        What is wrong, in a few words.
    """
    text = _without_comment(line)
    if ";" in text and not {"'", '"'} & set(text):
        for one in text.split(";"):
            assign(one, known)
        return
    if not text:
        return
    name, equals, expression = text.partition("=")
    name = name.strip()
    if not equals or not NAME.match(name):
        raise ValueError(f"{text[:40]}; a line reads name = expression")
    if len(known) >= MOST_PARAMETERS:
        raise ValueError(f"more than {MOST_PARAMETERS} parameters")
    known[name] = evaluate(expression, known)


def evaluate(expression: str, known: Mapping[str, Value]) -> Value:
    """Return the value of an expression.

    Raises
    ------
    ValueError
        Syntax, an unknown name, an operation that is not simple arithmetic, or no finite value.

    Examples
    --------
    >>> evaluate("3.0*sin(30*pi/180.0) + a", {"a": 1})
    2.5
    """
    text = expression.strip()
    if len(text) > LONGEST:
        raise ValueError(f"an expression of {len(text)} characters, at most {LONGEST}")
    try:
        tree = ast.parse(text, mode="eval")
        value = _value(tree.body, known)
    except (SyntaxError, RecursionError, MemoryError):
        raise ValueError(f"{text[:40]} is no expression") from None
    except (ZeroDivisionError, OverflowError, TypeError) as error:
        raise ValueError(f"{text[:40]}: {error}") from None
    if isinstance(value, str):
        return value
    if isinstance(value, complex) or not math.isfinite(value) or abs(value) > 1e300:
        raise ValueError(f"{text[:40]} has no finite value")
    return value


def _value(node: ast.expr, known: Mapping[str, Value]) -> Value:
    if isinstance(node, ast.Constant) and type(node.value) in (int, float, str):
        value = node.value
        if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
            raise ValueError(f"an integer of {len(str(value))} digits")
        return value  # type: ignore[return-value]  # int, float or str by the test above
    if isinstance(node, ast.Name):
        if node.id in known:
            return known[node.id]
        if node.id == "pi":
            return math.pi
        raise ValueError(f"{node.id} is no parameter defined before")
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.UAdd | ast.USub):
        operand = _number(node.operand, known)
        return -operand if isinstance(node.op, ast.USub) else operand
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return _operation(node, known)
    if isinstance(node, ast.Call):
        if not isinstance(node.func, ast.Name) or node.func.id not in FUNCTIONS or node.keywords:
            raise ValueError(f"{ast.unparse(node.func)[:40]}() is not run; functions are {', '.join(FUNCTIONS)}")
        return FUNCTIONS[node.func.id](*(_number(one, known) for one in node.args))
    raise ValueError(f"{ast.unparse(node)[:40]} is no simple arithmetic")


def _operation(node: ast.BinOp, known: Mapping[str, Value]) -> float:
    left, right = _number(node.left, known), _number(node.right, known)
    if isinstance(node.op, ast.Div) and isinstance(left, int) and isinstance(right, int):
        # 1/2 is 0 in releases with Python 2 inside and 0.5 in later ones
        if right == 0 or left % right:
            raise ValueError(f"{left}/{right} of integers differs between releases; write {left}./{right}.")
        return left // right
    if isinstance(node.op, ast.Pow) and (abs(right) > 1000 or (isinstance(left, int) and abs(right) > 60)):
        raise ValueError(f"an exponent of {right}")
    value = OPERATORS[type(node.op)](left, right)
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        raise ValueError("an integer beyond 18 digits")
    return value


def _number(node: ast.expr, known: Mapping[str, Value]) -> float:
    value = _value(node, known)
    if isinstance(value, str):
        raise ValueError(f"{value[:40]!r} is a string, not a number")
    return value


def _without_comment(line: str) -> str:
    """Cut what follows a ``#`` outside quotes."""
    quote = ""
    for position, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "#":
            return line[:position].strip()
    return line.strip()


def substitute(text: str, known: Mapping[str, Value]) -> str:
    """Return `text` with every ``<name>`` replaced by its value.

    Raises
    ------
    KeyError
        A name that is not known.
    """
    return MARK.sub(lambda found: written(known[found[1]]), text)


def written(value: Value) -> str:
    """Return a value as it is put into the text; floats in the shortest form that reads back the same."""
    return value if isinstance(value, str) else repr(value)
