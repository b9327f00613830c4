"""Lessons: those that ship are true by the solver, and those that are broken say where."""

import dataclasses
import re
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from dashboard.session.inputs import DesignInputs, display_values
from dashboard.teaching import lessons as module
from dashboard.teaching.lessons import (
    LARGEST_FILE,
    LessonError,
    load_lessons,
    parse_lesson,
    read_lesson,
    reveal,
    set_sliders,
)

GOOD = """+++
title = "A lesson"
order = 1
claims = ["loaded_track falls by at least 1 Hz"]

[start]
preset = "booted-block-low-mass"

[set]
boot_stiffness = 14

[predict]
question = "What happens?"
choices = [
  { text = "It falls", when = "loaded_track falls by at least 1 %" },
  { text = "It rises", when = "loaded_track rises by at least 1 %" },
]
+++
Read this first: {{ before boot_stiffness }}.

## Reveal

It {{ percent loaded_track }}.
"""

SHIPPED, PROBLEMS = load_lessons()


def test_seven_lessons_ship_in_their_order():
    assert PROBLEMS == ()
    subjects = ["Stiffness", "Mass", "Spacing", "Damping", "One stage or two", "Reading a specification"]
    subjects.append("Tolerances")
    assert [lesson.title.split(":")[0] for lesson in SHIPPED] == subjects


@pytest.mark.parametrize("lesson", SHIPPED, ids=lambda lesson: lesson.file)
def test_every_lesson_is_true_by_the_solver(lesson):
    found = reveal(lesson)
    assert [str(problem) for problem in found.problems] == []
    assert sum(found.right) == 1
    assert "{{" not in found.introduction + found.reveal
    assert lesson.claims
    assert len(lesson.choices) >= 2


@pytest.mark.parametrize("lesson", SHIPPED, ids=lambda lesson: lesson.file)
def test_every_level_in_a_revealed_text_is_computed(lesson):
    """Written are the lumped model's 12 and 24 dB per octave, theory that is asserted elsewhere, and limits.

    A limit is what is asked for: a figure of the same text is computed for it.
    """
    written = re.sub(r"\{\{.*?\}\}", "", lesson.reveal)
    limits = re.findall(r"at_most\(\w+, [\d.]+, (-?[\d.]+)\)", lesson.reveal)
    assert set(re.findall(r"(-?[\d.]+) dB", written)) <= {"12", "24", *limits}


@pytest.mark.parametrize("lesson", SHIPPED, ids=lambda lesson: lesson.file)
def test_a_lesson_whose_change_is_undone_is_found_false(lesson):
    """What a lesson says is asked of the solver, not assumed."""
    start = {**lesson.start, **lesson.change}
    undone = dataclasses.replace(lesson, start=start, change=start_of(lesson))
    assert reveal(undone).problems


def start_of(lesson):
    """Return the sliders that a lesson changes, where it found them."""
    inputs = DesignInputs()
    set_sliders(inputs, lesson.start)
    return {name: getattr(inputs, name) for name in lesson.change}


def test_a_lesson_is_read_and_revealed():
    lesson = parse_lesson(GOOD, "good.md")
    before, after = lesson.designs()
    assert before == tig.PRESETS["booted-block-low-mass"]
    assert after == before.replace(boot_stiffness=14e6)
    found = reveal(lesson)
    assert found.introduction == "Read this first: 28 kN/mm."
    falls = 1 - tig.solve(after, "exact").natural_frequencies.loaded_track / 39.055
    assert found.reveal == f"It falls by {100 * falls:.0f} %."
    assert found.right == (True, False)
    assert found.problems == ()


def test_sliders_are_set_and_not_locked():
    inputs = DesignInputs()
    inputs.boot_stiffness = 100.0
    lesson = parse_lesson(GOOD, "good.md")
    set_sliders(inputs, lesson.start)
    assert display_values(inputs.to_design()) == display_values(tig.PRESETS["booted-block-low-mass"])
    set_sliders(inputs, lesson.change)
    assert inputs.boot_stiffness == 14
    inputs.boot_stiffness = 20.0
    assert inputs.to_design().boot_stiffness == 20e6


