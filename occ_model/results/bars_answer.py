"""What removes a lamp's bars from pictures and films, as an answer of one line and details."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from occ_model.errors import capitalize
from occ_model.results.bands import (
    NO_BARS_DEPTH,
    ROUNDING_DEPTH,
    SpeedDepth,
    depth_text,
    format_depth,
)
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.units import SECOND

ROWS = Count(
    "rows", "Rows in turn", "n", "Rows, or groups of rows, of a panel that are lit in turn.",
    1, 10_000, 16,
)  # fmt: skip

_DIGITS = 4
_FRACTIONS = (1 / 20_000, 0.3)  # seconds between which shutter times are written as 1/n s


def format_shutter_time(seconds: float) -> str:
    """Format a shutter time, as on a camera if it is one over a whole number: 1/100 s."""
    inverse = round(1.0 / seconds)
    if _FRACTIONS[0] <= seconds < _FRACTIONS[1] and abs(inverse * seconds - 1.0) < 1e-9:
        return f"1/{inverse} s"
    return SECOND.format(seconds, _DIGITS)


def _join(words: Iterable[str], last: str) -> str:
    *others, final = words
    return f"{', '.join(others)} {last} {final}" if others else final


@dataclass(frozen=True, slots=True)
class Beat:
    """How the bars of one sine of a light move in a film."""

    depth: float  # Peak to peak, over the mean
    # How many times a second the bars return to their place; 0 if they stand still
    frequency: float


@dataclass(frozen=True, slots=True)
class FrameRateBeats:
    """The motion of a lamp's bars in a film of a usual frame rate."""

    name: str  # As written on cameras: 29.97
    rate: float  # Frames a second
    beats: tuple[Beat, ...]  # Of the sines whose bars are deep enough, the deepest first

    @property
    def frequency(self) -> float:
        """How many times a second the deepest moving bars return to their place; 0 for none."""
        return next((beat.frequency for beat in self.beats if beat.frequency), 0.0)

    @property
    def stands_still(self) -> bool:
        """Whether no bars move."""
        return not self.frequency


@dataclass(frozen=True, slots=True)
class UnlitRows:
    """Rows of a panel lit row by row in one exposure, averaged over its starts."""

    dark: float  # Fraction of the rows that are not lit during the exposure
    cut: float  # Fraction of the rows that are lit when the exposure starts or ends


@dataclass(frozen=True, slots=True)
class BarsAnswer:
    """Shutter speeds without bars, and the depth of the bars at a given shutter time.

    Parameters
    ----------
    lamp
        What the lamp is, as a noun.
    exposure, depth
        The shutter time in s, and the depth of the bars, peak to peak over the mean.
    speeds
        Usual shutter speeds near it without bars, longest first; only those without bars on every
        camera, if there are any.
    best
        The usual shutter speed near it with the weakest bars; None if none is near.
    valley
        Exposure in seconds whose integer multiples show no bars; 0 for steady light.
    columns
        Lines of the picture from bar to bar; infinite if there are no bars, None if the readout
        time is unknown.
    rates
        Usual frame rates at which the shutter time is possible.
    rows
        Those of a panel lit row by row; None for another lamp.
    """

    lamp: str
    exposure: float
    depth: float
    speeds: tuple[SpeedDepth, ...]
    best: SpeedDepth | None
    valley: float
    columns: float | None = None
    rates: tuple[FrameRateBeats, ...] = ()
    rows: UnlitRows | None = None

    @property
    def shows_bars(self) -> bool:
        """Whether there are bars at the given shutter time."""
        return self.depth >= NO_BARS_DEPTH

    @property
    def sentence(self) -> str:
        """The answer in one line."""
        time = format_shutter_time(self.exposure)
        if not self.valley:
            return "This light is steady: no shutter time shows bars."
        if not self.shows_bars:
            remainder = f": {depth_text(self.depth)}" if self.depth > ROUNDING_DEPTH else ""
            return f"No bars at {time}{remainder}."
        distance = ""
        if self.columns is not None and self.columns < math.inf:
            distance = f", {self.columns:.3g} lines from bar to bar"
        return f"{self._advice} At {time} they are {depth_text(self.depth)}{distance}."

    @property
    def _advice(self) -> str:
        if self.speeds:
            speeds = _join((speed.name.removesuffix(" s") for speed in self.speeds), "or")
            condition = "" if any(speed.is_free for speed in self.speeds) else ", if kept exactly"
            return f"Use {speeds} s{condition}: no bars."
        return f"Use {format_shutter_time(self.valley)}, or a whole multiple of it: no bars."

    @property
    def details(self) -> tuple[str, ...]:
        """Sentences on the reason, on bars in films, and on the dark rows of a panel."""
        if not self.valley:
            return ()
        lines = [
            f"{capitalize(self.lamp)}: its bars vanish at whole multiples of "
            f"{SECOND.format(self.valley, _DIGITS)}, and at no shorter time."
        ]
        if not self.speeds and self.best and self.shows_bars:
            lines.append(
                f"Of the usual shutter speeds near it, {self.best.name} leaves the weakest bars: "
                f"{format_depth(self.best.at_nominal)}."
            )
        lines += [speed.doubt for speed in self.speeds if speed.doubt][:1]
        if self.rates and self.shows_bars:
            lines += list(self._film_lines())
        if self.rows is not None:
            lines.append(
                f"The rows of this panel are lit in turn: at {format_shutter_time(self.exposure)}, "
                f"{format_depth(self.rows.dark)} of them are dark in one picture, and "
                f"{format_depth(self.rows.cut)} are cut short."
            )
        return tuple(lines)

    def _film_lines(self) -> Iterable[str]:
        still = [rate for rate in self.rates if rate.stands_still]
        if still:
            names = _join((rate.name for rate in still), "and")
            yield f"In films of {names} frames a second the bars stand still."
        moving = sorted(
            (rate for rate in self.rates if not rate.stands_still), key=lambda rate: rate.frequency
        )
        times: dict[str, list[str]] = {}
        for rate in moving:
            times.setdefault(SECOND.format(1.0 / rate.frequency, 3), []).append(rate.name)
        if times:
            moves = "; ".join(f"{time} at {_join(names, 'and')}" for time, names in times.items())
            yield f"At other rates they move, and return after {moves}."
