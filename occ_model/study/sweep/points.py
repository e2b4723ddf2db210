"""The work at a sweep's points: one after the other, or handed out in parcels."""

from collections.abc import Callable, Generator, Iterable
from dataclasses import dataclass
from time import perf_counter

from occ_model.errors import OccError
from occ_model.results import RateSettings, SweepPoint, SweepRequest
from occ_model.results.sweep_csv import one_line
from occ_model.scene.parameter_kinds import ParameterValue
from occ_model.scene.scene import Scene
from occ_model.study.success_rate import check_rate, right_bits

Pulse = Callable[[], object]
"""Is called again and again while there is work; what it raises ends it."""


def measure_point(
    scene: Scene,
    settings: RateSettings,
    index: int,
    values: dict[str, ParameterValue],
    pulse: Pulse = lambda: None,
) -> SweepPoint:
    """Measure one point; what the model refuses becomes a note."""
    try:
        at = scene.replace(**values)
        check_rate(at, settings)
        right = right_bits(at, settings, pulse)
    except OccError as refusal:
        return SweepPoint(index, 0, (0,) * len(settings.decoders), one_line(str(refusal)))
    return SweepPoint(index, settings.images * at.transmitter.bits, right)


def measure_here(
    request: SweepRequest, indices: Iterable[int], pulse: Pulse = lambda: None
) -> Generator[SweepPoint, None, None]:
    """Measure points in this process, one after the other."""
    for index in indices:
        values = request.values(index)
        yield measure_point(request.scene, request.settings, index, values, pulse)


@dataclass(frozen=True, slots=True)
class Parcel:
    """Some points for a worker, with all that it needs to know."""

    scene: Scene
    settings: RateSettings
    points: tuple[tuple[int, dict[str, ParameterValue]], ...]

    @property
    def indices(self) -> tuple[int, ...]:
        """Which points."""
        return tuple(index for index, _ in self.points)


@dataclass(frozen=True, slots=True)
class Delivery:
    """What a worker found in a parcel.

    Parameters
    ----------
    points
        What was measured.
    seconds
        Time that it took.
    error
        What the model failed with: it is handed over as a value, so that whatever an executor
        itself raises is known to be the executor's.
    """

    points: tuple[SweepPoint, ...]
    seconds: float
    error: Exception | None = None


def measure_parcel(parcel: Parcel) -> Delivery:
    """Measure some points in a worker."""
    start = perf_counter()
    found = []
    try:
        for index, values in parcel.points:
            found.append(measure_point(parcel.scene, parcel.settings, index, values))
    except Exception as error:  # noqa: BLE001 - raised again where the sweep runs
        return Delivery((), perf_counter() - start, error)
    return Delivery(tuple(found), perf_counter() - start)
