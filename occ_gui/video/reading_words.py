"""Words for a film's reading: its rates, its clocks, and what is not sure."""

from PySide6.QtCore import QCoreApplication

from occ_gui.video.film_reading import Figure
from occ_model.results.video_reading import Clock, FilmProgress, Measured, VideoReading
from occ_model.scene.units import HERTZ, SECOND, Unit

_PERCENT = 100.0
_RATE = Unit("Hz/s")

_ROUNDING = 1e-12
"""Share of a value below which its error is that of the arithmetic, and is not stated."""


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
    clock = known.clock if whole is None or whole.clock is None else whole.clock
    if clock is not None:
        said += clock.problems
    return tuple(dict.fromkeys(said))


def _rates(whole: VideoReading) -> list[Figure]:
    found = []
    if whole.complete_at is not None:
        found.append(
            Figure(
                _tr("Payload complete"),
                _tr("after {time}").format(time=SECOND.format(whole.complete_at, 4)),
                _tr("When the frame began after which the whole payload was known."),
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
            _tr("{rate:.4g} bit/s").format(rate=whole.bits_per_second),
            _tr("Bits of the payload in the packets read, repetitions included."),
        )
    )
    for label, share, meaning in (
        (
            _tr("Packet error rate"),
            whole.packet_error_rate,
            _tr("Share of the packets sent that were lost."),
        ),
        (
            _tr("Bit error rate"),
            whole.bit_error_rate,
            _tr("Share of wrong bits in the packets read, against the payload of all together."),
        ),
    ):
        if share is not None:
            found.append(Figure(label, f"{_PERCENT * share:.3g} %", meaning))
    return found


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
    is_exact = measured.error <= _ROUNDING * abs(measured.value)
    return unit.format_estimate(measured.value, None if is_exact else measured.error)


def _tr(text: str) -> str:
    return QCoreApplication.translate("FilmReading", text)
