"""Snapshot: the results of one simulation, and the request for it."""

from dataclasses import dataclass, field
from typing import TypeAlias

from occ_model.arrays import FloatArray
from occ_model.results import DecodeResult, Frame, Plan
from occ_model.results.frame import PICTURES
from occ_model.scene.scene import Scene
from occ_model.scene.simulation_settings import SimulationSettings


@dataclass(frozen=True, slots=True)
class SimulationRequest:
    """A scene to be simulated.

    Parameters
    ----------
    scene
        The scene.
    settings
        The settings of its simulation.
    whose
        Whose picture is shown first, the ``"camera"``'s or the ``"receiver"``'s.
    """

    scene: Scene
    settings: SimulationSettings
    whose: str = field(default=PICTURES[0], compare=False)  # of the same results


@dataclass(frozen=True, eq=False, slots=True)
class Snapshot:
    """The results for one scene, as the panes show them.

    Parameters
    ----------
    request
        The scene and the settings that they were computed from.
    frame
        The simulated picture.
    decoded
        The result of the paper's decoder.
    others
        The results of the other decoders for the same signal.
    sent
        The transmitted bits in order of time; empty where a raw pattern is transmitted.
    packet_columns
        Columns that one period of the transmitted signal spans in the picture.
    panel_origin
        Column and row of the panel's upper left corner in the picture, or of the picture's where
        the panel reaches beyond it.
    band : ndarray of float64, shape (columns,), or None
        The band model's profile, None where ``band_undefined`` says why there is none.
    enhanced_band : ndarray of float64, shape (columns,), or None
        The same as a receiver would enhance it.
    band_undefined
        A sentence, empty where there is a profile.
    reading_seconds
        Computing time of the paper's decoder.
    called_for
        Effects that the picture leaves out and the studies of the same scene take in, by label.
    """

    request: SimulationRequest
    frame: Frame
    decoded: DecodeResult
    sent: tuple[int, ...]
    packet_columns: float
    panel_origin: tuple[float, float]
    band: FloatArray | None
    enhanced_band: FloatArray | None
    band_undefined: str
    reading_seconds: float
    others: tuple[DecodeResult, ...] = ()
    called_for: tuple[str, ...] = ()

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self.request.scene

    @property
    def plan(self) -> Plan:
        """The effects that were simulated."""
        return self.frame.plan

    @property
    def profile(self) -> FloatArray:
        """Mean of the panel's pixels in each column, before the receiver's enhancement."""
        return self.frame.profile

    @property
    def signal(self) -> FloatArray:
        """The same after the receiver's enhancement."""
        return self.frame.signal

    @property
    def corners(self) -> FloatArray:
        """The panel's corners in the picture, each as (column, row)."""
        return self.frame.corners

    @property
    def results(self) -> tuple[DecodeResult, ...]:
        """The result of every decoder, the paper's first."""
        return (self.decoded, *self.others)

    @property
    def simulation_seconds(self) -> float:
        """Computing time of the picture."""
        return sum(self.frame.timings.values())


Reading: TypeAlias = Snapshot
"""What is read of a scene."""
