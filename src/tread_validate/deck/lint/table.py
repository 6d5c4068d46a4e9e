"""The keywords that the lint knows: where each may stand, its parameters and the form of its data lines.

Complete for what the decks of this package use, and wide enough for what is common in ABAQUS/Explicit decks around
them. A keyword that is not here is reported, never passed over in silence.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Place = Literal["model", "step", "any"]


@dataclass(frozen=True)
class Keyword:
    """Form of one keyword.

    Attributes
    ----------
    place : str
        ``model`` (before the first step), ``step`` (inside one) or ``any``.
    required, optional : frozenset of str
        Parameter names.
    values : dict of str to tuple of str
        Parameters whose values are a closed list.
    fields : tuple of int or None
        Least and most fields of a data line; None where this depends on more than the keyword.
    lines : tuple of int
        Least and most data lines (the most may be -1: any number).
    numeric : bool
        Whether every field of a data line is a number.
    parents : tuple of str
        Keywords one of which must precede it directly, options of theirs aside.
    """

    place: Place
    required: frozenset[str]
    optional: frozenset[str]
    values: dict[str, tuple[str, ...]]
    fields: tuple[int, int] | None
    lines: tuple[int, int]
    numeric: bool
    parents: tuple[str, ...] = ()


def _keyword(
    place: Place,
    parameters: str = "",
    fields: tuple[int, int] | None = None,
    lines: tuple[int, int] = (0, -1),
    numeric: bool = False,
    parents: str = "",
    **values: str,
) -> Keyword:
    """Build an entry; in `parameters` a trailing ``!`` marks a required one, ``;`` separates."""
    names = [name.strip() for name in parameters.split(";") if name.strip()]
    required = frozenset(name[:-1] for name in names if name.endswith("!"))
    return Keyword(
        place,
        required,
        frozenset(name.rstrip("!") for name in names) - required,
        {name.replace("_", " "): tuple(value.strip() for value in text.split("|")) for name, text in values.items()},
        fields,
        lines,
        numeric,
        tuple(name.strip() for name in parents.split(";") if name.strip()),
    )


NONE = (0, 0)
SOME = (1, -1)
ONE = (1, 1)
YES_NO = "YES|NO"
OP = "MOD|NEW"

KEYWORDS: dict[str, Keyword] = {
    # the deck itself
    "HEADING": _keyword("model", "UNSYMM"),
    "PREPRINT": _keyword("model", "ECHO; MODEL; HISTORY; CONTACT; PARSUBSTITUTION; PARVALUES", NONE, NONE),
    "PARAMETER": _keyword("model", "DEPENDENT; TABLE"),
    "RESTART": _keyword("any", "WRITE; READ; NUMBER INTERVAL; TIME MARKS; OVERLAY; FREQUENCY; STEP; INTERVAL"),
    "PHYSICAL CONSTANTS": _keyword(
        "model", "ABSOLUTE ZERO; STEFAN BOLTZMANN; UNIVERSAL GAS CONSTANT; ACOUSTIC WAVE FORMULATION", NONE, NONE
    ),
    # mesh and sets
    "NODE": _keyword("model", "NSET; SYSTEM; INPUT", (1, 7), SOME, numeric=True, SYSTEM="R|C|S"),
    "ELEMENT": _keyword("model", "TYPE!; ELSET; INPUT; OFFSET; SOLID ELEMENT NUMBERING", (2, 28), SOME, numeric=True),
    "NSET": _keyword("model", "NSET!; GENERATE; ELSET; UNSORTED; INSTANCE; INTERNAL; SURFACE", (1, 16)),
    "ELSET": _keyword("model", "ELSET!; GENERATE; INSTANCE; INTERNAL; UNSORTED", (1, 16)),
    "NCOPY": _keyword("model", "CHANGE NUMBER!; OLD SET!; NEW SET; SHIFT; REFLECT; POLE; MULTIPLE"),
    "ELCOPY": _keyword("model", "ELEMENT SHIFT!; OLD SET!; SHIFT NODES!; NEW SET; REFLECT"),
    "NGEN": _keyword("model", "NSET; LINE; SYSTEM", (2, 9)),
    "NFILL": _keyword("model", "NSET; BIAS; SINGULAR; TWO STEP", (2, 4)),
    "ELGEN": _keyword("model", "ELSET; ALL NODES", (2, 10), SOME, numeric=True),
    "TRANSFORM": _keyword("model", "NSET!; TYPE", (6, 6), ONE, numeric=True, TYPE="R|C|S"),
    "ORIENTATION": _keyword("model", "NAME!; DEFINITION; SYSTEM; LOCAL DIRECTIONS"),
    "SURFACE": _keyword(
        "model",
        "NAME!; TYPE; COMBINE; CROP; FILLET RADIUS; INTERNAL; REGION TYPE; TRIM; MAX RATIO; NO OFFSET; NO THICK; SCALE THICK",
        TYPE="ELEMENT|NODE|CYLINDER|REVOLUTION|SEGMENTS|USER|CUTTING SURFACE|EULERIAN MATERIAL",
    ),
    "TIE": _keyword(
        "model",
        "NAME!; ADJUST; CONSTRAINT RATIO; NO ROTATION; NO THICKNESS; POSITION TOLERANCE; TIED NSET; TYPE; CYCLIC SYMMETRY",
        (2, 4),
        SOME,
        ADJUST=YES_NO,
        TYPE="NODE TO SURFACE|SURFACE TO SURFACE",
    ),
    "EQUATION": _keyword("model", "INPUT"),
    "MPC": _keyword("model", "INPUT; MODE; USER"),
    "COUPLING": _keyword("model", "CONSTRAINT NAME!; REF NODE!; SURFACE!; INFLUENCE RADIUS; ORIENTATION; ALPHA"),
    "KINEMATIC": _keyword("model", "", (0, 2), (0, -1), parents="COUPLING"),
    "DISTRIBUTING": _keyword("model", "COUPLING; WEIGHTING METHOD", parents="COUPLING"),
    "PART": _keyword("model", "NAME!; INTERNAL", NONE, NONE),
    "END PART": _keyword("model", "", NONE, NONE),
    "ASSEMBLY": _keyword("model", "NAME!", NONE, NONE),
    "END ASSEMBLY": _keyword("model", "", NONE, NONE),
    "INSTANCE": _keyword("model", "NAME; PART; LIBRARY; INSTANCE"),
    "END INSTANCE": _keyword("model", "", NONE, NONE),
    # sections and point elements
    "SOLID SECTION": _keyword(
        "model",
        "ELSET!; MATERIAL; COMPOSITE; CONTROLS; ORIENTATION; REF NODE; STACK DIRECTION; LAYUP; SYMMETRIC; ORDER; POISSON",
        (0, 4),
    ),
    "SHELL SECTION": _keyword(
        "model",
        "ELSET!; MATERIAL; COMPOSITE; CONTROLS; DENSITY; OFFSET; ORIENTATION; POISSON; SECTION INTEGRATION; NODAL THICKNESS; SHELL THICKNESS; THICKNESS MODULUS; STACK DIRECTION; TEMPERATURE; SYMMETRIC; BULK VISCOSITY",
    ),
    "MEMBRANE SECTION": _keyword("model", "ELSET!; MATERIAL!; CONTROLS; MEMBRANE THICKNESS; NODAL THICKNESS; ORIENTATION; POISSON"),
    "SECTION CONTROLS": _keyword(
        "model",
        "NAME!; HOURGLASS; KINEMATIC SPLIT; SECOND ORDER ACCURACY; DISTORTION CONTROL; LENGTH RATIO; ELEMENT DELETION; MAX DEGRADATION; VISCOSITY; WEIGHT FACTOR; DRILL STIFFNESS; INITIAL GAP OPENING; RAMP INITIAL STRESS; ELEMENT CONVERSION",
        (0, 6),
        (0, 1),
        numeric=True,
        HOURGLASS="COMBINED|ENHANCED|RELAX STIFFNESS|STIFFNESS|VISCOUS|ENHANCED",
        KINEMATIC_SPLIT="AVERAGE STRAIN|CENTROID|ORTHOGONAL",
        SECOND_ORDER_ACCURACY=YES_NO,
        DISTORTION_CONTROL=YES_NO,
        ELEMENT_DELETION=YES_NO,
    ),
    "MASS": _keyword("model", "ELSET!; ALPHA; COMPOSITE; ORIENTATION; TYPE", (1, 3), ONE, numeric=True),
    "ROTARY INERTIA": _keyword("model", "ELSET!; ALPHA; COMPOSITE; ORIENTATION", (3, 6), ONE, numeric=True),
    "RIGID BODY": _keyword(
        "model",
        "REF NODE!; ELSET; TIE NSET; PIN NSET; ANALYTICAL SURFACE; POSITION; ISOTHERMAL; DENSITY; NODAL THICKNESS; OFFSET",
        (0, 1),
        (0, 1),
        POSITION="INPUT|CENTER OF MASS",
        ISOTHERMAL=YES_NO,
    ),
    "FIXED MASS SCALING": _keyword(
        "any", "FACTOR; DT; TYPE; ELSET", NONE, NONE, TYPE="UNIFORM|BELOW MIN|SET EQUAL DT"
    ),
    "VARIABLE MASS SCALING": _keyword(
        "step", "TYPE; DT; ELSET; FREQUENCY; NUMBER INTERVAL; CROSS SECTION NODES; EXTRUDED LENGTH; FEED RATE", NONE, NONE
    ),
    # materials
    "MATERIAL": _keyword("model", "NAME!; RTOL; SRATE FACTOR; STRAIN RATE REGULARIZATION; DESCRIPTION", NONE, NONE),
    "DENSITY": _keyword("model", "DEPENDENCIES; PORE FLUID", (1, 8), SOME, numeric=True, parents="MATERIAL"),
    "ELASTIC": _keyword(
        "model",
        "TYPE; MODULI; DEPENDENCIES; COMPRESSION FACTOR",
        (1, 8),
        SOME,
        numeric=True,
        parents="MATERIAL",
        MODULI="INSTANTANEOUS|LONG TERM",
        TYPE="ISOTROPIC|ENGINEERING CONSTANTS|LAMINA|ORTHOTROPIC|ANISOTROPIC|TRACTION|SHEAR|COUPLED TRACTION|SHORT FIBER|BILAMINA",
    ),
    "HYPERELASTIC": _keyword(
        "model",
        "MOONEY-RIVLIN; NEO HOOKE; NEO HOOKEAN; OGDEN; YEOH; ARRUDA-BOYCE; VAN DER WAALS; REDUCED POLYNOMIAL; POLYNOMIAL; MARLOW; USER; N; MODULI; POISSON; TEST DATA INPUT; BETA; DEPENDENCIES; PROPERTIES; TYPE",
        parents="MATERIAL",
        MODULI="INSTANTANEOUS|LONG TERM",
    ),
    "HYPERFOAM": _keyword("model", "N; MODULI; POISSON; TEST DATA INPUT", parents="MATERIAL"),
    "VISCOELASTIC": _keyword(
        "model",
        "TIME; FREQUENCY; ERRTOL; NMAX; TYPE; NETWORKID; PRELOAD; SIGMAP",
        (1, 8),
        parents="MATERIAL",
        numeric=True,
        TIME="PRONY|CREEP TEST DATA|RELAXATION TEST DATA|FREQUENCY DATA",
        FREQUENCY="FORMULA|TABULAR|PRONY|CREEP TEST DATA|RELAXATION TEST DATA",
        TYPE="ISOTROPIC|TRACTION",
    ),
    "TRS": _keyword(
        "model",
        "DEFINITION; PROPERTIES; DEPENDENCIES",
        (3, 8),
        ONE,
        numeric=True,
        parents="VISCOELASTIC",
        DEFINITION="WLF|ARRHENIUS|USER|TABULAR",
    ),
    "SHEAR TEST DATA": _keyword("model", "SHRINF", parents="VISCOELASTIC"),
    "VOLUMETRIC TEST DATA": _keyword("model", "VOLINF", parents="VISCOELASTIC"),
    "COMBINED TEST DATA": _keyword("model", "SHRINF; VOLINF", parents="VISCOELASTIC"),
    "PLASTIC": _keyword("model", "HARDENING; RATE; DEPENDENCIES; PROPERTIES; SCALESTRESS; DATA TYPE", parents="MATERIAL"),
    "DAMPING": _keyword("any", "ALPHA; BETA; COMPOSITE; STRUCTURAL; BETA TYPE", (0, 8)),
    "EXPANSION": _keyword("model", "TYPE; ZERO; DEPENDENCIES; FIELD; USER; PORE FLUID", parents="MATERIAL"),
    "CONDUCTIVITY": _keyword("model", "TYPE; DEPENDENCIES; PORE FLUID", parents="MATERIAL"),
    "SPECIFIC HEAT": _keyword("model", "DEPENDENCIES; PORE FLUID; CONSTANT VOLUME", parents="MATERIAL"),
    "DEPVAR": _keyword("model", "DELETE; CONVERT ELEMENT", (1, 3), SOME, parents="MATERIAL"),
    "USER MATERIAL": _keyword(
        "model", "CONSTANTS!; TYPE; UNSYMM; EFFMOD; HYBRID FORMULATION; PROPERTIES", parents="MATERIAL"
    ),
    # amplitudes, conditions, loads
    "AMPLITUDE": _keyword(
        "any",
        "NAME!; DEFINITION; TIME; VALUE; SMOOTH; INPUT; FIXED INTERVAL; BEGIN; BASELINE; VARIABLES; PROPERTIES; SCALEX; SCALEY; SHIFTX; SHIFTY",
        (1, 8),
        DEFINITION="TABULAR|EQUALLY SPACED|PERIODIC|MODULATED|DECAY|SMOOTH STEP|SOLUTION DEPENDENT|BUBBLE|USER|ACTUATOR|PSD",
        TIME="STEP TIME|TOTAL TIME",
        VALUE="RELATIVE|ABSOLUTE",
    ),
    "INITIAL CONDITIONS": _keyword(
        "model",
        "TYPE!; INPUT; USER; FILE; STEP; INC; GEOSTATIC; UNBALANCED STRESS; VARIABLE; DEFINITION; NORMAL",
        TYPE="TEMPERATURE|VELOCITY|ROTATING VELOCITY|STRESS|FIELD|HARDENING|SOLUTION|PRESSURE STRESS|SPECIFIC ENERGY|MASS FLOW RATE|CONTACT|ACOUSTIC STATIC PRESSURE",
    ),
    "BOUNDARY": _keyword(
        "any",
        "TYPE; AMPLITUDE; OP; USER; FIXED; LOAD CASE; REGION TYPE; SUBMODEL; STEP; INC; TIMESCALE; BLOCKING",
        (2, 4),
        TYPE="DISPLACEMENT|VELOCITY|ACCELERATION",
        OP=OP,
        REGION_TYPE="LAGRANGIAN|SLIDING|EULERIAN",
    ),
    "CLOAD": _keyword("step", "AMPLITUDE; OP; FOLLOWER; REGION TYPE; LOAD CASE; USER", (3, 3), OP=OP),
    "DLOAD": _keyword("step", "AMPLITUDE; OP; ORIENTATION; FOLLOWER; CONSTANT RESULTANT; REGION TYPE; LOAD CASE", (2, 12), OP=OP),
    "DSLOAD": _keyword("step", "AMPLITUDE; OP; ORIENTATION; FOLLOWER; CONSTANT RESULTANT; REF NODE; LOAD CASE", (2, 12), OP=OP),
    "TEMPERATURE": _keyword("step", "AMPLITUDE; OP; FILE; INPUT; USER; BSTEP; BINC; ESTEP; EINC; INTERPOLATE; MIDSIDE", (2, 8), OP=OP),
    # contact
    "SURFACE INTERACTION": _keyword("model", "NAME!; DEPVAR; PROPERTIES; USER; UNSYMM; PAD THICKNESS; TRACKING THICKNESS", (0, 8)),
    "FRICTION": _keyword(
        "any",
        "USER; DEPVAR; PROPERTIES; ELASTIC SLIP; SLIP TOLERANCE; TAUMAX; LAGRANGE; ROUGH; ANISOTROPIC; EXPONENTIAL DECAY; DEPENDENCIES; RATE DEPENDENT; SHEAR TRACTION SLOPE; TEST DATA; COEFFICIENT",
        (0, 8),
        numeric=True,
        parents="SURFACE INTERACTION; CHANGE FRICTION; GAP; CONNECTOR FRICTION",
        USER="FRIC|FRICTION|COEFFICIENT",
    ),
    "SURFACE BEHAVIOR": _keyword(
        "any",
        "PRESSURE-OVERCLOSURE; NO SEPARATION; AUGMENTED LAGRANGE; DIRECT; PENALTY; HARD",
        (0, 4),
        parents="SURFACE INTERACTION",
        PRESSURE_OVERCLOSURE="HARD|EXPONENTIAL|LINEAR|TABULAR|SCALE FACTOR",
    ),
    "CONTACT DAMPING": _keyword("model", "DEFINITION; TANGENT FRACTION", (1, 4), parents="SURFACE INTERACTION"),
    "CONTACT PAIR": _keyword(
        "any",
        "INTERACTION; MECHANICAL CONSTRAINT; CPSET; OP; WEIGHT; SMALL SLIDING; TYPE; ADJUST; HCRIT; TIED; EXTENSION ZONE; GEOMETRIC CORRECTION; NO THICKNESS; SMOOTH; MINIMUM DISTANCE; SUPPLEMENTARY CONSTRAINTS",
        (1, 4),
        SOME,
        MECHANICAL_CONSTRAINT="KINEMATIC|PENALTY",
        OP="ADD|DELETE",
    ),
    "CONTACT": _keyword("any", "OP", NONE, NONE, OP=OP),
    "CONTACT INCLUSIONS": _keyword("any", "ALL EXTERIOR; ALL ELEMENT BASED; HISTORY", (0, 2), parents="CONTACT"),
    "CONTACT EXCLUSIONS": _keyword("any", "HISTORY", (0, 2), parents="CONTACT"),
    "CONTACT PROPERTY ASSIGNMENT": _keyword("any", "", (2, 4), SOME, parents="CONTACT"),
    "CONTACT CONTROLS": _keyword(
        "step",
        "CPSET; RESET; FASTLOCALTRK; GLOBTRKINC; SCALE PENALTY; WARP CHECK PERIOD; WARP CUT OFF; MASTER; SLAVE; STABILIZE",
        (0, 8),
    ),
    "CONTACT CONTROLS ASSIGNMENT": _keyword("any", "TYPE; ROTATIONAL TERMS; NODAL EROSION; AUTOMATIC OVERCLOSURE RESOLUTION", (0, 4), parents="CONTACT"),
    "CLEARANCE": _keyword("model", "CPSET; VALUE; TABULAR; MASTER; SLAVE; INPUT; BOLT"),
    "CHANGE FRICTION": _keyword("step", "INTERACTION; ELSET; RESET; AMPLITUDE", NONE, NONE),
    # steps
    "STEP": _keyword(
        "any",
        "NAME; NLGEOM; INC; PERTURBATION; AMPLITUDE; UNSYMM; CONVERT SDI; EXTRAPOLATION; SOLVER",
        None,
        NLGEOM=YES_NO,
        AMPLITUDE="STEP|RAMP",
    ),
    "END STEP": _keyword("step", "", NONE, NONE),
    "DYNAMIC": _keyword(
        "step",
        "EXPLICIT; DIRECT USER CONTROL; ELEMENT BY ELEMENT; FIXED TIME INCREMENTATION; SCALE FACTOR; ADIABATIC; IMPROVED DT METHOD; APPLICATION; ALPHA; BETA; GAMMA; HAFTOL; HALFINC SCALE FACTOR; INITIAL; NOHAF; DIRECT; SINGULAR MASS; SUBSPACE; IMPACT; INCREMENTATION; TIME INTEGRATOR",
        (1, 4),
        (0, 1),
    ),
    "STATIC": _keyword("step", "ADIABATIC; ALLSDTOL; CONTINUE; DIRECT; FACTOR; FULLY PLASTIC; LONG TERM; RIKS; STABILIZE", (0, 8), (0, 1)),
    "FREQUENCY": _keyword("step", "EIGENSOLVER; NORMALIZATION; NUMBER INTERVAL; RESIDUAL MODES; ACOUSTIC COUPLING", (0, 7)),
    "VISCO": _keyword("step", "CETOL; CREEP; FACTOR; STABILIZE; CONTINUE; ALLSDTOL", (0, 4), (0, 1)),
    "BULK VISCOSITY": _keyword("step", "", (0, 2), (0, 1), numeric=True),
    "CONTROLS": _keyword("step", "ANALYSIS; PARAMETERS; RESET; FIELD; TYPE"),
    # output
    "OUTPUT": _keyword(
        "step",
        "FIELD; HISTORY; DIAGNOSTICS; OP; TIME INTERVAL; NUMBER INTERVAL; FREQUENCY; TIME MARKS; TIME POINTS; VARIABLE; NAME; FILTER; SENSOR; MODE LIST",
        NONE,
        NONE,
        OP="ADD|NEW|REPLACE",
        VARIABLE="ALL|PRESELECT",
        TIME_MARKS=YES_NO,
    ),
    "NODE OUTPUT": _keyword("step", "NSET; VARIABLE; EXTERIOR; TRACER SET", None, parents="OUTPUT"),
    "ELEMENT OUTPUT": _keyword(
        "step", "ELSET; VARIABLE; DIRECTIONS; POSITION; SECTION POINTS; EXTERIOR; REBAR; AVERAGE REGION", None, parents="OUTPUT"
    ),
    "CONTACT OUTPUT": _keyword("step", "CPSET; NSET; MASTER; SLAVE; SURFACE; SECOND SURFACE; GENERAL CONTACT; VARIABLE", None, parents="OUTPUT"),
    "ENERGY OUTPUT": _keyword("step", "ELSET; VARIABLE; PER ELEMENT SET; PER SECTION", None, parents="OUTPUT"),
    "INCREMENTATION OUTPUT": _keyword("step", "VARIABLE", None, parents="OUTPUT"),
    "INTEGRATED OUTPUT": _keyword("step", "ELSET; SECTION; SURFACE; VARIABLE", None, parents="OUTPUT"),
    "FILE OUTPUT": _keyword("step", "NUMBER INTERVAL; TIME MARKS", NONE, NONE),
    "NODE FILE": _keyword("step", "NSET; FREQUENCY; GLOBAL; LAST MODE; MODE"),
    "EL FILE": _keyword("step", "ELSET; FREQUENCY; POSITION; DIRECTIONS; LAST MODE; MODE; REBAR"),
    "ENERGY FILE": _keyword("step", "ELSET; FREQUENCY"),
    "NODE PRINT": _keyword("step", "NSET; FREQUENCY; GLOBAL; SUMMARY; TOTALS; LAST MODE; MODE"),
    "EL PRINT": _keyword("step", "ELSET; FREQUENCY; POSITION; SUMMARY; TOTALS; LAST MODE; MODE; REBAR"),
    "MONITOR": _keyword("step", "NODE!; DOF!; FREQUENCY", NONE, NONE),
}  # fmt: skip

ELEMENT_NODES = {
    "C3D4": 4, "C3D6": 6, "C3D8": 8, "C3D8R": 8, "C3D8I": 8, "C3D8H": 8, "C3D8RH": 8, "C3D8T": 8, "C3D8RT": 8,
    "C3D10": 10, "C3D10M": 10, "C3D20": 20, "C3D20R": 20, "R3D3": 3, "R3D4": 4, "S3R": 3, "S4": 4, "S4R": 4,
    "M3D3": 3, "M3D4": 4, "M3D4R": 4, "SFM3D3": 3, "SFM3D4": 4, "SFM3D4R": 4, "CPE4R": 4, "CPS4R": 4, "CAX4R": 4,
    "T3D2": 2, "B31": 2, "MASS": 1, "ROTARYI": 1, "SPRINGA": 2, "DASHPOTA": 2, "CONN3D2": 2,
}  # fmt: skip
"""Nodes of each known element type."""

HEXAHEDRA = frozenset({"C3D8", "C3D8R", "C3D8I", "C3D8H", "C3D8RH", "C3D8T", "C3D8RT"})
SECTIONLESS = frozenset({"R3D3", "R3D4", "MASS", "ROTARYI", "SPRINGA", "DASHPOTA", "CONN3D2"})
SECTION_KEYWORDS = frozenset({"SOLID SECTION", "SHELL SECTION", "MEMBRANE SECTION"})
STANDARD_ONLY = frozenset({"STATIC", "FREQUENCY", "VISCO", "CONTROLS", "NODE PRINT", "EL PRINT", "CLEARANCE_STANDARD"})
FACES = {"C3D4": 4, "C3D6": 5, "C3D10": 4, "C3D10M": 4, "R3D3": 0, "R3D4": 0}
"""Faces S1.. of solid elements other than hexahedra (6)."""
