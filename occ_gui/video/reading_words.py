"""Words for a film's reading: its rates, its clocks, and what is not sure."""

import math

from PySide6.QtCore import QCoreApplication

from occ_gui.video.film_reading import Figure
from occ_model.results.video_reading import Clock, FilmProgress, Measured, VideoReading
from occ_model.scene.units import HERTZ, SECOND, Unit

_PERCENT = 100.0
_RATE = Unit("Hz/s")


def figures_of(known: FilmProgress, whole: VideoReading | None) -> tuple[Figure, ...]:
    """List the figures of a film that is being read.

    Parameters
    ----------
    known
        What is known after the last frame.
    whole
        What the frames said together when they were last looked at; None before.
    """
    figures = [
        Figure(
            _tr("Frames placed"),
            _tr("{placed} of {frames}").format(placed=known.placed, frames=known.frames),
            _tr("Frames whose place in what is sent over and over is known."),
        ),
        Figure(
            _tr("Packet known"),
            f"{_PERCENT * known.known:.0f} %",
            _tr(
                "Share of the chips sent over and over that are known, those of a header included."
            ),
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
                _tr("Payload complete"),
                _tr("after {time}").format(time=SECOND.format(whole.complete_after, 4)),
                _tr("How long the film had run by the end of the frame that completed it."),
            )
        )
    if not whole.packets:
        return found
    found.append(
        Figure(
            _tr("Packets"),
            _tr("{read} read, {lost} lost").format(read=whole.read, lost=whole.lost),
            _tr("Of those sent; one that no frame shows whole is lost."),
        )
    )
    found.append(
        Figure(
            _tr("Net rate"),
            _tr("{rate:.4g} bit/s").format(rate=whole.net_bits_per_second),
            _tr(
                "Bits that were wanted and arrived: repeats of a packet within a frame count once, "
                "as if every frame showed another payload."
            ),
        )
    )
    (counts,) = whole.rates(1)
    found.append(
        Figure(
            _tr("Packet error rate"),
            _tr("{share} of {sent} packets").format(
                share=_share(counts.packets_lost, counts.packets), sent=counts.packets
            ),
            _tr(
                "Share of the packets sent that were lost: {cut} were cut off by the edge of a "
                "frame or fell in the gap, and the frames can all be read all the same."
            ).format(cut=whole.cut_off),
        )
    )
    if counts.bits:
        found.append(
            Figure(
                _tr("Bit error rate"),
                _tr("{share} of {read} bits").format(
                    share=_share(counts.bits_wrong, counts.bits), read=counts.bits
                ),
                _tr(
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
    where = _tr("sent in the gap between two frames, or cut off by a frame's edge")
    if unplaced := known.frames - known.placed:
        where += _tr(", or in one of {count} frames that were not placed").format(count=unplaced)
    text = _tr("Of {lost} lost packets no frame shows {cut_off} whole: {where}.").format(
        lost=whole.lost, cut_off=whole.cut_off, where=where
    )
    if misread := whole.lost - whole.cut_off:
        text += _tr(" {misread} were in view and misread.").format(misread=misread)
    return text + _tr(" The bit error rate counts only bits of packets in view.")


def _clocks(clock: Clock) -> list[Figure]:
    doubt = "" if clock.is_sure else _tr(", not sure")
    found = [
        Figure(label, _with_error(unit, measured) + mark, meaning)
        for label, unit, measured, mark, meaning in (
            (
                _tr("Frequency"), HERTZ, clock.switching_frequency, doubt,
                _tr("Switching frequency by the clock that states the frames' times."),
            ),
            (
                _tr("Readout time"), SECOND, clock.readout_time, doubt,
                _tr("From one column to the next, without any LED that is known."),
            ),
            (
                _tr("Gap"), SECOND, clock.gap, doubt,
                _tr("The part of a frame's period in which no column begins."),
            ),
            (
                _tr("Frame period"), SECOND, clock.frame_period, "",
                _tr("From one frame to the next."),
            ),
        )
    ]  # fmt: skip
    if clock.drift is not None:
        found.append(
            Figure(
                _tr("Drift"),
                _with_error(_RATE, clock.drift),
                _tr("How the switching frequency changes while the film runs."),
            )
        )
    return found


def _with_error(unit: Unit, measured: Measured) -> str:
    return unit.format_estimate(measured.value, measured.error)


def _tr(text: str) -> str:
    return QCoreApplication.translate("FilmReading", text)
