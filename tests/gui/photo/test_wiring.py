"""The photo's pane is idle where nothing works for it."""

from types import SimpleNamespace

import pytest

from occ_gui.photo.wiring import PhotoWiring

RUN = ("photos", "matching", "many", "lamps")
NEWEST = ("comparison", "chips")


def wiring(busy: str) -> SimpleNamespace:
    parts = {name: SimpleNamespace(runner=SimpleNamespace(is_running=name == busy)) for name in RUN}
    parts |= {
        name: SimpleNamespace(runner=SimpleNamespace(is_idle=name != busy)) for name in NEWEST
    }
    return SimpleNamespace(**parts)


@pytest.mark.parametrize("busy", ["", *RUN, *NEWEST])
def test_the_photo_is_idle_where_none_of_its_controllers_works(busy: str) -> None:
    assert PhotoWiring.is_idle.fget(wiring(busy)) is not bool(busy)  # type: ignore[attr-defined]
