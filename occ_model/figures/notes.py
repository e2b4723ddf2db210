"""What a file says of how its scene was simulated."""

from occ_model.scene.simulation_settings import SimulationSettings


def settings_notes(settings: SimulationSettings) -> tuple[str, ...]:
    """Write a simulation's settings as lines of a provenance; the seed has a line of its own."""
    forced = ", ".join(f"{name} {'on' if on else 'off'}" for name, on in settings.force.items())
    return (
        f"tolerance {settings.tolerance:g} levels of the {settings.observable}",
        f"noise {settings.noise}",
        f"by hand: {forced or 'nothing'}",
    )
