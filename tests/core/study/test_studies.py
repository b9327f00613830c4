"""Study files: what is saved is what is opened, and nothing in a file can do harm."""

import contextlib
import dataclasses
import pickle
import time
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from trackig_core.names import LONGEST_NAME, is_name
from trackig_core.study.toml_format import LONGEST_LINE, MOST_BYTES
from trackig_core.track.design import RANGES
from trackig_core.track.measured_curves import COLUMNS, PRELOAD

BLOCK = tig.PRESETS["booted-block-low-mass"]
MEASURED = tig.StiffnessCurve([(5, 22e6, 0.18), (50, 28e6, 0.2), (500, 38e6, 0.2)])
STUDY = tig.Study(
    BLOCK.replace(boot_stiffness=MEASURED, boot_loss_factor=None),
    [
        tig.PinnedDesign("Slab", tig.PRESETS["slab-track"], colour=3, shown=False),
        tig.PinnedDesign("Softer \N{GREEK SMALL LETTER ETA}", BLOCK.replace(boot_stiffness=20e6), colour=7),
    ],
    tig.Specification([(8, 12.5), (31.5, -3.0)], name="Client"),
    tig.SourceSpectrum([(31.5, 70.0), (63, 65.0)], name="Metro"),
    tig.View(summation="coherent", reference="rigid", base=1),
    name="Assessment",
)
FILE = STUDY.to_toml()


def within(low, high):
    return st.floats(low, high, allow_subnormal=False)


def curves(kind, columns):
    rows = st.lists(
        st.tuples(*(within(*COLUMNS[column][:2]) for column in columns)),
        min_size=2,
        max_size=12,
        unique_by=lambda row: row[0],
    )
    return rows.map(sorted).map(kind)


def preloaded(measured):
    """Curves with the static load under which they were measured."""
    return st.builds(
        lambda curve, load: dataclasses.replace(curve, preload=load), measured, within(*PRELOAD[:2])
    )


numbers = {name: within(low, high) for name, (low, high, _) in RANGES.items()}
printable = st.characters(exclude_categories=["C", "Z"], include_characters=" ")
names = st.text(printable, min_size=1, max_size=LONGEST_NAME).filter(is_name)
rails = st.one_of(
    st.sampled_from(list(tig.RAILS.values())),
    st.builds(tig.Rail, names, numbers["mass_per_metre"], numbers["bending_stiffness"]),
)


def springs(part):
    """Stiffness and loss factor of a part, constant or measured."""
    loss = curves(tig.LossFactorCurve, ("frequency", "loss factor"))
    return st.one_of(
        st.tuples(numbers[f"{part}_stiffness"], st.one_of(numbers[f"{part}_loss_factor"], loss)),
        st.tuples(curves(tig.StiffnessCurve, tuple(COLUMNS)), st.none()),
        st.tuples(preloaded(curves(tig.StiffnessCurve, tuple(COLUMNS))), st.none()),
    ).map(lambda pair: {f"{part}_stiffness": pair[0], f"{part}_loss_factor": pair[1]})


@st.composite
def designs(draw):
    values = {name: draw(numbers[name]) for name in ("fastener_spacing", "wheel_mass", "contact_stiffness")}
    values |= draw(springs("pad")) | {"rail": draw(rails)}
    values["pad_static_stiffness"] = draw(st.none() | numbers["pad_static_stiffness"])
    if draw(st.booleans()):
        values |= draw(springs("boot")) | {"block_mass": draw(numbers["block_mass"])}
        values["boot_static_stiffness"] = draw(st.none() | numbers["boot_static_stiffness"])
    return tig.TrackDesign(**values)


def tables(kind):
    bands = st.sampled_from([float(label) for label in tig.BAND_LABELS])
    rows = st.dictionaries(bands, st.floats(-100, 100), min_size=1).map(lambda table: tuple(table.items()))
    limits = {name: numbers[name] for name in ("rail_deflection_limit", "wheel_load")}
    return st.one_of(
        st.none(),
        st.builds(kind, rows, names),
        *([st.builds(kind, rows, names, **limits)] if kind is tig.Specification else []),
    )


presets = st.sampled_from([None, *tig.PRESETS])


