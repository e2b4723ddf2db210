"""Words for a film's reading: its rates, its clocks, and what is not sure."""

from occ_model.results.fact import Fact
from occ_model.results.video_reading import FilmProgress, VideoReading
from occ_model.study.reading_facts import clock_facts, packet_facts


def facts_of(known: FilmProgress, whole: VideoReading | None) -> tuple[Fact, ...]:
    """List the facts on a film that is being read.

    Parameters
    ----------
    whole
        What the frames said together when they were last looked at; None before.
    """
    facts = [
        Fact(
            "placed",
            "Frames placed",
            f"{known.placed} of {known.frames}",
            meaning="Frames whose place in what is sent over and over is known.",
        ),
        Fact(
            "known",
            "Packet known",
            f"{100.0 * known.known:.0f} %",
            meaning="Share of the chips of a period that are known, those of a header included.",
        ),
    ]
    if whole is not None:
        facts += packet_facts(whole)
    clock = known.clock if whole is None or whole.clock is None else whole.clock
    if clock is not None:
        facts += clock_facts(clock)
    return tuple(facts)


def sentences_of(
    known: FilmProgress, whole: VideoReading | None, problem: str | None
) -> tuple[str, ...]:
    """List what is not sure of a film, and what is wrong with it."""
    said = [problem] if problem else []
    if whole is not None and whole.failure is not None:
        said.append(whole.failure)
    if whole is not None:
        said += whole.problems
    elif known.clock is not None:
        said += known.clock.problems
    if whole is not None and whole.cut_off:
        said.append(_losses(known, whole))
    return tuple(dict.fromkeys(said))


def _losses(known: FilmProgress, whole: VideoReading) -> str:
    """Say why packets are lost, and that their bits are not counted as wrong ones."""
    where = "sent in the gap between two frames, or cut off by a frame's edge"
    if unplaced := known.frames - known.placed:
        where += f", or in one of {unplaced} frames that were not placed"
    text = f"Of {whole.lost} lost packets no frame shows {whole.cut_off} whole: {where}."
    if misread := whole.lost - whole.cut_off:
        text += f" {misread} were in view and misread."
    return text + " The bit error rate counts only bits of packets in view."
