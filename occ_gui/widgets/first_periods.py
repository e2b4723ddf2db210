"""Words on the button that shows the first periods of what is sent: packets, or cycles."""

PACKETS_IN_VIEW = 2  # packets in the first view of a plot over columns


def first_periods(has_packets: bool) -> tuple[str, str]:
    """Return the text of the button and its tooltip."""
    whose, periods = ("panel", "packets") if has_packets else ("pattern", "cycles")
    tip = f"Show the {whose}'s first {periods}, and follow them."
    return f"{PACKETS_IN_VIEW} {periods}", tip
