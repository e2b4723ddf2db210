"""The frames of a simulated film, their noise, times, motion and exposure times."""

import tracemalloc
from fractions import Fraction
from itertools import islice

import numpy as np
import pytest
from exact_light import ExactLight

import occ_model as occ
from occ_model.light.sent import light_period
from occ_model.scene.scene import Scene

SCENE = Scene().replace(rows=120, columns=160, readout_time=1e-4, distance=0.8)
PERIOD, READ = 1 / 30, 160e-4


def test_a_film_can_be_iterated_again_and_read_frame_by_frame() -> None:
    film = occ.render_video(SCENE, frames=4)
    once, again = ([frame.image for frame in film] for _ in range(2))
    assert len(once) == film.frame_count == 4
    for index, image in enumerate(once):
        np.testing.assert_array_equal(again[index], image)
        np.testing.assert_array_equal(film.frame(index).image, image)
    assert [frame.index for frame in film.frames(2)] == [2, 3]
    assert once[0].shape == film.shape == (120, 160)


def test_an_endless_film_has_no_frame_count() -> None:
    film = occ.render_video(SCENE)
    assert film.frame_count is None
    assert [frame.index for frame in islice(film.frames(10**6), 2)] == [10**6, 10**6 + 1]


def test_each_frame_has_its_own_noise_and_the_camera_keeps_its_pattern() -> None:
    # 20 packets per frame, so all frames start at the same place in a packet.
    still = SCENE.replace(switching_frequency=24 * 30 * 20.0)
    noisy = occ.SimulationSettings(force={"fixed-pattern": False, "sensor-noise": True})
    film = occ.render_video(still, frames=3, settings=noisy)
    first, second, third = (frame.image.astype(float) for frame in film)
    assert np.ptp([frame.scene.model.start_time for frame in film if frame.scene]) < 1e-12
    noise, other = first - second, second - third
    assert noise.std() > 0.3
    assert abs(np.corrcoef(noise.ravel(), (first - third).ravel())[0, 1] - 0.5) < 0.05
    assert other.std() == pytest.approx(noise.std(), rel=0.05)
    patterned = occ.SimulationSettings(force={"fixed-pattern": True, "sensor-noise": False})
    one, two = occ.render_video(still.replace(gain_variation=0.05), frames=2, settings=patterned)
    np.testing.assert_array_equal(one.image, two.image)


def test_another_seed_gives_other_noise_and_the_same_seed_equal_noise() -> None:
    films = [
        occ.render_video(SCENE, settings=occ.SimulationSettings(seed=seed)) for seed in (1, 2, 1)
    ]
    first, other, same = (film.frame(7).image for film in films)
    np.testing.assert_array_equal(first, same)
    assert (first != other).any()
    assert len({films[0].seed_of(index) for index in range(1000)}) == 1000


def test_jitter_has_its_deviation_and_never_lets_frames_overlap() -> None:
    recording = occ.Recording(frame_jitter=1e-3, camera_drift=-5e-5)
    film = occ.render_video(SCENE, recording=recording)
    # By the camera's clock, as the stated times are.
    starts = np.array([float(film.start_of(index)) * (1 - 5e-5) for index in range(2000)])
    moved = starts - np.arange(2000) * PERIOD
    # The deviation of 2,000 numbers is within 5 % of the true one by more than three sigma.
    assert moved.std() == pytest.approx(1e-3, rel=0.05)
    assert np.diff(starts).min() >= READ
    assert np.abs(moved).max() <= recording.gap(SCENE) / 2
    times = [film.time_of(index) for index in range(2000)]
    assert times[0] == 0.0
    np.testing.assert_allclose(times, starts - starts[0], atol=1e-12)
    frame = film.frame(7)
    assert (frame.time, frame.start) == (times[7], film.start_of(7))
    nominal = occ.render_video(SCENE, recording=recording.replace(frame_times="nominal"))
    assert [nominal.time_of(index) for index in (0, 3, 300)] == [0.0, 0.1, 10.0]
    assert nominal.start_of(5) == film.start_of(5)


def test_the_panel_follows_the_path() -> None:
    path = (occ.Waypoint(0.1), occ.Waypoint(0.2, offset_x=0.1, roll=0.2), occ.Waypoint(0.3))
    film = occ.render_video(SCENE.replace(offset_x=0.05), recording=occ.Recording(path=path))
    where = {index: film.scene_of(index).pose for index in (0, 3, 6, 90)}
    assert [pose.offset_x for pose in where.values()] == pytest.approx([0.05, 0.05, 0.15, 0.05])
    slower = occ.Recording(frame_rate=20.0, path=path)
    halfway = occ.render_video(SCENE, recording=slower).scene_of(3)
    assert (halfway.pose.offset_x, halfway.pose.roll) == pytest.approx((0.05, 0.1))
    frame = film.frame(6)
    assert frame.scene is not None
    corners = occ.panel_corners(frame.scene)
    level = frame.image[:, : int(corners[:, 0].min()) - 2].max()
    assert frame.image[:, int(corners[:, 0].max()) - 20 :].max() > level + 50


