"""What removes a lamp's bars from pictures and films, as an answer of one line and details."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from occ_model.results.bands import NO_BARS_DEPTH, ROUNDING_DEPTH, SpeedDepth, percent
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.units import SECOND

ROWS = Count(
    "rows", "Rows in turn", "n", "Rows, or groups of rows, of a panel that are lit in turn.",
    1, 10_000, 16,
)  # fmt: skip

_DIGITS = 4
_FRACTIONS = (1 / 20_000, 0.3)  # seconds between which shutter times are written as 1/n s


def shutter_words(seconds: float) -> str:
    """Write a shutter time as on a camera where it is one over a whole number: 1/100 s."""
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
    # How often in a second the bars come back to their place; 0: they stand still
    frequency: float


@dataclass(frozen=True, slots=True)
class FrameRateBeats:
    """What becomes of a lamp's bars in a film of a usual frame rate."""

    name: str  # As written on cameras: 29.97
    rate: float  # Frames a second
    beats: tuple[Beat, ...]  # Of the sines whose bars are deep enough, the deepest first

    @property
    def frequency(self) -> float:
        """How often in a second the deepest of the moving bars come back; 0 for none."""
        return next((beat.frequency for beat in self.beats if beat.frequency), 0.0)

    @property
    def stands_still(self) -> bool:
        """Whether no bars move."""
        return not self.frequency


@dataclass(frozen=True, slots=True)
class UnlitRows:
    """Rows of a panel lit row by row, in one exposure, on average over its starts."""

    dark: float  # Fraction of the rows of which no light falls into the exposure
    cut: float  # Fraction that the exposure's start or end cuts short


@dataclass(frozen=True, slots=True)
class BarsAnswer:
    """Shutter speeds without bars, and the depth at the one asked about.

    Parameters
    ----------
    lamp
        What the lamp is, as a noun.
    exposure, depth
        The shutter time in s, and the depth of the bars, peak to peak over the mean.
    speeds
        Usual shutter speeds near it without bars, longest first; those that hold on every camera,
        if there are any.
    best
        The usual shutter speed near it with the weakest bars; None if none is near.
    valley
        Exposure in seconds whose whole multiples show no bars; 0 for steady light.
    columns
        Lines of the picture from bar to bar; infinite where there are no bars, None if the readout
        time is not known.
    rates
        Usual frame rates at which the shutter time is possible.
    rows
        Of a panel lit row by row.
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
        """Whether bars are left at the shutter time asked about."""
        return self.depth >= NO_BARS_DEPTH

    @property
    def sentence(self) -> str:
        """The answer in one line."""
        time = shutter_words(self.exposure)
        if not self.valley:
            return "This light is steady: no shutter time shows bars."
        if not self.shows_bars:
            left = f": {percent(self.depth)} of the light" if self.depth > ROUNDING_DEPTH else ""
            return f"No bars at {time}{left}."
        apart = ""
        if self.columns is not None and self.columns < math.inf:
            apart = f", {self.columns:.3g} lines from bar to bar"
        return f"{self._advice} At {time} they are {percent(self.depth)} deep{apart}."

    @property
    def _advice(self) -> str:
        if self.speeds:
            speeds = _join((each.name.removesuffix(" s") for each in self.speeds), "or")
            exactly = "" if any(each.is_free for each in self.speeds) else ", if kept exactly"
            return f"Use {speeds} s{exactly}: no bars."
        return f"Use {shutter_words(self.valley)}, or a whole multiple of it: no bars."

    @property
    def details(self) -> tuple[str, ...]:
        """Why, what films show, and which rows of a panel are dark: a sentence each."""
        if not self.valley:
            return ()
        lines = [
            f"{self.lamp[:1].upper()}{self.lamp[1:]}: its bars vanish at whole multiples of "
            f"{SECOND.format(self.valley, _DIGITS)}, and at no shorter time."
        ]
        if not self.speeds and self.best and self.shows_bars:
            lines.append(
                f"Of the usual shutter speeds near it, {self.best.name} leaves the weakest bars: "
                f"{percent(self.best.at_nominal)}."
            )
        lines += [each.doubt for each in self.speeds if each.doubt][:1]
        if self.rates and self.shows_bars:
            lines += list(self._film_lines())
        if self.rows is not None:
            lines.append(
                f"The rows of this panel are lit in turn: at {shutter_words(self.exposure)}, "
                f"{percent(self.rows.dark)} of them are dark in one picture, and "
                f"{percent(self.rows.cut)} are cut short."
            )
        return tuple(lines)

    def _film_lines(self) -> Iterable[str]:
        still = [each for each in self.rates if each.stands_still]
        if still:
            names = _join((each.name for each in still), "and")
            yield f"In films of {names} frames a second the bars stand still."
        moving = sorted(
            (each for each in self.rates if not each.stands_still), key=lambda each: each.frequency
        )
        times: dict[str, list[str]] = {}
        for each in moving:
            times.setdefault(SECOND.format(1.0 / each.frequency, 3), []).append(each.name)
        if times:
            moves = "; ".join(f"{time} at {_join(names, 'and')}" for time, names in times.items())
            yield f"At other rates they move, and are back after {moves}."
