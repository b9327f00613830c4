"""A study: what a workshop found, as one object that is kept as one TOML file."""

from dataclasses import dataclass, field

from trackig_core.decide.questions import Answer
from trackig_core.levels.measured_gain import MeasuredGain
from trackig_core.levels.source import SourceSpectrum
from trackig_core.levels.specification import Specification
from trackig_core.names import LONGEST_TITLE, allowed, brief, is_name
from trackig_core.study import toml_format
from trackig_core.study.records import PinnedDesign, StaticLoad, StudyError, View, check_kind, check_preset
from trackig_core.track.design import TrackDesign
from trackig_core.words import counted

MOST_BYTES = toml_format.MOST_BYTES
"""Size that a file may have [bytes]."""

MOST_MEASURED = 4
"""Curves from elsewhere that a study may have [-]."""


@dataclass(frozen=True)
class Study:
    """All that is kept and shared.

    Parameters
    ----------
    design : TrackDesign
        The current design.
    pinned : iterable of PinnedDesign
        Up to eight designs beside it.
    specification : Specification or None
        What the designs have to meet.
    source : SourceSpectrum or None
        Levels on the reference track.
    view : View
        How insertion gain is computed and compared.
    name : str
        What the study is called.
    preset : str or None
        Key of ``PRESETS`` from which the current design departs, if from any.
    answers : iterable of Answer
        Questions that were asked about designs, and what came out.
    measured : iterable of MeasuredGain
        Up to four curves from elsewhere, beside those computed.
    load : StaticLoad
        The wheels that stand on every design.

    Raises
    ------
    StudyError
        If a value is not allowed.
    """

    design: TrackDesign
    pinned: tuple[PinnedDesign, ...] = ()
    specification: Specification | None = None
    source: SourceSpectrum | None = None
    view: View = field(default_factory=View)
    name: str = toml_format.UNTITLED
    preset: str | None = None
    answers: tuple[Answer, ...] = ()
    measured: tuple[MeasuredGain, ...] = ()
    load: StaticLoad = field(default_factory=StaticLoad)

    def __post_init__(self) -> None:
        """Check every value once."""
        if not is_name(self.name, LONGEST_TITLE):
            raise StudyError(f"{brief(self.name)}: give {allowed(LONGEST_TITLE)}", "name")
        object.__setattr__(self, "pinned", tuple(self.pinned))
        check_kind(self.design, TrackDesign, "design")
        check_kind(self.view, View, "view")
        check_kind(self.load, StaticLoad, "load")
        for number, pinned in enumerate(self.pinned):
            check_kind(pinned, PinnedDesign, f"pinned[{number}]")
            if pinned.colour is None:
                raise StudyError(
                    "None: only the current design has no colour of its own", f"pinned[{number}].colour"
                )
        object.__setattr__(self, "answers", tuple(self.answers))
        for number, answer in enumerate(self.answers):
            check_kind(answer, Answer, f"answers[{number}]")
        if self.specification is not None:
            check_kind(self.specification, Specification, "specification")
        if self.source is not None:
            check_kind(self.source, SourceSpectrum, "source")
        if self.view.base is not None and self.view.base >= len(self.pinned):
            raise StudyError(f"{self.view.base}: there is no such pinned design", "view.base")
        check_preset(self.preset)
        object.__setattr__(self, "measured", tuple(self.measured))
        if len(self.measured) > MOST_MEASURED:
            raise StudyError(f"{len(self.measured)} curves: give at most {MOST_MEASURED}", "measured")
        for number, gain in enumerate(self.measured):
            check_kind(gain, MeasuredGain, f"measured[{number}]")

    @classmethod
    def from_toml(cls, data: str | bytes) -> "Study":
        """Read a file.

        Parameters
        ----------
        data : str or bytes
            What the file holds.

        Returns
        -------
        Study
            The study.

        Raises
        ------
        StudyError
            If the file cannot be used; the message says where and why.
        """
        return cls(**toml_format.read(data))

    def to_toml(self) -> str:
        """Return the study as a file (str), which :meth:`from_toml` reads back exactly.

        Raises
        ------
        StudyError
            If the file would be too large to be read back.
        """
        text = toml_format.written(self)
        size = len(text.encode())
        if size > MOST_BYTES:
            raise StudyError(
                f"the file would have {size // 1024} kB, and {MOST_BYTES // 1024} kB can be read back: "
                "thin out the measured tables, or pin fewer designs that have one"
            )
        return text

    def __str__(self) -> str:
        """Return name and design, and what else there is."""
        there = [counted(len(self.pinned), "pinned design"), counted(len(self.answers), "answer")]
        named = [each.name for each in (self.specification, self.source) if each is not None]
        return f"{self.name}: {self.design}; {', '.join([*there, *named])}"
