"""The drawing: true to scale, in one piece, following every input, and safe whatever it is given."""

import re
import xml.etree.ElementTree as ET
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from dashboard import theme
from dashboard.fields import to_si
from dashboard.figures import track_drawing
from dashboard.session.inputs import DesignInputs
from trackig_core.names import LONGEST_NAME, is_name
from trackig_core.track.design import RANGES

SVG = "{http://www.w3.org/2000/svg}"

LOW_MASS = tig.PRESETS["booted-block-low-mass"]

PARTS_OF = {
    "pad_stiffness": {"pad"},
    "pad_loss_factor": {"pad"},
    "block_mass": {"pad", "block", "boot", "ground"},
    "boot_stiffness": {"boot"},
    "boot_loss_factor": {"boot"},
    "wheel_mass": {"wheel"},
    "contact_stiffness": {"contact"},
}
"""What moves when an input does."""


def numbers(name):
    low, high, _ = RANGES[name]
    return st.floats(low, high)


def any_design(two_stage):
    """Return every design of plain numbers that the core allows."""
    second = ("block_mass", "boot_stiffness", "boot_loss_factor") if two_stage else ()
    first = ("pad_stiffness", "pad_loss_factor", "fastener_spacing", "wheel_mass", "contact_stiffness")
    printable = st.characters(exclude_categories=["C", "Z"], include_characters=" ")
    names = st.text(printable, min_size=1, max_size=LONGEST_NAME).filter(is_name)
    rail = st.builds(tig.Rail, names, numbers("mass_per_metre"), numbers("bending_stiffness"))
    return st.builds(tig.TrackDesign, rail=rail, **{name: numbers(name) for name in (*first, *second)})


any_track = st.booleans().flatmap(any_design)


def svg(design):
    return ET.fromstring(track_drawing.track_svg(design))


def parts(root):
    return [group.get("class") for group in root.iter(f"{SVG}g") if group.get("class")]


def texts(root):
    return [line.text for line in root.iter(f"{SVG}tspan")] + [
        text.text for text in root.iter(f"{SVG}text") if text.text
    ]


@given(any_track)
def test_the_load_path_is_in_one_piece(design):
    drawn = track_drawing.geometry(design)
    wheel, rail, block, boot = drawn["wheel"], drawn["rail"], drawn["block"], drawn["boot"]
    assert wheel["centre"] + wheel["radius"] == pytest.approx(drawn["contact"]["top"])
    assert drawn["contact"]["bottom"] == rail["top"] < rail["foot"] == drawn["pad"]["top"]
    assert drawn["pad"]["bottom"] == (block["top"] if design.two_stage else drawn["ground"]["top"])
    if design.two_stage:
        assert block["bottom"] == boot["top"]
        assert block["top"] < boot["rim"] < block["bottom"]
        assert boot["bottom"] == drawn["floor"] - boot["lining"]
    for part in filter(None, (drawn["contact"], drawn["pad"], boot)):
        heights = [y for _, y in part["spring"]]
        assert (heights[0], heights[-1]) == (part["top"], part["bottom"])
        assert heights == sorted(heights)


@given(any_track)
def test_nothing_meets_its_neighbour_or_leaves_the_picture(design):
    drawn = track_drawing.geometry(design)
    pitch = drawn["supports"][1] - drawn["supports"][0]
    assert drawn["wheel"]["centre"] - drawn["wheel"]["radius"] > 0
    assert drawn["wheel"]["x"] - drawn["wheel"]["radius"] > track_drawing.LEFT
    assert drawn["dimension"]["end"] < drawn["width"] <= drawn["supports"][-1]
    for part in filter(None, (drawn["pad"], drawn["boot"])):
        damper = part["damper"]
        right_of_spring = max(dx for dx, _ in part["spring"]) + part["wire"] / 2
        assert right_of_spring < damper["x"] - damper["half"]
        assert damper["x"] + damper["half"] < part["half"]
        assert 0 <= damper["fluid"] <= damper["bottom"] - damper["top"]
        assert part["top"] < damper["top"] < damper["piston"] < damper["bottom"] < part["bottom"]
    if design.two_stage:
        outer = drawn["boot"]["pocket"] + track_drawing.BOOT_LINING / 2
        assert 2 * drawn["pad"]["half"] <= drawn["block"]["width"] + 1e-9
        assert drawn["block"]["width"] / 2 < drawn["boot"]["pocket"] - track_drawing.BOOT_LINING / 2
        assert 2 * outer <= pitch - track_drawing.LEAST_WALL + 1e-9


