"""No field of a study can be forgotten: each changes the digest of a case or says why it does not."""

from __future__ import annotations

import dataclasses
import types
import typing
from pathlib import Path

import pytest
from pydantic import BaseModel

from tread_validate.fields import DataFile, Label, Numerics
from tread_validate.friction import ENTRIES as LAWS
from tread_validate.friction.law import FrictionEntry
from tread_validate.geometry import ENTRIES as PATHS
from tread_validate.geometry import PathEntry
from tread_validate.study import Case, LibraryCompound, Study
from tread_validate.study.digest import marks
from tread_validate.study.grid import expand
from tread_validate.study.library import FOLDER

SOURCED = {"origin": "assumed", "source": "for the test"}
MODEL = {"description": "a model", "origin": "somebody"}


def kind(entry: type[BaseModel]) -> str:
    """Return the word by which a study names a kind of law or path."""
    return typing.get_args(entry.model_fields["kind"].annotation)[0]


def example(entry: type[FrictionEntry | PathEntry]) -> dict[str, object]:
    """Return the example of a law or path as a study gives it, any file in it the test's."""
    keys = {key: "one.dat" if key == "file" else value for key, value in entry.example.items()}
    return SOURCED | {"kind": kind(entry)} | keys


STANDING = {kind(entry) for entry in PATHS if not entry.rolls}  # paths of which a creep ratio has no meaning
EVERYTHING = {
    "schema_version": 1,
    "name": "everything",
    "title": "Every kind of input, two of each where a run names it",
    "mesh_of_path": {
        "rig": {"element_size_mm": 2.0, "element_length_ratio": 0.5, "layers": 6, "refinement": 2.0},
    },
    "compounds": {
        "zener": SOURCED
        | {
            "kind": "fractional_zener",
            "long_term_modulus_MPa": 10.0,
            "modulus_rise_MPa": 70.0,
            "corner_frequency_rad_s": 1e5,
            "exponent": 0.25,
        },
        "prony": SOURCED
        | {
            "kind": "prony",
            "long_term_modulus_MPa": 10.0,
            "terms": [{"modulus_MPa": 3.0, "relaxation_time_s": 0.01}],
        },
        "prony_file": SOURCED | {"kind": "prony_file", "file": "one.dat"},
        "sweeps": SOURCED | {"kind": "sweeps", "file": "one.dat"},
        "springpots": SOURCED
        | {
            "kind": "springpots",
            "reference_frequency_Hz": 1e7,
            "branches": [[{"modulus_MPa": 2.0, "phase_deg": 2.0}]],
            "shift": {"kind": "arrhenius", "activation_energy_kJ_mol": 90.0},
        },
        "tabulated": SOURCED
        | {
            "kind": "prony",
            "long_term_modulus_MPa": 10.0,
            "shift": {"kind": "table", "points": [[0.0, 1.0], [50.0, -1.0]]},
        },
        "library": {"kind": "library", "name": "one"},
    },
    "friction_laws": {kind(entry): example(entry) for entry in LAWS},
    "blocks": {
        "sipes": SOURCED
        | {
            "shape": "parallelogram",
            "length_mm": 25.0,
            "width_mm": 20.0,
            "height_mm": 8.0,
            "skew_deg": 20.0,
            "sipes": [{"position_mm": 12.0, "width_mm": 0.6}],
        },
        "plain": SOURCED | {"shape": "rectangle", "length_mm": 25.0, "width_mm": 20.0, "height_mm": 8.0},
    },
    "paths": {kind(entry): example(entry) for entry in PATHS}
    | {"wheel": SOURCED | {"kind": "rig", "big_wheel_diameter_mm": 800.0}},
    "tolerances": {"peak_positive_tangential_force": {"value": 0.2, "floor": 5.0, "reason": "a screening"}},
    "models": {
        "function": MODEL | {"kind": "python", "object": "block:forces", "files": ["one.dat"]},
        "command": MODEL | {"kind": "command", "command": "./run {case} {history}"},
        "histories": MODEL | {"kind": "histories", "folder": "made", "made_for": "0" * 64, "statement": "of today"},
    },
    "runs": [
        {"name": name, "path": path, "block": block, "compound": compound, "friction": friction}
        | {"temperature_degC": 22.0, "interference_mm": 0.2, "creep_percent": 0.1}
        | speed
        for name, path, block, compound, friction, speed in (
            ("a", ["simplified_belt", "rig"], "sipes", "zener", "coulomb", {"speed_m_s": 2.0}),
            ("b", "wheel", "sipes", "prony", "huemer", {"speed_m_s": 3.0}),
            ("c", "measured_belt", "sipes", "prony_file", "table", {"speed_m_s": 2.0}),
            ("d", "rig", "plain", "sweeps", "huemer_file", {"speed_rpm": 300.0}),
            ("h", "rig", "plain", "springpots", "coulomb", {"speed_rpm": 300.0}),
            ("i", "rig", "plain", "tabulated", "coulomb", {"speed_rpm": 300.0}),
            ("k", "rig", "plain", "library", "coulomb", {"speed_rpm": 300.0}),
            *((f"l{n}", "rig", "plain", "zener", kind(entry), {"speed_m_s": 2.0}) for n, entry in enumerate(LAWS)),
            *(
                (
                    f"p{n}",
                    kind(entry),
                    "plain",
                    "zener",
                    "coulomb",
                    {"speed_m_s": 2.5, "creep_percent": 0.1 if entry.rolls else 0.0},
                )
                for n, entry in enumerate(PATHS)
            ),
            ("e", "rig", "plain", "zener", "coulomb", {"speed_rpm": 300.0, "poissons_ratio": 0.47}),
        )
    ],
}  # a kind of input that is missing here fails the first test
NAMED = {
    "path": ("wheel", "rig"),
    "block": ("plain", "sipes"),
    "compound": ("zener", "prony"),
    "friction": ("coulomb", "huemer"),
}