@st.composite
def studies(draw):
    pins = st.builds(tig.PinnedDesign, names, designs(), st.integers(0, 7), st.booleans(), presets)
    pinned = draw(st.lists(pins, max_size=3))
    base = draw(st.sampled_from([None, *range(len(pinned))]))
    view = tig.View(
        draw(st.sampled_from(["energy", "coherent"])), draw(st.sampled_from(["line", "rigid"])), base
    )
    return tig.Study(
        draw(designs()),
        pinned,
        draw(tables(tig.Specification)),
        draw(tables(tig.SourceSpectrum)),
        view,
        draw(names),
        draw(presets),
        measured=draw(st.lists(tables(tig.MeasuredGain).filter(lambda gain: gain is not None), max_size=4)),
    )


@given(studies())
def test_what_is_saved_is_what_is_opened(study):
    text = study.to_toml()
    assert tig.Study.from_toml(text) == study
    assert tig.Study.from_toml(text.encode()) == study
    assert tig.Study.from_toml(text).to_toml() == text
    assert max(map(len, text.split("\n"))) <= LONGEST_LINE


@pytest.mark.parametrize("preset", tig.PRESETS)
def test_presets_round_trip_in_the_units_that_their_keys_name(preset):
    design = tig.PRESETS[preset]
    text = tig.Study(design).to_toml()
    assert tig.Study.from_toml(text) == tig.Study(design)
    table = tomllib.loads(text)["design"]
    assert table["pad_stiffness_N_per_m"] == design.pad_stiffness
    assert table["fastener_spacing_m"] == design.fastener_spacing
    assert table["rail"]["bending_stiffness_N_m2"] == design.rail.bending_stiffness
    assert table.get("block_mass_kg") == design.block_mass


def test_numbers_read_as_engineers_write_them():
    assert "pad_stiffness_N_per_m = 100e6\n" in FILE
    assert "    [50.0, 28e6, 0.2],\n" in FILE
    assert "fastener_spacing_m = 0.6\n" in FILE


@pytest.mark.parametrize(
    "data",
    [
        b"\xef\xbb\xbf" + FILE.encode(),
        FILE.replace("\n", "\r\n"),
        FILE.replace("100e6", "100_000_000"),
        "# " + "long" * 100 + "\n" + FILE,
        FILE.replace('name = "Assessment"', "name = 'Assessment'"),
    ],
)
def test_files_edited_by_hand_are_read(data):
    assert tig.Study.from_toml(data) == STUDY


def test_what_may_be_left_out():
    rail = '[design.rail]\nname = "60"\nmass_kg_per_m = 60\nbending_stiffness_N_m2 = 6.3798e6\n'
    design = "[design]\npad_stiffness_N_per_m = 1e9\npad_loss_factor = 0.15\nfastener_spacing_m = 0.25\n"
    text = f'format = "trackig study"\nversion = 1\n{design}wheel_mass_kg = 950\n'
    assert (
        tig.Study.from_toml(text + "contact_stiffness_N_per_m = 1.2e9\n" + rail).design
        == tig.PRESETS["slab-track"]
    )
    with pytest.raises(tig.StudyError, match=r"^design.contact_stiffness_N_per_m: it is missing"):
        tig.Study.from_toml(text + rail)


