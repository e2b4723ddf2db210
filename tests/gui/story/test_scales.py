"""The scales' ticks stand at the columns and times that they name."""

import pytest
from gui.kinds import GreyPicture, SnapshotOf

from occ_gui.story.story_rows import StoryRows
from occ_gui.widgets.round_step import round_step


def test_each_time_is_that_of_its_column(rows: StoryRows, bare_snapshot_of: SnapshotOf) -> None:
    snapshot = bare_snapshot_of(start_time=2.5e-3, readout_time=11e-6)
    rows.show_reading(snapshot)
    ticks = rows.time.ticks()
    assert len(ticks) > 3
    for column, text in ticks:
        assert float(text) == pytest.approx(2500.0 + 11.0 * column, abs=1e-6)
        assert rows.axis.first <= column <= rows.axis.last
    for column, text in rows.columns.ticks():
        assert int(text) == column


@pytest.mark.parametrize("zoom", [1.0, 0.1, 3.0])
def test_a_tick_is_drawn_where_the_rows_have_its_column(
    rows: StoryRows, grey_picture: GreyPicture, zoom: float
) -> None:
    rows.axis.zoom(zoom, 1500.0)
    for scale, line in ((rows.columns, 2), (rows.time, -3)):
        drawn = grey_picture(scale)[line].astype(int)
        for column, _ in scale.ticks():
            x = round(rows.profile.x_of(column))
            around = drawn[[x - 2, x + 2]] if x + 2 < len(drawn) else drawn[[x - 2]]
            assert abs(drawn[x] - int(around.max())) > 60


@pytest.mark.parametrize(
    ("least", "step"), [(0.011, 0.02), (1.0, 1.0), (1.2, 2.0), (3.0, 5.0), (51.0, 100.0)]
)
def test_a_step_is_round_and_no_smaller_than_asked(least: float, step: float) -> None:
    assert round_step(least) == pytest.approx(step)
