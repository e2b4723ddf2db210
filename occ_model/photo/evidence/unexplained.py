"""Say why neither what is sent nor what is read explains a photo's stripes."""

from occ_model.errors import distinct_texts
from occ_model.photo.stripes.period import LEAST_AUTOCORRELATION, best_repetition
from occ_model.results.match import NEVER_CHANGES, Stripes


def why_not_as_sent(varies: bool) -> str:
    if not varies:
        return NEVER_CHANGES
    return (
        "What the scene sends explains the stripes at no timing: lit columns would be darker than "
        "dark ones, or dark ones darker than black."
    )


def why_unread(stripes: Stripes) -> str:
    """Say why no chips are read from stripes."""
    if stripes.period is None:
        longest, best = best_repetition(stripes.flattened)
        shown, limit = distinct_texts(best, LEAST_AUTOCORRELATION, 2)
        return (
            f"No period is found in the stripes, so that what is sent cannot be read from them: "
            f"after no shift of up to {longest} columns is their correlation with themselves above "
            f"{shown}; at least {limit} is needed; come closer, raise the frequency, or say what "
            "is sent."
        )
    return (
        f"The stripes repeat after {stripes.period:.1f} columns, but no sequence of chips read "
        "from them explains them; say what is sent."
    )
