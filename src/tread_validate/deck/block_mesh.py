"""What the mesh of a block is, in coordinates that belong to the block alone.

A node is named by its distance `s` behind the leading corner (along the contact face), its height fraction `u`
(0 on the contact face, 1 at the mount) and its place `z` across the block. Where these lie in space is the business
of `placement`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def _none() -> IntArray:
    return np.zeros(0, dtype=np.int64)


@dataclass(frozen=True)
class BlockMesh:
    """Eight-node hexahedra that fill the block; sipes are gaps without elements.

    Attributes
    ----------
    s : (n,) array, mm
        Distance behind the first corner to touch, measured along the contact face; 0 .. length + skew on the face,
        a little beyond it where the walls have a draft.
    u : (n,) array
        Height fraction: 0 on the contact face, 1 at the mount.
    z : (n,) array, mm
        Place across the block, -width/2 .. width/2 on the face.
    elements : (m, 8) array of int
        Node indices from 0; the first four are the element's face towards the road, counter-clockwise seen from
        inside the element.
    face_nodes, mount_nodes : arrays of int
        Node indices on the contact face and at the mount.
    face_elements : array of int
        Elements whose face 1 lies on the contact face.
    symmetry_nodes : array of int
        Nodes on the plane z = 0 of a block of which only z >= 0 is meshed; empty for a whole block.
    """

    s: FloatArray
    u: FloatArray
    z: FloatArray
    elements: IntArray
    face_nodes: IntArray
    mount_nodes: IntArray
    face_elements: IntArray
    symmetry_nodes: IntArray = field(default_factory=_none)

    @property
    def span(self) -> float:
        """Extent of the face in the rolling direction, mm."""
        return float(self.s[self.face_nodes].max())


def finished(s: FloatArray, u: FloatArray, z: FloatArray, elements: IntArray) -> BlockMesh:
    """Return the mesh with its sets: what lies at u = 0 and u = 1."""
    return BlockMesh(
        s=s,
        u=u,
        z=z,
        elements=elements,
        face_nodes=np.flatnonzero(u == 0.0),
        mount_nodes=np.flatnonzero(u == 1.0),
        face_elements=np.flatnonzero(np.all(u[elements[:, :4]] == 0.0, axis=1)),
    )
