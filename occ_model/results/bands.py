"""Results on the depth of a picture's bars, and on settings that avoid bars."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.errors import capitalize
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, PERCENT, SECOND

NO_BARS_DEPTH = 0.01  # peak-to-peak depth relative to the mean below which there are no bars

ROUNDING_DEPTH = 1e-9  # depth up to which bars are rounding errors


def format_depth(fraction: float) -> str:
    """Format a depth in percent; rounding errors become 0."""
    return PERCENT.format(fraction, 3) if fraction > ROUNDING_DEPTH else "0 %"


OF_MEAN_LIGHT = "of the mean light from dark to bright"  # what a depth is, which may exceed 100 %


def depth_text(fraction: float) -> str:
    """State the difference of the brightest and the darkest column."""
    return f"{format_depth(fraction)} {OF_MEAN_LIGHT}"


@dataclass(frozen=True, slots=True)
class Depth:
    """Modulation depth, relative to the mean over all starts of an exposure."""

    peak_to_peak: float  # Largest minus smallest value
    rms: float  # Root mean square of the deviation from the mean


@dataclass(frozen=True, slots=True)
class BandDepth:
    """Depth of the bars in a scene's light and in its picture.

    Parameters
    ----------
    light
        Depth of the light of an exposure over all its starts, before the tone curve.
    columns
        Depth of the light of the picture's columns, before the tone curve.
    pixel
        Depth of the columns' pixel values, after the tone curve, saturation and the full well, and
        without noise, by which columns of a few electrons are darker in the mean.
    frequency
        Frequency in Hz of the strongest component of the light that the columns show; 0 for none.
    period
        Columns from one bar of that component to the next, as the columns sample it; infinite if
        there are no bars or all columns receive the same light.
    contrast
        Peak-to-peak depth of the picture on a display of exponent 2.2.
    threshold
        Contrast from which bars of this period are visible.
    hidden
        What hides the light's bars in the picture, as a clause; empty if nothing does.
    """

    light: Depth
    columns: Depth
    pixel: Depth
    frequency: float
    period: float
    contrast: float
    threshold: float
    hidden: str = ""

    @property
    def peak_to_peak(self) -> float:
        """Largest minus smallest light of an exposure, relative to its mean."""
        return self.light.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the light's deviation, relative to its mean."""
        return self.light.rms

    @property
    def is_visible(self) -> bool:
        """Whether the picture's contrast exceeds the threshold of vision."""
        return self.contrast > self.threshold and not self.hidden

    @property
    def visibility(self) -> str:
        """Whether the picture's bars are visible, or what hides them, without numbers."""
        if self.hidden:
            return f"Not visible, since {self.hidden}."
        return f"{'Visible' if self.is_visible else 'Not visible'} on a display."

    @property
    def sentence(self) -> str:
        """Whether the picture's bars are visible, or what hides them."""
        if self.hidden:
            return self.visibility
        return (
            f"{self.visibility.removesuffix('.')}: "
            f"{depth_text(self.contrast)} there, and visible "
            f"from {format_depth(self.threshold)}."
        )


@dataclass(frozen=True, slots=True)
class ShutterSpeed:
    name: str  # As marked on the camera, such as 1/125 s
    # The marked time and that of a camera whose speeds are powers of two, in seconds
    nominal: float
    real: float


@dataclass(frozen=True, slots=True)
class SpeedDepth(ShutterSpeed):
    """Depth of the bars at a marked shutter speed."""

    # Peak-to-peak depth of the light at the marked time and at the other
    at_nominal: float
    at_real: float

    @property
    def is_free(self) -> bool:
        """Whether both times show no bars."""
        return max(self.at_nominal, self.at_real) < NO_BARS_DEPTH

    @property
    def is_doubtful(self) -> bool:
        """Whether only one of the two times shows no bars."""
        return not self.is_free and min(self.at_nominal, self.at_real) < NO_BARS_DEPTH

    @property
    def doubt(self) -> str:
        """A sentence if only a camera that uses the marked time shows no bars; else empty."""
        if not self.is_doubtful or self.at_nominal > self.at_real:
            return ""
        return (
            f"Many cameras keep {SECOND.format(self.real, 4)} for {self.name}, which shows bars of "
            f"{format_depth(self.at_real)}."
        )


@dataclass(frozen=True, slots=True)
class FrequencyAxis:
    """The frequency of a light that the user can vary."""

    parameter: str  # The parameter that sets it
    frequency: float  # Its value in the scene, in Hz
    label: str


