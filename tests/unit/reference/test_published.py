"""The published numbers and the data package that holds them."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from tread_validate.compare.claims import belt as claims_belt
from tread_validate.compare.claims import rig as claims_rig
from tread_validate.compare.claims.inputs import INPUTS
from tread_validate.compare.claims.study import STUDY
from tread_validate.compare.regression.coefficients import published_coefficients
from tread_validate.errors import InputError
from tread_validate.reference import load_published, validate_package

COMPUTED = {
    *STUDY,
    *claims_rig.RUNS,
    *claims_rig.TABLE_1,
    *claims_rig.REGRESSIONS,
    *claims_belt.RUNS,
    *claims_belt.SPRING,
}


@pytest.fixture
def references(root: Path) -> Path:
    return root / "reference_data"


@pytest.fixture
def package(references: Path, tmp_path: Path) -> Path:
    """A copy of the published part of the package that a test may spoil."""
    shutil.copytree(references / "published", tmp_path / "published")
    descriptor = yaml.safe_load((references / "datapackage.yaml").read_text(encoding="utf-8"))
    descriptor["resources"] = [item for item in descriptor["resources"] if item["name"] == "published"]
    (tmp_path / "datapackage.yaml").write_text(yaml.safe_dump(descriptor, sort_keys=False), encoding="utf-8")
    return tmp_path


def test_the_package_as_it_is_shipped_is_valid(references: Path) -> None:
    """Schema and checksum of every table."""
    assert "published" in validate_package(references)


def test_every_number_says_how_it_is_compared_or_why_it_is_not(references: Path) -> None:
    """More than forty rows; each computed one has a computation, each input one a place in the study, no other has."""
    rows = load_published(references)
    assert len(rows) > 40
    assert all(row.comparison and row.section and row.unit for row in rows)
    by_kind = {kind: {row.id for row in rows if row.comparability == kind} for kind in ("computed", "input", "context")}
    assert by_kind["computed"] == COMPUTED
    assert by_kind["input"] == set(INPUTS)


def test_table_1_is_there_cell_by_cell(references: Path) -> None:
    """Eight cells with their printed spreads, as fractions: the numbers of the paper's Table 1."""
    rows = {
        (row.source, row.shape, row.coefficient): row
        for row in published_coefficients({r.id: r for r in load_published(references)})
    }
    printed = {
        ("rig:published", "rectangle", "a_v"): (0.036, 0.018),
        ("fe:published", "rectangle", "a_v"): (0.034, 0.008),
        ("rig:published", "parallelogram", "a_v"): (0.014, 0.014),
        ("fe:published", "parallelogram", "a_v"): (0.029, 0.009),
        ("rig:published", "rectangle", "a_theta"): (-0.0034, 0.0007),
        ("fe:published", "rectangle", "a_theta"): (-0.0060, 0.0004),
        ("rig:published", "parallelogram", "a_theta"): (-0.0038, 0.0038),
        ("fe:published", "parallelogram", "a_theta"): (-0.0063, 0.0010),
    }
    assert set(rows) == set(printed)
    for key, (value, spread) in printed.items():
        assert rows[key].value == pytest.approx(value, abs=1e-12)
        assert rows[key].spread == pytest.approx(spread, abs=1e-12)


def _edit(old: str, new: str) -> Callable[[Path], None]:
    def edit(package: Path) -> None:
        path = package / "published" / "published.csv"
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    return edit


def _descriptor(change: Callable[[dict[str, object]], object]) -> Callable[[Path], None]:
    def edit(package: Path) -> None:
        path = package / "datapackage.yaml"
        data = yaml.safe_load(path.read_text(encoding="utf-8"))
        change(data["resources"][0])
        path.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")

    return edit


@pytest.mark.parametrize(
    ("spoil", "match"),
    [
        (_edit("8.86", "eight"), r"published\.csv:\d+: value"),
        (_edit("8.86", "8.87"), "hash"),
        (_edit("wlf_c2,", "wlf_c1,"), r"published\.csv:\d+"),
        (_edit(",input,", ",guess,"), "comparability"),
        (lambda package: (package / "published" / "published.csv").unlink(), "no such file"),
        (_descriptor(lambda item: item.update(path="https://example.org/published.csv")), "file below this folder"),
        (_descriptor(lambda item: item.pop("license")), r"resources\[0\]\.license"),
        (_descriptor(lambda item: item.pop("hash")), r"resources\[0\]\.hash"),
        (_descriptor(lambda item: item.update(path="../published.csv")), "published.csv"),
        (lambda package: (package / "datapackage.yaml").write_text("resources: []\n"), "resources"),
        (lambda package: (package / "datapackage.yaml").write_text("a: [\n"), "YAML"),
    ],
)
def test_a_spoilt_package_is_refused_with_its_place(spoil: Callable[[Path], None], match: str, package: Path) -> None:
    """A wrong cell, checksum, key, enumeration or path, a missing file or key: one line that says where."""
    validate_package(package)
    spoil(package)
    with pytest.raises(InputError, match=match):
        validate_package(package)


@pytest.mark.parametrize(
    ("spoil", "match"),
    [
        (_edit("id,quantity", "key,quantity"), "column id"),
        (_edit("8.86", "inf"), "finite number"),
        (_edit("wlf_c2,", "wlf_c1,"), "id of its own"),
        (_edit(",3.7,3.9,", ",3.9,3.7,"), "at most high"),
        (_edit(",input,", ",guess,"), "computed, input or context"),
    ],
)
def test_a_wrong_row_is_refused_by_the_reader_too(spoil: Callable[[Path], None], match: str, package: Path) -> None:
    """The reader does not rely on the package having been validated."""
    spoil(package)
    with pytest.raises(InputError, match=match):
        load_published(package)


def test_the_checksum_is_that_of_the_file(references: Path) -> None:
    """SHA-256 in the descriptor and of the bytes: equal."""
    descriptor = yaml.safe_load((references / "datapackage.yaml").read_text(encoding="utf-8"))
    for resource in descriptor["resources"]:
        data = (references / resource["path"]).read_bytes()
        assert resource["hash"] == f"sha256:{hashlib.sha256(data).hexdigest()}"
