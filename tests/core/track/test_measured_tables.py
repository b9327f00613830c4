"""Tables of measured stiffness: columns, units, what is asked, and the bands that nobody measured."""

import pytest

import trackig_core as tig
from trackig_core.track.measured_tables import read_stiffness

PAD = ((1.0, 310.4e6, 0.151), (10.0, 605.7e6, 0.151), (30.0, 671.0e6, 0.151))
"""A pad that stiffens with frequency, as a test house reports it up to 30 Hz."""


@pytest.mark.parametrize(
    ("data", "unit"),
    [
        (
            "Frequenz [Hz];Steifigkeit [kN/mm];Verlustfaktor\n1;310,4;0,151\n10;605,7;0,151\n30;671;0,151",
            "kN/mm",
        ),
        ("f (Hz),k' (N/mm),eta (-)\n1,310.4e3,.151\n10,605.7e3,.151\n30,671e3,.151", "N/mm"),
        ("freq;loss factor, %;k_dyn MN/m\n30;15.1;671\n10;15.1;605.7\n1;15.1;310.4", "MN/m"),
        (
            "frequency_hz stiffness_N_per_m loss_factor\n1 310.4e6 0.151\n10 605.7e6 0.151\n30 671e6 0.151",
            "N/m",
        ),
        ("f [Hz]\t1\t10\t30\nk [kN/mm]\t310,4\t605,7\t671\nη\t0,151\t0,151\t0,151", "kN/mm"),
    ],
)
def test_columns_and_units_are_found(data, unit):
    reading = read_stiffness(data)
    assert reading.curve.points == PAD
    assert (reading.unit, reading.is_assumed, reading.question, reading.notes) == (unit, False, "", ())


def test_real_and_imaginary_part_make_a_loss_factor():
    reading = read_stiffness("f [Hz];Re(k) [MN/m];Im(k) [MN/m]\n10;20;4\n500;25;5")
    assert reading.curve.points == ((10.0, 20e6, 0.2), (500.0, 25e6, 0.2))


def test_a_magnitude_is_not_taken_for_the_real_part():
    reading = read_stiffness("f [Hz];|k| [MN/m];eta\n10;5;0.75\n20;5;0.75")
    assert [stiffness for _, stiffness, _ in reading.curve.points] == pytest.approx([4e6, 4e6], rel=1e-12)


def test_a_unit_that_is_not_given_is_assumed_and_named():
    reading = read_stiffness("1 310.4 0.151\n10 605.7 0.151\n30 671 0.151")
    assert reading.curve.points == PAD
    assert (reading.unit, reading.is_assumed, reading.question) == ("kN/mm", True, "")
    assert reading.notes == ("no unit of stiffness is given: kN/mm is assumed",)


def test_where_two_units_make_a_pad_it_is_asked():
    reading = read_stiffness("10 2000 0.2\n20 3000 0.2")
    assert "is it in N/mm or in kN/mm?" in reading.question
    answered = read_stiffness("10 2000 0.2\n20 3000 0.2", unit="N/mm")
    assert answered.curve.points == ((10.0, 2e6, 0.2), (20.0, 3e6, 0.2))
    assert answered.question == ""


def test_a_header_a_thousand_times_off_is_asked_about_and_may_be_overruled():
    data = "f (Hz),k (N/mm),eta\n199.5,3.86e9,0.1\n3162,3.9e9,0.1\n"
    reading = read_stiffness(data)
    assert reading.question == (
        "in N/mm, the stiffness is 3,860,000 to 3,900,000 kN/mm, and pads have 1 to 10,000: "
        "are the figures in N/m?"
    )
    assert reading.suggestion == "N/m"
    assert read_stiffness(data, unit="N/m").curve.points == ((199.5, 3.86e9, 0.1), (3162.0, 3.9e9, 0.1))


