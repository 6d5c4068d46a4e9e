"""Which code can change a result: digests of the package's source, part by part, from the import graph.

A part is named by its entry modules. Everything that those modules import, directly or through others, belongs to
it, found in the syntax trees without running anything:

- ``from ..friction import law`` leads to the module that defines ``law``, not to everything that the package's
  ``__init__`` offers;
- imports inside functions count, those under ``if TYPE_CHECKING`` do not;
- a name that cannot be traced counts as the whole package that it comes from;
- data files (templates, keyword tables) beside a module of the part, or in a folder of data there, count too.

Comments, docstrings, blank lines, annotations' quotes and the words of raised errors do not count: they change no
number. The digest is the same under every Python version that the package runs on.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from .errors import InputError
from .syntax import KEPT, Module, read_module

PACKAGE = Path(__file__).resolve().parent
DATA = (".j2", ".f", ".inc", ".typ", ".css", ".js", ".yaml", ".json")

UNKNOWN = "unknown"
"""In place of a digest: for code that cannot be read here."""

PARTS: Mapping[str, tuple[str, ...]] = {
    "study": ("study",),
    "material": ("material",),
    "friction": ("friction",),
    "geometry": ("geometry",),
    "deck": ("deck.model", "spring.creep", "spring.block_pass"),
    "fe": ("fe.run",),
    "calculix": ("calculix.engine",),
    "abaqus": ("reference.abaqus",),
    "compare": ("compare.*", "spring.block_pass"),
    "hierarchy": ("hierarchy.*", "spring.*"),
    "report": ("report.*", "spring.block_pass"),
}
"""Parts and the modules that they begin with (``x.*``: a whole package). `deck`, `compare` and `report` include the
spring model that finds the creep of free rolling, `hierarchy` all variants. The parts of the spring model are its
variants, see `spring.variants.code_digest`."""


def code_digest(part: str) -> str:
    """Return the digest of a part of `PARTS`; raises `InputError` for another."""
    if part not in PARTS:
        raise InputError("part of the code", part, f"one of {', '.join(PARTS)}")
    return digest_of(PARTS[part])


@cache
def digest_of(entries: tuple[str, ...], root: Path = PACKAGE) -> str:
    """Return the digest of everything that the entry modules depend on: 16 hex digits of a SHA-256.

    Parameters
    ----------
    entries : tuple of str
        Modules, dotted and relative to the package.
    root : path
        Folder of the package's source.
    """
    graph = _graph(root)
    names = graph.closure(entries)
    total = hashlib.sha256()
    for name in sorted(names):
        total.update(f"{name} {graph.module(name).digest}\n".encode())
    for file in sorted(graph.data_files(names)):
        total.update(f"{file.relative_to(root).as_posix()} {hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    KEPT.save()
    return total.hexdigest()[:16]


@cache
def _graph(root: Path) -> Graph:
    return Graph(root)


class Graph:
    """The modules below a package's folder and what they import, read as far as they are asked for."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.modules: dict[str, Module] = {}
        self.path = cache(self._path)  # asked thousands of times

    def _path(self, name: str) -> Path | None:
        """Return the file of a module, None where there is none; ``""`` is the package itself."""
        base = self.root.joinpath(*name.split(".")) if name else self.root
        for file in (base / "__init__.py", base.with_suffix(".py") if name else base):
            if file.is_file():
                return file
        return None

    def module(self, name: str) -> Module:
        """Return a module; raises `InputError` where there is none."""
        bare = name.removesuffix(" (names)")
        if name not in self.modules:
            file = self.path(bare)
            if file is None:
                raise InputError("code digest", name, "a module of the package")
            self.modules[name] = read_module(file, bare, names_only=name != bare)
        return self.modules[name]

    def closure(self, entries: Iterable[str]) -> set[str]:
        """Return the names of all modules that the entries depend on, themselves included."""
        found: set[str] = set()
        waiting: list[str] = []
        for entry in entries:
            package, whole, _ = entry.partition(".*")
            waiting += self._whole(package) if whole else [package]
        while waiting:
            name = waiting.pop()
            if name in found:
                continue
            found.add(name)
            waiting += self.needs(name)
        return found

    def needs(self, name: str) -> set[str]:
        """Return what one module imports, traced to where each name is defined."""
        bare = name.removesuffix(" (names)")
        needed = {f"{above} (names)" for above in _above(bare)}
        module = self.module(name)
        if name != bare:
            return needed
        for target, imported in module.imports:
            needed |= self.trace(target, imported)
        return needed

    def trace(self, package: str, name: str | None, asked: frozenset[tuple[str, str | None]] = frozenset()) -> set[str]:
        """Return the modules behind ``from package import name`` (or ``import package`` where name is None)."""
        if name is None or (package, name) in asked:
            return {package}
        below = f"{package}.{name}" if package else name
        if self.path(below) is not None:
            return {below}
        file = self.path(package)
        if file is None:
            raise InputError("code digest", package, "a module of the package")
        if file.name != "__init__.py":
            return {package}
        init = self.module(f"{package} (names)")
        if name in init.defines:
            return {f"{package} (names)"} if name not in init.uses_imports else {package}
        passed = init.passes_on.get(name)
        if passed is None:
            return self._whole(package)
        found = self.trace(*passed, asked | {(package, name)})
        return found | {f"{package} (names)"}

    def data_files(self, names: Iterable[str]) -> set[Path]:
        """Return the data files beside the modules, or in folders there that hold no modules."""
        folders: set[Path] = set()
        for name in names:
            if name.endswith(" (names)"):
                continue
            file = self.path(name)
            assert file is not None
            if file.parent != self.root:
                folders.add(file.parent)
        found: set[Path] = set()
        for folder in folders:
            found |= {path for path in folder.iterdir() if path.suffix in DATA}
            for inner in folder.iterdir():
                if inner.is_dir() and not (inner / "__init__.py").exists() and inner.name != "__pycache__":
                    found |= {path for path in inner.rglob("*") if path.suffix in (*DATA, ".py")}
        return found

    def _whole(self, package: str) -> set[str]:
        """Return every module of a package: for names that cannot be traced."""
        folder = self.root.joinpath(*package.split(".")) if package else self.root
        names = {package}
        for file in folder.rglob("*.py"):
            dotted = ".".join(file.relative_to(self.root).with_suffix("").parts)
            names.add(dotted.removesuffix(".__init__"))
        return {name for name in names if self.path(name) is not None}


def _above(name: str) -> list[str]:
    """Return the packages whose ``__init__`` runs before a module: all above it, and the outermost, ``""``."""
    pieces = name.split(".") if name else []
    return ["", *(".".join(pieces[:depth]) for depth in range(1, len(pieces)))] if pieces else []
