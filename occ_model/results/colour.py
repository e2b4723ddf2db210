"""A simulated picture of a colour camera, and what is read from one."""

from collections.abc import Mapping
from dataclasses import dataclass

from occ_model.arrays import ByteArray, FloatArray
from occ_model.results.decoding import DecodeResult, Region
from occ_model.results.frame import Plan
from occ_model.scene.parameters.colour import COLOURS
from occ_model.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class ColourFrame:
    """A simulated picture of a colour camera.

    Parameters
    ----------
    plan
        The effects simulated, with those of colour last in their stage.
    image : ndarray of uint8, shape (rows, columns, 3) or (rows, columns)
        Red, green and blue; or the raw mosaic, if it is not demosaiced.
    profiles : ndarray of float64, shape (3, columns)
        The column means of each channel on the panel, in grey levels. A raw mosaic has NaN in
        columns without pixels of the colour.
    region
        The panel's bounding rectangle.
    timings
        Seconds of each stage in the order of computation.
    """

    scene: Scene
    plan: Plan
    image: ByteArray
    profiles: FloatArray
    region: Region
    timings: Mapping[str, float]

    @property
    def title(self) -> str:
        """What the picture is, as a title."""
        return "Colour camera's picture" if self.image.ndim == 3 else "Colour camera's raw mosaic"


@dataclass(frozen=True, eq=False, slots=True)
class ColourReading:
    """What a picture's three colours say: of three codes, or of one packet of colours.

    Parameters
    ----------
    results
        The reading of each colour, red first; of colour shift keying, one reading of all.
    region
        The panel's place in the picture; None if none was found.
    """

    results: tuple[DecodeResult, ...]
    region: Region | None

    @property
    def is_read(self) -> bool:
        """Whether every colour was read."""
        return all(result.failure is None for result in self.results)

    @property
    def by_colour(self) -> dict[str, DecodeResult]:
        """The readings by colour; that of colour shift keying by "colours"."""
        names = COLOURS if len(self.results) == len(COLOURS) else ("colours",)
        return dict(zip(names, self.results, strict=True))

    @property
    def descriptions(self) -> dict[str, str]:
        """What each colour says, after its name: a code, a payload, or that it is not read."""
        return {name: f"{name} {_describe(result)}" for name, result in self.by_colour.items()}

    def __str__(self) -> str:
        return ", ".join(self.descriptions.values())


def _describe(result: DecodeResult) -> str:
    return "not read" if result.failure is not None else result.payload or str(result.code)
