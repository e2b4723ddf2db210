"""Maps over a floor count what pictures show; a stopped map is continued."""

import dataclasses
import math
from pathlib import Path

import pytest
from small_rooms import small_room

import occ_model as occ
from occ_model.cli import main
from occ_model.errors import quote
from occ_model.room.room import Place
from occ_model.study import room_map as study
from occ_model.study.room_map import RoomMapRequest, RoomMapText, RoomPoint, places_under, room_map


def test_a_place_counts_what_its_picture_shows_which_is_nothing_far_away() -> None:
    request = RoomMapRequest(small_room(), (0.6, 40.0), (0.6,), images=2)
    near, far = room_map(request)
    assert near.whole == 8
    assert near.named == 8
    assert near.named_wrongly == 0
    assert near.sure_places == 2
    assert near.error < 6.0 * near.stated_error < 0.2
    assert (far.whole, far.named, far.sure_places) == (0, 0, 0)
    assert math.isnan(far.error)
    assert far.note.startswith("No lamp was found")


def test_a_lamp_given_another_ones_name_is_counted_as_wrong(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    room = small_room()
    swapped = room.replace(lamps=(*room.lamps[2:], *room.lamps[:2]))
    codes = [lamp.transmitter for lamp in swapped.lamps]
    other = room.replace(
        lamps=tuple(
            dataclasses.replace(lamp, transmitter=sent)
            for lamp, sent in zip(room.lamps, codes, strict=True)
        )
    )
    monkeypatch.setattr(study, "read_room", lambda image, _room: occ.read_room(image, other))
    (point,) = room_map(RoomMapRequest(room, (0.6,), (0.6,)))
    assert (point.whole, point.named, point.misread, point.named_wrongly) == (4, 0, 0, 4)


def test_cut_lamps_do_not_count_as_whole_lamps_named() -> None:
    (point,) = room_map(
        RoomMapRequest(small_room().replace(x=0.6, y=0.6), (1.25,), (0.6,), images=2)
    )
    frame = occ.render_room(small_room().replace(x=1.25, y=0.6))
    read = occ.read_room(frame.camera_image, frame.room)
    whole = sum(not one.is_cut for one in frame.lamps)
    assert sum(lamp.name is not None for lamp in read.lamps) > whole
    assert point.named <= point.whole == 2 * whole


def test_a_code_that_no_lamp_at_the_place_sends_is_counted_as_misread(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    room = small_room(1)
    other = room.with_sent(code=700)
    frame = occ.render_room(other)
    monkeypatch.setattr(
        study,
        "render_room",
        lambda *_, **__: dataclasses.replace(frame, lamps=occ.render_room(room).lamps),
    )
    (point,) = room_map(RoomMapRequest(room, (0.6,), (0.6,)))
    assert (point.whole, point.named, point.misread, point.named_wrongly) == (1, 0, 1, 0)


def test_a_killed_map_is_continued_with_the_same_result(tmp_path: Path) -> None:
    request = RoomMapRequest(small_room(1), (0.0, 0.6), (0.0, 0.3))
    path = tmp_path / "map.csv"
    whole = room_map(request, results=path)
    text = path.read_bytes()
    rows = text.splitlines(keepends=True)
    path.write_bytes(b"".join(rows[:-2]) + rows[-2][:7])
    done: list[int] = []
    again = room_map(request, results=path, progress=lambda here, *_: done.append(here))
    assert path.read_bytes() == text
    assert RoomMapText(request).text(whole[3]) == RoomMapText(request).text(again[3])
    assert done[0] == 2
    path.write_bytes(text.replace(b"seed 1", b"seed 2"))
    with pytest.raises(occ.OutputError, match="another map of a room"):
        room_map(request, results=path)


@pytest.mark.parametrize(
    ("cell", "value", "said"),
    [
        (3, "-1", "whole lamps is '-1'; allowed: 0 to 2."),
        (3, "9" * 400, f"whole lamps is {quote('9' * 400)}; allowed: 0 to 2."),
        (4, "3", "named correctly is '3'; allowed: 0 to 2."),
        (5, "nan", f"misread is 'nan'; allowed: 0 to {2 * 240 * 320}."),
        (6, "5", "named wrongly is '5'; allowed: 0 to 2."),
        (7, "1", "error (m) is ''; allowed: numbers from 0 m."),
        (7, "3", "sure places is '3'; allowed: 0 to 2."),
        (8, "0.5", "error (m) is '0.5'; allowed: nothing, without a sure place."),
    ],
)
def test_impossible_counts_of_a_map_are_refused_with_line_and_value(
    tmp_path: Path, cell: int, value: str, said: str
) -> None:
    room = small_room(1, rows=240, columns=320)
    request = RoomMapRequest(room, (0.0,), (0.0,), images=2)
    text, path = RoomMapText(request), tmp_path / "map.csv"
    row = text.text(RoomPoint(0, 2, 2, 0, 0, 0, math.nan, math.nan, "No place.")).split(",")
    row[cell] = value
    path.write_text(text.header + ",".join(row))
    line = text.header.count("\n") + 1
    with pytest.raises(occ.OutputError) as refused:
        room_map(request, results=path)
    assert str(refused.value).startswith(f"{path}, line {line}: ")
    assert str(refused.value).endswith(f"{said} Correct or remove the line, or name another file.")


def test_the_command_measures_a_room_file_with_other_settings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    room = tmp_path / "small.toml"
    room.write_text(small_room(1).to_toml())
    out = tmp_path / "map.csv"
    words = ("room", "map", "--room", str(room), "--side", "1", "--images", "2", "--out", str(out))
    assert main((*words, "--set", "switching_frequency=7kHz", "--set", "bits=12")) == 0
    assert "1 place, 2 pictures: 2 of 2 whole lamps named, 0 lamps named wrongly" in (
        capsys.readouterr().out
    )
    assert "switching_frequency = 7000.0" in out.read_text()
    assert main(words) == 2
    assert "another map of a room" in capsys.readouterr().err


def test_the_places_are_under_the_lamps() -> None:
    assert places_under(small_room(), 3) == ((0.0, 0.6, 1.2), (0.0, 0.6, 1.2))
    assert places_under(small_room(1), 3) == ((0.0,), (0.0,))


def test_a_single_place_is_in_the_middle_of_the_floor() -> None:
    assert places_under(small_room(), 1) == ((0.6,), (0.6,))


def test_a_tolerance_is_refused_in_the_same_words_as_elsewhere() -> None:
    with pytest.raises(occ.ParameterError, match=r"tolerance is nan levels; allowed: from 0"):
        RoomMapRequest(small_room(1), (0.0,), (0.0,), tolerance=math.nan)


def test_a_place_without_a_picture_has_no_whole_lamp() -> None:
    room = small_room(2, turned=0.0, camera=Place(z=2.3, pitch=0.9))
    (point,) = room_map(RoomMapRequest(room, (0.6,), (0.0,)))
    assert "partly behind the camera" in point.note
    assert point.whole == 0