def test_a_table_is_read_from_the_door_and_becomes_a_designs():
    reading = tig.study.read_stiffness("f [Hz];k [kN/mm];eta\n10;20;0.06\n200;23.2;0.079")
    assert (reading.unit, reading.question) == ("kN/mm", "")
    design = tig.PRESETS["slab-track"].replace(pad_stiffness=reading.curve, pad_loss_factor=None)
    assert design.pad_stiffness.points[0] == (10.0, 20e6, 0.06)


def test_what_is_set_aside_is_said():
    reading = read_stiffness("T;f;k [kN/mm];eta\n20;0;18;0.1\n20;10;20;0.1\n20;20;;0.1\n20;30;22;0.1")
    assert reading.curve.points == ((10.0, 20e6, 0.1), (30.0, 22e6, 0.1))
    assert reading.notes == (
        "line 2 is not read: 0 Hz has no dynamic stiffness",
        "line 4 is not read: a value is missing",
        "column 1 ('T') is not read",
    )


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("", "no columns: give columns of frequency, stiffness and loss factor"),
        ("f;k\n10;20\n20;20", "column 2 ('k'): give columns of frequency, stiffness and loss factor"),
        ("f;k;eta;k2\n10;20;.1;3\n20;20;.1;3", "column 4 ('k2')"),
        ("f;k [kN/mm];eta\n10;2x0;.1\n20;20;.1", "line 2, column 2: '2x0'"),
        ("f;k [kN/mm];eta\n10;20;.1\n20;soft;.1\n30;20;.1", "line 3, column 2: 'soft' is no number"),
        ("f;k [kN/mm];eta\n20;20;.1\n10;20;3", "line 3: loss factor = 3.0: give a number from 0.0001 to 2"),
        ("f;k [kN/mm];eta\n10;1e9;.1\n20;1e9;.1", "are the figures in N/m?"),
        ("f;k [kN/mm];eta\n10;20 kg;.1\n20;20;.1", "'20 kg' is in kg, a unit of mass: give it in N/m"),
        (b"%PDF", "this is a PDF"),
    ],
)
def test_what_cannot_be_used_says_where_and_why(data, words):
    with pytest.raises(tig.MeasurementError) as caught:
        read_stiffness(data)
    assert words in str(caught.value)


def test_an_answer_must_be_a_unit_of_stiffness():
    with pytest.raises(ValueError, match="give a unit of stiffness"):
        read_stiffness("10 2000 0.2\n20 3000 0.2", unit="kg")


TABLE = "f [Hz];k [kN/mm];eta\n10;20;0.1\n20;22;0.1"
POINTS = ((10.0, 20e6, 0.1), (20.0, 22e6, 0.1))


@pytest.mark.parametrize(
    "data",
    [
        f"# preload: 30 kN\n{TABLE}",
        f"Vorlast: 30,0 kN\n{TABLE}",
        f"Vorlast;30;kN\n{TABLE}",
        f"Preload [kN];30\n{TABLE}",
        f"Pad 7, static preload F0 = 30 000 N, 23 °C\n{TABLE}",
        "f [Hz];k [kN/mm] at preload 30 kN;eta\n10;20;0.1\n20;22;0.1",
        "f [Hz] k [kN/mm] eta\npreload 30 kN\n10 20 0.1\n20 22 0.1",
        "Précharge [N];f [Hz];k [kN/mm];eta\n3e4;10;20;0.1\n;20;22;0.1",
        "f [Hz];k [kN/mm];eta;preload\n10;20;0.1;30 kN\n20;22;0.1;30 kN",
        "f [Hz];k [kN/mm];eta;remark\n10;20;0.1;preload 30 kN\n20;22;0.1;preload 30 kN",
        "f [Hz]\t10\t20\nk [kN/mm]\t20\t22\nη\t0.1\t0.1\npreload [kN]\t30\t30",
    ],
)
def test_the_preload_is_kept_wherever_it_stands(data):
    reading = read_stiffness(data)
    assert (reading.curve.points, reading.curve.preload) == (POINTS, 30e3)
    assert (reading.unit, reading.question) == ("kN/mm", "")
    assert [each for each in reading.notes if "remark" not in each] == []


