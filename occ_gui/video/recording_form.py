"""Form of the recording: how the film of the scene is simulated."""

from PySide6.QtCore import QLocale, QSignalBlocker, Signal
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QSizePolicy, QWidget

from occ_gui.scene.number_edits import CountEdit, QuantityEdit
from occ_gui.scene.parameter_rows import explain
from occ_gui.values.choices import FIRST_FRAMES, FRAMES as COUNTS
from occ_gui.widgets.building import fill, name_widget, paragraph, push_button
from occ_gui.widgets.event_filters import keep_wheel_for_scrolling
from occ_gui.widgets.work_bar import WorkBar
from occ_model.errors import OccError, inflect
from occ_model.scene.colour_scenes import is_colour
from occ_model.scene.parameter_kinds import Count
from occ_model.scene.recording import DECLARED, Recording
from occ_model.scene.refusal import refusal_of, sentence_with_label
from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND

FRAMES = Count(
    "frames", "Frames", "", "Number of frames of the simulated film.",
    low=COUNTS[0], high=COUNTS[-1], default=FIRST_FRAMES,
)  # fmt: skip


class RecordingForm(QWidget):
    """Fields for the length, frame rate, jitter and clocks of the simulated film."""

    changed = Signal()  # the user has entered another value
    save_asked = Signal()  # the user writes the simulated film to a file
    refused = Signal(str)  # why a value that was entered is refused

    def __init__(self) -> None:
        super().__init__()
        self.recording = Recording()
        self.count = name_widget(CountEdit(FRAMES), FRAMES.label, FRAMES.meaning)
        self.count.setValue(FRAMES.default)
        keep_wheel_for_scrolling(self.count)
        self.count.valueChanged.connect(lambda _: self.changed.emit())
        self.count.refused.connect(self.refused)
        self.fields: dict[str, QuantityEdit] = {}
        form = QFormLayout(self)
        form.setContentsMargins(6, 6, 6, 6)
        form.setVerticalSpacing(4)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.FieldsStayAtSizeHint)
        form.addRow(FRAMES.label, self.count)
        for declared in DECLARED:
            field = name_widget(QuantityEdit(declared), declared.label, explain(declared))
            self.fields[declared.name] = field
            keep_wheel_for_scrolling(field)
            field.edited.connect(lambda value, name=declared.name: self._take(name, value))
            field.refused.connect(self.refused)
            form.addRow(declared.label, field)
        self.gap = paragraph(name="Gap between two frames, and size")
        self.gap.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        form.addRow(self.gap)
        self.save = push_button(
            "Sa&ve the simulated film…",
            "MKV, GIF and PNG keep every grey level; MP4 does not. The file contains the scene.",
            self.save_asked,
        )
        self.saving = WorkBar("Progress of writing the film")
        line = fill(QHBoxLayout(), self.save, self.saving, None)
        form.addRow(line)
        self.show_recording(self.recording)

    @property
    def frames(self) -> int:
        return self.count.value()

    def show_recording(self, recording: Recording) -> None:
        self.recording = recording
        for name, field in self.fields.items():
            field.set_value(getattr(recording, name))

    def show_frames(self, frames: int) -> None:
        with QSignalBlocker(self.count):
            self.count.setValue(frames)

    def show_scene(self, scene: Scene) -> None:
        """Show what a film of this scene misses between frames and its size, or its refusal."""
        try:
            self.recording.check(scene)
        except OccError as error:
            self.gap.setText(sentence_with_label(error))
            return
        gap, fraction = self.recording.gap(scene), 100.0 * self.recording.gap_ratio(scene)
        camera = scene.camera
        size = self.frames * camera.rows * camera.columns * (3 if is_colour(scene) else 1)
        self.gap.setText(
            f"Between two frames, no column is read out for {SECOND.format(gap, 4)}, "
            f"{fraction:.1f} % of a frame.\nBefore compression, the film is "
            f"{QLocale().formattedDataSize(size, 1, QLocale.DataSizeFormat.DataSizeSIFormat)}: "
            f"{inflect(self.frames, 'frame')} of {camera.columns} x {camera.rows} pixels."
        )

    def _take(self, name: str, value: float) -> None:
        try:
            self.recording = self.recording.replace(**{name: value})
        except OccError as error:
            self.show_recording(self.recording)
            self.refused.emit(refusal_of(error))
            return
        self.changed.emit()
