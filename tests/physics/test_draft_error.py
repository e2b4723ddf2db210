"""A draft's column means are as near to those of the whole picture as stated."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.effects.effect import paper_view_of
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.simulation.draft_error import (
    DraftedMeans,
    DraftedPanel,
    _compare_parts,
    draft_errors,
)
from occ_model.simulation.render import describe_draft

OBSERVED = ("profile", "signal")


def random_scene(random: np.random.Generator) -> Scene:
    """Draw a small picture with all effects of any size; every second panel is turned."""
    distance = float(random.uniform(0.3, 3.0))
    seen = random.uniform(0.2, 1.5, size=2) * distance
    changes: dict[str, ParameterValue] = {
        name: declared.at(float(random.random()))
        for name, declared in PARAMETERS.items()
        if isinstance(declared, Quantity)
    }
    changes |= {
        "rows": int(random.integers(100, 600)),
        "columns": int(random.integers(60, 300)),
        "code": int(random.integers(1024)),
        "averaging": str(random.choice(["light", "pixel-value"])),
        "enhancement": str(random.choice(["equalization", "stretch", "none"])),
        "jpeg_quality": int(random.choice([0, *random.integers(1, 101, size=3)])),
        "equivalent_focal_length": float(random.uniform(0.02, 0.06)),
        "distance": distance,
        "panel_width": float(seen[0]),
        "panel_height": float(seen[1]),
        "offset_x": float(random.normal() * 0.2 * distance),
        "offset_y": float(random.normal() * 0.2 * distance),
        "radial_k1": float(random.uniform(-0.15, 0.15)),
        "radial_k2": float(random.uniform(-0.15, 0.15)),
        "luminance": float(10 ** random.uniform(2.5, 5.0)),
        "illuminance": float(10 ** random.uniform(1.0, 4.0)),
        "pixel_pitch": float(10 ** random.uniform(-6.0, -5.0)),
    }
    if random.random() < 0.5:
        changes |= {"yaw": 0.0, "pitch": 0.0, "roll": 0.0}
    return Scene().replace(**changes)


def errors(scene: Scene, step: int) -> list[tuple[float, float]]:
    """Return the true and the stated error of the profile and of the signal."""
    whole = occ.render(scene, tolerance=0.0, seed=1)
    draft = occ.render(scene, tolerance=0.0, seed=2, rows_step=step)
    region = paper_view_of(scene).region
    columns = slice(region.first_column, region.last_column)
    found = []
    for observed in OBSERVED:
        off = (getattr(draft, observed) - getattr(whole, observed))[columns]
        found.append((math.sqrt(float(np.mean(off**2))), draft.draft_error[observed]))
    return found


def test_a_draft_is_as_near_to_its_picture_as_stated() -> None:
    random = np.random.default_rng(1)
    tried = 0
    while tried < amount(6, 50):
        scene, step = random_scene(random), int(random.choice([2, 3, 5, 9, 16]))
        try:
            found = errors(scene, step)
        except occ.ProjectionError:
            continue
        tried += 1
        for observed, (off, stated) in zip(OBSERVED, found, strict=True):
            assert off <= stated + 1e-9, (tried, step, observed, scene)


@pytest.mark.parametrize(
    "preset", ["phone-136us-real", pytest.param("tablet-61us-real", marks=pytest.mark.whole)]
)
@pytest.mark.parametrize("turn", [{}, {"roll": 0.15, "yaw": 0.2}])
def test_the_stated_error_of_a_real_cameras_draft_is_not_far_too_large(
    preset: str, turn: dict[str, float]
) -> None:
    scene = occ.load_preset(preset).replace(**turn)
    scene = scene.replace(columns=600, readout_time=5 * scene.camera.readout_time)
    for (off, stated), most in zip(errors(scene, 5), (4.0, 20.0), strict=True):
        assert off <= stated <= most


def test_a_picture_and_a_draft_of_equal_rows_have_no_error() -> None:
    scene = occ.load_preset("phone-136us").replace(rows=600, columns=600)
    whole = occ.render(scene)
    assert whole.draft_error == {"profile": 0.0, "signal": 0.0}
    draft = occ.render(scene, tolerance=math.inf, rows_step=7)
    assert draft.draft_error == {"profile": 0.0, "signal": 0.0}
    np.testing.assert_array_equal(draft.signal, occ.render(scene, tolerance=math.inf).signal)


def test_fewer_rows_have_a_larger_error() -> None:
    scene = occ.load_preset("phone-136us-real").replace(columns=600)
    steps = (2, 6, 18)
    stated = [occ.render(scene, rows_step=step).draft_error for step in steps]
    for observed in OBSERVED:
        found = [errors[observed] for errors in stated]
        assert found == sorted(found)


ROWS, STEP = 64, 4


def drafted(
    columns: int, rows: int, shown: int | None = None, blur: float = 0.0, rounding: float = 0.0
) -> DraftedPanel:
    """Draft so many rows, on all or on some of whose picture's rows the panel lies."""
    high = rows * STEP
    low = high if shown is None else shown
    outline = np.array([[0.0, 0.0], [columns, 0.0], [columns, low], [0.0, low]]) - 0.5
    return DraftedPanel(
        range(0, high, STEP), slice(0, columns), outline, (high, columns), blur, rounding
    )


