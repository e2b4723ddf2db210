"""Keep the messages of decoders in C off the terminal."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def no_stderr() -> Iterator[None]:
    """Redirect stderr to the null device: libtiff, LibRaw and OpenCV print their warnings there."""
    try:
        copy = os.dup(2)
    except OSError:  # a program without a console has none
        yield
        return
    try:
        with Path(os.devnull).open("wb") as null_device:
            os.dup2(null_device.fileno(), 2)
        yield
    finally:
        os.dup2(copy, 2)
        os.close(copy)
