"""The steps of a deck: duration, constraints, loads, contact and output requests."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import DataLine, KeywordBlock
from .amplitude import Amplitude, amplitude_at
from .kernel_data import DISPLACEMENT, FIXED, VELOCITY
from .loads import Load, read_loads
from .mesh import Mesh

Ints = NDArray[np.int64]
HISTORY_VARIABLES = ("U", "V", "RF")
NAMED_CONDITIONS = {
    "ENCASTRE": (1, 2, 3, 4, 5, 6),
    "PINNED": (1, 2, 3),
    "XSYMM": (1, 5, 6),
    "YSYMM": (2, 4, 6),
    "ZSYMM": (3, 4, 5),
    "XASYMM": (2, 3, 4),
    "YASYMM": (1, 3, 5),
    "ZASYMM": (1, 2, 6),
}


@dataclass(frozen=True)
class Condition:
    """A prescribed degree of freedom: `kind` FIXED, VELOCITY or DISPLACEMENT, `dof` 1..6."""

    nodes: Ints
    dof: int
    kind: int
    magnitude: float
    amplitude: Amplitude | None
    where: str
    step: str


@dataclass(frozen=True)
class ContactPair:
    """A slave surface against an analytical master, with its interaction."""

    slave: str
    master: str
    interaction: str
    where: str


@dataclass(frozen=True)
class NodeHistory:
    """Nodes whose history is asked for, and the variables (U, V, RF)."""

    nodes: Ints
    variables: tuple[str, ...]


@dataclass
class Step:
    """One explicit step.

    Attributes
    ----------
    period : float
        Duration.
    increment : float or None
        The increment of ``DIRECT USER CONTROL``; None is automatic.
    element_by_element : bool
        Whether the automatic increment comes from the elements one by one.
    """

    name: str
    where: str
    period: float = 0.0
    increment: float | None = None
    scale: float = 1.0
    element_by_element: bool = False
    linear_viscosity: float = 0.06
    quadratic_viscosity: float = 1.2
    conditions: dict[tuple[int, int], Condition] = field(default_factory=dict)
    loads: list[Load] = field(default_factory=list)
    pairs: list[ContactPair] = field(default_factory=list)
    mass_scaling: list[tuple[Ints, float | None, float | None, str]] = field(default_factory=list)
    history_interval: float | None = None
    node_history: dict[str, NodeHistory] = field(default_factory=dict)
    renewed: set[str] = field(default_factory=set)


def read_steps(blocks: list[KeywordBlock], mesh: Mesh, amplitudes: dict[str, Amplitude]) -> list[Step]:
    """Read model-level BOUNDARY and every step; conditions, loads and pairs carry over to the next step."""
    steps: list[Step] = []
    current = Step("initial", blocks[0].where)
    before, total = current, 0.0
    history = False
    for block in blocks:
        word = block.keyword
        if word == "STEP":
            before = current
            name = block.parameters.get("NAME") or f"Step-{len(steps) + 1}"
            current = Step(name, block.where, conditions=dict(before.conditions), loads=list(before.loads))
            current.pairs = list(before.pairs)
            history = False
        elif word == "END STEP":
            if not current.period > 0:
                raise InputError(current.where, "a step without *DYNAMIC, EXPLICIT", "a duration above 0")
            _refuse_stale(current)
            _refuse_jumps(current, before, total)
            total += current.period
            steps.append(current)
        elif word == "DYNAMIC":
            _dynamic(block, current)
        elif word == "BULK VISCOSITY":
            _bulk_viscosity(block, current)
        elif word == "BOUNDARY":
            _boundary(block, mesh, amplitudes, current)
        elif word in ("CLOAD", "DLOAD", "DSLOAD"):
            _loads(block, mesh, amplitudes, current)
        elif word == "CONTACT PAIR":
            _pair(block, current)
        elif word == "FIXED MASS SCALING":
            _mass_scaling(block, mesh, current)
        elif word == "OUTPUT":
            history = "HISTORY" in block.parameters
            if history and block.parameters.get("TIME INTERVAL"):
                current.history_interval = _positive(block, "TIME INTERVAL")
        elif word == "NODE OUTPUT" and history and block.parameters.get("NSET"):
            _node_history(block, mesh, current)
    if not steps:
        raise InputError(blocks[0].file, "no *STEP", "at least one *DYNAMIC, EXPLICIT step")
    return steps


def _bulk_viscosity(block: KeywordBlock, step: Step) -> None:
    line = _line(block)
    step.linear_viscosity = line.number_at(0, "linear bulk viscosity", 0.06)
    step.quadratic_viscosity = line.number_at(1, "quadratic bulk viscosity", 1.2)
    if step.linear_viscosity < 0 or step.quadratic_viscosity < 0:
        raise InputError(line.where, line.text, "bulk viscosities >= 0")


def _loads(block: KeywordBlock, mesh: Mesh, amplitudes: dict[str, Amplitude], step: Step) -> None:
    if _is_first_new(block, step):
        step.loads = [load for load in step.loads if not load.kind.startswith(block.keyword + " ")]
    read_loads(block, mesh, _amplitude(block, amplitudes), step.where, step.loads)


def _node_history(block: KeywordBlock, mesh: Mesh, step: Step) -> None:
    name = block.value("NSET")
    asked = {text.upper() for line in block.data for text in line.fields if text}
    if not asked or block.parameters.get("VARIABLE") in ("ALL", "PRESELECT"):
        asked |= set(HISTORY_VARIABLES)
    variables = tuple(word for word in HISTORY_VARIABLES if any(text.rstrip("123") == word for text in asked))
    step.node_history[name] = NodeHistory(mesh.nodes_of(name, block), variables)


def _refuse_stale(step: Step) -> None:
    """Refuse a step-time amplitude that goes on from an earlier step: it has no meaning in this one's clock."""
    items: list[Condition | Load] = [*step.conditions.values(), *step.loads]
    for item in items:
        if item.step != step.where and item.amplitude is not None and not item.amplitude.total_time:
            raise InputError(
                item.where,
                f"amplitude {item.amplitude.name} in STEP TIME carried into step {step.name}",
                "TIME=TOTAL TIME",
            )


