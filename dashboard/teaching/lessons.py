"""Guided lessons: Markdown files that set sliders, ask what will happen, and reveal what the solver found.

A lesson is one file in the lessons' folder; whoever can write Markdown can add one:

    +++
    title = "Stiffness"
    order = 1
    claims = ["insertion_gain(63) falls by at least 3 dB"]

    [start]                                  # where the sliders begin, in their own units
    preset = "booted-block-low-mass"

    [set]                                    # what the student changes
    boot_stiffness = 14

    [predict]
    question = "What happens to the loaded-track frequency?"
    choices = [                              # the right one is the one whose claim the solver finds true
      { text = "It falls", when = "loaded_track falls by at least 5 %" },
      { text = "It rises", when = "loaded_track rises by at least 5 %" },
    ]
    +++
    What the student reads first.

    ## Reveal

    What came of it: the frequency {{ percent loaded_track }}.

Figures in braces and claims are those of :mod:`dashboard.teaching.quantities`. Files are taken as hostile:
bounded in size and number, read as TOML and text, and their Markdown is to be rendered with HTML disabled;
titles, questions and choices are plain text. A broken lesson gives a message that names file
and line, never an exception to the page, and a lesson that the solver contradicts says so.
"""

import difflib
import re
import tomllib
from dataclasses import dataclass, field

import param

import trackig_core as tig
from dashboard import assets
from dashboard.fields import PHYSICAL, SURROUNDINGS
from dashboard.session.inputs import DesignInputs, values_of
from dashboard.teaching.quantities import QuantityError, read_claim, read_placeholder

LARGEST_FILE = 32_768
"""Bytes that a lesson may have [-]."""

MOST_LESSONS = 40
"""Files that are read from a folder [-]."""

MOST_FIGURES = 60
"""Placeholders, and claims, that a lesson may have [-]."""

FENCE = "+++"
"""The line before and after a lesson's front matter."""

REVEAL = "## Reveal"
"""The line that parts what the student reads first from what is revealed."""

_FIGURE = re.compile(r"\{\{([^{}\n]*)\}\}")
_TOML_LINE = re.compile(r"\(at line (\d+)")
_KEYS = {"title", "order", "claims", "start", "set", "predict"}


class LessonError(ValueError):
    """A lesson cannot be shown as it is.

    Attributes
    ----------
    file : str
        Name of the file.
    line : int or None
        Line at fault, counted from 1; None when it is the lesson as a whole.
    problem : str
        What is wrong and what to do.
    """

    def __init__(self, file, line, problem):
        self.file, self.line, self.problem = file, line, problem
        super().__init__(f"{file if line is None else f'{file}, line {line}'}: {problem}")

    def __reduce__(self):
        """Let the error pass between processes."""
        return type(self), (self.file, self.line, self.problem)


@dataclass(frozen=True)
class Choice:
    """One answer to a lesson's question.

    Attributes
    ----------
    text : str
        The answer, plain text.
    when : str
        The claim that makes it right.
    """

    text: str
    when: str


@dataclass(frozen=True)
class Lesson:
    """One lesson, read and checked, but not yet solved.

    Attributes
    ----------
    file : str
        Name of its file.
    title : str
        Plain text.
    order : float
        Lessons are shown in ascending order.
    start, change : dict
        Sliders at the start, a preset among them, and those that the student then sets [display units].
    question : str
        Plain text.
    choices : tuple of Choice
        Answers.
    claims : tuple of str
        What else the solver must find true.
    introduction, reveal : str
        Markdown with figures in braces.
    """

    file: str
    title: str
    order: float
    start: dict = field(hash=False)
    change: dict = field(hash=False)
    question: str
    choices: tuple[Choice, ...]
    claims: tuple[str, ...]
    introduction: str
    reveal: str

    def designs(self):
        """Return the designs before and after the change (two trackig_core.TrackDesign)."""
        inputs = DesignInputs()
        set_sliders(inputs, self.start)
        before = inputs.to_design()
        set_sliders(inputs, self.change)
        return before, inputs.to_design()


@dataclass(frozen=True)
class Revealed:
    """A lesson as the solver completes it.

    Attributes
    ----------
    introduction, reveal : str
        Markdown; a figure that could not be computed is a question mark.
    right : tuple of bool
        Which choices are right: exactly one, unless there are problems.
    problems : tuple of LessonError
        Figures without a value and claims that the solver finds false.
    """

    introduction: str
    reveal: str
    right: tuple[bool, ...]
    problems: tuple[LessonError, ...]


def load_lessons(folder=assets.LESSONS):
    """Read every lesson of a folder.

    Parameters
    ----------
    folder : pathlib.Path, optional
        Where ``*.md`` files lie.

    Returns
    -------
    lessons : tuple of Lesson
        Lessons that can be shown, in their order.
    problems : tuple of LessonError
        One per file that cannot.
    """
    files = sorted(folder.glob("*.md"))
    if not files:
        return (), (LessonError(folder.name, None, "no lessons here: add files that end in .md"),)
    lessons, problems = [], []
    for file in files[:MOST_LESSONS]:
        try:
            lessons.append(read_lesson(file))
        except LessonError as error:
            problems.append(error)
    if len(files) > MOST_LESSONS:
        left = files[MOST_LESSONS].name
        problems.append(LessonError(left, None, f"not read: at most {MOST_LESSONS} lessons are; remove some"))
    return tuple(sorted(lessons, key=lambda lesson: (lesson.order, lesson.file))), tuple(problems)


