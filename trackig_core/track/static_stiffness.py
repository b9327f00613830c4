"""Static stiffness of pad and boot: as stated, or the dynamic one in its place.

Static and dynamic stiffness are different measurements (EN 13146-9 and EN 17495); for the elastomers in use
the dynamic one is 1.1 to 2.5 times the static one. N/m.
"""

from trackig_core.track.design import REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.measured_curves import StiffnessCurve


def static_stiffnesses(design: TrackDesign) -> tuple[float, float | None]:
    """Return the static stiffnesses on which a design stands.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    pad : float
        Static stiffness of the pads, or the dynamic one where none is stated [N/m].
    boot : float or None
        The same of the boots; None when single-stage.
    """
    pad = stand_in(design.pad_static_stiffness, design.pad_stiffness)
    if design.boot_stiffness is None:
        return pad, None
    return pad, stand_in(design.boot_static_stiffness, design.boot_stiffness)


def stand_in(static: float | None, dynamic: float | StiffnessCurve) -> float:
    """Return a static stiffness, or the dynamic one where none is stated.

    Parameters
    ----------
    static : float or None
        Static stiffness [N/m].
    dynamic : float or StiffnessCurve
        Dynamic stiffness [N/m]; of a measured curve that at 50 Hz is taken, or at the nearest frequency
        measured.

    Returns
    -------
    float
        Stiffness [N/m].
    """
    if static is not None:
        return static
    if isinstance(dynamic, StiffnessCurve):
        return float(dynamic.stiffness(REFERENCE_FREQUENCY))
    return dynamic


def unstated(design: TrackDesign) -> tuple[str, ...]:
    """Return which of ``"pad"`` and ``"boot"`` have no static stiffness stated.

    Parameters
    ----------
    design : TrackDesign
        The track.

    Returns
    -------
    tuple of str
        Names; empty if a static stiffness is stated for every part that the track has.
    """
    parts = ("pad", "boot") if design.two_stage else ("pad",)
    return tuple(part for part in parts if getattr(design, f"{part}_static_stiffness") is None)
