"""What stands on and under a track, as it is chosen: of the catalogue, or a study's own.

A design holds suspension, positions and ground as they are [SI units]; here they are named. What no entry of
the catalogue gives is a study's own: it is shown as such and kept to the last digit.
"""

import trackig_core as tig
from dashboard.fields import KILONEWTON, NEWTON_PER_METRE
from dashboard.formats import quantity_text
from trackig_core.analysis.ladder import DEFAULT_VEHICLE
from trackig_core.track.design import ONE_AXLE

OFF = {"suspension": None, "axle_positions": ONE_AXLE, "ground": None}
"""The paper's simplified model: one unsprung wheel, on rigid ground."""

NONE, BOGIE, OWN = "none", "bogie", "own"
"""Choices besides the catalogue's: nothing, both axles of a bogie, and what a study holds."""

LABELS = {"suspension": "Vehicle", "axle_positions": "Axles", "ground": "Ground"}

CHOICES = {
    "suspension": {"none: unsprung wheel": NONE, **{f"{key}, generic": key for key in tig.VEHICLES}},
    "axle_positions": {"one wheel": NONE, "both of a bogie": BOGIE},
    "ground": {"rigid": NONE, **{f"{key}, generic": key for key in tig.GROUNDS}},
}
"""What each may be: words, and the key for them."""

WORDS = {
    "suspension": (
        "Suspension, bogie and body above the wheel; the unsprung mass stays as its slider says. Round "
        "figures of the kind, not those of a vehicle."
    ),
    "axle_positions": (
        "The second axle of the vehicle's bogie on the same rail; without a vehicle that of a regional one. "
        "No load moves: the wheels stand, and roughness passes under them."
    ),
    "ground": (
        "What each support stands on by itself, as a round foot on an elastic half-space. Supports do not "
        "feel each other through it, and nothing is said of a tunnel, of the way to a receptor, or of a "
        "floating slab. Insertion gain is then against a very stiff track on the same ground."
    ),
}
"""What each is, and what it is not."""


def chosen(name, values):
    """Return which choice gives a value.

    Parameters
    ----------
    name : str
        A key of :data:`OFF`.
    values : mapping
        Suspension, positions [m] and ground by name; the axles of a bogie depend on the vehicle.

    Returns
    -------
    str
        A value of :data:`CHOICES`, or :data:`OWN`.
    """
    value = values[name]
    if value == OFF[name]:
        return NONE
    if name == "axle_positions":
        return BOGIE if value == _bogie(values["suspension"]) else OWN
    known = (key for key, each in _catalogue(name).items() if each == value)
    return next(known, OWN)


def choose(name, key, values):
    """Return what a choice changes.

    Parameters
    ----------
    name : str
        A key of :data:`OFF`.
    key : str
        A value of :data:`CHOICES`.
    values : mapping
        Suspension, positions and ground as they are, by name.

    Returns
    -------
    dict
        New values by name; with another vehicle the axles of its bogie come too.
    """
    if name == "axle_positions":
        return {name: _bogie(values["suspension"]) if key == BOGIE else ONE_AXLE}
    value = _catalogue(name).get(key)
    if name == "suspension" and chosen("axle_positions", values) == BOGIE:
        return {name: value, "axle_positions": _bogie(value)}
    return {name: value}


def _catalogue(name):
    if name == "ground":
        return tig.GROUNDS
    return {key: vehicle.suspension for key, vehicle in tig.VEHICLES.items()}


def _bogie(suspension):
    """Return the positions of a bogie's axles under a suspension [m]."""
    of_kind = (vehicle for vehicle in tig.VEHICLES.values() if vehicle.suspension == suspension)
    return 0.0, next(of_kind, tig.VEHICLES[DEFAULT_VEHICLE]).wheelbase


NUMBERS_SEPARATOR = "_"


def written(name, values):
    """Return a value as a short text: the name of its entry in the catalogue, or its numbers [SI units]."""
    key = NONE if name == "axle_positions" else chosen(name, values)
    if key not in (NONE, OWN):
        return key
    value = values[name]
    if name == "axle_positions":
        numbers = value
    else:
        numbers = [each for each in vars(value).values() if each is not None]
    return NUMBERS_SEPARATOR.join(map(repr, numbers))


def read(name, text):
    """Return what a text means, as :func:`written` gives it.

    Raises
    ------
    ValueError
        If it means nothing; a :class:`trackig_core.DesignError` if its numbers are beyond their ranges.
    """
    if name != "axle_positions" and text in _catalogue(name):
        return _catalogue(name)[text]
    numbers = [float(each) for each in text.split(NUMBERS_SEPARATOR)]
    if name == "axle_positions":
        return tuple(numbers)
    kind, counts = (tig.Ground, (3,)) if name == "ground" else (tig.Suspension, (3, 6))
    if len(numbers) not in counts:
        raise ValueError(f"{name}: give the name of an entry, or {counts[-1]} numbers")
    return kind(*numbers)


def text(design, name):
    """Return what a design has of vehicle, axles or ground, in words for tables and reports."""
    values = {each: getattr(design, each) for each in OFF}
    key = chosen(name, values)
    if name == "axle_positions":
        at = ", ".join(quantity_text(each) for each in design.axle_positions)
        return "one wheel" if key == NONE else f"at {at} m, {_roughness(design)}"
    if key == NONE:
        return "rigid" if name == "ground" else "unsprung wheel"
    return _own_text(values[name]) if key == OWN else f"{key} (generic)"


def _own_text(value):
    """Return the figures of a suspension or ground that no entry of the catalogue gives, in words."""
    if isinstance(value, tig.Ground):
        return f"own: {_spring_text(value.stiffness, value.damping)}, {quantity_text(value.mass)} kg"
    primary = _spring_text(value.primary_stiffness, value.primary_damping)
    words = f"own: primary {primary}; bogie {quantity_text(value.bogie_mass)} kg"
    if value.body_mass is None:
        return words
    secondary = _spring_text(value.secondary_stiffness, value.secondary_damping)
    return f"{words}; secondary {secondary}; body {quantity_text(value.body_mass)} kg"


def _spring_text(stiffness, damping):
    """Return a stiffness [N/m] and a dashpot [N s/m] in words."""
    return (
        f"{quantity_text(stiffness / NEWTON_PER_METRE)} kN/mm, {quantity_text(damping / KILONEWTON)} kN s/m"
    )


def sentence(design):
    """Return what stands on a design and what it stands on, in words, without a full stop."""
    count = len(design.axle_positions)
    wheels = "one wheel" if count == 1 else f"{count} wheels {text(design, 'axle_positions')}"
    vehicle = "unsprung mass only" if design.suspension is None else f"vehicle: {text(design, 'suspension')}"
    ground = "rigid ground" if design.ground is None else f"ground that yields: {text(design, 'ground')}"
    return f"{wheels}; {vehicle}; {ground}"


def _roughness(design):
    if design.speed is None:
        return "independent roughness"
    return f"same roughness at {quantity_text(3.6 * design.speed)} km/h"


def is_simplified(design):
    """Return whether a design is the paper's simplified model: nothing stands here but one wheel."""
    return all(getattr(design, name) == value for name, value in OFF.items())
