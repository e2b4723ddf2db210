"""The command ``occ-model limits``: find the frequencies and exposures that a decoder reads."""

import argparse
import math

from occ_model.commands.options import (
    Commands,
    add_scene_options,
    decoder_name,
    number,
    scene_of,
    whole_number,
)
from occ_model.commands.progress_bar import progress_bar
from occ_model.program import EXIT_FAILURE
from occ_model.receiver.decoders import DECODERS, PAPER_DECODER
from occ_model.results import Limits, Trial
from occ_model.results.advice import Advice, EndFacts, RangeFacts
from occ_model.results.bit_errors import FRAMES_A_SECOND
from occ_model.scene.parameters import quantity
from occ_model.scene.recording import FRAME_RATE
from occ_model.scene.units import HERTZ, SECOND
from occ_model.study.advice import advice_of
from occ_model.study.limits import limits

_BAR = "{desc}: {percentage:3.0f} %|{bar}| {elapsed}, about {remaining} left"

_DIGITS = 4
"""Significant digits of a limit that is known to a few thousandths."""


def add_to(commands: Commands) -> None:
    """Add the command."""
    parser = commands.add_parser(
        "limits", help="find how fast a scene can go, and how long it can be exposed"
    )
    add_scene_options(parser)
    parser.add_argument(
        "--decoder",
        type=decoder_name,
        default=PAPER_DECODER,
        help=f"one of {', '.join(DECODERS)} or a plug-in's; default: %(default)s",
    )
    parser.add_argument(
        "--rate", type=number, default=99.0, metavar="PERCENT",
        help="of the bits from which a scene counts as read; default: %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--images", type=whole_number, default=20,
        help="at each value tried; more of them make the answer surer; default: %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--fps", type=number, default=FRAMES_A_SECOND,
        help="pictures a second, or as many as can be read out, one payload each; default: "
        "%(default)g",
    )  # fmt: skip
    parser.add_argument("--seed", type=whole_number, default=1, help="default: %(default)s")
    parser.add_argument(
        "--jobs", type=whole_number, default=2, metavar="N",
        help="processes, two at most; the answer is the same with one; default: %(default)s",
    )  # fmt: skip
    parser.set_defaults(command=_run)


def _run(options: argparse.Namespace) -> int:
    scene = scene_of(options)
    FRAME_RATE.check(options.fps)
    with progress_bar(total=100, unit="%", bar_format=_BAR, leave=False, delay=0.5) as bar:

        def show(share: float, what: str) -> None:
            bar.set_description_str(what, refresh=False)
            bar.update(round(100.0 * share) - bar.n)

        found = limits(
            scene,
            options.decoder,
            rate=options.rate,
            images=options.images,
            seed=options.seed,
            jobs=options.jobs,
            progress=show,
        )
    for line in sentences(advice_of(found), options.fps):
        print(line)
    return 0 if found.highest_frequency and found.longest_exposure else EXIT_FAILURE


def sentences(advice: Advice, frames_a_second: float = FRAMES_A_SECOND) -> list[str]:
    """Write advice as lines of text."""
    found = advice.limits
    scene = found.scene
    exposure = SECOND.format(scene.camera.exposure_time)
    frequency = HERTZ.format(scene.transmitter.switching_frequency)
    distance = quantity("distance").format(scene.pose.distance)
    reads = f"the {found.decoder} decoder reads {found.rate:g} % of the bits"
    return [
        *_on_range(f"At an exposure of {exposure} and {distance} {reads}", advice.frequency),
        *_on_range(f"At {frequency} and {distance} {reads}", advice.exposure),
        f"Each of these values was tried with {found.images} images, seed {found.seed}; the "
        "intervals hold the rate in 95 of 100 cases if bits err independently of each other.",
        *_bits_a_second(found, frames_a_second),
        *_by_theory(advice),
    ]


def _bits_a_second(found: Limits, frames_a_second: float) -> list[str]:
    """Say what the scene's payload is a second, where it is read."""
    if not found.highest_frequency:
        return []
    bits = found.scene.transmitter.payload_length
    camera = found.scene.camera
    pictures = min(frames_a_second, 1.0 / (camera.columns * camera.readout_time))
    a_second = bits * pictures * found.rate / 100.0
    return [
        f"Where it does, {bits} bits in each of {pictures:.4g} pictures a second are at least "
        f"{a_second:.4g} right bits a second; occ-model most-bits looks for more."
    ]


def _on_range(start: str, facts: RangeFacts) -> list[str]:
    if not facts.ends:
        return [facts.found.failure or ""]
    low, high = (_written(end.parameter, end.value) for end in facts.ends)
    label = quantity(facts.found.parameter).label.lower()
    return [f"{start} at any {label} from {low} to {high}.", *map(_on_end, facts.ends)]


def _on_end(end: EndFacts) -> str:
    works = f"at {_written(end.parameter, end.value)} {_counted(end.works)}"
    if end.fails is None:
        side = {"lowest": "below", "highest": "above"}[end.side]
        return f"  {works}; {side} it was not searched.{_on_inside(end)}"
    beyond = f"at {_written(end.parameter, end.fails.value)} {_counted(end.fails)}"
    return f"  {works}, {beyond}.{_on_inside(end)}"


def _on_inside(end: EndFacts) -> str:
    if end.inside is None:
        return " No value near it was read without an error."
    if end.inside == end.works:
        return ""
    value = _written(end.parameter, end.inside.value)
    images = f"every bit of {end.inside.images} images"
    return f" At {value}, {end.margin:.1f} % inside, it read {images}."


def _written(parameter: str, value: float) -> str:
    return quantity(parameter).format(value, _DIGITS)


def _counted(trial: Trial) -> str:
    return f"{trial.right} of {trial.sent} bits ({trial.low:.1f} to {trial.high:.1f} %)"


def _by_theory(advice: Advice) -> list[str]:
    frequencies, white = advice.frequency.theory, advice.exposure.theory.saturation
    band = HERTZ.format(frequencies.band_model, _DIGITS)
    null = HERTZ.format(frequencies.null, _DIGITS)
    lines = [f"By theory the band model ends at {band} and an alternating pattern at {null};"]
    if frequencies.two_packets is not None:
        packets = HERTZ.format(frequencies.two_packets, _DIGITS)
        lines.append(f"  below {packets} no two packets fit the picture;")
    if white is not None and math.isfinite(white):
        exposure = SECOND.format(white, _DIGITS)
        lines.append(f"  from an exposure of {exposure} what is lit throughout is white.")
    else:
        lines.append("  there is no light that could saturate.")
    return lines
