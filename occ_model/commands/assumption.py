"""What measured times rest on: the frequency, or the readout time, that is taken as known."""

import argparse

from occ_model.scene.parameters import quantity


def assumption(name: str, value: float, options: argparse.Namespace) -> str:
    """Name the value that the estimates of time rest on, unless the command line states it.

    Parameters
    ----------
    name
        The parameter that was taken as known.
    value
        Its value in SI units.
    options
        The parsed command line.
    """
    stated = {setting.partition("=")[0].strip() for setting in options.settings}
    if options.led_frequency is not None:
        stated.add("switching_frequency")
    return "" if name in stated else f"if {name} = {quantity(name).format(value)}: "