def is_label(found: tuple[object, ...]) -> bool:
    """Whether a field's marks say that it decides no result."""
    return any(isinstance(mark, Label) for mark in found)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    (tmp_path / "one.dat").write_text("1\n", encoding="utf-8")
    (tmp_path / "two.dat").write_text("2\n", encoding="utf-8")
    (tmp_path / FOLDER).mkdir(parents=True)
    for name, modulus in (("one", 5), ("onex", 6)):
        text = f"{{kind: prony, origin: assumed, source: for the test, long_term_modulus_MPa: {modulus}}}"
        (tmp_path / FOLDER / f"{name}.yaml").write_text(text, encoding="utf-8")
    return tmp_path


def models_in(annotation: object) -> set[type[BaseModel]]:
    """Return every model that a value of the annotated type may hold, at any depth."""
    found: set[type[BaseModel]] = set()
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        found.add(annotation)
        for item in annotation.model_fields.values():
            found |= models_in(item.annotation)
    elif isinstance(annotation, types.UnionType) or typing.get_origin(annotation) is not None:
        for part in typing.get_args(annotation):
            found |= models_in(part)
    return found


def places(value: object, at: tuple[object, ...] = ()):
    """Yield the place (keys and indices from the study down), owner and field of every field in a study."""
    if isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield (*at, name), value, name
            yield from places(getattr(value, name), (*at, name))
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from places(inner, (*at, key))
    elif isinstance(value, tuple):
        for index, inner in enumerate(value):
            yield from places(inner, (*at, index))


def changed(value: object, name: str, found: tuple[object, ...]) -> object:
    """Return another value of the same sort."""
    if any(isinstance(mark, DataFile) for mark in found):
        return "two.dat"
    if name in NAMED:
        return next(other for other in NAMED[name] if other != value)
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 1 if isinstance(value, int) else 1.01 * value + 0.0123
    if isinstance(value, str):
        return f"{value}x"
    if isinstance(value, tuple):
        return (*value[:-1], changed(value[-1], "", ())) if value else ("another",)
    raise TypeError(f"{name}: {value}")


def replaced(value: object, at: tuple[object, ...], new: object) -> object:
    """Return a copy of a study with one value in it replaced."""
    if not at:
        return new
    head, *rest = at
    if isinstance(value, BaseModel):
        return value.model_copy(update={head: replaced(getattr(value, head), tuple(rest), new)})
    if isinstance(value, dict):
        return value | {head: replaced(value[head], tuple(rest), new)}
    place = head % len(value)
    return tuple(replaced(item, tuple(rest), new) if index == place else item for index, item in enumerate(value))


def digests(study: Study, root: Path, *solvers: str) -> list[str]:
    return [case.digest(*solvers) for case in expand(study, root / "study.yaml", root, "0" * 64)]


