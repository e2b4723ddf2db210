"""Each argument that is not allowed is refused by its name, its value and the allowed range.

One rule for all functions: a row is a call, the parameter, the value as it is said, and what is
allowed, in part where it is long. Values out of the range of a scene's parameter are in
``test_every_error.py``, those of another kind in ``test_argument_kinds.py``.
"""

import math
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from fractions import Fraction
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from each_case import each_case
from simulated_photos import photo_of

import occ_model as occ
from occ_model.photo.many.row import MatchSettings
from occ_model.results.bit_errors import BenchRequest
from occ_model.scene.payload import MAX_PAYLOAD_BITS
from occ_model.study.bench.bench import bench
from occ_model.study.bit_error_rate import check_frame_rate
from occ_model.study.confidence import wilson_interval
from occ_model.study.spectrum import profile_spectrum
from occ_model.teaching.light_over_columns import exposure_window, light_over_columns

Row = tuple[Callable[[], object], str, str, str]

SCENE = occ.load_preset("phone-136us").replace(rows=20)
COLUMNS = SCENE.camera.columns
PHOTO = photo_of(occ.render(SCENE).image)


class Untouched(Executor):
    """Workers that must not get any work."""

    def submit(self, *_: object, **__: object) -> "Future[Any]":
        raise AssertionError("work has started")


def calls(
    function: Callable[..., object], *rows: tuple[dict[str, Any], str, str, str]
) -> list[Row]:
    """Call a function once a row, with the row's arguments."""

    def call(arguments: dict[str, Any]) -> Callable[[], object]:
        return lambda: function(**arguments)

    return [(call(arguments), *rest) for arguments, *rest in rows]  # type: ignore[misc]


def in_scene(**arguments: Any) -> Callable[..., object]:
    """Bind the scene to a function's first argument."""
    function = arguments.pop("of")
    return lambda **more: function(SCENE, **{**arguments, **more})


def swept(**arguments: Any) -> object:
    """Sweep a scene, by workers that must not be asked."""
    axes = arguments.pop("axes", {"distance": [1.0]})
    return occ.sweep(SCENE, axes, executor=Untouched(), **arguments)


def moved(*points: occ.Waypoint) -> Callable[[], object]:
    return lambda: occ.Recording(path=points)


LEVELS, WHOLE, A_NUMBER = "from 0 levels", "a whole number from 0", "a number between 0 and 1"
OBSERVABLES, EFFECTS = "signal, profile, image, decision", "led-edges, flicker, "
CHANNELS, AXES_OF_SCAN = "brightest, luma, red, green, blue", "auto, columns, lines"
CODES, PLUGINS = "text:HELLO", "differential-manchester"
UNKNOWN: tuple[object, ...] = ("psychic", None, [])
DECODERS = "threshold, matched, equalizer, sequence"

