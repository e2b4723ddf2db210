"""A table of several matched photos with their combined estimates, and its CSV."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from occ_model.errors import inflect, make_printable, one_line
from occ_model.results.match import Match, known_parameter
from occ_model.results.sweep_csv import csv_row, scene_comments
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.version import __version__

SURE, DOUBTFUL, REFUSED, UNREADABLE = "sure", "doubtful", "refused", "unreadable"
"""Verdicts on a photo: the two of a match, no match, and a file that cannot be read."""

VERDICTS = (SURE, DOUBTFUL, REFUSED, UNREADABLE)


@dataclass(frozen=True, slots=True)
class PhotoRow:
    path: Path
    verdict: str  # One of VERDICTS
    # Sentences on why the match, or only its exposure time, is not sure
    note: str = ""
    match: Match | None = field(default=None, compare=False, repr=False)  # None without a match
    # Exposure time in seconds, from the file's metadata
    noted_exposure: float | None = None
    # Lines read out for a picture, the photo's columns; 0 for an unreadable file
    lines: int = 0
    # Width and height of the upright picture in pixels; (0, 0) for an unreadable file
    size: tuple[int, int] = (0, 0)
    # ``"lines"`` or ``"columns"`` of the upright picture; empty for an unreadable file
    scanned_along: str = ""
    camera: str | None = None  # Maker and model
    # Value of the known parameter that was given for this photo, in SI units; None for the scene's
    given: float | None = None

    @property
    def readout_time(self) -> float | None:
        return None if self.match is None else self.match.readout_time

    @property
    def switching_frequency(self) -> float | None:
        """The frequency of a code; None for a lamp."""
        return None if self.match is None or self.match.lamp else self.match.switching_frequency

    @property
    def lamp_frequency(self) -> float | None:
        return None if self.match is None else self.match.lamp_frequency

    @property
    def duty(self) -> float | None:
        return None if self.match is None else self.match.duty

    @property
    def exposure_time(self) -> float | None:
        return None if self.match is None else self.match.exposure_time

    @property
    def correlation(self) -> float | None:
        return None if self.match is None else self.match.correlation

    @property
    def pattern(self) -> str:
        """The chips of a code; empty for a lamp."""
        return "" if self.match is None or self.match.lamp else self.match.pattern

    def uncertainty(self, name: str) -> float | None:
        """Return the standard deviation of an estimate, None if it was not estimated."""
        return None if self.match is None else self.match.uncertainties.get(name)

    @property
    def exposure_verdict(self) -> str:
        """The verdict on the exposure time; empty without a match."""
        return "" if self.match is None else self.match.exposure_verdict


@dataclass(frozen=True, slots=True)
class CombinedEstimate:
    """Weighted mean of several estimates."""

    value: float  # Weighted by the inverse variances
    # Standard deviation of a mean of independent estimates, times ``scale``
    uncertainty: float
    count: int
    # Sum of the squared differences from the mean, in standard deviations
    chi_square: float
    # Probability of at least this chi-square if the standard deviations are right
    probability: float
    # At least 1, see `weighted_mean`; above 1 if the estimates scatter more than their standard
    # deviations, or so little that they may share an error
    scale: float
    # Indices of the estimates that were excluded as too far from the others
    outliers: tuple[int, ...] = ()

    @property
    def degrees_of_freedom(self) -> int:
        return self.count - 1

    @property
    def agrees(self) -> bool:
        """Whether the estimates agree within their standard deviations, at a level of 1 %."""
        return self.probability >= _MIN_PROBABILITY


_MIN_PROBABILITY = 0.01


@dataclass(frozen=True, slots=True)
class PhotoTable:
    """Several photos of one scene.

    Parameters
    ----------
    estimate
        The parameter that was measured: ``"readout_time"``, ``"switching_frequency"``, or
        ``"lamp_frequency"`` where every sure photo shows a lamp.
    rows
        One for each photo, in the given order.
    estimated, exposure_time
        Means over the sure photos, and over those with a sure exposure time; None if there are
        none, or if the photos differ in exposure time. ``outliers`` are indices of ``rows``.
    notes
        Sentences about all photos together.
    """

    scene: Scene
    estimate: str
    rows: tuple[PhotoRow, ...]
    estimated: CombinedEstimate | None
    exposure_time: CombinedEstimate | None
    notes: tuple[str, ...] = ()

    @property
    def known(self) -> str:
        """The parameter that was taken as known, the other one of the two."""
        return known_parameter(self.estimate, self.scene.transmitter)

    def count(self, verdict: str) -> int:
        """Count the photos with a verdict."""
        return sum(row.verdict == verdict for row in self.rows)

    def is_outlier(self, index: int) -> bool:
        """Return whether a photo was excluded from the mean as too far from the others."""
        return self.estimated is not None and index in self.estimated.outliers

    @property
    def rests_on_the_scene(self) -> bool:
        """Whether the scene's known value was used for any photo."""
        return any(row.given is None for row in self.rows)

    def is_counted(self, index: int) -> bool:
        """Return whether a photo contributes to the mean."""
        is_sure = self.rows[index].verdict == SURE
        return self.estimated is not None and is_sure and not self.is_outlier(index)


