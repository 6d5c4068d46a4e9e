"""The paper's springs in a host's hands: on a prescribed path they are the pass, element by element."""

from dataclasses import replace

import numpy as np
import pytest

import tread_validate as tv
from tread_validate.geometry import path_of
from tread_validate.spring.block_pass import prepare
from tread_validate.spring.element_record import PRESSURE, SHEAR

RIG = "rig-rectangle-22c-0p2mm-300rpm"
BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"


def stepped(case, ready, steps, parts=1):
    """Forces (steps + 1, 2) at the pass's own nodes from t = 0 on, each of its steps taken in so many parts."""
    path = path_of(case)
    block = tv.TreadBlock(case, "paper")
    middle, time = 0.5 * path.columns.extent, ready.step / parts * np.arange(-parts, parts * steps + 1)
    at, points = path.at(middle, time), path.at(middle - block.mount_points, time[:, None])
    speed = path.speed * (1.0 + case.creep_ratio)
    forces = np.zeros((time.size, 2))
    for k in range(time.size):
        mount = None if case.path.family == "rig" else np.column_stack([points.x[k], points.y[k], points.theta[k]])
        if k == 0:
            block.start((at.x[0], at.y[0]), at.theta[0], mount)
        else:
            forces[k] = block.step(ready.step / parts, (at.x[k], at.y[k]), at.theta[k], speed, mount)
    return forces[parts::parts]


def by_elements(case, ready, steps):
    """Forces of the pass, the kernel's history of every element shifted by its time of arrival."""
    edges, middles = ready.elements()
    areas = ready.path.profile.cell_areas(edges)
    record, _ = ready.element(case.creep_ratio)
    forces = np.zeros((steps + 1, 2))
    for area, s in zip(areas, middles, strict=True):
        late = round(float(ready.path.columns.arc_offset(s)) / (ready.path.speed * ready.step))
        own = record[: steps + 1 - late]
        forces[late : late + own.shape[0]] += area * own[:, [PRESSURE, SHEAR]] * [1.0, -1.0]
    return forces


def test_a_flat_block_on_the_rig_is_the_pass(study_cases):
    """Its pass is the sum over elements: to 1e-6 of the peak."""
    case = study_cases[RIG]
    case = replace(case, block=case.block.model_copy(update={"mounting": "flat"}))
    ready = prepare(case)
    expected = ready.forces(case.creep_ratio)
    found = stepped(case, ready, expected.shape[0] - 1)
    peak = expected[:, 0].max()
    assert np.abs(found[:, 0] - expected[:, 0]).max() < 1e-6 * peak
    assert np.abs(found[:, 1] + expected[:, 1]).max() < 1e-6 * peak


@pytest.mark.parametrize(("name", "parts"), [(RIG, 1), (BELT, 2)])
def test_a_prescribed_path_gives_the_pass_of_every_element(name, parts, study_cases):
    """Elements of half a millimetre, with the pass's steps: to 1e-6 of the peak. Poses do not say where the belt's arcs
    end within a step: of second order in the step, 2.4e-6 with the pass's own, so that half of it is taken."""
    case = study_cases[name]
    ready = prepare(case)
    steps = ready.block_nodes - 1
    found, expected = stepped(case, ready, steps, parts), by_elements(case, ready, steps)
    peak = expected[:, 0].max()
    assert np.abs(found - expected).max() < 1e-6 * peak
    limit = ready.forces(case.creep_ratio)
    assert np.abs(found[:, 0].max() / limit[:, 0].max() - 1.0) < 1e-3
