"""Return values of plug-ins: those of decoders, line codes and framings."""

import io
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import fields, replace
from functools import cache
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any, NoReturn
from unittest.mock import patch

import numpy as np
from model.plugins.installed_package import forget_plugins

import occ_model as occ
from hard_cases.attack.promise import Door
from occ_model import plugins
from occ_model.arrays import FloatArray
from occ_model.cli import main
from occ_model.figures.decoding import decode_drawing
from occ_model.files.writing import write_image
from occ_model.program import EXIT_FAILURE, EXIT_MISUSE
from occ_model.receiver.decode import decoder_named
from occ_model.results.bit_errors import BenchRequest
from occ_model.results.sweep_request import RateSettings
from occ_model.study.bench.bench import measure_bench_point
from occ_model.study.sweep.sweep import measure_point
from occ_model.transmitter.framings.preamble import FRAMING
from occ_model.transmitter.line_codes.manchester import LINE_CODE
from occ_model.transmitter.scheme import code_of
from occ_model.video.reader import VideoReader

NAME = "own"

SCENES = tuple(
    occ.load_preset("phone-68us").replace(rows=60, distance=0.6, switching_frequency=4e3, **changes)
    for changes in ({}, {"payload": "text:HI"}, {"pattern": "1100"}, {"enhancement": "none"})
)

RUBBISH: tuple[Any, ...] = (
    None, True, -1, 0, 1, 2**70, 10**5000, 1.5, -7.0, 1e-320, float("nan"), float("inf"), 1j, "",
    "a\x1b[31m", "x" * 10_000, b"\0", object(), [], [1], {}, (), (1, "2"), (0, 0), (2**70,),
    np.array(1), np.array([]), np.array([0.5, 1.0]), np.array([1, 0, 1]), np.zeros((2, 2)),
    np.array(["1", "0"]), np.array([1, None]), np.array([1j, 0]), np.array([np.nan, 1.0]),
    np.array([np.inf, 1.0]), np.array([2**70, 1]), np.zeros(2, dtype=[("a", "u1")]),
    np.array([1, 0], dtype="datetime64[s]"), np.array([np.longdouble("1e4000"), 0]),
    np.ma.masked_array([1, 0], [True, False]), np.broadcast_to(np.uint8(0), 10**12),
    np.zeros(200), np.float32(0.5), np.int64(3), np.str_("a"), np.bool_(1), occ.Scene(), len,
    SimpleNamespace(),
)  # fmt: skip


class Own(BaseException):
    """An exception that ``except Exception`` does not catch."""


class WordlessError(Exception):
    def __str__(self) -> str:
        raise ValueError("no words")


FAULTS: tuple[BaseException, ...] = (
    ValueError("not today"), ValueError("a\x1b[31m\nb" * 1000), Own("out"), WordlessError(),
    SystemExit(3), GeneratorExit(), StopIteration(1), MemoryError(), RecursionError(), OSError(),
    UnicodeDecodeError("utf-8", b"\xff", 0, 1, "no"), occ.ParameterError("y is 3; allowed: 1."),
    occ.ParameterError("long " * 1000), occ.PluginError("odd\n"), KeyError("k"),
)  # fmt: skip


