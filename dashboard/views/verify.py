"""The tab in which the run is compared with theory, and theory with others.

Under each picture stands what it proves and what it does not; every figure in a sentence is
computed from what is drawn beside it.
"""

import numpy as np
import panel as pn
import panel_material_ui as pmui

import trackig_core as tig
from dashboard import formats, theme
from dashboard.fields import PRESET_LABELS
from dashboard.figures.verification import (
    ComparisonFigure,
    DampingFigure,
    DifferenceFigure,
    ElementFigure,
    ReceptanceFigure,
    TimeStepFigure,
)
from dashboard.views.components import PAPER, bokeh_pane, caption, gain_axis, words
from dashboard.views.idealisations import IdealisationsView
from dashboard.views.tab import Tab

FINE = tig.Lattice(elements_per_bay=24)
"""Lattice of the frequency-domain solution that is compared with an independent package."""

CURVE = np.geomspace(tig.BAND_EDGES[0], tig.BAND_EDGES[-1], 300)
"""Frequencies of smooth curves [Hz]."""


DAMPED = np.geomspace(5.0, 500.0, 200)
"""Frequencies over which damping is fitted and drawn [Hz]."""

NOTHING = np.full_like(DAMPED, np.nan)


class Verify(Tab):
    """Time stepping and frequency-domain solution, an independent package, convergence, and damping.

    Parameters
    ----------
    outcome : Outcome
        Whose checked picture is shown.
    definition : GainDefinition
        Which insertion gain is shown.
    on_look : callable
        Called with whether anybody looks: only then is anything checked.
    """

    title = "Verify"
    link_name = "verify"

    def __init__(self, outcome, definition, on_look):
        super().__init__()
        self._on_look = on_look
        self._outcome, self._definition = outcome, definition
        self.idealisations = IdealisationsView(outcome, definition)
        self.comparison = ComparisonFigure()
        self.difference = DifferenceFigure(self.comparison.bands)
        self.receptance = ReceptanceFigure()
        self.time_step = TimeStepFigure()
        self.element = ElementFigure()
        self.stiffness = DampingFigure("stiffness", "Stiffness over that at 50 Hz")
        self.loss_factor = DampingFigure("loss_factor", "Loss factor")
        figures = (
            self.comparison,
            self.difference,
            self.time_step,
            self.element,
            self.stiffness,
            self.loss_factor,
        )
        self.panes = [bokeh_pane(figure.model) for figure in figures]
        self.words = {key: words() for key in ("run", "peer", "convergence", "damping")}
        self.peer = pn.widgets.Select(
            label="Compared track of Table 1",
            options={PRESET_LABELS.get(key, key): key for key in tig.peer_receptances()},
            value=next(iter(tig.peer_receptances())),
            width=240,
            margin=(0, 12, 0, 12),
            stylesheets=[theme.SELECT_CSS],
        )
        self.peer.param.watch(self._show_peer, "value")
        outcome.param.watch(self._show, "verified")
        definition.param.watch(self._show_run, ["reference", "summation"])
        outcome.param.watch(self._dim, ["verified", "problem", "progress"])
        self._show_peer()
        self._show()
        self._dim()

    def refresh(self):
        """Have the solution checked while the tab is in sight."""
        self._on_look(self.in_sight)
        self.idealisations.look(self.in_sight)

    def _show(self, *_):
        self._show_run()
        verified = self._outcome.verified
        if verified is None or verified.theory is None:
            return
        self._show_convergence(verified)
        self._show_damping(verified.summary.solution)

    def _dim(self, *_):
        verified = self._outcome.verified
        stale = self._outcome.stale or (verified is not None and verified.theory is None)
        for pane in self.panes:
            pane.styles = theme.STALE if stale else theme.FRESH

    def _show_run(self, *_):
        verified, chosen = self._outcome.verified, self._definition
        solved = [] if verified is None else [verified.summary.design]
        self.comparison.name_axis(gain_axis(chosen, *solved))
        if verified is None:
            self.words["run"].object = "Not checked yet."
            return
        if verified.theory is None:
            self.words["run"].object = verified.problem
            return
        solution = verified.summary.solution
        run = chosen.gain(solution).levels
        exact = chosen.levels_of(verified.theory.exact, solution)
        scheme = chosen.levels_of(verified.theory.scheme, solution)
        self.comparison.show(run, exact)
        self.difference.show(run - exact)
        self.words["run"].object = (
            f"Largest difference {largest(run - exact)} between time stepping and the frequency-domain "
            "solution of the same lattice, infinitely long and in continuous time: the cost of time step and "
            "ring. From the stepping scheme on its ring, solved exactly by its z-transform: "
            f"{largest(run - scheme)}. This proves that the scheme is solved as it is written; it does not "
            "prove that rail, ground and wheel are as modelled."
        )

    def _show_peer(self, *_):
        peer = tig.peer_receptances()[self.peer.value]
        design = tig.PRESETS[self.peer.value]
        self.receptance.show(peer, CURVE, tig.receptance(design, CURVE, lattice=FINE))
        own = tig.receptance(design, peer.frequency, lattice=FINE)
        below = peer.frequency < BELOW
        gaps = np.abs(20 * np.log10(np.abs(own / peer.euler)))
        shear = 20 * np.log10(np.abs(peer.timoshenko / peer.euler))
        worst = np.argmax(np.abs(shear))
        near, farthest = formats.difference_text(gaps[below].max()), largest(gaps)
        at_5_hz, at_worst = formats.level_text(shear[0]), formats.level_text(shear[worst])
        self.words["peer"].object = (
            f"{PRESET_LABELS.get(self.peer.value, self.peer.value)} as published, whatever the sliders say: "
            "the rail's point receptance over a support, by the open-source package Rolland 26.08a1. Its "
            f"Euler rail is within {near} of trackig up to 315 Hz, and differs from it most by {farthest}, "
            "since it keeps the rail's rotary inertia. This proves rail and supports by other hands; it does "
            "not prove the beam. A rail that shears (Timoshenko) would change the receptance "
            f"by {at_5_hz} at 5 Hz and by {at_worst} at {tig.BAND_LABELS[worst]} Hz. trackig leaves shear "
            "out, and the ground is rigid for both."
        )

    def _show_convergence(self, verified):
        theory, solution = verified.theory, verified.summary.solution
        grid = solution.grid
        self.time_step.show(theory, grid.dt)
        self.element.show(theory, solution.design.fastener_spacing, grid.dx)
        time_error = np.interp(grid.dt, theory.time_steps, theory.run_errors)
        element_error = theory.element_errors[
            np.argmin(np.abs(theory.elements_per_bay - grid.elements_per_bay))
        ]
        in_time, along = formats.difference_text(time_error), formats.difference_text(element_error)
        self.words["convergence"].object = (
            "Largest error in any band (energy sum, reference line): "
            f"{in_time} at this run's time step, {along} at its {grid.elements_per_bay} elements a bay (both "
            "dash-dotted). Errors that fall along the grey slopes prove that finer grids lead to one answer: "
            "the paper's damping memory is of first order, its beam of second. They do not prove that this "
            "grid is fine enough for every question."
        )

    def _show_damping(self, solution):
        design = solution.design
        laws = {"pad": solution.pad_law, "boot": solution.boot_law}
        stiffness, loss_factor = {}, {}
        for part, law in laws.items():
            present = law is not None
            stiffness[part] = law.dynamic_stiffness(DAMPED).real / law.stiffness(50.0) if present else NOTHING
            stated = stated_spring(design, part)
            stiffness[f"{part}_stated"] = stated[0] / law.stiffness(50.0) if present else NOTHING
            loss_factor[part] = law.loss_factor(DAMPED) if present else NOTHING
            loss_factor[f"{part}_stated"] = stated[1]
        self.stiffness.show(DAMPED, **stiffness)
        self.loss_factor.show(DAMPED, **loss_factor)
        worst = max(law.worst_error for law in laws.values() if law is not None)
        ends = solution.pad_law.dynamic_stiffness([5.0, 500.0]).real / solution.pad_law.stiffness(50.0)
        self.words["damping"].object = (
            f"Three relaxation terms keep the loss factor within {worst:.1%} of the stated (thin) from 5 to "
            f"500 Hz. A causal damper stiffens with frequency: this pad from {ends[0]:.2f} of its stated "
            f"stiffness at 5 Hz to {ends[1]:.2f} at 500 Hz. This proves the fit; it does not prove that a "
            "real pad has the same loss factor at all frequencies."
        )

    def build(self):
        """Return what is put on the page."""
        comparison, difference, time_step, element, stiffness, loss_factor = self.panes
        run = pmui.Paper(
            caption("Time stepping and frequency-domain solution", ""),
            comparison,
            difference,
            self.words["run"],
            **PAPER,
        )
        peer = pmui.Paper(
            pmui.Row(
                caption("Tracks of Table 1 and an independent package", PEER_WORDS),
                pn.HSpacer(),
                self.peer,
                sizing_mode="stretch_width",
            ),
            bokeh_pane(self.receptance.model),
            self.words["peer"],
            **PAPER,
        )
        convergence = _pair("Convergence", time_step, element, self.words["convergence"])
        damping = _pair("Memory of the damping", stiffness, loss_factor, self.words["damping"])
        return pmui.Grid(
            *(pmui.Grid(each, size=12) for each in (run, peer, convergence, damping, self.idealisations)),
            container=True,
            spacing=1,
            sizing_mode="stretch_width",
            margin=(0, 8, 8, 8),
        )


