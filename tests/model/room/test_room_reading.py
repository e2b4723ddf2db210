"""Lamps are named by their codes, and the camera's place is found within its stated error."""

import dataclasses
import math

import numpy as np
import pytest
from amount import amount
from small_rooms import small_room

import occ_model as occ
from occ_model.room.edge_lines import Edge
from occ_model.room.locate import RoomReading, select_places
from occ_model.room.pose_fit import Located, OutlineEdges
from occ_model.room.room import Place, Room
from occ_model.room.view import lamp_scene
from occ_model.study.room_map import RoomMapRequest, room_map


def _room(seed: int, lamps: int) -> Room:
    """Return lamps in a square, seen from about below its middle, and a camera turned at random."""
    random = np.random.default_rng(seed)
    across = math.ceil(math.sqrt(lamps))
    middle = 0.6 * (across - 1)
    x, y, z, yaw, pitch, roll = random.uniform(
        (-0.2, -0.2, -0.4, -0.2, -0.2, -3.0), (0.2, 0.2, 0.2, 0.2, 0.2, 3.0)
    ).tolist()
    camera = Place(x=middle + x, y=middle + y, z=z, yaw=yaw, pitch=pitch, roll=roll)
    return small_room(lamps, across=across, camera=camera, rows=1024)


def _off(place: Place, true: Place) -> np.ndarray:
    return np.array(dataclasses.astuple(place)) - np.array(dataclasses.astuple(true))


@pytest.mark.parametrize("seed", [2, pytest.param(3, marks=pytest.mark.whole)])
def test_the_place_is_within_its_stated_error_and_no_lamp_is_misnamed(seed: int) -> None:
    room = _room(seed, 9)
    frame = occ.render_room(room, seed=seed)
    reading = occ.read_room(frame.camera_image, room)
    shown = {one.lamp.name: one.region for one in frame.lamps}
    named = [lamp for lamp in reading.lamps if lamp.name]
    assert len(named) >= 2
    for lamp in named:
        assert lamp.name is not None
        true = shown[lamp.name]
        assert abs(lamp.region.first_row - true.first_row) < 20
        assert abs(lamp.region.last_row - true.last_row) < 20
    assert reading.is_sure, reading.reasons
    deviation = _off(reading.located.place, room.camera) / reading.located.errors
    assert np.abs(deviation).max() < 4.5
    assert reading.located.errors[:2].max() < 0.02


def _at(room: str, place: str, **settings: float) -> Room:
    x, y, z, yaw, pitch, roll = map(float, place.split())
    angles = dict(zip(("yaw", "pitch", "roll"), np.radians([yaw, pitch, roll]), strict=True))
    return occ.load_room(room).with_sent(**settings).replace(x=x, y=y, z=z, **angles)


