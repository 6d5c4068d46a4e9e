"""Prony fits of this package against those of PyPI's pyvisco: weighted error and time, same data, same terms.

Run with an interpreter that has both (benchmarks/requirements-pyvisco.txt): ``python benchmarks/material_pyvisco.py``.
Error is the root mean square of the relative errors of E' and E'' together, as both series give them at the data.
pyvisco is run in its two windows of relaxation times, with and without its optimisation; its best counts.
"""

from __future__ import annotations

import contextlib
import io
import time
import warnings
from pathlib import Path

import numpy as np
import pandas as pd

from tread_validate.material import PronySeries, RouteSettings, fit_prony, fractional_zener, read_route
from tread_validate.material.collocation import relaxation_times
from tread_validate.material.reduce import refine_times
from tread_validate.study import Wlf

ROOT = Path(__file__).resolve().parents[1]
TERMS = (3, 6, 12, 18, 24)
Data = tuple[np.ndarray, np.ndarray, np.ndarray]


def data_sets() -> dict[str, Data]:
    w = np.geomspace(0.25, 2500, 81)
    random = np.random.default_rng(5)
    sets: dict[str, Data] = {}
    law = fractional_zener(w, 10.2e6, 77e6, 1e5, 0.25)
    sets["surrogate, exact"] = w, law.real, law.imag
    sets["surrogate, 2 % noise"] = (
        w,
        *(part * np.exp(0.02 * random.standard_normal(81)) for part in (law.real, law.imag)),
    )
    law = fractional_zener(w, 1e6, 1e9, 30.0, 0.6)
    sets["glass transition in the band"] = w, law.real, law.imag
    sets["the same, 5 % noise"] = (
        w,
        *(part * np.exp(0.05 * random.standard_normal(81)) for part in (law.real, law.imag)),
    )
    times = np.array([1e-3, 3e-2, 0.5, 9.0])
    series = PronySeries(3e6, np.array([8e6, 2e6, 5e6, 1e6]), times, 22.0)
    sets["four exponentials"] = w, series.storage_modulus(w), series.loss_modulus(w)
    route = read_route(
        ROOT / "reference_data" / "material" / "synthetic_sweeps.csv", Wlf(), 22.0, RouteSettings(replicates=0)
    )
    m = route.master
    sets["shipped sweeps, 6.4 decades"] = m.angular_frequency, m.storage_modulus, m.loss_modulus
    return sets


def error(data: Data, storage: np.ndarray, loss: np.ndarray) -> float:
    _, e1, e2 = data
    return float(np.sqrt(np.mean(np.concatenate([storage / e1 - 1.0, loss / e2 - 1.0]) ** 2)))


def ours(data: Data, terms: int, refined: bool) -> tuple[float, float]:
    w, e1, e2 = data
    start = time.perf_counter()
    fit = fit_prony(w, e1, e2, relaxation_times((w[0], w[-1]), terms), 22.0)
    if refined:
        fit = refine_times(fit)
    spent = time.perf_counter() - start
    return error(data, fit.series.storage_modulus(w), fit.series.loss_modulus(w)), spent


def theirs(data: Data, terms: int) -> tuple[float, float, str]:
    from pyvisco import prony

    w, e1, e2 = data
    frame = pd.DataFrame(
        {"f": w / (2 * np.pi), "omega": w, "E_stor": e1 / 1e6, "E_loss": e2 / 1e6,
         "E_stor_filt": e1 / 1e6, "E_loss_filt": e2 / 1e6}
    )  # fmt: skip
    best, spent, name = np.inf, 0.0, ""
    for window in ("round", "exact"):
        for optimise in (False, True):
            with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
                warnings.simplefilter("ignore")
                frame.modul, frame.domain, frame.RefT = "E", "freq", 22.0
                start = time.perf_counter()
                fit = prony.fit_freq(prony.discretize(frame, window, terms), frame, optimise)
                took = time.perf_counter() - start
            rows = fit["df_terms"]
            moduli, times = rows["E_i"].to_numpy() * 1e6, rows["tau_i"].to_numpy()
            long_term = fit["E_0"] * 1e6 - moduli.sum()
            x = w[:, None] * times
            found = error(data, long_term + (x**2 / (1 + x**2)) @ moduli, (x / (1 + x**2)) @ moduli)
            if found < best:
                best, spent, name = found, took, f"{window}{', optimised' if optimise else ''}"
    return best, spent, name


def main() -> None:
    import pyvisco

    print(f"pyvisco {pyvisco.__version__}; errors are RMS of E' and E'', per cent; times in ms")
    print(f"{'data':30s} terms |  even   ms | refined    ms | pyvisco    ms  its setting")
    worse = 0
    for name, data in data_sets().items():
        for terms in TERMS:
            even, refined, other = ours(data, terms, False), ours(data, terms, True), theirs(data, terms)
            worse += refined[0] > other[0] * 1.0001
            print(
                f"{name:30s} {terms:5d} | {100 * even[0]:6.3f} {1e3 * even[1]:4.0f} | {100 * refined[0]:7.3f} "
                f"{1e3 * refined[1]:5.0f} | {100 * other[0]:7.3f} {1e3 * other[1]:5.0f}  {other[2]}"
                f"{'  (even worse)' if even[0] > other[0] else ''}"
            )
    print(f"pyvisco better than the refined fit: {worse} of {len(data_sets()) * len(TERMS)}")


if __name__ == "__main__":
    main()
