"""The interface of an effect: something real that the paper's model lacks.

An effect belongs to one stage of the light's path from the panel to the file. It says whether a
scene has it (``is_present``), and simulates it (``apply``). :mod:`occ_model.effects.estimates`
applies it to a sample of the pixels, to estimate how much is lost without it.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias, TypeVar

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import ColumnLight
from occ_model.results.plan import Stage
from occ_model.scene.scene import Scene

Kind: TypeAlias = Literal["column", "noise", "image"]
"""Whether the rows stay equal, stay equal except for independent noise, or become different."""

Values = TypeVar("Values", FloatArray, Pixels)  # pixel values in double or in single precision


@dataclass(frozen=True, slots=True)
class Cost:
    """Computing time of an effect: seconds for a picture, and for a million of its pixels."""

    picture: float = 0.0
    pixels: float = 0.0


class Effect(ABC):
    name: ClassVar[str]  # Its identifier, as in a plan
    label: ClassVar[str]  # Its usual name in the field, as on screen
    kind: ClassVar[Kind]  # What it does to the rows of a picture
    stage: ClassVar[Stage]  # Where on the light's path it happens
    parameters: ClassVar[tuple[str, ...]]  # Names of the scene's parameters that it depends on

    cost: ClassVar[Cost] = Cost()
    """Its own computing time as measured; see :mod:`occ_model.effects.effect_sets`."""

    @abstractmethod
    def is_present(self, scene: Scene) -> bool:
        """Return whether a scene has the effect; if not, applying it changes exactly nothing."""


class LightEffect(Effect):
    """An effect on the light that reaches each column."""

    kind = "column"
    stage = "light"

    @abstractmethod
    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Add the effect to the columns' light."""


class OpticsEffect(Effect):
    """An effect of the lens on where and how bright the panel is in the picture."""

    kind = "image"
    stage = "optics"

    @abstractmethod
    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Add the effect to the panel's optics."""


class PixelEffect(Effect):
    """An effect on a pixel's mean value which depends on that value alone."""

    kind = "column"
    stage = "sensor"

    @abstractmethod
    def apply(self, scene: Scene, values: Values) -> Values:
        """Add the effect to pixel values before they saturate."""


class NoiseEffect(Effect):
    """Noise of mean zero, independent from pixel to pixel."""

    kind = "noise"
    stage = "sensor"
    of_the_camera: ClassVar[bool] = False
    """Whether the noise is the same in every picture of a camera."""

    @abstractmethod
    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        """Return the noise's standard deviation in grey levels at these mean values."""


class FileEffect(Effect):
    """An effect of the file in which the camera stores the picture."""

    kind = "image"
    stage = "processing"

    @abstractmethod
    def apply(self, scene: Scene, image: ByteArray) -> ByteArray:
        """Return the picture as read from the file; 8 rows of blocks depend on no others."""

    @abstractmethod
    def check_size(self, scene: Scene, shape: tuple[int, ...]) -> None:
        """Raise a ParameterError for a picture that the file cannot hold."""

    @abstractmethod
    def steps(self, scene: Scene) -> FloatArray:
        """Return the steps to which the cosine coefficients of 8 x 8 pixels are rounded."""

    @abstractmethod
    def rounding_of_means(self, scene: Scene) -> float:
        """Return the error of a column's mean over one block by rounding, in grey levels.

        It is the standard deviation for coefficients that lie anywhere between their steps with
        equal probability.
        """
