"""How far places that pictures tell are from the true ones, in their stated errors.

Random places under 1 to 16 lamps, half of them with a real lens; or in the program's rooms, behind
lenses that bend and blur, with more noise and white lamps among them:
``python tests/benchmarks/room_poses.py --poses 500 --seed 7 --lenses``. With ``--edges`` the lamps'
edges are also held against a projection of this program's own (Rodrigues' formula).
"""

import argparse
import dataclasses
from collections.abc import Iterator

import numpy as np

import occ_model as occ
from occ_model.arrays import ByteArray, FloatArray
from occ_model.effects.distortion import undistort
from occ_model.room.edges import find_edges
from occ_model.room.locate import fit_quadrilateral
from occ_model.room.reading import read_lamps
from occ_model.room.room import Place, Room, RoomLamp
from occ_model.room.view import lamps_in_view

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
            transmitter=scene.transmitter.replace(
                panel_width=0.8, panel_height=0.7, code=61 * n + 5
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


_SIZES = ((1536, 1152, 24e-6), (2304, 1728, 16e-6))  # rows, columns, readout time of a column


def behind_lens(random: np.random.Generator, radial_k1: float | None = None) -> Room:
    """Return a room of the program behind a lens that bends and blurs, at a random place.

    Lenses that fold the picture, and places that no picture is simulated from, are drawn again.
    ``radial_k1`` takes the place of the one drawn.
    """
    while True:
        room = occ.load_room(str(random.choice(occ.rooms())))
        x, y = (np.array([getattr(lamp, axis) for lamp in room.lamps]) for axis in "xy")
        low = (x.min() - 0.5, y.min() - 0.5, 0.0, -0.45, -0.45, -np.pi)
        high = (x.max() + 0.5, y.max() + 0.5, 1.6, 0.45, 0.45, np.pi)
        place = random.uniform(low, high)
        rows, columns, readout = _SIZES[random.integers(len(_SIZES))]
        is_blurred, is_noisy = random.random(2) < 0.5
        room = room.with_sent(
            rows=rows, columns=columns, readout_time=readout,
            exposure_time=float(random.choice([40e-6, 60e-6, 100e-6])),
            iso=float(random.choice([400, 800, 1600])),
            equivalent_focal_length=float(random.uniform(0.013, 0.035)),
            radial_k1=float(random.uniform(-0.1, 0.4)),
            point_spread=float(random.uniform(0.3, 5.0)) if is_blurred else 0.0,
            read_noise=float(random.uniform(2.0, 20.0)) if is_noisy else 2.0,
            gain_variation=0.02 if is_noisy else 0.008, edge_time=10e-6 if is_noisy else 0.0,
        ).replace(**dict(zip(NUMBERS, place.tolist(), strict=True)))  # fmt: skip
        try:
            lamps_in_view(room)
        except occ.ProjectionError:
            continue
        return room if radial_k1 is None else room.replace(radial_k1=radial_k1)


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
    lamps = {lamp.name: lamp for lamp in room.lamps}
    for read in read_lamps(image, room):
        lamp = lamps.get(read.name or "")
        if lamp is None or lamp.shape != "rectangle":
            continue
        corners = projected(room, lamp)
        starts, ends = corners, np.roll(corners, -1, axis=0)
        along = (ends - starts) / np.hypot(*(ends - starts).T)[:, None]
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        for edge in find_edges(
            image, room, lamp, fit_quadrilateral(undistort(read.hull, room.scene))
        ):
            off = np.einsum("psk,sk->ps", edge.points[:, None] - starts, across)
            own = off[:, int(np.abs(off).max(axis=0).argmin())]
            upright = bool(abs(edge.normal[0]) > abs(edge.normal[1]))
            yield upright, float(own.mean()), float(np.sqrt(edge.covariance.mean()))


def fractions(deviations: FloatArray) -> str:
    """Say what lies within one, two and 4.5 stated errors, and how far the farthest is."""
    size = np.abs(deviations)
    return (
        f"{100.0 * (size < 1).mean():.1f} % within 1, {100.0 * (size < 2).mean():.1f} % within 2, "
        f"{100.0 * (size < 4.5).mean():.2f} % within 4.5, farthest {size.max():.1f}, of {len(size)}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--poses", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--room", help="a room of the program; default: random ones")
    parser.add_argument("--lenses", action="store_true", help="behind lenses that bend and blur")
    parser.add_argument("--k1", type=float, help="of all these lenses; default: random ones")
    parser.add_argument("--enhanced", action="store_true", help="read the receiver's picture")
    parser.add_argument("--edges", action="store_true", help="hold each edge against the truth")
    options = parser.parse_args()
    deviations: list[list[float]] = []
    off: list[tuple[bool, float, float]] = []
    named = wrong = located = 0
    for number in range(options.poses):
        random = np.random.default_rng([options.seed, number])
        if options.lenses:
            room = behind_lens(random, options.k1)
        else:
            room = placed(options.room, random) if options.room else random_room(random)
        frame = occ.render_room(room, seed=number)
        image = frame.image if options.enhanced else frame.camera_image
        reading = occ.read_room(image, room)
        lamps = {lamp.name: lamp for lamp in room.lamps}
        for read in reading.lamps:
            if read.name:
                named += 1
                middle = projected(room, lamps[read.name]).mean(axis=0)
                seen = undistort(read.hull, room.scene).mean(axis=0)
                wrong += bool(np.abs(seen - middle).max() > 120 and not read.is_cut)
        located += reading.located is not None
        if reading.is_sure and reading.located is not None:
            true = np.array(dataclasses.astuple(room.camera))
            found = np.array(dataclasses.astuple(reading.located.place))
            apart = found - true
            apart[3:] = (apart[3:] + np.pi) % (2.0 * np.pi) - np.pi
            deviations.append((apart / reading.located.errors).tolist())
        if options.edges:
            off += edges_off(room, image)
    print(f"{options.poses} places, {located} found, {len(deviations)} sure; {wrong} of {named} "
          "lamps named wrongly")  # fmt: skip
    if deviations:
        found = np.array(deviations)
        print(f"coordinates and angles: {fractions(found.ravel())}")
        print(f"the largest of each place's six: {fractions(np.abs(found).max(axis=1))}")
    for upright in (False, True) if options.edges else ():
        some = np.array([each[1:] for each in off if each[0] is upright])
        print(f"{'upright' if upright else 'level'} edges: {fractions(some[:, 0] / some[:, 1])}; "
              f"median off {np.median(np.abs(some[:, 0])):.3f} px, "
              f"stated {np.median(some[:, 1]):.3f}")  # fmt: skip


if __name__ == "__main__":
    main()
