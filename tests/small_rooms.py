"""Rooms of a few panels, and a camera of few pixels."""

from typing import Any

import occ_model as occ
from occ_model.room.room import Place, Room, RoomLamp


def small_room(
    panels: int = 4,
    *,
    across: int = 2,
    apart: float = 1.2,
    turned: float = 0.1,
    camera: Place = Place(z=-0.2, roll=0.4),  # noqa: B008 - a value that never changes
    **settings: Any,
) -> Room:
    """Return panels in rows, each turned a little more, with settings of the camera."""
    scene = occ.load_preset("phone-68us").replace(**{
        "rows": 512, "columns": 768, "readout_time": 36e-6, "exposure_time": 60e-6,
        "averaging": "light", "switching_frequency": 8e3, **settings,
    })  # fmt: skip
    lamps = tuple(
        RoomLamp(
            name=f"L{n}", x=apart * (n % across), y=1.2 * (n // across), z=2.6, start_time=3e-4 * n,
            roll=turned * n,
            transmitter=scene.transmitter.replace(
                panel_width=0.8, panel_height=0.7, code=61 * n + 5
            ),
        )
        for n in range(panels)
    )  # fmt: skip
    return Room(lamps=lamps, scene=scene, camera=camera)
