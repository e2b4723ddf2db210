"""The pictures a second that the panes of the detection map share."""

import pytest
from gui.stores import store_of

from occ_gui.scene.frame_rate import FrameRate
from occ_model.errors import ParameterError


def test_only_another_rate_or_view_is_announced() -> None:
    rate = FrameRate(store_of().store)
    told: list[object] = []
    rate.changed.connect(told.append)
    rate.shown_changed.connect(told.append)
    rate.change(30.0)
    rate.show("rate")
    assert told == []
    rate.change(24.0)
    rate.show("bits")
    assert told == [24.0, "bits"]
    assert (rate.value, rate.shown) == (24.0, "bits")


def test_a_rate_that_cannot_be_leaves_the_one_before() -> None:
    rate = FrameRate(store_of().store)
    with pytest.raises(ParameterError):
        rate.change(-1.0)
    assert rate.value == 30.0
