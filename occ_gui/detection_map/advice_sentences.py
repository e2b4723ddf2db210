"""Sentences of the advice: the limits of a decoder, found and theoretical, in words."""

import math
from dataclasses import dataclass

from PySide6.QtCore import QObject

from occ_model.results.advice import Advice, EndFacts, TheoryLimits
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.results.limits import Limits, Trial, WorkingRange
from occ_model.scene.parameters import quantity
from occ_model.scene.units import HERTZ, SECOND

_DIGITS = 4
"""Significant digits: the ends of a range are found to a few thousandths."""


@dataclass(frozen=True, slots=True)
class AdviceLine:
    """One line of the advice: a sentence or two.

    Parameters
    ----------
    destination
        The change that its button makes: a parameter, its value in SI units, and as text.
    is_common
        Whether it is the same for every decoder of a scene.
    """

    text: str
    destination: tuple[str, float, str] | None = None
    is_title: bool = False
    is_common: bool = False


class AdviceSentences(QObject):
    """Writes advice in translatable sentences."""

    frames_a_second = FRAMES_A_SECOND
    """Pictures a second by which bits a second are counted."""

    def lines(self, advice: Advice) -> list[AdviceLine]:
        """Write a title and a few lines on what was found."""
        ends = {
            ("switching_frequency", "lowest"): "The lowest frequency that it reads is {value}",
            ("switching_frequency", "highest"): "The highest frequency that it reads is {value}",
            ("exposure_time", "lowest"): "The shortest exposure that it reads is {value}",
            ("exposure_time", "highest"): "The longest exposure that it reads is {value}",
        }
        lines = [AdviceLine(self._title(advice.limits), is_title=True)]
        for facts, theory in (
            (advice.frequency, self._theory_of_frequency(advice.frequency.theory)),
            (advice.exposure, self._theory_of_exposure(advice.exposure.theory)),
        ):
            if not facts.ends:
                lines.append(AdviceLine(self._nowhere(advice.limits, facts.found)))
            lines.extend(
                self._line(ends[end.parameter, end.side], end)
                for end in facts.ends
                if (end.parameter, end.side) in ends
            )
            if facts.found.gaps:
                lines.append(AdviceLine(self.gaps(facts.found)))
            if facts.found.most_chips is not None:
                lines.append(AdviceLine(self.searched_to(facts.found)))
            if facts.theory.two_packets is not None:
                lines.append(AdviceLine(self._two_packets(facts.theory.two_packets)))
            lines.append(AdviceLine(theory, is_common=True))
        lines.append(AdviceLine(self.bits_a_second(advice.limits)))
        lines.append(AdviceLine(self._confidence(advice.limits), is_common=True))
        return lines

    def gaps(self, found: WorkingRange) -> str:
        """Write between which values it does not read."""
        gaps = [
            (
                f"{_formatted(found.parameter, end.value)} and "
                f"{_formatted(found.parameter, after.value)}"
            )
            for end, after in found.gaps
        ]
        return "It does not read everywhere between: gaps lie between {gaps}.".format(
            gaps="; ".join(gaps)
        )

    def searched_to(self, found: WorkingRange) -> str:
        """Write where the search ended, as the decoder takes too long beyond."""
        return (
            f"Searched to {_formatted(found.parameter, found.searched[1])} alone, where "
            f"an exposure covers {found.most_chips:.3g} chips: more take this "
            "decoder much longer."
        )

    def _two_packets(self, frequency: float) -> str:
        return (
            f"Below {HERTZ.format(frequency, _DIGITS)} no two packets fit the picture, which "
            "it needs."
        )

    def bits_a_second(self, found: Limits) -> str:
        """Write how many bits a second arrive at the scene's own values."""
        own = found.frequency.own
        return (
            f"At {HERTZ.format(own.value, _DIGITS)} it reads {own.whole} of {own.images} pictures: "
            f"{found.bits_a_second(self.frames_a_second):.4g} bits a second, each picture with "
            "another payload."
        )

    def on_highest_frequency(self, advice: Advice) -> AdviceLine:
        """Write the line on the highest frequency that is read, or that there is none."""
        end = highest_frequency(advice)
        if end is None:
            return AdviceLine(self._nowhere(advice.limits, advice.frequency.found))
        return self._line("The highest frequency that it reads is {value}", end)

    def common_title(self) -> str:
        """Write the title of the lines that are the same for every decoder."""
        return "For every decoder"

    def still_holds(self, parameters: frozenset[str]) -> str:
        """Say that the advice is of an earlier scene, and which of its limits hold all the same."""
        text = "This advice is on the scene before the change."
        if not parameters:
            return text
        names = " and ".join(sorted(quantity(name).label.lower() for name in parameters))
        return f"{text} Its limits of the {names} still hold."

    def left_out(self, effects: tuple[str, ...]) -> str:
        """Say which of the scene's effects the advice leaves out."""
        return "This advice leaves out: {effects}.".format(effects=", ".join(effects))

    def _nowhere(self, limits: Limits, found: WorkingRange) -> str:
        if found.best is None:
            return found.failure or ""
        texts = {
            "switching_frequency": (
                "It reads {rate:g} % of the bits at no switching frequency from {low} to {high}; "
                "the most it reads is {right} of {sent} bits, at {value}."
            ),
            "exposure_time": (
                "It reads {rate:g} % of the bits at no exposure time from {low} to {high}; "
                "the most it reads is {right} of {sent} bits, at {value}."
            ),
        }
        low, high = (_formatted(found.parameter, value) for value in found.searched)
        return texts[found.parameter].format(
            rate=limits.rate, low=low, high=high, right=found.best.right, sent=found.best.sent,
            value=_formatted(found.parameter, found.best.value),
        )  # fmt: skip

    def _title(self, found: Limits) -> str:
        scene = found.scene
        return (
            "The {decoder} decoder, {rate:g} % of the bits, at {frequency}, {exposure}, {distance}"
        ).format(
            decoder=found.decoder,
            rate=found.rate,
            frequency=HERTZ.format(scene.transmitter.switching_frequency, _DIGITS),
            exposure=SECOND.format(scene.camera.exposure_time, _DIGITS),
            distance=_formatted("distance", scene.pose.distance),
        )

    def _line(self, text: str, end: EndFacts) -> AdviceLine:
        value = _formatted(end.parameter, end.value)
        inside = f"there it read {self._counted(end.works)}"
        if end.fails is None:
            beyond = "beyond it was not tried"
        else:
            beyond = f"at {_formatted(end.parameter, end.fails.value)} {self._counted(end.fails)}"
        sentence = f"{text.format(value=value)}: {inside}, {beyond}."
        if end.inside is None:
            return AdviceLine(f"{sentence} No value inside is surely read.")
        place = _formatted(end.parameter, end.inside.value)
        if end.interval is not None:
            low, high = (_formatted(end.parameter, value) for value in end.interval)
            sentence += (
                f" At {place} it read every bit of {end.inside.images} images: the end lies "
                f"between {low} and {high} (95 %)."
            )
        return AdviceLine(sentence, (end.parameter, end.inside.value, place))

    def _counted(self, trial: Trial) -> str:
        return (
            f"{trial.rate:.3g} % in {trial.images} images ({trial.low:.1f} to {trial.high:.1f} %)"
        )

    def _theory_of_frequency(self, theory: TheoryLimits) -> str:
        text = (
            f"By theory the band model ends at {HERTZ.format(theory.band_model, _DIGITS)} and "
            f"an alternating pattern at {HERTZ.format(theory.null, _DIGITS)}"
        )
        return f"{text}."

    def _theory_of_exposure(self, theory: TheoryLimits) -> str:
        text = (
            f"By theory the band model ends at {SECOND.format(theory.band_model, _DIGITS)} "
            f"and an alternating pattern at {SECOND.format(theory.null, _DIGITS)}"
        )
        if theory.saturation is not None and math.isfinite(theory.saturation):
            text += (
                f"; from {SECOND.format(theory.saturation, _DIGITS)} what is lit throughout "
                "is white"
            )
        return f"{text}."

    def _confidence(self, found: Limits) -> str:
        return (
            f"Each end was tried with {found.images} images that had not chosen it; the "
            "95 % intervals "
            "count images. Values between were tried in steps of "
            f"{100.0 * (found.frequency.step - 1.0):.0f} %: a narrower gap can "
            "be missed."
        )


def highest_frequency(advice: Advice) -> EndFacts | None:
    """Return the facts on the highest frequency that is read, None if none is."""
    ends = (end for end in advice.frequency.ends if end.side == "highest")
    return next(ends, None)


def formatted_frequency(value: float) -> str:
    """Write a frequency with the digits of the advice."""
    return HERTZ.format(value, _DIGITS)


def _formatted(name: str, value: float) -> str:
    return quantity(name).format(value, _DIGITS)
