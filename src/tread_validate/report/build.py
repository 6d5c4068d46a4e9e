"""From tables and histories to the report's files."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path

from ..beside import beside
from ..compare.rig_peaks import rig_peaks
from ..compare.summary import SUMMARY
from ..files import write_text
from ..palette import looks
from ..study import load_study
from . import figures
from .alternating import alternating_table
from .baseline import baseline_section
from .cases import case_views
from .claims import claims_table
from .content import Item, Paragraph, Report, Section
from .discussion import discussion_section, method_section
from .error_charts import heatmap, scatter
from .expected import expected_section
from .extra import hierarchy_section, mesh_table
from .figures import figure_items
from .figures.workflow import rule_graph
from .help import with_help
from .histories import HistoryStore, load_histories
from .html import render
from .inputs import inputs_section, provenance_section, sensitivity_table, stamp
from .marks import Marks
from .models import Costs, models_table
from .pdf import write_pdf
from .results import ensemble_table
from .route import route_items, worth_items
from .summary import CAVEAT, first_screen
from .table1 import differences_table, table1
from .tables import read_tables
from .widgets import browser
from .workflow import read_rules


@dataclass(frozen=True)
class ReportPlaces:
    """Where a report takes its data from, and where it goes."""

    tables: Path
    spring: Path
    reference: Path
    decks: Path
    out: Path
    baseline_delta: Path | None = None
    hierarchy: Path | None = None
    workflow: Path | None = None

    @property
    def models(self) -> Path:
        """Histories of the user's own models, beside those of the springs."""
        return self.spring.parent / "models"


def build_report(
    study_path: Path | str,
    tables_dir: Path | str,
    spring_dir: Path | str,
    reference_dir: Path | str,
    decks_dir: Path | str,
    out_dir: Path | str,
    baseline_delta: Path | str | None = None,
    hierarchy_dir: Path | str | None = None,
    workflow: Path | str | None = None,
    jobs: int = 1,
) -> Report:
    """Write ``index.html``, ``report.pdf``, ``summary.json``, ``tables/`` and ``figures/`` below `out_dir`.

    Parameters
    ----------
    study_path : path
        The study file, for title, notes, materials and geometry.
    tables_dir : path
        The comparison's tables (``cases.csv``, ``errors.csv``, ...); the report shows them and computes no metric.
    spring_dir : path
        Histories as ``<variant>/<case_id>.csv``.
    reference_dir : path
        The reference data package.
    decks_dir : path
        Decks as ``<case_id>/mesh.vtu``, for the mesh sketch; may be missing.
    baseline_delta : path, optional
        The table that ``tread-validate check`` wrote.
    hierarchy_dir : path, optional
        Tables of the model hierarchy.
    workflow : path, optional
        The workflow's note of its rules; their graph is drawn from it.
    jobs : int
        With 2, figures are drawn in two processes; the files are the same.

    Raises
    ------
    InputError
        For a missing table or column, a wrong study or a damaged history.
    """
    places = ReportPlaces(
        Path(tables_dir),
        Path(spring_dir),
        Path(reference_dir),
        Path(decks_dir),
        Path(out_dir),
        None if baseline_delta is None else Path(baseline_delta),
        None if hierarchy_dir is None else Path(hierarchy_dir),
        None if workflow is None else Path(workflow),
    )
    report = compose(Path(study_path), places, jobs)
    _copy_tables(places)
    # typst has threads of its own, which a forked process would wait for in vain: it stays here
    page = beside(lambda: write_text(places.out / "index.html", render(report)), jobs)
    write_pdf(report, places.out / "report.pdf", places.out / "tables")
    page()
    return report