def check_read(result: occ.DecodeResult, columns: int, scene: occ.Scene) -> None:
    """Check that a result is complete and possible, whichever decoder made it."""
    assert type(result) is occ.DecodeResult
    for name in ("bits", "chips"):
        values = getattr(result, name)
        assert values.dtype == np.uint8
        assert values.ndim == 1
        assert set(np.unique(values)) <= {0, 1}
    if result.failure is None:
        assert result.code == code_of(result.bits.tolist())
        assert len(result.bits) == scene.transmitter.payload_length
    else:
        assert type(result.failure) is str
        assert result.failure
        assert result.failure.isprintable()
        assert result.code is None
    assert type(result.payload) is str
    for name, low, high in (
        ("threshold", -math.inf, math.inf), ("chip_length", 0.0, math.inf),
        ("correlation", -1.0, 1.0), ("confidence", 0.0, 1.0),
    ):  # fmt: skip
        number = getattr(result, name)
        assert number is None or (type(number) is float and low <= number <= high)
        assert number is None or math.isfinite(number)
    assert result.chip_length != 0.0
    folded = result.model if result.folded is None else result.folded
    bins = None if folded is None else len(folded)
    for name, length in {
        "signal": columns, "equalized": columns, "light": columns, "light_model": columns,
        "chip_starts": len(result.chips), "chip_likelihoods": len(result.chips),
        "bit_likelihoods": len(result.bits), "folded": bins, "model": bins,
    }.items():  # fmt: skip
        values = getattr(result, name)
        assert values is None or (values.dtype == np.float64 and values.shape == (length,))
        assert values is None or np.isfinite(values).all()
        if name.endswith("likelihoods") and values is not None:
            assert np.all((values >= 0.0) & (values <= 1.0))
    if result.chip_starts is not None:
        assert np.all(np.diff(result.chip_starts) >= 0.0)
        assert np.all(np.abs(result.chip_starts) <= 10.0 * columns + 1e-6)
    assert all(type(place) is int and 0 <= place < len(result.chips) for place in result.headers)


def _raise(error: BaseException) -> NoReturn:
    raise error


def _make_without_fields(kind: type) -> object:
    """Make an object of a subclass whose fields have no values."""
    return object.__new__(type("Mine", (kind,), {}))


def _spoil(chance: Random, given: Any) -> Any:
    """Spoil a plug-in's return value: some of its fields, all of it, or nothing."""
    kind = chance.random()
    if kind < 0.15:
        return _raise(chance.choice(FAULTS))
    if kind < 0.2:
        return _make_without_fields(type(given))
    if kind < 0.25:
        return chance.choice(RUBBISH)
    if kind < 0.35 or isinstance(given, np.ndarray):
        return given if chance.random() < 0.6 else chance.choice(RUBBISH)
    names = [field.name for field in fields(given)]
    if isinstance(given, occ.DecodeResult) and chance.random() < 0.3:
        return replace(given, chip_starts=_make_rising_starts(chance, len(given.chips)))
    spoiled = chance.sample(names, chance.choice((1, 1, 2)))
    return replace(given, **{name: chance.choice(RUBBISH) for name in spoiled})


def _make_rising_starts(chance: Random, count: int) -> FloatArray:
    """Return rising starts of chips, some of them extremely close together or far apart."""
    far = chance.choice((0.0, 5e-324, 1e-300, 1e-9, 1e-3, 1.0, 300.0, 2e4))
    first = chance.choice((-2e4, -1.0, 0.0, 0.0, 1e3))
    return np.sort([first + chance.uniform(0.0, far) for _ in range(count)]).astype(np.float64)


def _spoil_function(chance: Random, function: Callable[..., Any]) -> Callable[..., Any]:
    if chance.random() < 0.05:
        return chance.choice(RUBBISH)
    return lambda *given: _spoil(chance, function(*given))


def make_plugin(chance: Random, group: str) -> object:
    """Return a plug-in's object that may fail in any way."""
    if group == plugins.DECODERS:
        read = decoder_named(chance.choice(("threshold", "matched"))).read
        title = "Own" if chance.random() < 0.97 else chance.choice(RUBBISH)
        return occ.Decoder(NAME, title, _spoil_function(chance, read))
    base: Any = LINE_CODE if group == plugins.LINE_CODES else FRAMING
    changes: dict[str, Any] = {"name": NAME, "decode": _spoil_function(chance, base.decode)}
    if chance.random() < 0.3:
        changes["encode"] = _spoil_function(chance, base.encode)
    if chance.random() < 0.2:
        names = [field.name for field in fields(base) if field.name != "name"]
        changes[chance.choice(names)] = chance.choice(RUBBISH)
    return replace(base, **changes)


