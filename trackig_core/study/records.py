"""Records of a study: how insertion gain is looked at, and a design with a name and a look."""

from dataclasses import dataclass, field

from trackig_core.analysis.statics import StaticResponse, static_response
from trackig_core.bands import BANDS
from trackig_core.levels.insertion_gain import REFERENCES, SUMMATIONS
from trackig_core.names import allowed, brief, is_name
from trackig_core.track.catalogue import PRESETS
from trackig_core.track.design import TrackDesign
from trackig_core.track.fields import DEFAULT_WHEEL_LOAD, DesignError, check_number
from trackig_core.words import quantity


class StudyError(ValueError):
    """A study, or the file of one, cannot be used.

    Attributes
    ----------
    message : str
        What is at fault, and what to give instead.
    path : str
        Keys that lead to what is at fault, such as ``pinned[2].design.rail``; empty if the whole is.
    """

    def __init__(self, message: str, path: str = "") -> None:
        self.path, self.message = path, message
        super().__init__(f"{path}: {message}" if path else message)

    def __reduce__(self) -> tuple[type, tuple[str, str]]:
        """Let the error pass between processes."""
        return type(self), (self.message, self.path)


@dataclass(frozen=True)
class View:
    """How insertion gain is computed and compared.

    Parameters
    ----------
    summation : str
        ``"energy"`` or ``"coherent"``.
    reference : str
        ``"line"``, ``"rigid"`` or ``"stiff"``.
    base : int or None
        Number, from 0, of the pinned design from which differences are taken; None: from the current design.
    bands : str
        A key of :data:`trackig_core.bands.BANDS`: the bands that are shown and written. Limits and sources
        stay one-third octaves.

    Raises
    ------
    StudyError
        If a choice is none of these.
    """

    summation: str = "energy"
    reference: str = "line"
    base: int | None = None
    bands: str = "one-third-octave"

    def __post_init__(self) -> None:
        """Check every choice once."""
        for name, choices in (("summation", SUMMATIONS), ("reference", REFERENCES), ("bands", BANDS)):
            value = getattr(self, name)
            if value not in tuple(choices):
                raise StudyError(f"{brief(value)}: give {' or '.join(map(repr, choices))}", f"view.{name}")
        if self.base is not None:
            check_count(self.base, "view.base")

    def __str__(self) -> str:
        """Return the definition and the bands, in words."""
        return f"reference {self.reference}, summation {self.summation}, {self.bands} bands"


@dataclass(frozen=True)
class StaticLoad:
    """The wheels that stand on every design of a study.

    Parameters
    ----------
    wheel_load : float
        Load of each wheel [N].
    wheelbase : float or None
        Distance to a second wheel [m]; None: there is one wheel.

    Raises
    ------
    StudyError
        If a value is no number within its range.
    """

    wheel_load: float = DEFAULT_WHEEL_LOAD
    wheelbase: float | None = None

    def __post_init__(self) -> None:
        """Check every value once."""
        for name in ("wheel_load", "wheelbase"):
            value = getattr(self, name)
            if name == "wheelbase" and value is None:
                continue
            try:
                object.__setattr__(self, name, check_number(name, value))
            except DesignError as error:
                raise StudyError(f"{brief(value)}: give {error.allowed}", f"load.{name}") from None

    def response(self, design: TrackDesign) -> StaticResponse:
        """Return how a design carries the wheels (StaticResponse)."""
        return static_response(design, self.wheel_load, self.wheelbase)

    def __str__(self) -> str:
        """Return the wheels with their units."""
        load = quantity(self.wheel_load, "N")
        if self.wheelbase is None:
            return f"one wheel of {load}"
        return f"two wheels of {load}, {quantity(self.wheelbase, 'm')} apart"


@dataclass(frozen=True)
class PinnedDesign:
    """A design with a name and a look: the one record of a design that is shown beside others.

    Parameters
    ----------
    name : str
        What it is called.
    design : TrackDesign
        The design.
    colour : int or None
        Number, from 0, of the colour in which an interface draws it; how many colours there are is for the
        interface to know. None: that of the current design.
    shown : bool
        Whether it is drawn, reported and checked.
    preset : str or None
        Key of ``PRESETS`` from which it departs, if from any.
    key : int or None
        Tells it from all others of its session, whatever their names; None for the current design. It is no
        part of a study's file.

    Raises
    ------
    StudyError
        If a value is not allowed.
    """

    name: str
    design: TrackDesign
    colour: int | None = 0
    shown: bool = True
    preset: str | None = None
    key: int | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        """Check every value once."""
        if not is_name(self.name):
            raise StudyError(f"{brief(self.name)}: give {allowed()}", "name")
        if not isinstance(self.design, TrackDesign):
            raise StudyError(f"{brief(self.design)}: give a TrackDesign", "design")
        if self.colour is not None:
            check_count(self.colour, "colour")
        if not isinstance(self.shown, bool):
            raise StudyError(f"{brief(self.shown)}: give true or false", "shown")
        check_preset(self.preset)

    def __str__(self) -> str:
        """Return name and design."""
        return f"{self.name}: {self.design}"


def check_kind(value: object, kind: type, path: str) -> None:
    """Raise a StudyError that names the path if a value is not of a kind."""
    if not isinstance(value, kind):
        raise StudyError(f"{brief(value)}: give a {kind.__name__}", path)


def check_preset(preset: object) -> None:
    """Raise a StudyError if a value is neither None nor a key of ``PRESETS``."""
    if preset is not None and preset not in tuple(PRESETS):
        raise StudyError(f"{brief(preset)}: give {', '.join(PRESETS)}, or remove it", "preset")


def check_count(value: object, path: str) -> None:
    """Raise a StudyError that names the path if a value is no whole number, 0 or more."""
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise StudyError(f"{brief(value)}: give a whole number, 0 or more", path)