def _none_short(_rows: np.ndarray, _times: int) -> dict[str, np.ndarray]:
    raise AssertionError("every column has parts enough")


@pytest.mark.parametrize("columns", [32, 128, 2048])
def test_of_independent_noise_it_is_that_of_the_means_with_a_margin_of_five_deviations(
    columns: int,
) -> None:
    random = np.random.default_rng(columns)
    stated = []
    for _ in range(40):
        image = np.rint(random.normal(120.0, 12.0, (ROWS, columns))).astype(np.uint8)
        means = {"profile": DraftedMeans(image, image.mean(axis=0), np.array([120.0]), 1.0)}
        stated.append(draft_errors(drafted(columns, ROWS), means, _none_short)["profile"])
    # The whole picture's mean has its own noise, over more rows.
    deviation = 12.0 / math.sqrt(ROWS) * math.sqrt(1.0 + 1.0 / STEP)
    # Eight neighbouring columns count as one independent estimate of a variance.
    margin = 1.0 + 5.0 / math.sqrt(2.0 * columns / 8)
    assert np.mean(stated) == pytest.approx(deviation * margin, rel=0.06)


@pytest.mark.parametrize("rounding", [0.02, 0.1, 0.5])
def test_the_rounding_of_a_file_counts_by_its_deviation_a_block(rounding: float) -> None:
    image = np.full((ROWS, 80), 120, dtype=np.uint8)
    means = DraftedMeans(image, image.mean(axis=0), np.array([120.0]), 1.0)

    def stated(of_a_block: float) -> float:
        panel = drafted(80, ROWS, rounding=of_a_block)
        return draft_errors(panel, {"profile": means}, _none_short)["profile"]

    assert stated(0.0) == 0.0
    # With the same number of blocks, twice the deviation gives twice the error.
    assert stated(2.0 * rounding) == pytest.approx(2.0 * stated(rounding))
    assert stated(rounding) >= rounding / math.sqrt(ROWS / 8)


def blocks(*levels: float, columns: int = 3) -> np.ndarray:
    """Return rows in blocks of eight, each of one level."""
    return np.tile(np.repeat(levels, 8).astype(np.uint8)[:, None], (1, columns))


def test_rows_of_the_blurred_rim_do_not_count_as_noise() -> None:
    """Blur darkens the rows at both ends of the panel, the same in every draft."""
    image = blocks(40, 100, 104, 100, 40)
    first, last = np.zeros(3, dtype=int), np.full(3, 40)
    means = np.full(3, 90.0)
    for guard, inner in ((1, [100, 104, 100]), (8, [100, 104, 100]), (9, [104])):
        variance, rim = _compare_parts(image, means, first, last, guard)
        if len(inner) == 1:
            assert np.isnan(variance).all()
            assert not rim.any()
            continue
        steps = np.diff(inner)
        expected = (steps @ steps) / 2.0 / (len(inner) - 1) / len(inner)
        assert variance == pytest.approx(expected)
        assert rim == pytest.approx(abs(90.0 - np.mean(inner)))
    whole, _ = _compare_parts(image, means, first, last, 0)
    assert (whole > 100.0).all()


def test_only_whole_parts_within_the_panel_count() -> None:
    image = blocks(0, 100, 100, 0)
    first, last = np.array([8, 7, 9]), np.array([24, 25, 23])
    variance, _ = _compare_parts(image, np.full(3, 100.0), first, last, 0)
    assert variance[:2].tolist() == [0.0, 0.0]
    assert np.isnan(variance[2])


