"""Combine the limits found by trial with those of theory."""

from occ_model.results.advice import Advice, TheoryLimits
from occ_model.results.limits import Limits
from occ_model.study import theory
from occ_model.study.cause import TWO_HEADERS


def advice_of(limits: Limits) -> Advice:
    """Return the limits found by trial together with those of theory."""
    scene, period = limits.scene, limits.scene.transmitter.switching_period
    reads_two = limits.decoder in TWO_HEADERS
    frequencies = TheoryLimits(
        band_model=theory.band_model_frequency(scene),
        null=theory.null_frequency(scene),
        two_packets=theory.two_packets_frequency(scene) if reads_two else None,
    )
    exposures = TheoryLimits(
        band_model=period, null=2.0 * period, saturation=theory.saturation_exposure(scene)
    )
    return Advice(limits, frequencies, exposures)
