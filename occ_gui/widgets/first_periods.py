"""Words on the button that shows the first periods of what is sent: packets, or cycles."""

PACKETS_IN_VIEW = 2  # packets in the first view of a plot over columns


def first_periods(has_packets: bool) -> tuple[str, str]:
    """Return the text of the button and its tooltip."""
    if has_packets:
        text, tip = "{count} packets", "Show the panel's first packets, and follow them."
    else:
        text, tip = "{count} cycles", "Show the pattern's first cycles, and follow them."
    return text.format(count=PACKETS_IN_VIEW), tip
