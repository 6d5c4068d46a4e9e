"""Materials, sections and section controls of a deck."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import DataLine, KeywordBlock
from .mesh import Mesh

Floats = NDArray[np.float64]


@dataclass
class Material:
    """A (visco)elastic material, linear or neo-Hookean, in deck units.

    Attributes
    ----------
    density, youngs_modulus, poissons_ratio : float
        Of the neo-Hookean law: at no strain.
    neo_hookean : bool
    instantaneous : bool
        Whether the modulus given is the instantaneous one (else the long-term one).
    prony : (k, 3)
        Rows g, k, tau: ratios to the instantaneous shear and bulk modulus, and the relaxation time.
    trs : (theta0, C1, C2) or None
    damping : float
        Stiffness-proportional damping, s: adds a stress of this time, times instantaneous stiffness, times strain rate.
    """

    name: str
    where: str
    density: float = 0.0
    youngs_modulus: float = 0.0
    poissons_ratio: float = 0.0
    instantaneous: bool = False
    prony: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    trs: tuple[float, float, float] | None = None
    damping: float = 0.0
    neo_hookean: bool = False

    def shear_and_bulk(self) -> tuple[float, float]:
        """Return the instantaneous shear and bulk modulus."""
        shear = self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
        bulk = self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
        if not self.instantaneous:
            shear /= 1.0 - float(self.prony[:, 0].sum())
            bulk /= 1.0 - float(self.prony[:, 1].sum())
        return shear, bulk

    def shift(self, temperature: float) -> float:
        """Return the factor on relaxation times at `temperature`, degC.

        log10 A = -C1 (T - T0) / (C2 + T - T0), 1 without ``*TRS``.
        """
        if self.trs is None:
            return 1.0
        theta, c1, c2 = self.trs
        if c2 + temperature - theta <= 0.0:
            raise InputError(f"{self.where}: *TRS", f"temperature {temperature:g}", f"more than {theta - c2:g}")
        return float(10.0 ** (-c1 * (temperature - theta) / (c2 + temperature - theta)))


@dataclass(frozen=True)
class SolidSection:
    """The material and the hourglass control of some elements.

    Attributes
    ----------
    hourglass : str
        STIFFNESS or RELAX STIFFNESS.
    hourglass_scale, linear_scale, quadratic_scale : float
        Factors of the section controls on hourglass stiffness and on both bulk viscosities.
    """

    elements: NDArray[np.int64]
    material: Material
    hourglass: str = "RELAX STIFFNESS"
    hourglass_scale: float = 1.0
    linear_scale: float = 1.0
    quadratic_scale: float = 1.0


def read_materials(blocks: list[KeywordBlock]) -> dict[str, Material]:
    """Read every material with its DENSITY, ELASTIC or HYPERELASTIC, VISCOELASTIC, TRS and DAMPING."""
    materials: dict[str, Material] = {}
    current: Material | None = None
    for block in blocks:
        if block.keyword == "MATERIAL":
            name = block.value("NAME")
            if name in materials:
                raise InputError(block.where, f"material {name} twice", "each material once")
            current = materials[name] = Material(name, block.where)
        elif block.keyword in ("DENSITY", "ELASTIC", "HYPERELASTIC", "VISCOELASTIC", "TRS", "DAMPING"):
            if current is None:
                raise InputError(block.where, f"*{block.keyword} before any *MATERIAL", "*MATERIAL first")
            _property(block, current)
    for material in materials.values():
        _complete(material)
    return materials


def _only(block: KeywordBlock, fields: int) -> DataLine:
    """Return the single data line of a property without field or temperature dependence."""
    if len(block.data) != 1 or len(block.data[0].fields) > fields:
        raise InputError(block.where, "a table" if block.data else "no data", f"one line of {fields} value(s)")
    return block.data[0]


def _factor(block: KeywordBlock, name: str) -> float:
    """Return a parameter that is a finite number of at least 0."""
    text = block.value(name)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 <= value < math.inf:
        raise InputError(f"{block.where}: *{block.keyword}, {name}", text, "a number of 0 or more")
    return value


def _property(block: KeywordBlock, material: Material) -> None:
    if block.keyword == "DENSITY":
        material.density = _only(block, 1).number_at(0, "a density")
    elif block.keyword in ("ELASTIC", "HYPERELASTIC") and material.youngs_modulus:
        raise InputError(
            block.where, f"a second elasticity of material {material.name}", "*ELASTIC or *HYPERELASTIC, once"
        )
    elif block.keyword == "HYPERELASTIC":
        _neo_hookean(block, material)
    elif block.keyword == "ELASTIC":
        line = _only(block, 2)
        material.youngs_modulus = line.number_at(0, "Young's modulus")
        material.poissons_ratio = line.number_at(1, "Poisson's ratio", 0.0)
        material.instantaneous = block.parameters.get("MODULI") == "INSTANTANEOUS"
        if not material.youngs_modulus > 0 or not -1.0 < material.poissons_ratio < 0.5:
            raise InputError(line.where, line.text, "E > 0 and -1 < nu < 0.5")
    elif block.keyword == "VISCOELASTIC":
        rows = []
        for line in block.data:
            g, k, tau = (line.number_at(i, "g, k, tau") for i in range(3))
            if g < 0 or k < 0 or tau <= 0:
                raise InputError(line.where, line.text, "g >= 0, k >= 0, tau > 0")
            rows.append((g, k, tau))
        if not rows:
            raise InputError(block.where, "no terms", "lines g, k, tau")
        material.prony = np.array(rows)
    elif block.keyword == "DAMPING":
        if block.data:
            raise InputError(block.where, "data lines", "*DAMPING, BETA=...")
        material.damping = _factor(block, "BETA")
    else:
        line = _only(block, 3)
        material.trs = (line.number_at(0, "theta0"), line.number_at(1, "C1"), line.number_at(2, "C2"))


def _neo_hookean(block: KeywordBlock, material: Material) -> None:
    """Read C10, D1: shear modulus 2 C10 and bulk modulus 2/D1 at no strain."""
    line = _only(block, 2)
    c10, d1 = line.number_at(0, "C10"), line.number_at(1, "D1", 0.0)
    shear, bulk = 2.0 * c10, 2.0 / d1 if d1 > 0.0 else 0.0
    if not c10 > 0.0 or not d1 > 0.0 or not 3.0 * bulk > 2.0 * shear:
        expected = "C10 > 0 and D1 > 0 (ABAQUS/Explicit takes K = 20 G for D1 = 0: write it), Poisson's ratio > 0"
        raise InputError(line.where, line.text, expected)
    material.neo_hookean = True
    material.youngs_modulus = 9.0 * bulk * shear / (3.0 * bulk + shear)
    material.poissons_ratio = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
    material.instantaneous = block.parameters.get("MODULI") == "INSTANTANEOUS"


def _complete(material: Material) -> None:
    if not material.density > 0 or not material.youngs_modulus > 0:
        missing = "*ELASTIC or *HYPERELASTIC" if material.density > 0 else "*DENSITY"
        raise InputError(material.where, f"material {material.name} without {missing}", "density and elasticity")
    for column, name in ((0, "g"), (1, "k")):
        total = float(material.prony[:, column].sum())
        if total >= 1.0:
            raise InputError(material.where, f"sum of {name}_i = {total:g}", "less than 1")


def read_sections(blocks: list[KeywordBlock], mesh: Mesh, materials: dict[str, Material]) -> list[SolidSection]:
    """Read SOLID SECTION with SECTION CONTROLS; every element must have one section."""
    controls = {b.value("NAME"): b for b in blocks if b.keyword == "SECTION CONTROLS"}
    sections: list[SolidSection] = []
    seen = np.zeros(mesh.element_labels.size, dtype=np.int64)
    for block in blocks:
        if block.keyword != "SOLID SECTION":
            continue
        name = block.value("MATERIAL")
        if name not in materials:
            raise InputError(block.where, f"material {name}", "a material that exists")
        elements = mesh.elements_of(block.value("ELSET"), block)
        seen[elements] += 1
        chosen = block.parameters.get("CONTROLS")
        if chosen is None:
            sections.append(SolidSection(elements, materials[name]))
            continue
        if chosen not in controls:
            raise InputError(block.where, f"section controls {chosen}", "*SECTION CONTROLS with that name")
        control = controls[chosen]
        scales = [1.0, 1.0, 1.0, 1.0, 1.0]
        if control.data:
            scales = [control.data[0].number_at(i, "a scaling factor", 1.0) for i in range(5)]
        if min(scales) < 0:
            raise InputError(control.data[0].where, min(scales), "scaling factors >= 0")
        kind = control.parameters.get("HOURGLASS") or "RELAX STIFFNESS"
        sections.append(SolidSection(elements, materials[name], kind, scales[0], scales[3], scales[4]))
    wrong = np.flatnonzero(seen != 1)
    if wrong.size:
        label = mesh.element_labels[wrong[0]]
        raise InputError(f"element {label}", f"{seen[wrong[0]]} solid sections", "one *SOLID SECTION for every element")
    return sections
