"""Live film: the newest picture of a source, whenever the one before has been dealt with."""

from collections.abc import Callable, Iterator
from threading import Condition, Thread

import cv2
import numpy as np

from occ_gui.video.frame_source import FrameSource, LivePicture
from occ_model.arrays import ByteArray
from occ_model.errors import OccError, VideoError
from occ_model.results.video import Video, VideoFrame

AXES = ("lines", "columns")
"""What of the source's pictures the rolling shutter scans, the usual one first."""

_JOIN_SECONDS = 5.0
"""How long is waited for a device that does not answer before the program goes on without it."""


class LiveVideo(Video):
    """The pictures of a source as a film without an end, which loses what nobody had time for.

    The source is opened, read and closed by a thread of its own, so that a picture that is still
    being decoded never delays the next ones, and a device that hangs never holds up the window.

    ``axis``: what of them the rolling shutter scans, one of AXES.
    ``after``: the film before, whose device is to be released first.
    """

    def __init__(
        self, source: FrameSource, axis: str = AXES[0], after: "LiveVideo | None" = None
    ) -> None:
        self.title = source.title
        self.shape = (0, 0)
        self.frame_rate = self.frame_count = None
        self.source = source
        self.axis = axis  # what of its pictures the rolling shutter scans, one of AXES
        self._after = after
        self._changed = Condition()
        self._newest: LivePicture | None = None
        self.arrived = 0
        self.has_ended = self._is_stopped = False
        self.last: VideoFrame | None = None
        self._problem: str | None = None
        self._orders: list[Callable[[], None]] = []
        self._thread = Thread(target=self._film, name="camera", daemon=True)

    @property
    def simulated(self) -> bool:
        return False

    @property
    def problem(self) -> str | None:
        """Why there are no more pictures, or None."""
        return self._problem

    def start(self) -> None:
        self._thread.start()

    def end(self) -> None:
        """End filming: the device is released as soon as it answers."""
        with self._changed:
            self._is_stopped = self.has_ended = True
            self._newest = None
            self._changed.notify_all()

    def stop(self) -> None:
        self.end()
        self.join()

    def join(self) -> None:
        """Wait until the device is released; not for ever, as a driver may hang."""
        if self._thread.ident is not None:
            self._thread.join(_JOIN_SECONDS)

    def lock_exposure(self, on: bool, answer: Callable[[bool], None]) -> None:
        """Hold the exposure or let it go, between two pictures; the answer says whether it could.

        The answer comes from another thread.
        """
        with self._changed:
            self._orders.append(lambda: answer(self.source.lock_exposure(on)))

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:  # noqa: ARG002 - as of any film
        """Return the newest picture whenever one is asked for, until there are no more.

        Each is given once. ``first`` is not used: what has passed has passed.
        """
        while (frame := self._next()) is not None:
            yield frame

    def frame(self, index: int) -> VideoFrame:
        """Refuse: what has passed has passed."""
        raise VideoError(f"Frame {index} of {self.title} is not kept: it is a live film.")

    def _next(self) -> VideoFrame | None:
        with self._changed:
            self._changed.wait_for(lambda: self._newest is not None or self.has_ended)
            picture, self._newest = self._newest, None
            index = self.arrived - 1
        if picture is None:
            return None
        grey = self._grey(picture.pixels)
        self.shape = (grey.shape[0], grey.shape[1])
        self.last = VideoFrame(index, picture.time, grey)
        return self.last

    def _grey(self, pixels: ByteArray) -> ByteArray:
        """Take the luma, as of a film in a file, with the scan axis as columns."""
        if pixels.ndim == 3:
            pixels = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), dtype=np.uint8)
        if self.axis == "lines":
            pixels = np.asarray(cv2.transpose(pixels), dtype=np.uint8)
        return pixels

    def _film(self) -> None:
        problem: str | None = None
        after, self._after = self._after, None
        if after is not None:
            after.join()
        try:
            self.source.open()
            while not self._is_stopped:
                picture = self.source.read()
                if picture is None:
                    problem = f"{self.title} gives no more pictures: it has ended or is unplugged."
                    break
                self._put(picture)
        except OccError as error:
            problem = str(error)
        except Exception as error:  # noqa: BLE001 - a driver may raise anything
            problem = f"{self.title} gives no more pictures ({type(error).__name__}: {error})."
        finally:
            self.source.close()
            with self._changed:
                self.has_ended = True
                self._problem = None if self._is_stopped else problem
                self._changed.notify_all()

    def _put(self, picture: LivePicture) -> None:
        with self._changed:
            orders, self._orders = self._orders, []
            if not self._is_stopped:
                self._newest = picture
                self.arrived += 1
                self._changed.notify_all()
        for order in orders:
            order()
