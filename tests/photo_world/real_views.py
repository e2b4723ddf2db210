"""Photographs of lamps by other people, with what is known and what is read of them."""

import csv
from dataclasses import dataclass, replace
from pathlib import Path

import occ_model as occ
from occ_model.photo.reading.choices import SCAN_AXES

_BASE = "phone-136us"


@dataclass(frozen=True)
class KnownPhoto:
    file: Path
    group: str
    scan: str
    given: str  # What the program is told: "readout_time=...", "lamp_frequency=..." or "ratios"
    frequencies: tuple[float, ...]
    readout: float | None
    chips: str
    tolerance: float


@dataclass(frozen=True)
class Answer:
    """What the program says of one lamp."""

    verdict: str  # "sure", "doubtful", "refused"
    value: float | None = None
    error: float | None = None  # Stated standard deviation
    truth: float | None = None
    says: str = ""

    def is_wrong(self, tolerance: float) -> bool:
        if self.value is None or self.truth is None:
            return False
        return abs(self.value / self.truth - 1.0) > tolerance

    def line(self) -> str:
        if self.value is None or self.truth is None:
            return f"{self.verdict:9} {self.says[:90]}"
        off = self.value - self.truth
        stated = f"{off / self.error:+6.1f} errors" if self.error else ""
        return f"{self.verdict:9} {self.value:12.6g} {100.0 * off / self.truth:+7.2f} % {stated}"


def load_known_photos(folder: Path) -> list[KnownPhoto]:
    with (folder / "truths.csv").open(newline="", encoding="utf-8") as file:
        return [
            KnownPhoto(
                folder / row["file"],
                row["group"],
                row["scan"],
                row["known"],
                tuple(float(each) for each in row["lamp_frequency_hz"].split()),
                float(row["readout_time_s"]) if row["readout_time_s"] else None,
                row["chips"],
                float(row["tolerance"] or 0.03),
            )
            for row in csv.DictReader(file)
        ]


def read_answers(known: KnownPhoto) -> list[Answer]:
    """Return what is said of each lamp; of one view along both scan axes the better answer."""
    axes = [known.scan] if known.scan else [axis for axis in SCAN_AXES if axis != "auto"]
    found = [_along(known, axis) for axis in axes]
    order = ("refused", "doubtful", "sure")
    return max(found, key=lambda each: sum(order.index(one.verdict) for one in each))


def _along(known: KnownPhoto, axis: str) -> list[Answer]:
    photo = occ.load_photo(known.file, scan_axis=axis)
    if known.chips:
        return [_chips(photo, known.chips)]
    scene = occ.load_preset(_BASE).replace(light="lamp")
    estimate = "readout_time"
    name, _, value = known.given.partition("=")
    if name == "ratios":
        estimate = "switching_frequency"
    elif name == "readout_time":
        scene, estimate = scene.replace(readout_time=float(value)), "switching_frequency"
    elif name == "lamp_frequency":
        scene = scene.replace(lamp_frequency=float(value))
    if len(known.frequencies) > 1:
        found = [
            _answer(match, estimate, known)
            for lamp, match in occ.match_lamps(photo, scene, estimate=estimate)
            if lamp.modulated
        ]
        found = _by_ratios(found, known) if name == "ratios" else found
        return found or [Answer("refused", says="no lamp found")]
    try:
        return [_answer(occ.match_photo(photo, scene, estimate=estimate), estimate, known)]
    except occ.MatchError as error:
        return [Answer("refused", says=str(error))]


def _answer(match: "occ.Match | occ.MatchError", estimate: str, known: KnownPhoto) -> Answer:
    if isinstance(match, occ.MatchError):
        return Answer("refused", says=str(match))
    if estimate == "readout_time":
        value, right = match.readout_time, known.readout
    else:
        value = match.lamp_frequency or 0.0
        right = min(known.frequencies, key=lambda each: abs(each - value), default=None)
    return Answer(match.verdict, value, match.uncertainties[match.estimate], right)


def _by_ratios(found: list[Answer], known: KnownPhoto) -> list[Answer]:
    """Compare frequencies up to the common factor with which most of them are right."""

    def scaled(factor: float) -> list[Answer]:
        return [
            replace(
                one,
                truth=None
                if one.value is None
                else min((each / factor for each in known.frequencies),
                         key=lambda each: abs(each - (one.value or 0.0))),
            )
            for one in found
        ]  # fmt: skip

    factors = [right / one.value for right in known.frequencies for one in found if one.value]
    return max(
        (scaled(factor) for factor in factors),
        key=lambda each: -sum(one.is_wrong(known.tolerance) for one in each),
        default=found,
    )


def _chips(photo: occ.Photo, chips: str) -> Answer:
    try:
        read = occ.read_chips(photo)
    except occ.MatchError as error:
        return Answer("refused", says=str(error))
    turns = {chips[at:] + chips[:at] for at in range(len(chips))}
    is_right = read.text[: len(chips)] in turns
    return Answer("sure" if read.confidence > 0.95 else "doubtful", 1.0, None, float(is_right))
