"""Words for what is not sure of a film's reading."""

from occ_model.results.video_reading import FilmProgress, VideoReading


def sentences_of(
    known: FilmProgress, whole: VideoReading | None, problem: str | None
) -> tuple[str, ...]:
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