@dataclass(frozen=True, slots=True)
class BandAdvice:
    """Exposures without bars at the scene's frequency, and frequencies at its exposure.

    Parameters
    ----------
    axis
        The frequency to which ``frequencies`` belong.
    limit
        Peak-to-peak depth below which there are no bars.
    valley, flicker_valley
        Exposures in seconds whose integer multiples show no bars of the lamp and of the
        surroundings' flicker; 0 if there are none at any exposure.
    exposures, frequencies
        Ranges in s and Hz with a depth below the limit, in increasing order, up to
        ``all_exposures`` and ``all_frequencies``.
    all_exposures, all_frequencies
        Values above which every depth is below the limit; None if there are none.
    speeds
        Usual shutter speeds, longest first.
    """

    axis: FrequencyAxis
    limit: float
    valley: float
    flicker_valley: float
    exposures: tuple[tuple[float, float], ...]
    all_exposures: float | None
    frequencies: tuple[tuple[float, float], ...]
    all_frequencies: float | None
    speeds: tuple[SpeedDepth, ...]

    @property
    def sentence(self) -> str:
        """The exposures at which the bars of the lamp and of the surroundings vanish."""
        vanishing_bars = [
            f"{bars} vanish at whole multiples of {SECOND.format(valley, 4)}"
            for bars, valley in (
                ("the lamp's bars", self.valley),
                ("the bars of the surroundings' flicker", self.flicker_valley),
            )
            if valley
        ]
        text = "; ".join(vanishing_bars) or "nothing blinks: no exposure shows bars"
        return f"{capitalize(text)}."


@dataclass(frozen=True, eq=False, slots=True)
class DepthMap:
    """Least depth of the bars over frequency and exposure, both in even steps of logarithms.

    If the light has levels between dark and lit, or many pieces, the depth is an upper bound.
    """

    axis: FrequencyAxis
    # Shapes (n + 1,), (m + 1,): ends of the cells, in Hz and s
    frequencies: FloatArray
    exposures: FloatArray
    # Shape (n, m): least depth within the exposures of each cell, at its middle frequency
    least: FloatArray
    # Cycles of the frequency after which the lamp's light repeats: bars vanish at integer multiples
    # of this time; 0 for steady light
    period: float


@dataclass(frozen=True, eq=False, slots=True)
class RiskLines:
    """The limit lines of IEEE 1789-2015 over frequency."""

    # Shape (n, 2): corners: frequency in Hz, modulation in percent
    no_effect: FloatArray
    low_risk: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class EyeFlicker:
    """Measures of a lamp's flicker for the eye.

    Parameters
    ----------
    percent_flicker
        100 (largest - smallest) / (largest + smallest).
    flicker_index
        Area of a period above the mean, relative to the whole area.
    visibility, visibility_2016
        Stroboscopic visibility measure SVM by the threshold of Perz (2018), and by that of CIE TN
        006:2016; at 1, half of the observers see the effect.
    frequency
        Repetition frequency of the light, in Hz.
    frequencies, modulations : ndarray of float64, shape (n,)
        The light's Fourier components up to the last limit of IEEE 1789-2015, only the strongest if
        there are very many: frequency in Hz, and amplitude over mean in percent.
    risk, parts_risk
        "no effect", "low risk" or "above low risk" by IEEE 1789-2015: of the percent flicker at the
        repetition frequency, and of the Fourier components.
    """

    percent_flicker: float
    flicker_index: float
    visibility: float
    visibility_2016: float
    frequency: float
    frequencies: FloatArray
    modulations: FloatArray
    risk: str
    parts_risk: str

    @property
    def _visibilities(self) -> str:
        """SVM by Perz (2018), and also by CIE TN 006 if only one of them exceeds 1."""
        text = f"{self.visibility:.3g} by Perz (2018)"
        if (self.visibility > 1.0) != (self.visibility_2016 > 1.0):
            text += f" and {self.visibility_2016:.3g} by CIE TN 006:2016"
        return text

    @property
    def sentences(self) -> tuple[str, ...]:
        """The measures in words, in one part or two."""
        if not self.percent_flicker:
            return ("For the eye: the lamp's light does not flicker.",)
        return (
            f"For the eye: percent flicker {self.percent_flicker:.3g} %, flicker index "
            f"{self.flicker_index:.3g}, SVM {self._visibilities} (1: half of the observers see "
            "it);",
            f"by IEEE 1789-2015: {self.risk} as a whole, repeated at "
            f"{HERTZ.format(self.frequency, 4)}; {self.parts_risk} by each of its sines.",
        )


@dataclass(frozen=True, slots=True)
class Cure:
    """Settings that remove the bars from a picture."""

    # Repetition frequency of the lamp's light in Hz, 0 if it is steady: bars vanish at integer
    # multiples of its inverse
    repetition_rate: float
    duty: float  # Fraction of the time in which the lamp is lit
    # Smallest and largest depth of the bars of the lamp's own light at present, within two standard
    # deviations of the exposure
    depth: tuple[float, float]
    # The shortest usual shutter speeds without bars, at most two: at the marked time, and also at
    # the power of two that many cameras use. Computed for sharp edges, the worst case.
    speeds: tuple[ShutterSpeed, ...]
    safe_speeds: tuple[ShutterSpeed, ...]
    scene: Scene  # With the shortest of them, or the lamp's shortest exposure without bars
