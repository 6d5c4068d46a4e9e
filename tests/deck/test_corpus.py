"""Small decks that cover a construct each, whole or broken in one place: what the lint must say of them, and no more.

Every deck states it in its first lines: ``** expect: CODE:LINE ...`` or ``nothing``, with ``** dialect:`` for CalculiX.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tread_validate.cli import app
from tread_validate.deck.lint import catalogue, formatted, lint
from tread_validate.errors import InputError
from tread_validate.fe import run_deck
from tread_validate.inp import read_deck

CORPUS = Path(__file__).parent / "corpus"
DECKS = sorted(CORPUS.glob("*.inp"))
CAE = CORPUS / "09-assembly.inp"


def stated(deck: Path) -> tuple[str, set[tuple[str, int]]]:
    text = deck.read_bytes().decode("latin-1")
    dialect = re.search(r"^\*\* dialect: (\w+)", text, re.MULTILINE)
    expected = re.search(r"^\*\* expect: (.*?)\r?$", text, re.MULTILINE)
    assert expected is not None
    pairs = (
        set() if expected[1] == "nothing" else {(w.split(":")[0], int(w.split(":")[1])) for w in expected[1].split()}
    )
    return dialect[1] if dialect else "abaqus", pairs


def test_corpus_is_whole() -> None:
    """Forty decks and more, half of them broken, no code twice in the catalogue."""
    assert len(DECKS) >= 40
    assert sum(bool(stated(deck)[1]) for deck in DECKS) >= 20
    assert len({rule.code for rule in catalogue().values()}) == len(catalogue())


@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: deck.stem)
def test_lint_says_what_the_deck_states_and_no_other_error(deck: Path) -> None:
    """Each fault at its line. What follows from it may be said too (a part lost with its END PART), but never in a
    deck that is whole, nor at severity error where only a note or a warning is expected.
    """
    dialect, expected = stated(deck)
    findings = lint(deck, dialect)  # type: ignore[arg-type]
    found = {(one.code, one.line) for one in findings}
    assert expected <= found, [str(one) for one in findings]
    by_code = {rule.code: rule.severity for rule in catalogue().values()}
    if not any(by_code[code] == "error" for code, _ in expected):
        assert [str(one) for one in findings if one.severity == "error"] == []
    if not expected:
        assert [str(one) for one in findings] == []


def test_what_calculix_passes_over_is_no_error_in_its_dialect_and_one_in_the_other() -> None:
    deck = CORPUS / "29-calculix-words.inp"
    assert {one.severity for one in lint(deck, "calculix")} == {"warning"}
    assert {"TV001", "TV207", "TV014"} <= {one.code for one in lint(deck) if one.severity == "error"}


def test_the_axis_of_a_revolved_tool_goes_where_its_instance_goes() -> None:
    """Turned by 90 deg about x through its tip: the part's y axis becomes z."""
    (surface,) = (one for one in read_deck(CORPUS / "26-revolved-tool.inp").named("SURFACE") if one.data[0].fields[5:])
    axis = [float(text) for text in surface.data[0].fields]
    assert axis == pytest.approx([0.5, 0.5, 1.1, 0.5, 0.5, 2.1], abs=1e-12)


def test_a_deck_of_parts_runs_in_the_engine(tmp_path: Path) -> None:
    """The block of the assembly is pressed by 0.05 mm less 0.01 mm: contact pushes it up, and nothing slides."""
    result = run_deck(CAE)
    assert result.record["elements"] == 1
    peak = result.contact["cfn_z_N"].abs().max()
    assert 0.05 < peak < 1.0


def test_quoted_names_and_the_plain_ones_are_one_model() -> None:
    plain, quoted = (read_deck(CORPUS / name) for name in ("09-assembly.inp", "10-quoted-names.inp"))
    assert [len(block.data) for block in plain.blocks] == [len(block.data) for block in quoted.blocks]
    assert list(next(quoted.named("NODE")).data.texts) == list(next(plain.named("NODE")).data.texts)


@pytest.mark.parametrize("form", ["json", "sarif", "github"])
def test_findings_come_in_forms_for_programs(form: str, capsys: pytest.CaptureFixture[str]) -> None:
    """File, line, code, severity and message in each; exit code 1 for an error."""
    deck = CORPUS / "61-poissons-ratio.inp"
    assert app.run(["lint", str(deck), "--format", form]) == 1
    text = capsys.readouterr().out
    line = next(iter(stated(deck)[1]))[1]
    if form == "json":
        (entry,) = json.loads(text)
        assert (entry["code"], entry["line"], entry["severity"]) == ("TV305", line, "error")
        assert entry["file"] == str(deck)
    elif form == "sarif":
        log = json.loads(text)
        assert log["version"] == "2.1.0"
        (run,) = log["runs"]
        (result,) = run["results"]
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"] == "TV305"
        assert result["locations"][0]["physicalLocation"]["region"]["startLine"] == line
    else:
        assert text.startswith(f"::error file={deck},line={line},title=TV305")
        assert text.count("\n") == 1


