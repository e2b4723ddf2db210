"""Symbols of a circuit diagram, drawn on axes whose unit is half a symbol's length."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyBboxPatch, Polygon, Rectangle

_LINE: dict[str, Any] = {"color": "black", "linewidth": 1.2, "solid_capstyle": "round"}


def wire(axes: Axes, *points: tuple[float, float]) -> None:
    """Draw a wire through some points."""
    across, up = zip(*points, strict=True)
    axes.plot(across, up, **_LINE)


def joint(axes: Axes, x: float, y: float) -> None:
    """Mark where wires are joined."""
    axes.add_patch(Circle((x, y), 0.09, color="black", zorder=3))


def resistor(axes: Axes, x: float, y: float, label: str, *, upright: bool = False) -> None:
    """Draw a resistor whose wires end one unit from its middle."""
    long, short = 0.7, 0.24
    width, height = (short, long) if upright else (long, short)
    ends = [(x, y - 1), (x, y + 1)] if upright else [(x - 1, y), (x + 1, y)]
    wire(axes, *ends)
    axes.add_patch(
        Rectangle(
            (x - width, y - height), 2 * width, 2 * height,
            facecolor="white", edgecolor="black", linewidth=1.2, zorder=2,
        )
    )  # fmt: skip
    if upright:
        axes.text(x + 0.4, y, label, va="center", ha="left")
    else:
        axes.text(x, y + 0.42, label, va="bottom", ha="center")


def ground(axes: Axes, x: float, y: float) -> None:
    """Draw the sign of the common ground below a wire's end."""
    for number, half in enumerate((0.4, 0.26, 0.12)):
        wire(axes, (x - half, y - 0.16 * number), (x + half, y - 0.16 * number))


def transistor(axes: Axes, x: float, y: float, label: str) -> None:
    """Draw an n-channel MOSFET: gate at (x - 1, y), drain at (x + 0.5, y + 1), source below."""
    wire(axes, (x - 1, y), (x - 0.25, y))
    wire(axes, (x - 0.25, y - 0.5), (x - 0.25, y + 0.5))
    for low, high in ((-0.62, -0.28), (-0.17, 0.17), (0.28, 0.62)):
        wire(axes, (x, y + low), (x, y + high))
    wire(axes, (x, y + 0.45), (x + 0.5, y + 0.45), (x + 0.5, y + 1))
    wire(axes, (x, y - 0.45), (x + 0.5, y - 0.45), (x + 0.5, y - 1))
    wire(axes, (x, y), (x + 0.5, y), (x + 0.5, y - 0.45))
    axes.add_patch(
        Polygon([(x + 0.03, y), (x + 0.28, y + 0.13), (x + 0.28, y - 0.13)], color="black")
    )
    axes.text(x + 0.7, y, label, va="center", ha="left")


def diode(axes: Axes, x: float, y: float, label: str) -> None:
    """Draw an LED whose current flows down, and whose wires end one unit from its middle."""
    wire(axes, (x, y + 1), (x, y - 1))
    axes.add_patch(
        Polygon(
            [(x - 0.35, y + 0.3), (x + 0.35, y + 0.3), (x, y - 0.3)],
            facecolor="white", edgecolor="black", linewidth=1.2, zorder=2,
        )
    )  # fmt: skip
    wire(axes, (x - 0.35, y - 0.3), (x + 0.35, y - 0.3))
    for shift in (0.0, 0.3):
        axes.annotate(
            "", (x + 0.85 + shift, y + 0.45 + 0.0 * shift), (x + 0.45 + shift, y + 0.05),
            arrowprops={"arrowstyle": "->", "linewidth": 1.0},
        )  # fmt: skip
    axes.text(x + 1.3, y, label, va="center", ha="left")


def box(axes: Axes, corner: tuple[float, float], size: tuple[float, float], label: str) -> None:
    """Draw a part as a box with its name inside."""
    axes.add_patch(
        FancyBboxPatch(
            corner, *size, boxstyle="round,pad=0,rounding_size=0.15",
            facecolor="0.93", edgecolor="black", linewidth=1.2,
        )
    )  # fmt: skip
    axes.text(
        corner[0] + size[0] / 2, corner[1] + size[1] / 2, label, va="center", ha="center",
        fontweight="bold",
    )  # fmt: skip
