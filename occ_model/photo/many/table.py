"""Combine the rows of several photos: what is in the mean, and what is to be said of them."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from occ_model.photo.many.row import MatchSettings
from occ_model.photo.many.weighted_mean import combine
from occ_model.results.photo_table import SURE, CombinedEstimate, PhotoRow, PhotoTable
from occ_model.scene.parameters import quantity

_SAME_EXPOSURE = 1.02  # maximum ratio of noted exposure times that are the same


def table_of(settings: MatchSettings, rows: Sequence[PhotoRow]) -> PhotoTable:
    """Make the table of photos that were matched."""
    sure = [place for place, row in enumerate(rows) if row.verdict == SURE]
    estimated = _combined(rows, sure, settings.estimate)
    outliers = () if estimated is None else estimated.outliers
    counted = [place for place in sure if place not in outliers]
    noted = [row.noted_exposure for row in (rows[p] for p in counted) if row.noted_exposure]
    differ = bool(noted) and max(noted) > _SAME_EXPOSURE * min(noted)
    sure = [place for place in counted if rows[place].exposure_verdict == SURE]
    exposure = None if differ else _combined(rows, sure, "exposure_time")
    table = PhotoTable(settings.scene, settings.estimate, tuple(rows), estimated, exposure)
    return replace(table, notes=tuple(_notes(table, noted if differ else [])))


def _combined(
    rows: Sequence[PhotoRow], places: Sequence[int], name: str
) -> CombinedEstimate | None:
    values, deviations, of = [], [], []
    for place in places:
        value, deviation = getattr(rows[place], name), rows[place].uncertainty(name)
        if value is not None and deviation is not None and deviation > 0.0:
            values.append(value)
            deviations.append(deviation)
            of.append(place)
    found = combine(values, deviations)
    if found is None:
        return None
    return replace(found, outliers=tuple(of[place] for place in found.outliers))


def _notes(table: PhotoTable, exposures: Sequence[float]) -> list[str]:
    """Say what of the photos together keeps from one answer."""
    counted = [row for place, row in enumerate(table.rows) if table.is_counted(place)]
    label = quantity(table.estimate).label.lower()
    notes = []
    if table.estimated is None:
        notes.append(f"No photo is sure: there is no mean of the {label}.")
    elif not table.estimated.agrees:
        notes.append(
            "The photos differ by more than their errors: the error of the mean "
            f"is widened {table.estimated.scale:.2g} times."
        )
    for what, kinds in (
        # However the camera was held.
        ("sizes", Counter("{} x {}".format(*sorted(row.size)) for row in counted)),
        ("cameras", Counter(row.camera for row in counted if row.camera)),
    ):
        if len(kinds) > 1:
            each = ", ".join(f"{name} ({number})" for name, number in kinds.most_common(4))
            notes.append(
                f"The photos in the mean are of different {what}, {each}: their {label} need not "
                "be the same."
            )
    if exposures:
        time = quantity("exposure_time")
        notes.append(
            f"The camera noted exposure times from {time.format(min(exposures))} to "
            f"{time.format(max(exposures))}: they have no mean."
        )
    return notes
