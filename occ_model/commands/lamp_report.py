"""The chips, regions and lamps of ``occ-model match`` as text."""

import re

from occ_model.errors import ParameterError, shown
from occ_model.results.decoding import Region
from occ_model.results.lamp import Lamp
from occ_model.results.match import ChipReading
from occ_model.scene.units import Unit

_REGION = re.compile(r"(\d{1,9}):(\d{1,9}),(\d{1,9}):(\d{1,9})")


def region_from(text: str) -> Region:
    """Read the rectangle ``R0:R1,C0:C1``: rows R0 to before R1, columns C0 to before C1."""
    found = _REGION.fullmatch(text.strip())
    if found is None:
        raise ParameterError.of(
            "--region",
            shown(text),
            "R0:R1,C0:C1, such as 100:800,0:1920: the first row, the row after the last, and the "
            "same of the columns",
        )
    return Region(*(int(number) for number in found.groups()))


def lamp_lines(number: int, lamp: Lamp) -> list[str]:
    lines = [f"lamp {number}: {lamp.region}, grey level {lamp.level:.0f}"]
    product, deviation = lamp.switching_frequency_times_readout, lamp.product_uncertainty
    if product is None or deviation is None:
        return [*lines, "no stripes: its light does not change while the picture is read out"]
    estimate = Unit("chips a column").format_estimate(product, deviation)
    lines.append(f"frequency times readout time {estimate}")
    if lamp.periods is not None:
        lines.append(f"{lamp.periods:.1f} periods in view")
    lines += [f"doubtful: {doubt}" for doubt in lamp.doubts]
    if lamp.reflections:
        lines.append(f"reflected at {', '.join(map(str, lamp.reflections))}")
    return lines


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
