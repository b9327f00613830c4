"""The address bar: what was encoded comes back, and whatever else is there does no harm."""

from urllib.parse import parse_qs, urlsplit

import pytest
from hypothesis import given
from hypothesis import strategies as st

import trackig_core as tig
from dashboard.fields import EXTRA_FIELDS, EXTRAS, NUMBERS, SHOWN, six_figures
from dashboard.persistence.link import MOST_PROBLEMS, VIEW_CHOICES, decode, encode, left_out
from dashboard.session import surroundings
from dashboard.session.inputs import (
    DesignInputs,
    GainDefinition,
    InputError,
    check_values,
    design_of,
    preset_values,
    read_input,
    values_of,
)
from dashboard.session.pins import Pins
from dashboard.theme import MOST_PINNED
from trackig_core.names import LONGEST_NAME

OPENING = DesignInputs().to_values()

LINK_OF_VERSION_1 = (
    "v=1&preset=slab-track&pad_stiffness=150&pad_loss_factor=0.12&block_mass=45&boot_stiffness=28"
    "&boot_loss_factor=0.2&fastener_spacing=0.65&wheel_mass=900&contact_stiffness=1300&two_stage=0&rail=49E1"
    "&summation=coherent&reference=rigid"
    "&pin=3~0~booted-sleeper~160~0.2~210~31.5~0.3~0.75~450~1200~1~60E1~S%C3%B6fter+%7E+%C2%BD&base=1"
)
"""A link as somebody may have kept it: it opens the same study for ever."""


def arguments(query):
    """Return a query's arguments as a server hands them on."""
    return {key: [each.encode() for each in values] for key, values in parse_qs(query).items()}


def opened(**values):
    """Return what a link with some raw values opens."""
    return decode({key: [each] if isinstance(each, bytes) else each for key, each in values.items()})


def number(name):
    low, high = DesignInputs.param[name].bounds
    return st.floats(low, high).map(six_figures)


def pin(name, colour, values, shown=True):
    """Return a pinned design of some inputs."""
    return tig.PinnedDesign(name, design_of(values), colour, shown, values["preset"])


def extra(name):
    """Return any value of an extra number: nothing too, where there may be none."""
    return st.one_of(st.just(EXTRA_FIELDS[name].default), number(name))


any_values = st.fixed_dictionaries(
    {
        "preset": st.sampled_from([*tig.PRESETS]),
        "two_stage": st.booleans(),
        "rail": st.sampled_from([*tig.RAILS]),
        **{name: number(name) for name in NUMBERS},
        "special": st.just({}),
        **{name: extra(name) for name in EXTRAS},
    }
)
any_view = st.fixed_dictionaries(
    {}, optional={key: st.sampled_from(each) for key, each in VIEW_CHOICES.items()}
)
any_name = st.text(min_size=1, max_size=LONGEST_NAME).filter(
    lambda name: name.isprintable() and name == name.strip() != ""
)
any_pins = st.lists(
    st.tuples(any_name, st.integers(0, MOST_PINNED - 1), any_values, st.booleans()),
    max_size=MOST_PINNED,
    unique_by=(lambda pin: pin[0], lambda pin: pin[1]),
).map(lambda rows: tuple(pin(*row) for row in rows))


@given(any_values, any_view, any_pins, st.data())
def test_what_was_encoded_comes_back(values, view, pins, data):
    base = data.draw(st.sampled_from([None, *range(len(pins))]))
    link = decode(arguments(encode(values, view, pins, base)))
    assert link.values == surroundings.OFF | values
    assert link.view == view
    assert link.pins == pins
    assert link.base == base
    assert link.problems == ()


@given(any_values)
def test_a_link_reopens_the_same_design(values):
    there, here = DesignInputs(), DesignInputs()
    there.take(values)
    here.take(decode(arguments(encode(there.to_values()))).values)
    assert here.to_design() == there.to_design()


def test_the_whole_design_is_in_a_link_even_if_it_is_the_opening_one():
    assert {*SHOWN} <= arguments(encode(OPENING)).keys()


def test_extra_numbers_stand_in_a_link_only_where_they_are_set():
    assert not {*EXTRAS} & arguments(encode(OPENING)).keys()
    set_ = OPENING | {"wheelbase": 2.5, "stiffness_frequency": 10.0}
    assert {*EXTRAS} & arguments(encode(set_)).keys() == {"wheelbase", "stiffness_frequency"}


@pytest.mark.parametrize(
    "extras", ["x", "pad_static_stiffness", "pad_static_stiffness=", "wheel_load=9", ";;=1"]
)
def test_extra_numbers_of_a_pin_that_cannot_be_read_change_nothing(extras):
    (kept,) = opened(pin=pin_text(shown=f"1;{extras}")).pins
    assert kept.design == design_of(OPENING)
    assert kept.shown