def changed(old, new):
    assert old in FILE
    return FILE.replace(old, new, 1)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("", "this is no study"),
        ("a = 1", "this is no study"),
        (changed("version = 1", "version = 2"), "version: 2: a newer trackig wrote this file"),
        (changed("version = 1", "version = true"), "version: True: give 1"),
        (changed("version = 1", "version = 1.0"), "version: 1.0: give 1"),
        (changed("version = 1", "version = 0"), "version: 0: give 1"),
        (changed("version = 1", "version = '1'"), "version: '1': give 1"),
        (changed("version = 1\n", ""), "version: it is missing"),
        (changed("version = 1\n", "version = 1\nauthor = 'x'\n"), "author: there is no such key; known are"),
        (changed("version = 1\n", "version = 1\nzzz = 'x'\n"), "view, specification, source, pinned, name,"),
        (changed("fastener_spacing_m", "fastener_spacing"), "write 'fastener_spacing_m'"),
        (changed("summation", "sumation"), "view.sumation: there is no such key; write 'summation'"),
        (changed('"coherent"', '"loud"'), "view.summation: 'loud': give 'energy' or 'coherent'"),
        (changed('"coherent"', '["energy"]'), "view.summation: ['energy']: give"),
        (changed("base = 1", "base = 2"), "view.base: 2: there is no such pinned design"),
        (changed("base = 1", "base = true"), "view.base: True: give a whole number, 0 or more"),
        (changed("base = 1", "base = -1"), "view.base: -1"),
        (
            changed("100e6", "true"),
            "design.pad_stiffness_N_per_m: True: give a number from 100000 to 1e+13 N/m",
        ),
        (changed("100e6", "nan"), "design.pad_stiffness_N_per_m: nan"),
        (changed("100e6", "inf"), "design.pad_stiffness_N_per_m: inf"),
        (changed("100e6", "1e999"), "design.pad_stiffness_N_per_m: inf"),
        (changed("100e6", "'100e6'"), "design.pad_stiffness_N_per_m: '100e6'"),
        (changed("100e6", "2026-01-01"), "design.pad_stiffness_N_per_m: datetime"),
        (changed("100e6", "9" * 150), "design.pad_stiffness_N_per_m: 999"),
        (changed("100e6", "0x" + "f" * 150), "design.pad_stiffness_N_per_m: "),
        (changed("100e6", "9" * 5000), "line 13 has more than 200 characters"),
        (changed("100e6", "{}"), "design.pad_stiffness_N_per_m: {}"),
        (
            changed("[50.0, 28e6, 0.2]", "[50.0, 28e6, true]"),
            "boot_stiffness_measured: row 2: loss factor = True",
        ),
        (changed("[50.0, 28e6, 0.2]", "[50.0, 28e6]"), "design.boot_stiffness_measured: row 2: 2 values"),
        (changed("boot_stiffness_measured", "boot_loss_factor = 0.2\nboot_stiffness_measured"), "remove it"),
        (
            changed("boot_stiffness_measured", "boot_stiffness_N_per_m = 2e7\nboot_stiffness_measured"),
            "design.boot_stiffness_measured: give this or boot_stiffness_N_per_m, not both",
        ),
        *(
            (
                changed("boot_stiffness_measured", f"boot_preload_N = {value}\nboot_stiffness_measured"),
                f"design.boot_preload_N: preload = {said}: give a number from 0 to 1e+06 N",
            )
            for value, said in (("nan", "nan"), ("-1.0", "-1.0"), ("1e300", "1e+300"), ("true", "True"))
        ),
        (
            changed("block_mass_kg", "pad_preload_N = 30e3\nblock_mass_kg"),
            "design.pad_preload_N: remove it, or give pad_stiffness_measured",
        ),
        (changed("block_mass_kg = 45.0\n", ""), "design.block_mass_kg: it is missing: give a value too"),
        (changed('name = "60"', 'name = "6\\u0000"'), "design.rail.name: "),
        (changed('name = "60"', "name = 60"), "design.rail.name: 60: give a name"),
        (changed("mass_kg_per_m = 60.0", "mass_kg_per_m = 0.0"), "design.rail.mass_kg_per_m: 0.0"),
        (changed('name = "Slab"', 'name = "' + "x" * 41 + '"'), "pinned[0].name: "),
        (changed('name = "Slab"', 'name = "Slab "'), "pinned[0].name: "),
        (changed('name = "Assessment"', 'name = "' + "x" * 61 + '"'), "name: "),
        (changed('name = "Slab"', 'name = "a\\nb"'), "pinned[0].name: "),
        (changed('name = "Slab"', 'name = "\\u202e"'), "pinned[0].name: "),
        (changed("colour = 3", "preset = 'slab'"), "pinned[0].preset: 'slab': give slab-track, booted-sl"),
        (changed("version = 1", "version = 1\npreset = ['slab']"), "preset: ['slab']: give slab-track, "),
        (changed("colour = 3", "colour = -8"), "pinned[0].colour: -8: give a whole number, 0 or more"),
        (changed("colour = 3", "colour = 3.0"), "pinned[0].colour: 3.0"),
        (changed("colour = 3", "color = 3"), "pinned[0].color: there is no such key; write 'colour'"),
        (changed("shown = false", "shown = 0"), "pinned[0].shown: 0: give true or false"),
        (changed("pad_loss_factor = 0.15", "pad_loss_factor = 2.5"), "pinned[0].design.pad_loss_factor: 2.5"),
        (changed("[31.5, -3.0]", "[32.9, -3.0]"), "specification.ig_max_dB: row 2, column 1: "),
        (changed("[31.5, -3.0]", "[31.5, nan]"), "specification.ig_max_dB: row 2, column 2: "),
        (changed('name = "Client"', 'name = ""'), "specification: name = ''"),
        (changed('name = "Client"', 'limits = "loss"'), "specification: limits = 'loss': give one of"),
        (changed('name = "Client"', "limits = 3"), "specification: limits = 3: give one of"),
        (changed('name = "Client"', "not_judged = 3"), "specification.not_judged: 3: give a list of texts"),
        (changed('name = "Client"', "not_judged = [3]"), "specification: not_judged = (3,): give at most 60"),
        (
            changed('name = "Client"', 'name = "Client"\nrail_deflection_max_m = 2.5'),
            "specification: rail_deflection_limit = 2.5: give a number from 1e-06 to 0.1 m",
        ),
        (
            changed('name = "Client"', 'name = "Client"\nwheel_load_N = 85e3'),
            "specification.wheel_load_N: give rail_deflection_max_m too, or remove it",
        ),
        (changed("level_dB", "level"), "source.level_dB: it is missing"),
        (changed('name = "Assessment"', "name = 5"), "name: 5: give a name"),
        (changed('name = "Assessment"', 'name = "Assessment'), "this is not TOML: "),
        (changed("[view]", "[view"), "(at line 7, column 6)"),
        (changed("[view]", "[view]\nsummation = 'energy'"), "this is not TOML: "),
        (changed("[view]", "[design]"), "this is not TOML: "),
        ("a = " + "[\n" * 100_000, "nested too deep"),
        ("a = " + "[\n" * 2000 + "]\n" * 2000, "nested too deep"),
        ("a = 2020-13-45", "this is not TOML"),
        ("a = 9999-99-99", "this is not TOML"),
        ("a\0 = 1", "this is not TOML"),
        (b"\0" * 100, "this is not TOML"),
        (b"format = 1\nb = '\xff'", "line 2: this is not UTF-8 text"),
        ("x" * (MOST_BYTES + 1), "larger than 256 kB"),
        (b"x" * (MOST_BYTES + 1), "larger than 256 kB"),
        ("\n" * 5 + "x" * 1000, "line 6 has more than 200 characters"),
        (FILE.partition("[view]")[0] + "design = 5", "design: 5: give a table"),
        (
            FILE.partition("[view]")[0]
            + "pinned = 5\n[view]"
            + FILE.partition("[view]")[2].partition("[[")[0],
            "pinned: 5",
        ),
        (FILE.partition("[view]")[0] + "view = 5\n", "view: 5: give a table"),
        (FILE.partition("[design]")[0], "design: it is missing"),
    ],
)
def test_wrong_files_say_where_and_what_to_do(data, words):
    with pytest.raises(tig.StudyError) as caught:
        tig.Study.from_toml(data)
    assert words in str(caught.value)
    assert len(str(caught.value)) < 320


