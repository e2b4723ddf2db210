"""Name a transmitter's light in sentences, and describe it as a blinking lamp if it is one."""

from dataclasses import dataclass

from occ_model.scene.scene import Transmitter
from occ_model.scene.units import HERTZ, PERCENT, SECOND

MAINS_HARMONIC = 2  # cycles of a mains lamp's light in one cycle of the mains
CYCLIC_LIGHTS = ("lamp", "pulses", "mains")  # of one pulse or swing a cycle

PICTURE_ONLY = "ask for its picture, its spectrum or its bars"  # what is known without a code


@dataclass(frozen=True, slots=True)
class BlinkingLamp:
    """A lamp that is lit once in each cycle."""

    frequency: float  # Hz
    duty: float  # Fraction of a cycle in which it is lit
    depth: float = 1.0  # Fraction of the light that it loses in the rest

    @property
    def words(self) -> str:
        dimmed = f", depth {PERCENT.format(self.depth, 3)}" if self.depth != 1.0 else ""
        duty = PERCENT.format(self.duty, 3)
        return f"lamp of {HERTZ.format(self.frequency, 4)}, duty {duty}{dimmed}"


def blinking_lamp(transmitter: Transmitter) -> BlinkingLamp | None:
    """Return the lamp that a transmitter is; None if its light does not have one pulse a cycle.

    A raw pattern of chips with one pulse is a lamp as well.
    """
    sent = transmitter
    if sent.light == "lamp":
        return BlinkingLamp(sent.lamp_frequency, sent.duty, sent.depth)
    if sent.light == "pulses":
        duty = min(sent.pulse_length * sent.pulse_frequency, 1.0)
        return BlinkingLamp(sent.pulse_frequency, duty)
    if sent.light == "code":
        return lamp_of_chips(sent.pattern, sent.switching_frequency)
    return None


def cycle_frequency(transmitter: Transmitter) -> float | None:
    """Return how often a light repeats in Hz if each cycle has one pulse or swing, else None."""
    if transmitter.light == "mains":
        return MAINS_HARMONIC * transmitter.mains_frequency
    lamp = blinking_lamp(transmitter)
    return None if lamp is None else lamp.frequency


def lamp_of_chips(pattern: str, frequency: float) -> BlinkingLamp | None:
    """Return the lamp that chips with one pulse are, at a switching frequency in Hz, if any."""
    if (pattern + pattern[:1]).count("01") != 1:
        return None
    return BlinkingLamp(frequency / len(pattern), pattern.count("1") / len(pattern))


def frequency_parameter(transmitter: Transmitter) -> str:
    """Return the name of the parameter that says how often a code's or lamp's light changes."""
    lamps = {"lamp": "lamp_frequency", "pulses": "pulse_frequency"}
    return lamps.get(transmitter.light, "switching_frequency")


def has_chips(transmitter: Transmitter) -> bool:
    """Whether a light is described by its chips, as a code or a pattern of several pulses is."""
    return transmitter.light == "code" and blinking_lamp(transmitter) is None


def describe_samples(samples: str) -> str:
    """Return how many levels a recorded waveform has, and how long it is; empty without one."""
    *rows, end = samples.splitlines() or [""]
    return f"{len(rows):,} levels in {SECOND.format(float(end), 4)}" if end else ""


def describe_light(transmitter: Transmitter) -> str:
    """Return what is sent, as a noun in a sentence."""
    sent = transmitter
    frequency = HERTZ.format(sent.switching_frequency, 4)
    match sent.light:
        case "mains":
            depth = PERCENT.format(sent.mains_depth, 3)
            return f"lamp on the mains of {HERTZ.format(sent.mains_frequency, 4)}, depth {depth}"
        case "waveform" if sent.waveform_file:
            return f"recorded waveform, {describe_samples(sent.waveform_file)}"
        case "waveform":
            count = len(sent.levels.partition("/")[0].split())
            return f"waveform of {count} levels at {frequency}"
        case "pulses":
            length = SECOND.format(sent.pulse_length, 4)
            return f"flashes of {length} at {HERTZ.format(sent.pulse_frequency, 4)}"
    lamp = blinking_lamp(sent)
    if lamp is not None:
        return lamp.words
    return f"{f'pattern of {len(sent.pattern)} chips' if sent.pattern else 'code'} at {frequency}"
