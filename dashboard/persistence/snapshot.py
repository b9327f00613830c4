"""All that a session holds, as a link and as a study, and back.

What is opened is checked as a whole before anything changes, and then replaces everything.
"""

import param

import trackig_core as tig
from dashboard.fields import INPUTS
from dashboard.persistence import link, studies
from dashboard.session.answers import Answers
from dashboard.session.bands import PAPER
from dashboard.session.boxes import Boxes
from dashboard.session.steps import Steps


class SessionSnapshot(param.Parameterized):
    """The parts of a session whose state is kept and shared.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.
    definition : GainDefinition
        Which insertion gain is shown.
    pins : Pins
        The pinned designs.
    assessment : Assessment
        Specification, source and the study's name.
    tabs : iterable of str
        Names of the page's tabs, in small letters; the first is open.

    Attributes
    ----------
    steps : Steps
        What of it can be undone.
    answers : Answers
        Questions that were asked, and what came out.
    boxes : Boxes
        What stands in boxes and is part of no link and no study.
    """

    tab = param.Selector(objects=[""], doc="The tab that is open.")

    def __init__(self, inputs, definition, pins, assessment, tabs=("explore",)):
        super().__init__()
        self.inputs, self.definition, self.pins, self.assessment = inputs, definition, pins, assessment
        self.steps = Steps(inputs, definition, pins, assessment)
        self.answers, self.boxes = Answers(), Boxes()
        self.param.tab.objects = list(tabs)
        self.tab = self.param.tab.objects[0]

    def watch(self, callback):
        """Call back whenever anything changes that is kept."""
        self.inputs.param.watch(callback, list(INPUTS))
        self.definition.param.watch(callback, list(link.VIEW_CHOICES))
        self.pins.param.watch(callback, ["pinned", "base", "alone"])
        self.assessment.param.watch(callback, ["specification", "source", "measured", "title"])
        self.answers.param.watch(callback, "kept")
        self.boxes.param.watch(callback, "typed")
        self.param.watch(callback, "tab")

    @property
    def _view(self):
        return {name: getattr(self.definition, name) for name in link.VIEW_CHOICES}

    @property
    def _base(self):
        """Number of the pin from which differences are taken, counted from 0, or None."""
        keys = [pin.key for pin in self.pins.pinned]
        return keys.index(self.pins.base) if self.pins.base in keys else None

    def query(self):
        """Return the query string of a link to what is on the page; it holds no specification or source."""
        chosen = {name: each for name, each in self._view.items() if each != PAPER}
        view = {**chosen, "alone": str(int(self.pins.alone)), "tab": self.tab}
        return link.encode(self.inputs.to_values(), view, self.pins.pinned, self._base)

    @property
    def left_out(self):
        """What a link leaves out of all that a study file holds, in words; empty if it holds everything."""
        assessment = self.assessment
        beside = {
            "the specification": assessment.specification,
            "the source spectrum": assessment.source,
            "insertion gain from elsewhere": assessment.measured,
            "the kept answers": self.answers.kept,
            "the name of the study": assessment.title != tig.Study.name,
        }
        held = [*link.left_out(self.inputs.to_values(), self.pins.pinned)]
        return ", ".join([*held, *(words for words, there in beside.items() if there)])

    def study(self):
        """Return everything as a study (trackig_core.Study)."""
        return studies.to_study(
            self.inputs.to_values(),
            self._view,
            self.pins.pinned,
            self._base,
            self.assessment.specification,
            self.assessment.source,
            self.assessment.title,
            self.assessment.measured,
            self.answers.kept,
        )

    def follow(self, arguments):
        """Set what a link holds, whatever it holds.

        Parameters
        ----------
        arguments : mapping of str to list of bytes
            The query's arguments as the server hands them on.

        Returns
        -------
        tuple of str
            What was ignored, in words for the user.
        """
        choices = {**link.VIEW_CHOICES, "alone": ("0", "1"), "tab": tuple(self.param.tab.objects)}
        found = link.decode(arguments, choices)
        view = dict(found.view)
        self.tab = view.pop("tab", self.tab)
        alone = view.pop("alone", "0") == "1"
        self._set(found.values, found.pins, found.base, view)
        self.pins.alone = alone and bool(found.pins)
        self.steps.restart()
        return found.problems

    def open(self, data):
        """Replace everything by the study that a file holds.

        Parameters
        ----------
        data : str or bytes
            What the file holds.

        Raises
        ------
        trackig_core.StudyError
            If the file holds no study, or one that the page cannot show; then nothing has changed.
        """
        opened = studies.from_study(tig.Study.from_toml(data))
        with self.steps.as_one():
            self._set(opened.values, opened.pins, opened.base, opened.view)
            self.assessment.param.update(
                specification=opened.specification,
                source=opened.source,
                measured=opened.measured,
                title=opened.name,
            )
        self.answers.replace_all(opened.answers)

    def _set(self, values, pins, base, view):
        self.pins.replace_all(pins, base)
        self.definition.param.update(**view)
        self.inputs.take(values)
