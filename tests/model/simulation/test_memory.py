"""How much memory a picture takes while it is made, and after."""

import tracemalloc
from collections.abc import Iterator

import pytest

import occ_model as occ
from occ_model.camera.row_memory import LIMIT
from occ_model.scene.scene import Scene


@pytest.fixture(scope="module")
def scene() -> Scene:
    """A picture with all ten effects, of eight million pixels."""
    scene = occ.load_preset("phone-136us-real").replace(columns=1728)
    occ.render(scene.replace(rows=200), tolerance=0.0)  # what is loaded once is loaded now
    occ.render(scene.replace(rows=200), tolerance=0.0, noise="reused")
    return scene


@pytest.fixture
def traced() -> Iterator[None]:
    tracemalloc.start()
    yield
    tracemalloc.stop()


@pytest.mark.usefixtures("traced")
@pytest.mark.parametrize("noise", ["exact", "reused"])
@pytest.mark.parametrize("turn", [{}, {"roll": 0.3}])
def test_a_picture_takes_six_bytes_a_pixel_beside_itself(
    scene: Scene, noise: str, turn: dict[str, float]
) -> None:
    before, _ = tracemalloc.get_traced_memory()
    tracemalloc.reset_peak()
    image = occ.render(scene.replace(**turn), tolerance=0.0, noise=noise).image  # type: ignore[arg-type]
    _, peak = tracemalloc.get_traced_memory()
    assert image.nbytes <= peak - before <= 7 * image.nbytes


@pytest.mark.whole
@pytest.mark.usefixtures("traced")
def test_a_frame_that_is_gone_leaves_no_more_than_is_remembered(scene: Scene) -> None:
    small = scene.replace(rows=1152, jpeg_quality=0)
    held = []
    for move in range(24):
        # Without a limit, what is remembered would be half as much again after these.
        occ.render(small.replace(distance=1.0 + 0.01 * move), tolerance=0.0, noise="reused")
        held.append(tracemalloc.get_traced_memory()[0])
    assert max(held) <= LIMIT + 2**21  # two megabytes for all that is small