@given(any_track)
def test_the_drawing_is_sound_and_safe_for_any_design(design):
    root = svg(design)
    assert {each.tag.removeprefix(SVG) for each in root.iter()} <= {
        *("svg", "title", "desc", "g", "path", "rect", "circle", "polyline", "text", "tspan")
    }
    attributes = {name for each in root.iter() for name in each.attrib}
    assert not {name for name in attributes if name.startswith("on") or name in ("id", "style")}
    assert not any("href" in name for name in attributes)


@given(any_track)
def test_labels_stay_apart(design):
    placed = track_drawing.labels(design, track_drawing.geometry(design))
    for above, below in pairwise(placed):
        assert below["y"] - above["y"] >= len(above["lines"]) * track_drawing.LINE_HEIGHT
    assert placed[-1]["y"] + track_drawing.LINE_HEIGHT < track_drawing.HEIGHT


@pytest.mark.parametrize("spacing", [0.2, 0.25, 0.6, 0.75, 1.0])
def test_spacing_is_true_to_scale(spacing):
    design = LOW_MASS.replace(fastener_spacing=spacing)
    drawn = track_drawing.geometry(design)
    assert drawn["dimension"]["end"] - drawn["wheel"]["x"] == pytest.approx(spacing * track_drawing.SCALE)
    steps = {round(b - a, 6) for a, b in pairwise(drawn["supports"])}
    assert steps == {round(spacing * track_drawing.SCALE, 6)}
    assert "to scale" in texts(svg(design))


def test_a_spacing_that_has_no_room_says_that_it_is_not_to_scale():
    assert {"2 m", "not to scale"} <= {*texts(svg(LOW_MASS.replace(fastener_spacing=2.0)))}


@pytest.mark.parametrize(("name", "moved"), PARTS_OF.items())
def test_an_input_moves_its_own_part_and_nothing_else(name, moved):
    low, high = (to_si(name, bound) for bound in DesignInputs.param[name].bounds)
    before = track_drawing.geometry(LOW_MASS.replace(**{name: low}))
    after = track_drawing.geometry(LOW_MASS.replace(**{name: high}))
    assert {part for part in before if before[part] != after[part]} == moved


@pytest.mark.parametrize("part", ["pad", "boot", "contact"])
def test_stiffer_springs_have_thicker_wire_and_fewer_turns(part):
    name = f"{part}_stiffness"
    values = [to_si(name, bound) for bound in DesignInputs.param[name].bounds]
    soft, stiff = (track_drawing.geometry(LOW_MASS.replace(**{name: value}))[part] for value in values)
    assert stiff["wire"] > 1.3 * soft["wire"]
    assert stiff["turns"] < soft["turns"]


def test_equal_stiffness_looks_equal_in_pad_and_boot():
    drawn = track_drawing.geometry(LOW_MASS.replace(pad_stiffness=50e6, boot_stiffness=50e6))
    assert [drawn["pad"][key] for key in ("wire", "turns")] == [
        drawn["boot"][key] for key in ("wire", "turns")
    ]


