"""Which inputs a published statement depends on: it is judged only where the study has the paper's."""

from __future__ import annotations

from .claim import AGREES, Computed, Evidence, judge
from .inputs import INPUTS

BLOCK = ("block_length", "block_width", "block_height")
RUBBER = ("wlf_c1", "wlf_c2", "glass_transition", "poissons_ratio", "static_friction")
BELT = (
    *BLOCK, *RUBBER, "tyre_temperature", "belt_speed", "belt_compression", "simplified_profile_length", "edge_radius",
)  # fmt: skip
# the paper's regressions leave its largest interference out, so that one is not needed
RIG = ("small_wheel_diameter", "rig_speed_low", "rig_speed_high", "rig_interference_low", "rig_temperature_high")
FIT = ("prony_terms", "band_low", "band_high")

NEEDS: dict[str, tuple[str, ...]] = {
    "band_low_at_60": ("wlf_c1", "wlf_c2", "glass_transition", "tyre_temperature", "band_low"),
    "band_high_at_60": ("wlf_c1", "wlf_c2", "glass_transition", "tyre_temperature", "band_high"),
    "average_modulus": FIT,
    "block_mass": BLOCK,
    "inertia_pressure": BLOCK,
    "inertia_acceleration": BLOCK,
    "belt_speed_kmh": ("belt_speed",),
    "unloaded_curvature": ("trace_pitch",),
    "largest_curvature": ("trace_pitch",),
    "edge_curvature": ("trace_pitch",),
    "spring_angle_below": BELT,
    "linear_model_stress_limit": (*BELT, *RIG),
}
RIG_STATEMENTS = ("rig_", "table1_", "fe_error_", "force_falls", "tangential_force_falls", "speed_", "temperature_",
                  "shape_effect")  # fmt: skip
PRINTED = ("typical_",)  # arithmetic on printed numbers alone


def needs(claim_id: str) -> tuple[str, ...]:
    """Return the published inputs that a statement depends on, by their own names; none for an input itself."""
    if claim_id in INPUTS or claim_id.startswith(PRINTED):
        return ()
    return NEEDS.get(claim_id) or (RIG if claim_id.startswith(RIG_STATEMENTS) else BELT)


def differing_inputs(evidence: Evidence, claim_id: str) -> tuple[str, ...]:
    """Return, in words, the inputs that a statement needs and that the study has otherwise; none where all are alike.

    An input that the study does not have at all (no rig, no belt) is none that differs: then there is no run either.
    """
    found = []
    for name in needs(claim_id):
        published = evidence.published.get(name)
        if published is None:
            continue
        computed = INPUTS[name](evidence, "study")
        if computed.value is None:
            if computed.status == "undefined":
                found.append(f"{published.quantity}: {computed.note}")
            continue
        if judge(published, "input", "study", computed).assessment != AGREES:
            printed = published.value if published.value is not None else published.low
            found.append(f"{published.quantity} {computed.value:g}, published {printed:g} {published.unit}")
    return tuple(found)


def not_applicable(differing: tuple[str, ...], computed: Computed) -> Computed:
    """Return a computed value that is shown and not judged."""
    note = "not applicable, inputs differ: " + "; ".join(differing)
    return Computed(computed.value, computed.case_ids, "not_applicable", note, computed.assumed, "cannot tell")
