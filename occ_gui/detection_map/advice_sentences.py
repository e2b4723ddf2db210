"""Advice in plain sentences."""

import math
from dataclasses import dataclass

from PySide6.QtCore import QObject

from occ_gui.detection_map.advice import Advice, TheoryNumbers
from occ_model.results import Limits, RangeEnd, Trial, WorkingRange
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND

_DIGITS = 4
"""Of an edge that is known to a few thousandths."""


@dataclass(frozen=True, slots=True)
class AdviceLine:
    """One sentence or two.

    Parameters
    ----------
    text
        What is said.
    destination
        Where it leads: a parameter, its value in SI units, and that value in words.
    is_title
        Whether it stands over what follows.
    """

    text: str
    destination: tuple[str, float, str] | None = None
    is_title: bool = False


class AdviceWords(QObject):
    """Says how far a decoder reaches."""

    def lines(self, advice: Advice) -> list[AdviceLine]:
        """Say it in a title and a few lines."""
        found, theory = advice.limits, advice.theory
        frequency, exposure = found.frequency, found.exposure
        lines = [AdviceLine(self._title(found), is_title=True)]
        if frequency.highest is None:
            lines.append(AdviceLine(frequency.failure or ""))
        else:
            text = self.tr("The highest frequency that it reads is {value}")
            lines.append(self._line(text, frequency, frequency.highest))
        lines.append(AdviceLine(self._theory_of_frequency(theory)))
        if exposure.lowest is None or exposure.highest is None:
            lines.append(AdviceLine(exposure.failure or ""))
        else:
            text = self.tr("The shortest exposure that it reads is {value}")
            lines.append(self._line(text, exposure, exposure.lowest))
            text = self.tr("The longest exposure that it reads is {value}")
            lines.append(self._line(text, exposure, exposure.highest))
        lines.append(AdviceLine(self._theory_of_exposure(theory)))
        lines.append(AdviceLine(self._how_sure(found)))
        return lines

    def _title(self, found: Limits) -> str:
        scene = found.scene
        return self.tr(
            "The {decoder} decoder, {rate:g} % of the bits, at {frequency}, {exposure}, {distance}"
        ).format(
            decoder=found.decoder,
            rate=found.rate,
            frequency=HERTZ.format(scene.transmitter.switching_frequency, _DIGITS),
            exposure=SECOND.format(scene.camera.exposure_time, _DIGITS),
            distance=_written("distance", scene.pose.distance),
        )

    def _line(self, text: str, working_range: WorkingRange, range_end: RangeEnd) -> AdviceLine:
        value = _written(working_range.parameter, range_end.value)
        ground = self.tr("there it read {counted}").format(counted=self._counted(range_end.works))
        if range_end.fails is None:
            beyond = self.tr("beyond it was not tried")
        else:
            beyond = self.tr("at {value} {counted}").format(
                value=_written(working_range.parameter, range_end.fails.value),
                counted=self._counted(range_end.fails),
            )
        sentence = f"{text.format(value=value)}: {ground}, {beyond}."
        return AdviceLine(sentence, (working_range.parameter, range_end.value, value))

    def _counted(self, trial: Trial) -> str:
        return self.tr("{right} of {sent} bits ({low:.1f} to {high:.1f} %)").format(
            right=trial.right, sent=trial.sent, low=trial.low, high=trial.high
        )

    def _theory_of_frequency(self, theory: TheoryNumbers) -> str:
        text = self.tr(
            "By theory the band model ends at {band} and an alternating pattern at {null}"
        ).format(
            band=HERTZ.format(theory.band_frequency, _DIGITS),
            null=HERTZ.format(theory.null_frequency, _DIGITS),
        )
        if theory.packets_frequency is not None:
            text += self.tr("; below {packets} no two packets fit the picture").format(
                packets=HERTZ.format(theory.packets_frequency, _DIGITS)
            )
        return f"{text}."

    def _theory_of_exposure(self, theory: TheoryNumbers) -> str:
        text = self.tr(
            "By theory the band model ends at {band} and an alternating pattern at {null}"
        ).format(
            band=SECOND.format(theory.band_exposure, _DIGITS),
            null=SECOND.format(theory.null_exposure, _DIGITS),
        )
        if math.isfinite(theory.saturation_exposure):
            text += self.tr("; from {white} what is lit throughout is white").format(
                white=SECOND.format(theory.saturation_exposure, _DIGITS)
            )
        return f"{text}."

    def _how_sure(self, found: Limits) -> str:
        return self.tr(
            "Each value was tried with {images} images; the intervals hold the rate in 95 of 100 "
            "cases if bits err independently of each other."
        ).format(images=found.images)


def _written(name: str, value: float) -> str:
    return quantity(name).format(value, _DIGITS)
