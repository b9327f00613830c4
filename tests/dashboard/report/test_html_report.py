"""The report: everything is in it, nothing in it runs, and it asks for nothing."""

import dataclasses
import datetime
import html
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from markupsafe import escape

import trackig_core as tig
from dashboard import formats, theme
from dashboard.formats import signed_text
from dashboard.report.html_report import Particulars, html_report
from dashboard.session.results import SolutionSummary
from dashboard.teaching.left_out import left_out

LOW, HIGH = tig.PRESETS["booted-block-low-mass"], tig.PRESETS["booted-block-high-mass"]
HOSTILE = '<script>alert(1)</script>$\\frac "&</svg>'
DAY = datetime.date(2026, 3, 5)

VOID = {"meta", "br", "link", "img"}


class Reader(HTMLParser):
    """Reads tags, attributes and the text of each kind of element."""

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.attributes, self.rows = [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attributes]
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attributes]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "td" in self.open or "th" in self.open:
            self.rows[-1][-1] += data


def row(reader, head):
    """Return the cells of the rows that begin with given text."""
    return [each[1:] for each in reader.rows if each[0].strip() == head]


@pytest.fixture
def summaries(summary):
    return {tig.PRESETS[key]: summary(key) for key in tig.PRESETS}


def limits(levels, **changed):
    """Return a specification 1 dB above given levels but where changed."""
    points = dict(zip((float(label) for label in tig.BAND_LABELS), levels + 1, strict=True))
    return tig.Specification([*(points | changed).items()], name=f"Limit {HOSTILE}")


@pytest.fixture
def study(summaries):
    levels = summaries[LOW].solution.insertion_gain
    pinned = [
        tig.PinnedDesign(HOSTILE, HIGH, colour=4),
        tig.PinnedDesign("Hidden one", tig.PRESETS["booted-sleeper"], shown=False),
        tig.PinnedDesign("Slab", tig.PRESETS["slab-track"], colour=1),
    ]
    source = tig.SourceSpectrum([(31.5, 70.0), (63, 65.0)], name=f"Source {HOSTILE}")
    return tig.Study(LOW, pinned, limits(levels), source, name=f"Study {HOSTILE}")


@pytest.fixture
def report(study, summaries):
    return html_report(study, summaries, date=DAY, version="9.8.7")


def test_the_report_is_well_formed_and_dated(report, study):
    reader = Reader(report)
    assert reader.open == []
    assert "5 March 2026 · trackig 9.8.7" in report
    assert f"<h1>{html.escape(study.name, quote=False)[:11]}" in report


def test_nothing_in_the_report_runs_or_asks_for_anything(report):
    reader = Reader(report)
    assert not {"script", "iframe", "object", "embed", "link", "img", "base", "form"} & set(reader.tags)
    for _, name, value in reader.attributes:
        assert not name.startswith("on")
        if name in ("href", "xlink:href", "src"):
            assert value.startswith("#")
    assert "@import" not in report
    assert all(target.startswith("#") for target in re.findall(r"url\(([^)]*)\)", report))
    (policy,) = [value for tag, name, value in reader.attributes if tag == "meta" and "default-src" in value]
    assert policy.startswith("default-src 'none'")


def test_names_are_shown_as_they_are(report):
    assert HOSTILE not in report
    assert "&lt;script&gt;alert" in report


def test_whose_report_it_is_stands_in_its_header_if_that_is_said(report, study, summaries):
    assert "<dl>" not in report
    particulars = Particulars(project="Line 7, west", author=HOSTILE)
    text = html_report(study, summaries, date=DAY, version="9.8.7", particulars=particulars)
    header = text[text.index("<header>") : text.index("</header>")]
    assert "<dt>Project</dt><dd>Line 7, west</dd>" in header
    assert f"<dt>Author</dt><dd>{escape(HOSTILE)}</dd>" in header
    assert "Client" not in header
    assert HOSTILE not in text
    assert Reader(text).open == []


@pytest.mark.parametrize("name", [" Line 7", "Line\n7", "x" * 61, None, 7])
def test_particulars_are_names(name):
    with pytest.raises(ValueError, match=r"^client = .*give a name of 1 to 60 printable characters"):
        Particulars(client=name)


