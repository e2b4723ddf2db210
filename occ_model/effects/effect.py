"""The interface of an effect: something that the paper's model leaves out.

An effect belongs to one stage of the light's way from the panel to the file. It says whether a
scene has it (``is_present``) and how much leaving it out can change what is observed (``bound``),
and simulates it (``apply``).
"""

from abc import ABC, abstractmethod
from typing import ClassVar, Literal, TypeAlias, TypeVar

from occ_model.arrays import ByteArray, FloatArray, Pixels
from occ_model.camera.optics import Optics
from occ_model.camera.photometry import WHITE, ColumnLight
from occ_model.effects.paper_view import PaperView
from occ_model.results.plan import Stage
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import Observable

Kind: TypeAlias = Literal["column", "noise", "image"]
"""Whether an effect leaves all rows alike, alike but for independent noise, or not alike."""

Values = TypeVar("Values", FloatArray, Pixels)
"""Pixel values of either precision."""

ROUNDING = 1.0
"""Most grey levels by which rounding can enlarge a difference of two values."""


class Effect(ABC):
    """An effect, of whatever stage."""

    name: ClassVar[str]
    """The identifier, as in a plan."""

    label: ClassVar[str]
    """The field's term for it, as on screen."""

    kind: ClassVar[Kind]
    """How it leaves the rows of a picture."""

    stage: ClassVar[Stage]
    """Where on the light's way it happens."""

    parameters: ClassVar[tuple[str, ...]]
    """The parameters of a scene that it depends on, by name."""

    @abstractmethod
    def is_present(self, scene: Scene) -> bool:
        """Return whether a scene has the effect; where not, it is exactly nothing."""

    def bound(self, view: PaperView, observable: Observable) -> float:
        """Return the most by which leaving the effect out can change what is observed.

        Parameters
        ----------
        view
            The paper's view of the scene.
        observable
            ``"image"``: the camera's pixels of the panel's bounding rectangle; ``"profile"``: the
            means of its columns, both before rounding; ``"signal"``: the means of its columns after
            rounding and the receiver's enhancement, which a decoder reads.

        Returns
        -------
        float
            Root mean square in grey levels of the observable; never too small, whichever other
            effects are there. 0 where the scene does not have the effect.
        """
        if not self.is_present(view.scene):
            return 0.0
        if observable != "signal":
            return self._bound(view, observable)
        if view.scene.model.enhancement == "none":
            return min(self._bound(view, "profile") + ROUNDING, WHITE)
        return WHITE

    @abstractmethod
    def _bound(self, view: PaperView, observable: Observable) -> float:
        """Return the bound in the image or the profile for a scene that has the effect."""


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
    """Whether every picture that the camera takes has the same noise."""

    @abstractmethod
    def spread(self, scene: Scene, values: FloatArray) -> FloatArray:
        """Return the standard deviation in grey levels of pixels with these mean values."""


class FileEffect(Effect):
    """An effect of the file that the picture is kept in."""

    kind = "image"
    stage = "processing"

    @abstractmethod
    def apply(self, scene: Scene, image: ByteArray) -> ByteArray:
        """Return the picture as it is read back from the file.

        Rows of whole blocks, eight rows each, give the same as they do in a larger picture.
        """

    @abstractmethod
    def check_size(self, scene: Scene, shape: tuple[int, ...]) -> None:
        """Refuse a picture that the file cannot hold.

        Raises
        ------
        ParameterError
            Naming its size, and what is allowed.
        """

    @abstractmethod
    def rounding_of_means(self, scene: Scene) -> tuple[float, float]:
        """Return what the file's rounding adds to a column's mean over one block, in grey levels.

        Its standard deviation, if the block's coefficients lie anywhere between their steps, and
        the most that it can be, root mean square over the columns.
        """

    @abstractmethod
    def propagated_change(self, view: PaperView, change: float, dithered: bool) -> float:
        """Return the most by which a change of the picture can change what is read back.

        Rounding makes steps of the smallest changes: the output can differ by more than the input
        does.

        Parameters
        ----------
        view
            The paper's view of the scene.
        change
            Root mean square of the change in grey levels.
        dithered
            Whether noise spreads the pixels over the steps. The result is then an expectation,
            from which a single picture differs by its sampling error; without noise it is the
            largest value.
        """
