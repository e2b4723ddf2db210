"""Control panel: the preset, the light, the code, and pages with all other parameters."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QStandardItemModel
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from occ_gui.scene.code_entry import CodeEntry
from occ_gui.scene.forced_effects import ForcedEffects
from occ_gui.scene.parameter_panel import ParameterPage, ParameterPanel
from occ_gui.scene.parameter_rows import CountRow, ParameterRow, QuantityRow, row_for
from occ_gui.scene.player import Player
from occ_gui.scene.scene_editor import SceneEditor
from occ_gui.widgets.building import fill
from occ_gui.widgets.plain_text import LONGEST_TEXT, in_tool_tip
from occ_model.errors import one_line
from occ_model.results.teaching import MarkedValue
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import GROUPS, Scene

MAIN = (
    "exposure_time", "lamp_frequency", "duty", "mains_frequency", "mains_depth", "levels",
    "waveform_file", "pulse_frequency", "pulse_length", "switching_frequency", "readout_time",
    "iso", "f_number", "distance",
)  # fmt: skip
"""The parameters on the first page; only those of the scene's kind of light are shown."""


def main_of(light: str) -> tuple[str, ...]:
    """Return the parameters that the first page shows for a kind of light."""
    return tuple(name for name in MAIN if PARAMETERS[name].is_of(light))


