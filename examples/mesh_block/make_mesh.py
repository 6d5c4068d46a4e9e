"""Write block.vtu: a block of 12 x 10 x 6 mm as 720 hexahedra of 1 mm, the inner ones out of true; lengths in mm.

Usage: python make_mesh.py [FOLDER]
"""

import sys
from pathlib import Path

import meshio
import numpy as np

LENGTH, HEIGHT, WIDTH = 12, 6, 10


def main(folder: Path) -> None:
    """x towards the leading end, y away from the road, z across; inner nodes up to 0.12 mm off their grid."""
    x, y, z = np.meshgrid(np.arange(LENGTH + 1.0), np.arange(HEIGHT + 1.0), np.arange(WIDTH + 1.0), indexing="ij")
    inside = (x > 0) & (x < LENGTH) & (y > 0) & (y < HEIGHT) & (z > 0) & (z < WIDTH)
    moved = x + 0.12 * inside * np.sin(1.7 * y + z)
    points = np.stack([moved - LENGTH / 2, y, z - WIDTH / 2], axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(x.shape)
    low, high = slice(None, -1), slice(1, None)
    ring = ((low, low), (high, low), (high, high), (low, high))
    corners = [number[i, j, k] for k in (low, high) for i, j in ring]
    hexahedra = np.stack(corners, axis=-1).reshape(-1, 8)
    meshio.write(folder / "block.vtu", meshio.Mesh(points, [("hexahedron", hexahedra)]))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
