"""Short chips: those that end before the next column begins, so that a picture skips some."""

from occ_model.scene.scene import Scene
from occ_model.scene.units import SECOND

_MIN_CHIP_COLUMNS = 1.0  # columns of a chip below which not every chip has a column of its own
_DIGITS = 3  # significant digits of a time in a sentence


def columns_of_chip(scene: Scene) -> float:
    """Return the columns that are read out while one chip lasts."""
    return scene.transmitter.switching_period / scene.camera.readout_time


def has_short_chips(scene: Scene) -> bool:
    """Return whether a chip ends before the next column begins."""
    return columns_of_chip(scene) < _MIN_CHIP_COLUMNS


def with_short_chips(failure: str, scene: Scene) -> str:
    """Say before a failure that chips are too short, where they are: it follows from that."""
    return f"{_sentence(scene)} {failure}" if has_short_chips(scene) else failure


def then_short_chips(failure: str, scene: Scene) -> str:
    """Say after a failure that chips are too short, where they are: it may have another cause."""
    return f"{failure} {_sentence(scene)}" if has_short_chips(scene) else failure


def _sentence(scene: Scene) -> str:
    chip, column = scene.transmitter.switching_period, scene.camera.readout_time
    return (
        f"A chip of {SECOND.format(chip, _DIGITS)} is shorter than the "
        f"{SECOND.format(column, _DIGITS)} from one column to the next: not every chip has a "
        "column of its own."
    )