def test_columns_of_few_rows_are_compared_with_all_of_them() -> None:
    columns = 40
    image = np.full((ROWS, columns), 100, dtype=np.uint8)
    means = DraftedMeans(image, np.full(columns, 100.0), np.array([100.0]), 1.0)
    random = np.random.default_rng(2)

    def stated(deviation: float, rounding: float = 0.0, most: int = 400) -> float:
        def exposed(shown: np.ndarray, times: int) -> dict[str, np.ndarray]:
            assert times == 7  # six differences of five blocks of columns
            assert np.flatnonzero(shown).tolist() == list(range(9))
            return {"profile": 93.0 + deviation * random.standard_normal((most, columns))}

        panel = drafted(columns, ROWS, shown=9, rounding=rounding)
        return draft_errors(panel, {"profile": means}, exposed)["profile"]

    assert stated(0.0) == pytest.approx(7.0)
    margin = 1.0 + 5.0 / math.sqrt(2.0 * columns / 8)
    other = 2.0 * math.sqrt(1.0 + 1.0 / STEP)
    assert stated(2.0) == pytest.approx(7.0 + margin * other, rel=0.05)
    # A file's step that all exposures lie on one side of: four of five blocks may lie beyond.
    assert stated(0.0, rounding=3.0) == pytest.approx(math.hypot(7.0, 3.0 * math.sqrt(4 / 5)))
    assert stated(0.0, rounding=3.0, most=1) == pytest.approx(7.0)


def test_of_an_even_white_that_the_lens_darkens_the_error_is_not_stated_as_none() -> None:
    """Without the lens, panel and surroundings have a single level."""
    scene = occ.load_preset("phone-136us").replace(
        rows=300, columns=300, iso=50.0, illuminance=3e5, reflectance=1.0, luminance=1e4,
        vignetting_exponent=8.0, panel_height=0.004, panel_width=0.3, offset_y=0.35, distance=1.0,
    )  # fmt: skip
    for off, stated in errors(scene, 40):
        assert 4.0 < off <= stated < 2.0 * off


def small_scene(random: np.random.Generator, step: int) -> Scene:
    """Make a scene whose draft has no, one or a few rows on the panel."""
    scene = random_scene(random)
    pixel = scene.pose.distance / scene.camera.focal_length_pixels
    height = pixel * step * float(10 ** random.uniform(-1.5, 0.7))
    width = pixel * float(10 ** random.uniform(-0.5, 2.3))
    return scene.replace(panel_height=max(1e-4, height), panel_width=max(1e-4, width))


def test_with_few_rows_of_the_panel_the_error_is_as_stated_and_not_much_less() -> None:
    random = np.random.default_rng(8)
    ratios: list[float] = []
    while len(ratios) < amount(15, 300):
        step = int(random.choice([2, 5, 16, 40]))
        try:
            found = errors(small_scene(random, step), step)
        except occ.ProjectionError:
            continue
        for off, stated in found:
            assert off <= stated + 1e-9, (step, found)
            if off > 0.1:
                ratios.append(stated / off)
    assert np.median(ratios) < 5.0


@pytest.mark.parametrize(("factor", "stretch"), [(0.3, 1.0), (1.0, 1.0), (2.5, 2.5)])
def test_an_enhancement_makes_a_files_rounding_larger_and_never_smaller(
    factor: float, stretch: float
) -> None:
    columns = SimpleNamespace(
        profile=np.array([20.0, 80.0]), around=np.array([10.0]),
        enhancement=lambda levels: factor * levels,
    )  # fmt: skip
    made = SimpleNamespace(
        profile=np.array([21.0, 79.0]), signal=np.zeros(2), camera_image=None, image=None
    )
    means = describe_draft(made, columns)  # type: ignore[arg-type]
    assert means["profile"].stretch == 1.0
    assert means["signal"].stretch == pytest.approx(stretch)
    assert np.ptp(means["profile"].levels) == 70.0
    assert np.ptp(means["signal"].levels) == pytest.approx(70.0 * factor)


def test_the_blurred_rim_that_is_left_out_is_whole() -> None:
    """Its reach is rounded up to whole rows of the draft."""
    image = np.full((40, 32), 100, dtype=np.uint8)
    image[:8] = image[-8:] = 60
    means = DraftedMeans(image, np.full(32, 100.0), np.array([60.0, 100.0]), 1.0)

    def stated(blur: float) -> float:
        panel = drafted(32, 40, blur=blur)
        return draft_errors(panel, {"profile": means}, _none_short)["profile"]

    # Even less than a row of blur leaves out the block at either rim, all of whose rows differ.
    assert stated(0.05) < 0.2 * stated(0.0)
