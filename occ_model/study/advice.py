"""Combine the limits found by trial with those of theory."""

from occ_model.results.advice import Advice, RangeFacts, TheoryLimits
from occ_model.results.limits import Limits
from occ_model.scene.scene import Scene
from occ_model.study import theory
from occ_model.study.cause import TWO_HEADERS


def advice_of(limits: Limits) -> Advice:
    """Return the limits found by trial together with those of theory."""
    scene = limits.scene
    return Advice(
        limits,
        RangeFacts(limits.frequency, _frequencies(scene, limits.decoder)),
        RangeFacts(limits.exposure, _exposures(scene)),
    )


def _frequencies(scene: Scene, decoder: str) -> TheoryLimits:
    return TheoryLimits(
        band_model=theory.band_model_frequency(scene),
        null=theory.null_frequency(scene),
        two_packets=theory.two_packets_frequency(scene) if decoder in TWO_HEADERS else None,
    )


def _exposures(scene: Scene) -> TheoryLimits:
    period = scene.transmitter.switching_period
    return TheoryLimits(
        band_model=period, null=2.0 * period, saturation=theory.saturation_exposure(scene)
    )
