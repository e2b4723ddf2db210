"""Facts about the reading of a film: packets, error rates and clocks."""

import math
from collections.abc import Iterator

from occ_model.results.clock import Clock, MeasuredValue
from occ_model.results.fact import Fact
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.units import HERTZ, SECOND, Unit
from occ_model.study.confidence import wilson_interval

_PERCENT = 100.0
_RATE = Unit("Hz/s")
_MOST_SPACING = 0.5  # spacing of the solutions, over the frequency, above which it is not stated


def film_facts(progress: FilmProgress, reading: VideoReading | None) -> tuple[Fact, ...]:
    """List the facts about a film being read; ``reading``: the last one of all frames."""
    facts = [
        Fact(
            "placed",
            "Frames placed",
            f"{progress.placed} of {progress.frames}",
            meaning="Frames whose place in the repeated packets is known.",
        ),
        Fact(
            "known",
            "Chips known",
            f"{100.0 * progress.known:.0f} %",
            meaning="Fraction of the chips of a period that are known, including a header's.",
        ),
    ]
    if reading is not None:
        facts += packet_facts(reading)
    clock = progress.clock if reading is None or reading.clock is None else reading.clock
    if clock is not None:
        facts += clock_facts(clock)
    return tuple(facts)


def packet_facts(reading: VideoReading) -> Iterator[Fact]:
    """List the numbers of packets and bits received; nothing if they cannot be counted."""
    after = reading.complete_after
    if after is not None:
        yield Fact(
            "complete",
            "Payload complete",
            f"after {SECOND.format(after, 4)}",
            f"{len(reading.bits) / after:.4g} bits a second",
            "Time of the film at the end of the frame that completed it.",
        )
    if not reading.packets:
        return
    yield Fact(
        "packets",
        "Packets",
        f"{reading.read} read, {reading.lost} lost",
        f"{len(reading.packets)} sent, {reading.doubled} doubled",
        "A packet that no frame shows whole is lost.",
    )
    yield Fact(
        "net_rate",
        "Net rate",
        f"{reading.net_bits_per_second:.4g} bit/s",
        "repeats within a frame counted once",
        "Payload bits received per second; repeats of a packet within a frame count once, as if "
        "every frame showed a new payload.",
    )
    (counts,) = reading.rates(1)
    yield Fact(
        "packet_error_rate",
        "Packet loss",
        *error_rate(counts.packets_lost, counts.packets, "packets"),
        f"Fraction of the packets sent that were lost: {reading.cut_off} were cut off by the edge "
        "of a frame or fell in the gap, which happens even where every frame is read.",
    )
    if counts.bits:
        yield Fact(
            "bit_error_rate",
            "Bit error rate",
            *error_rate(counts.bits_wrong, counts.bits, "bits"),
            "Fraction of wrong bits in the packets that one frame shows whole, against the payload "
            "of all together. Packets that no frame shows whole have no bits here.",
        )


def clock_facts(clock: Clock) -> Iterator[Fact]:
    """List what a film reveals about the clocks of the camera and of the transmitter."""
    yield _frequency_fact(clock)
    slow_motion = f"slow motion of 1/{clock.slow_motion}" if clock.slow_motion > 1 else ""
    for key, label, note, meaning in (
        ("readout_time", "Readout time", "", "Time from one column to the next."),
        (
            "gap", "Gap", "",
            f"The part of a frame's period, {_PERCENT * clock.gap_ratio:.3g} %, in which no "
            "column begins.",
        ),
        ("frame_period", "Frame period", slow_motion, "From one frame to the next."),
    ):  # fmt: skip
        measured: MeasuredValue = getattr(clock, key)
        text = SECOND.format_estimate(measured.value, measured.error) + _doubt_on(clock, key)
        yield Fact(key, label, text, note, meaning)
    drift = clock.lamp_drift or clock.drift
    if clock.beat is not None:
        text = HERTZ.format_estimate(clock.beat.value, clock.beat.error)
        meaning = (
            "How often the stripes pass through the frames: the lamp's frequency less the nearest "
            "whole multiple of the frame rate."
        )
        yield Fact("beat", "Beat", text, meaning=meaning)
    if drift is not None:
        text = _RATE.format_estimate(drift.value, drift.error)
        meaning = f"Change of the {_name_frequency(clock)} during the film."
        yield Fact("drift", "Drift", text, meaning=meaning)
    if clock.timing_noise is not None:
        yield Fact(
            "frame_starts",
            "Frame jitter",
            SECOND.format(clock.timing_noise, 4),
            f"root mean square of {clock.frames} frames",
            "Deviation of the frames' starts from equal steps, or from their stated times where "
            "these explain them better.",
        )


def _frequency_fact(clock: Clock) -> Fact:
    frequency = clock.lamp_frequency or clock.switching_frequency
    note, spacing = "", math.inf if clock.spacing is None else clock.spacing
    if spacing <= _MOST_SPACING * clock.switching_frequency.value:
        spacing /= clock.chips_of_cycle or 1
        note = f"another one every {HERTZ.format(spacing, 4)}"
    return Fact(
        "frequency",
        "Lamp frequency" if clock.lamp_frequency else "Frequency",
        HERTZ.format_estimate(frequency.value, frequency.error)
        + _doubt_on(clock, "switching_frequency"),
        note,
        f"The {_name_frequency(clock)} by the clock of the frames, which any other whole number of "
        "steps away would fit as well; what is known of the lamp or the camera selects one.",
    )


def _name_frequency(clock: Clock) -> str:
    return "lamp frequency" if clock.lamp_frequency else "switching frequency"


def _doubt_on(clock: Clock, name: str) -> str:
    return "" if clock.is_sure_of(name) else ", not sure"


def error_rate(count: int, total: int, what: str) -> tuple[str, str]:
    """Format an error rate in percent with its 95 % interval, with as many digits as it allows."""
    fraction = count / total
    deviation = _PERCENT * math.sqrt(fraction * (1.0 - fraction) / total)
    decimals = max(0, -math.floor(math.log10(deviation))) if deviation else 0
    low, high = wilson_interval(count, total)
    return (
        f"{_PERCENT * fraction:.{decimals}f} % of {total} {what}",
        f"{_percent(low)} to {_percent(high)} % at 95 %",
    )


def _percent(fraction: float) -> str:
    """Format a fraction in percent, with two digits of its distance from 0 or 100 %."""
    nearest = _PERCENT * min(fraction, 1.0 - fraction)
    decimals = max(0, 1 - math.floor(math.log10(nearest))) if nearest > 0.0 else 0
    return f"{_PERCENT * fraction:.{decimals}f}"
