"""Measurements of cameras by bars of mains lamps, of real pictures and of simulated rooms."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from simulated_photos import photo_of

import occ_model as occ
from photo_world.mains_rooms import Room, photograph_room


@dataclass(frozen=True)
class Truth:
    files: tuple[Path, ...]
    mains: float
    least: float | None  # of the frame's readout, in seconds
    most: float | None
    scan: str

    @property
    def name(self) -> str:
        return " ".join(path.name for path in self.files)

    @property
    def known(self) -> str:
        if self.least is None or self.most is None:
            return "nothing"
        return f"{1e3 * self.least:.1f} to {1e3 * self.most:.1f} ms"


@dataclass(frozen=True)
class Measured:
    verdict: str  # "sure", "doubtful", "refused"
    value: float = math.nan  # the frame's readout in seconds
    error: float = math.nan
    says: str = ""

    def off(self, truth: float) -> float:
        """Return by how many stated errors the value is off."""
        return (self.value - truth) / self.error

    def line(self, truth: float | None = None) -> str:
        if math.isnan(self.value):
            return f"{self.verdict:9} {self.says[:100]}"
        text = f"{self.verdict:9} {1e3 * self.value:7.3f} +- {1e3 * self.error:.3f} ms"
        if truth is not None:
            text += f" {100.0 * (self.value / truth - 1.0):+7.2f} % {self.off(truth):+6.1f} errors"
        return f"{text}  {self.says[:60]}"


_PAIRS = (("_1", "_2"), ("_in", "_ref"))  # ends of the names of two pictures of one room
_ENDINGS = (".png", ".jpg", ".jpeg")


def pictures(folder: Path, mains: float) -> list[Truth]:
    """Return the pairs of a folder, by their names, and its other pictures each by itself."""
    paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in _ENDINGS)
    found: list[Truth] = []
    for path in paths:
        for first, second in _PAIRS:
            other = path.with_name(f"{path.stem.removesuffix(first)}{second}{path.suffix}")
            if path.stem.endswith(first) and other in paths:
                found.append(Truth((path, other), mains, None, None, "auto"))
    together = {path for pair in found for path in pair.files}
    single = [Truth((path,), mains, None, None, "auto") for path in paths if path not in together]
    return found + single


def truths(folder: Path, mains: float = 50.0) -> list[Truth]:
    """Return what a folder's table says of its pictures, or the pictures without a table."""
    if not (folder / "truths.csv").is_file():
        return pictures(folder, mains)
    with (folder / "truths.csv").open(newline="", encoding="utf-8") as file:
        return [
            Truth(
                tuple(folder / name for name in row["files"].split()),
                float(row["mains_hz"]),
                float(row["least_ms"]) / 1e3 if row["least_ms"] else None,
                float(row["most_ms"]) / 1e3 if row["most_ms"] else None,
                row["scan"] or "auto",
            )
            for row in csv.DictReader(file)
        ]


def measure_truth(truth: Truth) -> Measured:
    return measured_of(list(truth.files), truth.mains, truth.scan)


def measure_room(room: Room) -> Measured:
    photos = [photo_of(image) for image in photograph_room(room)]
    return measured_of(photos, room.mains_frequency, "lines")


def measured_of(photos: list[occ.Photo] | list[Path], mains: float, scan: str) -> Measured:
    try:
        found = occ.measure_camera(photos, mains, scan_axis=scan)
    except occ.MatchError as reason:
        return Measured("refused", says=str(reason))
    error = found.uncertainties["frame_readout_time"]
    says = " ".join(found.reasons)
    return Measured(found.verdict, found.frame_readout_time, error, says)
