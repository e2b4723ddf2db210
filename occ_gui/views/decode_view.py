"""What the receiver read: the verdict, the bits, and the steps behind them."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFormLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from occ_gui.state.snapshot import Snapshot
from occ_gui.widgets.bit_strip import BitStrip
from occ_model.results import DecodeResult


class DecodeView(QWidget):
    """The decode result in words, sent and received bits, and what was measured on the way."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.verdict = QLabel()
        self.verdict.setWordWrap(True)
        self.verdict.setTextFormat(Qt.TextFormat.PlainText)
        font = self.verdict.font()
        font.setBold(True)
        self.verdict.setFont(font)
        self.strip = BitStrip()
        self.reason = QLabel()
        self.reason.setWordWrap(True)
        self.reason.setTextFormat(Qt.TextFormat.PlainText)
        self.reason.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self._steps = {name: QLabel() for name in ("region", "threshold", "chip", "chips")}
        layout = QVBoxLayout(self)
        for widget in (self.verdict, self.strip, self.reason):
            layout.addWidget(widget)
        layout.addLayout(self._make_form())
        layout.addStretch(1)

    def _make_form(self) -> QFormLayout:
        form = QFormLayout()
        form.setVerticalSpacing(2)
        titles = {
            "region": self.tr("Region"),
            "threshold": self.tr("Threshold"),
            "chip": self.tr("Chip length"),
            "chips": self.tr("Chips read"),
        }
        for name, title in titles.items():
            self._steps[name].setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            form.addRow(title, self._steps[name])
        return form

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show these results in place of the last ones."""
        decoded = snapshot.decoded
        self.strip.setVisible(bool(snapshot.sent))
        self.strip.show_bits(snapshot.sent, decoded.bits.tolist())
        self.verdict.setText(self._verdict(snapshot))
        self.reason.setText(decoded.failure or "")
        self.reason.setVisible(decoded.failure is not None)
        for name, text in self._measured(decoded).items():
            self._steps[name].setText(text)

    def _verdict(self, snapshot: Snapshot) -> str:
        decoded = snapshot.decoded
        if not snapshot.sent:
            return self.tr("No code is sent")
        if decoded.code is None:
            return self.tr("✗ No code read")
        wrong = len(self.strip.wrong_places())
        if wrong:
            return self.tr("✗ Code {code} read, {wrong} of {bits} bits wrong").format(
                code=decoded.code, wrong=wrong, bits=len(snapshot.sent)
            )
        return self.tr("✓ Code {code} read, all bits right").format(code=decoded.code)

    def _measured(self, decoded: DecodeResult) -> dict[str, str]:
        none = "–"  # noqa: RUF001 - a dash is what stands for nothing
        region, level, chip = decoded.region, decoded.threshold, decoded.chip_length
        return {
            "region": none
            if region is None
            else self.tr("{columns} x {rows} px").format(columns=region.columns, rows=region.rows),
            "threshold": none
            if level is None
            else self.tr("{level:.1f} grey levels").format(level=level),
            "chip": none if chip is None else self.tr("{chip:.2f} columns").format(chip=chip),
            "chips": str(decoded.chips.size) if decoded.chips.size else none,
        }
