"""Command lines of both programs, which run to their end or are interrupted."""

import io
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from functools import cache
from pathlib import Path
from random import Random
from types import FrameType
from typing import NoReturn

import damaged_photos
import numpy as np
from PIL import Image
from program_options import all_actions

import occ_model as occ
from hard_cases.fuzzing.mutations import random_number, random_quantity, random_text
from hard_cases.fuzzing.target import FuzzTarget
from occ_model.effects.registry import NAMES
from occ_model.program import EXIT_FAILURE, EXIT_INTERRUPTED, EXIT_MISUSE, INTERRUPTED
from occ_model.scene.parameters import PARAMETERS

_INTERRUPT_S = 0.4
"""Processor time in seconds after which a command is interrupted, as by Ctrl-C."""

_AGAIN_S = 0.01

_IMPORTING = "<frozen importlib."  # start of the file names of functions that import a module
_LONGEST_LINE = 4200  # characters of a line on standard error: a sentence, after the program's name

COMMANDS: dict[str, tuple[str, ...]] = {
    "render": ("-o", "{out}.png"),
    "animate": ("--vary", "distance=0.5:1:x3", "-o", "{out}.gif"),
    "film": ("--frames", "3", "-o", "{out}.mkv"),
    "plan": (),
    "accuracy": (),
    "sweep": ("--vary", "distance=0.5,1", "--images", "1", "--out", "{out}.csv"),
    "limits": ("--images", "1", "--jobs", "1"),
    "bands": (),
    "bench": ("--bits", "10", "--decoder", "threshold"),
    "most-bits": ("--pictures", "1", "--decoder", "threshold"),
    "decode": ("{in}.png",),
    "match": ("{in}.png", "--jobs", "1"),
    "figures": ("--out", "{out}", "--images", "1"),
    "transmit": ("-o", "{out}"),
    "codes": (),
    "presets": (),
    "parameters": (),
}
"""A valid command line of each command, without the options of a small scene."""

_SCENELESS = ("bench", "figures", "codes", "presets", "parameters")

_SMALL = ("--scene", "{in}.toml")

_NO_OPTIONS = (
    "--no-such", "--pre", "--s", "--o", "--set=", "--out=", "-x", "-oo", "--", "-", "---",
)  # fmt: skip
"""Beginnings of options, and words that look like options."""


@cache
def _options() -> tuple[str, ...]:
    """Return the options of both programs, and words that look like options."""
    known = {each for action in all_actions() for each in action.option_strings}
    return (*sorted(known), *_NO_OPTIONS)


_KEPT = ("--jobs", "--images")
"""Options of which valid values may start processes or hours of work."""


def _random_value(random: Random, folder: Path) -> str:
    """Return a value of an option: a path, a setting, a word that an option knows, or any text."""
    kind = random.randrange(7)
    if kind == 0:
        return str(folder / random.choice(_FILES))
    if kind == 1:
        return f"{random.choice((*PARAMETERS,))}={random_quantity(random)}"
    if kind == 2:
        return random.choice((
            *NAMES, "threshold", "matched", "sequence", "equalizer", "both", "all", "exact",
            "camera", "receiver", "profile", "lines", "columns", "red", "readout_time", "read",
            "scene", "pico",
            "0:9,0:9", "1s:offset_x=2cm,roll=5deg", "manchester/preamble", "phone-68us", "10,20",
            "1kHz,2kHz", "1280x800", "dark", "split", "explore", "map",
        ))  # fmt: skip
    if kind in (3, 4):
        return random_quantity(random)
    if kind == 5:
        name = random.choice((*PARAMETERS,))
        return f"{name}={':'.join(random_number(random) for _ in range(3))}"
    return random_text(random)


_FILES = (
    "in.png", "in.toml", "in.csv", "damaged.png", "folder", "nowhere/out.png", "missing.toml",
    "out.png", "out.csv", "out.toml", "out.pdf", "out.svg", "out.gif", "out.mkv", "out.mp4", "out",
    "link", "in.png/x", "folder/../in.png", "a" * 300, ".", "..", "é\n.png", "out.PNG", "empty",
)  # fmt: skip


@cache
def _picture() -> bytes:
    scene = occ.load_preset("phone-68us").replace(rows=20)
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(occ.render(scene).image)).save(buffer, "PNG")
    return buffer.getvalue()


def _write_files(folder: Path, random: Random) -> None:
    """Write the files named in command lines."""
    scene = occ.Scene().replace(rows=8, columns=120, readout_time=20e-6, distance=0.6)
    (folder / "in.toml").write_text(scene.to_toml(), "utf-8")
    (folder / "in.png").write_bytes(_picture())
    (folder / "in.csv").write_text("a,b\n1,2\n", "utf-8")
    (folder / "damaged.png").write_bytes(damaged_photos.make_damaged(random.getrandbits(32))[1])
    (folder / "empty").touch()
    (folder / "folder").mkdir()
    (folder / "link").symlink_to("in.png")


def _make_words(random: Random, folder: Path, command: str, usual: Sequence[str]) -> list[str]:
    """Return a valid command line with a few random changes."""
    paths = {"in": str(folder / "in"), "out": str(folder / "out")}
    words = [word.format(**paths) for word in usual]
    for _ in range(random.choice((0, 1, 1, 1, 2, 3))):
        place, kind = random.randint(0, len(words)), random.randrange(6)
        if kind < 3:
            option = random.choice(_options())
            value = _random_value(random, folder)
            if option in _KEPT and random.random() < 0.8:
                value = random.choice(("0", "1", "-1", "x", "1e9", "99999999999"))
            words[place:place] = [f"{option}={value}"] if random.random() < 0.2 else [option, value]
        elif kind == 3 and words:
            words[place % len(words)] = _random_value(random, folder)
        elif kind == 4 and words:
            del words[place % len(words)]
        elif words:
            words.insert(place, words[place % len(words)])
    return [command, *words] if command else words


