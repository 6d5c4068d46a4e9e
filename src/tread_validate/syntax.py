"""The syntax tree of a module as its digest and its imports see it; nothing is run."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from .errors import InputError
from .syntax_cache import SyntaxCache

OUTERMOST = "tread_validate"
IGNORED_FIELDS = frozenset({"type_params", "type_comment", "kind", "ctx", "type_ignores"})
KEPT = SyntaxCache(Path(__file__))
STATEMENTS = ("body", "orelse", "handlers", "finalbody", "cases")
"""Fields of a syntax tree that hold statements: imports stand nowhere else."""


@dataclass(frozen=True)
class Module:
    """What a source file says.

    Attributes
    ----------
    digest : str
        SHA-256 of the tree without comments, docstrings and words of raised errors, in hex.
    imports : tuple of (module, name or None)
        Imports from the package itself, module names relative to it; None for ``import module``.
    defines : frozenset of str
        Names that the module's own statements define at its outer level.
    uses_imports : frozenset of str
        Those among them whose definitions need what the module imports.
    passes_on : mapping of str to (module, name or None)
        Names that it only imports and offers further.
    """

    digest: str
    imports: tuple[tuple[str, str | None], ...]
    defines: frozenset[str]
    uses_imports: frozenset[str]
    passes_on: dict[str, tuple[str, str | None]]


def read_module(file: Path, name: str, *, names_only: bool = False) -> Module:
    """Read a module; raises `InputError` where its syntax is wrong.

    Parameters
    ----------
    name : str
        Dotted, relative to the package; ``""`` is the package itself.
    names_only : bool
        Leave imports and ``__all__`` out of the digest: for an ``__init__`` that a part only comes through.
    """
    package = name if file.name == "__init__.py" else name.rpartition(".")[0]
    source = file.read_text(encoding="utf-8")
    key = KEPT.key(source, package, str(names_only))
    found = KEPT.get(key)
    if found is None:
        module = _read(file, source, package, names_only)
        KEPT.put(
            key, [module.digest, module.imports, sorted(module.defines), sorted(module.uses_imports), module.passes_on]
        )
        return module
    digest, imports, defines, uses, passed = found
    targets = tuple((target, alias) for target, alias in imports)
    return Module(
        digest,
        targets,
        frozenset(defines),
        frozenset(uses),
        {alias: (one, two) for alias, (one, two) in passed.items()},
    )


def _read(file: Path, source: str, package: str, names_only: bool) -> Module:
    try:
        return _module(source, package, names_only)
    except SyntaxError as error:
        raise InputError(f"{file}:{error.lineno}", error.msg, "Python source") from None


@lru_cache(maxsize=1024)
def _module(source: str, package: str, names_only: bool) -> Module:
    tree = ast.parse(source)
    imports: list[tuple[str, str | None]] = []
    passed: dict[str, tuple[str, str | None]] = {}
    for node in _running(tree):
        for alias, target in _imported(node, package):
            imports.append(target)
            if node in tree.body:
                passed[alias] = target
    passed |= _named_lazily(tree, package)
    body = [node for node in tree.body if not (_is_docstring(node) or (names_only and _only_names(node)))]
    defines: set[str] = set()
    uses: set[str] = set()
    for node in body if names_only else ():
        own = set(_defined(node))
        defines |= own
        used = {inner.id for inner in ast.walk(node) if isinstance(inner, ast.Name)}
        if used & set(passed) or any(list(_imported(inner, package)) for inner in _running(node)):
            uses |= own
    lines = source.encode("utf-8").splitlines(keepends=True)
    digest = hashlib.sha256("\n".join(_canonical(node, lines) for node in body).encode()).hexdigest()
    return Module(digest, tuple(dict.fromkeys(imports)), frozenset(defines), frozenset(uses), passed)


def _running(tree: ast.AST) -> Iterator[ast.AST]:
    """Walk the statements of the tree, without what stands under ``if TYPE_CHECKING``."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test):
            waiting += node.orelse
            continue
        for name in STATEMENTS:
            waiting += getattr(node, name, ())


