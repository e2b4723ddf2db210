"""Which photos of a table are in the mean, and which were left out of it."""

from pathlib import Path

from occ_model.results.photo_table import DOUBTFUL, SURE, CombinedEstimate, PhotoRow, PhotoTable
from occ_model.scene.scene import Scene

ROWS = tuple(
    PhotoRow(Path(f"{place}.png"), verdict) for place, verdict in enumerate([SURE, DOUBTFUL, SURE])
)


def of(estimated: CombinedEstimate | None) -> list[tuple[bool, bool]]:
    table = PhotoTable(Scene(), "readout_time", ROWS, estimated, None)
    return [(table.is_outlier(place), table.is_counted(place)) for place in range(len(ROWS))]


def test_a_sure_photo_is_in_the_mean_or_an_outlier_and_no_other_is_either() -> None:
    mean = CombinedEstimate(1e-5, 1e-7, 1, 0.0, 1.0, 1.0, outliers=(2,))
    assert of(mean) == [(False, True), (False, False), (True, False)]


def test_without_a_mean_no_photo_is_in_it_or_left_out_of_it() -> None:
    assert of(None) == [(False, False)] * 3
