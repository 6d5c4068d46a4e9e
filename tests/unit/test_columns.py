"""Laboratory tables: what is read, and what is refused with file, row and reason."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tread_validate.columns import read_columns
from tread_validate.errors import InputError


def table(folder: Path, text: str | bytes) -> Path:
    path = folder / "table.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    return path


def test_comments_and_order_of_columns_do_not_matter(tmp_path: Path) -> None:
    read = read_columns(table(tmp_path, "# operator: me\n\nb,extra,a\n2,x,1\n4,y,3\n"), ("a", "b"))
    np.testing.assert_array_equal(read["a"], [1.0, 3.0])
    assert read.comments == {"operator": "me"}
    assert read.where(1).endswith("table.csv:5")


@pytest.mark.parametrize("separator", [";", "\t"])
def test_decimal_commas_are_read_where_every_number_has_them(tmp_path: Path, separator: str) -> None:
    text = separator.join("ab") + "\n" + separator.join(("1,5", "2,25e3")) + "\n"
    read = read_columns(table(tmp_path, text), ("a", "b"))
    assert (read["a"][0], read["b"][0]) == (1.5, 2250.0)


def test_mark_at_the_start_of_the_file_is_taken_off(tmp_path: Path) -> None:
    assert read_columns(table(tmp_path, "\ufeffa,b\n1,2\n"), ("a", "b"))["a"][0] == 1.0


@pytest.mark.parametrize(
    ("text", "where", "reason"),
    [
        ("a,c\n1,2\n", ":1", "column b"),
        ("a;b\n1,5;2,5\n1.5;2\n", ":3: a", "decimal point"),
        ("a;b\n1.5;2.5\n1,5;2\n", ":3: a", "decimal comma"),
        ("a,b\n1,5,2,5\n", ":2", "decimal commas in a comma-separated file?"),
        ("a,b\n1,2\n\ufeffa,b\n", ":3", "byte-order mark inside"),
        ("a,b\n1,2\n3\n", ":3", "2, as in the header"),
        ("a,b\n1,two\n", ":2: b", "'two'"),
        ("a,b\n1,1e999\n", ":2: b", "a finite number"),
        ("a,b\n1,inf\n", ":2: b", "'inf'"),
        ("a,b\n1,\n", ":2: b", "an empty cell"),
        ("a,b,a\n1,2,3\n", ":1", "column a twice"),
        ("a,b\n", "table.csv", "a header without rows"),
        ("# only\n# comments\n", "table.csv", "no header"),
        (b"a,b\n1,\xff\n", "table.csv", "binary data"),
        ("a,b\n1,2\n".encode("utf-16"), ":1", "UTF-16 byte-order mark"),
        (b"", "table.csv", "an empty file"),
    ],
)
def test_a_wrong_table_is_refused_with_its_line_and_reason(
    tmp_path: Path, text: str | bytes, where: str, reason: str
) -> None:
    with pytest.raises(InputError) as refused:
        read_columns(table(tmp_path, text), ("a", "b"))
    assert where in refused.value.where
    assert reason in str(refused.value)
    assert "\n" not in str(refused.value)


def test_gaps_are_read_only_where_they_are_allowed(tmp_path: Path) -> None:
    path = table(tmp_path, "a,b\n1,\n2,3\n")
    assert np.isnan(read_columns(path, ("a", "b"), gaps=True)["b"][0])
    with pytest.raises(InputError, match="an empty cell"):
        read_columns(path, ("a", "b"))


@given(text=st.text(max_size=200) | st.text(alphabet='ab,;\t\n01.-e#"\ufeff ', max_size=80))
@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_text_is_read_or_refused_in_one_line(tmp_path: Path, text: str) -> None:
    """No file content may end in anything but numbers or an `InputError`."""
    path = tmp_path / "any.csv"
    path.write_text(text, encoding="utf-8", newline="")
    fault: InputError | None = None
    try:
        read = read_columns(path, ("a", "b"))
    except InputError as refused:
        fault = refused
    if fault is not None:
        assert "\n" not in str(fault)
    else:
        assert np.all(np.isfinite(read["a"]))
        assert read["a"].shape == read["b"].shape
