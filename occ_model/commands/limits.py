"""``occ-model limits``."""

import argparse
import math
import sys

from occ_model.commands.options import Commands, add_scene_options, scene_of
from occ_model.program import EXIT_FAILURE
from occ_model.receiver.decoders import DECODERS, PAPER_DECODER
from occ_model.results import Limits, RangeEnd, Trial, WorkingRange
from occ_model.scene.parameters import PARAMETERS
from occ_model.scene.scene import Scene
from occ_model.scene.units import HERTZ, SECOND
from occ_model.study import theory
from occ_model.study.limits import limits

_DIGITS = 4
"""Of an edge that is known to a few thousandths."""


def add_to(commands: Commands) -> None:
    """Add the command."""
    parser = commands.add_parser(
        "limits", help="say how fast a scene can go, and how long it can be exposed"
    )
    add_scene_options(parser)
    parser.add_argument("--decoder", choices=tuple(DECODERS), default=PAPER_DECODER)
    parser.add_argument(
        "--rate", type=float, default=99.0, metavar="PERCENT",
        help="of the bits that are to be read; default: %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--images", type=int, default=20,
        help="at each value tried; more of them make the answer surer; default: %(default)s",
    )  # fmt: skip
    parser.add_argument("--seed", type=int, default=1, help="default: %(default)s")
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    from tqdm import tqdm

    scene = scene_of(options)
    with tqdm(unit="image", file=sys.stderr, leave=False, delay=0.5) as bar:
        found = limits(
            scene,
            options.decoder,
            rate=options.rate,
            images=options.images,
            seed=options.seed,
            pulse=bar.update,
        )
    for line in _answer(found):
        print(line)
    for line in _by_theory(scene):
        print(line)
    return 0 if found.highest_frequency and found.longest_exposure else EXIT_FAILURE


def _answer(found: Limits) -> list[str]:
    scene = found.scene
    exposure = SECOND.format(scene.camera.exposure_time)
    frequency = HERTZ.format(scene.transmitter.switching_frequency)
    distance = PARAMETERS["distance"].format(scene.pose.distance)  # type: ignore[arg-type]
    who = f"the {found.decoder} decoder reads {found.rate:g} % of the bits"
    lines = _working_range(f"At an exposure of {exposure} and {distance} {who}", found.frequency)
    lines += _working_range(f"At {frequency} and {distance} {who}", found.exposure)
    lines.append(
        f"Each value was tried with {found.images} images, seed {found.seed}; the intervals hold "
        "the rate in 95 of 100 cases if bits err independently of each other."
    )
    return lines


def _working_range(start: str, working_range: WorkingRange) -> list[str]:
    if working_range.failure is not None:
        return [working_range.failure]
    assert working_range.lowest is not None  # noqa: S101 - both ends are there where any is
    assert working_range.highest is not None  # noqa: S101
    low, high = (
        _written(working_range, working_range.lowest.value),
        _written(working_range, working_range.highest.value),
    )
    own = PARAMETERS[working_range.parameter].label.lower()
    lines = [f"{start} at any {own} from {low} to {high}."]
    lines += _range_end(working_range, working_range.lowest, "below") + _range_end(
        working_range, working_range.highest, "above"
    )
    return lines


def _range_end(working_range: WorkingRange, range_end: RangeEnd, side: str) -> list[str]:
    works = f"at {_written(working_range, range_end.value)} {_counted(range_end.works)}"
    if range_end.fails is None:
        return [f"  {works}; {side} it was not searched."]
    fails = _written(working_range, range_end.fails.value)
    return [f"  {works}, at {fails} {_counted(range_end.fails)}."]


def _written(working_range: WorkingRange, value: float) -> str:
    return PARAMETERS[working_range.parameter].format(value, _DIGITS)  # type: ignore[arg-type, call-arg]


def _counted(trial: Trial) -> str:
    return f"{trial.right} of {trial.sent} bits ({trial.low:.1f} to {trial.high:.1f} %)"


def _by_theory(scene: Scene) -> list[str]:
    band = HERTZ.format(theory.band_model_frequency(scene), _DIGITS)
    null = HERTZ.format(theory.null_frequency(scene), _DIGITS)
    lines = [f"By theory the band model ends at {band} and an alternating pattern at {null};"]
    packets = theory.two_packets_frequency(scene)
    if packets is not None:
        lines.append(f"  below {HERTZ.format(packets, _DIGITS)} no two packets fit the picture;")
    white = theory.saturation_exposure(scene)
    if math.isfinite(white):
        exposure = SECOND.format(white, _DIGITS)
        lines.append(f"  from an exposure of {exposure} what is lit throughout is white.")
    else:
        lines.append("  there is no light that could saturate.")
    return lines
