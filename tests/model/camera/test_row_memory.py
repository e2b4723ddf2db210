"""What depends on pose and lens alone is remembered, within a number of bytes."""

import numpy as np
from amount import amount

import occ_model as occ
from occ_model.camera.row_memory import LIMIT, MEMORY, RowMemory


def kilobyte() -> tuple[np.ndarray, ...]:
    return (np.zeros(256, dtype=np.float32),)


def test_what_was_made_for_a_key_is_made_once() -> None:
    memory, made = RowMemory(10_000), []

    def make() -> tuple[np.ndarray, ...]:
        made.append(1)
        return kilobyte()

    first = memory.recall("a", make, tuple)
    assert memory.recall("a", make, tuple) is first
    assert len(made) == 1
    assert not first[0].flags.writeable


def test_what_was_used_longest_ago_is_forgotten_first() -> None:
    memory = RowMemory(3 * 1024)
    kept = memory.recall("kept", kilobyte, tuple)
    for key in range(10):
        memory.recall(key, kilobyte, tuple)
        assert memory.recall("kept", kilobyte, tuple) is kept
        assert memory.size <= 3 * 1024
    assert memory.recall(0, kilobyte, tuple) is not memory.recall("other", kilobyte, tuple)


def test_of_small_things_no_more_are_remembered_than_entries() -> None:
    memory = RowMemory(10**6, entries=5)
    for key in range(100):
        memory.recall(key, kilobyte, tuple)
    assert memory.size == 5 * 1024
    kept = memory.recall(99, kilobyte, tuple)
    assert memory.recall(99, kilobyte, tuple) is kept


def test_what_is_larger_than_the_memory_is_not_remembered() -> None:
    memory = RowMemory(1000)
    assert memory.recall("a", kilobyte, tuple) is not memory.recall("a", kilobyte, tuple)
    assert memory.size == 0


def test_no_number_of_moves_fills_more_than_the_limit() -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=1152, jpeg_quality=0)
    for move in range(amount(25, 60)):
        moved = scene.replace(distance=1.0 + 0.01 * move)
        occ.render(moved, tolerance=0.0, noise="reused", rows_step=1 + 8 * (move % 5 > 0))
        assert MEMORY.size <= LIMIT
    held = sum(size for _, size in MEMORY._known.values())
    assert held == MEMORY.size > LIMIT / 2


def test_a_remembered_picture_is_the_one_made_anew() -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=400, columns=500, roll=0.1)
    first = occ.render(scene, tolerance=0.0).image
    for changes in ({"roll": 0.0}, {"vignetting_exponent": 1.0}, {"lambertian_order": 3.0}):
        other = occ.render(scene.replace(**changes), tolerance=0.0).image
        assert (other != first).any()
    np.testing.assert_array_equal(occ.render(scene, tolerance=0.0).image, first)