class _InterruptLater:
    """Interrupts a command that takes long, as Ctrl-C does."""

    def __enter__(self) -> None:
        self._hook = sys.unraisablehook
        sys.unraisablehook = self._hear_unraisable
        self._late = signal.getsignal(signal.SIGPROF)
        self._left = signal.getitimer(signal.ITIMER_PROF)
        signal.signal(signal.SIGPROF, self._interrupt)
        signal.setitimer(signal.ITIMER_PROF, _INTERRUPT_S)

    @staticmethod
    def _interrupt(_signal: int, frame: FrameType | None) -> None:
        # An interrupted import may be impossible to repeat, as in fontTools. Ctrl-C ends the
        # program, but here the next case would use the incomplete module.
        if any(each.f_code.co_filename.startswith(_IMPORTING) for each in _stack(frame)):
            signal.setitimer(signal.ITIMER_PROF, _AGAIN_S)
            return
        raise KeyboardInterrupt

    def _hear_unraisable(self, what: "sys.UnraisableHookArgs") -> None:
        """Interrupt again a little later if an interrupt was ignored, as a second Ctrl-C does."""
        if issubclass(what.exc_type, KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_PROF, _AGAIN_S)
        else:
            self._hook(what)

    def __exit__(self, *_fault: object) -> None:
        sys.unraisablehook = self._hook
        signal.signal(signal.SIGPROF, self._late)
        signal.setitimer(signal.ITIMER_PROF, *self._left)


def _stack(frame: FrameType | None) -> Iterator[FrameType]:
    while frame is not None:
        yield frame
        frame = frame.f_back


@contextmanager
def _streams() -> Iterator[tuple[io.StringIO, io.StringIO]]:
    with redirect_stdout(io.StringIO()) as out, redirect_stderr(io.StringIO()) as err:
        yield out, err


def run_main(main: Callable[[Sequence[str]], int], words: Sequence[str]) -> tuple[int, str, str]:
    """Run a program's main function; return its exit code, output and messages."""
    # Files that an interrupt leaves open, such as fonts, are closed by the garbage collector.
    warnings.simplefilter("ignore", ResourceWarning)
    with _streams() as (out, err):
        try:
            with _InterruptLater():
                code = main(words)
        except SystemExit as left:
            code = left.code if isinstance(left.code, int) else EXIT_FAILURE
        except KeyboardInterrupt:  # the command had just ended
            code = EXIT_INTERRUPTED
            err.write(f": {INTERRUPTED}\n")
    return code, out.getvalue(), err.getvalue()


def check_output(code: int, out: str, err: str) -> list[str]:
    """Check exit code, output and messages; return a sentence if the program refused or failed."""
    for line in out.split("\n"):
        assert line.isprintable(), f"not one printable line of output: {line!r}"
    assert "Traceback" not in err, err
    assert "mistake in this program" not in err, err
    lines = [line.split("\r")[-1] for line in err.split("\n")]
    lines = [line for line in lines if line.strip()]
    for line in lines:
        assert line.isprintable(), f"not one printable line: {line!r}"
        assert len(line) <= _LONGEST_LINE, f"{len(line)} characters"
    if code == 0:
        return []
    assert code in (EXIT_FAILURE, EXIT_MISUSE, EXIT_INTERRUPTED), code
    if code == EXIT_MISUSE:
        # The usage of a wrong option is also followed by one line.
        said = [line for line in lines if line.startswith("occ-")]
        assert len(said) == 1, err
        assert lines[-1] == said[0], err
    return ["It said so."]


def _run_command(random: Random, folder: Path) -> list[str]:
    from occ_model.cli import main

    _write_files(folder, random)
    command = random.choice((*COMMANDS,))
    usual = COMMANDS[command] if command in _SCENELESS else (*_SMALL, *COMMANDS[command])
    words = _make_words(random, folder, command, usual)
    before = _read_inputs(folder)
    code, out, err = run_main(main, words)
    try:
        assert _read_inputs(folder) == before, "an input was overwritten"
        return check_output(code, out, err)
    except AssertionError as fault:
        raise AssertionError(f"{words} -> {code}: {fault}") from None


def _read_inputs(folder: Path) -> tuple[bytes, ...]:
    return tuple((folder / name).read_bytes() for name in ("in.toml", "in.png"))


SHELL = FuzzTarget(
    "command lines", "words of 17 commands", _run_command, (), fraction=60, patience=10.0
)


def _start_window(random: Random, folder: Path) -> list[str]:
    import pytest

    from occ_gui.app import command_line

    def start(*_arguments: object) -> NoReturn:
        raise occ.OccError("The window opens.")

    _write_files(folder, random)
    words = _make_words(random, folder, "", random.choice((_SMALL, (), ("{in}.png",))))
    before = _read_inputs(folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OCC_STATE", str(folder / "state"))
        patch.setattr(command_line, "start", start)
        code, out, err = run_main(command_line.main, words)
    try:
        assert _read_inputs(folder) == before, "an input was overwritten"
        said = check_output(code, out, err)
    except AssertionError as fault:
        raise AssertionError(f"{words} -> {code}: {fault}") from None
    return [] if "The window opens." in err else said


WINDOW_SHELL = FuzzTarget(
    "window's command lines", "words of occ-gui", _start_window, (), fraction=60
)