class ControlPanel(QWidget):
    """All controls of a scene.

    ``effects``: the parameters of the effects, in the order of the light's path; they have a page
    of their own. ``stages``: the stage of each, ``"light"``, ``"optics"``, ``"sensor"`` or
    ``"processing"``, which becomes a heading there.
    """

    preset_chosen = Signal(str)

    def __init__(
        self,
        effects: Sequence[str] = (),
        stages: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        super().__init__()
        self.preset = QComboBox()
        self.preset.setAccessibleName("Preset")
        self.preset.setToolTip("Load a scene that comes with the program, or one of your own.")
        self.preset.setPlaceholderText("Choose a preset")
        self.preset.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.preset.activated.connect(
            lambda index: self.preset_chosen.emit(self.preset.itemData(index))
        )
        self.light = row_for(PARAMETERS["light"])
        self.code = CodeEntry()
        self.forced = ForcedEffects()
        colours = GROUPS["colours"]
        elsewhere = (*MAIN, *effects, *colours, "code", "light")
        others = [name for name in PARAMETERS if name not in elsewhere]
        model = [name for name in others if name in (*GROUPS["model"], *GROUPS["receiver"])]
        self._scene: Scene | None = None
        self._editor: SceneEditor | None = None
        self._pages = {
            "Main": ParameterPage(MAIN, lambda: ParameterPanel(MAIN, with_scales=True)),
            "Panel and camera": ParameterPage([name for name in others if name not in model]),
            "Effects": ParameterPage(
                effects, lambda: ParameterPanel(effects, self._make_headings(stages))
            ),
            "Model": ParameterPage(
                [*model, *colours],
                lambda: ParameterPanel([*model, *colours], {colours[0]: "Colour camera"}),
            ),
        }
        self._main = self._pages["Main"].panel()
        for page in self._pages.values():
            page.made.connect(self._set_up_panel)
        self.player = Player(self.main_rows(), self._main.play_buttons, self)
        self._lay_out()

    @property
    def panels(self) -> dict[str, ParameterPanel]:
        return {title: page.panel() for title, page in self._pages.items()}

    @property
    def _existing_panels(self) -> list[ParameterPanel]:
        return [page.content for page in self._pages.values() if page.content is not None]

    def _set_up_panel(self, panel: ParameterPanel) -> None:
        if self._editor is not None:
            _connect(panel.rows.values(), self._editor)
        if self._scene is not None:
            panel.show_scene(self._scene)
            self._show_bits(self._scene)

    def _make_headings(self, stages: Mapping[str, str]) -> dict[str, str]:
        titles = {
            "light": "Light: LED and room",
            "optics": "Optics: from the panel through the lens",
            "sensor": "Sensor",
            "processing": "File",
        }
        first_names: dict[str, str] = {}
        for name, stage in stages.items():
            first_names.setdefault(stage, name)
        return {name: titles[stage] for stage, name in first_names.items()}

    def connect_editor(self, editor: SceneEditor) -> None:
        self._editor = editor
        _connect(self._list_fields().values(), editor)

    def _lay_out(self) -> None:
        pages = QTabWidget()
        pages.setUsesScrollButtons(False)  # the pane is at least as wide as all titles
        for title, page in self._pages.items():
            pages.addTab(page, title)
        light = fill(QHBoxLayout(), QLabel(PARAMETERS["light"].label), (self.light, 1), margins=0)
        rows_above = (
            QLabel("Preset"), self.preset, self.forced, light, self.code.title, self.code
        )  # fmt: skip
        fill(QVBoxLayout(self), *rows_above, (pages, 1))

    def list_presets(
        self,
        presets: Sequence[tuple[str, str]],
        unreadable: Sequence[tuple[str, str]] = (),
        user_presets: Collection[str] = (),
    ) -> None:
        """Replace the listed presets by these, each given as (name, title).

        ``unreadable``: (name, reason) of presets that cannot be loaded or chosen. ``user_presets``:
        names of the user's presets, which are listed by name instead of title.
        """
        self.preset.clear()
        for name, title in presets:
            by_name = name in user_presets
            self._add_preset(one_line(name if by_name else title), name, title if by_name else name)
        for name, reason in unreadable:
            text = f"{one_line(name)}: cannot be read"
            index = self._add_preset(text, None, reason)
            entries = self.preset.model()
            if isinstance(entries, QStandardItemModel):
                entries.item(index).setEnabled(False)
        self.preset.setCurrentIndex(-1)

    def _add_preset(self, text: str, name: str | None, tip: str) -> int:
        self.preset.addItem(text, name)
        index = self.preset.count() - 1
        tip = in_tool_tip(one_line(tip, LONGEST_TEXT))
        self.preset.setItemData(index, tip, Qt.ItemDataRole.ToolTipRole)
        return index

    def add_foot(self, widget: QWidget) -> None:
        self._main.add_foot(widget)

    def main_rows(self) -> dict[str, QuantityRow]:
        rows = self._main.rows.items()
        return {name: row for name, row in rows if isinstance(row, QuantityRow)}

    def show_scene(self, scene: Scene) -> None:
        self._scene = scene
        self.player.follow_scene(scene)
        self.light.show_value(scene.transmitter.light)
        self.code.show_scene(scene)
        for panel in self._existing_panels:
            panel.show_scene(scene)
        self._show_bits(scene)

    def _show_bits(self, scene: Scene) -> None:
        row = self._list_fields().get("bits")
        if isinstance(row, CountRow):
            sent = scene.transmitter
            reason = "Bits of the payload, which is sent in place of the code."
            row.show_derived(*((sent.payload_length, reason) if sent.payload else (None,)))

    def show_marks(self, name: str, marks: Sequence[MarkedValue]) -> None:
        self._main.show_marks(name, marks)

    def show_problem(self, sentence: str, names: Iterable[str], *, stays: bool = False) -> None:
        """Show at the fields of parameters what is wrong; ``stays``: with the values they show."""
        for field in self._make_fields(names):
            field.show_problem(sentence, stays=stays)

    def end_refusals(self, names: Iterable[str] | None = None) -> None:
        """Remove the refusals from the fields of parameters; by default all."""
        for field in self._list_fields().values() if names is None else self._find_fields(names):
            field.end_refusal()

    def _make_fields(self, names: Iterable[str]) -> list[CodeEntry | ParameterRow]:
        wanted = set(names)
        for page in self._pages.values():
            if wanted.intersection(page.names):
                page.panel()
        return self._find_fields(wanted)

    def _find_fields(self, names: Iterable[str]) -> list[CodeEntry | ParameterRow]:
        fields = self._list_fields()
        return [fields[name] for name in names if name in fields]

    def _list_fields(self) -> dict[str, CodeEntry | ParameterRow]:
        fields: dict[str, CodeEntry | ParameterRow] = {"code": self.code, "light": self.light}
        for panel in self._existing_panels:
            fields.update(panel.rows)
        return fields

    def show_preset(self, name: str, base: str = "") -> None:
        """Show the scene's preset, or ``base``, the preset that it was changed from."""
        text = "Choose a preset"
        index = self.preset.findData(base) if base else -1
        if index >= 0:
            text = f"{self.preset.itemText(index)}, changed"
        if text != self.preset.placeholderText():
            self.preset.setPlaceholderText(text)
        self.preset.setCurrentIndex(self.preset.findData(name) if name else -1)


def _connect(fields: Iterable[CodeEntry | ParameterRow], editor: SceneEditor) -> None:
    for field in fields:
        field.edited.connect(editor.edit)
        field.refused.connect(editor.input_refused)
