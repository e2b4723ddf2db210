"""What sixteen lamps cost in one picture, over one lamp of the same lit pixels.

Both are simulated in turn, the camera a little elsewhere each time, so that nothing is remembered:
run ``python tests/benchmarks/room_lamps.py``.
"""

import argparse
from statistics import median
from time import process_time

import occ_model as occ
from occ_model.room.room import Place, Room, RoomLamp

_SIDE, _GAP = 4, 0.08


def lamps_of(preset: str, side: int) -> Room:
    """Return side x side lamps that are as large together as one of 0.8 m x 0.8 m at 1.5 m."""
    scene = occ.load_preset(preset)
    size = 0.8 / side
    sent = scene.transmitter.replaced({"panel_width": size, "panel_height": size})
    lamps = tuple(
        RoomLamp(
            name=f"L{n}", z=1.5, start_time=1e-4 * n, transmitter=sent.replaced({"code": 37 + n}),
            x=(size + _GAP) * (n % side - (side - 1) / 2),
            y=(size + _GAP) * (n // side - (side - 1) / 2),
        )
        for n in range(side * side)
    )  # fmt: skip
    return Room(lamps=lamps, scene=scene)


def _timed(room: Room, seed: int, force: dict[str, bool]) -> tuple[float, frozenset[str]]:
    start = process_time()
    made = occ.render_room(room, seed=seed, force=force)
    return process_time() - start, frozenset(made.plan.included)


def _compared(preset: str, turn: float, rounds: int, *, all_effects: bool) -> str:
    rooms = [lamps_of(preset, side) for side in (1, _SIDE)]
    every = occ.plan(rooms[0].scene, 0.0).included if all_effects else ()
    times: list[tuple[float, ...]] = []
    for n in range(rounds + 1):
        camera = Place(x=1e-3 * n, yaw=turn, roll=2.0 * turn)
        force = dict.fromkeys(every, True)
        made = [_timed(room.replace(camera=camera), n, force) for room in rooms]
        times.append(tuple(seconds for seconds, _ in made))
    one, many = (1e3 * median(column) for column in zip(*times[1:], strict=True))
    ratio = median(second / first for first, second in times[1:])
    unlike = ", ".join(made[0][1] ^ made[1][1]) or "none"
    return f"{one:.0f} ms, {many:.0f} ms, {ratio:.2f} times; effects of only one: {unlike}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--presets", nargs="+", default=["phone-136us", "phone-136us-real"])
    options = parser.parse_args()
    for preset in options.presets:
        for turn in (0.0, 0.1):
            for all_effects in (False, True):
                found = _compared(preset, turn, options.rounds, all_effects=all_effects)
                which = "all effects" if all_effects else "planned"
                print(f"{preset}, turned by {turn:g}, {which}: {found}", flush=True)


if __name__ == "__main__":
    main()
