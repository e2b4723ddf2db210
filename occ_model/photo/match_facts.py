"""The facts of a match: estimates with their errors, quality of the fit, alternatives."""

from collections.abc import Iterator

from occ_model.photo.many.other_programs import frame_of_match
from occ_model.results.fact import Fact
from occ_model.results.match import Alternative, Match
from occ_model.results.match_sentence import estimate_text
from occ_model.scene.parameters import quantity
from occ_model.scene.units import PERCENT, Unit

_FREQUENCIES = ("switching_frequency", "lamp_frequency")
ESTIMATES = ("readout_time", *_FREQUENCIES, "exposure_time", "start_time", "gamma")

LABELS = {
    "readout_time": "Readout time a line",
    "frame": "Readout of the frame",
    "switching_frequency": quantity("switching_frequency").label,
    "lamp_frequency": quantity("lamp_frequency").label,
    "exposure_time": quantity("exposure_time").label,
    "noted": "Noted by the camera",
    "others": "Other possible exposures",
    "start_time": quantity("start_time").label,
    "gamma": quantity("gamma").label,
    "duty": quantity("duty").label,
    "pattern": "Chips",
    "chip": "Chip length",
    "period": "Period of the lamp",
    "periods": "Periods in view",
    "exposed": "Exposure in chips",
    "exposed_periods": "Exposure in periods",
    "averaging": "Averaging",
    "lines": "Lines read together",
    "region": "Region",
    "correlation": "Correlation",
    "residual": "Residual (RMSE)",
    "saturated": "Saturated",
    "repeats": "Stripes repeat after",
    "alternative": "Or instead",
}
"""Names of the facts, in their order."""

_NUMBERS = {2: "two", 3: "three", 4: "four", 8: "eight"}
_DIGITS = 4


def match_facts(match: Match, condition: str = "", noted: float | None = None) -> tuple[Fact, ...]:
    """List the facts of a match, in the order of :data:`LABELS`.

    ``condition``: the assumption that estimated times depend on, as ``"if f = 10 kHz: "``.
    ``noted``: the exposure time in seconds that the camera recorded.
    """
    texts = dict[str, tuple[str, str]]()
    excluded = _FREQUENCIES[match.lamp is None]  # of what is not sent
    for name in ESTIMATES:
        if name != excluded:
            texts[name] = _estimate(match, name, condition)
    if (frame := frame_of_match(match)) is not None:
        texts["frame"] = condition + estimate_text(quantity("readout_time"), *frame), ""
    exposure = quantity("exposure_time")
    if noted is not None:
        texts["noted"] = exposure.format(noted, _DIGITS), ""
    if match.other_exposures:
        others = " or ".join(exposure.format(time, _DIGITS) for time in match.other_exposures)
        texts["others"] = condition + others, ""
    texts |= _fit(match)
    facts = [Fact(key, label, *texts[key]) for key, label in LABELS.items() if key in texts]
    alternatives = (
        _alternative(alternative, match.estimate, condition) for alternative in match.alternatives
    )
    return (*facts, *(Fact("alternative", LABELS["alternative"], text) for text in alternatives))


def format_facts(facts: tuple[Fact, ...], width: int = 22) -> Iterator[str]:
    """Format facts as lines of two columns; parameters have the names that users type."""
    for fact in facts:
        label = fact.label[:1].lower() + fact.label[1:]
        yield f"{fact.key if fact.key in ESTIMATES else label:{width}}{fact}"


def _estimate(match: Match, name: str, condition: str) -> tuple[str, str]:
    deviation = match.uncertainties.get(name)
    text = estimate_text(quantity(name), getattr(match, name), deviation)
    if deviation is None:
        return text, "assumed" if condition and name == match.known else "given"
    # Gamma is estimated from the shape of the stripes, not from their timing.
    note = "doubtful" if name in match.doubtful_alone else ""
    return text if name == "gamma" else condition + text, note


def _fit(match: Match) -> dict[str, tuple[str, str]]:
    stripes = match.stripes
    texts = _lamp(match) if match.lamp is not None else _chips(match)
    texts |= {
        "periods": (f"{match.periods_in_view:.3g}", ""),
        "averaging": (match.scene.model.averaging, ""),
        "region": (str(match.region), ""),
        # The comparison of both profiles leaves out the rims, where blur mixes in the surroundings.
        "correlation": (f"{match.correlation:.4f}", "rims included"),
        "residual": (f"{match.rmse:.2f} grey levels", "rims included"),
        "saturated": (f"{100.0 * stripes.saturated:.1f} % of the region's pixels", ""),
    }
    if match.lines_at_once > 1:
        texts["lines"] = f"this camera reads {_NUMBERS[match.lines_at_once]} lines at a time", ""
    if stripes.period is not None:
        columns = Unit("columns").format_estimate(stripes.period, stripes.period_uncertainty)
        texts["repeats"] = columns, ""
    return texts


def _chips(match: Match) -> dict[str, tuple[str, str]]:
    how = "read from the photo" if match.pattern_was_read else "as the scene sends it"
    return {
        "pattern": (match.pattern, how),
        "chip": (f"{match.columns_per_chip:.3f} columns, {len(match.pattern)} chips a period", ""),
        "exposed": (f"{match.exposure_in_chips:.3g}", ""),
    }


def _lamp(match: Match) -> dict[str, tuple[str, str]]:
    columns = match.columns_per_chip * len(match.pattern)
    return {
        "duty": _duty(match),
        "period": (f"{columns:.4g} columns", ""),
        "exposed_periods": (f"{match.exposure_in_periods:.3g}", ""),
    }


def _duty(match: Match) -> tuple[str, str]:
    deviation, duty = match.uncertainties.get("duty"), match.duty or 0.0
    if deviation is None:
        return PERCENT.format(duty, 3), "given"
    note = "doubtful" if match.only_exposure_is_doubtful else ""
    return PERCENT.format_estimate(duty, deviation), note


def _alternative(alternative: Alternative, estimated: str, condition: str) -> str:
    side = "lower" if alternative.evidence <= 0.0 else "higher"
    text = (
        f"{alternative.sent}: correlation {alternative.correlation:.3f}, log-likelihood {side} by "
        f"{abs(alternative.evidence):.1f}"
    )
    if estimated in _FREQUENCIES:
        estimated = _FREQUENCIES[alternative.lamp is not None]
    value, parameter = getattr(alternative, estimated), quantity(estimated)
    if value is None or alternative.exposure_time is None:
        return text
    exposure = quantity("exposure_time").format(alternative.exposure_time, _DIGITS)
    return (
        f"{text}; {condition}{parameter.in_sentence} {parameter.format(value, _DIGITS)}, exposed "
        f"for {exposure}"
    )
