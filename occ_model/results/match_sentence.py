"""Say a match in one sentence: what was sent, what the camera does, and how sure that is."""

from occ_model.errors import capitalize
from occ_model.results.match import Match
from occ_model.results.photo_table import SURE
from occ_model.scene.parameter_kinds import Quantity
from occ_model.scene.parameters import quantity
from occ_model.scene.units import PERCENT

_LARGEST_ERROR = 0.5  # relative standard deviation above which only an upper limit is stated
_LIMIT_DEVIATIONS = 2.0  # number of standard deviations by which the limit exceeds the estimate


def state_verdict(match: Match, condition: str = "") -> str:
    """State in a few words how sure a match is, except for what, and under which condition."""
    words = [match.verdict]
    if match.only_exposure_is_doubtful:
        words.append("but for the exposure")
    if match.verdict == SURE and condition:
        words.append(condition.removesuffix(": "))
    return ", ".join(words)


def describe_match(match: Match, condition: str = "") -> str:
    """Describe a match in a sentence.

    ``condition``: the assumption that it depends on, as ``"if f = 10 kHz: "``; empty if the value
    is known.
    """
    measured, known = _value(match, match.estimate), _value(match, match.known)
    what = "lamp" if match.lamp is not None else "code"
    if match.estimate == "readout_time":
        start = condition or f"{what} of {known}: "
        facts = [f"{start}your camera reads a line in {measured}"]
    else:
        start = condition or f"lines read in {known}: "
        facts = [f"{start}{what} of {measured}"]
    exposure = _value(match, "exposure_time")
    light = [f"exposed {'' if exposure.startswith('below') else 'for '}{exposure}"]
    error = match.uncertainties.get("duty")
    if match.duty is not None and error is not None:
        light.insert(0, f"lit for {PERCENT.format_estimate(match.duty, error)} of the time")
    if match.only_exposure_is_doubtful:
        facts.append(f"{' and '.join(light)} ({'both ' * (len(light) > 1)}doubtful)")
    else:
        facts += light
    facts.append(f"{match.verdict}{' otherwise' * match.only_exposure_is_doubtful}")
    sentence = "; ".join(facts)
    return f"{capitalize(sentence)}."


def _value(match: Match, name: str) -> str:
    return estimate_text(quantity(name), getattr(match, name), match.uncertainties.get(name))


def estimate_text(quantity: Quantity, value: float, deviation: float | None) -> str:
    """Format an estimate in SI units, with its deviation if any, to the significant digits.

    An exposure time with a large error is stated as an upper limit, since the value minus its error
    would be close to zero or negative.
    """
    text = quantity.unit.format_estimate(value, deviation)
    if quantity.name != "exposure_time" or deviation is None or deviation <= _LARGEST_ERROR * value:
        return text
    return f"below {quantity.format(value + _LIMIT_DEVIATIONS * deviation, 2)} ({text})"