def test_notes_and_warnings_alone_end_with_code_0(capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["lint", str(CORPUS / "73-unknown-keyword.inp"), str(CORPUS / "51-missing-include.inp")]) == 0
    text = capsys.readouterr().out
    assert ": note: " in text
    assert ": warning: " in text


def test_rules_are_chosen_by_code_beginning_of_a_code_or_name() -> None:
    deck = CORPUS / "60-duplicate-node.inp"
    assert [one.code for one in lint(deck, select=["TV2"])] == ["TV202"]
    assert lint(deck, select=["no-density"]) == []
    assert lint(deck, ignore=["duplicate-node"]) == []
    with pytest.raises(InputError, match="TV999"):
        lint(deck, select=["TV999"])


@pytest.mark.parametrize("word", ["TV012", "tv012", "missing-include"])
def test_explain_tells_what_a_code_means(word: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["lint", "--explain", word]) == 0
    text = capsys.readouterr().out
    assert text.startswith("TV012 missing-include (warning): ")
    assert "ABAQUS stops without the file" in text


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--explain", "TV999"], "TV012"),
        ([str(CAE), "--format", "xml"], "sarif"),
        ([str(CAE), "--dialect", "nastran"], "calculix"),
        ([], "no deck"),
    ],
)
def test_wrong_choices_end_with_code_2_in_one_line(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert app.run(["lint", *arguments]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1


def test_a_sarif_log_has_what_the_standard_requires() -> None:
    """SARIF 2.1.0: version, runs, tool.driver.name, a message and a level of its list, a rule that ruleIndex points to,
    lines from 1, a URI reference for the file, whatever its name holds.
    """
    found = [one for deck in DECKS for one in lint(deck, stated(deck)[0])]  # type: ignore[arg-type]
    odd = type(found[0])("a b/c:d%[1].inp", 1, found[0].rule, "x", "note")
    log = json.loads(formatted([*found, odd], "sarif"))
    assert log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-2.1.0.json")
    (run,) = log["runs"]
    driver = run["tool"]["driver"]
    assert driver["name"]
    assert len({rule["id"] for rule in driver["rules"]}) == len(driver["rules"]) >= 20
    for result in run["results"]:
        assert result["message"]["text"]
        assert result["level"] in ("none", "note", "warning", "error")
        assert driver["rules"][result["ruleIndex"]]["id"] == result["ruleId"]
        (location,) = result["locations"]
        place = location["physicalLocation"]
        assert place["region"]["startLine"] >= 1
        assert re.fullmatch(r"(?:[A-Za-z0-9._~/-]|%[0-9A-F]{2})+", place["artifactLocation"]["uri"])
    assert (
        run["results"][-1]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "a%20b/c%3Ad%25%5B1%5D.inp"
    )


@pytest.mark.parametrize("code", [rule.code for rule in catalogue().values()])
def test_every_code_has_a_help_page(code: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert app.run(["lint", "--explain", code]) == 0
    head, blank, *help_text = capsys.readouterr().out.splitlines()
    assert head.startswith(f"{code} ")
    assert blank == ""
    assert len(" ".join(help_text)) > 20


def test_an_annotation_cannot_end_early() -> None:
    """Per cent signs, colons and commas of a file name are escaped as GitHub reads them."""
    (finding,) = lint(CORPUS / "61-poissons-ratio.inp")
    changed = type(finding)("a,b:c%.inp", 3, finding.rule, "50 %\nmore", "error")
    assert (
        formatted([changed], "github")
        == "::error file=a%2Cb%3Ac%25.inp,line=3,title=TV305 material-value::50 %25%0Amore"
    )


@pytest.mark.parametrize("target", ["../mesh.inp", "/data/mesh.inp", "C:\\work\\mesh.inp"])
def test_an_include_elsewhere_is_not_read_and_holds_nothing_against_the_deck(target: str, tmp_path: Path) -> None:
    """A warning at its line; names that it may define are not doubted."""
    (tmp_path / "mesh.inp").write_text("*NODE\n1, 0.\n")
    (tmp_path / "a").mkdir()
    rest = "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n,\n*STEP\n*STATIC\n*BOUNDARY\nTOP, 1, 3\n*END STEP\n"
    (tmp_path / "a" / "a.inp").write_text(f"*INCLUDE, INPUT={target}\n{rest}")
    assert [(one.code, one.line, one.severity) for one in lint(tmp_path / "a" / "a.inp")] == [("TV012", 1, "warning")]
