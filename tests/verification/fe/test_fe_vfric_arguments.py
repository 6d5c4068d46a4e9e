"""Every argument of VFRIC means what its documentation says, seen from inside the routine."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.errors import InputError

# A routine that answers with an impossible force, so that the run stops, as soon as one argument is not what it should.
CHECKS = """      good = 1.d0
      if (nDir.ne.3 .or. nFricDir.ne.2 .or. nProps.ne.2) good = 0.d0
      if (nStateVar.ne.2 .or. nTemp.ne.1 .or. nPred.ne.0) good = 0.d0
      if (lContType.ne.1 .or. nContact.gt.nSlvNod) good = 0.d0
      if (kStep.ne.1 .or. kInc.lt.1) good = 0.d0
      if (surfInt(1:6).ne.'TOUCH ') good = 0.d0
      if (surfSlv(1:5).ne.'FACE ') good = 0.d0
      if (surfMst(1:5).ne.'ROAD ') good = 0.d0
      if (dTimCur.le.0.d0 .or. timStep.lt.dTimCur*0.99d0) good = 0.d0
      if (abs(timGlb-timStep).gt.1.d-12) good = 0.d0
      n = jConSlvid(k)
      if (n.lt.1 .or. n.gt.nSlvNod) good = 0.d0
      if (jSlvUid(n).lt.1 .or. jSlvUid(n).gt.20) good = 0.d0
      if (jMstUid(1).ne.900001) good = 0.d0
      if (abs(coordSlv(3,n)).gt.1.d-9) good = 0.d0
      if (abs(coordMst(3,1)).gt.1.d-12) good = 0.d0
      if (abs(tempSlv(k)-55.d0).gt.1.d-12) good = 0.d0
      if (abs(dircosN(3,k)-1.d0).gt.1.d-12) good = 0.d0
      dot = 0.d0
      one = 0.d0
      slip = 0.d0
      prev = 0.d0
      do 20 i = 1, 3
      dot = dot + dircosN(i,k)*dirCosSl(i,k)
      one = one + dirCosSl(i,k)**2
      slip = slip + dSlipFric(i,k)*dircosN(i,k)
   20 prev = prev + fTangPrev(i,k)**2
      if (abs(dot).gt.1.d-12 .or. abs(one-1.d0).gt.1.d-12) good = 0.d0
      if (abs(slip).gt.1.d-12) good = 0.d0
      if (abs(sqrt(prev)-statev(1,n)).gt.1.d-9*(1.d0+sqrt(prev)))
     & good = 0.d0
      total = 0.d0
      do 30 i = 1, nSlvNod
   30 total = total + areaSlv(i)
      if (abs(total/props(2)-1.d0).gt.0.02d0) good = 0.d0
      if (fNormal(k).le.0.d0 .or. fStickForce(k).lt.0.d0) good = 0.d0
      f = min(props(1)*fNormal(k), fStickForce(k))
      fTangential(1,k) = -f
      if (good.lt.0.5d0) fTangential(1,k) = 1.d30
      statev(1,n) = f
      statev(2,n) = statev(2,n) + v*dTimCur"""


def deck(fe: ModuleType, area: float) -> str:
    """A block pressed on a plane that then slides under it at 1000 mm/s."""
    block = fe.brick(4, 3, 2, 4.0, 3.0, 2.0)
    friction = fe.user_friction(0.3, area).replace("USER=FRIC", "USER=FRIC, DEPVAR=2")
    text = (
        block.text() + fe.elastic(20.0, 0.3) + fe.plane() + friction
        + "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 1e-4, 1.\n*BOUNDARY\nROADREF, 2, 6\nTOP, 1, 2\n"
        + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 55.\n*INITIAL CONDITIONS, TYPE=VELOCITY\nROADREF, 1, 1000.\n"
        + fe.step(6e-4, "*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, -0.02\n",
                  "*BOUNDARY, TYPE=VELOCITY\nROADREF, 1, 1, 1000.\n", fe.CONTACT)
    )  # fmt: skip
    # short increments: the slip of the increment in which a node first touches is in no sum
    return text.replace("*DYNAMIC, EXPLICIT", "*DYNAMIC, EXPLICIT, SCALE FACTOR=0.5")


def test_arguments_of_vfric_mean_what_their_documentation_says(tmp_path: Path, fe: ModuleType) -> None:
    """The run goes through only if all checks inside the routine hold; its state variables carry over.

    statev(2) sums the slip: once all slides, (path of the road) less what the block gives way in shear; 5 %.
    """
    simulation = fe.run(tmp_path, deck(fe, 12.0), CHECKS)
    slipped = simulation.pairs[0].arguments.arrays["statev"][:, 1]
    assert slipped.mean() == pytest.approx(1000.0 * 6e-4, rel=0.05)
    assert min(simulation.samples.slipping[50:]) == 1.0
    force = np.linalg.norm(simulation.pairs[0].pair.force, axis=2)
    assert force[:, 0].min() > 0.0
    assert force[:, 1] == pytest.approx(0.3 * force[:, 0], rel=1e-9)


def test_a_check_inside_the_routine_that_fails_stops_the_run(tmp_path: Path, fe: ModuleType) -> None:
    """With another area as property the routine's own check fails: the test above can fail."""
    with pytest.raises(InputError, match="VFRIC"):
        fe.run(tmp_path, deck(fe, 13.0), CHECKS)
