"""How far places that pictures tell are from the true ones, in their stated errors.

Random places under 1 to 16 lamps, half of them with a real lens. The lamps' edges are also held
against a projection of this program's own (Rodrigues' formula): run
``python tests/benchmarks/room_poses.py --poses 500 --seed 7``.
"""

import argparse
import dataclasses
from collections.abc import Iterator

import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray
from occ_model.room.edges import EdgeFinder
from occ_model.room.locate import quadrilateral
from occ_model.room.reading import find_and_name
from occ_model.room.room import Place, Room, RoomLamp

NUMBERS = tuple(Place.__dataclass_fields__)


def random_room(random: np.random.Generator) -> Room:
    """Return a room of 1 to 16 lamps, and a camera below them that looks up, more or less."""
    preset = "phone-68us-real" if random.random() < 0.5 else "phone-68us"
    scene = occ.load_preset(preset).replace(
        rows=1024, columns=768, readout_time=36e-6, exposure_time=60e-6, averaging="light",
        switching_frequency=8e3, point_spread=0.6 if preset.endswith("real") else 0.0,
    )  # fmt: skip
    count = int(random.integers(1, 17))
    across = int(np.ceil(np.sqrt(count)))
    lamps = tuple(
        RoomLamp(
            name=f"L{n}", z=2.8, roll=float(random.uniform(-0.2, 0.2)),
            x=1.2 * (n % across - (across - 1) / 2), y=1.2 * (n // across - (across - 1) / 2),
            start_time=float(random.uniform(0.0, 3e-3)),
            transmitter=scene.transmitter.replaced(
                {"panel_width": 0.8, "panel_height": 0.7, "code": 61 * n + 5}
            ),
        )
        for n in range(count)
    )  # fmt: skip
    spread = 0.2 + 0.2 * across
    place = random.uniform(
        (-spread, -spread, -1.5, -0.25, -0.25, -3.0), (spread, spread, 0.4, 0.25, 0.25, 3.0)
    )
    camera = Place(**dict(zip(NUMBERS, place.tolist(), strict=True)))
    return Room(lamps=lamps, scene=scene, camera=camera)


def placed(name: str, random: np.random.Generator) -> Room:
    """Return a room of the program with its camera at a random place.

    In one of three it is hardly turned: lamps' edges are upright and level in the picture.
    """
    turn = 0.03 if random.random() < 1.0 / 3.0 else 3.0
    place = random.uniform((-1, -1, 0, -0.15, -0.15, -turn), (1, 1, 1, 0.15, 0.15, turn))
    return occ.load_room(name).replace(**dict(zip(NUMBERS, place.tolist(), strict=True)))


def projected(room: Room, lamp: RoomLamp) -> FloatArray:
    """Return where a lens without distortion shows a lamp's corners, (column, row)."""
    width, height = lamp.size
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    corners *= [width / 2, height / 2, 0]
    x, y, z = np.eye(3)
    for axis, angle in ((x, lamp.pitch), (y, lamp.yaw), (z, lamp.roll)):
        corners = _about(axis, angle, corners)
    corners += np.array([lamp.x, lamp.y, lamp.z]) - [room.camera.x, room.camera.y, room.camera.z]
    for axis, angle in ((z, room.camera.roll), (y, room.camera.yaw), (x, room.camera.pitch)):
        corners = _about(axis, -angle, corners)
    camera = room.scene.camera
    middle = [(camera.columns - 1) / 2, (camera.rows - 1) / 2]
    return np.asarray(corners[:, :2] / corners[:, 2:] * camera.focal_length_pixels + middle)


def _about(axis: FloatArray, angle: float, points: FloatArray) -> FloatArray:
    across = np.cross(axis, points)
    along = np.outer(points @ axis, axis)
    return np.asarray(points * np.cos(angle) + across * np.sin(angle) + along * (1 - np.cos(angle)))


def edges_off(room: Room, image: ByteArray) -> Iterator[tuple[bool, float, float]]:
    """Yield of each measured edge's points whether it is upright, how far off, and the error."""
    finder = EdgeFinder(image, room)
    lamps = {lamp.name: lamp for lamp in room.lamps}
    for read in find_and_name(image, room):
        lamp = lamps.get(read.name or "")
        if lamp is None:
            continue
        corners = projected(room, lamp)
        starts, ends = corners, np.roll(corners, -1, axis=0)
        along = (ends - starts) / np.hypot(*(ends - starts).T)[:, None]
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        for edge in finder.edges(lamp, quadrilateral(read.hull)):
            off = np.einsum("psk,sk->ps", edge.points[:, None] - starts, across)
            own = off[:, int(np.abs(off).max(axis=0).argmin())]
            upright = bool(abs(edge.normal[0]) > abs(edge.normal[1]))
            yield upright, float(own.mean()), float(np.sqrt(edge.covariance.mean()))


def fractions(deviations: FloatArray) -> str:
    """Say what lies within one and two stated errors, and how far the farthest is."""
    size = np.abs(deviations)
    return (
        f"{100.0 * (size < 1).mean():.1f} % within 1, {100.0 * (size < 2).mean():.1f} % within 2, "
        f"farthest {size.max():.1f}, of {len(size)}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--poses", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--room", help="a room of the program; default: random ones")
    parser.add_argument("--edges", action="store_true", help="hold each edge against the truth")
    options = parser.parse_args()
    deviations: list[list[float]] = []
    off: list[tuple[bool, float, float]] = []
    named = wrong = located = 0
    for number in range(options.poses):
        random = np.random.default_rng([options.seed, number])
        room = placed(options.room, random) if options.room else random_room(random)
        frame = occ.render_room(room, seed=number)
        reading = occ.read_room(frame.camera_image, room)
        lamps = {lamp.name: lamp for lamp in room.lamps}
        for read in reading.lamps:
            if read.name:
                named += 1
                middle = projected(room, lamps[read.name]).mean(axis=0)
                wrong += bool(
                    np.abs(read.hull.mean(axis=0) - middle).max() > 120 and not read.is_cut
                )
        located += reading.located is not None
        if reading.is_sure and reading.located is not None:
            true = np.array(dataclasses.astuple(room.camera))
            found = np.array(dataclasses.astuple(reading.located.place))
            apart = found - true
            apart[3:] = (apart[3:] + np.pi) % (2.0 * np.pi) - np.pi
            deviations.append((apart / reading.located.errors).tolist())
        if options.edges:
            off += edges_off(room, frame.camera_image)
    print(f"{options.poses} places, {located} found, {len(deviations)} sure; {wrong} of {named} "
          "lamps named wrongly")  # fmt: skip
    if deviations:
        print(f"places: {fractions(np.array(deviations).ravel())}")
    for upright in (False, True) if options.edges else ():
        some = np.array([each[1:] for each in off if each[0] is upright])
        print(f"{'upright' if upright else 'level'} edges: {fractions(some[:, 0] / some[:, 1])}; "
              f"median off {np.median(np.abs(some[:, 0])):.3f} px, "
              f"stated {np.median(some[:, 1]):.3f}")  # fmt: skip


if __name__ == "__main__":
    main()
