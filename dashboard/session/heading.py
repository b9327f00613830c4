"""What every file that leaves the page says of itself: study, design, definition, solution, date, version."""

import datetime
from dataclasses import dataclass

import trackig_core as tig
from dashboard import formats
from dashboard.fields import PRESET_LABELS
from dashboard.session.bands import bands_text
from dashboard.session.pins import THIS_DESIGN
from trackig_core.levels.insertion_gain import reference_for


@dataclass(frozen=True)
class Heading:
    """What a file says of itself.

    Attributes
    ----------
    study : str
        What the study is called.
    design : str
        What the design is called that the file is about, the first if there are several.
    definition : str
        Which insertion gain is meant.
    fidelity : str
        How the solutions were obtained.
    date : datetime.date
        The day.
    version : str
        Version of the software.
    bands : str
        Which bands are shown, and what they cost in validity; empty of the paper's.
    """

    study: str
    design: str
    definition: str
    fidelity: str
    date: datetime.date
    version: str
    bands: str = ""

    @classmethod
    def of(cls, study, results, date):
        """Return what a file says that shows results of a study.

        Parameters
        ----------
        study : trackig_core.Study
            The study.
        results : sequence of DesignResult
            Designs with a solution, one or more.
        date : datetime.date
            The day.
        """
        first = results[0]
        return cls(
            study=study.name,
            design=current_name(study) if first.key is None else first.name,
            definition=formats.definition_text(
                study.view.summation, reference_for(first.design, study.view.reference)
            ),
            bands=bands_text(study.view.bands),
            fidelity=formats.fidelities_text(each.summary.solution.fidelity for each in results),
            date=date,
            version=tig.__version__,
        )

    @classmethod
    def of_question(cls, study, question, design, date):
        """Return what a file says that holds an answer.

        Parameters
        ----------
        study : trackig_core.Study
            The study.
        question : trackig_core.decide.Question
            What was asked; answers are of the frequency-domain solution and of the paper's bands.
        design : str
            What the design is called that was asked about.
        date : datetime.date
            The day.
        """
        return cls(
            study=study.name,
            design=design,
            definition=formats.definition_text(question.summation, question.reference),
            fidelity=formats.FIDELITIES["exact"],
            date=date,
            version=tig.__version__,
        )

    @property
    def day(self):
        """The date in words."""
        return f"{self.date.day} {self.date:%B %Y}"

    @property
    def in_bands(self):
        """The bands that are shown, to be put after the definition; empty of the paper's."""
        return f"; {self.bands}" if self.bands else ""

    @property
    def track_lines(self):
        """What of it concerns a track without its wheel, a line of text each."""
        of_wheel = ("insertion gain:", "bands:", "solution:")
        return tuple(each for each in self.lines if not each.startswith(of_wheel))

    @property
    def lines(self):
        """All of it, a line of text each."""
        return (
            f"study: {self.study}",
            f"design: {self.design}",
            f"insertion gain: {self.definition}",
            *([f"bands: {self.bands}"] if self.bands else []),
            f"solution: {self.fidelity}",
            f"date: {self.date.isoformat()}",
            f"trackig {self.version}",
        )


def current_name(study):
    """Return what a study's current design is called outside the page: after the preset it comes from."""
    if study.preset is None:
        return THIS_DESIGN
    label = PRESET_LABELS[study.preset]
    return label if study.design == tig.PRESETS[study.preset] else f"{label}, modified"