def test_example_holds_every_model_that_a_study_may_hold():
    study = Study.model_validate(EVERYTHING)
    assert {type(owner) for _, owner, _ in places(study)} == models_in(Study)


def test_changing_any_field_changes_the_digest_unless_it_is_a_label(root):
    """Field by field through the whole study: 100 and more places."""
    study = Study.model_validate(EVERYTHING)
    plain = digests(study, root)
    count = 0
    for at, owner, name in places(study):
        value, found = getattr(owner, name), marks(type(owner))[name]
        if value is None or isinstance(value, BaseModel | dict) or models_in(type(owner).model_fields[name].annotation):
            continue
        if isinstance(owner, LibraryCompound) and name == "kind":
            continue  # says where the compound stands, not what it is
        if name == "schema_version" or (name == "creep_percent" and owner.path in STANDING):
            continue  # of the file's form; and a track has no creep
        named = any(is_label(marks(type(part))[key]) for part, key in _chain(study, at))
        altered = digests(replaced(study, at, changed(value, name, found)), root)
        assert (altered == plain) == named, f"{'.'.join(map(str, at))}: declare it a Label, or let it count"
        count += 1
    assert count > 100


def _chain(study: Study, at: tuple[object, ...]):
    """Yield the models and fields on the way to a place."""
    value: object = study
    for key in at:
        if isinstance(value, BaseModel):
            yield value, key
            value = getattr(value, str(key))
        else:
            value = value[key]


def test_a_factor_left_out_and_given_differ(root):
    study = Study.model_validate(EVERYTHING)
    own = replaced(study, ("runs", -1, "poissons_ratio"), None)
    assert digests(own, root) == digests(study, root)  # 0.47 is what the compound has
    other = replaced(study, ("runs", -1, "poissons_ratio"), (0.45, 0.49))
    ids = [case.case_id for case in expand(other, root / "study.yaml", root, "")]
    assert sum("-nu0p45-" in name for name in ids) == sum("-nu0p49-" in name for name in ids) > 0
    assert len(set(digests(other, root))) == len(ids)


def test_every_field_of_a_case_is_a_label_a_solvers_setting_or_counts(root):
    study = Study.model_validate(EVERYTHING)
    case = expand(study, root / "study.yaml", root, "0" * 64)[0]
    for item in dataclasses.fields(Case):
        found = marks(Case)[item.name]
        value = getattr(case, item.name)
        if isinstance(value, BaseModel | Path):  # the study's own test goes through them
            continue
        altered = dataclasses.replace(case, **{item.name: 0.5 if value is None else changed(value, "", ())})
        assert (altered.digest() == case.digest()) == is_label(found), item.name


def test_settings_of_a_solver_leave_the_problem_and_the_other_solver_alone(root):
    study = Study.model_validate(EVERYTHING)
    coarse = replaced(study, ("spring", "element_length_mm"), 1.0)
    thick = replaced(study, ("deck", "layers"), 4)
    case, with_spring, with_deck = (expand(item, root / "study.yaml", root, "")[0] for item in (study, coarse, thick))
    assert case.problem_digest() == with_spring.problem_digest() == with_deck.problem_digest()
    assert case.digest("spring") == with_deck.digest("spring") != with_spring.digest("spring")
    assert case.digest("deck") == with_spring.digest("deck") != with_deck.digest("deck")


def test_content_of_a_data_file_counts_and_its_name_does_not(root):
    study = Study.model_validate(EVERYTHING)
    plain = digests(study, root)
    (root / "two.dat").write_text("1\n", encoding="utf-8")
    moved = replaced(study, ("compounds", "sweeps", "file"), "two.dat")
    assert digests(moved, root) == plain
    (root / "one.dat").write_text("3\n", encoding="utf-8")
    assert digests(study, root) != plain
    (root / "one.dat").unlink()
    assert len({*digests(study, root), *plain}) > len(set(plain))


def test_every_label_says_why():
    for model in models_in(Study) | {Case}:
        for name, found in marks(model).items():
            for mark in found:
                assert not isinstance(mark, Label) or len(mark.why) > 5, name
    solvers = {mark.solver for found in marks(Case).values() for mark in found if isinstance(mark, Numerics)}
    assert solvers == {"spring", "deck"}
