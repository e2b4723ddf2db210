"""What a film's file states of its times: rate, length, resolution, and slow motion."""

import re
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from av.container import InputContainer
from av.video.stream import VideoStream

from occ_model.video.file.source import FilmFacts

_MAX_FRAMES, _MAX_FRAME_RATE = 1e9, 1e6
_MICROSECONDS = 1e6
_DURATION = re.compile(r"(\d+):(\d\d):(\d\d(?:\.\d+)?)")  # Matroska's tag of a track

_CAPTURE_RATE = "com.android.capture.fps"
_LEAST_CHANGE = 1.5  # ratio of rates from which it is slow motion or time lapse, not rounding


def describe_film(container: InputContainer, stream: VideoStream) -> FilmFacts:
    """Return what a file states of the frames of a track."""
    slowdown = 1.0
    rate = _rate_of(stream)
    capture_rate = _capture_rate(container, stream)
    if rate and capture_rate:
        ratio = capture_rate / rate
        slowdown = ratio if not 1.0 / _LEAST_CHANGE < ratio < _LEAST_CHANGE else 1.0
    # An AVI file numbers its frames, and states their rate, not their times.
    is_numbered = container.format.name == "avi"
    resolution = 0.0 if is_numbered else float(stream.time_base or 0)
    duration, count = _duration_of(container, stream), stream.frames
    if is_numbered and rate:
        duration = count / rate
    elif rate and duration and not 0.0 < count <= rate * duration + 1.0:
        count = round(rate * duration)  # not stated, or of frames that an edit leaves out
    return FilmFacts(
        frame_rate=rate * slowdown if rate else None,
        frame_count=count if 0 < count < _MAX_FRAMES else None,
        duration=duration / slowdown if duration else None,
        resolution=resolution / slowdown,
        slowdown=slowdown,
    )


def as_fields(facts: FilmFacts, axis: int) -> FilmFacts:
    """Return what is stated of a film whose frames are two fields each."""
    rate, count = facts.frame_rate, facts.frame_count
    return replace(
        facts,
        frame_rate=2.0 * rate if rate else None,
        frame_count=2 * count if count else None,
        field_axis=axis,
    )


def _rate_of(stream: VideoStream) -> float | None:
    rate: Fraction | None = stream.average_rate or stream.guessed_rate
    return float(rate) if rate and 0.0 < rate < _MAX_FRAME_RATE else None


def _capture_rate(container: InputContainer, stream: VideoStream) -> float | None:
    """Return the frames a second at which a film was recorded, if its file says so."""
    stated = stream.metadata.get(_CAPTURE_RATE, container.metadata.get(_CAPTURE_RATE, ""))
    with suppress(ValueError):
        rate = float(stated)
        if 0.0 < rate < _MAX_FRAME_RATE:
            return rate
    return None


def _duration_of(container: InputContainer, stream: VideoStream) -> float | None:
    """Return the length of a track in seconds; that of a file may be the length of its sound."""
    if stream.duration and stream.time_base:
        return float(stream.duration * stream.time_base)
    stated = _DURATION.match(stream.metadata.get("DURATION", ""))
    if stated:
        hours, minutes, seconds = map(float, stated.groups())
        return 3600.0 * hours + 60.0 * minutes + seconds
    if container.duration and len(container.streams) == 1:
        return container.duration / _MICROSECONDS
    return None
