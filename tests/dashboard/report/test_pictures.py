"""Pictures for other reports: large, with every word outside the axes, and names as text."""

import datetime
import io
import re

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import trackig_core as tig
from dashboard.report import pictures
from dashboard.report.pictures import DATA_PART, picture
from dashboard.session.heading import Heading
from dashboard.theme import MOST_PINNED

DAY = datetime.date(2026, 3, 5)
NAME = "$\\frac{1}{$ <b>forty characters & more "
LIMIT = tig.Specification([(63, 0.0), (80, -30.0)], name="Limit $x")


@pytest.fixture
def results(session):
    session.show("booted-block-low-mass")
    for place in range(MOST_PINNED):
        session.pin("slab-track", f"{NAME}{place}")
    session.assessment.specification = LIMIT
    return session.assessment.shown


@pytest.fixture
def heading(session, results):
    return Heading.of(session.snapshot.study(), results, DAY)


@pytest.fixture
def figures(monkeypatch):
    """Return a list that gathers every figure that is saved."""
    kept, save = [], Figure.savefig

    def keep(figure, *arguments, **options):
        kept.append(figure)
        save(figure, *arguments, **options)

    monkeypatch.setattr(Figure, "savefig", keep)
    return kept


@pytest.mark.parametrize("kind", ["gain", "difference", "force"])
def test_a_picture_is_large_and_leaves_two_thirds_to_the_data(results, heading, figures, kind):
    data = picture(kind, "png", results, heading, base=results[0], specification=LIMIT)
    width, height = Image.open(io.BytesIO(data)).size
    assert width >= 2000
    (figure,) = figures
    assert figure.axes[0].get_position().height >= DATA_PART
    assert figure.axes[0].get_legend() is None
    frame, (legend,) = figure.axes[0].get_window_extent(), figure.legends
    renderer = figure.canvas.get_renderer()
    below = legend.get_window_extent(renderer)
    assert below.y1 < frame.y0
    assert below.y0 >= 0
    assert below.x1 <= figure.bbox.x1
    assert height / pictures.RESOLUTION == pytest.approx(figure.get_figheight(), abs=0.01)


def test_a_picture_says_study_design_definition_and_date(results, heading, figures):
    picture("gain", "png", results, heading, specification=LIMIT)
    (figure,) = figures
    words = figure.get_suptitle() + figure.axes[0].get_title("left")
    for said in (
        "Insertion gain",
        heading.study,
        "Booted block, low mass",
        heading.definition,
        "5 March 2026",
    ):
        assert said in words
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    natural = results[0].summary.solution.natural_frequencies
    assert names == [
        "Booted block, low mass",
        *(each.name for each in results[1:]),
        "greatest allowed: Limit $x",
        f"loaded track {natural.loaded_track:.1f} Hz",
        f"coupled block {natural.coupled_block:.0f} Hz",
    ]


def test_the_first_design_sets_the_scale_of_force_and_what_leaves_it_is_said(results, heading, figures):
    picture("force", "png", results, heading)
    (figure,) = figures
    assert figure.axes[0].get_ylim()[1] == pytest.approx(1.1 * results[0].summary.total_force.max())
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert not names[0].endswith(")")
    peak = results[1].summary.total_force.max()
    assert all(f"(cut off: reaches {peak:+.3g} kN" in name for name in names[1:])


def test_the_curves_of_a_picture_are_the_results(results, heading, figures):
    picture("difference", "png", results, heading, base=results[1])
    lines = {line.get_color(): line for line in figures[0].axes[0].get_lines() if len(line.get_xdata()) == 21}
    found = lines[results[0].colour].get_ydata()
    np.testing.assert_array_equal(found, results[0].levels - results[1].levels)


def test_bands_beyond_what_was_measured_are_hatched_as_on_the_page(session, measured_result, figures):
    heading = Heading.of(session.snapshot.study(), [measured_result], DAY)
    picture("gain", "png", [measured_result], heading)
    (figure,) = figures
    hatched = [patch for patch in figure.axes[0].patches if patch.get_hatch()]
    beyond = measured_result.extrapolated_bands
    assert len(hatched) == len(beyond) > 0
    for label, patch in zip(beyond, hatched, strict=True):
        band = tig.BAND_LABELS.index(label)
        assert (patch.get_x(), patch.get_x() + patch.get_width()) == pytest.approx(
            tuple(tig.BAND_EDGES[band : band + 2])
        )
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert f"beyond what was measured of {heading.design}" in names
    assert [each for each in figure.legends[0].get_patches() if each.get_hatch()]


def test_a_drawing_holds_no_markup_of_a_name(results, heading):
    drawing = picture("gain", "svg", results, heading, specification=LIMIT).decode()
    assert "<b>" not in drawing
    assert re.search(r"<svg [^>]*viewBox", drawing)
