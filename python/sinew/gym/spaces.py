"""Spaces of actions and observations with Gymnasium's interface, used if Gymnasium is not installed."""

from typing import Any, Optional, Tuple

import numpy
import numpy.typing


class Box:
    """Arrays between two bounds, like gymnasium.spaces.Box.

    low, high: arrays of the same shape, in the units of the bounded quantities.
    """

    def __init__(
        self,
        low: numpy.typing.ArrayLike,
        high: numpy.typing.ArrayLike,
        dtype: Any = numpy.float64,
    ) -> None:
        self.dtype = numpy.dtype(dtype)
        self.low = numpy.asarray(low, self.dtype)
        self.high = numpy.asarray(high, self.dtype)
        if self.low.shape != self.high.shape:
            raise ValueError(
                f"bounds: found shapes {self.low.shape} and {self.high.shape}; expected one shape"
            )
        self._random = numpy.random.default_rng()

    @property
    def shape(self) -> Tuple[int, ...]:
        """Shape of its arrays."""
        return self.low.shape

    def seed(self, seed: Optional[int] = None) -> None:
        """Restart the samples; the same seed gives the same samples."""
        self._random = numpy.random.default_rng(seed)

    def sample(self) -> "numpy.typing.NDArray[Any]":
        """Return an array from within the bounds, uniform; unbounded numbers are normal."""
        bounded = numpy.isfinite(self.low) & numpy.isfinite(self.high)
        low, high = numpy.where(bounded, self.low, 0), numpy.where(bounded, self.high, 1)
        uniform = self._random.uniform(low, high)
        normal = numpy.clip(self._random.standard_normal(self.shape), self.low, self.high)
        return numpy.where(bounded, uniform, normal).astype(self.dtype)

    def contains(self, x: Any) -> bool:
        """Return whether x is an array of this shape within the bounds."""
        x = numpy.asarray(x)
        if x.shape != self.shape or not numpy.can_cast(x.dtype, self.dtype, "same_kind"):
            return False
        return bool(numpy.all((x >= self.low) & (x <= self.high)))

    __contains__ = contains

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Box)
            and self.dtype == other.dtype
            and numpy.array_equal(self.low, other.low)
            and numpy.array_equal(self.high, other.high)
        )

    def __repr__(self) -> str:
        return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"


def box(low: numpy.typing.ArrayLike, high: numpy.typing.ArrayLike) -> Any:
    """Return Gymnasium's Box if Gymnasium is installed, else the Box of this module."""
    low, high = numpy.asarray(low, float), numpy.asarray(high, float)
    try:
        from gymnasium.spaces import Box as Theirs  # type: ignore[import]
    except ImportError:
        return Box(low, high)
    return Theirs(low, high, dtype=numpy.float64)
