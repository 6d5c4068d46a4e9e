"""Time and size of the report of a whole study, from tables and histories that exist.

    python benchmarks/report_time.py [STUDY]

Runs the pipeline's own inputs (results/liu2010, reference_data, fe_inputs/liu2010); target: 20 s, 15 MB.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

TARGET_SECONDS, TARGET_BYTES = 20.0, 15_000_000


def main() -> int:
    tables = Path("results/liu2010/tables")
    if not (tables / "errors.csv").is_file():
        print("report: no tables in results/liu2010/tables; run `make report` first")
        return 0
    start, cpu = time.perf_counter(), time.process_time()
    from tread_validate.report import build_report

    study = sys.argv[1] if len(sys.argv) > 1 else "config/study.yaml"
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        build_report(study, tables, "results/liu2010/spring", "reference_data", "fe_inputs/liu2010", out)
        wall, used = time.perf_counter() - start, time.process_time() - cpu
        page, pdf = (out / "index.html").stat().st_size, (out / "report.pdf").stat().st_size
    print(f"report: {wall:.1f} s ({used:.1f} s of processor) with imports; target {TARGET_SECONDS:g} s")
    print(f"report: page {page / 1e6:.2f} MB, target {TARGET_BYTES / 1e6:g} MB; PDF {pdf / 1e6:.2f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