PEER_WORDS = "fixed tracks: this comparison does not follow the sliders"

BELOW = 317.0
"""Frequency up to which the independent package is compared in words [Hz]: the 315 Hz band's centre."""

HALF = {"xs": 12, "lg": 6}


def stated_spring(design, part):
    """Return the stiffness [N/m] and loss factor [-] that were stated of a part, over DAMPED; NaN if not.

    Of a stiffness that is a number, only the loss factor is stated over frequency.
    """
    stiffness, loss_factor = (getattr(design, f"{part}_{what}") for what in ("stiffness", "loss_factor"))
    if isinstance(stiffness, tig.StiffnessCurve):
        return stiffness.stiffness(DAMPED), stiffness.loss_factor(DAMPED)
    if isinstance(loss_factor, tig.LossFactorCurve):
        return NOTHING, loss_factor.loss_factor(DAMPED)
    return NOTHING, NOTHING if loss_factor is None else np.full_like(DAMPED, loss_factor)


def largest(differences):
    """Return the largest of some differences per band (21,) [dB], in words."""
    band = int(np.argmax(np.abs(differences)))
    size = abs(differences[band])
    if size < formats.LEAST_DIFFERENCE:
        return f"below {formats.LEAST_DIFFERENCE:f} dB"
    return f"{formats.difference_text(size)} at {tig.BAND_LABELS[band]} Hz"


def _pair(title, left, right, words):
    """Return two figures side by side under one heading, and the words below them."""
    return pmui.Paper(
        caption(title, ""),
        pmui.Grid(
            pmui.Grid(left, size=HALF),
            pmui.Grid(right, size=HALF),
            container=True,
            sizing_mode="stretch_width",
        ),
        words,
        **PAPER,
    )