def _refuse_jumps(step: Step, before: Step, total: float) -> None:
    """Refuse a displacement that does not begin where the step before, which ended at `total`, has left it."""
    for key, now in step.conditions.items():
        was = before.conditions.get(key)
        moved = was is not None and was.kind == DISPLACEMENT
        if now.kind != DISPLACEMENT or now.step != step.where or not (moved or before.period == 0.0):
            continue
        left = _displacement(was, before.period, total) if was is not None and moved else 0.0
        begins = _displacement(now, 0.0, total)
        if abs(begins - left) > 1e-6 * max(abs(now.magnitude), abs(left)):
            raise InputError(
                now.where, f"a displacement that jumps from {left:g} to {begins:g} as step {step.name} begins",
                "an amplitude that goes on from where the step before ends",
            )  # fmt: skip


def _displacement(condition: Condition, step_time: float, total: float) -> float:
    a = condition.amplitude
    if a is None:
        return condition.magnitude
    now = total if a.total_time else step_time
    value, _, _ = amplitude_at(a.times, a.values, a.integrals(), 0, a.times.size, a.smooth, 0, now)
    return condition.magnitude * float(value) + 0.0  # no -0 in a message


def _line(block: KeywordBlock) -> DataLine:
    if len(block.data) != 1:
        raise InputError(f"{block.where}: *{block.keyword}", f"{len(block.data)} data lines", "one data line")
    return block.data[0]


def _positive(block: KeywordBlock, name: str) -> float:
    try:
        value = float(block.value(name))
    except ValueError:
        value = float("nan")
    if not 0 < value < float("inf"):
        raise InputError(f"{block.where}: *{block.keyword}, {name}", block.value(name), "a number above 0")
    return value


