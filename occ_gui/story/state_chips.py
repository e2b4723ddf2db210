"""State chips: short labels of what holds for a result, such as where the band model ends."""

from typing import TYPE_CHECKING

from occ_gui.scene.forced_effects import switch_text
from occ_gui.simulation.snapshot import Reading
from occ_gui.simulation.verdict import is_right, left_out_in_words
from occ_gui.story.column_facts import READ_BY_ALL
from occ_gui.widgets.chip_row import Chip
from occ_gui.widgets.state_look import State

if TYPE_CHECKING:
    from occ_gui.detection_map.own_rate_controller import OwnRate

_COMPUTING = "computing"  # the chip of results that are still to come
_READS = 0.99  # fraction of the bits from which a decoder counts as reading
_MOST_FORCED = 2  # effects switched by hand that have a chip each; more share one


def chips_of(reading: Reading, decoder: str) -> tuple[Chip, ...]:
    """Return what holds for the results, beside the verdict on one decoder's."""
    return (
        *_followed(reading),
        _ratio(reading),
        *_band_model(reading),
        *_other_decoders(reading, decoder),
        *_by_hand(reading),
        *_left_out(reading),
    )


def computing() -> Chip:
    return Chip(_COMPUTING, "computing", "The results are computed.", State.WAITING)


def of_pictures(rate: "OwnRate") -> Chip:
    """Return what is read of pictures that begin at any time, beside the verdict on this one."""
    text = f"of {rate.images} pictures: {100.0 * rate.share:.3g} % of bits"
    meaning = (
        f"This picture is one; of {rate.images} that begin at any time "
        f"{100.0 * rate.share:.3g} % of the bits are "
        f"read (95 % interval {100.0 * rate.low:.1f} to {100.0 * rate.high:.1f} %), and every bit "
        f"of {rate.whole} pictures. The strips show the same share."
    )
    state = State.GOOD if rate.share >= _READS else State.DOUBTFUL if rate.share else State.BAD
    return Chip("rate", text, meaning, state)


def behind_run(chips: tuple[Chip, ...], pictured: str) -> tuple[Chip, ...]:
    """Say of which value the picture is, where a slider runs ahead of it.

    ``pictured``: the value of the picture; empty where it is that of the results.
    """
    rest = tuple(chip for chip in chips if chip.key != _COMPUTING)
    if not pictured:
        return rest
    meaning = "The slider runs ahead of the picture, which is still of this value."
    return (Chip(_COMPUTING, f"picture: {pictured}", meaning), *rest)


def _followed(reading: Reading) -> list[Chip]:
    """Say that what is shown was read before the picture, which has the last word."""
    if reading.has_picture:
        return []
    meaning = "Read from the column profile or a draft; the exact picture is computed."
    return [Chip(_COMPUTING, "picture follows", meaning, State.WAITING)]


def _ratio(reading: Reading) -> Chip:
    scene = reading.scene
    ratio = scene.camera.exposure_time / scene.transmitter.switching_period
    meaning = (
        "The exposure time over the time that a chip lasts. Above 1 no column sees one chip alone."
    )
    return Chip("ratio", f"t / t<sub>LED</sub> = {ratio:.3g}", meaning)


def _band_model(reading: Reading) -> list[Chip]:
    if not reading.band_undefined:
        return []
    return [Chip("band", "band model ends here", reading.band_undefined)]


def _other_decoders(reading: Reading, decoder: str) -> list[Chip]:
    # Others have read it only where they were chosen before.
    results = {result.decoder: result for result in reading.results}
    tried = [name for name in (*READ_BY_ALL, decoder) if name in results]
    right = [name for name in tried if is_right(results[name], reading.sent)]
    others = [name for name in right if name != decoder]
    if not reading.sent or not others:
        return []
    names = ", ".join(others)
    meaning = (
        f"Of the decoders that every picture is read with ({', '.join(READ_BY_ALL)}), these too "
        f"read the code from the same signal, all bits right: {names}. The others read it where "
        "they are chosen."
    )
    text = f"also read: {names}" if decoder in right else f"read by: {names}"
    return [Chip("others", text, meaning, State.GOOD)]


def _by_hand(reading: Reading) -> list[Chip]:
    decisions = reading.plan.decisions
    labels = {decision.effect: decision.label for decision in decisions}
    texts = [switch_text(d.effect, d.included, labels) for d in decisions if d.forced]
    meaning = "The plan would decide by the tolerance; this was decided by hand."
    if len(texts) > _MOST_FORCED:
        text = f"{len(texts)} effects by hand"
        return [Chip("forced", text, "\n".join([*texts, meaning]), State.DOUBTFUL)]
    return [Chip("forced", text, meaning, State.DOUBTFUL) for text in texts]


def _left_out(reading: Reading) -> list[Chip]:
    if not reading.called_for:
        return []
    return [Chip("left out", "effects left out", left_out_in_words(reading), State.DOUBTFUL)]
