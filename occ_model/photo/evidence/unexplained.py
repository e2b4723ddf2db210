"""Say why neither what is sent nor what is read explains a photo's stripes."""

from occ_model.errors import distinct_texts
from occ_model.photo.stripes.period import LEAST_AUTOCORRELATION, best_repetition
from occ_model.results.match import NEVER_CHANGES, Stripes


def why_not_as_sent(varies: bool) -> str:
    if not varies:
        return NEVER_CHANGES
    return (
        "What the scene sends does not explain the stripes, whenever it begins: lit columns would "
        "be darker than dark ones, or dark ones darker than black."
    )


def why_unread(stripes: Stripes) -> str:
    """Say why no chips are read from stripes."""
    if stripes.period is None:
        longest, best = best_repetition(stripes.flattened)
        shown, limit = distinct_texts(best, LEAST_AUTOCORRELATION, 2)
        return (
            f"The stripes do not repeat: shifted by up to {longest} columns, they correlate with "
            f"themselves by {shown} at most; at least {limit} is needed. Come closer, raise the "
            "frequency, or say what is sent."
        )
    return (
        f"The stripes repeat after {stripes.period:.1f} columns, but no sequence of chips read "
        "from them explains them; say what is sent."
    )
