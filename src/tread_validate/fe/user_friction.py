"""VFRIC: compile the user's routine, and call it from compiled code through its documented arguments.

The routine gets every argument by reference, as Fortran passes it. The engine keeps each argument in an array of its
own and a table of their addresses; `call_vfric` calls the routine's address with that table.
"""

from __future__ import annotations

import ctypes
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]  # numba and llvmlite have no types
from numba import types
from numba.extending import intrinsic
from numpy.typing import NDArray

from ..errors import EngineError, InputError, one_line
from ..files import read_text
from ..kernels import kernel
from .routine_cache import fetch, keep, kept_library

ARGUMENTS = 42
NAME_LENGTH = 80
# Two lines that stand for ABAQUS's own include file in double precision; they lie beside the compile only.
PARAMETERS = "      implicit real*8 (a-h,o-z)\n      parameter (j_sys_Dimension = 2)\n"
COMPILE_SECONDS = 120
OPTIONS = ("-O2", "-shared", "-fPIC", "-x", "f77", "-ffixed-form")


@dataclass
class UserRoutine:
    """A loaded VFRIC.

    Attributes
    ----------
    address : int
    library : object
        Keeps the shared library in memory.
    """

    address: int
    library: Any = field(repr=False)
    source: Path


def compile_vfric(source: Path | str) -> UserRoutine:
    """Compile a fixed-form Fortran source with gfortran and load its VFRIC.

    Raises
    ------
    EngineError
        gfortran is not installed, or the source does not compile.
    InputError
        The source holds no VFRIC.
    """
    path = Path(source)
    text = read_text(path)
    compiler = shutil.which("gfortran")
    if compiler is None:
        raise EngineError(f"{path}: gfortran not found; it compiles the user friction routine (Debian: gfortran)")
    with tempfile.TemporaryDirectory(prefix="vfric-") as name:
        folder = Path(name)
        (folder / "vaba_param.inc").write_text(PARAMETERS, encoding="ascii")
        library = folder / "vfric.so"
        kept = kept_library(text, compiler, [*OPTIONS, PARAMETERS])
        if not fetch(kept, library):  # a copy, as a library loaded twice from one place would share its variables
            command = [compiler, *OPTIONS, f"-I{folder}", "-o", str(library), str(path.resolve())]
            try:
                done = subprocess.run(command, capture_output=True, text=True, timeout=COMPILE_SECONDS, cwd=folder)
            except subprocess.TimeoutExpired:
                raise EngineError(f"{path}: gfortran took more than {COMPILE_SECONDS} s") from None
            if done.returncode != 0:
                raise _compile_error(path, done.stderr)
            keep(kept, library)
        loaded = ctypes.CDLL(str(library))
    try:
        entry = loaded.vfric_
    except AttributeError:
        raise InputError(path, "no subroutine VFRIC", "subroutine vfric(fTangential, statev, ...)") from None
    address = ctypes.cast(entry, ctypes.c_void_p).value
    if address is None:
        raise EngineError(f"{path}: VFRIC has no address")
    return UserRoutine(address, loaded, path)


def _compile_error(path: Path, message: str) -> EngineError:
    line = re.search(r":(\d+):\d+:", message)
    error = re.search(r"Error: (.*)", message)
    where = f"{path}:{line.group(1)}" if line else str(path)
    told = one_line(error.group(1) if error else message, 160)
    return EngineError(f"{where}: got {told}, expected Fortran that gfortran compiles")


@intrinsic
def call_vfric(typingctx, address, table):  # type: ignore[no-untyped-def]  # numba types it
    """Call the routine at `address` (int64) with the pointers listed at `table` (int64)."""

    def generate(context, builder, signature, arguments):  # type: ignore[no-untyped-def]  # numba types it
        pointer = ir.PointerType(ir.IntType(8))
        long = ir.IntType(64)
        kinds = [pointer] * ARGUMENTS + [long] * 3
        function_type = ir.FunctionType(ir.VoidType(), kinds)
        function = builder.inttoptr(arguments[0], function_type.as_pointer())
        rows = builder.inttoptr(arguments[1], long.as_pointer())
        values = []
        for row in range(ARGUMENTS):
            entry = builder.load(builder.gep(rows, [ir.Constant(ir.IntType(32), row)]))
            values.append(builder.inttoptr(entry, pointer))
        values += [ir.Constant(long, NAME_LENGTH)] * 3
        builder.call(function, values)
        return context.get_dummy_value()

    return types.void(types.int64, types.int64), generate


