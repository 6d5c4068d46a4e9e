"""Which figures a report has, and of which cases."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ...compare.baseline.histories import Histories
from ...compare.baseline.movement import Movement
from ...compare.rig_peaks import RigPeak
from ...geometry import PathEntry
from ...history import History
from ...palette import Look
from ...study import Case, LoadedStudy
from ...units import MM
from .. import wording
from ..cases import CaseView
from ..content import Figure, Mark
from ..marks import Marks
from ..table1 import regression_sources
from ..tables import Tables, pairs_of
from . import contact, errors, forces, geometry, material, regressions
from .before_after import before_after, worst
from .contact import FaceTable
from .overview import overview
from .style import Drawn


@dataclass(frozen=True)
class Drawings:
    """Draws the figures of one report into `folder`."""

    study: LoadedStudy
    tables: Tables
    views: tuple[CaseView, ...]
    histories: Mapping[str, Mapping[str, History]]
    looks: Mapping[str, Look]
    marks: Marks
    decks: Path
    reference: Path
    folder: Path
    rig: Mapping[str, RigPeak] = field(default_factory=dict)

    def overview(self) -> Figure | None:
        """Draw the first screen's picture: the first of the cases with most histories; None without any."""
        known = [view for view in self.views if self.histories.get(view.case_id)]
        if not known:
            return None
        view = max(known, key=lambda view: len(self.histories[view.case_id]))
        own = tuple(row for row in self.tables.errors if row.case_id == view.case_id)
        return overview(self.folder, view, self.histories[view.case_id], self.looks, own, self.marks.of(view.assumed))

    def moved(self, found: Sequence[Movement], accepted: Histories) -> tuple[Figure, ...]:
        """Draw before and after of the runs that moved most since the baseline."""
        views = {view.case_id: view for view in self.views}
        return tuple(
            before_after(
                self.folder, item, accepted, self.histories.get(item.case_id, {}), views[item.case_id], self.looks,
                self.marks,
            )
            for item in worst(found, accepted)
            if item.case_id in views
        )  # fmt: skip

    def regressions(self) -> tuple[Drawn, ...]:
        """Draw coefficients and residuals."""
        found = []
        for name in ("a_v", "a_theta"):
            own = self.marks.of_column(row.assumed for row in self.tables.regression if row.coefficient == name)
            found.append(regressions.coefficients(self.folder, self.tables, regression_sources(self.tables), name, own))
        for name in ("a_v", "a_theta"):
            own = self.marks.of_column(row.assumed for row in self.tables.residuals if row.coefficient == name)
            found.append(regressions.residuals(self.folder, self.tables, self.looks, name, own))
        return tuple(found)

    def heat(self) -> tuple[Drawn, ...]:
        """Draw the still heat map of every model."""
        rows = self.tables.errors
        marks = self.marks.of_column(row.assumed for row in rows)
        return tuple(errors.heat(self.folder, self.tables, self.views, pair, marks) for pair in pairs_of(rows))

    def scatter(self) -> tuple[Drawn, ...]:
        """Draw the still scatter plots."""
        marks = self.marks.of_column(row.assumed for row in self.tables.errors)
        return tuple(
            errors.scatter(self.folder, self.tables, self.looks, quantity, marks)
            for quantity in ("peak_normal_force", "peak_positive_tangential_force")
        )

    def forces(self) -> tuple[Drawn, ...]:
        """Draw the paper's Figs. 5, 14, 16 and 6 where the study has such cases."""
        return (*self._figure5(), *self._belts(), *self._peaks())

    def _figure5(self) -> tuple[Drawn, ...]:
        """Parallelogram at 300 rpm and 0.2 mm, at both temperatures: the case nearest to that for each."""
        rig = [view for view in self.views if view.row.path in self._paths(lambda path: path.gives_coefficients)]
        if not rig:
            return ()
        wanted = {"shape": "parallelogram", "speed_rpm": 300.0, "interference_mm": 0.2}
        temperatures = list(dict.fromkeys(view.levels["temperature_degC"] for view in rig))[:2]
        chosen = [
            max(
                (view for view in rig if view.levels["temperature_degC"] == level),
                key=lambda view: sum(_same(getattr(view.row, key), value) for key, value in wanted.items()),
            )
            for level in temperatures
        ]
        found: list[Drawn] = []
        for view in chosen:
            key = f"rig-histories-{view.levels['temperature_degC']}c"
            found += self._pair(key, view, "As the paper's Fig. 5.")
        return tuple(found)

    def _belts(self) -> tuple[Drawn, ...]:
        measured = self._paths(lambda path: path.on_tyre and path.is_measured)
        simplified = self._paths(lambda path: path.on_tyre and not path.is_measured)
        found: list[Drawn] = []
        for names, number in ((measured, "14"), (simplified, "16")):
            for view in [view for view in self.views if view.row.path in names][:1]:
                key = f"belt-histories-{view.row.path}".replace("_", "-")
                found += self._pair(key, view, f"As the paper's Fig. {number}.")
        return tuple(found)

    def _pair(self, key: str, view: CaseView, caption: str) -> tuple[Drawn, ...]:
        histories = self.histories.get(view.case_id, {})
        if not histories:
            return (Drawn(None, f"{view.label}: no histories to draw."),)
        marks = self.marks.of(view.assumed)
        words = f"{view.label}. {caption}"
        return tuple(
            forces.history_panel(
                self.folder,
                f"{key}-{force}",
                f"{forces.NAMES[force].capitalize()} force",
                words,
                histories,
                self.looks,
                force,
                marks,
            )
            for force in ("normal", "tangential")
        )

    def _peaks(self) -> tuple[Drawn, ...]:
        rig = [view for view in self.views if view.row.path in self._paths(lambda path: path.gives_coefficients)]
        grids: dict[tuple[str, str], list[CaseView]] = {}
        for view in rig:
            grids.setdefault((view.row.shape, view.levels["temperature_degC"]), []).append(view)
        return tuple(
            forces.peaks_panel(
                self.folder,
                self.tables,
                self.looks,
                tuple(members),
                shape,
                temperature,
                self.marks.of(*(view.assumed for view in members)),
                self.rig,
            )
            for (shape, temperature), members in grids.items()
            if len({view.levels["speed"] for view in members}) > 1
        )

    def contact(self) -> tuple[Drawn, ...]:
        """Draw the pressure on the face in mid-contact, for one case of every path."""
        found: list[Drawn] = []
        for label, case in self._one_per_path().items():
            face, engine = self._face(case.case_id)
            found.append(contact.pressure(self.folder, case, label, face, engine, self.looks, self._of(case)))
            if face is not None:
                found.append(contact.pressure_map(self.folder, case, label, face, engine, self._of(case)))
        return tuple(found)

    def _face(self, case_id: str) -> tuple[FaceTable | None, str]:
        """Return the contact face of the first engine with a current run of the case, and the engine's name."""
        for source in self.histories.get(case_id, {}):
            if source.startswith("fe:"):
                folder = next(row.folder for row in self.tables.peaks if (row.source, row.case_id) == (source, case_id))
                face = contact.read_face(self.reference / folder / "face.csv")
                if face is not None:
                    return face, wording.source(source)
        return None, ""

    def material(self) -> tuple[Drawn, ...]:
        """Draw moduli and friction of everything that the cases use."""
        model, root = self.study.model, self.study.root
        compounds = dict.fromkeys(view.row.compound for view in self.views)
        laws = dict.fromkeys(view.row.friction for view in self.views)
        found = [
            material.moduli(self.folder, name, self.study.compounds()[name], root, self.input_marks(f"compound {name}"))
            for name in compounds
            if name in model.compounds
        ]
        found += [
            material.friction(
                self.folder, name, model.friction_laws[name], root, self.input_marks(f"friction law {name}")
            )
            for name in laws
            if name in model.friction_laws
        ]
        return tuple(found)

    def geometry(self) -> tuple[Drawn, ...]:
        """Draw belt, rig and meshes."""
        cases = {case.path_name: case for case in reversed(self._cases())}
        belts = {name: case for name, case in reversed(cases.items()) if case.path.on_tyre}
        rigs = [(case, radii) for case in cases.values() if (radii := case.path.wheel_radii()) is not None]
        found: list[Drawn] = []
        if belts:
            marks = self.marks.of(
                *(f"path {name} ({case.path.origin})" for name, case in belts.items() if _made_up(case))
            )
            found += [
                geometry.belt_heights(self.folder, belts, marks),
                geometry.belt_curvature(self.folder, belts, marks),
            ]
            first = next(iter(belts.values()))
            found.append(geometry.belt_sketch(self.folder, first, self.input_marks(f"path {first.path_name}")))
        found += [
            geometry.rig_sketch(self.folder, case, radii, self.input_marks(f"path {case.path_name}"))
            for case, radii in rigs[:1]
        ]
        found += [
            geometry.track_sketch(self.folder, case, self.input_marks(f"path {name}"))
            for name, case in reversed(cases.items())
            if not case.path.rolls
        ]
        blocks = {case.block_name: case for case in reversed(self._cases())}
        for name, case in reversed(blocks.items()):
            file = self.decks / case.case_id / "mesh.vtu"
            title = f"Mesh of block {name.replace('_', ' ')}"
            found.append(geometry.mesh(self.folder, file, title, self.input_marks(f"block {name}"), case.height / MM))
        return tuple(found)

    def _cases(self) -> tuple[Case, ...]:
        return self.study.cases()

    def _one_per_path(self) -> dict[str, Case]:
        labels = {view.case_id: view.label for view in self.views}
        creeps = {view.case_id: view.row.creep_percent for view in self.views}
        chosen: dict[tuple[str, str], Case] = {}
        for case in self._cases():
            middle = chosen.get((case.path_name, case.block_name))
            if middle is None or (
                case.path.gives_coefficients and abs(case.interference - 2e-4) < abs(middle.interference - 2e-4)
            ):
                chosen[(case.path_name, case.block_name)] = case
        found = {}
        for case in chosen.values():
            creep = creeps.get(case.case_id)
            if case.creep_ratio is None:
                case = case.with_creep(0.01 * float(creep)) if isinstance(creep, int | float) else case.with_creep(0.0)
            found[labels.get(case.case_id, case.case_id)] = case
        return found

    def _paths(self, fits: Callable[[PathEntry], bool]) -> set[str]:
        return {name for name, path in self.study.model.paths.items() if fits(path)}

    def input_marks(self, name: str) -> tuple[Mark, ...]:
        """Return the mark of one input, if it is assumed or synthetic."""
        return tuple(mark for mark in self.marks.all() if mark.text.startswith(f"{name} ("))

    def _of(self, case: Case) -> tuple[Mark, ...]:
        return self.marks.of("; ".join(case.assumed()))


def _same(found: object, wanted: object) -> bool:
    if isinstance(wanted, float) and isinstance(found, int | float):
        return abs(found - wanted) < 1e-6 * abs(wanted)
    return found == wanted


def _made_up(case: Case) -> bool:
    return case.path.origin in ("assumed", "synthetic")
