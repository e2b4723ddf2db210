"""Lamps that send no code are found, and named by the frequency of their light."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from amount import amount
from small_rooms import small_room

import occ_model as occ
from occ_model.effects.light_effects import ambient_fractions
from occ_model.room.reading import ReadLamp
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.room.view import scene_with_lamp
from occ_model.study.room_map import RoomMapRequest, room_map


def _lamp(frequency: float, duty: float = 0.3, **more: float) -> dict[str, Any]:
    return {"light": "lamp", "lamp_frequency": frequency, "duty": duty, **more}


def _room(*lights: dict[str, Any], **settings: Any) -> Room:
    """Return a room of lamps with these lights, as its file says it."""
    room = small_room(len(lights), **settings)
    lamps = tuple(
        dataclasses.replace(lamp, transmitter=lamp.transmitter.replace(**light))
        for lamp, light in zip(room.lamps, lights, strict=True)
    )
    return Room.from_toml(room.replace(lamps=lamps).to_toml())


def _read(room: Room) -> tuple[ReadLamp, ...]:
    return occ.read_room(occ.render_room(room, seed=1).camera_image, room).lamps


def _names(room: Room) -> list[str | None]:
    return sorted((lamp.name for lamp in _read(room)), key=str)


def test_two_dim_lamps_with_long_dark_times_are_found_as_two() -> None:
    room = _room(_lamp(300.0), _lamp(360.0), rows=768, columns=1152)
    image = occ.render_room(room, seed=1).camera_image
    assert 60 < np.percentile(image, 99) < 75
    assert 5 < image[:, :100].mean() < 8
    assert _names(room) == ["L0", "L1"]


@pytest.mark.parametrize("light", [
    {}, _lamp(2e3, 0.05), _lamp(9e3, 0.05), _lamp(400.0, 0.3, depth=0.5),
    {"light": "pulses", "pulse_frequency": 700.0, "pulse_length": 100e-6},
], ids=["code", "flashes", "missed flashes", "half dark", "pulses"])  # fmt: skip
@pytest.mark.parametrize("luminance", [2500.0, 3600.0])
@pytest.mark.parametrize("blur", [0.0, 3.0])
def test_as_many_lamps_are_found_as_there_are(
    light: dict[str, Any], luminance: float, blur: float
) -> None:
    """At the lower luminance the mean of missed flashes is little above the noise of the dark."""
    room = _room(light, light, rows=768, columns=1152, luminance=luminance, point_spread=blur,
                 vignetting_exponent=4.0)  # fmt: skip
    assert len(_read(room)) == len(occ.render_room(room, seed=1).lamps) == 2


def test_lamps_of_several_frequencies_and_codes_are_named_and_give_the_place() -> None:
    room = _room(_lamp(700.0), _lamp(500.0, 0.6, depth=0.5), {"code": 5},
                 {"pattern": "10", "switching_frequency": 4e3})  # fmt: skip
    reading = occ.read_room(occ.render_room(room, seed=1).camera_image, room)
    found = {lamp.name: lamp for lamp in reading.lamps}
    assert sorted(map(str, found)) == ["L0", "L1", "L2", "L3"]
    for name, true in {"L0": 700.0, "L1": 500.0, "L3": 2000.0}.items():
        measured = found[name].frequency
        assert abs(measured.value - true) < 5.0 * measured.error < 0.02 * true
        assert found[name].code is None
    assert found["L2"].code == 5
    apart = [getattr(reading.located.place, axis) - getattr(room.camera, axis) for axis in "xyz"]
    assert (np.abs(apart) < 4.5 * reading.located.errors[:3]).all()


def test_lamps_that_look_the_same_are_not_named() -> None:
    rate = 1.0 / 36e-6
    for other in (700.0, 700.1, rate - 700.0, rate + 700.0):  # the last two in these columns
        reading = _read(_room(_lamp(700.0), _lamp(other, 0.5)))
        assert [lamp.name for lamp in reading] == [None, None]
        assert reading[0].note == "L0 and L1 would look the same."


def test_a_lamp_of_another_frequency_is_not_named() -> None:
    room = _room(_lamp(700.0))
    image = occ.render_room(room, seed=1).camera_image
    (read,) = occ.read_room(image, _room(_lamp(720.0))).lamps
    assert read.name is None
    assert read.note == f"No lamp of the room has the frequency {read.frequency.words}."


def test_light_without_stripes_or_with_too_few_cycles_is_not_named() -> None:
    flat, slow = (
        _read(_room(_lamp(frequency, 0.5), exposure_time=1e-3)) for frequency in (1e3, 150.0)
    )
    assert [lamp.name for lamp in (*flat, *slow)] == [None, None]
    assert flat[0].note.endswith("its light shows no stripes that repeat.")
    assert slow[0].note.endswith("cycles of its light; at least 2 are needed.")


def test_a_lamp_that_may_be_cut_at_its_dark_time_is_reported_as_cut() -> None:
    # The light of the second starts 51 columns before it is cut.
    for shift, start, may_be_cut in ((-1.4, 0.0, False), (-1.6, 0.0017, True), (0.0, 0.0, False)):
        room = _room(_lamp(500.0, 0.2))
        lamp = dataclasses.replace(room.lamps[0], x=shift, start_time=start)
        room = room.replace(lamps=(lamp,), roll=0.0, y=0.0)
        (read,) = _read(room)
        assert read.is_cut == may_be_cut == ("picture's edge" in read.note), shift


@pytest.mark.parametrize("light", [
    {"light": "mains", "mains_frequency": 200.0, "mains_depth": 0.8},
    {"light": "pulses", "pulse_frequency": 900.0},
    {"light": "waveform", "levels": "0 1 2 3 / 3"},
], ids=lambda light: light["light"])  # fmt: skip
def test_every_light_is_rendered_and_named(light: dict[str, Any]) -> None:
    assert _names(_room(light, _lamp(1234.0))) == ["L0", "L1"]


def test_a_lamp_on_the_mains_lights_the_surroundings_at_the_rooms_time() -> None:
    room = _room(_lamp(700.0), {"light": "mains", "mains_frequency": 60.0}, _lamp(500.0))
    own, *others = (
        ambient_fractions(scene_with_lamp(room, room.lamps[number])) for number in (1, 0, 2)
    )
    assert np.ptp(own) > 0.1
    for other in others:
        np.testing.assert_allclose(other, own, atol=1e-12)


def _random_room(seed: int) -> Room:
    lights: list[dict[str, Any]]
    random = np.random.default_rng(seed)
    readout = float(random.choice([10e-6, 20e-6, 36e-6, 68e-6]))
    scene = occ.load_preset("phone-68us").replace(
        rows=320, columns=512, readout_time=readout, averaging="light",
        exposure_time=float(10 ** random.uniform(-4.6, -3.0)), iso=float(random.choice([50, 200])),
        jpeg_quality=int(random.choice([0, 80])), point_spread=float(random.choice([0.0, 2.0])),
    )  # fmt: skip
    lights = [
        {"code": int(random.integers(1024)), "switching_frequency": 0.15 / readout}
        if random.random() < 0.2
        else _lamp(float(10 ** random.uniform(2.3, 4.4)), float(random.uniform(0.05, 0.95)),
                   depth=float(random.choice([1.0, 0.5])))
        for _ in range(4)
    ]  # fmt: skip
    lamps = tuple(
        RoomLamp(
            name=f"L{n}", x=1.4 * (n % 2) - 0.7, y=1.2 * (n // 2) - 0.5, z=2.2,
            start_time=float(random.uniform(0.0, 0.01)), roll=float(random.uniform(-0.4, 0.4)),
            transmitter=scene.transmitter.replace(panel_width=0.8, panel_height=0.8, **light),
        )
        for n, light in enumerate(lights)
    )  # fmt: skip
    return Room(lamps=lamps, scene=scene, camera=Place(roll=float(random.uniform(-0.2, 0.2))))


def test_no_lamp_of_a_random_room_has_a_wrong_name_or_error() -> None:
    named, shown, deviations = 0, 0, []
    for seed in range(amount(12, 100)):
        room = _random_room(seed)
        frame = occ.render_room(room, seed=seed)
        places = {one.lamp.name: one.region for one in frame.lamps}
        shown += len(places)
        for read in occ.read_room(frame.camera_image, room).lamps:
            if not read.name:
                continue
            named += 1
            (column, row), there = read.hull.mean(axis=0), places[read.name]
            assert there.first_column - 5 <= column <= there.last_column + 5, (seed, read.name)
            assert there.first_row - 5 <= row <= there.last_row + 5, (seed, read.name)
            sent = next(lamp for lamp in room.lamps if lamp.name == read.name).transmitter
            if sent.light == "lamp" and read.frequency:
                cycles = sent.lamp_frequency * room.scene.camera.readout_time
                true = abs(cycles - round(cycles)) / room.scene.camera.readout_time
                deviations.append((read.frequency.value - true) / read.frequency.error)
    assert named > shown / 3
    assert 0.3 < np.sqrt(np.mean(np.square(deviations))) < 1.5


def test_a_map_counts_lamps_named_by_frequency() -> None:
    request = RoomMapRequest(_room(_lamp(700.0), _lamp(500.0)), (0.6,), (0.0,))
    (point,) = room_map(request)
    assert (point.whole, point.named, point.misread, point.named_wrongly) == (2, 2, 0, 0)
