"""Files are whole or absent."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from tread_validate.errors import InputError
from tread_validate.files import atomic_path, read_text, write_text


def test_failed_write_leaves_the_old_file_and_no_debris(tmp_path):
    target = tmp_path / "table.csv"
    write_text(target, "old\n")

    def write_half():
        with atomic_path(target) as temporary:
            temporary.write_text("half")
            raise RuntimeError("halfway")

    with pytest.raises(RuntimeError, match="halfway"):
        write_half()
    assert target.read_text() == "old\n"
    assert [path.name for path in tmp_path.iterdir()] == ["table.csv"]


@pytest.mark.parametrize("data", [b"", b"  \n", b"\xff\xfe\x00a", b"a\x00b"])
def test_text_that_is_none_is_refused(tmp_path, data):
    path = tmp_path / "text"
    path.write_bytes(data)
    with pytest.raises(InputError, match="expected"):
        read_text(path)


def test_byte_order_mark_is_not_part_of_the_text(tmp_path):
    path = tmp_path / "text"
    path.write_bytes(b"\xef\xbb\xbfhello")
    assert read_text(path) == "hello"


def test_full_disk_is_said_with_the_file(tmp_path, monkeypatch):
    """The error of a write has no file name of its own; the one that was to be written is put in."""

    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(OSError, match="No space left") as fault:
        write_text(tmp_path / "table.csv", "1\n")
    assert fault.value.filename == str(tmp_path / "table.csv")
    assert list(tmp_path.iterdir()) == []