def test_identifiers_are_unique_and_referenced_ones_exist(report):
    identifiers = re.findall(r' id="([^"]+)"', report)
    assert len(identifiers) == len(set(identifiers))
    wanted = re.findall(r'href="#([^"]+)"', report) + re.findall(r"url\(#([^)]+)\)", report)
    assert wanted
    assert set(wanted) <= set(identifiers)


def test_bands_margins_and_verdicts_are_those_of_the_core(report, study, summaries):
    reader = Reader(report)
    levels = [summaries[design].solution.insertion_gain for design in (LOW, HIGH, tig.PRESETS["slab-track"])]
    verdicts = [study.specification.check(each) for each in levels]
    for band, label in enumerate(tig.BAND_LABELS):
        gains, margins = row(reader, label)
        crosses = [" ✗" if verdict.fails[band] else "" for verdict in verdicts]
        shown = [formats.signed_text(each[band]) + cross for each, cross in zip(levels, crosses, strict=True)]
        assert gains == [formats.signed_text(study.specification.levels[band]), *shown]
        assert margins == [
            formats.signed_text(verdict.margins[band]) + cross
            for verdict, cross in zip(verdicts, crosses, strict=True)
        ]
    assert verdicts[0].complies
    assert not verdicts[2].complies
    for verdict in verdicts:
        assert f"{'✓' if verdict.complies else '✗'} {verdict}</strong>" in report


def test_a_report_without_verdict_says_what_to_answer_first(study, summaries):
    asked = tig.Specification.given([(63, 10.0)], "Client", set_aside=("630 Hz",))
    text = html_report(dataclasses.replace(study, specification=asked), summaries, date=DAY, version="9.8.7")
    assert "<strong>No verdict yet.</strong> To be answered first: no limit is below 0 dB" in text
    assert "complies" not in text.partition("<pre>")[0].partition("Method and assumptions")[0]
    assert "Margin per band" not in text
    text = html_report(
        dataclasses.replace(study, specification=asked.kept()), summaries, date=DAY, version="9.8.7"
    )
    assert text.count("<em>; 1 not judged, of no band from 5 to 500 Hz: 630 Hz</em>") == 3
    assert "No verdict yet" not in text


def test_inputs_have_the_units_of_the_trade(report):
    reader = Reader(report)
    assert row(reader, "Pad stiffness, kN/mm") == [["100", "200", "1000"]]
    assert row(reader, "Block mass, kg") == [["45", "120", "–"]]
    assert row(reader, "Fastener spacing, m") == [["0.6", "0.6", "0.25"]]
    assert row(reader, "Rail")[0][0] == "60: 60 kg/m, 6.3798 MN m²"


def test_natural_frequencies_are_those_of_the_solutions(report, summaries):
    natural = summaries[HIGH].solution.natural_frequencies
    reader = Reader(report)
    assert row(reader, "Loaded track")[0][1] == f"{natural.loaded_track:.1f}"
    assert row(reader, "Coupled block")[0][1:] == [f"{natural.coupled_block:.0f}", "–"]


def test_levels_with_the_track_are_those_of_the_source(report, study, summaries):
    reader = Reader(report)
    slab, here = (
        study.source.with_track(summaries[design].solution.insertion_gain)
        for design in (tig.PRESETS["slab-track"], LOW)
    )
    (cells,) = row(reader, "Slab")
    difference = slab.relative_to(here)
    assert cells == [
        f"{slab.unweighted:.1f}", f"{slab.a_weighted:.1f}",
        formats.signed_text(difference.unweighted), formats.signed_text(difference.a_weighted),
    ]  # fmt: skip
    assert row(reader, "This design")[0][2:] == ["0.0", "0.0"]
    assert row(reader, "Reference track")[0][0] == f"{10 * np.log10(10**7 + 10**6.5):.1f}"


def test_hidden_and_unsolved_designs_are_named(study, summaries):
    some = {design: each for design, each in summaries.items() if design != tig.PRESETS["slab-track"]}
    report = html_report(study, some, date=DAY, version="1")
    assert "left out: Slab." in report
    assert "judged: Hidden one." in report
    assert row(Reader(report), "Pad stiffness, kN/mm") == [["100", "200"]]


def test_the_report_holds_the_study(report, study):
    (text,) = re.findall(r"<pre>(.*?)</pre>", report, re.DOTALL)
    assert tig.Study.from_toml(html.unescape(text)) == study


