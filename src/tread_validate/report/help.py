"""A line of help behind the title of every table: how to read it, and what to do with it."""

from __future__ import annotations

from dataclasses import replace

from .content import Item, Section, Table

HELP = {
    "delta": "Every cell that differs from the baseline, furthest beyond its noise first.",
    "disagreeing-statements": "What the paper prints and a model does not meet, furthest first; the reason if known.",
    "flips": "Assessments that are not what they were, however little a number moved; look at these first.",
    "trend": "One row a model and accepted baseline, oldest first: a model that gets worse slowly shows here.",
    "assumptions": "Replace these by your own data; the codes S and A mark every number that depends on them.",
    "published": "What the paper prints, number by number, and what each is used for here.",
    "sensitivity": "A score that moves more than its tolerance with window or sampling says little.",
    "meshes": "Values on three meshes and their extrapolation; an order near 2 says that the meshes converge.",
    "expected": "A case outside the map has no expected error: its groups lie beyond the runs that made the map.",
    "expected-means": "Nine in ten cases should lie below the limit; fewer, and the map promises too much.",
    "hierarchy-levels": "From simple to fine: take the first level whose errors your purpose allows.",
    "hierarchy-pareto": "A level that is slower and worse than another is not worth its time.",
    "hierarchy-published": "Which level of detail brings which published figure; the rest is a matter of inputs.",
    "hierarchy-effects": "One effect switched off at a time: the change of the peaks says what it is worth.",
    "hierarchy-combinations": "Inputs that the paper does not give, and the values that would meet what it prints.",
    "hierarchy-compatibility": "A compound must give both coefficients at once; each row is one spectrum tried.",
    "hierarchy-sobol": "First order: an input alone; total: with all its interactions. Both lie between 0 and 1.",
    "hierarchy-stiffness": "Stiffness over that of an unconstrained block; solved, and as closed forms have it.",
    "hierarchy-fe_meshes": "What a finer mesh costs and what it changes.",
    "provenance-code": "What would have to be checked out to make this report again.",
    "provenance-sources": "Runs by source and state; only current ones are compared.",
    "provenance-packages": "Versions with which the tables were made.",
    "provenance-inputs": "A file with another digest is another study.",
    "alternating": "Compare means and scatter; a peak of such a run is one of many, and no assessment depends on it.",
    "hierarchy-compounds": "Each compound's own moduli at the runs' frequencies, and the models' errors with it.",
    "hierarchy-compound_dependence": "How far the assessment of a model hangs on the compound that the study assumes.",
    "quality": "Residuals of the fit; the compound's section says what they are worth for the runs of this study.",
}


def with_help(section: Section) -> Section:
    """Return a section whose tables have their line; a test goes through all tables."""
    return replace(section, items=tuple(_helped(item) for item in section.items))


def _helped(item: Item) -> Item:
    if not isinstance(item, Table) or item.help:
        return item
    kind = "quality" if item.key.startswith("quality-") else item.key
    return replace(item, help=HELP.get(kind, ""))