SMALL = {"rows": 1536, "columns": 1152, "readout_time": 24e-6}
BLURRED = {"point_spread": 5.0, "read_noise": 20.0, "gain_variation": 0.02, "edge_time": 10e-6}
BENT = {
    "inverse": _at(
        "office", "1.932 -1.386 1.556 9.80 -18.39 -82.96", **SMALL, exposure_time=40e-6,
        iso=1600, equivalent_focal_length=0.015, radial_k1=0.4,
    ),
    "sides": _at(
        "hall", "11.519 -6.646 0.725 -14.84 -22.23 -122.9", rows=2304, columns=1728,
        readout_time=16e-6, exposure_time=40e-6, equivalent_focal_length=0.015, radial_k1=0.1,
    ),
    "blur": _at(
        "hall", "1.4872 -6.6133 1.2369 -15.371 22.412 68.749", **SMALL, exposure_time=100e-6,
        iso=400, radial_k1=0.03, **BLURRED,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BENT)
def test_the_place_behind_a_distorting_and_blurring_lens_is_within_its_stated_error(
    name: str,
) -> None:
    room = BENT[name]
    reading = occ.read_room(occ.render_room(room).camera_image, room)
    assert reading.is_sure, reading.reasons
    assert (np.abs(_off(reading.located.place, room.camera)) < 4.5 * reading.located.errors).all()
    assert reading.located.errors[:3].max() < 0.03


@pytest.mark.parametrize("enhancement", ["equalization", "stretch"])
@pytest.mark.parametrize("blur", [0.0, 2.5])
def test_both_pictures_of_a_frame_give_the_same_place(enhancement: str, blur: float) -> None:
    room = _room(2, 9).replace(enhancement=enhancement, point_spread=blur, radial_k1=0.05)
    frame = occ.render_room(room, seed=2)
    found = []
    for image in (frame.camera_image, frame.image):
        reading = occ.read_room(image, room)
        assert reading.is_sure, reading.reasons
        off = _off(reading.located.place, room.camera)
        assert (np.abs(off) < 4.5 * reading.located.errors).all()
        assert reading.located.errors[:2].max() < 0.03
        found.append(reading.located)
    assert (frame.camera_image != frame.image).any()
    apart = np.abs(_off(found[0].place, found[1].place))
    assert (apart < 4.0 * np.maximum(found[0].errors, found[1].errors)).all()


def _exact(room: Room, wanted: dict[str, tuple[int, ...]], error: float = 0.05) -> OutlineEdges:
    """Return some sides of lamps as exactly measured edges."""
    measured = []
    for lamp in room.lamps:
        corners = occ.panel_corners(lamp_scene(room, lamp))
        sides = [(corners[side], corners[(side + 1) % 4]) for side in wanted.get(lamp.name, ())]
        measured.append((lamp, [Edge(np.array(ends), error**2 * np.eye(2)) for ends in sides]))
    return OutlineEdges.of(measured, room, 0.0)


def test_an_edge_is_assigned_to_a_side_that_has_the_lamp_on_the_same_side() -> None:
    room = small_room(2, turned=0.0, camera=Place(x=0.4, z=0.0, roll=0.3))
    edges = _exact(room, {"L0": (0, 1, 3), "L1": (1, 3)})
    # Seen from a place displaced by the lamp's height, the first side is where the third is
    # expected.
    start = np.array([0.4, 0.7, 0.0, 0.0, 0.0, 0.3])
    located, _ = edges.fit(start)
    assert located.place.y == pytest.approx(0.0, abs=1e-6)
    assert located.deviations == pytest.approx(0.0, abs=1e-6)


def test_errors_too_large_for_a_linear_law_are_reported() -> None:
    room = small_room(2, turned=0.0, camera=Place(x=0.4, z=0.0, roll=0.3))
    start = np.array([0.4, 0.0, 0.0, 0.0, 0.0, 0.3])
    sides = {"L0": (0, 2, 3), "L1": (0, 2)}
    assert _exact(room, sides).fit(start)[0].is_linear
    assert not _exact(room, sides, error=5.0).fit(start)[0].is_linear


def test_the_rooms_own_transmitter_has_no_influence() -> None:
    room = small_room(framing="preamble", preamble="11110000111100110")
    image = occ.render_room(room, seed=1).camera_image
    other = dataclasses.replace(room, scene=room.scene.replace(framing="paper", preamble=""))
    found, again = occ.read_room(image, room), occ.read_room(image, other)
    assert found.is_sure
    assert found.located.place == again.located.place
    assert found.located.deviations == again.located.deviations


def test_a_picture_is_read_equally_in_any_pixel_type() -> None:
    room = small_room()
    image = occ.render_room(room, seed=1).camera_image
    found = occ.read_room(image, room)
    for pixels in (image / 255.0, image.astype(np.float32), (image * np.uint16(257)).astype(">u2")):
        assert occ.read_room(pixels, room).located.place == found.located.place
    with pytest.raises(occ.DecodeInputError, match="from 0 to 25500; allowed in floating point"):
        occ.read_room(np.where(image == image.max(), 25500.0, 0.0), room)


def test_a_lamp_that_sends_a_payload_is_named_by_its_bits() -> None:
    room = small_room(2)
    sent = ("bits:0100100001", "bits:1110001010")
    lamps = [dataclasses.replace(lamp, transmitter=lamp.transmitter.replace(payload=payload))
             for lamp, payload in zip(room.lamps, sent, strict=True)]  # fmt: skip
    room = dataclasses.replace(room, lamps=tuple(lamps))
    reading = occ.read_room(occ.render_room(room, seed=1).camera_image, room)
    assert {lamp.name: lamp.code for lamp in reading.lamps} == {
        "L0": 0b0100100001,
        "L1": 0b1110001010,
    }
    (point,) = room_map(RoomMapRequest(room, (0.6,), (0.0,)))
    assert (point.whole, point.named, point.misread) == (2, 2, 0)


def test_a_lamp_with_long_dark_runs_is_found_as_one() -> None:
    room = small_room(
        2, line_code="fsk", framing="preamble", bits=8, code=0, switching_frequency=12e3,
        columns=1536, rows=1024,
    )  # fmt: skip
    # There are ten dark chips between two lit ones.
    sent = [lamp.transmitter.replace(bits=8, code=code)
            for lamp, code in zip(room.lamps, (192, 240), strict=True)]  # fmt: skip
    lamps = [dataclasses.replace(lamp, transmitter=own)
             for lamp, own in zip(room.lamps, sent, strict=True)]  # fmt: skip
    room = dataclasses.replace(room, lamps=tuple(lamps))
    reading = occ.read_room(occ.render_room(room, seed=1).camera_image, room)
    assert [lamp.name for lamp in reading.lamps] == ["L0", "L1"]


# In the last case a single column of the next lit chip is in the picture.
@pytest.mark.parametrize("chips", [*range(0, 24, amount(12, 2)), 10 / 7])
def test_a_lamp_cut_at_dark_chips_is_reported_as_cut(chips: float) -> None:
    room = small_room(1, camera=Place(z=-0.56764158), rows=1024, switching_frequency=4e3)
    sent = room.lamps[0].transmitter.replace(panel_width=1.3)
    lamp = dataclasses.replace(room.lamps[0], start_time=chips / 4e3, transmitter=sent)
    # A chip has 7 columns, and a metre 243 columns.
    for shift, is_cut in ((0.0, False), (-0.83, False), (-1.1, True), (1.1, True)):
        here = room.replace(lamps=(dataclasses.replace(lamp, x=shift),))
        frame = occ.render_room(here)
        (read,) = occ.read_room(frame.camera_image, here).lamps
        assert frame.lamps[0].is_cut == is_cut
        assert read.name == "L0"
        assert read.is_cut == is_cut
        assert ("picture's edge" in read.note) == is_cut


def test_a_panel_that_looks_the_same_from_several_places_is_reported() -> None:
    room = _room(5, 1).replace(yaw=0.3, pitch=0.2, z=0.3)
    reading = occ.read_room(occ.render_room(room).camera_image, room)
    assert reading.lamps[0].name == "L0"
    assert not reading.is_sure
    assert reading.reasons


def test_a_lamp_of_another_room_is_not_named() -> None:
    room = _room(1, 4)
    image = occ.render_room(room).camera_image
    others = tuple(
        dataclasses.replace(lamp, transmitter=lamp.transmitter.replace(code=900 + n))
        for n, lamp in enumerate(room.lamps)
    )
    reading = occ.read_room(image, room.replace(lamps=others))
    assert reading.located is None
    assert all(lamp.name is None and "No lamp of the room" in lamp.note for lamp in reading.lamps)
    assert reading.reasons


def test_lamps_that_send_the_same_code_are_not_named() -> None:
    room = _room(1, 4)
    image = occ.render_room(room).camera_image
    same = tuple(
        dataclasses.replace(lamp, transmitter=room.lamps[0].transmitter) for lamp in room.lamps
    )
    reading = occ.read_room(image, room.replace(lamps=same))
    assert all(lamp.name is None for lamp in reading.lamps)


def test_a_dark_picture_has_no_place_and_a_reason() -> None:
    room = _room(1, 4).replace(x=30.0)
    reading = occ.read_room(occ.render_room(room).camera_image, room)
    assert reading.located is None
    assert reading.reasons[0].startswith("No lamp was found")


def test_lamps_moved_in_the_file_give_no_place() -> None:
    room = _room(2, 9)
    image = occ.render_room(room).camera_image
    moved = tuple(dataclasses.replace(lamp, x=lamp.x * 1.3, y=lamp.y * 0.6) for lamp in room.lamps)
    reading = occ.read_room(image, room.replace(lamps=moved))
    assert reading.located is None
    assert "No place of the camera explains" in reading.reasons[0]


def test_a_picture_of_another_size_is_refused() -> None:
    with pytest.raises(occ.DecodeInputError, match="1024 rows and 768 columns"):
        occ.read_room(np.zeros((10, 10), dtype=np.uint8), _room(1, 1))


@pytest.mark.parametrize("lamps", [1, 2])
def test_a_place_from_a_single_lamp_is_not_sure(lamps: int) -> None:
    there = Located(Place(), np.eye(6), 1.0, 2)
    places, reasons = select_places([there], lamps)
    assert places == [there]
    assert RoomReading((), there, (), reasons).is_sure == (lamps > 1)
