"""A second deck in the manner of ABAQUS/CAE, of two instances of one part: each fault is one error, at its line."""

from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.deck.lint import lint
from tread_validate.fe import run_deck

DECK = Path(__file__).parent / "cae_drum.inp"
SECTION = '*Solid Section, elset=_PickedSet2, controls=EC-1, material="Tread compound"\n,\n'
TURNED = "5.5,           0.,           0.,          5.5,           1.,           0.,         180.\n"

# text to find (first match), its replacement, the one error, and what the line that it must name holds
ALONE: list[tuple[str, str, str, str]] = [
    ('material="Tread compound"', 'material="Tread compund"', "TV104", "Tread compund"),
    ("name=Pad-1-rad-2, part=Pad", "name=Pad-1-rad-2, part=Pod", "TV110", "part=Pod"),
    ("nset=Floor, instance=Pad-1-rad-2", "nset=Floor, instance=Pad-1-rad-3", "TV111", "instance=Pad-1-rad-3"),
    ("Floor, ENCASTRE", "Flor, ENCASTRE", "TV101", "Flor, ENC"),
    ("*Density\n 1.1e-09,\n", "", "TV303", "*Material, name"),
    ("*Elastic, moduli=INSTANTANEOUS\n 8., 0.47\n", "", "TV304", "*Material, name"),
    (SECTION, "", "TV301", " 1,  1,  2,  5,  4"),
    ("     14,            5.,            3.,            5.\n", "", "TV207", " 1,  1,  2,  5,  4"),
    (" 1,  1,  2,  5,  4, 10, 11, 14, 13", " 1, 10, 11, 14, 13,  1,  2,  5,  4", "TV209", " 1, 10, 11"),
    ("*Element, type", "     27,            9.,  6.,  9.\n*Element, type", "TV202", "     27,            9."),
    (" 8., 0.47", " 8., 0.6", "TV305", " 8., 0.6"),
    (" 8., 0.47", " 0., 0.47", "TV305", " 0., 0.47"),
    (" 1.1e-09,", " -1.1e-09,", "TV305", " -1.1e-09"),
    (",\n*End Part\n", ",\n", "TV015", "*Part, name=Pad"),
    ("*Part, name=Drum\n*End Part\n", "*Part, name=Drum\n", "TV015", "*Part, name=Drum"),
    (TURNED + "*End Instance\n", TURNED, "TV015", "*Instance, name=Pad-1-rad-2"),
    ("analytical surface=Shell\n*End Instance\n", "analytical surface=Shell\n", "TV015", "*Instance, name=Drum-1"),
    ("*End Assembly\n", "", "TV015", "*Assembly"),
    ("*Assembly, name=Assembly\n", "", "TV015", "*Instance, name=Drum-1"),
    (TURNED, TURNED.replace("1.,  ", "0.,  "), "TV015", "5.5,           0.,           0.,          5.5"),
    ("Top-2, Drum-1.Shell", "Top-3, Drum-1.Shell", "TV103", "Top-3, Drum"),
    ("Top-1, Drum-1.Shell", "Top-1, Shell", "TV103", "Top-1, Shell"),
    ("analytical surface=Shell", "analytical surface=Shel", "TV103", "*Rigid Body"),
    ("ref node=Drum-1-RefPt_,", "ref node=Drum-1-RefPnt_,", "TV101", "RefPnt_"),
    ("_Top-1_S5, S5", "_Top-1_S6, S5", "TV102", "_Top-1_S6, S5"),
    ("_Top-1_S5, S5", "_Top-1_S5, S8", "TV504", "S8"),
    ("elset=_PickedSet2, controls", "elset=_PickedSet3, controls", "TV102", "_PickedSet3"),
    ("instance=Pad-1\n 3, 4, 7, 8", "instance=Pad-1\n 3, 4, 7, 9", "TV208", " 3, 4, 7, 9"),
    (" 2,  2,  3,  6,", " 1,  2,  3,  6,", "TV204", " 1,  2,  3,  6"),
    ("4, 10, 11, 14, 13\n", "4, 10, 11, 14\n", "TV206", "4, 10, 11, 14"),
    ("type=C3D8R", "type=C3D8RR", "TV205", "C3D8RR"),
    ("name=EC-1, hourglass", "name=EC-2, hourglass", "TV105", "*Solid Section"),
    ("*Boundary, amplitude=Amp-1", "*Boundary, amplitude=Amp-2", "TV107", "amplitude=Amp-2"),
    ("0.,           0.002,  ", "0.,          -0.002,  ", "TV405", "-0.002,"),
    ("interaction=IntProp-1, mech", "interaction=IntProp1, mech", "TV108", "IntProp1"),
    ("*Contact Output, cpset=Int-2", "*Contact Output, cpset=Int-3", "TV109", "cpset=Int-3"),
    ("*Node Output, nset=Set-1", "*Node Output, nset=Set-9", "TV101", "Set-9"),
    ("Set-1, 6, 6", "Set-1, 6, 8", "TV401", "Set-1, 6, 8"),
    ("0.2, 0.2, 0.001", "1.2, 0.2, 0.001", "TV306", "1.2, 0.2"),
    (" 0.4,", " -0.4,", "TV510", " -0.4,"),
    ("-10.,     1.27016654", "-10.,     1.57016654", "TV501", "1.57016654"),
    ("Top-2, Drum-1.Shell", "Drum-1.Shell, Top-2", "TV505", "Drum-1.Shell, Top-2"),
    ("*Bulk Viscosity", "*Bulk Viscocity", "TV002", "Viscocity"),
    ("*Step, name", "*Stp, name", "TV002", "*Stp"),
    ("*Elastic, moduli", "*Elastc, moduli", "TV002", "*Elastc"),
    ("pressure-overclosure", "presure-overclosure", "TV004", "presure"),
    (", 0.002\n*Bulk", ", 0.\n*Bulk", "TV604", "@, 0.@"),
    ("*Dynamic, Explicit\n, 0.002\n", "", "TV603", "*Step, name"),
    ("*End Step\n", "", "TV601", "*Step, name"),
    ("*End Step\n", "*End Step\n*Material, name=Late\n", "TV014", "name=Late"),
]  # fmt: skip


def test_two_pads_of_one_part_carry_a_drum_evenly() -> None:
    """One pad is the other turned by half a turn: no net force along x or z remains."""
    assert [str(one) for one in lint(DECK)] == []
    result = run_deck(DECK)
    assert result.record["elements"] == 16
    peak = result.history.normal_force.max()
    assert 40.0 < peak < 75.0
    assert abs(result.history.tangential_force).max() < 1e-6 * peak


@pytest.mark.parametrize(("old", "new", "code", "holds"), ALONE, ids=[f"{row[2]} {row[3].strip()}" for row in ALONE])
def test_a_fault_is_one_error_at_its_line_and_nothing_follows(
    old: str, new: str, code: str, holds: str, tmp_path: Path
) -> None:
    text = DECK.read_text(encoding="utf-8")
    assert old in text
    broken = text.replace(old, new, 1)
    path = tmp_path / "drum.inp"
    path.write_text(broken, encoding="utf-8")
    line = next(number for number, one in enumerate(broken.splitlines(), 1) if holds in f"@{one}@")
    found = [(one.code, one.line) for one in lint(path) if one.severity == "error"]
    assert found == [(code, line)]
