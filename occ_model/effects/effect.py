"""The interface of an effect: something that the paper's model leaves out.

An effect belongs to one stage of the light's way from the panel to the file. It determines whether
a scene has it (``is_present``), and simulates it (``apply``). How much leaving it out changes what
is observed follows from that, on a sample of the pixels: see :mod:`occ_model.effects.estimates`.
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
"""Whether an effect leaves all rows equal, equal but for independent noise, or different."""

Values = TypeVar("Values", FloatArray, Pixels)  # pixel values of either precision


@dataclass(frozen=True, slots=True)
class Cost:
    """Computing time of an effect: seconds for a picture, and for a million of its pixels."""

    picture: float = 0.0
    pixels: float = 0.0


class Effect(ABC):
    name: ClassVar[str]  # The identifier, as in a plan
    label: ClassVar[str]  # The field's term for it, as on screen
    kind: ClassVar[Kind]  # How it leaves the rows of a picture
    stage: ClassVar[Stage]  # Where on the light's way it happens
    parameters: ClassVar[tuple[str, ...]]  # The parameters of a scene that it depends on, by name

    cost: ClassVar[Cost] = Cost()
    """Its own computing time, as measured: see :mod:`occ_model.effects.effect_sets`."""

    @abstractmethod
    def is_present(self, scene: Scene) -> bool:
        """Return whether a scene has the effect; without it the effect changes exactly nothing."""


class LightEffect(Effect):
    """An effect on the light that reaches each column."""

    kind = "column"
    stage = "light"

    @abstractmethod
    def apply(self, scene: Scene, light: ColumnLight) -> ColumnLight:
        """Return the columns' light with the effect."""


class OpticsEffect(Effect):
    """An effect on how the lens pictures the panel."""

    kind = "image"
    stage = "optics"

    @abstractmethod
    def apply(self, scene: Scene, optics: Optics) -> Optics:
        """Return how the panel is pictured with the effect."""


class PixelEffect(Effect):
    """An effect on a pixel's mean value that depends on that value alone."""

    kind = "column"
    stage = "sensor"

    @abstractmethod
    def apply(self, scene: Scene, values: Values) -> Values:
        """Return pixel values before saturation with the effect."""


class NoiseEffect(Effect):
    """Noise that is independent from pixel to pixel, its mean zero."""

    kind = "noise"
    stage = "sensor"
    of_the_camera: ClassVar[bool] = False
    """Whether the noise is the same in every picture that the camera takes."""

    @abstractmethod
    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        """Return the standard deviation in grey levels of pixels with these mean values."""


class FileEffect(Effect):
    """An effect of the file that the picture is kept in."""

    kind = "image"
    stage = "processing"

    @abstractmethod
    def apply(self, scene: Scene, image: ByteArray) -> ByteArray:
        """Return the picture as read back; rows of whole 8-row blocks do not depend on others."""

    @abstractmethod
    def check_size(self, scene: Scene, shape: tuple[int, ...]) -> None:
        """Refuse a picture that the file cannot hold."""

    @abstractmethod
    def steps(self, scene: Scene) -> FloatArray:
        """Return the steps to which cosine coefficients of 8 x 8 pixels are rounded."""

    @abstractmethod
    def rounding_of_means(self, scene: Scene) -> tuple[float, float]:
        """Return what the file's rounding adds to a column's mean over one block, in grey levels.

        Its standard deviation, if the block's coefficients lie anywhere between their steps, and
        the most that it can be, root mean square over the columns.
        """
