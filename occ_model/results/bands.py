"""Results of how deep the bars of a picture are, and of what shows none."""

from dataclasses import dataclass

from occ_model.arrays import FloatArray
from occ_model.scene.scene import Scene

BARELY = 0.01
"""Depth, peak to peak over the mean, below which a picture counts as without bars."""


@dataclass(frozen=True, slots=True)
class Depth:
    """How far something swings, relative to its mean over all starts of an exposure."""

    peak_to_peak: float  # Largest less smallest value
    rms: float  # Root mean square of the deviation from the mean


@dataclass(frozen=True, slots=True)
class BandDepth:
    """Depth of the bars in the picture of a scene.

    Parameters
    ----------
    light
        Depth of the light of an exposure, before the tone curve.
    pixel
        Depth of the pixel values, after the tone curve, saturation and the full well.
    frequency
        Of the strongest part of the light that an exposure leaves, in Hz; 0 for none.
    period
        Columns from one bar of that part to the next, as the columns sample it; infinite where
        there are no bars or all columns see the same.
    contrast
        Depth, peak to peak, of the picture on a display of exponent 2.2.
    threshold
        Contrast from which bars of this period are seen.
    """

    light: Depth
    pixel: Depth
    frequency: float
    period: float
    contrast: float
    threshold: float

    @property
    def peak_to_peak(self) -> float:
        """Largest less smallest light of an exposure, relative to its mean."""
        return self.light.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the light's deviation, relative to its mean."""
        return self.light.rms

    @property
    def is_visible(self) -> bool:
        """Whether the bars are seen, by the threshold."""
        return self.contrast > self.threshold


@dataclass(frozen=True, slots=True)
class SpeedDepth:
    """Depth of the bars at a shutter speed that is written on cameras."""

    name: str  # As it is written on the camera, such as 1/125 s
    # The time that is written, and that of a camera whose speeds are powers of two, in seconds
    nominal: float
    real: float
    # Peak to peak depth of the light at each
    at_nominal: float
    at_real: float

    @property
    def is_free(self) -> bool:
        """Whether there are no bars, whichever of both times the camera keeps."""
        return max(self.at_nominal, self.at_real) < BARELY

    @property
    def is_doubtful(self) -> bool:
        """Whether it depends on the time that the camera keeps."""
        return not self.is_free and min(self.at_nominal, self.at_real) < BARELY


@dataclass(frozen=True, slots=True)
class BandAdvice:
    """What shows no bars: exposures at the scene's frequency, frequencies at its exposure.

    Parameters
    ----------
    limit
        Depth, peak to peak, below which there are no bars.
    valley
        Exposure in seconds whose whole multiples show no bars of the code at all.
    exposures, frequencies
        Ranges from first to last in s and Hz in which the depth is below the limit, in order; those
        below ``all_exposures`` and ``all_frequencies``, and the scene's own frequency or exposure.
    all_exposures, all_frequencies
        From where on every one is below the limit; None for nowhere.
    speeds
        The usual shutter speeds, longest first.
    """

    limit: float
    valley: float
    exposures: tuple[tuple[float, float], ...]
    all_exposures: float | None
    frequencies: tuple[tuple[float, float], ...]
    all_frequencies: float | None
    speeds: tuple[SpeedDepth, ...]


@dataclass(frozen=True, eq=False, slots=True)
class DepthMap:
    """Least depth of the bars over frequency and exposure, both in even steps of logarithms."""

    # Shapes (n + 1,), (m + 1,): ends of the cells, in Hz and s
    frequencies: FloatArray
    exposures: FloatArray
    # Shape (n, m): least depth within the exposures of each cell, at its middle frequency
    least: FloatArray
    period: int  # Chips after which the code repeats: bars vanish at whole multiples of it


@dataclass(frozen=True, eq=False, slots=True)
class RiskLines:
    """The lines of IEEE 1789-2015 over the frequencies that they divide, each with its end."""

    # Shape (n, 2): corners: frequency in Hz, modulation in percent
    no_effect: FloatArray
    low_risk: FloatArray


@dataclass(frozen=True, eq=False, slots=True)
class EyeFlicker:
    """Measures of how a lamp's light flickers for the eye.

    Parameters
    ----------
    percent_flicker
        100 (largest - smallest) / (largest + smallest).
    flicker_index
        Area of a period above the mean, relative to the whole area.
    visibility
        Stroboscopic visibility measure SVM; at 1 half of the observers see the effect.
    frequency
        How often the light repeats, in Hz.
    frequencies, modulations : ndarray of float64, shape (n,)
        Of the sines that it consists of, up to where IEEE 1789-2015 has no line any more: in Hz,
        and amplitude over mean in percent.
    risk, parts_risk
        "no effect", "low risk" or "above low risk" by the lines of IEEE 1789-2015: of the percent
        flicker at the frequency of repetition, and of each of the sines.
    """

    percent_flicker: float
    flicker_index: float
    visibility: float
    frequency: float
    frequencies: FloatArray
    modulations: FloatArray
    risk: str
    parts_risk: str


@dataclass(frozen=True, slots=True)
class ShutterSpeed:
    """A shutter speed."""

    name: str  # As it is written on the camera
    # The time that is written, and the one that is kept where speeds are powers of two, in s
    nominal: float
    real: float


@dataclass(frozen=True, slots=True)
class Cure:
    """What takes the bars out of a picture."""

    # How often the lamp's light repeats, in Hz: bars vanish at whole multiples of one over it
    repeats: float
    duty: float  # Share of the time in which the lamp is lit
    # Least and largest peak to peak depth of the bars that the lamp's own light, without that of
    # others, has now: within two standard deviations of the exposure
    depth: tuple[float, float]
    # The shortest usual shutter speeds that show no bars, at most two: as they are written, and
    # also at the power of two that many cameras keep. Counted for sharp edges, and so for all.
    speeds: tuple[ShutterSpeed, ...]
    kept: tuple[ShutterSpeed, ...]
    scene: Scene  # With the shortest of them, or the shortest exposure without bars of the lamp