_MAX_TEXT_LENGTH = 10_000  # most characters of a text; a path has fewer

_COLUMNS = (
    "file", "verdict", "in the mean", "readout time (s)", "its error (s)",
    "switching frequency (Hz)", "its error (Hz)", "exposure time (s)", "its error (s)",
    "exposure time is", "rests on", "noted exposure time (s)", "correlation", "chips", "lines",
    "camera", "note", "lamp frequency (Hz)", "its error (Hz)", "duty", "its error",
)  # fmt: skip


def csv_text(table: PhotoTable, extra_notes: Sequence[str] = (), condition: str = "") -> str:
    """Write a table; ``condition`` is empty, or that of estimates, as ``"if f = 10 kHz: "``."""
    counts = ", ".join(
        f"{table.count(v)} {v}" for v in dict.fromkeys(r.verdict for r in table.rows)
    )
    lines = [
        f"# Match of {inflect(len(table.rows), 'photo')}: {counts}",
        f"# occ_model {__version__}",
        f"# measured: {table.estimate}",
        *_mean_lines(table.estimate, table.estimated, condition),
        *_mean_lines("exposure_time", table.exposure_time, condition),
        *(f"# {make_printable(note)}" for note in (*table.notes, *extra_notes)),
        *scene_comments(table.scene),
    ]
    return "\n".join(lines) + "\n" + csv_row(_COLUMNS) + "".join(_photo_rows(table, condition))


def _photo_rows(table: PhotoTable, condition: str) -> list[str]:
    texts = []
    known = quantity(table.known)
    scene_basis = _given_text(known, float(table.scene.value(table.known)))
    rests_on = condition.removesuffix(": ") or scene_basis
    for index, row in enumerate(table.rows):
        in_mean = (
            "outlier" if table.is_outlier(index) else "yes" if table.is_counted(index) else "no"
        )
        basis = rests_on if row.given is None else _given_text(known, row.given)
        texts.append(
            csv_row(
                [_quote_text(str(row.path)), row.verdict, in_mean,
                 *_estimates(row, "readout_time", "switching_frequency", "exposure_time"),
                 row.exposure_verdict, None if row.match is None else basis, row.noted_exposure,
                 row.correlation, row.pattern, row.lines or None,
                 _quote_text(row.camera or ""), _quote_text(row.note),
                 *_estimates(row, "lamp_frequency", "duty")]
            )
        )  # fmt: skip
    return texts


def _estimates(row: PhotoRow, *names: str) -> Iterator[object]:
    """Yield some estimates of a photo, each before its error."""
    for name in names:
        yield getattr(row, name)
        yield _format_error(row.uncertainty(name))


def _given_text(known: Quantity, value: float) -> str:
    return f"{known.symbol} = {known.format(value)}, given"


def _mean_lines(name: str, estimate: CombinedEstimate | None, condition: str) -> list[str]:
    if estimate is None:
        return [f"# no mean of {name}"]
    value = quantity(name).unit.round_estimate(estimate.value, estimate.uncertainty)
    photos, outliers = inflect(estimate.count, f"{SURE} photo"), len(estimate.outliers)
    lines = [
        f"# mean of {name}: {condition}{value!r} +- {_format_error(estimate.uncertainty)}, from "
        f"{photos}, {inflect(outliers, 'outlier')}"
    ]
    if estimate.count > 1:
        lines.append(
            f"# chi-square of {name}: {estimate.chi_square:.4g} of "
            f"{inflect(estimate.degrees_of_freedom, 'degree')} of freedom, probability "
            f"{estimate.probability:.3g}, error widened {estimate.scale:.3g} times"
        )
    return lines


def _format_error(deviation: float | None) -> str | None:
    """Format a standard deviation to two digits, as in the window."""
    return None if deviation is None else f"{deviation:.1e}"


_FORMULA = "=+-@\uff1d\uff0b\uff0d\uff20"  # start of a spreadsheet's formula, also full-width


def _quote_text(text: str) -> str:
    """Quote a text from a file, so that no spreadsheet evaluates it."""
    text = one_line(text, _MAX_TEXT_LENGTH)
    return f"'{text}" if text.startswith(tuple(_FORMULA)) else text


def assumption(name: str, value: float) -> str:
    """Return the condition of estimated times, such as ``"if f = 10 kHz: "``."""
    known = quantity(name)
    if name == "lamp_frequency":
        return f"if it is a lamp of {known.format(value)}: "
    return f"if {known.symbol} = {known.format(value)}: "
