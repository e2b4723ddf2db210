"""Player: which frame of a film is shown, and which one next while it plays."""

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

_TURN_MS = 33  # milliseconds between two frames on the screen, at least
_USUAL_RATE = 30.0  # frames a second of a film that does not say how many


class FilmPlayer(QObject):
    """Plays a film at its own speed: frames that would come late are left out."""

    wanted = Signal(int)  # the number of the frame that is to be shown

    playing_changed = Signal(bool)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.index = 0  # the number of the frame that is shown, or about to be
        self.count = 0  # how many frames there are, as far as is known
        self._rate = _USUAL_RATE
        self._began_at = 0
        self._clock = QElapsedTimer()
        self._turns = QTimer(self)
        self._turns.setInterval(_TURN_MS)
        self._turns.timeout.connect(self.advance)

    @property
    def is_playing(self) -> bool:
        return self._turns.isActive()

    def set_film(self, count: int, rate: float | None) -> None:
        """Stop, and begin at the first frame of a film of so many frames at this rate."""
        self.pause()
        self.index, self.count = 0, count
        self._rate = rate or _USUAL_RATE

    def set_count(self, count: int) -> None:
        """Set how many frames there are, where that is found out by reading the film."""
        self.count = count
        if self.index >= count > 0:
            self.seek(count - 1)

    def toggle(self) -> None:
        if self.is_playing:
            self.pause()
        else:
            self.play()

    def play(self) -> None:
        if self.count < 2 or self.is_playing:
            return
        if self.index >= self.count - 1:
            self._show(0)
        self._began_at = self.index
        self._clock.start()
        self._turns.start()
        self.playing_changed.emit(True)

    def pause(self) -> None:
        if self.is_playing:
            self._turns.stop()
            self.playing_changed.emit(False)

    def seek(self, index: int) -> None:
        index = min(max(index, 0), max(self.count - 1, 0))
        self._began_at = index
        self._clock.start()
        if self.count and index != self.index:
            self._show(index)

    def step(self, frames: int) -> None:
        self.pause()
        self.seek(self.index + frames)

    def advance(self) -> None:
        """Show the frame whose time has come."""
        passed = 1e-3 * self._clock.elapsed()
        index = min(self._began_at + int(passed * self._rate), self.count - 1)
        if index > self.index:
            self._show(index)
        if self.index >= self.count - 1:
            self.pause()

    def _show(self, index: int) -> None:
        self.index = index
        self.wanted.emit(index)
