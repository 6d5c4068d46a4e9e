"""Digests of the code behind a result: what counts, what does not, and where an edit reaches."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from tread_validate import source_code, syntax
from tread_validate.errors import InputError
from tread_validate.source_code import PACKAGE, PARTS, Graph, code_digest, digest_of
from tread_validate.spring.variants import BUILT_IN, COMMON
from tread_validate.syntax_cache import SyntaxCache

VARIANTS = {name: (*COMMON, f"spring.{place.partition(':')[0]}") for name, (place, _) in BUILT_IN.items()}


def digests(root: Path, names: tuple[str, ...]) -> dict[str, str]:
    """Return today's digests of parts and variants in a copy of the package."""
    digest_of.cache_clear()
    source_code._graph.cache_clear()
    return {name: digest_of(PARTS.get(name) or VARIANTS[name], root) for name in names}


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the package's source, to edit."""
    target = tmp_path_factory.mktemp("source") / "tread_validate"
    shutil.copytree(PACKAGE, target, ignore=shutil.ignore_patterns("__pycache__"))
    return target


@pytest.mark.parametrize(
    ("file", "changed", "kept"),
    [
        ("spring/condensed/march.py", {"condensed"}, {"paper", "fe", "deck"}),
        ("spring/element.py", {"paper", "shape_factor", "condensed", "deck"}, {"fe", "friction", "material"}),
        ("material/prony.py", {"material", "paper", "condensed", "deck"}, {"fe", "friction"}),
        ("fe/contact_kernel.py", {"fe"}, {"paper", "condensed", "deck", "compare"}),
        ("friction/kernel.py", {"friction", "paper", "condensed"}, {"fe", "material"}),
        ("report/html.py", {"report"}, {"compare", "paper", "fe"}),
        ("deck/mesh.py", {"deck"}, {"paper", "fe"}),
    ],
)
def test_an_edit_changes_the_digests_of_what_rests_on_it_and_no_other(
    file: str, changed: set[str], kept: set[str], copy: Path
) -> None:
    """Adding a statement to a module changes the parts that import it; taking it back restores every digest."""
    names = tuple(sorted(changed | kept))
    before = digests(copy, names)
    path = copy / file
    text = path.read_text(encoding="utf-8")
    path.write_text(text + "\nEDITED = 1\n", encoding="utf-8")
    after = digests(copy, names)
    path.write_text(text, encoding="utf-8")
    assert {name for name in names if before[name] != after[name]} == changed
    assert digests(copy, names) == before


@pytest.mark.parametrize("what", ["comment", "docstring", "blank lines", "words of an error"])
def test_what_changes_no_number_changes_no_digest(what: str, copy: Path) -> None:
    """Comments, docstrings, layout and messages are left out."""
    path = copy / "fe" / "run.py"
    text = path.read_text(encoding="utf-8")
    edited = {
        "comment": text.replace("def run_deck(", "# why\ndef run_deck(  # here\n    "),
        "docstring": text.replace('"""Run a deck from its files."""', '"""Run a deck."""'),
        "blank lines": text.replace("\n    source = ", "\n\n\n    source = "),
        "words of an error": re.sub(r'"1 or more"', '"at least 1"', text),
    }[what]
    assert edited != text
    before = digests(copy, ("fe",))
    path.write_text(edited, encoding="utf-8")
    after = digests(copy, ("fe",))
    path.write_text(text, encoding="utf-8")
    assert after == before


def test_a_template_counts_for_the_part_that_it_lies_beside(copy: Path) -> None:
    """The friction routine's template belongs to the decks, the page's style to the report."""
    before = digests(copy, ("deck", "report", "compare"))
    path = copy / "deck" / "templates" / "vfric.f"
    text = path.read_text(encoding="utf-8")
    path.write_text(text + "c\n", encoding="utf-8")
    after = digests(copy, ("deck", "report", "compare"))
    path.write_text(text, encoding="utf-8")
    assert after["deck"] != before["deck"]
    assert (after["report"], after["compare"]) == (before["report"], before["compare"])


def test_names_are_traced_through_packages_to_their_modules(copy: Path) -> None:
    """The paper's variant needs the friction laws, not the condensed model that its package offers as well."""
    names = Graph(PACKAGE).closure(VARIANTS["paper"])
    assert "friction.laws" in names
    assert "spring (names)" in names
    assert not any(name.startswith("spring.condensed") for name in names)
    assert "spring.condensed.march" in Graph(PACKAGE).closure(VARIANTS["condensed"])
    assert not any(name.startswith(("spring", "material", "friction")) for name in Graph(PACKAGE).closure(PARTS["fe"]))


def test_a_package_s_other_modules_count_where_a_name_cannot_be_traced(tmp_path: Path) -> None:
    """A name that an __init__ makes up at run time leads to the whole package: never too little."""
    room = tmp_path / "pkg" / "room"
    room.mkdir(parents=True)
    (tmp_path / "pkg" / "__init__.py").write_text("")
    (room / "__init__.py").write_text("def __getattr__(name):\n    return find(name)\n")
    (room / "inner.py").write_text("x = 1\n")
    (tmp_path / "pkg" / "user.py").write_text("from .room import y\n")
    assert "room.inner" in Graph(tmp_path / "pkg").closure(("user",))


def test_a_name_that_is_loaded_later_leads_to_its_module_alone(tmp_path: Path) -> None:
    """The table of names and modules beside ``__getattr__`` is read."""
    room = tmp_path / "pkg" / "room"
    room.mkdir(parents=True)
    (tmp_path / "pkg" / "__init__.py").write_text("")
    (room / "__init__.py").write_text(
        '_LATER = {"y": ".inner"}\n\ndef __getattr__(name):\n    return loaded(__name__, _LATER, name)\n'
    )
    (room / "inner.py").write_text("y = 1\n")
    (room / "other.py").write_text("x = 1\n")
    (tmp_path / "pkg" / "user.py").write_text("from .room import y\n")
    closure = Graph(tmp_path / "pkg").closure(("user",))
    assert "room.inner" in closure
    assert "room.other" not in closure


def test_an_unknown_part_is_refused() -> None:
    """One line with the parts that there are."""
    with pytest.raises(InputError, match="got engine, expected one of study, material"):
        code_digest("engine")


def test_digests_do_not_depend_on_what_is_kept_of_earlier_runs(
    copy: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without a cache, with an empty one, a full one, and one that is no JSON: the same; an edit is seen through it."""

    def now(folder: str) -> dict[str, str]:
        monkeypatch.setenv("TREAD_VALIDATE_CACHE", folder)
        monkeypatch.setattr(syntax, "KEPT", SyntaxCache(Path(syntax.__file__)))
        monkeypatch.setattr(source_code, "KEPT", syntax.KEPT)
        return digests(copy, ("friction", "paper"))

    bare = now("off")
    kept = str(tmp_path)
    assert now(kept) == bare
    (file,) = (tmp_path / "syntax").iterdir()
    assert now(kept) == bare
    path = copy / "friction" / "law.py"
    text = path.read_text(encoding="utf-8")
    path.write_text(text + "\nEDITED = 1\n", encoding="utf-8")
    assert now(kept) == now("off") != bare
    path.write_text(text, encoding="utf-8")
    assert now(kept) == bare
    file.write_text('{"half', encoding="utf-8")
    assert now(kept) == bare
