"""Ordinary scenes from which colour pictures are made and read.

A colour camera has a filter on each pixel, in a Bayer pattern: a sensor's line (a column here) has
red and green pixels, or green and blue ones. So the red pixels are those of a monochrome camera
that reads out a column every 2 t_r, with half the columns and half the rows; so are the blue ones,
t_r later or earlier. Green pixels are in every column, in half the rows. What is known of a
monochrome scene, such as decoders, limits and sweeps, thus holds for each colour of a raw picture.
"""

import math
from dataclasses import replace

import numpy as np

from occ_model.errors import ParameterError, quote
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.parameters.camera import DIAGONAL_35MM
from occ_model.scene.parameters.colour import COLOURS, CSK_ORDERS
from occ_model.scene.scene import Scene

EFFECTS_OFF: dict[str, dict[str, ParameterValue]] = {
    "mixing": {"mixing": "", "crosstalk": 0.0},
    "white-balance": {"red_gain": 1.0, "blue_gain": 1.0},
    "demosaicing": {"demosaicing": "none"},
    "chroma": {"chroma": "full"},
}
"""The effects of a colour camera alone, and the parameters of a scene without each."""


def is_colour(scene: Scene) -> bool:
    """Return whether a scene has a colour camera."""
    return scene.colours.bayer != "none"


def check_monochrome(scene: Scene) -> None:
    """Refuse a scene of three colours where one is simulated or read."""
    if not is_colour(scene):
        if scene.colours.colour_light != "white":
            raise ParameterError.of(
                "colour_light", scene.colours.colour_light, "white",
                condition="for a monochrome camera, whose bayer is none",
                parameters=("colour_light", "bayer"),
            )  # fmt: skip
    else:
        check_colour(scene)
        raise ParameterError.of(
            "bayer", scene.colours.bayer,
            "none, or one colour of the scene: scene.colour('red'), --colour red",
            parameters=("bayer",),
        )  # fmt: skip


def check_colour(scene: Scene) -> None:
    """Refuse a scene that has no colour camera, or one whose parameters contradict each other."""
    if not is_colour(scene):
        raise ParameterError.of("bayer", "none", "a pattern such as rggb", parameters=("bayer",))
    if scene.model.averaging != "light":
        raise ParameterError.of(
            "averaging", scene.model.averaging, "light", condition="for a colour camera",
            parameters=("averaging", "bayer"),
        )  # fmt: skip
    sent, kind = scene.transmitter, scene.colours.colour_light
    if kind == "white":
        return
    if sent.light != "code" or (kind == "three-codes" and (sent.payload or sent.pattern)):
        raise ParameterError.of(
            "colour_light", kind, "white",
            condition="for a light other than a code, or three codes with a payload or pattern",
            parameters=("colour_light", "light"),
        )  # fmt: skip
    for name, code in scene.colours.codes.items() if kind == "three-codes" else ():
        if code >= 2**sent.bits:
            raise ParameterError.of(
                name, f"{code}", f"0 to {2**sent.bits - 1}",
                condition=f"with {sent.bits} bits", parameters=(name, "bits"),
            )  # fmt: skip


def led_scene(scene: Scene, index: int) -> Scene:
    """Return the monochrome scene of one LED, and of all the camera's pixels, without a file."""
    sent, kind = scene.transmitter, scene.colours.colour_light
    colour = COLOURS[index]
    if kind == "three-codes" and index:
        sent = replace(sent, code=scene.colours.codes[f"{colour}_code"])
    elif kind in CSK_ORDERS:
        from occ_model.scene.csk import levels_of_colour  # needed by this light only

        levels = levels_of_colour(kind, sent.payload_bits, index)
        sent = replace(sent, light="waveform", levels=levels, waveform_file="")
    elif kind in COLOURS and kind != colour:
        sent = replace(sent, light="waveform", levels="1", waveform_file="")
    return replace(
        scene,
        transmitter=sent,
        camera=replace(scene.camera, jpeg_quality=0),
        model=replace(scene.model, enhancement="none"),
        colours=type(scene.colours)(),
    )


def channel_scene(scene: Scene, index: int) -> Scene:
    """Return the monochrome scene of one channel: of its sensitivity to white, and its gain.

    Its transmitter is the LED of that colour alone; the lights are mixed when it is exposed.
    """
    led, colours = led_scene(scene, index), scene.colours
    sensitivity = sum(colours.matrix[index])
    return led.replace(
        iso=led.camera.iso * colours.gains[index],
        luminance=led.transmitter.luminance * sensitivity,
        illuminance=led.surroundings.illuminance * sensitivity,
    )


def noise_gain(scene: Scene, index: int) -> float:
    """Return by how much solving the mixing matrix enlarges the noise of one LED's light.

    It is the norm of a row of the inverse, as for channels that are equally noisy.
    """
    return float(np.linalg.norm(np.linalg.inv(scene.colours.matrix)[index]))


def colour_scene(scene: Scene, name: str) -> Scene:
    """Return the scene of one LED and of the pixels with its filter.

    Fewer rows stand for the noise that solving the mixing matrix adds. The picture's geometry is
    kept for a panel that faces the camera; a rim can be half a pixel off.
    """
    if name not in COLOURS:
        raise ParameterError.of("colour", quote(name), ", ".join(COLOURS))
    check_colour(scene)
    index = COLOURS.index(name)
    led, camera = led_scene(scene, index), scene.camera
    led = led.replace(iso=camera.iso * scene.colours.gains[index])
    row, column = scene.colours.first_pixel(name)
    rows = len(range(row, camera.rows, 2)) / noise_gain(scene, index) ** 2
    every = 1 if name == "green" else 2
    return pixels_scene(led, max(1, round(rows)), range(column % every, camera.columns, every))


def filter_scene(scene: Scene, place: int) -> Scene:
    """Return the scene of the pixels at one of the four places of a Bayer pattern."""
    row, column = divmod(place, 2)
    camera, sensor = scene.camera, scene.sensor
    # The four places are different pixels, whose gains differ.
    scene = scene.replace(sensor_seed=(4 * sensor.sensor_seed + place) % 2**31)
    return pixels_scene(scene, len(range(row, camera.rows, 2)), range(column, camera.columns, 2))


def pixels_scene(scene: Scene, rows: int, columns: range) -> Scene:
    """Return the scene of a camera that has some rows, and every k-th column, of another."""
    camera, sensor, sent, every = scene.camera, scene.sensor, scene.transmitter, columns.step
    # Pixels need not be square: a panel of another height stands for rows of another height.
    height = rows / camera.rows * every
    focal = camera.focal_length_pixels / every
    return scene.replace(
        panel_height=sent.panel_height * height,
        offset_y=scene.pose.offset_y * height,
        rows=rows,
        columns=len(columns),
        readout_time=every * camera.readout_time,
        equivalent_focal_length=focal * DIAGONAL_35MM / math.hypot(rows, len(columns)),
        # A pixel of twice the pitch that catches a quarter of the light is as noisy.
        pixel_pitch=sensor.pixel_pitch * every,
        quantum_efficiency=sensor.quantum_efficiency / every**2,
        point_spread=scene.lens.point_spread / every,
        start_time=scene.model.start_time + columns.start * camera.readout_time,
    )
