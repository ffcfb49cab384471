"""Rendering of the machine as an image or a line of text, without an image library."""

import math
from typing import List, Tuple

import numpy
import numpy.typing

from sinew._sinew import Experiment, Simulation

Image = "numpy.typing.NDArray[numpy.uint8]"
_width, _height, _scale = 480, 320, 520.0  # pixels, and pixels per metre
_paper, _ink, _faint = (255, 255, 255), (38, 70, 110), (170, 170, 170)


class Drawing:
    """Drawing of a chain of links below a hip, like the thesis's leg; the view follows the hip.

    Raises ValueError for a robot with several legs.
    """

    def __init__(self, experiment: Experiment) -> None:
        values = experiment.to_dict()
        if any(key.startswith("leg.") for key in values):
            raise ValueError("render: found a robot with several legs; expected one chain of links")
        self._lengths = [
            float(v) for key, v in values.items() if key.startswith("link.") and key.endswith(".length")
        ]
        self._names = [
            key.split(".")[1]
            for key in values
            if key.startswith("joint.") and key.endswith(".rest_angle")
        ]
        self._ground = float(values["ground.height"]) if values.get("ground.present") else None
        rows, columns = numpy.mgrid[0:_height, 0:_width]
        self._x, self._y = columns + 0.5, rows + 0.5

    def points(self, simulation: Simulation) -> List[Tuple[float, float]]:
        """Return the positions of the joints and the foot relative to the hip, x and y [m]."""
        out, x, y, turned = [(0.0, 0.0)], 0.0, 0.0, 0.0
        for length, name in zip(self._lengths, self._names):
            turned += simulation.read(f"/true/joint/{name}/angle")
            x, y = x + length * math.cos(turned), y + length * math.sin(turned)
            out.append((x, y))
        return out

    def text(self, simulation: Simulation) -> str:
        """Return a line of text: time, angles, position of the foot."""
        x, y = self.points(simulation)[-1]
        angles = ", ".join(
            f"{name} {math.degrees(simulation.read(f'/true/joint/{name}/angle')):.1f} deg"
            for name in self._names
        )
        return f"{simulation.time:.2f} s: {angles}, foot at ({x:.3f}, {y:.3f}) m about the hip"

    def image(self, simulation: Simulation) -> "numpy.typing.NDArray[numpy.uint8]":
        """Return an image of 320 x 480 pixels, red, green and blue; one metre is 520 pixels."""
        image = numpy.full((_height, _width, 3), _paper, numpy.uint8)
        pixels = [(_width / 2 + _scale * x, 60 - _scale * y) for x, y in self.points(simulation)]
        if self._ground is not None:
            level = 60 - _scale * self._ground
            self._line(image, (0, level), (_width, level), 1.5, _faint)
            for x in self._marks(simulation):
                self._line(image, (x, level), (x, level + 8), 1.0, _faint)
        self._line(image, (pixels[0][0] - 40, 60), (pixels[0][0] + 40, 60), 8, _faint)
        for a, b in zip(pixels, pixels[1:]):
            self._line(image, a, b, 6, _ink)
        for x, y in pixels:
            self._line(image, (x, y), (x, y), 9, _ink)
        return image

    @staticmethod
    def _marks(simulation: Simulation) -> List[float]:
        """Return the positions of the marks on the ground, every 0.1 m [pixels]."""
        moved = _scale * simulation.read("/true/trolley/position")
        return [x for x in numpy.arange(-moved % (0.1 * _scale), _width, 0.1 * _scale)]

    def _line(
        self,
        image: "numpy.typing.NDArray[numpy.uint8]",
        a: Tuple[float, float],
        b: Tuple[float, float],
        half_width: float,
        colour: Tuple[int, int, int],
    ) -> None:
        dx, dy = b[0] - a[0], b[1] - a[1]
        square = dx * dx + dy * dy
        along = ((self._x - a[0]) * dx + (self._y - a[1]) * dy) / square if square > 0 else 0.0
        along = numpy.clip(along, 0.0, 1.0)
        distance = numpy.hypot(self._x - a[0] - along * dx, self._y - a[1] - along * dy)
        cover = numpy.clip(half_width + 0.5 - distance, 0.0, 1.0)[..., None]
        image[:] = numpy.round(image * (1 - cover) + numpy.asarray(colour) * cover)