@pytest.mark.parametrize(
    "data", [f"# preload: 30\n{TABLE}", f"preload;f;k [kN/mm];eta\n{'30;10;20;0.1'}\n;20;22;0.1"]
)
def test_a_preload_without_a_unit_is_taken_to_be_in_kilonewtons_and_that_is_said(data):
    reading = read_stiffness(data)
    assert reading.curve.preload == 30e3
    assert "no unit of preload is given: kN is assumed" in reading.notes
    assert read_stiffness(data.replace("30", "30000", 1)).curve.preload == 30e3


@pytest.mark.parametrize(
    "line",
    ["preload 20 to 40 kN", "preload 0.03 N/mm2", "preload 1,200 N", "preload 30 t", "preload 30 tons"],
)
def test_a_preload_that_is_not_certain_is_left_out_with_a_word(line):
    reading = read_stiffness(f"# {line}\n{TABLE}")
    assert (reading.curve.points, reading.curve.preload) == (POINTS, None)
    assert reading.notes == ("line 1: the preload is not read; write it as in 'preload: 30 kN'",)
    reading = read_stiffness(f"{line}\n{TABLE}")
    assert (reading.curve.points, reading.curve.preload) == (POINTS, None)
    assert "line 1 is not read" in reading.notes[0]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (
            f"# preload: 30 kN\n# Vorlast: 40 kN\n{TABLE}",
            "preloads of 30 kN (line 1), 40 kN (line 2): a curve is of one",
        ),
        (
            "f;k [kN/mm] at preload 20 kN;k [kN/mm] at preload 40 kN;eta\n10;20;30;.1",
            "preloads of 20 kN (line 1)",
        ),
        ("preload [kN];f;k [kN/mm];eta\n20;10;20;.1\n40;10;30;.1", "40 kN (column 1 ('preload [kN]'))"),
        (
            "preload [kN];f;k [kN/mm];eta\n" + "\n".join(f"{n};{n};20;.1" for n in range(1, 9)),
            "4 kN (column 1 ('preload [kN]')) and 4 more",
        ),
        (f"preload: -30 kN\n{TABLE}", "line 1: preload = -30000.0: give a number from 0 to 1e+06 N"),
        (f"preload: 1e300 kN\n{TABLE}", "line 1: preload = 1e+303"),
    ],
)
def test_several_preloads_or_one_that_no_support_has_are_refused(data, words):
    with pytest.raises(tig.MeasurementError) as caught:
        read_stiffness(data)
    assert words in str(caught.value)
    assert len(str(caught.value)) < 300


def test_bands_that_nobody_measured_are_named():
    curve = tig.StiffnessCurve(PAD)
    beyond = tig.BAND_LABELS[tig.BAND_LABELS.index("31.5") :]
    assert curve.extrapolated_bands == beyond
    assert tig.LossFactorCurve([(5, 0.1), (500, 0.1)]).extrapolated_bands == ()
    assert tig.LossFactorCurve([(6, 0.1), (400, 0.1)]).extrapolated_bands == ("5", "500")
    design = tig.PRESETS["slab-track"].replace(pad_stiffness=curve, pad_loss_factor=None)
    solution = tig.solve(design, "exact")
    assert solution.extrapolated_bands == beyond
    note = "the pad stiffness was measured from 1 to 30 Hz: bands from 31.5 Hz on rest on extrapolation"
    assert note in solution.notes
    middle = design.replace(pad_stiffness=3e8, pad_loss_factor=tig.LossFactorCurve([(20, 0.1), (63, 0.1)]))
    solution = tig.solve(middle, "exact")
    assert "bands up to 16 Hz and from 80 Hz on rest on extrapolation" in solution.notes[-1]
    whole = tig.StiffnessCurve([(5, 3e8, 0.15), (500, 4e8, 0.15)])
    solution = tig.solve(design.replace(pad_stiffness=whole), "exact")
    assert solution.extrapolated_bands == ()
    assert not any("extrapolation" in note for note in solution.notes)
