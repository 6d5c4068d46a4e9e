"""Published inputs: does the study use the number that the paper prints?"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...study import Case, Wlf
from ...units import IN_MM, MM
from ...yaml_text import read_yaml
from .claim import Compute, Computed, Evidence, nothing

BELT, RIG = "belt", "rig"


def _of(which: str, value: Callable[[Case], Any], choose: Callable[[list[float]], float] | None = None) -> Compute:
    """Read a number of every case of one kind; several levels need a rule to choose one, or have to be the same."""

    def compute(evidence: Evidence, source: str) -> Computed:
        cases = evidence.belt_cases() if which == BELT else evidence.rig_cases()
        found = [(case, value(case)) for case in cases]
        numbers = sorted({float(number) for _, number in found if number is not None})
        if not numbers:
            return nothing(f"the study has no {which} case with this input")
        if len(numbers) > 1 and choose is None:
            listed = ", ".join(f"{number:g}" for number in numbers)
            return nothing(f"the study uses several: {listed}", "undefined")
        number = numbers[0] if choose is None else choose(numbers)
        ids = tuple(case.case_id for case, item in found if item is not None and float(item) == number)
        return Computed(number, ids)

    return compute


def _belt_file(key: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        for case in evidence.belt_cases():
            if case.path.is_measured:
                file = case.path.belt_file(case.root)
                data = None if file is None else read_yaml(file)
                if not isinstance(data, dict):
                    return nothing("the study's trace is not a belt file")
                number = len(data["traces"]) if key == "traces" and "traces" in data else data.get(key)
                if not isinstance(number, int | float):
                    return nothing(f"the study's belt file does not say {key}")
                return Computed(float(number), (case.case_id,))
        return nothing("the study has no measured profile")

    return compute


def _level(position: float) -> Callable[[list[float]], float]:
    """Choose the level nearest to the published one, so that a level that is left out shows as an error."""
    return lambda numbers: min(numbers, key=lambda number: abs(number - position))


def _wlf(case: Case, value: Callable[[Wlf], float]) -> float | None:
    law = case.compound.time_shift
    return value(law) if isinstance(law, Wlf) else None


def _fit(case: Case) -> Any:
    return getattr(case.compound, "fit", None)


def _simplified(name: str) -> Callable[[Case], Any]:
    return lambda case: getattr(case.path, name, None)


INPUTS: dict[str, Compute] = {
    "wlf_c1": _of(BELT, lambda case: _wlf(case, lambda law: law.c1)),
    "wlf_c2": _of(BELT, lambda case: _wlf(case, lambda law: law.c2_K)),
    "glass_transition": _of(BELT, lambda case: _wlf(case, lambda law: law.reference_temperature_degC - 50.0)),
    "data_temperature": _of(BELT, lambda case: case.compound.data_temperature_degC),
    "prony_terms": _of(BELT, lambda case: None if _fit(case) is None else _fit(case).terms),
    "band_low": _of(BELT, lambda case: None if _fit(case) is None else _fit(case).band_rad_s[0]),
    "band_high": _of(BELT, lambda case: None if _fit(case) is None else _fit(case).band_rad_s[1]),
    "tyre_temperature": _of(BELT, lambda case: case.temperature),
    "poissons_ratio": _of(BELT, lambda case: case.compound.poissons_ratio),
    "small_wheel_diameter": _of(RIG, lambda case: MM * getattr(case.path, "small_wheel_diameter_mm", 0.0)),
    "big_wheel_diameter": _of(RIG, lambda case: MM * getattr(case.path, "big_wheel_diameter_mm", 0.0)),
    "rig_speed_low": _of(RIG, lambda case: _rounded(case.speed_rpm), min),
    "rig_speed_high": _of(RIG, lambda case: _rounded(case.speed_rpm), max),
    "rig_interference_low": _of(RIG, lambda case: _rounded(IN_MM * case.interference), min),
    "rig_interference_high": _of(RIG, lambda case: _rounded(IN_MM * case.interference), max),
    "rig_temperature_high": _of(RIG, lambda case: case.temperature, max),
    "fig5_interference": _of(RIG, lambda case: _rounded(IN_MM * case.interference), _level(0.2)),
    "fig5_speed": _of(RIG, lambda case: _rounded(case.speed_rpm), _level(300.0)),
    "trace_count": _belt_file("traces"),
    "trace_pitch": _belt_file("pitch_mm"),
    "edge_radius": _of(BELT, lambda case: _metres(_simplified("edge_radius_mm")(case))),
    "static_friction": _of(BELT, lambda case: case.friction.static_coefficient),
    "block_length": _of(BELT, lambda case: _rounded(IN_MM * case.length)),
    "block_width": _of(BELT, lambda case: _rounded(IN_MM * case.width)),
    "block_height": _of(BELT, lambda case: _rounded(IN_MM * case.height)),
    "element_length": _of(BELT, lambda case: case.spring.element_length_mm),
    "belt_speed": _of(BELT, lambda case: case.speed),
    "belt_compression": _of(BELT, lambda case: _rounded(IN_MM * case.interference)),
    "simplified_profile_length": _of(BELT, lambda case: _metres(_simplified("patch_length_mm")(case))),
}


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 9)


def _metres(value: float | None) -> float | None:
    return None if value is None else round(MM * value, 12)
