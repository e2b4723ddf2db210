"""Pictures do not depend on the number of threads."""

import threading

import numpy as np
import pytest

import occ_model as occ
from occ_model.simulation.threads import each_in_threads, threads


@pytest.mark.parametrize("noise", ["exact", "reused"])
@pytest.mark.parametrize("rows_step", [1, 3])
def test_a_picture_is_the_same_in_any_number_of_threads(
    noise: str, rows_step: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=900, columns=300)
    frames = []
    for count in ("1", "2", "7"):
        monkeypatch.setenv("OMP_NUM_THREADS", count)
        monkeypatch.setattr("os.cpu_count", lambda: 8)
        assert threads() == int(count)
        frames.append(occ.render(scene, tolerance=0.0, noise=noise, rows_step=rows_step))  # type: ignore[arg-type]
    for frame in frames[1:]:
        np.testing.assert_array_equal(frame.image, frames[0].image)
        np.testing.assert_array_equal(frame.profile, frames[0].profile)
        np.testing.assert_array_equal(frame.signal, frames[0].signal)


@pytest.mark.parametrize(
    ("wanted", "count"), [("", 4), ("1", 1), ("3", 3), ("64", 4), ("0", 1), ("many", 4)]
)
def test_threads_are_as_many_as_cores_or_fewer(
    wanted: str, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", wanted)
    monkeypatch.setattr("os.cpu_count", lambda: 4)
    assert threads() == count


def test_results_come_in_order_and_items_are_taken_by_the_caller(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("occ_model.simulation.threads.threads", lambda: 3)
    takers, ahead = set(), []

    def items() -> object:
        for number in range(40):
            takers.add(threading.current_thread())
            ahead.append(number)
            yield number

    for place, result in enumerate(each_in_threads(lambda number: number**2, items())):  # type: ignore[arg-type]
        assert result == place**2
        assert len(ahead) - place <= 8  # few are prepared, whatever they hold
    assert takers == {threading.current_thread()}


def test_a_single_item_starts_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("occ_model.simulation.threads.threads", lambda: 2)
    workers = list(each_in_threads(lambda _: threading.current_thread(), [0]))
    assert workers == [threading.current_thread()]
    assert list(each_in_threads(lambda number: number, [])) == []
    assert threading.current_thread() not in each_in_threads(
        lambda _: threading.current_thread(), [0, 1]
    )


def test_an_error_in_a_thread_is_the_callers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("occ_model.simulation.threads.threads", lambda: 2)
    with pytest.raises(ZeroDivisionError):
        list(each_in_threads(lambda number: 1 / number, [1, 0, 2]))


def test_the_times_of_all_stages_add_up_to_that_of_the_frame(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ticks = iter(range(10**6))
    monkeypatch.setattr("occ_model.simulation.stage_timer.perf_counter", lambda: float(next(ticks)))
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    scene = occ.load_preset("phone-136us-real").replace(rows=200, columns=300)
    first = next(ticks)
    timings = occ.render(scene, tolerance=0.0).timings
    spent = next(ticks) - first
    # A tick before the first stage begins, one where the plan is handed over, and one at the end.
    assert sum(timings.values()) == pytest.approx(spent - 3)
