"""A deck of parts and instances as ABAQUS/CAE writes them: clean, run by the engine, and broken in one place each."""

from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.deck.lint import lint
from tread_validate.fe import run_deck

DECK = Path(__file__).parent / "cae_pad.inp"

# text to find (first match), its replacement, the finding, and what the line that it must name holds in the broken deck
BROKEN: list[tuple[str, str, str, str]] = [
    ("material=Rubber", "material=Ruber", "TV104", "material=Ruber"),
    ("part=Pad", "part=Pda", "TV110", "part=Pda"),
    ("nset=Mount, instance=Pad-1", "nset=Mount, instance=Pad-2", "TV111", "instance=Pad-2"),
    ("Mount, 2, 2", "Mont, 2, 2", "TV101", "Mont, 2, 2"),
    ("*Density\n 1.1e-09,\n", "", "TV303", "*Material"),
    ("*Solid Section, elset=All_elements, controls=EC-1, material=Rubber\n,\n", "", "TV301", "1,  1,  2,  5"),
    ("     11,           2.,           2.,           3.\n", "", "TV207", "1,  1,  2,  5"),
    ("1,  1,  2,  5,  4,  7,  8, 11, 10", "1,  7,  8, 11, 10,  1,  2,  5,  4", "TV209", "1,  7,  8"),
    ("      9,           4.", "      8,           4.", "TV202", "      8,           4."),
    (" 9., 0.46", " 9., 0.6", "TV305", " 9., 0.6"),
    ("material=Rubber\n,\n*End Part\n", "material=Rubber\n,\n", "TV015", "*Part, name=Pad"),
    ("Pad-1.Contact", "Pad-1.Contct", "TV103", "Pad-1.Contct"),
    ("Plate-1.Top\n", "Plate-2.Top\n", "TV103", "Plate-2.Top"),
    ("interaction=IntProp-1, mech", "interaction=IntProp-2, mech", "TV108", "IntProp-2"),
    ("elset=All_elements, controls", "elset=All_element, controls", "TV102", "elset=All_element, controls"),
    ("amplitude=Ramp", "amplitude=Rump", "TV107", "amplitude=Rump"),
    ("controls=EC-1", "controls=EC-2", "TV105", "controls=EC-2"),
    ("cpset=Int-1\nCFN1", "cpset=Int-2\nCFN1", "TV109", "cpset=Int-2"),
    ("name=Top\n", "name=Tops\n", "TV103", "*Rigid Body"),
    ("surface=Top\n*End Instance\n", "surface=Top\n", "TV015", "*Instance, name=Plate-1"),
    ("*End Assembly\n", "", "TV015", "*Assembly"),
    ("*End Step\n", "", "TV601", "*Step, name"),
    ("*Surface Interaction", "*Surface Interacton", "TV002", "Interacton"),
    ("type=C3D8R", "type=C3D8X", "TV205", "C3D8X"),
    ("_Contact_S3, S3", "_Contact_S3, S7", "TV504", "S7"),
    ("ref node=Plate-1-RefPt_", "ref node=Plate-1-Ref_", "TV101", "*Rigid Body"),
    ("  1,  12,   1", "  1,  12,   2", "TV113", "  1,  12,   2"),
    (" 1.1e-09,", " -1.1e-09,", "TV305", " -1.1e-09,"),
    ("Mount, 2, 2, -0.12", "Mount, 2, 1, -0.12", "TV401", "Mount, 2, 1"),
    (", 0.001\n*Bulk", ", -0.001\n*Bulk", "TV604", ", -0.001"),
    ("2,  2,  3,  6", "1,  2,  3,  6", "TV204", "1,  2,  3,  6"),
    ("2,  2,  3,  6,  5", "2,  2,  3, 66,  5", "TV207", "2,  2,  3, 66"),
    (" 0.6,", " -0.6,", "TV510", " -0.6,"),
    ("        -2.,         0.02", "        -2.,         x", "TV015", "-2.,         x"),
]  # fmt: skip


def test_the_deck_is_clean_and_the_engine_presses_the_pad() -> None:
    """0.12 mm less 0.02 mm of gap on 3 mm of height: some 12 N on 12 mm2, upward."""
    assert [str(one) for one in lint(DECK)] == []
    result = run_deck(DECK)
    assert result.record["elements"] == 2
    assert 5.0 < result.history.normal_force.max() < 25.0


@pytest.mark.parametrize(("old", "new", "code", "holds"), BROKEN, ids=[f"{row[2]} {row[3].strip()}" for row in BROKEN])
def test_a_fault_is_caught_at_its_line(old: str, new: str, code: str, holds: str, tmp_path: Path) -> None:
    text = DECK.read_text(encoding="utf-8")
    assert old in text
    broken = text.replace(old, new, 1)
    path = tmp_path / "pad.inp"
    path.write_text(broken, encoding="utf-8")
    line = next(number for number, one in enumerate(broken.splitlines(), 1) if holds in one)
    found = [one for one in lint(path) if one.severity == "error"]
    assert (code, line) in {(one.code, one.line) for one in found}, [str(one) for one in found]


ENDS = [
    ("controls=EC-1, material=Rubber\n,\n*End Part\n", "*Part, name=Pad"),
    ("part=Pad\n        -2.,         0.02,           0.\n*End Instance\n", "*Instance, name=Pad-1"),
    ("surface=Top\n*End Instance\n", "*Instance, name=Plate-1"),
    ("*End Assembly\n", "*Assembly"),
]


@pytest.mark.parametrize(("place", "opened"), ENDS, ids=[row[1] for row in ENDS])
def test_a_missing_end_is_one_error_and_the_rest_is_read_for_what_it_is(
    place: str, opened: str, tmp_path: Path
) -> None:
    """The end is put before what cannot stand inside: no other error follows, and faults further on are found."""
    text = DECK.read_text(encoding="utf-8")
    assert place in text
    broken = text.replace(place, place[: place.rindex("*End")], 1)
    path = tmp_path / "pad.inp"
    path.write_text(broken, encoding="utf-8")
    line = next(number for number, one in enumerate(broken.splitlines(), 1) if one.startswith(opened))
    assert [(one.code, one.line) for one in lint(path) if one.severity == "error"] == [("TV015", line)]
    twice = broken.replace(" 9., 0.46", " 9., 0.6").replace("*Bulk Viscosity", "*Bulk Viscosty")
    path.write_text(twice, encoding="utf-8")
    found = {one.code for one in lint(path) if one.severity == "error"}
    assert {"TV015", "TV305", "TV002"} <= found
    if "Plate-1" not in opened:  # lines between it and the assembly's own sets may be the instance's or not
        path.write_text(broken.replace("amplitude=Ramp", "amplitude=Rump"), encoding="utf-8")
        assert "TV107" in {one.code for one in lint(path)}