def test_insertion_gain_is_reckoned_as_the_study_says(study, summaries):
    view = tig.View(summation="coherent", reference="rigid")
    report = html_report(
        tig.Study(HIGH, specification=study.specification, view=view), summaries, date=DAY, version="1"
    )
    expected = tig.solve(HIGH, "paper", summation="coherent", reference="rigid").insertion_gain
    shown = [row(Reader(report), label)[0][1] for label in tig.BAND_LABELS]
    assert [text.removesuffix(" ✗") for text in shown] == [formats.signed_text(level) for level in expected]
    assert "exact rigid track" in report


def test_a_bare_design_without_time_records_makes_a_short_report():
    exact = SolutionSummary.of(tig.solve(LOW, "exact"), 0.1)
    report = html_report(tig.Study(LOW), {LOW: exact}, date=DAY, version="1")
    assert Reader(report).open == []
    for absent in ("Verdict", "Force into", "Difference from", "Margin", "Level with", "Limit"):
        assert f"<h2>{absent}" not in report


def test_measured_tables_are_named_as_such(fake_picture):
    design = LOW.replace(
        boot_stiffness=tig.StiffnessCurve([(5, 22e6, 0.18), (50, 28e6, 0.2), (500, 38e6, 0.2)]),
        boot_loss_factor=None,
        pad_loss_factor=tig.LossFactorCurve([(5, 0.1), (500, 0.2)]),
    )
    notes = ("the boot is <b>odd</b>",)
    reader = Reader(
        text := html_report(tig.Study(design), {design: fake_picture(design, notes)}, date=DAY, version="1")
    )
    assert row(reader, "Boot stiffness, kN/mm") == [["measured at 3 frequencies, 5 to 500 Hz"]]
    assert row(reader, "Boot loss factor") == [["in the stiffness table"]]
    assert "This design: the boot is &lt;b&gt;odd&lt;/b&gt;." in text


def test_without_any_solution_there_is_no_report(study):
    with pytest.raises(ValueError, match="solve one first"):
        html_report(study, {}, date=DAY, version="1")


def test_failing_bands_are_marked_in_the_plot(summaries):
    levels = summaries[LOW].solution.insertion_gain

    def marks(specification):
        report = html_report(tig.Study(LOW, specification=specification), summaries, date=DAY, version="1")
        return report.count(f"fill: {theme.REPORT_BAD}")

    failing = limits(levels)
    met = marks(failing)
    tight = [(f, level - 3 if f in (63.0, 125.0) else level) for f, level in failing.points]
    assert (met, marks(tig.Specification(tight))) == (0, 2)


def test_designs_look_as_their_colours_say_and_no_two_alike(study, summaries):
    pinned = [dataclasses.replace(each, colour=4, shown=True) for each in study.pinned]
    report = html_report(dataclasses.replace(study, pinned=pinned), summaries, date=DAY, version="9.8.7")
    looks = re.findall(r'stroke="(#\w+)" stroke-width="3" stroke-dasharray="([\d ]*)"', report)[:4]
    own = [(theme.DESIGN_COLOURS[n], " ".join(map(str, theme.DESIGN_DASHES[n]))) for n in (4, 0, 1)]
    assert looks == [(theme.THIS_DESIGN, ""), *own]


@pytest.fixture
def plots(monkeypatch):
    """Return a dict that gathers the axes of each plot of a report, by its name."""
    axes = {}

    def keep(figure, name):
        axes[name] = figure.axes[0]
        return ""

    monkeypatch.setattr("dashboard.report.plots.svg", keep)
    return axes


def curve_of(axes, colour):
    """Return the data of the one curve of a colour."""
    (line,) = [each for each in axes.get_lines() if each.get_color() == colour]
    return line.get_data()


def test_differences_are_those_from_the_base(plots, study, summaries):
    study = dataclasses.replace(study, view=tig.View(base=0))
    html_report(study, summaries, date=DAY, version="1")
    axes, base = plots["difference"], summaries[HIGH].solution.insertion_gain
    slab = tig.PRESETS["slab-track"]
    for design, colour in (
        (LOW, theme.THIS_DESIGN),
        (HIGH, theme.DESIGN_COLOURS[4]),
        (slab, theme.DESIGN_COLOURS[1]),
    ):
        centres, difference = curve_of(axes, colour)
        np.testing.assert_array_equal(centres, tig.BAND_CENTRES)
        np.testing.assert_array_equal(difference, summaries[design].solution.insertion_gain - base)
        low, high = axes.get_ylim()
        assert low == -high
        assert np.abs(difference).max() < high