ROWS: list[Row] = [
    *calls(
        in_scene(of=occ.plan),
        ({"tolerance": -1}, "tolerance", "-1 levels", LEVELS),
        ({"observable": "pixels"}, "observable", "'pixels'", OBSERVABLES),
        ({"force": {"blur": True}}, "effect", "'blur'", EFFECTS),
        ({"force": {3: True}}, "effect", "3", EFFECTS),
        ({"force": {"jpeg": 1}}, "effect 'jpeg'", "switched 1", "True, False"),
    ),
    *calls(
        in_scene(of=occ.render),
        ({"seed": -1}, "seed", "-1", WHOLE),
        *(
            ({"rows_step": step}, "rows_step", repr(step), "a whole number from 1 to 20")
            for step in (0, -1, 21, 1.5, True)
        ),
    ),
    (lambda: occ.render(SCENE).picture("film"), "picture", "'film'", "camera, receiver"),
    *calls(
        lambda **how: occ.load_photo("x.png", **how),
        ({"scan_axis": "rows"}, "scan_axis", "'rows'", AXES_OF_SCAN),
        ({"channel": "ir"}, "channel", "'ir'", CHANNELS),
        ({"max_pixels": 0}, "max_pixels", "0", "a whole number from 1"),
        ({"max_pixels": 1e6}, "max_pixels", "1000000.0", "a whole number from 1"),
    ),
    *calls(
        lambda **how: occ.load_video("x.mp4", **how),
        ({"scan_axis": "rows"}, "scan_axis", "'rows'", AXES_OF_SCAN),
        ({"channel": "white"}, "channel", "'white'", "luma, red"),
    ),
    *calls(
        lambda **wrong: MatchSettings(SCENE, **wrong).check(),
        ({"estimate": "gamma"}, "estimate", "'gamma'", "switching_frequency"),
        ({"sent": "nothing"}, "sent", "'nothing'", "read"),
        ({"scan_axis": "nobody"}, "scan_axis", "'nobody'", AXES_OF_SCAN),
        ({"channel": "nobody"}, "channel", "'nobody'", CHANNELS),
    ),
    *calls(
        lambda **wrong: occ.match_photo(PHOTO, SCENE, **wrong),
        ({"averaging": "median"}, "averaging", "'median'", "light"),
        *(
            ({"region": region}, "region", repr(region), "first row")
            for region in ((0, 2, 5, 5), (-1, 2, 0, 50), (0, 10_000, 0, 50), (0, 2, 0), "0:1")
        ),
        ({"region": occ.Region(5, 1, 0, 10)}, "region", "(5, 1, 0, 10)", "first row"),
    ),
    *calls(
        lambda **wrong: occ.match_photos([Path("nowhere.png")], SCENE, **wrong),
        ({"jobs": 0}, "jobs", "0", "a whole number from 1"),
        ({"channel": "ultraviolet"}, "channel", "'ultraviolet'", CHANNELS),
        ({"known": {0: -1.0}}, "switching_frequency", "-1 Hz", "1 Hz to"),
        ({"known": {1: 5e3}}, "place of a known value", "1", "a whole number from 0"),
        ({"known": {0.5: 1.0}}, "place of a known value", "0.5", "a whole number from 0"),
    ),
    *calls(
        lambda decoder: occ.decode(PHOTO.image, SCENE, decoder),
        *(
            ({"decoder": decoder}, "decoder", repr(decoder), DECODERS)
            for decoder in UNKNOWN
        ),
    ),
    *calls(
        in_scene(of=occ.success_rate),
        ({"images": 0}, "images", "0", "a whole number from 1"),
        ({"tolerance": -1.0}, "tolerance", "-1 levels", LEVELS),
        ({"seed": None}, "seed", "None", WHOLE),
        ({"path": "guess"}, "path", "'guess'", "auto, profile, rows, image"),
    ),
    *calls(
        in_scene(of=occ.limits),
        ({"rate": math.nan}, "rate", "nan %", "above 0 % to 100 %"),
        ({"images": 0}, "images", "0", "a whole number from 1"),
        ({"seed": -1}, "seed", "-1", WHOLE),
    ),
    *calls(
        lambda duty=0.5, periods=1.0: occ.pulse_depth(duty, periods),
        *(({"duty": duty}, "duty", str(duty), "above 0, up to 1") for duty in (0.0, 1.5, math.nan)),
        *(
            ({"periods": periods}, "periods", str(periods), "above 0")
            for periods in (0.0, -1.0, math.inf, math.nan)
        ),
    ),
    *calls(
        occ.load_room("office").replace,
        ({"lamps": 3}, "lamps", "3", "a sequence of RoomLamps"),
        ({"lamps": (3,)}, "lamps", "(3,)", "a sequence of RoomLamps"),
        ({"camera": None}, "camera", "None", "a Place"),
        ({"scene": None}, "scene", "None", "a Scene"),
    ),
    *calls(
        swept,
        ({"axes": {}}, "axes", "{}", "one parameter or more"),
        ({"axes": {"distance": []}}, "distance", "no values to vary over", "one or more, 1 mm to"),
        ({"axes": {"distance": 1.0}}, "distance", "over 1.0", "a list of values"),
        ({"axes": {"distance": [1.0, -2.0]}}, "distance", "-2 m", "1 mm to 10 km"),
        ({"axes": {"distance": [1, 2.0, 1.0]}}, "distance", "1 m twice", "values that differ"),
        ({"axes": {"columns": [10, 10.5]}}, "columns", "10.5", "a whole number"),
        (
            {"axes": {"iso": (100.0 + 1e-4 * place for place in count())}},
            "iso", "too many values", "at most 1,000,000",
        ),
        ({"decoder": []}, "decoder", "[]", "one of threshold"),
        ({"decoder": ["matched", "x"]}, "decoder", "'x'", DECODERS),
        ({"decoder": ["matched"] * 2}, "decoder 'matched'", "given twice", "each of threshold"),
        ({"jobs": 0}, "jobs", "0", "a whole number from 1 to 1,024"),
        *(
            ({"frames_a_second": frames}, "frame_rate", f"{frames:g} Hz", "0.001 Hz to 100 kHz")
            for frames in (0.0, math.nan, -1.0)
        ),
    ),
    *calls(
        lambda **interval: wilson_interval(**{"successes": 1, "trials": 5, **interval}),
        *(
            ({"trials": trials}, "trials", repr(trials), "a whole number from 1 to")
            for trials in (0, 2.0, True, 2**53 + 1)
        ),
        ({"successes": 6}, "successes", "6", "a whole number from 0 to 5"),
        *(
            ({"level": level}, "level", repr(level), A_NUMBER)
            for level in (0.0, 95.0, math.nan, "0.95", True, 0.9j)
        ),
        ({"level": 1 - Fraction(1, 10**30)}, "level", "Fraction(9", A_NUMBER),
    ),
    *calls(
        lambda **request: bench(BenchRequest(**request)),
        ({"schemes": ("morse",)}, "line_code", "'morse'", PLUGINS),
        ({"schemes": ("nrz/c-ook",)}, "line_code", "'nrz', which does not limit", "a longest run"),
        ({"decoders": ("guess",)}, "decoder", "'guess'", DECODERS),
        ({"exposures": (0.0,)}, "exposure in symbols", "0.0", "0.001 to 100"),
        ({"decibels": (math.nan,)}, "signal-to-noise ratio in dB", "nan", "to"),
        ({"rows_a_symbol": 0.5}, "rows a symbol", "0.5", "1 to 100"),
        ({"bits": 0}, "bits", "0", "a whole number from"),
        ({"payload_bits": 9999}, "payload_bits", "9999", "a whole number from"),
    ),
    *(
        (
            lambda limit=limit: occ.band_advice(SCENE, limit),
            "limit", f"{100.0 * limit:g} %", "0.01 % to 100 %",
        )
        for limit in (0.0, -1.0, 2.0, math.nan)
    ),
    (lambda: check_frame_rate(SCENE, 0.0), "frames_a_second", "0.0", "above 0 to 36.17, where"),
    (
        lambda: occ.most_bits(SCENE, ("threshold",), frames_a_second=100.0),
        "frames_a_second", "100.0", "above 0 to 36.17, where",
    ),
    (lambda: profile_spectrum(np.zeros(7), SCENE), "profile", "shape (7,)", "(8 or more,)"),
    (lambda: profile_spectrum(np.zeros((2, 9)), SCENE), "profile", "shape (2, 9)", "or more,)"),
    (lambda: profile_spectrum(np.full(9, math.nan), SCENE), "profile", "values that", "finite"),
    (lambda: light_over_columns(SCENE, 5.0, 5.0, 100), "last", "5.0", "above 5.0"),
    *(
        (
            lambda column=column: exposure_window(SCENE, column),
            "column", repr(column), f"0 to {COLUMNS - 1}" if column == COLUMNS else "a whole",
        )
        for column in (-1, COLUMNS, 1.5, "2")
    ),
    *calls(
        occ.Recording,
        ({"frame_rate": 0.0}, "frame_rate", "0 Hz", "0.001 Hz to 100 kHz"),
        ({"frame_rate": "30"}, "frame_rate", "'30', which is not a number", "0.001 Hz to 100 kHz"),
        ({"camera_drift": 0.5}, "camera_drift", "500000 ppm", "-10000 ppm to 10000 ppm"),
        ({"frame_times": "late"}, "frame_times", "'late'", "measured, nominal"),
        ({"path": [(0.0, 1.0)]}, "path", "[(0.0, 1.0)]", "Waypoints, in the order of time"),
        ({"exposure_times": 1e-4}, "exposure_times", "0.0001", "times in seconds"),
        ({"exposure_times": (0.0,)}, "exposure_time", "0 s", "1 ns to"),
    ),
    (
        moved(occ.Waypoint(1.0), occ.Waypoint(1.0)),
        "path", "from the time 1 s to 1 s", "waypoints in the order of time",
    ),
    (moved(occ.Waypoint(math.nan)), "A waypoint's time", "nan", "numbers from -1e9 to 1e9"),
    (
        moved(occ.Waypoint(0.0, yaw="x")),  # type: ignore[arg-type]
        "A waypoint's yaw", "'x'", "numbers from -1e9 to 1e9",
    ),
    (
        lambda: occ.Recording().replace(gap=1.0),
        "setting of a recording", "'gap'", "frame_rate, frame_jitter",
    ),
    *calls(
        lambda frames: occ.render_video(SCENE, frames),
        *(
            ({"frames": frames}, "frames", repr(frames), "a whole number from 1")
            for frames in (0, -1, 2.5, True, 10**12)
        ),
    ),
    *calls(
        lambda index: occ.render_video(SCENE, 3).frame(index),
        *(
            ({"index": index}, "index", repr(index), "a whole number from 0 to 2")
            for index in (-1, 3, 1.5)
        ),
    ),
    *calls(
        lambda wrong: occ.VideoReader(SCENE, readout_tolerance=wrong),
        *(
            ({"wrong": wrong}, "readout_tolerance", repr(wrong), "above 0 up to 0.5")
            for wrong in (0.7, 0.0, "0.01", True)
        ),
    ),
    *calls(
        lambda wrong: occ.VideoReader(SCENE, frequency_tolerance=wrong),
        *(
            ({"wrong": wrong}, "frequency_tolerance", repr(wrong), "above 0 up to 0.5")
            for wrong in (0.7, 0.0, "0.01", True)
        ),
    ),
    (
        lambda: occ.transmitter_sketch(SCENE, "arduino-due"),
        "board", "'arduino-due'", "arduino-uno, arduino-nano, esp32, raspberry-pi-pico",
    ),
    (
        lambda: occ.transmitter_sketch(SCENE.replace(switching_frequency=400e3), "arduino-uno"),
        "switching_frequency", "400 kHz",
        "0.238419 Hz to 125 kHz, since its interrupt takes about 100 of the clock's cycles",
    ),
    *calls(
        SCENE.replace,
        *(
            ({"payload": wrong}, "payload", said, CODES)
            for wrong, said in (
                ("text:", "0 bits"), ("bits:", "0 bits"), ("bits:012", "'bits:012'"),
                ("hex:4", "'hex:4'"), ("hex:zz", "'hex:zz'"), ("x" * 513, "4,104 bits"),
                ("text:\ud800", "'text:\\ud800'"), (5, "5"), (None, "None"), (b"x", "b'x'"),
                ("bits:" + "1" * (MAX_PAYLOAD_BITS + 1), "4,097 bits"),
                ("bits:" + "1" * 10**6, "a text of 1,000,005 characters"),
            )
        ),
        ({"line_code": "mine"}, "line_code", "'mine'", PLUGINS),
    ),
]  # fmt: skip


def names() -> Iterator[str]:
    for number, (_, parameter, value, _) in enumerate(ROWS):
        yield f"{number}-{parameter}-{value[:20]}"


@each_case(ROWS)
def test_what_is_not_allowed_is_refused_with_parameter_value_and_range(
    call: Callable[[], object], parameter: str, value: str, allowed: str
) -> None:
    with pytest.raises(occ.ParameterError) as caught:
        call()
    refused = caught.value.refused
    assert refused.parameter == parameter
    assert refused.value.startswith(value)
    assert allowed in refused.allowed
    assert str(caught.value) == refused.sentence()
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 600