@pytest.mark.parametrize(
    "attack",
    [
        ("[" + ".".join("a" * 95) + "]\n")
        + "".join(f"k{n}." + ".".join("a" * 90) + "=1\n" for n in range(1350)),
        "".join(f"[{'a.' * 40}b{n}]\n" for n in range(2500)),
        "a = [" + "[1],\n" * 50_000 + "]",
        'a = """' + '\\"' * 90 + "\n" * 100_000 + '"""',
        "[[a]]\n" * 40_000,
    ],
    ids=["dotted keys", "headers", "rows", "string", "tables"],
)
def test_no_file_keeps_the_reader_busy(attack):
    began = time.process_time()
    with pytest.raises(tig.StudyError):
        tig.Study.from_toml(attack[:MOST_BYTES])
    assert time.process_time() - began < 10


@given(st.one_of(st.binary(max_size=300), st.text(max_size=300)))
def test_any_file_is_refused_in_words(data):
    with pytest.raises(tig.StudyError):
        tig.Study.from_toml(data)


values = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=20)),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=8,
)


@given(st.data())
def test_any_value_anywhere_is_read_or_refused_in_words(data):
    lines = FILE.split("\n")
    number = data.draw(st.integers(0, len(lines) - 1))
    key, equals, _ = lines[number].partition(" = ")
    junk = data.draw(st.one_of(values.map(str), values.map(repr), st.text(max_size=20)))
    lines[number] = f"{key}{equals}{junk}"
    with contextlib.suppress(tig.StudyError):
        assert isinstance(tig.Study.from_toml("\n".join(lines)), tig.Study)