def _imported(node: ast.AST, package: str) -> Iterator[tuple[str, tuple[str, str | None]]]:
    """Yield (name in the importing module, (module, name)) for each import from the package."""
    if isinstance(node, ast.Import):
        for alias in node.names:
            if alias.name == OUTERMOST or alias.name.startswith(f"{OUTERMOST}."):
                yield alias.asname or OUTERMOST, (alias.name[len(OUTERMOST) + 1 :], None)
    elif isinstance(node, ast.ImportFrom):
        if node.level:
            pieces = package.split(".") if package else []
            base = pieces[: len(pieces) - (node.level - 1)]
            target = ".".join([*base, *(node.module.split(".") if node.module else [])])
        elif node.module is not None and (node.module == OUTERMOST or node.module.startswith(f"{OUTERMOST}.")):
            target = node.module[len(OUTERMOST) + 1 :]
        else:
            return
        for alias in node.names:
            yield alias.asname or alias.name, (target, alias.name)


def _named_lazily(tree: ast.Module, package: str) -> dict[str, tuple[str, str | None]]:
    """Return names that ``__getattr__`` imports by a table ``{"name": ".module"}``, or ``.module:name``."""
    if not any(isinstance(node, ast.FunctionDef) and node.name == "__getattr__" for node in tree.body):
        return {}
    found: dict[str, tuple[str, str | None]] = {}
    for node in ast.walk(tree):
        if not isinstance(node, ast.Dict):
            continue
        for key, value in zip(node.keys, node.values, strict=True):
            if isinstance(key, ast.Constant) and isinstance(value, ast.Constant) and isinstance(value.value, str):
                module, _, name = value.value.partition(":")
                target = ".".join(filter(None, [package, module.lstrip(".")]))
                found[str(key.value)] = (target, name or str(key.value))
    return found


def _only_names(node: ast.stmt) -> bool:
    """Whether a statement only passes names on: an import or ``__all__``."""
    if isinstance(node, ast.Import | ast.ImportFrom):
        return True
    return isinstance(node, ast.Assign) and any(isinstance(t, ast.Name) and t.id == "__all__" for t in node.targets)


def _defined(node: ast.stmt) -> Iterator[str]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        yield node.name
    elif isinstance(node, ast.Assign | ast.AnnAssign | ast.For | ast.If | ast.Try | ast.With):
        for inner in ast.walk(node):
            if isinstance(inner, ast.Name) and isinstance(inner.ctx, ast.Store):
                yield inner.id


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _canonical(node: object, lines: list[bytes]) -> str:
    """Return a text of the tree that does not depend on the Python version, on comments, docstrings or messages."""
    if isinstance(node, list):
        kept = [item for item in node if not _is_docstring(item)]
        return "[" + ",".join([_canonical(item, lines) for item in kept]) + "]"
    if not isinstance(node, ast.AST):
        return repr(node)
    if isinstance(node, ast.JoinedStr):  # its tree differs between versions
        return f"f({_segment(node, lines)!r})"
    if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
        return f"Raise({_canonical(node.exc.func, lines)})"
    fields = []
    for name in node._fields:
        value = getattr(node, name, None)
        if name in IGNORED_FIELDS or value is None or value == []:
            continue
        fields.append(f"{name}={_canonical(value, lines)}")
    return f"{type(node).__name__}({','.join(fields)})"


def _segment(node: ast.JoinedStr, lines: list[bytes]) -> bytes:
    """Return the source of an expression."""
    assert node.end_lineno is not None
    part = lines[node.lineno - 1 : node.end_lineno]
    part[-1] = part[-1][: node.end_col_offset]
    part[0] = part[0][node.col_offset :]
    return b"".join(part)
