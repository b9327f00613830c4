"""Answers in the report: a page each, of those that are kept, and the same figures as the library's."""

import dataclasses
import datetime
import re

import pytest

import trackig_core as tig
from dashboard import formats
from dashboard.report.answer_pages import answer_page
from dashboard.report.html_report import html_report
from dashboard.session.answers import question_lines

BLOCK = tig.PRESETS["booted-block-low-mass"]
LIMITS = tig.Specification([(63, -1.5), (125, -6.0)], name="Line <b>7</b>")
SCATTER = {"pad_stiffness": {"uniform": 0.15}, "boot_stiffness": {"normal": 0.05}}
SETTINGS = {
    "range": {},
    "sensitivity": {"changes": {"boot_stiffness": 0.1, "block_mass": 0.2}},
    "sobol": {"tolerances": SCATTER, "figures": ["margin", "deflection"], "samples": 64},
    "tolerance": {"tolerances": SCATTER, "samples": 500},
    "map": {"x_field": "boot_stiffness", "y_field": "block_mass", "figures": ["margin"], "points": [20, 20]},
    "find": {
        "free": ["boot_stiffness"],
        "choices": {"rail": ["60", "49E1"]},
        "population": 8,
        "generations": 3,
    },
}


def asked(kind):
    question = tig.decide.Question(kind, BLOCK, SETTINGS[kind], specification=LIMITS)
    result = question.ask()
    return tig.decide.Answer.of(question, result), result


def report(summary, answers, pages=None):
    study = tig.Study(BLOCK, specification=LIMITS, answers=answers)
    summaries = {BLOCK: summary("booted-block-low-mass")}
    return html_report(study, summaries, date=datetime.date(2026, 11, 25), version="1", pages=pages)


@pytest.mark.parametrize("kind", SETTINGS)
def test_an_answer_has_a_page_with_all_that_obtains_it_again(kind, summary):
    answer, result = asked(kind)
    page = answer_page(answer, result)
    text = report(summary, (answer,), {answer.digest: page})
    (section,) = re.findall(r'<section class="page">.*?</section>', text, re.DOTALL)
    assert answer.digest in section
    assert "numpy" in section
    assert "Line &lt;b&gt;7&lt;/b&gt;" in section
    assert "boot stiffness 28 kN/mm" in section
    assert ("<svg" in section) == (kind in ("map", "tolerance"))
    assert "<image" not in section, "the file forbids pictures from outside its drawings"
    for table in page.tables:
        assert {len(row) for row in table.rows} == {len(table.heads)}
    # a page of its own for those asked, none for others
    assert 'class="page"' not in report(summary, ())


def test_figures_of_a_page_are_the_library_s():
    answer, result = asked("tolerance")
    ((table,), remarks) = (answer_page(answer, result).tables, answer_page(answer, result).remarks)
    assert table.rows[0][1] == f"{100 * next(iter(result.tightened.values())):.1f} %"
    assert f"{result.worst_margin:+.1f}".replace("-", "−") in remarks[-1]
    answer, result = asked("sensitivity")
    (table,) = answer_page(answer, result).tables
    less, more = result.differences["margin"][result.fields.index("block_mass")]
    row = next(row for row in table.rows if row[0].startswith("block mass"))
    assert row[0] == "block mass ∓ 20 %"
    assert row[1] == f"{formats.change_text(less)} / {formats.change_text(more)}"
    answer, result = asked("find")
    (table,) = answer_page(answer, result).tables
    assert "Rail" in table.heads
    assert len(table.rows) == min(max(result.front.size, 1), 24)


def test_numbers_of_vehicle_and_ground_are_named_as_elsewhere():
    sprung = BLOCK.replace(suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["rock"])
    path, other = "ground.stiffness", "suspension.bogie_mass"
    pages = {}
    for kind, settings in {
        "range": {"fields": [path]},
        "sensitivity": {"changes": {path: 0.1}},
        "tolerance": {"tolerances": {path: 0.1}, "samples": 100},
        "map": {"x_field": path, "y_field": other, "points": [4, 3]},
        "find": {"free": [path, other], "population": 8, "generations": 1},
    }.items():
        question = tig.decide.Question(kind, sprung, settings, specification=LIMITS, reference="stiff")
        result = question.ask()
        answer = tig.decide.Answer.of(question, result)
        pages[kind] = answer_page(answer, result)
        _, lines = question_lines(answer)
        assert "ground stiffness 3200 kN/mm" in lines[0]
        assert any("ground stiffness" in line.lower() for line in lines[3:])
    assert pages["range"].tables[0].rows[0][0] == "Ground stiffness (site)"
    assert pages["sensitivity"].tables[0].rows[0][0] == "ground stiffness (site) ∓ 10 %"
    assert pages["tolerance"].tables[0].rows[0][0] == "Ground stiffness (site)"
    assert "Bogie mass per wheel, kg" in str(pages["map"].plot)
    assert pages["find"].tables[0].heads[:2] == ("Bogie mass per wheel, kg", "Ground stiffness, kN/mm")


def test_an_answer_that_was_opened_and_not_asked_again_says_so(summary):
    answer, _ = asked("range")
    forged = dataclasses.replace(answer, sentence="<script>alert(1)</script>")
    text = report(summary, (forged,))
    assert "<script>" not in text
    assert "press “Ask again” on the tab Decide" in text
    text = report(summary, (answer,), {answer.digest: "Others came out: 1 < 2."})
    assert "Others came out: 1 &lt; 2." in text
    assert "press “Ask again” on the tab Decide" not in text


def test_an_answer_says_which_design_of_the_report_it_is_about(summary):
    answer, _ = asked("range")
    of_another = dataclasses.replace(
        answer, question=dataclasses.replace(answer.question, design=BLOCK.replace(block_mass=123.0))
    )
    assert "About “This design”." in report(summary, (answer,))
    text = report(summary, (of_another,))
    assert "About a design that is none of this report." in text
    assert "About “" not in text


def test_what_was_measured_of_the_design_is_named_in_what_was_asked():
    curve = tig.StiffnessCurve([(1, 310.4e6, 0.151), (30, 671e6, 0.151)], preload=30e3)
    design = BLOCK.replace(pad_stiffness=curve, pad_loss_factor=None)
    question = tig.decide.Question("range", design, specification=LIMITS)
    _, lines = question_lines(tig.decide.Answer(question, "Nothing complies.", "0" * 8, {}))
    assert "pad stiffness measured at 2 frequencies, 1 to 30 Hz, preload 30 kN, rail 60." in lines[0]
