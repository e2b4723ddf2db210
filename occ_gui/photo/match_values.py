"""Figures of a match: estimates with their uncertainties, quality of the fit, alternatives."""

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from occ_gui.photo.assumption import condition
from occ_gui.photo.match_choice import KNOWN
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.photo.estimate_text import estimate_text
from occ_model.photo.many.other_programs import frame_of_match
from occ_model.results.match import Alternative, Match
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.scene.square_wave import CHIPS_OF_A_CYCLE
from occ_model.scene.units import HERTZ

_ESTIMATES = ("readout_time", "switching_frequency", "exposure_time", "start_time", "gamma")

_DIGITS = 4


def known_of(match: Match) -> str:
    """Return which of readout time and switching frequency was given."""
    return next(name for name in KNOWN if name not in match.uncertainties)


def label_of(name: str) -> str:
    """Return the label of an estimate; the readout time is that of a line, not of the frame."""
    label = quantity(name).label
    if name != "readout_time":
        return label
    return f"{label} a line"


def condition_of(match: Match, certain: Mapping[str, float]) -> str:
    """Name the value that a match's estimates of time rest on, unless the user is certain of it."""
    name = known_of(match)
    return condition(name, float(getattr(match, name)), certain, len(match.pattern))


def with_uncertainty(quantity: Quantity, value: float, spread: float | None) -> str:
    """Format a value with its standard deviation, to the digits that are significant."""
    return estimate_text(quantity, value, spread)


def what_errors_mean() -> str:
    """Say what ± and the verdict mean."""
    return (
        "± is one standard deviation, of the fit alone: the error of the value that is known comes "
        "on top.\nA limit, as in “below 36 µs”, lies two standard deviations above the value.\n"
        "“Sure” means that no check found a reason to doubt the match; the reasons of a "
        "doubtful one are listed."
    )


class MatchValues(QWidget):
    """The figures as a table: a row that says nothing is hidden."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        # A grid: a form would not give lines that wrap their height.
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(2)
        grid.setColumnStretch(1, 1)
        self._certain: Mapping[str, float] = {}
        self._noted: float | None = None
        self.labels: dict[str, QLabel] = {}
        self._titled: dict[str, QLabel] = {}
        for row, (name, title) in enumerate(self._titles().items()):
            # A pattern can be of any length.
            label = ElidedLabel("", Qt.TextElideMode.ElideRight) if name == "pattern" else QLabel()
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setWordWrap(name != "pattern")
            label.setAccessibleName(title)
            if name in (*_ESTIMATES, "frame"):
                label.setToolTip(what_errors_mean())
            self.labels[name] = label
            self._titled[name] = QLabel(title)
            grid.addWidget(self._titled[name], row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(label, row, 1)
        fixed = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        self.labels["pattern"].setFont(fixed)

    def _titles(self) -> dict[str, str]:
        estimates = {name: label_of(name) for name in _ESTIMATES}
        return {
            "readout_time": estimates.pop("readout_time"),
            "frame": "Readout of the whole frame",
            **estimates,
            "others": "or exposed for",
            "chip": "Chip length",
            "periods": "Periods in view",
            "exposed": "Exposure in chips",
            "correlation": "Correlation of fit",
            "region": "Matched",
            "saturated": "Saturated",
            "duty": "Duty",
            "pattern": "Pattern",
            "alternatives": "Alternatives",
        }

    def show_match(self, match: Match, certain: Mapping[str, float], noted: float | None) -> None:
        """Show a match.

        Parameters
        ----------
        certain
            The known values, in SI units by name, that are confirmed and not only assumed.
        noted
            The exposure time in seconds that the camera noted in the photo, None if it did not.
        """
        self._certain, self._noted = certain, noted
        texts = self._estimates(match) | self._quality(match)
        texts["alternatives"] = self._alternatives(match)
        for name, text in texts.items():
            label = self.labels[name]
            if isinstance(label, ElidedLabel):
                label.set_full_text(text)
            else:
                label.setText(text)
            for part in (label, self._titled[name]):
                part.setVisible(bool(text))

    def _estimates(self, match: Match) -> dict[str, str]:
        """Format the estimates and the given value; empty for a gamma that was not fitted."""
        texts = {}
        condition = self._condition(match)
        given = {name: "{value} (given)" for name in _ESTIMATES if name != "gamma"}
        if condition:
            given[known_of(match)] = "{value} (assumed)"
        for name in _ESTIMATES:
            spread = match.uncertainties.get(name)
            texts[name] = with_uncertainty(quantity(name), getattr(match, name), spread)
            if spread is None:
                texts[name] = given.get(name, "").format(value=texts[name])
            elif name != "gamma":  # of the shape of the stripes, not of their timing
                texts[name] = condition + texts[name]
        for name in match.doubtful_alone:
            if texts[name]:
                texts[name] += " (doubtful)"
        frame = frame_of_match(match)
        texts["frame"] = (
            "" if frame is None else condition + with_uncertainty(quantity("readout_time"), *frame)
        )
        if len(match.pattern) == CHIPS_OF_A_CYCLE:
            # A blinking LED is specified by its cycles, not by its chips.
            cycles = HERTZ.format(match.switching_frequency / CHIPS_OF_A_CYCLE, _DIGITS)
            texts["switching_frequency"] += f": blinks at {cycles}"
        exposure = quantity("exposure_time")
        if self._noted is not None:
            texts["exposure_time"] += f"; the camera noted {exposure.format(self._noted, _DIGITS)}"
        others = (exposure.format(t, _DIGITS) for t in match.other_exposures)
        other = " or ".join(others)
        return {**texts, "others": condition + other if other else ""}

    def _condition(self, match: Match) -> str:
        return condition_of(match, self._certain)

    def _quality(self, match: Match) -> dict[str, str]:
        how = "read" if match.pattern_was_read else "given"
        region = match.region
        return {
            "region": (
                f"columns {region.first_column} to {region.last_column - 1}, between the "
                "first edge of a stripe and the last; the "
                "applied scene is dark outside them"
            ),
            "chip": f"{match.columns_per_chip:.3f} columns, {len(match.pattern)} chips a period",
            "periods": f"{match.periods_in_view:.3g}",
            "exposed": f"{match.exposure_in_chips:.3g}",
            "correlation": f"{match.correlation:.4f}, RMSE {match.rmse:.2f} grey levels",
            "saturated": f"{100 * match.stripes.saturated:.1f} % of the region's pixels",
            "duty": f"lit for {100 * match.duty:.3g} % of a period",
            "pattern": f"{match.pattern} ({how})",
        }

    def _alternatives(self, match: Match) -> str:
        estimated = next(name for name in KNOWN if name != known_of(match))
        condition = self._condition(match)
        return "\n".join(
            self._alternative(other, estimated, condition) for other in match.alternatives
        )

    def _alternative(self, other: Alternative, estimated: str, condition: str) -> str:
        side = "lower" if other.evidence <= 0.0 else "higher"
        text = (
            f"• {other.sent}: correlation {other.correlation:.3f}, log-likelihood {side} by "
            f"{abs(other.evidence):.1f}"
        )
        value = getattr(other, estimated)
        if value is not None and other.exposure_time is not None:
            text += "; {condition}{name} {value}, exposed for {exposure}".format(
                condition=condition,
                name=quantity(estimated).label.lower(),
                value=quantity(estimated).format(value, _DIGITS),
                exposure=quantity("exposure_time").format(other.exposure_time, _DIGITS),
            )
        return text