@contextmanager
def install_plugin(group: str, offer: object) -> Iterator[None]:
    """Install a plug-in of one object within the context."""
    entry = SimpleNamespace(name=NAME, dist=None, load=lambda: offer)

    def find(wanted: str) -> dict[str, Any]:
        return {NAME: entry} if wanted == group else {}

    forget_plugins()
    with patch.object(plugins, "_find_entries", find):
        yield
    forget_plugins()


def _decode(scene: occ.Scene, decoder: str, _folder: Path) -> list[str]:
    profile = occ.column_profile(scene)
    result = occ.decode(profile, scene, decoder)
    check_read(result, len(profile), scene)
    rows = list(decode_drawing(scene, result).rows())
    assert len(rows) >= len(profile)
    failure = result.failure or ""
    return [failure] if failure.startswith("The plug-in") else []


def _run_command(scene: occ.Scene, decoder: str, folder: Path) -> list[str]:
    scene_file, picture = folder / "scene.toml", folder / "picture.png"
    plain = scene.replace(line_code="manchester", framing="paper")
    scene_file.write_text(scene.to_toml(), "utf-8")
    write_image(picture, occ.render(plain).image)
    output, complaints = io.StringIO(), io.StringIO()
    with redirect_stdout(output), redirect_stderr(complaints):
        code = main(["decode", str(picture), "--scene", str(scene_file), "--decoder", decoder])
    assert code in (0, EXIT_FAILURE, EXIT_MISUSE), complaints.getvalue()
    assert "mistake" not in complaints.getvalue(), complaints.getvalue()
    return []


def _measure_rate(scene: occ.Scene, decoder: str, _folder: Path) -> list[str]:
    point = measure_point(scene, RateSettings(2, (decoder,)), 0, {})
    assert 0 <= point.right[0] <= point.sent
    return [point.note] if point.note else []


def _measure_bench(scene: occ.Scene, decoder: str, _folder: Path) -> list[str]:
    sent = scene.transmitter
    request = BenchRequest(
        (f"{sent.line_code}/{sent.framing}",), (decoder,), payload_bits=8, bits=16, rows=400
    )
    (point,) = measure_bench_point(request, request.points[0])
    assert 0 <= point.errors.errors <= point.errors.bits
    return [point.errors.faults] if point.errors.faults else []


@cache
def _film(scene: occ.Scene) -> tuple[occ.VideoFrame, ...]:
    return tuple(occ.render_video(scene, 3))


def _read_film(scene: occ.Scene, decoder: str, _folder: Path) -> list[str]:
    plain = scene.replace(line_code="manchester", framing="paper")
    reader = VideoReader(scene, decoder)
    for frame in _film(plain):
        reader.add(frame)
    reading = reader.reading()
    return [reading.faults] if reading.faults else []


_CHANGES = {
    plugins.DECODERS: {},
    plugins.LINE_CODES: {"line_code": NAME, "framing": "preamble"},
    plugins.FRAMINGS: {"framing": NAME, "line_code": "manchester"},
}
"""The parameters with which a scene uses the plug-in of each group."""


def _plugin(chance: Random, folder: Path) -> list[str]:
    group = chance.choice(
        (plugins.DECODERS, plugins.DECODERS, plugins.LINE_CODES, plugins.FRAMINGS)
    )
    with install_plugin(group, make_plugin(chance, group)):
        scene = chance.choice(SCENES).replace(**_CHANGES[group])
        decoder = NAME if group == plugins.DECODERS else chance.choice(("threshold", "matched"))
        use = chance.choice(
            (_decode, _decode, _run_command, _measure_rate, _measure_bench, _read_film)
        )
        return use(scene, decoder, folder)


PLUGINS = Door(
    "plug-ins", "results of plug-ins", _plugin, (occ.PluginError, occ.ParameterError), fraction=40,
    patience=5.0,
)  # fmt: skip