def read_lesson(file):
    """Read one lesson.

    Parameters
    ----------
    file : pathlib.Path
        The file.

    Returns
    -------
    Lesson
        The lesson, its figures and claims readable and its sliders within their ranges.

    Raises
    ------
    LessonError
        If it cannot be read or shown; names file and line.
    """
    if not file.is_file():  # a pipe would never end
        raise LessonError(file.name, None, "no file: only files are read")
    try:
        with file.open("rb") as opened:
            raw = opened.read(LARGEST_FILE + 1)
    except OSError as error:
        raise LessonError(file.name, None, f"cannot be opened: {error.strerror}") from None
    if len(raw) > LARGEST_FILE:
        raise LessonError(file.name, None, f"larger than {LARGEST_FILE} bytes: shorten it")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise LessonError(file.name, line, "not UTF-8 text: save it as UTF-8") from None
    return parse_lesson(text, file.name)


def parse_lesson(text, file):
    """Read a lesson from its text.

    Parameters
    ----------
    text : str
        What the file holds.
    file : str
        Its name, for messages.

    Returns
    -------
    Lesson
        The lesson.

    Raises
    ------
    LessonError
        If it cannot be shown; names file and line.
    """
    return _Reader(text.replace("\r\n", "\n"), file).lesson()


def set_sliders(inputs, values):
    """Set the sliders of a lesson; all others stay, unless a preset is among the values.

    Parameters
    ----------
    inputs : DesignInputs
        The sliders; changed.
    values : dict
        Values by name [display units].
    """
    preset = values.get("preset")
    published = {} if preset is None else values_of(tig.PRESETS[preset], preset)
    inputs.take(published | values)


def reveal(lesson):
    """Solve a lesson's two designs, fill in its figures and judge its choices and claims.

    Parameters
    ----------
    lesson : Lesson
        The lesson.

    Returns
    -------
    Revealed
        Texts, the right choice, and what is wrong with the lesson, if anything.
    """
    before, after = lesson.designs()
    problems = []

    def fill(found):
        try:
            return read_placeholder(found[1])(before, after)
        except QuantityError as error:
            problems.append(LessonError(lesson.file, None, str(error)))
            return "?"

    def judged(claim):
        try:
            return bool(read_claim(claim)(before, after))
        except QuantityError as error:
            problems.append(LessonError(lesson.file, None, str(error)))
            return None

    texts = [_FIGURE.sub(fill, text) for text in (lesson.introduction, lesson.reveal)]
    right = tuple(judged(choice.when) is True for choice in lesson.choices)
    if sum(right) != 1:
        problem = f"the solver finds {sum(right)} choices true: mend their claims so that exactly one is"
        problems.append(LessonError(lesson.file, None, problem))
    false = [claim for claim in lesson.claims if judged(claim) is False]
    problems += [
        LessonError(lesson.file, None, f"the solver finds this claim false: '{claim}'") for claim in false
    ]
    return Revealed(*texts, right, tuple(problems))


