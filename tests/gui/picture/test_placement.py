"""Where a photo lies: as it suits the pictures, until the user moves it."""

import pytest

from occ_gui.picture.placement import LARGEST_SCALE, LEAST_SCALE, Placement, PlacementStore


@pytest.fixture
def received() -> list[Placement]:
    return []


@pytest.fixture
def store(received: list[Placement]) -> PlacementStore:
    store = PlacementStore()
    store.changed.connect(received.append)
    return store


def test_an_allowed_value_is_taken_and_emitted_once(
    store: PlacementStore, received: list[Placement]
) -> None:
    store.suggest(Placement(3.0, 4.0))
    store.suggest(Placement(3.0, 4.0))
    assert store.placement == Placement(3.0, 4.0)
    assert received == [Placement(3.0, 4.0)]
    assert not store.is_by_hand


def test_what_the_user_chose_holds_whatever_suits(
    store: PlacementStore, received: list[Placement]
) -> None:
    store.move(Placement(1.0, 2.0, 0.5))
    store.suggest(Placement(3.0, 4.0))
    assert store.placement == Placement(1.0, 2.0, 0.5)
    assert received == [Placement(1.0, 2.0, 0.5)]
    assert store.is_by_hand


def test_reset_goes_back_to_what_suits_by_now(
    store: PlacementStore, received: list[Placement]
) -> None:
    store.move(Placement(1.0, 2.0, 0.5))
    store.suggest(Placement(3.0, 4.0))
    store.reset()
    assert received[-1] == store.placement == Placement(3.0, 4.0)
    assert not store.is_by_hand
    received.clear()
    store.reset()
    assert received == []


def test_moving_by_hand_to_the_same_place_still_counts(
    store: PlacementStore, received: list[Placement]
) -> None:
    store.move(Placement())
    assert received == [Placement()]
    assert store.is_by_hand


@pytest.mark.parametrize(("scale", "kept"), [(0.0, LEAST_SCALE), (1e9, LARGEST_SCALE)])
def test_the_scale_stays_within_its_limits(
    store: PlacementStore, scale: float, kept: float
) -> None:
    store.move(Placement(scale=scale))
    assert store.placement.scale == kept
