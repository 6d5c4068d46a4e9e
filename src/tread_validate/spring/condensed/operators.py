"""Stiffness of parts of a face whose other nodes are free of force, made when a pass first asks for them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from .body import Body
from .condense import inverse
from .inputs import NO_FOLD, ROWS, FaceNodes, Integers, Singles, Windows
from .symmetry import folded, folds, image_of

Array = NDArray[np.float64]


class FaceOperators:
    """A condensed face ready for contact.

    A window is a run of cells of two rows. Its operator M is the inverse of the window's part of the compliance, that
    is the Schur complement of the stiffness: forces on the window's nodes = M q while all others are free.

    Attributes
    ----------
    nodes : FaceNodes
    windows : Windows
        Replaced when one is added.

    Parameters
    ----------
    body : Body
    stiffness : callable
        Returns the face's stiffness, (3 n, 3 n); asked for when the first window is made.
    compliance : callable, optional
        Returns its inverse.
    nodal : array, optional
        The same in single precision, where that is at hand.
    """

    def __init__(
        self,
        body: Body,
        stiffness: Callable[[], Array],
        compliance: Callable[[], Array] | None = None,
        nodal: Singles | None = None,
    ) -> None:
        self._make_stiffness = stiffness
        self._make_compliance = compliance or (lambda: inverse(stiffness()))
        row = rows_of(body)
        cells = int(row[-1]) // ROWS + 1
        first = np.searchsorted(row, ROWS * np.arange(cells + 1)).astype(np.int64)
        if nodal is None:
            nodal = self._compliance.astype(np.float32)
        self.nodes = FaceNodes(body.area, row, nodal)
        self.windows = Windows(
            first,
            np.full((cells, cells + 1), -1, dtype=np.int64),
            np.zeros(0, dtype=np.float32),
            *(folds(body) or (NO_FOLD, NO_FOLD)),
        )
        same = np.array_equal(first + first[::-1], np.full(first.size, first[-1]))
        self._image = image_of(self.windows.even, self.windows.odd) if same and self.windows.even.left.size else None
        self._used = 0

    @cached_property
    def _stiffness(self) -> Array:
        return self._make_stiffness()

    @cached_property
    def _compliance(self) -> Array:
        return self._make_compliance()

    @property
    def count(self) -> int:
        """Number of operators made so far."""
        return int(np.sum(self.windows.offset >= 0))

    def known(self) -> dict[str, Any]:
        """Return the operators made so far."""
        return {"offset": self.windows.offset, "pool": self.windows.pool[: self._used]}

    def learn(self, offset: Integers, pool: Singles) -> None:
        """Take over the operators that `known` returned."""
        self.windows = self.windows._replace(offset=offset, pool=pool)
        self._used = pool.size

    def add(self, a: int, b: int) -> None:
        """Make the operator of the cells a..b-1."""
        _, offset, pool, even, odd = self.windows
        whole = self._window(a, b)
        parts = [whole]
        if even.left.size + odd.left.size == whole.shape[0]:
            exact = self._stiffness
            parts += [folded(exact, even).astype(np.float32), folded(exact, odd).astype(np.float32)]
        made = np.concatenate([part.ravel() for part in parts])
        if self._used + made.size > pool.size:
            pool = np.concatenate([pool[: self._used], np.zeros(max(made.size, self._used), dtype=np.float32)])
        pool[self._used : self._used + made.size] = made
        offset[a, b] = self._used
        self._used += made.size
        self.windows = self.windows._replace(offset=offset, pool=pool)

    def _window(self, a: int, b: int) -> Singles:
        """Return the operator of the cells a..b-1; on the trailing half of a symmetric face that of its image."""
        first, cells = self.windows.first, self.windows.first.size - 1
        begin, end = 3 * int(first[a]), 3 * int(first[b])
        if self._image is None or a + b >= cells:
            return self._operator(begin, end).astype(np.float32)
        c, d = cells - b, cells - a
        at, size = int(self.windows.offset[c, d]), end - begin
        there = self.windows.pool[at : at + size**2].reshape(size, size) if at >= 0 else self._window(c, d)
        place, sign = (each[begin:end] for each in self._image)
        return np.asarray(there[np.ix_(place - 3 * first[c], place - 3 * first[c])] * sign[:, None] * sign)

    def _operator(self, begin: int, end: int) -> Array:
        whole = self._stiffness.shape[0]
        inside = slice(begin, end)
        if 2 * (end - begin) <= whole:
            return inverse(self._compliance[inside, inside])
        out = np.r_[0:begin, end:whole]
        if out.size == 0:
            return self._stiffness
        coupling = self._stiffness[out, inside]
        factor = cho_factor(self._stiffness[np.ix_(out, out)], lower=True, overwrite_a=True, check_finite=False)
        return np.asarray(
            self._stiffness[inside, inside] - coupling.T @ cho_solve(factor, coupling, check_finite=False)
        )


def rows_of(body: Body) -> Integers:
    """Return the row across the block that each node belongs to, 0 at the trailing end, (n,)."""
    pitch = float(np.diff(body.knots).mean())
    return np.asarray(np.round((body.along - body.along[0]) / pitch), dtype=np.int64)
