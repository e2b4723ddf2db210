"""What the times that a command measures rest on, unless its words state it."""

import argparse

from occ_model.results.assumption import assumption


def assumption_of(name: str, value: float, chips: int, options: argparse.Namespace) -> str:
    """Name the value that the estimates of time rest on; empty where the command line states it."""
    stated = {setting.partition("=")[0].strip() for setting in options.settings}
    if options.led_frequency is not None:
        stated.add("switching_frequency")
    return "" if name in stated else assumption(name, value, chips)
