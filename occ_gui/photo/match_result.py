"""Result of a match: estimates with their uncertainties, quality of the fit, and their use."""

import math
from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from occ_gui.photo.match_choice import CHIPS_OF_A_CYCLE, KNOWN
from occ_gui.widgets.elided_label import ElidedLabel
from occ_model.results import Match
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ

_ESTIMATES = ("readout_time", "switching_frequency", "exposure_time", "start_time", "gamma")


def _known_of(match: Match) -> str:
    """Return which of readout time and switching frequency was given."""
    return next(name for name in KNOWN if name not in match.uncertainties)


def with_uncertainty(quantity: Quantity, value: float, spread: float | None) -> str:
    """Format a value with its standard deviation, to the digits that are significant."""
    if spread is None or not 0.0 < spread < math.inf:
        return quantity.format(value)
    symbol, factor = quantity.unit.display(value)
    # Two digits of the uncertainty, and the value to the same decimal place.
    decimals = min(max(0, 1 - math.floor(math.log10(spread / factor))), 12)
    number = f"{value / factor:.{decimals}f} ± {spread / factor:.{decimals}f}"
    return f"{number} {symbol}".rstrip()


class MatchResult(QWidget):
    """The estimates as a table, how well they explain the photo, and buttons to use them."""

    apply_asked = Signal()
    """The user applies the matched scene."""

    save_asked = Signal()
    """The user saves the matched scene as a preset."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._form = QFormLayout()
        self._form.setContentsMargins(0, 0, 0, 0)
        self._form.setVerticalSpacing(2)
        self.values: dict[str, QLabel] = {}
        for name, title in self._titles().items():
            # A pattern can be of any length.
            label = ElidedLabel("", Qt.TextElideMode.ElideRight) if name == "pattern" else QLabel()
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setWordWrap(name != "pattern")
            label.setAccessibleName(title)
            self.values[name] = label
            self._form.addRow(title, label)
        fixed = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        self.values["pattern"].setFont(fixed)
        self._match: Match | None = None
        self._scene: Scene | None = None
        self._given = math.nan
        self._certain: Mapping[str, float] = {}
        self.stale = QLabel()
        self.stale.setWordWrap(True)
        self.stale.setTextFormat(Qt.TextFormat.PlainText)
        self.stale.setAccessibleName(self.tr("Whether the match still belongs to the known value"))
        self.stale.hide()
        self.apply = QPushButton(self.tr("&Apply to the scene"))
        self.apply.setToolTip(
            self.tr(
                "Put the result into the scene, as one step that can be undone: its picture then "
                "lies on the photo."
            )
        )
        self.apply.clicked.connect(self.apply_asked)
        self.save = QPushButton(self.tr("&Save as preset…"))
        self.save.setToolTip(
            self.tr(
                "Save the result as a preset of your own, with the photo and the uncertainties as "
                "its sources."
            )
        )
        self.save.clicked.connect(self.save_asked)
        buttons = QHBoxLayout()
        buttons.addWidget(self.apply)
        buttons.addWidget(self.save)
        buttons.addStretch()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(self._form)
        layout.addWidget(self.stale)
        layout.addLayout(buttons)

    def _titles(self) -> dict[str, str]:
        estimates = {name: quantity(name).label for name in _ESTIMATES}
        return {
            **estimates,
            "others": self.tr("or exposed for"),
            "chip": self.tr("Chip length"),
            "correlation": self.tr("Correlation of fit"),
            "saturated": self.tr("Saturated"),
            "pattern": self.tr("Pattern"),
        }

    def show_match(self, match: Match) -> None:
        """Show a match."""
        self._match = match
        if self._scene is not None:
            self._given = float(self._scene.value(_known_of(match)))
        self._show_stale()
        self._show_values(match)

    def show_certain(self, certain: Mapping[str, float]) -> None:
        """Show which known values, in SI units by name, are confirmed and not only assumed."""
        self._certain = certain
        if self._match is not None:
            self._show_values(self._match)

    def _show_values(self, match: Match) -> None:
        for name, text in (self._estimates(match) | self._quality(match)).items():
            label = self.values[name]
            if isinstance(label, ElidedLabel):
                label.set_full_text(text)
            else:
                label.setText(text)
            self._form.setRowVisible(label, bool(text))

    def show_scene(self, scene: Scene) -> None:
        """Show whether the match was made with the known value of this scene."""
        self._scene = scene
        self._show_stale()

    def _show_stale(self) -> None:
        match, scene = self._match, self._scene
        if match is None or scene is None:
            return
        name = _known_of(match)
        declared = quantity(name)
        now, then = float(scene.value(name)), float(getattr(match, name))
        self.stale.setText(
            self.tr("Found with {then}; the scene has {now} now: match again.").format(
                then=declared.format(then), now=declared.format(now)
            )
        )
        self.stale.setVisible(now not in {then, self._given})

    def _estimates(self, match: Match) -> dict[str, str]:
        """Format the estimates and the given value; empty for a gamma that was not fitted."""
        texts = {}
        condition = self._condition(match)
        given = {name: self.tr("{value} (given)") for name in _ESTIMATES if name != "gamma"}
        if condition:
            given[_known_of(match)] = self.tr("{value} (assumed)")
        for name in _ESTIMATES:
            spread = match.uncertainties.get(name)
            texts[name] = with_uncertainty(quantity(name), getattr(match, name), spread)
            if spread is None:
                texts[name] = given.get(name, "").format(value=texts[name])
            elif name != "gamma":  # of the shape of the stripes, not of their timing
                texts[name] = condition + texts[name]
        if len(match.pattern) == CHIPS_OF_A_CYCLE:
            # A blinking LED is specified by its cycles, not by its chips.
            cycles = HERTZ.format(match.switching_frequency / CHIPS_OF_A_CYCLE, 4)
            texts["switching_frequency"] += self.tr(": blinks at {cycles}").format(cycles=cycles)
        exposure = quantity("exposure_time")
        others = (exposure.format(t, 4) for t in match.other_exposures)
        other = self.tr(" or ").join(others)
        return {**texts, "others": condition + other if other else ""}

    def _condition(self, match: Match) -> str:
        """Name the value that the estimates of time rest on, unless the user is certain of it."""
        name = _known_of(match)
        value, confirmed = float(getattr(match, name)), self._certain.get(name, math.nan)
        if math.isclose(value, confirmed, rel_tol=1e-9):
            return ""
        known = quantity(name)
        return self.tr("if {symbol} = {value}: ").format(
            symbol=known.symbol, value=known.format(value)
        )

    def _quality(self, match: Match) -> dict[str, str]:
        columns = 1.0 / (match.switching_frequency * match.readout_time)
        how = self.tr("read") if match.pattern_was_read else self.tr("given")
        return {
            "chip": self.tr("{columns:.3f} columns, {chips} chips a period").format(
                columns=columns, chips=len(match.pattern)
            ),
            "correlation": self.tr("{correlation:.4f}, RMSE {rmse:.2f} grey levels").format(
                correlation=match.correlation, rmse=match.rmse
            ),
            "saturated": self.tr("{share:.1f} % of the region's pixels").format(
                share=100 * match.stripes.saturated
            ),
            "pattern": self.tr("{pattern} ({how})").format(pattern=match.pattern, how=how),
        }