@kernel()
def call_at(address, table):  # type: ignore[no-untyped-def]  # numba types it
    """Call VFRIC once with the arguments whose addresses `table` lists."""
    call_vfric(address, table.ctypes.data)  # type: ignore[call-arg]  # numba and llvmlite have no types


@dataclass
class Arguments:
    """The arguments of VFRIC for one contact pair, each in an array of its own.

    Names are those of the documented interface. Arrays over contact points hold `nContact` points in front.
    """

    slaves: int
    state_variables: int
    properties: NDArray[np.float64]
    labels: NDArray[np.int64]
    names: tuple[str, str, str]
    master_label: int
    temperature: NDArray[np.float64] | None
    table: NDArray[np.int64] = field(init=False)
    integers: NDArray[np.int32] = field(init=False)
    reals: NDArray[np.float64] = field(init=False)
    arrays: dict[str, NDArray[Any]] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        n = self.slaves
        a = self.arrays
        a["fTangential"] = np.zeros((n, 2))
        a["statev"] = np.zeros((n, max(self.state_variables, 1)))
        # kStep, kInc, nContact, nFacNod, nSlvNod, nMstNod, nFricDir, nDir, nStateVar, nProps, nTemp, nPred, numDefTfv,
        # lContType
        has_temperature = int(self.temperature is not None)
        self.integers = np.array(
            [1, 0, 0, 1, n, 1, 2, 3, self.state_variables, self.properties.size, has_temperature, 0, 1, 1],
            dtype=np.int32,
        )
        # timStep, timGlb, dTimCur, frictionWork
        self.reals = np.zeros(4)
        a["jSlvUid"] = self.labels.astype(np.int32)
        a["jMstUid"] = np.array([self.master_label], dtype=np.int32)
        a["jConSlvid"] = np.zeros(n, dtype=np.int32)
        a["jConMstid"] = np.ones(n, dtype=np.int32)
        for position, name in enumerate(self.names):
            a[f"name{position}"] = np.frombuffer(
                name.ljust(NAME_LENGTH)[:NAME_LENGTH].encode("ascii", "replace"), "u1"
            ).copy()
        for name in ("dSlipFric", "fTangPrev", "coordSlv", "dirCosSl", "dircosN"):
            a[name] = np.zeros((n, 3))
        for name in ("fStickForce", "fNormal", "areaSlv", "tempSlv", "preDefSlv"):
            a[name] = np.zeros(n)
        a["shape"] = np.ones(n)
        a["coordMst"] = np.zeros((1, 3))
        a["tempMst"] = np.zeros(1)
        a["preDefMst"] = np.zeros(1)
        a["props"] = self.properties if self.properties.size else np.zeros(1)
        i, r = self.integers, self.reals
        order = [a["fTangential"], a["statev"], *(i[k : k + 1] for k in range(13))]
        order += [a["jSlvUid"], a["jMstUid"], a["jConSlvid"], a["jConMstid"], r[0:1], r[1:2], r[2:3]]
        order += [a["name0"], a["name1"], a["name2"], i[13:14], a["dSlipFric"], a["fStickForce"], a["fTangPrev"]]
        order += [
            a["fNormal"],
            r[3:4],
            a["shape"],
            a["coordSlv"],
            a["coordMst"],
            a["dirCosSl"],
            a["dircosN"],
            a["props"],
        ]
        order += [a["areaSlv"], a["tempSlv"], a["preDefSlv"], a["tempMst"], a["preDefMst"]]
        if len(order) != ARGUMENTS:
            raise AssertionError(len(order))
        self.table = np.array([item.ctypes.data for item in order], dtype=np.int64)
