"""What was read from a film, in one line."""

from occ_model.errors import one_line
from occ_model.results.clock import Clock
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.scene.units import HERTZ, PERCENT, SECOND

_LONGEST_TEXT = 40  # characters of a payload in a sentence
_SURE = 0.999  # probability of all bits from which it is not stated


def describe_film(progress: FilmProgress, reading: VideoReading | None) -> str:
    """State what a film shows so far: the lamp's frequency, or the payload and when it was read.

    ``reading``: the last one of all frames.
    """
    clock = progress.clock if reading is None or reading.clock is None else reading.clock
    lamp = None if clock is None else _describe_lamp(clock)
    if lamp is not None:
        return lamp
    text = one_line(progress.payload, _LONGEST_TEXT)
    if reading is not None and reading.complete_after is not None and reading.payload:
        payload = one_line(reading.payload, _LONGEST_TEXT)
        sentence = f"“{payload}” read, complete after {SECOND.format(reading.complete_after, 4)}"
        if reading.certainty < _SURE:
            sentence += (
                f"; all bits are right with a probability of {PERCENT.format(reading.certainty, 3)}"
            )
        return f"{sentence}."
    if reading is not None and reading.failure is not None:
        return reading.failure
    if not progress.placed:
        return f"Nothing read yet in {progress.frames} frames."
    return f"“{text}”, {100.0 * progress.known:.0f} % of a packet known, is read so far."


def _describe_lamp(clock: Clock) -> str | None:
    frequency = clock.lamp_frequency
    if frequency is None:
        return None
    text = HERTZ.format_estimate(frequency.value, frequency.error)
    doubt = "" if clock.is_sure_of("switching_frequency") else ", not sure"
    return f"A lamp of {text}{doubt}."