@pytest.mark.parametrize("spacing", [0.2, 0.6, 1.0])
def test_heavier_is_larger(spacing):
    masses = [10, 45, 120, 210, 500]
    blocks = [
        track_drawing.geometry(LOW_MASS.replace(fastener_spacing=spacing, block_mass=mass))["block"]
        for mass in masses
    ]
    areas = [block["width"] * (block["bottom"] - block["top"]) for block in blocks]
    assert all(b > 1.2 * a for a, b in pairwise(areas))
    light, heavy = (
        track_drawing.geometry(LOW_MASS.replace(wheel_mass=mass))["wheel"]["radius"] for mass in (400, 1200)
    )
    assert heavy / light == pytest.approx(3 ** (1 / 3), rel=0.03)


def test_the_damper_fills_with_the_loss_factor():
    fluids = [
        track_drawing.geometry(LOW_MASS.replace(pad_loss_factor=eta))["pad"]["damper"]["fluid"]
        for eta in (0.0, 0.1, 0.2, 0.5, 1.0)
    ]
    assert fluids[0] == 0
    assert fluids[2] == pytest.approx(2 * fluids[1])
    assert fluids[3] == fluids[4] == pytest.approx(5 * fluids[1])


def test_a_single_stage_track_has_neither_blocks_nor_boots():
    single, two = parts(svg(tig.PRESETS["slab-track"])), parts(svg(LOW_MASS))
    assert not {"block", "boot"} & {*single}
    assert two.count("block") == two.count("boot") == two.count("pad") > 1


def test_labels_read_as_the_sliders_do():
    shown = texts(svg(tig.PRESETS["booted-sleeper"]))
    expected = ["450 kg unsprung", "1200 kN/mm", "Rail 60", "60 kg/m", "150 kN/mm", "loss factor 0.2"]
    expected += ["210 kg", "31.5 kN/mm", "loss factor 0.2", "0.75 m"]
    assert [text for text in shown if text in expected] == expected


def test_screen_readers_are_told_the_whole_track():
    root = svg(tig.PRESETS["booted-sleeper"])
    assert root.get("role") == "img"
    assert root.get("aria-label") == root.find(f"{SVG}title").text
    words = root.find(f"{SVG}desc").text
    for quantity in ("450 kg", "1200 kN/mm", "Rail 60", "150 kN/mm", "210 kg", "31.5 kN/mm", "0.75 m"):
        assert quantity in words
    assert "boot" not in svg(tig.PRESETS["slab-track"]).find(f"{SVG}desc").text


def test_measured_curves_are_drawn_as_at_50_hz():
    measured = LOW_MASS.replace(
        boot_stiffness=tig.StiffnessCurve([(5, 20e6, 0.1), (50, 28e6, 0.2), (500, 40e6, 0.3)]),
        boot_loss_factor=None,
        pad_loss_factor=tig.LossFactorCurve([(50, 0.2), (500, 0.4)]),
    )
    assert track_drawing.track_svg(measured) == track_drawing.track_svg(LOW_MASS)


def test_a_hostile_name_stays_text():
    name = "\"'><script>alert(1)</script>"
    summary = track_drawing.track_svg(LOW_MASS.replace(rail=tig.Rail(name, 60.0, 6e6)))
    assert "<script" not in summary
    assert name in ET.fromstring(summary).find(f"{SVG}desc").text


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_colours_come_from_the_style(preset):
    colours = {*re.findall(r"#[0-9a-fA-F]{3,8}", track_drawing.track_svg(tig.PRESETS[preset]))}
    assert colours <= {*theme.FIGURE_COLOURS}


def test_what_goes_on_beyond_the_drawing_is_cut_at_its_edge():
    drawing = ET.fromstring(track_drawing.track_svg(LOW_MASS.replace(ground=tig.GROUNDS["rock"])))
    (inner,) = drawing.findall(f"{SVG}svg")
    box = f"{inner.get('x', '0')} {inner.get('y')} {inner.get('width')} {inner.get('height')}"
    assert box == inner.get("viewBox") == drawing.get("viewBox")
    assert {each.tag for each in drawing} == {f"{SVG}title", f"{SVG}desc", f"{SVG}svg"}
