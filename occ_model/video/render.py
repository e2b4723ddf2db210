"""Simulate a film: the pictures that a camera takes of a scene one after another."""

import math
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

import numpy as np

from occ_model.camera.projection import check_size
from occ_model.effects.registry import NAMES
from occ_model.errors import ParameterError
from occ_model.light.sent import light_period
from occ_model.results.video import Video, VideoFrame
from occ_model.scene.argument_checks import check_count
from occ_model.scene.colour_scenes import (
    EFFECTS_OFF,
    check_colour,
    check_monochrome,
    is_colour,
    led_scene,
)
from occ_model.scene.light_samples import samples_of, text_of_samples
from occ_model.scene.parameter_kinds import ParameterValue, Quantity
from occ_model.scene.recording import Recording
from occ_model.scene.scene import Scene, SimulationSettings, Transmitter
from occ_model.scene.units import HERTZ, SECOND
from occ_model.simulation.render import render_with

MOST_FRAMES = 100_000_000  # maximum of a film: days even at hundreds per second
_JITTER, _PICTURE = 0, 1  # numbers of a frame's own streams of random numbers


def render_video(
    scene: Scene,
    frames: int | None = None,
    recording: Recording | None = None,
    *,
    settings: SimulationSettings | None = None,
    rows_step: int = 1,
) -> "SimulatedVideo":
    """Simulate the film that the scene's camera takes.

    Frames are simulated one by one on request; only the current one is kept.

    Parameters
    ----------
    scene
        The scene; its start time is that of the first frame. Of a colour camera, the frames' images
        are those of :func:`occ_model.render_colour`.
    frames
        Number of frames; None for an endless film.
    recording
        Frame rate, jitter, clocks, motion and exposure times; by default 30 frames per second of
        the unchanged scene.
    settings
        The settings of the simulation, by default those of :func:`occ_model.render`. Each frame has
        its own stream of random numbers from their seed, but what belongs to the camera itself
        stays the same in all frames.
    rows_step
        From 2 on, frames are drafts that contain only every ``rows_step``-th row.

    Raises
    ------
    ParameterError
        ``frames`` is not a whole number from 1, a setting is out of range, or the scene cannot be
        recorded this way: see :meth:`occ_model.Recording.check`.
    ProjectionError
        The image would be too large.
    """
    if frames is not None:
        check_count("frames", frames, 1, MOST_FRAMES)
    names = NAMES
    if is_colour(scene):
        check_colour(scene)
        names = (*NAMES, *EFFECTS_OFF)
    else:
        check_monochrome(scene)
    check_count("rows_step", rows_step, 1, 1 if is_colour(scene) else scene.camera.rows)
    settings = (settings or SimulationSettings()).check(names)
    recording = recording or Recording()
    recording.check(scene)
    check_size(scene.camera)
    return SimulatedVideo(scene, frames, recording, settings, rows_step)


