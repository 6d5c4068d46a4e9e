"""Compiled friction routines are kept, and never the wrong one."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tread_validate.fe.routine_cache import fetch, keep, kept_library

SOURCE = "      subroutine vfric()\n      include 'vaba_param.inc'\n      end\n"


@pytest.fixture
def compiler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.setenv("TREAD_VALIDATE_CACHE", str(tmp_path / "cache"))
    return str(shutil.copy(shutil.which("true") or "", tmp_path / "compiler"))


def test_a_library_comes_back_for_the_same_source_compiler_and_options(compiler: str, tmp_path: Path) -> None:
    (tmp_path / "made.so").write_bytes(b"machine code")
    kept = kept_library(SOURCE, compiler, ["-O2"])
    assert not fetch(kept, tmp_path / "back.so")
    keep(kept, tmp_path / "made.so")
    assert fetch(kept_library(SOURCE, compiler, ["-O2"]), tmp_path / "back.so")
    assert (tmp_path / "back.so").read_bytes() == b"machine code"


def test_another_source_compiler_or_option_is_another_library(compiler: str, tmp_path: Path) -> None:
    names = {kept_library(SOURCE, compiler, ["-O2"]), kept_library(SOURCE + "c\n", compiler, ["-O2"])}
    names.add(kept_library(SOURCE, compiler, ["-O1"]))
    (tmp_path / "compiler").write_bytes(b"the next version")
    names.add(kept_library(SOURCE, compiler, ["-O2"]))
    assert len(names) == 4


@pytest.mark.parametrize("line", ["      include 'law.inc'\n", '#include "law.h"\n', '      INCLUDE "LAW.INC"\n'])
def test_a_source_with_files_of_its_own_is_compiled_each_time(line: str, compiler: str) -> None:
    assert kept_library(SOURCE + line, compiler, ["-O2"]) is None


def test_nothing_is_kept_where_the_cache_is_off(compiler: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TREAD_VALIDATE_CACHE", "off")
    kept = kept_library(SOURCE, compiler, ["-O2"])
    assert kept is None
    keep(kept, tmp_path / "compiler")
    assert not fetch(kept, tmp_path / "back.so")
