"""Words for a film's reading: its rates, its clocks, and what is not sure."""

import math

from occ_gui.video.film_reading import Figure
from occ_model.results.video_reading import Clock, FilmProgress, Measured, VideoReading
from occ_model.scene.units import HERTZ, SECOND, Unit

_PERCENT = 100.0
_RATE = Unit("Hz/s")


def figures_of(known: FilmProgress, whole: VideoReading | None) -> tuple[Figure, ...]:
    """List the figures of a film that is being read.

    Parameters
    ----------
    whole
        What the frames said together when they were last looked at; None before.
    """
    figures = [
        Figure(
            "Frames placed",
            f"{known.placed} of {known.frames}",
            "Frames whose place in what is sent over and over is known.",
        ),
        Figure(
            "Packet known",
            f"{_PERCENT * known.known:.0f} %",
            "Share of the chips sent over and over that are known, those of a header included.",
        ),
    ]
    if whole is not None:
        figures += _rates(whole)
    clock = known.clock if whole is None or whole.clock is None else whole.clock
    if clock is not None:
        figures += _clocks(clock)
    return tuple(figures)


def sentences_of(
    known: FilmProgress, whole: VideoReading | None, problem: str | None
) -> tuple[str, ...]:
    """List what is not sure of a film, and what is wrong with it."""
    said = [problem] if problem else []
    if whole is not None and whole.failure is not None:
        said.append(whole.failure)
    if whole is not None:
        said += whole.problems
    elif known.clock is not None:
        said += known.clock.problems
    if whole is not None and whole.cut_off:
        said.append(_losses(known, whole))
    return tuple(dict.fromkeys(said))


def _rates(whole: VideoReading) -> list[Figure]:
    found = []
    if whole.complete_after is not None:
        found.append(
            Figure(
                "Payload complete",
                f"after {SECOND.format(whole.complete_after, 4)}",
                "How long the film had run by the end of the frame that completed it.",
            )
        )
    if not whole.packets:
        return found
    found.append(
        Figure(
            "Packets",
            f"{whole.read} read, {whole.lost} lost",
            "Of those sent; one that no frame shows whole is lost.",
        )
    )
    found.append(
        Figure(
            "Net rate",
            f"{whole.net_bits_per_second:.4g} bit/s",
            (
                "Bits that were wanted and arrived: repeats of a packet within a frame count once, "
                "as if every frame showed another payload."
            ),
        )
    )
    (counts,) = whole.rates(1)
    found.append(
        Figure(
            "Packet error rate",
            f"{_share(counts.packets_lost, counts.packets)} of {counts.packets} packets",
            (
                f"Share of the packets sent that were lost: {whole.cut_off} were cut off "
                "by the edge of a "
                "frame or fell in the gap, and the frames can all be read all the same."
            ),
        )
    )
    if counts.bits:
        found.append(
            Figure(
                "Bit error rate",
                f"{_share(counts.bits_wrong, counts.bits)} of {counts.bits} bits",
                (
                    "Share of wrong bits in the packets that one frame shows whole, against the "
                    "payload of all together. Packets that no frame shows whole have no bits here."
                ),
            )
        )
    return found


def _share(count: int, total: int) -> str:
    """Write a share of things counted in percent, to the first digit that chance could change."""
    share = count / total
    deviation = _PERCENT * math.sqrt(share * (1.0 - share) / total)
    decimals = max(0, -math.floor(math.log10(deviation))) if deviation else 0
    return f"{_PERCENT * share:.{decimals}f} %"


def _losses(known: FilmProgress, whole: VideoReading) -> str:
    """Say why packets are lost, and that their bits are not counted as wrong ones."""
    where = "sent in the gap between two frames, or cut off by a frame's edge"
    if unplaced := known.frames - known.placed:
        where += f", or in one of {unplaced} frames that were not placed"
    text = f"Of {whole.lost} lost packets no frame shows {whole.cut_off} whole: {where}."
    if misread := whole.lost - whole.cut_off:
        text += f" {misread} were in view and misread."
    return text + " The bit error rate counts only bits of packets in view."


def _clocks(clock: Clock) -> list[Figure]:
    doubt = "" if clock.is_sure else ", not sure"
    found = [
        Figure(label, _with_error(unit, measured) + mark, meaning)
        for label, unit, measured, mark, meaning in (
            (
                "Frequency", HERTZ, clock.switching_frequency, doubt,
                "Switching frequency by the clock that states the frames' times.",
            ),
            (
                "Readout time", SECOND, clock.readout_time, doubt,
                "From one column to the next, without any LED that is known.",
            ),
            (
                "Gap", SECOND, clock.gap, doubt,
                "The part of a frame's period in which no column begins.",
            ),
            (
                "Frame period", SECOND, clock.frame_period, "",
                "From one frame to the next.",
            ),
        )
    ]  # fmt: skip
    if clock.drift is not None:
        found.append(
            Figure(
                "Drift",
                _with_error(_RATE, clock.drift),
                "How the switching frequency changes while the film runs.",
            )
        )
    return found


def _with_error(unit: Unit, measured: Measured) -> str:
    return unit.format_estimate(measured.value, measured.error)
