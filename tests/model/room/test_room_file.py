"""Room files are read as they were written, and mistakes give a sentence."""

import pytest
from each_case import each_case

import occ_model as occ
from occ_model.room.room import Room, RoomLamp
from occ_model.room.rooms import load_room, rooms

LAMP = "format = 1\nlamps = [{name = 'a', code = 3}]\n"


@pytest.mark.parametrize("name", rooms())
def test_a_room_is_read_as_it_was_written(name: str) -> None:
    room = load_room(name)
    assert Room.from_toml(room.to_toml()) == room
    assert len({lamp.transmitter.code for lamp in room.lamps}) == len(room.lamps)
    turned = Room(lamps=room.lamps, scene=room.scene.replace(yaw=0.3, distance=2.0))
    assert Room.from_toml(turned.to_toml()) == turned


def test_a_scenes_pose_is_not_part_of_a_room() -> None:
    room = Room.of_scene(occ.load_preset("phone-136us").replace(distance=2.5, yaw=0.3))
    assert Room.from_toml(room.to_toml()) == room
    moved = room.replace(x=1.0, roll=0.2)
    assert Room.from_toml(moved.to_toml()) == moved
    with pytest.raises(occ.ParameterError, match="A room has no distance"):
        room.replace(distance=2.0)


@each_case(
    [
        ("format = 1", "list of lamps"),
        ("format = 1\nlamps = []", "0 lamps; allowed: 1 to 200"),
        (LAMP + "[pose]\nyaw = 0", r"no table \[pose\]"),
        (LAMP + "[place]\nheight = 1.0", "known are x, y, z"),
        (LAMP + "[place]\nz = 2e4", "z is 20 km; allowed: -1 km to 1 km"),
        ("format = 1\nlamps = [{code = 3}]", "Lamp 1 has no name"),
        ("format = 1\nlamps = [{name = 'a', code = 9999}]", r"Lamp 1 \(a\): code is 9999"),
        ("format = 1\nlamps = [{name = 'a', shape = 'star'}]", "Lamp a: shape is 'star'"),
        ("format = 1\nlamps = [{name = 'a', z = 'high'}]", "Lamp a: z is 'high'"),
        ("format = 1\nlamps = [{name = 'a'}, {name = 'a'}]", "Two lamps have the name a"),
        ("format = 1\nlamps = 7", "list of lamps"),
        ("format = 1\nbased_on = 7\nlamps = [{name = 'a'}]", "no preset 7"),
    ]
)
def test_a_mistake_in_a_room_file_gives_a_sentence(text: str, words: str) -> None:
    with pytest.raises(occ.OccError, match=words):
        Room.from_toml(text)


def test_a_room_has_at_most_200_lamps() -> None:
    lamps = [RoomLamp(name=str(n)) for n in range(201)]
    with pytest.raises(occ.ParameterError, match="201 lamps"):
        Room(lamps=tuple(lamps))


@pytest.mark.parametrize(
    "rest", ["", ", code = 9999", ", x = 'far'", ", shape = 'star'", ", y = 1e9"]
)
def test_the_sentence_is_short_for_a_name_of_any_length(rest: str) -> None:
    for name in ("n" * 5000, "two\\nlines"):
        with pytest.raises((occ.SceneFileError, occ.ParameterError)) as refused:
            Room.from_toml(f'format = 1\nlamps = [{{name = "{name}"{rest}}}]')
        assert len(str(refused.value)) < 400
        assert str(refused.value).isprintable()


def test_an_unknown_room_is_refused_with_the_known_names() -> None:
    with pytest.raises(occ.PresetError, match="corridor, hall, office"):
        load_room("cellar")