def test_exposure_times_come_in_turn() -> None:
    recording = occ.Recording(exposure_times=(1e-4, 2e-4), camera_drift=1e-4)
    frames = list(occ.render_video(SCENE, 3, recording))
    assert [frame.exposure_time for frame in frames] == [1e-4, 2e-4, 1e-4]
    actual = [frame.scene.camera.exposure_time for frame in frames if frame.scene]
    assert actual == pytest.approx([1e-4 / 1.0001, 2e-4 / 1.0001, 1e-4 / 1.0001], rel=1e-15)


def test_the_gap_is_the_rest_of_the_period_after_the_readout() -> None:
    recording = occ.Recording(frame_rate=30.0)
    assert recording.gap(SCENE) == pytest.approx(PERIOD - READ)
    assert recording.gap_ratio(SCENE) == pytest.approx(1 - 30 * READ)


@pytest.mark.parametrize(
    ("scene", "recording", "words"),
    [
        (SCENE, {"frame_rate": 100.0}, "160 columns at 100 µs takes 16 ms; allowed at 100 Hz"),
        (SCENE, {"frame_jitter": 5e-3}, "frame_jitter is 5 ms; allowed with a gap of 17.3333 ms"),
        (SCENE, {"exposure_times": (0.04,)}, "exposure_time is 40 ms; allowed in a film of 30 Hz"),
        (SCENE.replace(exposure_time=0.05), {}, "exposure_time is 50 ms; allowed in a film"),
    ],
)
def test_a_scene_that_cannot_be_filmed_is_refused(
    scene: Scene, recording: dict[str, float], words: str
) -> None:
    with pytest.raises(occ.ParameterError) as refusal:
        occ.render_video(scene, recording=occ.Recording(**recording))  # type: ignore[arg-type]
    assert words in str(refusal.value)


LIGHTS: dict[str, tuple[dict[str, str | float], dict[str, str | float]]] = {
    # a light, and the same by a clock that runs too fast by 1/128
    "code": ({"switching_frequency": 12.8e3}, {"switching_frequency": 12.9e3}),
    "lamp": ({"light": "lamp", "lamp_frequency": 256.0}, {"lamp_frequency": 258.0}),
    "pulses": (
        {"light": "pulses", "pulse_frequency": 128.0, "pulse_length": 129e-5},
        {"pulse_frequency": 129.0, "pulse_length": 128e-5},
    ),
    "mains": ({"light": "mains", "mains_frequency": 64.0}, {"mains_frequency": 64.5}),
    "levels": (
        {"light": "waveform", "switching_frequency": 6400.0},
        {"switching_frequency": 6450.0},
    ),
    "recorded": (
        {"light": "waveform", "waveform_file": "0,0.2\n129e-5,1\n387e-5\n"},
        {"waveform_file": "0,0.2\n128e-5,1\n384e-5\n"},
    ),
}


@pytest.mark.parametrize("name", LIGHTS)
def test_frames_of_any_light_are_at_its_exact_phase_after_days(name: str) -> None:
    scene = SCENE.replace(**LIGHTS[name][0])
    film = occ.render_video(scene, recording=occ.Recording(frame_rate=30.0))
    for index in (0, 1, 7, 10**7 + 1):
        shown = film.scene_of(index)
        assert 0.0 <= shown.model.start_time <= float(light_period(scene.transmitter))
        start = Fraction(index, 30)
        exact = ExactLight(scene).mean(start, Fraction(1, 10**4), 160)
        np.testing.assert_allclose(occ.on_time(shown) / 136e-6, exact, atol=1e-10)


@pytest.mark.parametrize("name", LIGHTS)
def test_the_lamp_s_clock_sets_the_frequencies_and_times_of_any_light(name: str) -> None:
    own, drifted = LIGHTS[name]
    scene = SCENE.replace(**own, edge_time=1e-6)
    film = occ.render_video(scene, recording=occ.Recording(transmitter_drift=1 / 128))
    expected = scene.replace(**drifted).transmitter
    frame = film.scene_of(0)
    assert light_period(frame.transmitter) == pytest.approx(light_period(expected), rel=1e-15)
    np.testing.assert_allclose(
        occ.on_time(frame), occ.on_time(scene.replace(**drifted)), atol=1e-12
    )
    assert frame.transmitter.edge_time == 1e-6


def test_a_path_that_leads_out_of_range_is_refused_with_its_frame() -> None:
    film = occ.render_video(
        SCENE, recording=occ.Recording(path=(occ.Waypoint(0.0), occ.Waypoint(1.0, distance=-30.0)))
    )
    assert film.frame(0).image.any()
    with pytest.raises(occ.ParameterError, match="Frame 5 of the film: distance is "):
        film.frame(5)


def test_the_memory_does_not_grow_with_the_film(monkeypatch: pytest.MonkeyPatch) -> None:
    # In one thread, since the number of bands that several threads keep at once varies.
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    film = occ.render_video(SCENE.replace(rows=300, columns=300, readout_time=1e-5))
    peaks = []
    for frames in (3, 15):
        tracemalloc.start()
        for _ in islice(film, frames):
            pass
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.1 * peaks[0]


def test_a_draft_has_a_selection_of_the_frames_rows() -> None:
    film = occ.render_video(SCENE, 1, rows_step=8)
    assert film.shape == film.frame(0).image.shape == (15, 160)
