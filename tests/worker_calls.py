"""Functions that tests let other processes call."""

import os
import time
from typing import Any

from occ_gui.background.parcel import Pulse


def echo(value: Any, pulse: Pulse) -> Any:
    """Give it back."""
    return value


def fail(value: Any, pulse: Pulse) -> Any:
    """Make a mistake."""
    raise ValueError(f"no {value}")


def process_id(pulse: Pulse) -> int:
    """Say which process it is, after a while."""
    time.sleep(0.05)
    return os.getpid()


def count_for_ever(pulse: Pulse) -> None:
    """Pulse until that ends it."""
    while True:
        pulse()
        time.sleep(0.001)
