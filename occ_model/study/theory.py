"""Compute the limits of reading that follow from single equations, for comparison.

They ignore noise and decoders. They mark where the character of the picture changes, not where
reading stops: a matched decoder reads far beyond the null. Limits of chips refuse other lights.
"""

import math

import numpy as np

from occ_model.camera.photometry import WHITE, luminance_levels, luminance_of
from occ_model.camera.projection import panel_corners
from occ_model.effects.effect import region_of
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.scene.scene import Scene
from occ_model.transmitter.scheme import check_code, sent_chips

_BOUND_BINS = 2**14  # frequencies over which the bound of the rate is summed

_ASK_BANDS = "ask for its band model"
_ASK_BARS = "ask for its bars: they vanish where an exposure is a whole number of periods"


def band_model_frequency(scene: Scene) -> float:
    """Return the frequency in Hz above which the band model is undefined: t_LED = t, f = 1/t.

    Above it no column shows a single state: h_c = (t_LED - t) / t_r is negative (II.B).
    """
    check_code(scene.transmitter, _ASK_BANDS)
    return 1.0 / scene.camera.exposure_time


def null_frequency(scene: Scene) -> float:
    """Return the frequency in Hz at which an alternating pattern has no stripes: f = 2/t.

    An exposure of t = 2 t_LED collects the same light for any start. This is the first null of
    sinc(t f / 2), the exposure's response to the square wave's fundamental f/2.
    """
    check_code(scene.transmitter, _ASK_BARS)
    return 2.0 / scene.camera.exposure_time


def alternating_swing(scene: Scene) -> float:
    """Return the fraction of its full swing that alternating light keeps in the columns.

    It is 1 up to an exposure of one chip. In longer ones whole pairs of chips give the same light
    for any start, and only the remainder t mod 2 t_LED swings: min(c mod 2, 2 - c mod 2) / c
    with c = t / t_LED.
    """
    check_code(scene.transmitter, _ASK_BARS)
    chips = scene.camera.exposure_time * scene.transmitter.switching_frequency
    rest = math.fmod(chips, 2.0)
    return min(rest, 2.0 - rest) / chips


def panel_readout_time(scene: Scene) -> float:
    """Return the readout time in seconds of the columns that show the panel; 0 if none does."""
    camera = scene.camera
    region = region_of(panel_corners(scene), camera.rows, camera.columns)
    return 0.0 if region is None else region.columns * camera.readout_time


def is_panel_in_picture(scene: Scene) -> bool:
    """Return whether the panel's centre lies within the picture, even if the panel is tiny."""
    middle, size = panel_corners(scene).mean(axis=0), (scene.camera.columns, scene.camera.rows)
    return bool(np.all((middle >= 0.0) & (middle < size)))


def two_packets_frequency(scene: Scene) -> float | None:
    """Return the frequency in Hz below which no two packets fit the panel's image, or None.

    The readout of the columns that show the panel takes t_r times their number, and two packets of
    L chips last 2 L / f: f = 2 L / (t_r x columns). The paper's decoder needs two headers. A packet
    and a header can therefore suffice, but only two packets do so for any start of a packet.
    """
    check_code(scene.transmitter)
    readout = panel_readout_time(scene)
    return 2.0 * len(sent_chips(scene.transmitter)) / readout if readout else None


def row_rate_frequency(scene: Scene) -> float:
    """Return the highest frequency in Hz that columns can show: f = 1/(2 t_r), half the row rate.

    Anything faster appears as an alias. Chips that alternate at a switching frequency f have the
    frequency f/2, so the limit of f is 1/t_r.
    """
    return 1.0 / (2.0 * scene.camera.readout_time)


def gaussian_rate_bound(
    scene: Scene, signal_to_noise: float, frames_a_second: float = FRAMES_A_SECOND
) -> float:
    """Return an upper bound of the bits per second that light of Gaussian levels carries.

    C = fps N t_r x integral from 0 to 1/(2 t_r) of log2(1 + S(F) sinc^2(F t) / N_0) dF, with the
    light's power spectrum S water-filled: mu - N_0 / sinc^2(F t) where that is above 0, its
    integral the light's power (R. G. Gallager, Information Theory and Reliable Communication, 1968,
    section 8.3). fps N t_r is the fraction of time in which columns are read out; light in the gaps
    is lost. A lamp with two levels and a limited switching frequency carries less.
    ``signal_to_noise``: the variance of the light divided by that of a column's noise.
    """
    camera = scene.camera
    half_rate = row_rate_frequency(scene)
    # The middles of bins, because no light is transmitted at a null itself.
    frequencies = (np.arange(_BOUND_BINS) + 0.5) * (half_rate / _BOUND_BINS)
    transmitted = np.sinc(frequencies * camera.exposure_time) ** 2
    noise = 1.0 / half_rate  # spectral density of noise with the variance 1
    noise_levels = np.sort(noise / np.maximum(transmitted, np.finfo(float).tiny))
    # The level to which the whole power fills the k best frequencies, for each k.
    counts = np.arange(1, _BOUND_BINS + 1)
    fill_levels = (signal_to_noise * _BOUND_BINS / half_rate + np.cumsum(noise_levels)) / counts
    channels = int(np.count_nonzero(fill_levels > noise_levels))
    bits = (
        float(np.log2(fill_levels[channels - 1] / noise_levels[:channels]).sum())
        if channels
        else 0.0
    )
    seconds = frames_a_second * camera.columns * camera.readout_time
    return bits * half_rate / _BOUND_BINS * seconds


def saturation_exposure(scene: Scene) -> float:
    """Return the exposure in seconds at which the lit panel reaches the largest pixel value.

    The paper's equations (1) and (2) with PV_max = 255, solved for t: t = (255 / 118)^gamma K N^2 /
    (S (L_v + E_v R / pi)); infinite without light.
    """
    brightest = float(luminance_levels(scene)[1])
    if not brightest:
        return math.inf
    # White is a fixed product of luminance and exposure time.
    white = float(luminance_of(np.array([WHITE]), scene.camera)[0])
    return scene.camera.exposure_time * white / brightest
