"""Films and pictures in place of a camera."""

from collections.abc import Iterable, Iterator
from time import monotonic, sleep

import numpy as np

from occ_gui.video.camera import LivePicture
from occ_model.results.video import VideoFrame


class FilmSource:
    """The frames of a film at their own times, in place of a camera.

    ``frames``: the frames; they are gone through anew each time that the source is opened.
    ``in_real_time``: whether each frame comes at its own time, else as soon as it is asked for.
    """

    def __init__(
        self, frames: Iterable[VideoFrame], title: str, *, in_real_time: bool = True
    ) -> None:
        self.title, self.axis = title, "columns"
        self._frames, self._in_real_time = frames, in_real_time
        self._left: Iterator[VideoFrame] | None = None
        self._began = 0.0
        self.knows_exposure = True
        self.locked: list[bool] = []
        """What was asked for of the exposure: to be held, or to be let go."""

    @property
    def is_open(self) -> bool:
        return self._left is not None

    def open(self) -> None:
        self._left, self._began = iter(self._frames), monotonic()

    def read(self) -> LivePicture | None:
        frame = None if self._left is None else next(self._left, None)
        if frame is None:
            return None
        if self._in_real_time:
            sleep(max(0.0, self._began + frame.time - monotonic()))
        return LivePicture(frame.time, frame.image)

    def lock_exposure(self, on: bool) -> bool:
        self.locked.append(on)
        return self.knows_exposure

    def close(self) -> None:
        self._left = None


class ListedSource(FilmSource):
    """Gives listed pictures as fast as they are asked for."""

    def __init__(self, pictures: list[np.ndarray]) -> None:
        frames = [VideoFrame(index, 0.1 * index, image) for index, image in enumerate(pictures)]
        super().__init__(frames, "Listed", in_real_time=False)