def test_a_study_that_could_not_be_read_back_is_not_written():
    rows = [(5 + n / 7, 1e7 + n / 7, 0.1 + n / 7e4) for n in range(1000)]
    design = BLOCK.replace(
        pad_stiffness=tig.StiffnessCurve(rows), pad_loss_factor=None,
        boot_stiffness=tig.StiffnessCurve(rows), boot_loss_factor=None,
    )  # fmt: skip
    assert tig.Study.from_toml(tig.Study(design).to_toml()).design == design
    with pytest.raises(tig.StudyError, match="256 kB can be read back"):
        tig.Study(design, [tig.PinnedDesign("again", design)] * 8).to_toml()


@pytest.mark.parametrize(
    ("wrong", "path"),
    [
        ({"design": 5}, "design"),
        ({"pinned": [5]}, "pinned[0]"),
        ({"pinned": [tig.PinnedDesign("a", BLOCK, colour=None)]}, "pinned[0].colour"),
        ({"specification": STUDY.source}, "specification"),
        ({"source": STUDY.specification}, "source"),
        ({"view": None}, "view"),
        ({"view": tig.View(base=0)}, "view.base"),
        ({"name": "a\tb"}, "name"),
    ],
)
def test_a_study_that_exists_is_valid(wrong, path):
    with pytest.raises(tig.StudyError) as caught:
        tig.Study(**{"design": BLOCK, **wrong})
    assert caught.value.path == path
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.path) == (str(caught.value), path)


def test_a_pinned_design_is_a_design():
    with pytest.raises(tig.StudyError, match="design: 'slab-track': give a TrackDesign"):
        tig.PinnedDesign("Slab", "slab-track")


@pytest.mark.parametrize("load", [tig.study.StaticLoad(112.5e3), tig.study.StaticLoad(85e3, 2.6)])
def test_the_standing_wheels_are_kept(load):
    study = tig.Study(tig.PRESETS["slab-track"], load=load)
    assert tig.Study.from_toml(study.to_toml()) == study
    assert "[load]" not in tig.Study(tig.PRESETS["slab-track"]).to_toml()


@pytest.mark.parametrize(
    ("key", "value"), [("wheel_load_N", 10.0), ("wheelbase_m", 0.1), ("wheelbase_m", "true")]
)
def test_a_standing_wheel_that_cannot_be_is_named_by_its_key(key, value):
    text = tig.Study(tig.PRESETS["slab-track"]).to_toml() + f"\n[load]\n{key} = {value}\n"
    with pytest.raises(tig.StudyError, match=rf"load\.{key}: .*give a number from"):
        tig.Study.from_toml(text)


def test_vehicle_axles_and_ground_are_kept():
    surrounded = BLOCK.replace(
        suspension=tig.VEHICLES["metro"].suspension,
        axle_positions=(0.0, 2.4),
        speed=22.2,
        ground=tig.GROUNDS["stiff clay"],
    )
    laden = surrounded.replace(suspension=tig.VEHICLES["freight"].suspension, speed=None, ground=None)
    study = tig.Study(surrounded, [tig.PinnedDesign("Laden", laden)], view=tig.View(reference="stiff"))
    text = study.to_toml()
    assert tig.Study.from_toml(text) == study
    assert "speed_m_per_s = 22.2" in text
    for key in ("axle_positions", "suspension", "ground", "speed"):
        assert key not in tig.Study(BLOCK).to_toml()


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("body_mass_kg = 3500.0", "", "design.suspension.body_mass_kg: it is missing"),
        ("bogie_mass_kg = ", "bogie_mas_kg = ", "write 'bogie_mass_kg'"),
        ("mass_kg = 0.0", "mass_kg = -1.0", "design.ground.mass_kg: -1.0: give a number from 0"),
        ("[0.0, 2.4]", "[0.0, 99.0]", "design.axle_positions_m: (0.0, 99.0): give positions, each a number"),
        ("speed_m_per_s = 22.2", "speed_m_per_s = 0.2", "design.speed_m_per_s: 0.2: give a number from 1"),
    ],
)
def test_mistakes_in_vehicle_axles_and_ground_are_named_by_their_place(old, new, words):
    vehicle, ground = tig.VEHICLES["metro"].suspension, tig.GROUNDS["stiff clay"]
    design = BLOCK.replace(suspension=vehicle, axle_positions=(0.0, 2.4), speed=22.2, ground=ground)
    text = tig.Study(design).to_toml()
    assert old in text
    with pytest.raises(tig.StudyError) as caught:
        tig.Study.from_toml(text.replace(old, new))
    assert words in str(caught.value)
