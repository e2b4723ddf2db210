"""Write what a lesson asks for and an equation gives, each with the same number of digits."""

from occ_model.scene.units import Unit

_DIGITS = 3  # significant digits that a student can read off; integer parts are written in full


def result_text(unit: Unit, value: float) -> str:
    _, factor = unit.display(value)
    if not unit.symbol and value == round(value):
        return f"{value:.0f}"
    before_point = len(f"{abs(value / factor):.0f}")
    return unit.format(value, max(_DIGITS, before_point))