def test_forces_are_drawn_in_kilonewton_over_milliseconds(plots, summaries):
    html_report(tig.Study(LOW), summaries, date=DAY, version="1")
    axes, solution = plots["force"], tig.solve(LOW)
    time, force = curve_of(axes, theme.THIS_DESIGN)
    shown = (solution.time >= -0.005) & (solution.time <= 0.25)
    np.testing.assert_allclose(time, 1000 * solution.time[shown])
    np.testing.assert_allclose(force, solution.total_force[shown] / 1000)
    assert axes.get_xlim() == (-5, 250)
    assert axes.get_xlabel() == "Time since the step, ms"
    assert axes.get_ylabel() == "Force into the ground, kN"


def test_the_force_axis_holds_the_whole_force_of_this_design_upright(plots, study, summaries):
    """The first design sets the scale, a tenth beyond its extremes, whatever the others reach."""
    html_report(study, summaries, date=DAY, version="1")
    force = summaries[LOW].total_force
    assert force.min() < 0 < force.max()
    assert plots["force"].get_ylim() == pytest.approx((1.1 * force.min(), 1.1 * force.max()))
    assert max(each.total_force.max() for each in summaries.values()) > 1.1 * force.max()


def test_what_the_simplified_model_leaves_out_is_reported_on_request(study, summaries):
    found = left_out(study.design, "metro", "rock", "energy")
    page = html_report(study, summaries, date=DAY, version="1", left_out=found)
    assert found.ladder.sentence in html.unescape(page)
    cells = [signed_text(rung.difference[-1]) for rung in found.ladder.rungs[1:]]
    assert "".join(f"<td>{each}</td>" for each in cells) in page
    assert "simplified model leaves out" not in html_report(study, summaries, date=DAY, version="1")


def test_vehicle_and_ground_are_named_and_compared_with_what_has_a_meaning():
    metro = tig.PRESETS["slab-track"].replace(
        suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"]
    )
    summary = SolutionSummary.of(tig.solve(metro, "exact"), 0.1)
    page = html_report(tig.Study(design=metro), {metro: summary}, date=DAY, version="1")
    assert "metro (generic)" in page
    assert "soft clay (generic)" in page
    assert "relative to a very stiff track on the same ground" in page


def test_bands_beyond_what_was_measured_are_hatched_and_named(measured_result, summaries):
    design, measured = tig.PRESETS["slab-track"], measured_result.summary.solution.design
    study = tig.Study(measured, [tig.PinnedDesign("Slab", design, 0)])
    known = {measured: measured_result.summary, **summaries}
    text = html_report(study, known, date=DAY, version="1")
    assert formats.extrapolated_text("This design") in text
    assert "<pattern " in text
    plain = html_report(tig.Study(design), known, date=DAY, version="1")
    assert formats.extrapolated_text("This design") not in plain


def test_what_is_assumed_is_what_the_designs_have(summary):
    beyond = LOW.replace(
        suspension=tig.VEHICLES["metro"].suspension,
        axle_positions=(0.0, 2.4),
        ground=tig.GROUNDS["soft clay"],
    )
    simple = summary("booted-block-low-mass")
    summaries = {LOW: simple, beyond: SolutionSummary.of(tig.solve(beyond, "exact"), 1.0)}
    alone = " ".join(html_report(tig.Study(LOW), summaries, date=DAY, version="9").split())
    assert "One wheel; unsprung mass only; rigid ground." in alone
    both = tig.Study(LOW, [tig.PinnedDesign("On clay", beyond)])
    both = " ".join(html_report(both, summaries, date=DAY, version="9").split())
    assert "This design: one wheel; unsprung mass only; rigid ground." in both
    words = (
        "2 wheels at 0, 2.4 m, independent roughness; vehicle: metro (generic); ground that yields: soft clay"
    )
    assert f"On clay: {words} (generic)." in both
    assert "time stepping at the paper&#39;s resolution and frequency-domain solution" in both