def _dynamic(block: KeywordBlock, step: Step) -> None:
    line = _line(block)
    step.period = line.number_at(1, "the duration of the step")
    if not step.period > 0:
        raise InputError(line.where, line.text, "a duration above 0")
    if "DIRECT USER CONTROL" in block.parameters:
        step.increment = line.number_at(0, "the increment")
        if not 0 < step.increment <= step.period:
            raise InputError(line.where, line.text, "an increment above 0, not longer than the step")
    elif any(line.fields[i] for i in (0, 2, 3) if i < len(line.fields)):
        raise InputError(line.where, line.text, "', duration' (automatic increments)")
    step.element_by_element = "ELEMENT BY ELEMENT" in block.parameters
    if "SCALE FACTOR" in block.parameters:
        step.scale = _positive(block, "SCALE FACTOR")


def _amplitude(block: KeywordBlock, amplitudes: dict[str, Amplitude]) -> Amplitude | None:
    name = block.parameters.get("AMPLITUDE")
    if name is None:
        return None
    if name not in amplitudes:
        raise InputError(f"{block.where}: *{block.keyword}", f"amplitude {name}", "an *AMPLITUDE that exists")
    return amplitudes[name]


def _is_first_new(block: KeywordBlock, step: Step) -> bool:
    """Whether OP=NEW takes away what went before: the first such block of a keyword in a step does."""
    if block.parameters.get("OP") != "NEW" or block.keyword in step.renewed:
        return False
    step.renewed.add(block.keyword)
    return True


def _boundary(block: KeywordBlock, mesh: Mesh, amplitudes: dict[str, Amplitude], step: Step) -> None:
    if _is_first_new(block, step):
        step.conditions.clear()
    amplitude = _amplitude(block, amplitudes)
    velocity = block.parameters.get("TYPE") == "VELOCITY"
    for line in block.data:
        fields = line.fields
        nodes = mesh.nodes_of(fields[0], line)
        word = fields[1].upper() if len(fields) > 1 else ""
        if word in NAMED_CONDITIONS:
            dofs: tuple[int, ...] = NAMED_CONDITIONS[word]
            magnitude = 0.0
        else:
            first = line.integer_at(1, "a degree of freedom 1..6")
            dofs = tuple(range(first, line.integer_at(2, "a degree of freedom 1..6", first) + 1))
            magnitude = line.number_at(3, "a magnitude", 0.0)
            if not dofs or dofs[0] < 1 or dofs[-1] > 6:
                raise InputError(line.where, line.text, "degrees of freedom 1 to 6, in order")
        kind = FIXED
        if magnitude != 0.0:
            kind = VELOCITY if velocity else DISPLACEMENT
            if kind == DISPLACEMENT and amplitude is None:
                raise InputError(line.where, "a displacement without an amplitude", "AMPLITUDE= or TYPE=VELOCITY")
        for dof in dofs:
            condition = Condition(nodes, dof, kind, magnitude, amplitude, line.where, step.where)
            for node in nodes:
                step.conditions[(int(node), dof)] = condition


def _pair(block: KeywordBlock, step: Step) -> None:
    interaction = block.value("INTERACTION")
    for line in block.data:
        if len(line.fields) != 2:
            raise InputError(line.where, line.text, "slave surface, master surface")
        slave, master = (text.upper() for text in line.fields)
        step.pairs.append(ContactPair(slave, master, interaction, line.where))


def _mass_scaling(block: KeywordBlock, mesh: Mesh, step: Step) -> None:
    name = block.parameters.get("ELSET")
    elements = np.arange(mesh.element_labels.size) if name is None else mesh.elements_of(name, block)
    factor = _positive(block, "FACTOR") if "FACTOR" in block.parameters else None
    target = _positive(block, "DT") if "DT" in block.parameters else None
    if factor is None and target is None:
        raise InputError(block.where, "neither FACTOR nor DT", "FACTOR= or DT=")
    if target is not None and "TYPE" not in block.parameters:
        raise InputError(block.where, "DT without TYPE", "TYPE=BELOW MIN or TYPE=UNIFORM")
    kind = block.parameters.get("TYPE") or ""
    step.mass_scaling.append((elements, factor, target, kind))
