"""The condensed body of blocks with blind sipes and drafted walls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.spring.condensed.body import BodySettings, FreeShape, make_body
from tread_validate.spring.condensed.condense import condense
from tread_validate.spring.stiffness import static_ratios
from tread_validate.study import Block

SETTINGS = BodySettings(2e-3, 5, 1.5)


def block(**changes: Any) -> Block:
    plain = {"origin": "assumed", "source": "test", "shape": "rectangle", "length_mm": 24.0, "width_mm": 18.0,
             "height_mm": 8.0, "mounting": "flat"}  # fmt: skip
    return Block.model_validate({**plain, **changes})


def test_the_deeper_a_sipe_the_softer_the_block() -> None:
    """From none over 2, 5 and 7 mm to a cut through: normal and shear stiffness fall all the way."""
    found = []
    for depth in (0.0, 2.0, 5.0, 7.0, None):
        sipes = [] if depth == 0.0 else [{"position_mm": 11.7, "width_mm": 0.6, "depth_mm": depth}]
        body = make_body(block(sipes=sipes), FreeShape(), SETTINGS)
        assert body.area.sum() * 2.0 == pytest.approx(18e-3 * (24e-3 - (0.6e-3 if sipes else 0.0)))
        ratios = static_ratios(body, condense(body, 0.47), 0.47, 8e-3)  # stiffness over E A/h, A the face
        found.append(body.area.sum() * np.array([ratios.normal, ratios.shear]))
    assert np.all(np.diff(found, axis=0) < 0.0)


def test_a_draft_keeps_the_face_widens_the_mount_and_stiffens_the_block() -> None:
    plain, drafted = (make_body(block(draft_deg=angle), FreeShape(), SETTINGS) for angle in (0.0, 8.0))
    np.testing.assert_allclose(plain.face, drafted.face, atol=1e-15)
    grown = 8e-3 * np.tan(np.radians(8.0))
    assert np.ptp(drafted.mount_along) == pytest.approx(24e-3 + 2 * grown)
    shapes = drafted.mount_shapes().reshape(drafted.nodes_per_layer, 3, 2, -1)
    np.testing.assert_allclose(shapes[:, 0, 0] @ drafted.knots, drafted.mount_along, atol=1e-12)
    ratios = [static_ratios(body, condense(body, 0.47), 0.47, 8e-3) for body in (plain, drafted)]
    assert ratios[1].normal > 1.05 * ratios[0].normal


def test_a_mesh_file_is_refused_by_name() -> None:
    with pytest.raises(InputError, match="mine"):
        make_body(block(mesh="mine.vtu"), FreeShape(), SETTINGS)
