"""The same study on other machines: decks, histories, fits and tables do not depend on the processor.

OpenBLAS, NumPy and Numba choose their kernels by the processor they find. Each of them is told here to be another, in
a sub-process with a bare environment.
"""

from __future__ import annotations

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

RIG = "rig-parallelogram-45c-0p2mm-300rpm"
BELT = "belt-midtop-60c-0p2mm-16p7mps-free"
MACHINES = {
    "as it is": {},
    "Haswell": {"OPENBLAS_CORETYPE": "Haswell"},
    "AVX-512": {"OPENBLAS_CORETYPE": "SkylakeX"},
    "Zen": {"OPENBLAS_CORETYPE": "Zen"},
    "Sandy Bridge": {"OPENBLAS_CORETYPE": "Sandybridge"},
    "Prescott, two threads": {"OPENBLAS_CORETYPE": "Prescott", "OPENBLAS_NUM_THREADS": "2"},
    "no AVX": {"OPENBLAS_CORETYPE": "Nehalem", "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR"},
    "generic code": {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""},
}
WORK = """
import sys
from pathlib import Path
from tread_validate.cli.app import run

root, out, rig, belt = Path(sys.argv[1]), Path(sys.argv[2]), *sys.argv[3:]
config, data = root / "config", root / "reference_data"
study, laboratory = str(config / "study.yaml"), str(config / "laboratory.yaml")
sweeps = str(data / "material" / "synthetic_sweeps.csv")
for arguments in (
    ["deck", study, "--case", rig, "-o", str(out / "decks")],
    ["deck", study, "--case", belt, "-o", str(out / "decks")],  # with the search for its creep ratio
    ["deck", laboratory, "--case", "belt-60c-0p2mm-16p7mps-creep0p3", "-o", str(out / "laboratory")],  # from raw files
    ["spring", study, "--case", rig, "-o", str(out / "paper")],
    ["spring", study, "--case", belt, "-o", str(out / "paper")],
    ["spring", study, "--case", rig, "--variant", "shape_factor", "-o", str(out / "shape")],  # elastic solve
    ["compare", str(out / "paper" / f"{rig}.csv"), str(out / "shape" / f"{rig}.csv"), "-o", str(out / "compare.csv")],
    ["fit-prony", sweeps, "--band", "0.25", "2500", "--fit-wlf", "--resamples", "50", "-o", str(out / "material.yaml")],
    ["fit-friction", str(data / "friction" / "synthetic_tribometer.csv"), "-o", str(out / "friction.yaml")],
    ["import-rig", str(data / "rig" / "synthetic_record.csv"), "-o", str(out / "rig")],
    ["regress", str(out / "peaks.csv"), "-o", str(out / "coefficients.csv")],
):
    if run(arguments) != 0:
        sys.exit(f"failed: {arguments}")
"""


def peaks() -> str:
    """A table of peaks with known slopes and a little scatter."""
    rows = ["shape,temperature_degC,interference_mm,speed_m_s,peak_normal_force_N"]
    for number, (shape, theta, speed) in enumerate(
        (shape, theta, speed) for shape in ("rectangle", "parallelogram") for theta in (22, 45) for speed in (2, 3, 5)
    ):
        force = 90.0 * (1 + 0.01 * speed) * (1 - 0.002 * (theta - 22)) + 0.1 * np.sin(7.0 * number)
        rows.append(f"{shape},{theta},0.2,{speed},{force:.6f}")
    return "\n".join(rows) + "\n"


def work_on(machine: dict[str, str], folder: Path, root: Path) -> dict[str, bytes]:
    """Run the small study as on another machine; return every file it wrote, by name."""
    folder.mkdir()
    (folder / "peaks.csv").write_text(peaks(), encoding="utf-8")
    bare = {"PATH": os.environ["PATH"], "HOME": os.environ.get("HOME", "/"), **machine}
    done = subprocess.run(
        [sys.executable, "-c", WORK, str(root), str(folder), RIG, BELT],
        env=bare, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    found = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory, root: Path) -> dict[str, dict[str, bytes]]:
    folder = tmp_path_factory.mktemp("machines")
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        jobs = {
            name: pool.submit(work_on, machine, folder / str(number), root)
            for number, (name, machine) in enumerate(MACHINES.items())
        }
        return {name: job.result() for name, job in jobs.items()}


def test_every_machine_writes_the_same_bytes(files: dict[str, dict[str, bytes]]) -> None:
    """Decks, friction routine, spring histories, material, friction and rig files, scores and regressions."""
    here = files["as it is"]
    assert {f"decks/{case}/{case}.inp" for case in (RIG, BELT)} <= set(here)
    assert {
        f"paper/{BELT}.csv",
        f"shape/{RIG}.csv",
        "material.yaml",
        "friction.yaml",
        "coefficients.csv",
    } <= set(here)
    for machine, found in files.items():
        assert set(found) == set(here)
        differing = [name for name in here if found[name] != here[name]]
        assert not differing, f"{machine}: {differing}"