class SimulatedVideo(Video):
    """A film whose frames are simulated on demand: see :func:`render_video`."""

    scene: Scene
    recording: Recording

    def __init__(
        self,
        scene: Scene,
        frames: int | None,
        recording: Recording,
        settings: SimulationSettings,
        rows_step: int = 1,
    ) -> None:
        self.title = "Simulated film"
        self.scene = scene
        self.recording = recording
        self.settings = settings
        self.frame_count = frames
        self.frame_rate = recording.frame_rate
        rows = len(range(0, scene.camera.rows, rows_step))
        self.shape = (rows, scene.camera.columns)
        self._rows_step = rows_step
        self._drifted_scene = _apply_drift(scene, recording)

    def frames(self, first: int = 0) -> Iterator[VideoFrame]:
        """Simulate the frames in order, from the one with the number ``first``."""
        check_count("first", first, 0)
        index = int(first)
        while self.frame_count is None or index < self.frame_count:
            yield self.frame(index)
            index += 1

    def frame(self, index: int) -> VideoFrame:
        last = None if self.frame_count is None else self.frame_count - 1
        check_count("index", index, 0, last)
        index = int(index)
        scene = self.scene_of(index)
        settings = replace(self.settings, seed=self.seed_of(index))
        if is_colour(scene):
            from occ_model.simulation.colour import render_colour_with  # by colour cameras only

            picture = render_colour_with(scene, settings).image
        else:
            picture = render_with(scene, settings, self._rows_step).camera_image
        return VideoFrame(
            index=index,
            time=self.time_of(index),
            image=picture,
            exposure_time=self.recording.exposure_time(self.scene, index),
            scene=scene,
            start=self.start_of(index),
        )

    def seed_of(self, index: int) -> int:
        """Return the seed of a frame's picture, derived from that of the film."""
        words = _spawn_seed(self.settings.seed, index, _PICTURE).generate_state(2, np.uint64)
        return int(words[0]) << 64 | int(words[1])

    def start_of(self, index: int) -> Fraction:
        """Return the exact true start time of a frame, in seconds."""
        start = Fraction(self.scene.model.start_time)
        return start + self._clock(index) / (1 + Fraction(self.recording.camera_drift))

    def time_of(self, index: int) -> float:
        """Return the time that the film states for a frame, in seconds."""
        if self.recording.frame_times == "nominal":
            return float(index / Fraction(self.recording.frame_rate))
        return float(self._clock(index) - self._clock(0))

    def scene_of(self, index: int) -> Scene:
        """Return the exact scene that a frame shows: see :class:`occ_model.VideoFrame`.

        Whole periods of the light are subtracted from the start time in exact arithmetic, so that
        its phase is as exact after days as at the start; the phase of the mains is kept.
        """
        drifted_scene, recording = self._drifted_scene, self.recording
        start = self.start_of(index)
        time_in_period = float(start % _light_period(drifted_scene))
        changes = {"start_time": time_in_period, **self._pose_changes(index)}
        if recording.exposure_times:
            exposure = Fraction(recording.exposure_time(drifted_scene, index))
            changes["exposure_time"] = float(exposure / (1 + Fraction(recording.camera_drift)))
        if drifted_scene.surroundings.flicker_depth:
            cycles = (start - Fraction(time_in_period)) * Fraction(
                drifted_scene.surroundings.flicker_frequency
            )
            phase = drifted_scene.surroundings.flicker_phase + 2.0 * math.pi * float(cycles % 1)
            changes["flicker_phase"] = math.remainder(phase, 2.0 * math.pi)
        return drifted_scene.replace(**changes)

    def _pose_changes(self, index: int) -> dict[str, float]:
        pose = self.scene.pose
        motion = self.recording.motion(float(self._clock(index) - self._clock(0)))
        changes = {name: getattr(pose, name) + shift for name, shift in motion.items()}
        try:
            self.scene.replace(**changes)
        except ParameterError as error:
            raise error.within(f"Frame {index} of the film") from None
        return changes

    def _clock(self, index: int) -> Fraction:
        """Return a frame's start by the camera's clock, counted from the nominal start."""
        nominal = index / Fraction(self.recording.frame_rate)
        jitter = self.recording.frame_jitter
        if not jitter:
            return nominal
        random = np.random.default_rng(_spawn_seed(self.settings.seed, index, _JITTER))
        largest = self.recording.gap(self.scene) / 2.0
        return nominal + Fraction(min(max(jitter * random.standard_normal(), -largest), largest))


def _spawn_seed(seed: int, index: int, purpose: int) -> np.random.SeedSequence:
    """Return the seed of one of a frame's own streams of random numbers."""
    return np.random.SeedSequence(seed, spawn_key=(index, purpose))


def _light_period(scene: Scene) -> Fraction:
    """Return the period of a scene's light; a steady LED has any."""
    leds = [led_scene(scene, index) for index in range(3)] if is_colour(scene) else [scene]
    return max(light_period(led.transmitter) for led in leds)


def _apply_drift(scene: Scene, recording: Recording) -> Scene:
    """Return the scene with its true times and frequencies."""
    camera_rate, led_rate = (
        1 + Fraction(recording.camera_drift),
        1 + Fraction(recording.transmitter_drift),
    )
    return scene.replace(
        **_apply_clock(scene.transmitter, led_rate),
        exposure_time=float(Fraction(scene.camera.exposure_time) / camera_rate),
        readout_time=float(Fraction(scene.camera.readout_time) / camera_rate),
    )


def _apply_clock(transmitter: Transmitter, clock: Fraction) -> dict[str, ParameterValue]:
    """Return the frequencies and times of a light whose clock runs faster by a factor."""
    changes: dict[str, ParameterValue] = {}
    for name, declaration in transmitter.declarations().items():
        # No clock determines the other parameters, such as the LED's edges.
        if isinstance(declaration, Quantity) and transmitter.light in declaration.lights:
            value = Fraction(getattr(transmitter, name))
            if declaration.unit is HERTZ:
                changes[name] = float(value * clock)
            elif declaration.unit is SECOND:
                changes[name] = float(value / clock)
    if transmitter.light == "waveform" and transmitter.waveform_file and clock != 1:
        seconds, levels = samples_of(transmitter.waveform_file)
        changes["waveform_file"] = text_of_samples(
            [float(Fraction(second) / clock) for second in seconds], levels
        )
    return changes
