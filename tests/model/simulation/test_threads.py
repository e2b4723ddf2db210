"""Pictures do not depend on threads; all time counts for a stage; memory is limited."""

import os
import subprocess
import sys
import threading
import tracemalloc
from collections.abc import Iterator

import numpy as np
import pytest

import occ_model as occ
from occ_model.scene.scene import Scene
from occ_model.simulation import pixels, stage_timer
from occ_model.simulation.stage_timer import StageTimer
from occ_model.simulation.threads import each_in_threads, threads


def use_threads(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", str(count))
    monkeypatch.setattr("os.cpu_count", lambda: 8)


@pytest.mark.parametrize("rows_step", [1, 3])
def test_a_picture_is_the_same_in_any_number_of_threads(
    rows_step: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = occ.load_preset("phone-136us-real").replace(rows=900, columns=300)
    frames = []
    for count in (1, 2, 7):
        use_threads(monkeypatch, count)
        assert threads() == count
        frames.append(occ.render(scene, tolerance=0.0, rows_step=rows_step))
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
    use_threads(monkeypatch, 3)
    takers, ahead = set(), []

    def items() -> object:
        for number in range(40):
            takers.add(threading.current_thread())
            ahead.append(number)
            yield number

    for place, result in enumerate(each_in_threads(lambda number: number**2, items())):  # type: ignore[arg-type]
        assert result == place**2
        assert len(ahead) - place <= 8  # only few are prepared in advance
    assert takers == {threading.current_thread()}


def test_a_single_item_starts_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    use_threads(monkeypatch, 2)
    workers = list(each_in_threads(lambda _: threading.current_thread(), [0]))
    assert workers == [threading.current_thread()]
    assert list(each_in_threads(lambda number: number, [])) == []
    assert threading.current_thread() not in each_in_threads(
        lambda _: threading.current_thread(), [0, 1]
    )


def test_threads_are_kept_for_all_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenCV keeps memory of each thread that has called it, also after the thread's end."""
    use_threads(monkeypatch, 2)
    workers: set[threading.Thread] = set()
    for _ in range(5):
        workers.update(each_in_threads(lambda _: threading.current_thread(), range(8)))
    assert len(workers) <= 2


def test_work_for_another_purpose_does_not_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    """A panel that is exposed is enhanced and shown while the other rows are exposed."""
    use_threads(monkeypatch, 2)
    go_on = threading.Event()
    exposing = each_in_threads(lambda number: number == 0 or go_on.wait(2.0), range(9))
    assert next(exposing)
    assert list(each_in_threads(lambda number: number, range(3), "enhance")) == [0, 1, 2]
    go_on.set()
    assert all(exposing)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")
def test_a_forked_process_has_threads_of_its_own() -> None:
    """A process that a user's script forks after a picture can simulate, too."""
    squares = "list(each_in_threads(lambda number: number**2, range(4)))"
    script = (
        "import os\n"
        "from occ_model.simulation.threads import each_in_threads\n"
        f"{squares}\n"
        "child = os.fork()\n"
        "if not child:\n"
        f"    os._exit(sum({squares}))\n"
        "print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    ran = subprocess.run(
        [sys.executable, "-W", "ignore::DeprecationWarning", "-c", script],
        capture_output=True, text=True, timeout=60.0,
        env={**os.environ, "OMP_NUM_THREADS": ""}, check=True,
    )  # fmt: skip
    assert ran.stdout.strip() == "14"


def test_an_error_in_a_thread_is_raised_to_the_caller(monkeypatch: pytest.MonkeyPatch) -> None:
    use_threads(monkeypatch, 2)
    with pytest.raises(ZeroDivisionError):
        list(each_in_threads(lambda number: 1 / number, [1, 0, 2]))


def test_of_work_that_is_given_up_only_what_has_begun_is_done(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    use_threads(monkeypatch, 2)
    begun, may_end = list[int](), threading.Event()

    def work(number: int) -> None:
        begun.append(number)
        may_end.wait(10.0)

    def items() -> Iterator[int]:
        yield from range(4)
        threading.Timer(0.1, may_end.set).start()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(each_in_threads(work, items()))
    assert set(begun) <= {0, 1}


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
    # One tick before the first stage begins, one between plan and picture, and one at the end.
    assert sum(timings.values()) == pytest.approx(spent - 3)
    # In each thread the picture is rounded, then stored, then enhanced.
    assert timings["image"] == pytest.approx(2.0 * timings["jpeg"])


def test_the_time_that_rows_wait_for_a_thread_counts_for_no_stage(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ticks = iter(range(10**6))
    monkeypatch.setattr(stage_timer, "perf_counter", lambda: float(next(ticks)))
    scene = occ.load_preset("phone-136us-real").replace(rows=200, columns=300)
    timings = []
    for ahead in (iter, list):
        monkeypatch.setattr(
            pixels, "each_in_threads", lambda work, rows, ahead=ahead: map(work, ahead(rows))
        )
        timings.append(occ.render(scene, tolerance=0.0).timings)
    assert timings[0] == pytest.approx(timings[1])


class Clock:
    """A clock that is set by hand."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_stages_of_threads_share_the_time_that_passed() -> None:
    clock = Clock()
    timer, *threads = (StageTimer(clock=clock) for _ in range(3))
    for clock.now, stage in ((1.0, "light"), (4.0, "noise")):
        for thread in threads:
            thread.end_stage(stage)
    clock.now = 6.0
    timer.end_parallel_stages(threads)
    assert timer.timings == pytest.approx({"light": 1.5, "noise": 4.5})
    assert sum(timer.timings.values()) == pytest.approx(6.0)


def test_stages_that_took_no_time_share_what_has_passed_alike() -> None:
    clock = Clock()
    timer, thread = StageTimer(clock=clock), StageTimer(clock=clock)
    for stage in ("light", "noise"):
        thread.end_stage(stage)
    clock.now = 6.0
    timer.end_parallel_stages([thread])
    assert timer.timings == {"light": 3.0, "noise": 3.0}


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A picture with all ten effects, of five million pixels."""
    scene = occ.load_preset("phone-136us-real").replace(columns=1152)
    occ.render(scene.replace(rows=200), tolerance=0.0)  # load everything that is loaded once
    return scene


@pytest.fixture
def traced() -> Iterator[None]:
    tracemalloc.start()
    yield
    tracemalloc.stop()


@pytest.mark.usefixtures("traced")
@pytest.mark.parametrize("turn", [{"roll": 0.3}, {}])
def test_a_picture_takes_six_bytes_a_pixel_beside_itself(
    scene: Scene, turn: dict[str, float]
) -> None:
    before, _ = tracemalloc.get_traced_memory()
    tracemalloc.reset_peak()
    image = occ.render(scene.replace(**turn), tolerance=0.0).image
    _, peak = tracemalloc.get_traced_memory()
    assert image.nbytes <= peak - before <= 7 * image.nbytes
