"""Results: what has been computed for the workspace, as one value that all panes read."""

from dataclasses import dataclass, replace

from PySide6.QtCore import QObject, Signal

from occ_gui.shell.photo_profile import PhotoProfile
from occ_gui.simulation.preview import Picture
from occ_gui.simulation.snapshot import Reading, Snapshot
from occ_model.results.match import ChipReading
from occ_model.results.plan import Decision


@dataclass(frozen=True, eq=False, slots=True)
class Results:
    """What was computed last; each part says itself what it was computed from."""

    snapshot: Snapshot | None = None
    """The exact picture, and what is read of it."""

    picture: Picture | None = None
    """The picture that is there first: a draft, or the exact one before it is decoded."""

    reading: Reading | None = None
    """What is read of the scene, by its picture or sooner."""

    before: Snapshot | None = None
    """The exact picture before the latest step."""

    switched: tuple[Decision, ...] = ()
    """The effects that the plan has just switched in or out."""

    photo_profile: PhotoProfile | None = None
    """The profile of the open photo, beside the simulated one."""

    chips: ChipReading | None = None
    """The chips of the open photo."""


class Board(QObject):
    """Holds the results."""

    changed = Signal()
    """There are others."""

    photo_profile_changed = Signal()
    """There is another profile of a photo, or none any more."""

    def __init__(self) -> None:
        super().__init__()
        self.results = Results()

    def put(self, results: Results) -> None:
        """Put these in place of the last ones."""
        self.results = results
        self.changed.emit()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Put an exact picture in place of the last one."""
        self.put(replace(self.results, snapshot=snapshot))

    def show_picture(self, picture: Picture) -> None:
        """Put a picture that may be a draft in place of the last one."""
        self.put(replace(self.results, picture=picture))

    def show_reading(self, reading: Reading) -> None:
        """Put a reading in place of the last one."""
        self.put(replace(self.results, reading=reading))

    def show_before(self, snapshot: Snapshot) -> None:
        """Put the exact picture before the latest step in place of the last one."""
        self.put(replace(self.results, before=snapshot))

    def show_switched(self, switched: tuple[Decision, ...]) -> None:
        """Put what the plan has just switched in place of what it switched before."""
        self.put(replace(self.results, switched=switched))

    def show_photo_profile(self, profile: PhotoProfile | None) -> None:
        """Put the profile of a photo in place of the last one, or none."""
        self.put(replace(self.results, photo_profile=profile))
        self.photo_profile_changed.emit()

    def show_chips(self, chips: ChipReading | None) -> None:
        """Put the chips of a photo in place of the last ones, or none."""
        self.put(replace(self.results, chips=chips))