def compose(study_path: Path, places: ReportPlaces, jobs: int = 1) -> Report:
    """Read everything, draw the figures into ``out/figures`` and return the report's content."""
    study = load_study(study_path)
    tables = read_tables(places.tables)
    marks = Marks(tables.assumed)
    views = case_views(tables.cases)
    rig = rig_peaks(places.reference, study.cases())
    histories = load_histories(tables, HistoryStore(places.spring, places.models, places.reference, rig))
    look = looks([*tables.sources("fe"), *tables.sources("rig")], [*tables.sources("spring"), *tables.sources("model")])
    browse, data = browser(tables, views, histories, look, marks)
    heat, data["heat"] = heatmap(tables, views, marks)
    points, data["scatter"] = scatter(tables, views, look, marks)
    drawn = figures.Drawings(
        study, tables, views, histories, look, marks, places.decks, places.reference, places.out / "figures", rig
    )
    pictures = beside(lambda: (drawn.forces(), drawn.contact(), drawn.geometry()), jobs)
    delta, moved = baseline_section(places.baseline_delta, marks, places.tables, places.out / "baseline", drawn.moved)
    sensitivity = sensitivity_table(tables)
    results: list[Item] = [ensemble_table(tables, marks, headline=True), ensemble_table(tables, marks, headline=False)]
    results += [
        table
        for table in (alternating_table(tables, marks), mesh_table(places.reference), sensitivity)
        if table is not None
    ]
    screen = first_screen(
        tables, marks, models_table(tables, study, Costs.read(places.hierarchy, places.models, study), marks), moved,
        drawn.overview(),
    )  # fmt: skip
    regressions, still = figure_items(drawn.regressions()), figure_items(drawn.heat(), pdf=True)
    scattered, compound = (
        figure_items(drawn.scatter(), pdf=True),
        (*worth_items(study, drawn), *figure_items(drawn.material())),
    )
    route = route_items(study, drawn)
    levels = hierarchy_section(places.hierarchy, study, places.out / "figures", marks)
    forces, contact, geometry = map(figure_items, pictures())
    notes = tuple(Paragraph(text, tone="mute") for text in study.model.notes)
    sections = [
        Section("summary", "How far can the models be trusted?", (screen, Paragraph(CAVEAT), *notes)),
        method_section(),
        Section("results", "Results", tuple(results)),
        expected_section(tables, marks),
        Section(
            "table1",
            "Speed and temperature",
            (table1(tables, marks), *regressions, differences_table(tables, marks)),
        ),
        Section("claims", "Published statements", (claims_table(tables, marks),)),
        discussion_section(tables, marks),
        Section("cases", "Case browser", (browse,), page_only=True),
        Section("heatmaps", "Errors over the test matrix", (heat, *still)),
        Section("scatter", "Predicted against reference", (points, *scattered)),
        delta,
        Section("forces", "Force histories and peaks, as in the paper", forces),
        Section("contact", "Pressure on the contact face", contact),
        Section("material", "Compound and friction", compound),
        Section("geometry", "Belt, rig and mesh", geometry),
        Section("route", "From raw data to model input", route),
        levels,
        inputs_section(tables, marks),
        provenance_section(tables, SUMMARY if (places.tables / SUMMARY).is_file() else ""),
        _workflow(places),
    ]
    return Report(
        title="Tread-block validation report",
        subtitle=study.model.title,
        sections=tuple(with_help(section) for section in sections if section is not None and section.items),
        stamp=stamp(tables),
        page_data=data,
    )


def _workflow(places: ReportPlaces) -> Section | None:
    """Return the workflow's rule graph; its run times stand on a page of their own, for they differ from run to run."""
    if places.workflow is None or not places.workflow.is_file():
        return None
    drawn = figure_items((rule_graph(places.out / "figures", read_rules(places.workflow)),))
    words = Paragraph("Run time and memory of every rule, as Snakemake measured them: ", link="run_times.html")
    return Section("workflow", "The workflow", (*drawn, words), page_only=True)


def _copy_tables(places: ReportPlaces) -> None:
    """Copy the tables below the page, and the summary for programs beside it: the one of these tables or none."""
    target = places.out / "tables"
    target.mkdir(parents=True, exist_ok=True)
    for path in sorted(places.tables.glob("*.csv")):
        shutil.copyfile(path, target / path.name)
    (places.out / SUMMARY).unlink(missing_ok=True)
    if (places.tables / SUMMARY).is_file():
        shutil.copyfile(places.tables / SUMMARY, places.out / SUMMARY)
    if places.baseline_delta is not None and places.baseline_delta.is_file():
        shutil.copyfile(places.baseline_delta, target / "delta.csv")