def test_a_kept_link_opens_the_same_study_for_ever():
    link = decode(arguments(LINK_OF_VERSION_1))
    assert link.problems == ()
    assert link.values == surroundings.OFF | {
        "preset": "slab-track",
        "two_stage": False,
        "rail": "49E1",
        "pad_stiffness": 150.0,
        "pad_loss_factor": 0.12,
        "block_mass": 45.0,
        "boot_stiffness": 28.0,
        "boot_loss_factor": 0.2,
        "fastener_spacing": 0.65,
        "wheel_mass": 900.0,
        "contact_stiffness": 1300.0,
        "special": {},
        **{name: field.default for name, field in EXTRA_FIELDS.items()},
    }
    assert link.view == {"summation": "coherent", "reference": "rigid"}
    (opened_pin,) = link.pins
    assert (opened_pin.name, opened_pin.colour, opened_pin.shown) == ("Söfter ~ ½", 3, False)
    assert (opened_pin.preset, link.base) == ("booted-sleeper", 0)
    assert opened_pin.design == tig.PRESETS["booted-sleeper"].replace(
        pad_stiffness=160e6, boot_loss_factor=0.3, rail=tig.RAILS["60E1"]
    )
    assert encode(link.values, link.view, link.pins, link.base) == LINK_OF_VERSION_1.replace("%7E", "~")


def test_the_longest_link_fits_any_server_and_browser():
    name = "\N{SNOWMAN}" * LONGEST_NAME
    values = {**OPENING, **dict.fromkeys(("pad_loss_factor", "fastener_spacing"), 0.212345)}
    pins = [pin(name[:-1] + str(key), key, values) for key in range(MOST_PINNED)]
    assert len(encode(values, {}, pins)) < 5000


def test_no_link_is_the_opening_design():
    link = decode({})
    assert (link.values, link.view, link.pins, link.base, link.problems) == (OPENING, {}, (), None, ())


def test_a_link_by_hand_names_a_preset_and_what_differs():
    link = opened(preset=b"slab-track", pad_stiffness=b"150")
    assert link.values == {**preset_values("slab-track"), "pad_stiffness": 150.0}
    assert link.problems == ()


def test_a_number_without_bound_is_no_number():
    link = opened(pad_stiffness=b"1e999")
    assert design_of(link.values) == design_of(OPENING)
    assert link.problems == ("Pad stiffness is too large a number; it stays at 100 kN/mm.",)


@pytest.mark.parametrize(
    ("raw", "shown"),
    [(b"1e99", "1e+99"), (b"-0", "-0"), (b"-5", "-5"), (b"0.0999", "0.0999"), (b"1.01e7", "1.01e+07")],
)
def test_a_number_that_no_track_has_leaves_the_preset_s_and_the_range_of_its_box_is_said(raw, shown):
    link = opened(preset=b"booted-sleeper", pad_stiffness=raw)
    assert link.values == preset_values("booted-sleeper")
    assert link.problems == (
        f"Pad stiffness is {shown} kN/mm, and its box takes 10 to 2000 kN/mm; it stays at 150 kN/mm.",
    )


@pytest.mark.parametrize("name", [*NUMBERS, *EXTRAS])
@pytest.mark.parametrize("beyond", ["-1", "1e30"])
def test_the_range_that_is_said_is_the_one_that_the_box_says(name, beyond):
    link = opened(**{name: beyond.encode()})
    assert link.values == OPENING
    (problem,) = link.problems
    with pytest.raises(InputError) as refused:
        read_input(name, float(beyond))
    assert f" takes {str(refused.value).removeprefix('give ')}; it " in problem


def test_a_loss_factor_goes_as_far_as_its_box():
    link = opened(pad_loss_factor=b"1.9")
    assert (design_of(link.values).pad_loss_factor, link.problems) == (1.9, ())