BROKEN = {
    "no fence": ("+++\ntitle", "title", None, "no front matter"),
    "not TOML": ('title = "A lesson"', "title = A lesson", 2, "not TOML"),
    "no title": ('title = "A lesson"\n', "", None, "title"),
    "long title": ('"A lesson"', '"' + "x" * 101 + '"', 2, "1 to 100 characters"),
    "title in lines": ('"A lesson"', '"A\\nlesson"', 2, "one line"),
    "unknown key": ("order = 1", "ordr = 1", 3, "give order"),
    "order as text": ("order = 1", 'order = "first"', 3, "a number"),
    "order not a number": ("order = 1", "order = nan", 3, "order"),
    "unknown slider": ("boot_stiffness = 14", "boot_stifness = 14", 10, "give boot_stiffness"),
    "out of range": ("boot_stiffness = 14", "boot_stiffness = 14e6", 10, "from 2 to 200"),
    "not a number": ("boot_stiffness = 14", "boot_stiffness = nan", 10, "from 2 to 200"),
    "a bool": ("boot_stiffness = 14", "boot_stiffness = true", 10, "from 2 to 200"),
    "a list": ("boot_stiffness = 14", "rail = [1]", 10, "one of 60"),
    "unknown preset": ('preset = "booted-block-low-mass"', 'preset = "best"', 7, "one of slab-track"),
    "no preset": ('preset = "booted-block-low-mass"', "block_mass = 45", 6, "no preset"),
    "nothing set": ("boot_stiffness = 14", "", 9, "empty"),
    "nothing changes": ("boot_stiffness = 14", "boot_stiffness = 28", 9, "nothing changes"),
    "one choice": ('  { text = "It rises", when = "loaded_track rises by at least 1 %" },\n', "", 14, "two"),
    "choice without a claim": (', when = "loaded_track rises by at least 1 %"', "", 14, "a text and a claim"),
    "bad claim": ("loaded_track falls by at least 1 Hz", "it falls a lot", 4, "cannot be read"),
    "bad figure": ("percent loaded_track", "percent loaded", 23, "loaded_track"),
    "no reveal": ("## Reveal", "## Revelation", 19, "0 lines"),
    "two reveals": ("It {{", "## Reveal\nIt {{", 19, "2 lines"),
    "nothing revealed": ("It {{ percent loaded_track }}.", "", 21, "nothing to read"),
    "too many figures": ("It {{", "{{ peak }} " * 61 + "It {{", 23, "more than 60"),
}


@pytest.mark.parametrize(("old", "new", "line", "says"), BROKEN.values(), ids=BROKEN.keys())
def test_a_broken_lesson_names_its_line_and_what_to_do(old, new, line, says):
    assert old in GOOD
    with pytest.raises(LessonError, match=re.escape(says)) as caught:
        parse_lesson(GOOD.replace(old, new, 1), "broken.md")
    assert str(caught.value).startswith("broken.md, line ")
    if line is not None:
        assert caught.value.line == line


def test_a_false_claim_is_told():
    lesson = parse_lesson(GOOD.replace("falls by at least 1 Hz", "rises by at least 1 Hz"), "false.md")
    (problem,) = reveal(lesson).problems
    assert (
        str(problem) == "false.md: the solver finds this claim false: 'loaded_track rises by at least 1 Hz'"
    )


def test_two_right_choices_are_told():
    lesson = parse_lesson(
        GOOD.replace("loaded_track rises by at least 1 %", "peak is at least 1 dB"), "two.md"
    )
    assert "2 choices true" in str(reveal(lesson).problems[0])


def test_a_figure_that_a_track_lacks_is_a_question_mark_and_told():
    single = GOOD.replace("boot_stiffness = 14", "two_stage = false").replace(
        "percent loaded_track", "coupled_block"
    )
    found = reveal(parse_lesson(single, "single.md"))
    assert found.reveal == "It ?."
    assert sum("single-stage" in str(problem) for problem in found.problems) == 1


def test_a_folder_gives_its_good_lessons_and_a_message_for_each_broken_one(tmp_path):
    (tmp_path / "b.md").write_text(GOOD.replace("order = 1", "order = 2"))
    (tmp_path / "a.md").write_text(GOOD)
    (tmp_path / "latin.md").write_bytes(GOOD.replace("A lesson", "Übung").encode("latin-1"))
    (tmp_path / "large.md").write_text(GOOD + "x" * LARGEST_FILE)
    (tmp_path / "folder.md").mkdir()
    (tmp_path / "notes.txt").write_text("no lesson")
    lessons, problems = load_lessons(tmp_path)
    assert [lesson.file for lesson in lessons] == ["a.md", "b.md"]
    told = {problem.file: str(problem) for problem in problems}
    assert set(told) == {"latin.md", "large.md", "folder.md"}
    assert "line 2" in told["latin.md"]
    assert "UTF-8" in told["latin.md"]
    assert "larger" in told["large.md"]


def test_a_folder_that_is_empty_or_missing_is_told(tmp_path):
    for folder in (tmp_path, tmp_path / "nowhere"):
        lessons, problems = load_lessons(folder)
        assert lessons == ()
        assert "add files" in str(problems[0])


def test_only_so_many_lessons_are_read(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_LESSONS", 2)
    for name in ("a", "b", "c"):
        (tmp_path / f"{name}.md").write_text(GOOD)
    lessons, problems = load_lessons(tmp_path)
    assert len(lessons) == 2
    assert problems[0].file == "c.md"


def test_lines_may_end_as_on_windows(tmp_path):
    file = tmp_path / "windows.md"
    file.write_bytes(b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode())
    assert read_lesson(file).reveal == "It {{ percent loaded_track }}."


@given(st.text(max_size=300), st.integers(0, len(GOOD)))
def test_no_text_breaks_the_reader(text, at):
    with suppress(LessonError):
        parse_lesson(GOOD[:at] + text + GOOD[at:], "any.md")


@given(st.integers(0, len(GOOD)), st.integers(0, 60))
def test_no_cut_breaks_the_reader(at, length):
    with suppress(LessonError):
        reveal(parse_lesson(GOOD[:at] + GOOD[at + length :], "cut.md"))


def test_nesting_without_end_is_refused():
    deep = GOOD.replace("order = 1", "order = " + "[" * 5000 + "]" * 5000)
    with pytest.raises(LessonError):
        parse_lesson(deep, "deep.md")
