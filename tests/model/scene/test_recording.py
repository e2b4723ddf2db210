"""A film's path: straight lines between waypoints, and rest before and after."""

import pytest

from occ_model.scene.recording import Recording, Waypoint

PATH = (
    Waypoint(1.0, distance=0.1, yaw=-0.2),
    Waypoint(3.0, distance=0.5, yaw=0.2),
    Waypoint(4.0, distance=0.0, yaw=0.2),
)


@pytest.mark.parametrize(
    ("time", "distance", "yaw"),
    [
        (-5.0, 0.1, -0.2), (0.999, 0.1, -0.2), (1.0, 0.1, -0.2),
        (1.5, 0.2, -0.1), (2.5, 0.4, 0.1),
        (3.0, 0.5, 0.2), (3.25, 0.375, 0.2), (4.0, 0.0, 0.2), (9.0, 0.0, 0.2),
    ],
)  # fmt: skip
def test_the_panel_moves_along_straight_lines_and_rests_before_and_after(
    time: float, distance: float, yaw: float
) -> None:
    motion = Recording(path=PATH).motion(time)
    assert motion["distance"] == pytest.approx(distance, abs=1e-12)
    assert motion["yaw"] == pytest.approx(yaw, abs=1e-12)
    assert {motion[name] for name in ("offset_x", "offset_y", "pitch", "roll")} == {0.0}


def test_one_waypoint_is_a_constant_pose_and_no_waypoint_moves_nothing() -> None:
    one = Recording(path=PATH[1:2])
    assert {one.motion(time)["distance"] for time in (0.0, 3.0, 8.0)} == {0.5}
    assert Recording().motion(1.0) == {}
