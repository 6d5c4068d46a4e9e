"""Holding an ABAQUS result against its deck."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.inp import DeckFiles
from tread_validate.provenance import sha256_file
from tread_validate.reference import FeStore
from tread_validate.reference.abaqus import Options, file_history, import_history

CASE = "belt-22c-0p2mm-10mps"


def table(path: Path, curve, sign: float = 1.0, notes: str = "", shift: float = 0.0, scale: float = 1.0) -> Path:
    rows = "".join(f"{t + shift:.9g},0,{sign * scale * n:.9g},{-sign * scale * s:.9g},0\n" for t, n, s in curve)
    path.write_text(notes + "time_s,CFN1,CFN2,CFS1,CFS2\n" + rows)
    return path


def test_forces_take_the_signs_of_the_paper(tmp_path, deck, user, curve):
    """N is the y component, T minus the x component of the force on the block; the numbers pass through unchanged."""
    history = import_history(table(tmp_path / "f.csv", curve), deck, user).history
    np.testing.assert_allclose(history.normal_force, [n for _, n, _ in curve], rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(history.tangential_force, [s for _, _, s in curve], rtol=1e-8, atol=1e-9)


def test_forces_on_the_road_give_the_same_history(tmp_path, deck, user, curve):
    block = import_history(table(tmp_path / "a.csv", curve), deck, user).history
    road = import_history(
        table(tmp_path / "b.csv", curve, sign=-1.0), deck, user, options=Options(force_on="road")
    ).history
    np.testing.assert_array_equal(block.normal_force, road.normal_force)
    np.testing.assert_array_equal(block.tangential_force, road.tangential_force)


def test_total_time_is_moved_to_the_start_of_the_pass(tmp_path, deck, user, curve):
    """The lead-in takes 2 ms; a table on the total clock, lead-in rows included, gives the same history."""
    before = [(-0.002 + 1e-4 * i, 0.0, 0.0) for i in range(20)]
    step = import_history(table(tmp_path / "a.csv", curve), deck, user).history
    total = import_history(table(tmp_path / "b.csv", before + curve, shift=0.002), deck, user).history
    np.testing.assert_allclose(total.time, step.time, atol=1e-9)
    np.testing.assert_allclose(total.normal_force, step.normal_force)


def test_units_are_converted(tmp_path, deck, user, curve):
    plain = import_history(table(tmp_path / "a.csv", curve), deck, user).history
    kilo = table(tmp_path / "b.csv", [(1e3 * t, n, s) for t, n, s in curve], scale=1e-3)
    other = import_history(kilo, deck, user, options=Options(force_unit="kN", time_unit="ms")).history
    np.testing.assert_allclose(other.normal_force, plain.normal_force, atol=1e-6)
    np.testing.assert_allclose(other.time, plain.time, atol=1e-12)


def test_two_column_tables_need_both_forces(tmp_path, deck, user, curve):
    normal, shear = tmp_path / "n.txt", tmp_path / "t.txt"
    normal.write_text("".join(f"{t} {n}\n" for t, n, _ in curve))
    shear.write_text("".join(f"{t}\t{s}\n" for t, _, s in curve))
    history = import_history(normal, deck, user, tangential=shear).history
    np.testing.assert_allclose(history.tangential_force, [s for _, _, s in curve])
    with pytest.raises(InputError, match="tangential"):
        import_history(normal, deck, user)


def test_result_of_another_deck_is_refused(tmp_path, deck, user, curve):
    good = table(tmp_path / "f.csv", curve, notes=f"# job: {CASE}\n# deck_sha256: {sha256_file(deck)}\n")
    checks = import_history(good, deck, user).record["checks"]
    assert "deck_sha256: equal" in checks
    other = table(tmp_path / "f.csv", curve, notes=f"# deck_sha256: {'0' * 64}\n")
    with pytest.raises(InputError, match="deck_sha256"):
        import_history(other, deck, user)
    other = table(tmp_path / "f.csv", curve, notes="# job: rig-22c\n")
    with pytest.raises(InputError, match="the case of the deck"):
        import_history(other, deck, user)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"sign": -1.0}, "compression as positive"),
        ({"scale": 1e-3}, "is the unit N?"),
        ({"scale": 1e3}, "is the unit N?"),
        ({"shift": 0.013}, "clock of the pass"),
        ({"scale": 0.0}, "0 throughout"),
    ],
)
def test_implausible_table_is_refused(tmp_path, deck, user, curve, change, says):
    with pytest.raises(InputError) as fault:
        import_history(table(tmp_path / "f.csv", curve, **change), deck, user)
    assert says in str(fault.value)


def test_milliseconds_taken_for_seconds_do_not_fit_the_deck(tmp_path, deck, user, curve):
    with pytest.raises(InputError, match="clock of the pass"):
        import_history(table(tmp_path / "f.csv", [(1e3 * t, n, s) for t, n, s in curve]), deck, user)


def test_run_that_stops_in_contact_is_refused(tmp_path, deck, user, curve):
    cut = [(t * 0.02 / curve[50][0], n, s) for t, n, s in curve[:51]]
    with pytest.raises(InputError, match="last row"):
        import_history(table(tmp_path / "f.csv", cut), deck, user)


def test_reaction_of_the_road_fixes_the_sign(tmp_path, deck, user, curve):
    """CFN on the road and RF at its reference node have opposite signs: said, with the option that puts it right."""
    path = tmp_path / "f.csv"
    head = "time_s,CFN1,CFN2,CFS1,CFS2,RF1@ROAD_REF_N,RF2@ROAD_REF_N\n"
    path.write_text(head + "".join(f"{t},0,{n},{-s},0,{-s},{n}\n" for t, n, s in curve))
    assert any("at most 0 N apart" in check for check in import_history(path, deck, user).record["checks"])
    path.write_text(head + "".join(f"{t},0,{n},{-s},0,{s},{-n}\n" for t, n, s in curve))
    with pytest.raises(InputError, match="--force-on road"):
        import_history(path, deck, user)


def test_filed_reference_is_current_for_its_deck_and_stale_for_another(tmp_path, deck, user, curve):
    imported = import_history(table(tmp_path / "f.csv", curve), deck, user)
    files = DeckFiles(deck, user)
    folder = file_history(imported, tmp_path / "store", files)
    assert folder.parent == tmp_path / "store" / "fe" / "abaqus"
    store = FeStore(tmp_path / "store")
    assert store.find("abaqus", CASE, files).status == "current"
    other = tmp_path / "other.inp"
    other.write_text(deck.read_text() + "*STEP\n")
    assert store.find("abaqus", CASE, DeckFiles(other, user)).status == "stale"
    path = folder / "history.csv"
    path.write_text(path.read_text().replace("1", "2"))
    assert store.find("abaqus", CASE, files).status == "corrupt"


def test_existing_reference_is_replaced_on_request_only(tmp_path, deck, user, curve):
    imported = import_history(table(tmp_path / "f.csv", curve), deck, user)
    files = DeckFiles(deck, user)
    file_history(imported, tmp_path / "store", files)
    with pytest.raises(InputError, match="--replace"):
        file_history(imported, tmp_path / "store", files)
    file_history(imported, tmp_path / "store", files, replace=True)
