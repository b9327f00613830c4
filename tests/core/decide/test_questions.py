"""Questions are asked as the functions are, kept in a study's file, and give the same bits again."""

import dataclasses
import subprocess
import sys

import numpy as np
import pytest

import trackig_core as tig
from tests.core.decide.test_feasible import limits_around
from trackig_core.decide import Answer, Question
from trackig_core.decide.questions import KINDS, digest

BLOCK = tig.PRESETS["booted-block-low-mass"]

SOURCE = tig.SourceSpectrum([(each, 60.0) for each in tig.BAND_CENTRES])

SETTINGS = {
    "range": {
        "fields": ["boot_stiffness"],
        "ranges": {"boot_stiffness": [10e6, 60e6]},
        "max_deflection": 0.003,
    },
    "sensitivity": {"changes": {"boot_stiffness": 0.05}},
    "sobol": {
        "tolerances": {"boot_stiffness": 0.1, "block_mass": {"normal": 0.02}},
        "samples": 64,
        "seed": 5,
    },
    "tolerance": {
        "tolerances": {"pad_stiffness": {"uniform": 0.1}},
        "production": {"boot_stiffness": [27e6, 28e6, 30e6], "boot_loss_factor": [0.19, 0.2, 0.22]},
        "samples": 200,
        "seed": 3,
    },
    "map": {
        "x_field": "boot_stiffness",
        "y_field": "block_mass",
        "points": [5, 4],
        "figures": ["margin", "level", "63"],
    },
    "find": {
        "free": {"block_mass": [20.0, 90.0]},
        "choices": {
            "rail": ["60", "60E1"],
            "boot": [{"boot_stiffness": 20e6, "cost": 3.0}, {"boot_stiffness": 3e7}],
        },
        "objectives": ["margin", "cost"],
        "population": 8,
        "generations": 3,
        "seed": 2,
    },
}


@pytest.fixture(scope="module")
def questions():
    specification = limits_around(BLOCK, 1.0)
    return {
        kind: Question(kind, BLOCK, settings, specification, SOURCE if KINDS[kind].takes_source else None)
        for kind, settings in SETTINGS.items()
    }


@pytest.fixture(scope="module")
def answers(questions):
    return {kind: Answer.of(each, each.ask()) for kind, each in questions.items()}


def test_a_question_is_asked_as_the_function_is(questions):
    specification = questions["tolerance"].specification
    expected = tig.decide.tolerance(
        BLOCK,
        specification,
        {"pad_stiffness": tig.decide.Uniform(0.1)},
        production=SETTINGS["tolerance"]["production"],
        samples=200,
        seed=3,
    )
    found = questions["tolerance"].ask()
    assert str(found) == str(expected)
    assert np.array_equal(found.margins, expected.margins)
    rails = {rail.name for rail in questions["find"].ask().many.columns["rail"]}
    assert rails == {"60", "60E1"}


@pytest.mark.parametrize("kind", KINDS)
def test_asked_again_it_gives_the_same_bits(answers, kind):
    assert answers[kind].holds(threads=1)
    assert answers[kind].versions["numpy"] == np.__version__


def test_a_digest_sees_the_last_bit(questions):
    result = questions["map"].ask()
    figures = {name: values.copy() for name, values in result.figures.items()}
    figures["63"][2, 1] = np.nextafter(figures["63"][2, 1], 1)
    assert digest(dataclasses.replace(result, figures=figures)) != digest(result)
    assert digest(dataclasses.replace(result, figures=dict(result.figures))) == digest(result)


def test_other_settings_give_another_digest(questions, answers):
    question = questions["tolerance"]
    other = dataclasses.replace(question, settings={**question.settings, "seed": 4})
    assert digest(other.ask()) != answers["tolerance"].digest


def test_a_study_keeps_them_exactly(answers):
    study = tig.Study(BLOCK, answers=answers.values())
    text = study.to_toml()
    again = tig.Study.from_toml(text)
    assert again == study
    assert [each.question.kind for each in again.answers] == list(KINDS)
    assert again.to_toml() == text
    assert again.answers[3].holds()
    assert hash(again) == hash(study)


def test_a_study_without_any_is_written_as_before():
    assert "answers" not in tig.Study(BLOCK).to_toml()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('question = "tolerance"', 'question = "guess"', r"answers\[0\]: question = 'guess': give range"),
        ("samples = 200", "sample = 200", r"answers\[0\]: tolerance has no setting 'sample'"),
        ("samples = 200", "samples = 2026-01-01", r"answers\[0\]: samples = .*give numbers, texts"),
        ("seed = 3", "seed = 3\nfree = 1", r"answers\[0\]: tolerance has no setting 'free'"),
        ("digest = ", "digests = ", r"answers\[0\].digest: it is missing"),
        ("digest = ", 'mood = "good"\ndigest = ', r"answers\[0\].mood: there is no such key"),
        ("sentence = [", 'sentence = ["\\u0007",', r"answers\[0\]: sentence = .*printable"),
    ],
)
def test_a_file_at_fault_says_where(answers, old, new, message):
    text = tig.Study(BLOCK, answers=[answers["tolerance"]]).to_toml()
    assert text.count(old) == 1
    with pytest.raises(tig.StudyError, match=message):
        tig.Study.from_toml(text.replace(old, new))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("guess", BLOCK), "question = 'guess': give range, sensitivity"),
        (("range", BLOCK), "range needs a specification"),
        (("map", BLOCK, {"colour": 1}), "map has no setting 'colour': give x_field"),
        (("map", BLOCK, {"points": [None]}), "points = None: give numbers"),
    ],
)
def test_a_question_that_cannot_be_asked_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        Question(*arguments)


def test_a_study_is_opened_without_what_answers_it(tmp_path, answers):
    path = tmp_path / "study.toml"
    path.write_text(tig.Study(BLOCK, answers=answers.values()).to_toml(), encoding="utf-8")
    code = (
        f"import sys, trackig_core as tig; tig.Study.from_toml(open({str(path)!r}, 'rb').read()); "
        "assert 'trackig_core.decide.feasible' not in sys.modules; assert 'pymoo' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