class _Reader:
    """Reads one lesson and knows at which line it stands."""

    def __init__(self, text, file):
        self._file, self._lines = file, text.split("\n")

    def lesson(self):
        """Return the lesson."""
        front, body = self._parts()
        for key in front:
            if key not in _KEYS:
                near = difflib.get_close_matches(key, _KEYS, n=1)
                hint = near[0] if near else ", ".join(sorted(_KEYS))
                raise self._error(f"'{key}' means nothing here: give {hint}", key)
        start, change = self._sliders(front, "start"), self._sliders(front, "set")
        if "preset" not in start:
            raise self._error(f"[start] has no preset: give one of {', '.join(tig.PRESETS)}", "start")
        question, choices = self._predict(self._value(front, "predict", dict, "a table [predict]"))
        introduction, revealed = self._texts_of(body)
        order = self._value(front, "order", (int, float), "a number")
        if not abs(order) < 1e6:
            raise self._error("order is not below a million: give a number such as 1", "order")
        lesson = Lesson(
            file=self._file,
            title=self._plain(front, "title", 100),
            order=order,
            start=start,
            change=change,
            question=question,
            choices=choices,
            claims=self._claims(front),
            introduction=introduction,
            reveal=revealed,
        )
        self._check_sliders(lesson)
        return lesson

    def _error(self, problem, at=1):
        """Return an error at a line, or at the line on which a key or text first stands."""
        if isinstance(at, str):
            at = next((number for number, line in enumerate(self._lines, 1) if at in line), 1)
        return LessonError(self._file, at, problem)

    def _parts(self):
        """Return the front matter as a dict and the number of the line on which the body begins."""
        fences = [number for number, line in enumerate(self._lines) if line.rstrip() == FENCE][:2]
        if len(fences) < 2 or fences[0] != 0:
            raise self._error(f"no front matter: begin with a line {FENCE}, and end it with another")
        # the empty first line stands for the fence, so that lines count as in the file
        front = "\n".join(["", *self._lines[1 : fences[1]]])
        try:
            return tomllib.loads(front), fences[1] + 1
        except tomllib.TOMLDecodeError as error:
            found = _TOML_LINE.search(str(error))
            said = _TOML_LINE.split(str(error))[0].strip()
            problem = f'not TOML: {said}; write name = value, with values such as "text", 28 or true'
            raise self._error(problem, int(found[1]) if found else fences[1] + 1) from None
        except RecursionError:
            raise self._error("front matter nested too deep: write plain keys and tables") from None

    def _value(self, table, key, kinds, wanted):
        value = table.get(key)
        if value is None or not isinstance(value, kinds) or isinstance(value, bool):
            raise self._error(f"{key} = {str(value)[:40]!r}: give {wanted}", key)
        return value

    def _plain(self, table, key, longest):
        value = self._value(table, key, str, "a text in quotes").strip()
        if not 1 <= len(value) <= longest or not value.isprintable():
            raise self._error(f"{key}: give one line of 1 to {longest} characters", key)
        return value

    def _sliders(self, front, key):
        values = self._value(front, key, dict, f"a table [{key}] of sliders and their values")
        if not values:
            raise self._error(f"[{key}] is empty: name a slider and its value", f"[{key}]")
        names = ("preset", *(each for each in PHYSICAL if each not in SURROUNDINGS))
        for name in values:
            if name not in names:
                near = difflib.get_close_matches(name, names, n=1)
                raise self._error(
                    f"'{name}' is no slider: give {near[0] if near else ', '.join(names)}", name
                )
            self._check_slider(name, values[name])
        return values

    def _check_slider(self, name, value):
        about = DesignInputs.param[name]
        if isinstance(about, param.Selector):
            known, allowed = value in about.objects, f"one of {', '.join(map(str, about.objects))}"
        elif isinstance(about, param.Boolean):
            known, allowed = isinstance(value, bool), "true or false"
        else:
            low, high = about.bounds
            number = isinstance(value, (int, float)) and not isinstance(value, bool)
            known = number and low <= value <= high
            allowed = f"a number from {low:g} to {high:g} ({about.label})"
        if not known:
            raise self._error(f"{name} = {str(value)[:40]!r}: give {allowed}", name)

    def _check_sliders(self, lesson):
        try:
            before, after = lesson.designs()
        except tig.DesignError as error:
            raise self._error(str(error), "[set]") from None
        if before == after:
            raise self._error("nothing changes: [set] must move a slider from where [start] puts it", "[set]")

    def _predict(self, table):
        question = self._plain(table, "question", 300)
        given = self._value(table, "choices", list, "a list of { text, when }")
        if not 2 <= len(given) <= 6:
            raise self._error("choices: give two to six", "choices")
        choices = []
        for choice in given:
            if not isinstance(choice, dict) or set(choice) != {"text", "when"}:
                raise self._error(
                    'a choice needs a text and a claim: { text = "...", when = "..." }', "choices"
                )
            choices.append(Choice(self._plain(choice, "text", 200), self._claim(choice["when"])))
        return question, tuple(choices)

    def _claims(self, front):
        given = front.get("claims", [])
        if not isinstance(given, list) or len(given) > MOST_FIGURES:
            raise self._error(f"claims: give a list of at most {MOST_FIGURES} texts", "claims")
        return tuple(self._claim(claim) for claim in given)

    def _claim(self, claim):
        if not isinstance(claim, str):
            raise self._error(f"{str(claim)[:40]!r} is no claim: give a text in quotes", str(claim)[:40])
        try:
            read_claim(claim)
        except QuantityError as error:
            raise self._error(str(error), claim) from None
        return claim

    def _texts_of(self, begin):
        """Return introduction and reveal, each figure readable."""
        headings = [n for n in range(begin, len(self._lines)) if self._lines[n].strip() == REVEAL]
        if len(headings) != 1:
            raise self._error(
                f"{len(headings)} lines '{REVEAL}': write it once, before what is revealed", begin + 1
            )
        count = 0
        for number in range(begin, len(self._lines)):
            for found in _FIGURE.finditer(self._lines[number]):
                count += 1
                if count > MOST_FIGURES:
                    raise self._error(f"more than {MOST_FIGURES} figures: leave some out", number + 1)
                try:
                    read_placeholder(found[1])
                except QuantityError as error:
                    raise self._error(str(error), number + 1) from None
        parts = self._lines[begin : headings[0]], self._lines[headings[0] + 1 :]
        texts = tuple("\n".join(lines).strip() for lines in parts)
        if not all(texts):
            raise self._error(f"nothing to read: write a text before and after '{REVEAL}'", headings[0] + 1)
        return texts
