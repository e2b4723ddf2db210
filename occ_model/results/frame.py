"""A simulated picture, and the plan of the effects with which it was simulated."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, Protocol, TypeAlias

from occ_model.arrays import ByteArray, FloatArray
from occ_model.scene.argument_checks import check_choice
from occ_model.scene.scene import Observable, Scene, unit_of

# In the order of the light's path
Stage: TypeAlias = Literal["light", "optics", "sensor", "processing"]


@dataclass(frozen=True, slots=True)
class Decision:
    """The decision of a plan on one effect.

    Parameters
    ----------
    label
        The effect's usual name in the field.
    kind
        ``"column"``: all rows of the panel stay equal; ``"noise"``: equal except for independent
        noise; ``"image"``: rows differ.
    estimate
        Estimated change of the observable without the effect, RMS in levels of the stretched
        profile, with a safety margin; 0 if the scene does not have the effect. For the observable
        ``"decision"`` it is in decision margins: at 1 a chip could be misread.
    limit
        Upper bound of the change, estimated from a sample, which is compared with the tolerance;
        infinite if no bound is known.
    forced
        Whether the user has decided on the effect.
    why
        The reason in a few words.
    reason
        The reason as a sentence with the estimate and the decision.
    """

    effect: str
    label: str
    kind: str
    stage: Stage
    estimate: float
    limit: float
    included: bool
    forced: bool
    why: str
    reason: str


@dataclass(frozen=True, slots=True)
class EffectSet:
    """A set of simulated effects, with its time and error."""

    effects: frozenset[str]  # The simulated ones among the scene's effects
    seconds: float  # Time of a picture, as measured on one computer
    error: float  # Combined change by the omitted effects, as in Plan


@dataclass(frozen=True, slots=True)
class Plan:
    """The effects that are simulated, and why.

    Parameters
    ----------
    tolerance
        Allowed change of the observable by all omitted effects, in levels of the stretched profile.
    decisions
        One for each effect, in the order of the light path.
    left_out
        Combined change of the effects that the plan (not the user) omits, at most the tolerance.
    error
        Combined change of all effects omitted by the plan or the user; infinite if unknown, NaN for
        a plan without estimates.
    stretch
        Levels of the stretched profile per grey level.
    saved
        Seconds saved for each picture by the omitted effects, as measured on one computer.
    effect_sets
        The Pareto front of sets of effects in time and error, fastest first.
    """

    tolerance: float
    observable: Observable
    decisions: tuple[Decision, ...]
    left_out: float
    error: float
    stretch: float
    saved: float = 0.0
    effect_sets: tuple[EffectSet, ...] = field(default=(), repr=False)

    def __contains__(self, effect: object) -> bool:
        return any(d.effect == effect and d.included for d in self.decisions)

    @property
    def unit(self) -> str:
        """The unit of the tolerance, of estimates and of errors."""
        return unit_of(self.observable)

    @property
    def included(self) -> tuple[str, ...]:
        """The names of the effects that are simulated."""
        return tuple(d.effect for d in self.decisions if d.included)

    @property
    def kinds(self) -> frozenset[str]:
        """The kinds of the effects that are simulated."""
        return frozenset(d.kind for d in self.decisions if d.included)

    def __str__(self) -> str:
        return "\n".join(f"{d.label}: {d.reason}" for d in self.decisions)


PICTURES = ("camera", "receiver")  # as the camera takes it, and as the receiver enhances it

ENHANCED = "Receiver's picture, enhanced by "
"""Start of an enhanced picture's title, also in its file; the enhancement's name follows."""


class PicturePair(Protocol):
    """A picture as the camera takes it, and as the receiver enhances it, with column means.

    All are as :class:`Frame` has them; some are made when they are first asked for.
    """

    @property
    def camera_image(self) -> ByteArray: ...

    @property
    def image(self) -> ByteArray: ...

    @property
    def profile(self) -> FloatArray: ...

    @property
    def signal(self) -> FloatArray: ...


@dataclass(frozen=True, eq=False)
class Frame:
    """A simulated picture with its scene, plan and profile.

    There are two pictures: the receiver enhances the contrast on the panel in the camera's picture,
    and decodes the result.

    Parameters
    ----------
    plan
        The effects simulated, with reasons.
    rows
        The rows of the picture that are in ``image``: all, those that show the panel, or every k-th
        in a draft, which a view draws k rows high.
    corners : ndarray of float64, shape (4, 2)
        The panel's corners in order, each as (column, row).
    timings
        Seconds of each stage in the order of computation; effects are stages with their names.
        Where the receiver's picture is made when it is first asked for, its time counts from then.
    pictures
        The picture, as the camera takes it and as the receiver enhances it.
    """

    scene: Scene
    plan: Plan
    rows: range
    corners: FloatArray
    timings: Mapping[str, float]
    pictures: PicturePair = field(repr=False)

    @property
    def rows_step(self) -> int:
        """Rows of the picture for each row of ``image``; more than 1 in a draft."""
        return self.rows.step

    @property
    def image(self) -> ByteArray:
        """The receiver's picture with the scene's enhancement, which is decoded.

        An ndarray of uint8, shape (number of ``rows``, columns).
        """
        return self.pictures.image

    @property
    def camera_image(self) -> ByteArray:
        """The camera's picture, before the receiver's enhancement, shape as ``image``."""
        return self.pictures.camera_image

    @property
    def profile(self) -> FloatArray:
        """Mean of the panel's pixels in each column, in grey levels; shape (columns,).

        It is that before enhancement and rounding, but after compression if a file is simulated.
        With column effects only, it is the column's value PV_sim, also outside the panel.
        """
        return self.pictures.profile

    @property
    def signal(self) -> FloatArray:
        """Mean of the panel's pixels in each column of the receiver's picture; shape (columns,).

        This is the decoder's input, in grey levels. With column effects only, it is the enhanced
        value, also outside the panel.
        """
        return self.pictures.signal

    def picture(self, picture_kind: str) -> ByteArray:
        """Return the picture of the ``"camera"`` or the ``"receiver"``.

        Raises
        ------
        ParameterError
            There is no such picture.
        """
        check_choice("picture", picture_kind, PICTURES)
        return self.camera_image if picture_kind == "camera" else self.image

    def picture_title(self, picture_kind: str) -> str:
        """Return the title of a picture, with the receiver's enhancement."""
        if picture_kind == "camera":
            return "Camera's picture"
        enhancement = self.scene.model.enhancement
        is_enhanced = enhancement != "none"
        return ENHANCED + enhancement if is_enhanced else "Receiver's picture, not enhanced"