@pytest.mark.parametrize(
    "stiffness", [9.99e6, 2000.01e6, 3000e6, 100.0001e6, 123456789.125, 5e12 / 3 // 1, 1e13]
)
def test_numbers_that_no_slider_shows_come_back_exactly(stiffness):
    design = design_of(OPENING).replace(pad_stiffness=float(stiffness))
    values = preset_values(OPENING["preset"]) | values_of(design)
    pinned = (tig.PinnedDesign("Odd", design, preset=OPENING["preset"]),)
    link = decode(arguments(encode(values, {}, pinned, 0)))
    assert link.values == values
    assert (link.pins, link.base) == (pinned, 0)
    beyond = [problem.endswith("kN/mm; it was taken all the same.") for problem in link.problems]
    assert beyond == ([] if 10e6 <= stiffness <= 2000e6 else [True, True]), "of the design and of its pin"
    assert left_out(values, pinned) == []


CURVE = tig.StiffnessCurve([(5, 90e6, 0.1), (500, 150e6, 0.2)])
NEEDS_FILE = {
    "a curve": ({"pad_stiffness": CURVE, "pad_loss_factor": None}, "Pad stiffness", "pad stiffness"),
    "a rail": ({"rail": tig.Rail("UIC 60 worn", 58.0, 6e6)}, "Rail section", "rail section"),
}


@pytest.mark.parametrize(("changes", "said", "copied"), NEEDS_FILE.values(), ids=NEEDS_FILE)
def test_what_needs_the_study_file_is_said_where_the_link_is_opened_and_copied(changes, said, copied):
    design = design_of(OPENING).replace(**changes)
    odd, plain = tig.PinnedDesign("Odd", design), pin("Plain", 1, OPENING)
    values = preset_values(OPENING["preset"]) | values_of(design)
    link = decode(arguments(encode(values, {}, (odd, plain), 1)))
    assert link.values == OPENING
    assert (link.pins, link.base) == ((plain,), 0)
    assert link.problems == (
        f"{said}: the link cannot hold it and needs the study file; the sliders stand in.",
        "Pinned designs with curves or rails of their own are missing: they are in the study file.",
    )
    assert left_out(values, (odd, plain)) == [f"the {copied}", "the pinned design “Odd”"]
    assert decode(arguments(encode(values, {}, (odd, plain), 0))).base is None


@pytest.mark.parametrize(
    "raw",
    [
        *(b"", b" ", b"nan", b"NaN", b"inf", b"-Infinity", b"abc", b"1_000", b"0x10", b"1,5", b"1e", b"--1"),
        *(
            b"9" * 5000,
            b"1" + b"0" * 40,
            b"12\x00",
            b"\xff\xfe",
            b"null",
            b"[1,2]",
            b"<script>alert(1)</script>",
        ),
        *("١٢".encode(), b"100 ", b"1e5" * 2000),
    ],
)
def test_what_is_no_number_is_ignored_and_said(raw):
    link = opened(pad_stiffness=raw)
    assert link.values == OPENING
    assert link.problems == ("Pad stiffness is no number; it stays at 100 kN/mm.",)


@pytest.mark.parametrize("name", ["preset", "two_stage", "rail", "summation", "reference"])
@pytest.mark.parametrize("raw", [b"", b"2", b"True", b"<img src=x>", b"\xff", b"x" * 9999])
def test_choices_that_are_not_on_offer_are_ignored_and_said(name, raw):
    link = opened(**{name: raw})
    assert (link.values, link.view) == (OPENING, {})
    assert len(link.problems) == 1
    said, can_be = link.problems[0].split("; it can be ")
    assert said.endswith("in the link is unknown and was ignored")
    for each in can_be.removesuffix(".").removesuffix(", …").split(", "):
        assert opened(**{name: each.encode()}).problems == (), "what is said to be possible is"


def test_a_page_may_offer_further_views():
    raw = {"tab": [b"verify"], "summation": [b"coherent"]}
    assert decode(raw).view == {"summation": "coherent"}
    assert decode(raw, {**VIEW_CHOICES, "tab": ("explore", "verify")}).view == {
        "tab": "verify",
        "summation": "coherent",
    }


def test_views_are_those_that_the_page_offers():
    for name, allowed in VIEW_CHOICES.items():
        for value in allowed:
            assert getattr(GainDefinition(**opened(**{name: value.encode()}).view), name) == value


def test_unknown_keys_are_said_by_their_letters_alone():
    link = decode({"<script>alert(1)</script>": [b"1"], "k" * 5000: [b"<b>"], "\0\n": [b""]})
    assert link.values == OPENING
    assert [problem.split("”")[0] for problem in link.problems] == [
        "“?script?alert?1???script…",
        "“" + "k" * 24 + "…",
        "“??",
    ]


def test_keys_of_the_server_are_none_of_ours():
    assert decode({"theme": [b"dark"], "bokeh-session-id": [b"x"], "autoload": [b""]}).problems == ()


def test_the_first_of_duplicates_is_taken_and_said():
    link = opened(block_mass=[b"50", b"60"], wheel_mass=[b"500", b"500"])
    assert (link.values["block_mass"], link.values["wheel_mass"]) == (50, 500)
    assert link.problems == ("Block mass is in the link more than once; the first was taken.",)


def test_a_newer_link_is_opened_as_far_as_it_is_known():
    link = opened(v=b"2", block_mass=b"50", colour_of_sleepers=b"green")
    assert link.values["block_mass"] == 50
    assert len(link.problems) == 2


def pin_text(colour="0", shown="1", name="Pin", **values):
    return "~".join(
        (colour, shown, *(str({**OPENING, "two_stage": 1, **values}[key]) for key in SHOWN), name)
    ).encode()


def test_pins_that_cannot_be_read_are_left_out_and_the_base_follows():
    link = opened(
        pin=[b"junk", pin_text(name="First"), pin_text(rail="<b>"), pin_text(name="Second")], base=b"4"
    )
    assert [pin.name for pin in link.pins] == ["First", "Second"]
    assert link.base == 1
    assert link.problems == (
        "Pin 1: it cannot be read; it was ignored.",
        "Pin 3: it cannot be read; it was ignored.",
    )


def test_a_single_stage_pin_reopens_whatever_an_old_link_says_of_its_second_stage():
    slab = {"preset": "slab-track", "two_stage": 0, "pad_stiffness": 150}
    link = opened(pin=pin_text(**slab, block_mass=321, boot_stiffness=7))
    assert link.problems == ()
    (slab_pin,) = link.pins
    assert slab_pin.design.boot_stiffness is None
    assert slab_pin.design.pad_stiffness == 150e6
    again = decode(arguments(encode(OPENING, {}, link.pins)))
    assert again.pins == link.pins


def test_pins_are_made_to_differ():
    link = opened(pin=[pin_text(), pin_text(), pin_text(colour="99"), pin_text(colour="-1", name="")])
    assert [pin.name for pin in link.pins] == ["Pin", "Pin 2", "Pin 3", "Design 1"]
    assert [pin.colour for pin in link.pins] == [0, 1, 2, 3]


def test_values_that_no_pin_can_have_are_its_preset_s_and_said():
    link = opened(pin=pin_text(block_mass="1e6"))
    assert link.pins[0].design.block_mass == 45
    assert link.problems == (
        "Pin 1: Block mass is 1e+06 kg, and its box takes 10 to 500 kg; it stays at 45 kg.",
    )


def test_eight_pins_are_taken_of_a_thousand():
    link = opened(pin=[pin_text()] * 1000)
    assert len(link.pins) == MOST_PINNED
    assert link.problems == ("The link has 1000 pinned designs; 8 were taken.",)


@pytest.mark.parametrize("base", [b"0", b"2", b"-1", b"x", b"1" * 5000])
def test_a_base_that_is_no_pin_is_ignored_and_said(base):
    link = opened(pin=pin_text(), base=base)
    assert link.base is None
    assert len(link.problems) == 1


def test_names_in_a_link_are_shown_as_one_short_line():
    (named,) = opened(pin=pin_text(name="\u202ea\nb" + "c" * 400)).pins
    assert named.name == "a b" + "c" * 35 + "…"


any_key = st.sampled_from(["v", "pin", "base", "file", *SHOWN, *VIEW_CHOICES]) | st.text()
any_raw = (
    st.binary()
    | st.text().map(lambda text: text.encode("utf-8", "surrogatepass"))
    | st.floats().map(lambda value: repr(value).encode())
    | st.integers().map(lambda value: str(value).encode())
    | st.lists(st.sampled_from([b"~", b"0", b"1", b"60", b"slab-track", b"9e9", b"\xff"]), max_size=30).map(
        b"".join
    )
    | st.sampled_from([b"pins", b"rail,pad_stiffness", ",".join(SHOWN).encode(), b"<b>,pins"])
    | any_pins.filter(bool).map(lambda pins: pin_text(name=pins[0].name))
)


@given(st.dictionaries(any_key, st.lists(any_raw, max_size=12), max_size=20))
def test_nothing_that_a_link_may_hold_does_harm(hostile):
    link = decode(hostile)
    check_values(link.values)
    inputs = DesignInputs()
    inputs.take(link.values)
    inputs.to_design()
    GainDefinition(**link.view)
    pins = Pins()
    pins.replace_all(link.pins, link.base)
    assert decode(arguments(encode(link.values, link.view, link.pins, link.base))).pins == link.pins
    assert len(link.problems) <= MOST_PROBLEMS + 1
    for problem in link.problems:
        assert len(problem) < 160
        assert problem.isprintable()
        assert not {*"<>&\"'"} & {*problem}


def test_a_query_stays_one_argument_after_the_question_mark():
    odd = pin("a&b=c#d?<e>", 0, OPENING)
    parts = urlsplit("http://here/dashboard?" + encode(OPENING, {}, [odd]))
    assert parts.fragment == ""
    assert decode(arguments(parts.query)).pins == (odd,)
