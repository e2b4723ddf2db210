"""Pane of the detection map: success rates over two parameters, and a page of advice."""

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from occ_gui.detection_map.advice_view import AdviceView
from occ_gui.detection_map.decoder_maps import MapLegend, MapPlots
from occ_gui.detection_map.most_bits_card import MostBitsCard
from occ_gui.detection_map.rate_map import MAP_PARAMETERS, PointFacts, RateMap
from occ_gui.scene.number_edits import QuantityEdit
from occ_gui.widgets.building import ElidedLabel, KeyedComboBox, fill, name_widget, push_button
from occ_gui.widgets.outdated_mark import OutdatedMark
from occ_model.errors import inflect
from occ_model.results.sweep_request import ShownQuantity
from occ_model.scene.parameters import quantity
from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.scene import Scene

_LEAST_HEIGHT_WITH_CARDS = 480  # least height in pixels with the cards above the map


class MapView(QWidget):
    """The map with its choices, and a second page with the advice."""

    axes_chosen = Signal(str, str)  # the parameters that the user chose for the axes, x and y

    def __init__(
        self, decoders: Sequence[str], advice_decoders: Sequence[str] | None = None
    ) -> None:
        super().__init__()
        self._failure = self._refusal = ""
        self._progress = "measuring the first points…"
        self._facts: PointFacts | None = None
        self._is_outdated = False
        self._axes = (MAP_PARAMETERS[0], MAP_PARAMETERS[1])
        self._make_choices(decoders)
        self.plots, self.legend = MapPlots(decoders), MapLegend()
        self.outdated = OutdatedMark(self.plots)
        self.image_effects = name_widget(
            QCheckBox("image effects"),
            "Image effects",
            "Simulate lens, bundled emission and JPEG if the scene has them, which takes 2 to 4 "
            "times as long. Otherwise the map and the advice leave them out, and say so.",
        )
        self.image_effects.setChecked(True)
        self.advise = push_button(
            "How fast can I go?",
            "Search for the highest frequency and the exposures at which codes are read.",
            self._show_advice,
        )
        self.status = name_widget(ElidedLabel(how=Qt.TextElideMode.ElideMiddle), "State of the map")
        self.omissions = name_widget(ElidedLabel(), "Effects that the map leaves out")
        self.omissions.hide()
        self.advice = AdviceView(decoders if advice_decoders is None else advice_decoders)
        self.cards = self.advice.cards
        self.most_bits = MostBitsCard()
        self._lay_out()
        self._show_status()
        self._connect()
        self.show_axes(*self._axes)

    def _make_choices(self, decoders: Sequence[str]) -> None:
        names = {name: quantity(name).label for name in MAP_PARAMETERS}
        self.x_parameter = KeyedComboBox(
            "Horizontal axis", "The parameter of the horizontal axis.", names
        )
        self.y_parameter = KeyedComboBox(
            "Vertical axis", "The parameter of the vertical axis.", names
        )
        all_decoders = "both maps" if len(decoders) == 2 else "all maps"
        choices = {"both": all_decoders, **{name: name for name in decoders}}
        if len(decoders) > 1:
            choices["difference"] = "difference"
        self.decoder_choice = KeyedComboBox(
            "Decoders", "The decoder whose success rates are shown.", choices
        )

        self.quantity = KeyedComboBox(
            "What is shown",
            "Success rates, the fractions of the bits that are read; or the net bits a second of "
            "a video with one payload in each picture.",
            {"rate": "success rate", "bits": "bits a second"},
        )
        tip = "Pictures a second, each with its own payload; at most as many as can be read out."
        self.frame_rate = name_widget(QuantityEdit(FRAME_RATE), FRAME_RATE.label, tip)
        self.frame_rate.hide()

    def _lay_out(self) -> None:
        head = fill(
            QHBoxLayout(), (self.x_parameter, 3), QLabel("×"),  # noqa: RUF001 - the sign for it
            (self.y_parameter, 3), (self.decoder_choice, 2), (self.quantity, 2), self.frame_rate,
        )  # fmt: skip
        foot = fill(QHBoxLayout(), (self.legend, 1), self.image_effects)
        self.cards.head.addWidget(self.advise, 0, Qt.AlignmentFlag.AlignTop)
        self._state = fill(QHBoxLayout(), (self.status, 1))
        page = QWidget()
        fill(
            QVBoxLayout(page), self.cards, self.most_bits, head, (self.plots, 1), foot,
            self.omissions, self._state, margins=(4, 2, 4, 2), spacing=2,
        )  # fmt: skip
        self._pages = QStackedWidget()
        self._pages.addWidget(page)
        self._pages.addWidget(self.advice)
        fill(QVBoxLayout(self), self._pages, margins=0)

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        super().resizeEvent(event)
        has_cards = self.height() >= _LEAST_HEIGHT_WITH_CARDS
        for card in (self.cards, self.most_bits):
            card.setVisible(has_cards)
        # In a low pane, the button shares the line of the state.
        line = self.cards.head if has_cards else self._state
        if line.indexOf(self.advise) == -1:
            line.addWidget(self.advise, 0, Qt.AlignmentFlag.AlignTop)

    def _connect(self) -> None:
        self.x_parameter.chosen.connect(lambda x: self.axes_chosen.emit(x, self._axes[1]))
        self.y_parameter.chosen.connect(lambda y: self.axes_chosen.emit(self._axes[0], y))
        self.decoder_choice.chosen.connect(self.plots.show_choice)
        self.frame_rate.refused.connect(self.show_failure)
        self.legend.toggled.connect(self.plots.show_limit)
        self.advice.map_requested.connect(lambda: self._pages.setCurrentIndex(0))

    def _show_advice(self) -> None:
        self._pages.setCurrentWidget(self.advice)
        if not self.cards.is_up_to_date:
            self.advice.search_requested.emit()

    def show_axes(self, x: str, y: str) -> None:
        self._axes = (x, y)
        self.x_parameter.show_key(x)
        self.y_parameter.show_key(y)
        self.plots.show_axes(x, y)
        self.show_facts(None)

    def show_map(self, rates: RateMap) -> None:
        self._refusal = rates.explain_refusal()
        self.plots.show_map(rates)
        self.legend.enable_limits(self.plots.list_limits())

    def show_scene(self, scene: Scene) -> None:
        x, y = (quantity(name).fraction(float(scene.value(name))) for name in self._axes)
        self.plots.show_setting((x, y))

    def show_progress(self, known: int, total: int, images: int, enough: int) -> None:
        """Show the number of known points, and the least and the wanted number of their images."""
        self._progress = f"{known} of {total} points measured"
        if known >= total:
            pictures = inflect(images, "picture")
            self._progress = f"{total} points of {pictures} each"
            if images < enough:
                self._progress = f"{total} points of at least {pictures} each; pale: under {enough}"
        self._show_status()

    def show_failure(self, sentence: str) -> None:
        """Show why the map is not of the present scene, or a message from its workers."""
        self._failure = sentence
        self._show_status()

    def show_age(self, age: float) -> None:
        """Show that the map has been outdated for some seconds; zero if it is not outdated."""
        self._is_outdated = age > 0.0
        self.outdated.show_age(age, "computing…")
        self._show_status()

    def show_omissions(self, effects: tuple[str, ...]) -> None:
        self.omissions.setVisible(bool(effects))
        self.omissions.set_full_text(f"The map leaves out: {', '.join(effects)}.")

    def show_quantity(self, shown: ShownQuantity, frames_a_second: float) -> None:
        self.quantity.show_key(shown)
        self.frame_rate.setVisible(shown == "bits")
        self.frame_rate.set_value(frames_a_second)
        self.plots.show_quantity(shown, frames_a_second)
        self._show_status()

    def show_facts(self, facts: PointFacts | None) -> None:
        self._facts = facts
        self._show_status()

    def _show_status(self) -> None:
        facts = self._facts
        if facts is None:
            text = self._failure or self._refusal or self._progress
        else:
            counts = self._describe_counts(facts) if facts.sent else ""
            description = "; ".join(text for text in (counts, facts.note) if text)
            text = f"{self._describe_place(facts)}: {description}"
        if self._is_outdated and not self._failure:
            text = f"Earlier scene: {text}"
        self.status.set_full_text(text)

    def _describe_place(self, facts: PointFacts) -> str:
        x, y = (quantity(name) for name in self._axes)
        return f"{x.format(facts.x, 4)}, {y.format(facts.y, 4)}"

    def _describe_counts(self, facts: PointFacts) -> str:
        if self.quantity.key() == "bits":
            return "; ".join(
                f"{decoder} {facts.most_bits * whole / facts.images:,.0f} bits a second, "
                f"{whole} of {facts.images} pictures read without an error"
                for (decoder, *_), whole in zip(facts.counts, facts.whole, strict=True)
            )
        return "; ".join(
            f"{decoder} {100 * right / facts.sent:.0f} %, {right} of {facts.sent} bits "
            f"({low:.0f} to {high:.0f} %)"
            for decoder, right, low, high in facts.counts
        )
