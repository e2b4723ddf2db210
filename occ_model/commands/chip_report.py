"""The chips in view of ``occ-model match --chips`` as text."""

from occ_model.results.match import ChipReading


def chip_lines(reading: ChipReading) -> list[str]:
    """Describe the chips read from a photo in lines."""
    return [
        f"{'chips':22}{reading.text}",
        f"{'chips in view':22}{len(reading.chips)}, between the first edge and the last one",
        f"{'chip length':22}{reading.columns_per_chip:.3f} columns",
        f"{'first chip from':22}column {reading.start:.1f}",
        f"{'all right with':22}a probability of {100.0 * reading.confidence:.0f} %",
        f"{'region':22}{reading.region}",
    ]
