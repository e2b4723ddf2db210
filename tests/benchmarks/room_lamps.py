"""What sixteen lamps cost in one picture, over one lamp of the same lit pixels.

Both are simulated in turn, the camera a little elsewhere each time, so that nothing is remembered:
run ``python tests/benchmarks/room_lamps.py``.
"""

import argparse
from collections.abc import Callable
from statistics import median
from time import process_time

import occ_model as occ
from occ_model.results.plan import Plan
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


def _timed(work: Callable[[], Plan]) -> tuple[float, Plan]:
    start = process_time()
    made = work()
    return process_time() - start, made


def main() -> None:
    """Print the ratio of each preset."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--presets", nargs="+", default=["phone-136us", "phone-136us-real"])
    options = parser.parse_args()
    for preset in options.presets:
        for turn in (0.0, 0.1):
            rooms = [lamps_of(preset, side) for side in (1, _SIDE)]
            every = {name: True for name in occ.plan(rooms[0].scene, 0.0).included}
            for label, force in (("planned", {}), ("all effects", every)):
                pairs = []
                for n in range(options.rounds + 1):
                    camera = Place(x=1e-3 * n, yaw=turn, roll=2.0 * turn)
                    pairs.append([
                        _timed(
                            lambda room=room.replace(camera=camera): occ.render_room(
                                room, seed=n, force=force
                            ).plan
                        )
                        for room in rooms
                    ])  # fmt: skip
                (one, plan), (many, other) = pairs[0]
                one, many = (median(pair[k][0] for pair in pairs[1:]) for k in (0, 1))
                ratio = median(pair[1][0] / pair[0][0] for pair in pairs[1:])
                more = set(other.included) ^ set(plan.included)
                print(f"{preset}, turned by {turn:g}, {label}: {1e3 * one:.0f} ms, {1e3 * many:.0f} "
                      f"ms, {ratio:.2f} times; effects of only one: {', '.join(more) or 'none'}")  # fmt: skip


if __name__ == "__main__":
    main()
