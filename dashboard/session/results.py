"""What was computed of the current design: the last picture, and how the solver fares."""

import dataclasses
from dataclasses import dataclass

import numpy as np
import param

import trackig_core as tig
from dashboard import theme
from dashboard.fields import KILONEWTON


@dataclass(frozen=True, eq=False)
class SolutionSummary:
    """What the views show of one solution: all of it but the force under every single support.

    Attributes
    ----------
    solution : trackig_core.Solution
        The solution without its time history, which is a hundred times larger than the rest.
    time : numpy.ndarray (samples,) or None [s]
        Time since the step in contact compression; None, as are the next three, when nothing was stepped
        in time.
    loaded_support_force, total_force : numpy.ndarray (samples,) or None [kN]
        Force into the ground under the wheel, and summed over all supports.
    step : float or None [mm]
        Height of the step.
    seconds : float [s]
        How long the solver took.
    shown : trackig_core.TrackDesign or None
        The design that is shown, where its static stiffnesses differ from those of the solution; None: the
        solution's.
    """

    solution: tig.Solution
    time: np.ndarray | None
    loaded_support_force: np.ndarray | None
    total_force: np.ndarray | None
    step: float | None
    seconds: float
    shown: tig.TrackDesign | None = None

    @classmethod
    def of(cls, solution, seconds):
        """Return what is shown of a solution that took some time [s]."""
        if solution.history is None:
            return cls(solution, None, None, None, None, seconds)
        return cls(
            solution=dataclasses.replace(solution, history=None),
            time=solution.time,
            loaded_support_force=solution.loaded_support_force / KILONEWTON,
            total_force=solution.total_force / KILONEWTON,
            step=1000 * solution.history.step,
            seconds=seconds,
        )

    @property
    def design(self):
        """The design that was solved, with its static stiffnesses: the solution does without them."""
        return self.solution.design if self.shown is None else self.shown

    def of_design(self, design):
        """Return the same picture, of a design that differs in nothing but static stiffnesses."""
        return self if design == self.design else dataclasses.replace(self, shown=design)


@dataclass(frozen=True, eq=False)
class DesignResult:
    """One design with its name and look, and what was computed of it.

    Attributes
    ----------
    pinned : trackig_core.PinnedDesign
        The design, pinned or current.
    summary : SolutionSummary or None
        Its last good solution; None while there is none.
    gain : trackig_core.InsertionGain or None
        Its insertion gain by the definition in force, in the paper's bands; None while there is no solution.
    verdict : trackig_core.Verdict or None
        How it fares against the specification, if there is one.
    level : trackig_core.TrackLevel or None
        What the source becomes with it, if there is one.
    statics : trackig_core.StaticResponse or None
        How it carries the standing wheels; None while there is no solution.
    gain_shown : trackig_core.InsertionGain or None
        The same in the bands that are shown and written; None: in the paper's.
    """

    pinned: tig.PinnedDesign
    summary: SolutionSummary | None = None
    gain: tig.InsertionGain | None = None
    verdict: tig.Verdict | None = None
    level: tig.TrackLevel | None = None
    statics: tig.StaticResponse | None = None
    gain_shown: tig.InsertionGain | None = None

    @property
    def key(self):
        """Key of its pin; None for the current design."""
        return self.pinned.key

    @property
    def name(self):
        """What it is called: text of a user's, which nothing may take for markup."""
        return self.pinned.name

    @property
    def shown(self):
        """Whether it is drawn."""
        return self.pinned.shown

    @property
    def design(self):
        """The design (trackig_core.TrackDesign)."""
        return self.pinned.design

    @property
    def colour(self):
        """Colour of its curves in every plot."""
        return theme.look(self.pinned.colour)[0]

    @property
    def dash(self):
        """Dash of its curves in every plot [px]; empty: solid."""
        return theme.look(self.pinned.colour)[1]

    @property
    def levels(self):
        """Insertion gain in the paper's bands (21,) [dB], or None while there is no solution."""
        return None if self.gain is None else self.gain.levels

    @property
    def shown_gain(self):
        """Insertion gain in the bands that are shown, or None while there is no solution."""
        return self.gain_shown or self.gain

    @property
    def extrapolated_bands(self):
        """Labels of the bands that rest on extrapolation of what was measured of it (tuple of str)."""
        return () if self.summary is None else self.summary.solution.extrapolated_bands


@dataclass(frozen=True, eq=False)
class VerifiedSummary:
    """A picture, and what theory says of it.

    Attributes
    ----------
    summary : SolutionSummary
        What was checked.
    theory : trackig_core.Verification or None
        Exact answers and convergence studies; None if there are none.
    problem : str
        Why there are none, else empty.
    """

    summary: SolutionSummary
    theory: tig.Verification | None
    problem: str = ""


class Outcome(param.Parameterized):
    """The last good picture, how the solver fares, and what theory says of the picture."""

    summary = param.ClassSelector(
        class_=SolutionSummary, default=None, allow_None=True, doc="Last good solution."
    )
    preset_summary = param.ClassSelector(
        class_=SolutionSummary,
        default=None,
        allow_None=True,
        doc="The preset's, while the design is modified.",
    )
    busy = param.Boolean(default=False, doc="Whether a solution is awaited.")
    compiling = param.Boolean(default=False, doc="Whether the solver is still being compiled.")
    progress = param.Number(
        default=None, bounds=(0, 1), allow_None=True, doc="Part of a long run that is done; None when short."
    )
    from_cache = param.Boolean(default=False, doc="Whether the picture was there already.")
    verified = param.ClassSelector(
        class_=VerifiedSummary,
        default=None,
        allow_None=True,
        doc="The picture that was last compared with theory.",
    )
    problem = param.String(default="", doc="Why the picture is not that of the inputs; empty when it is.")

    asked = param.Parameter(default=None, doc="The design whose run is long, was stopped, or failed.")

    @property
    def stale(self):
        """Whether the picture is that of earlier inputs, and will be for a while."""
        lasts = bool(self.problem) or self.progress is not None
        return lasts and (self.summary is None or self.summary.design != self.asked)
