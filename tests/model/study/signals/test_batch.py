"""What a batch gives decoders to read is what whole pictures would give them."""

import numpy as np
import pytest
from amount import amount

import occ_model as occ
from occ_model.effects.effect import paper_view_of
from occ_model.effects.plan import complete_plan
from occ_model.receiver.signal import column_means
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene, SimulationSettings
from occ_model.simulation.render import render_plan
from occ_model.study.signals.bands import bands_of, without_light
from occ_model.study.signals.batch import Observation, simulate_images
from occ_model.study.signals.exposed import Image
from occ_model.study.signals.pictures import image_of, picture_itself

SIGNAL = SimulationSettings(observable="signal")
PICTURES = amount(10, 24)

SMALL: dict[str, ParameterValue] = {"columns": 1152, "readout_time": 24e-6, "panel_width": 0.9}
SCENES: dict[str, tuple[str, dict[str, ParameterValue]]] = {
    "plain": ("phone-136us", {"rows": 300, **SMALL}),
    "dark": ("phone-68us", {"rows": 300, "luminance": 300.0, "enhancement": "stretch", **SMALL}),
    "lens and file": ("phone-136us-real", {"rows": 864, **SMALL}),
    "dark, lens and file": (
        "phone-68us-real", {"rows": 864, "luminance": 400.0, "enhancement": "stretch", **SMALL},
    ),
    "coarse file": ("phone-136us", {"rows": 300, "jpeg_quality": 40, "iso": 50.0, **SMALL}),
    "hot spot": ("phone-136us", {"rows": 600, "lambertian_order": 30.0, "yaw": 0.3, **SMALL}),
    "roll": ("phone-136us", {"rows": 600, "roll": 0.1, **SMALL}),
}  # fmt: skip


def scene_named(name: str) -> Scene:
    preset, changes = SCENES[name]
    return occ.load_preset(preset).replace(**changes)


def in_columns(observation: Observation, columns: slice) -> np.ndarray:
    region = observation.region
    assert region is not None
    assert region.first_column <= columns.start
    assert columns.stop <= region.last_column
    return observation.signal[columns.start - region.first_column :][: columns.stop - columns.start]


@pytest.mark.parametrize("name", SCENES)
def test_means_and_scatter_are_those_of_whole_pictures(name: str) -> None:
    scene = scene_named(name)
    plan, view = complete_plan(scene, SIGNAL), paper_view_of(scene)
    drawn = [*simulate_images([picture_itself(scene, plan, seed) for seed in range(PICTURES)])]
    first = max(each.region.first_column for each in drawn if each.region) + 8
    last = min(each.region.last_column for each in drawn if each.region) - 8
    batch = np.array([in_columns(each, slice(first, last)) for each in drawn])
    region = drawn[0].region
    assert region is not None
    pictures = np.array([
        column_means(render_plan(view, plan, seed=500 + seed).image, region)
        [first - region.first_column : last - region.first_column]
        for seed in range(PICTURES)
    ])  # fmt: skip
    scatter = pictures.var(axis=0, ddof=1) + batch.var(axis=0, ddof=1)
    error = np.sqrt(scatter.mean() / PICTURES)
    off = batch.mean(axis=0) - pictures.mean(axis=0)
    is_exact = bands_of(without_light(scene), frozenset(plan.included)).light is None
    assert np.sqrt((off**2).mean()) < 1.3 * error + (0.1 if is_exact else 1.2)
    ratio = np.sqrt(batch.var(axis=0, ddof=1).mean() / pictures.var(axis=0, ddof=1).mean())
    # Where noise does not dither a file's steps, little is left of it, and that is hardly known.
    assert (0.5 if name == "coarse file" else 0.85) < ratio < 1.15


def test_an_image_does_not_depend_on_those_simulated_with_it() -> None:
    scenes = [scene_named("plain").replace(switching_frequency=f) for f in (5e3, 9e3, 14e3)]
    scenes += [scene_named("lens and file"), scene_named("plain").replace(exposure_time=60e-6)]
    plans = [complete_plan(scene, SIGNAL) for scene in scenes]

    def images() -> list[Image]:
        pairs = zip(scenes, plans, strict=True)
        return [image_of(*pair, seed=3, number=number) for pair in pairs for number in range(4)]

    together = list(simulate_images(images()))
    alone = [observation for image in images() for observation in simulate_images([image])]
    for one, other in zip(together, alone, strict=True):
        assert one.region == other.region
        assert np.abs(one.signal - other.signal).max() < 1e-3


@pytest.mark.parametrize(
    "changes", [{}, {"light": "mains"}, {"rows": 9}, {"distance": 60.0}, {"offset_x": 0.4}]
)
@pytest.mark.parametrize("preset", ["phone-136us", "phone-136us-real"])
def test_without_noise_the_signal_of_a_plain_picture_is_exact(
    preset: str, changes: dict[str, ParameterValue]
) -> None:
    scene = occ.load_preset(preset).replace(rows=240, columns=800, readout_time=35e-6)
    scene = scene.replace(**changes)
    plan = occ.plan(scene, np.inf, "signal")
    (observation,) = simulate_images([picture_itself(scene, plan, 1)])
    image = render_plan(paper_view_of(scene), plan, seed=1).image
    if observation.region is None:
        assert occ.decode(image, scene).region is None or not paper_view_of(scene).is_visible
        return
    assert observation.region == occ.decode(image, scene).region
    assert observation.signal == pytest.approx(column_means(image, observation.region), abs=1e-4)
