"""The track as a drawing: wheel, contact, rail, pads, blocks and boots, as large as they are stiff or heavy.

Bogie and body stand above the wheel, feet on springs below the supports, where the design has them.

The picture itself is ``assets/track.svg``, a Jinja template; here every length in it is computed, in
the units of its view box [px]. Along the rail it is true to scale. Across, stiffness makes a spring's
wire thick and its turns few, on one scale for pad, boot and contact; mass makes wheel and block
large, as of equal shape; the loss factor fills the damper. Nothing leaves its place in the picture, whatever
the core allows.
"""

import math
from functools import cache

import jinja2

import trackig_core as tig
from dashboard import assets, formats, theme
from dashboard.fields import NEWTON_PER_METRE, STIFFNESSES, to_display
from dashboard.session.inputs import DesignInputs
from trackig_core.track.design import REFERENCE_FREQUENCY

WIDTH, HEIGHT = 728, 624
"""The view box [px]: shown 650 px wide, text is still 16 px high."""

SCALE = 360.0
"""Length of a metre along the rail [px]."""

FONT_SIZE, LINE_HEIGHT = 18, 23
LABELS_END = 196
"""Right end of the labels [px]; lines lead from there to the parts."""

LEFT = 212
"""Where the drawn part of the track begins [px]."""

WHEEL_X = 292
"""Where the wheel stands, over a support [px]."""

WHEEL_BOTTOM, RAIL_FOOT, BLOCK_CENTRE, FLOOR = 168, 254, 399, 544
"""Levels that no slider moves [px]."""

SLAB_TOP = 376
"""Level of the ground below pads that have no blocks [px]."""

BOOT_RIM = 404
"""Level up to which boots reach; the ground between them is filled up to it [px]."""

DIMENSION = 584
"""Level of the dimension line [px]."""

WHEEL_RADIUS = (38.0, 74.0)
RAIL_HEIGHT = (22.0, 32.0)
BLOCK_HEIGHT = (24.0, 88.0)
WIRE = (1.4, 6.5)
TURNS = (10, 3)
"""Sizes at the lowest and the highest value of a slider [px; turns have no unit]."""

CONTACT_REACH = 12.0
"""Half of the width of the contact spring [px]."""

WIDEST_BLOCK, WIDEST_LAYER = 132.0, 72.0
"""Widths where supports stand far apart [px]."""

WHEEL_LABEL, CONTACT_LABEL, RAIL_LABEL, PAD_LABEL, BLOCK_LABEL, BOOT_LABEL = 122, 187, 252, 309, 401, 466
SLAB_LABEL, GROUND_LABEL, SPACING_LABEL = 446, 550, 590
"""Baselines of the labels' first lines [px]; the line to the part starts a little higher."""

LEADER_RISE = 6
"""Height of the line to a part above its label's baseline [px]."""

BOOT_LINING, BOOT_ROOM = 5.0, 1.5
"""Thickness of a boot's wall, and its distance from the block [px]."""

LEAST_WALL = 3.0
"""Ground between two boots at least [px]."""

LONGEST_NAME, LONGEST_SPOKEN_NAME = 12, 40
"""Characters of a rail's name that have room in the picture, and in words."""

FULL_LOSS = DesignInputs.param.pad_loss_factor.bounds[1]
"""Loss factor that fills a damper [-]: the sliders' highest."""

DAMPER_REACH = 22.0
"""Half of the height of a damper [px]."""

VEHICLE_ROOM, GROUND_ROOM = 156, 66
"""Room that bogie and body need above the wheel, and springs of the ground below the supports [px]."""

BOGIE_TOP, BODY_TOP, CARRIED_HEIGHT, CARRIED_WIDTH = -66, -142, 28, 150
"""Levels and sizes of bogie and body, which no number of theirs moves [px]."""

BOGIE_LABEL, BODY_LABEL, NEXT_AXLE = -50, -126, 200
"""Baselines of their labels, and of the words on the next axle [px]."""

LABEL_DROP = 30
"""How much lower the ground's label stands beside its springs [px]."""

FOOT_HEIGHT = 9
"""Height of a support's foot on ground that yields [px]."""

TITLE = "The track, drawn"

WORDS = {
    "wheel": "Wheel: the unsprung mass on one rail",
    "contact": "Contact: steel against steel, a stiff spring between wheel and rail",
    "rail": "Rail: a beam that spreads the force over the supports",
    "pad": "Pad: the resilient layer under the rail",
    "block": "Block: the mass between pad and boot",
    "boot": "Boot: the soft layer around and under the block",
    "ground": "Ground: rigid; the force that it takes is the result",
    "spacing": "Spacing: from fastener to fastener",
    "vehicle": "Bogie and body: what the wheel carries on its suspension, a share of each",
    "foot": "Ground that yields: a spring and a damper under each support by itself",
}
"""What each part is, shown when the pointer rests on it."""


def track_svg(design):
    """Return the drawing of a track.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        Any design; sizes beyond the sliders' ranges are drawn as at their ends, and labelled as they are.

    Returns
    -------
    str
        An SVG element to be set into a page: it scales, takes the text's colour from around it, and
        holds no script, no reference and no identifier. Names in it are escaped.
    """
    parts = geometry(design)
    return _template().render(
        parts,
        labels=labels(design, parts),
        title=TITLE,
        description=description(design),
        words=WORDS,
        colours={"pad": theme.THIS_DESIGN, "block": theme.COUPLED_BLOCK, "boot": theme.LOADED_TRACK},
        font=theme.FONT,
        font_size=FONT_SIZE,
        line_height=LINE_HEIGHT,
        labels_end=LABELS_END,
    )


@cache
def _template():
    environment = jinja2.Environment(
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        finalize=lambda value: round(value, 2) if isinstance(value, float) else value,
    )
    return environment.from_string(assets.read_text("track.svg"))


def share(value, low, high):
    """Return where a value stands between two others on a logarithmic scale: 0 to 1, whatever the value."""
    return min(max(math.log(value / low) / math.log(high / low), 0.0), 1.0)


def between(ends, part):
    """Return the value that stands at a part, 0 to 1, of the way between two on a logarithmic scale."""
    return ends[0] * (ends[1] / ends[0]) ** part


def _share_of_slider(name, value):
    return share(value, *DesignInputs.param[name].bounds)


def _share_of_springs(stiffness):
    """Return where a stiffness [kN/mm] stands among all that the sliders offer."""
    bounds = [DesignInputs.param[name].bounds for name in STIFFNESSES]
    return share(stiffness, min(low for low, _ in bounds), max(high for _, high in bounds))


def geometry(design):
    """Return every length in the drawing.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The track.

    Returns
    -------
    dict
        Lengths and positions [px], by part.
    """
    pitch = SCALE * _drawn_spacing(design)
    room = min(pitch - LEAST_WALL - 2 * (BOOT_LINING + BOOT_ROOM), WIDEST_BLOCK)
    half = min(0.45 * room, WIDEST_LAYER / 2)
    supports = [WHEEL_X + pitch * count for count in range(math.ceil((WIDTH - WHEEL_X) / pitch) + 1)]
    radius = between(WHEEL_RADIUS, _share_of_slider("wheel_mass", design.wheel_mass))
    rail_top = RAIL_FOOT - _rail_height(design.rail)
    block = _block(design, 2 * half, room)
    boot = _boot(design, block, half)
    return {
        "width": WIDTH,
        "top": 0 if design.suspension is None else -VEHICLE_ROOM,
        "height": HEIGHT + _vehicle_room(design) + _ground_room(design),
        "left": LEFT,
        "floor": FLOOR,
        "supports": supports,
        "wheel": {"x": WHEEL_X, "radius": radius, "centre": WHEEL_BOTTOM - radius},
        "contact": _spring(_stiffness(design, "contact"), 0.0, CONTACT_REACH, WHEEL_BOTTOM, rail_top),
        "rail": {"top": rail_top, "foot": RAIL_FOOT},
        "pad": _layer(design, "pad", RAIL_FOOT, block["top"] if block else SLAB_TOP, half),
        "block": block,
        "boot": boot,
        "ground": _ground(supports, boot),
        "feet": _feet(design, half),
        "vehicle": _vehicle(design, WHEEL_BOTTOM - 2 * radius),
        "next_axle": _next_axle(design),
        "next_axle_y": NEXT_AXLE,
        "dimension": {
            "y": DIMENSION + _ground_room(design),
            "end": WHEEL_X + pitch,
            "text": f"{formats.quantity_text(design.fastener_spacing)} m",
        },
    }


def _vehicle_room(design):
    return 0 if design.suspension is None else VEHICLE_ROOM


def _ground_room(design):
    return 0 if design.ground is None else GROUND_ROOM


def _vehicle(design, wheel_top):
    """Return what stands above the wheel, or None: springs, and the masses that they carry."""
    carried = design.suspension
    if carried is None:
        return None
    masses, springs = [BOGIE_TOP], [_spring(*_soft(carried.primary_stiffness), BOGIE_TOP, wheel_top)]
    if carried.body_mass is not None:
        masses.append(BODY_TOP)
        springs.append(_spring(*_soft(carried.secondary_stiffness), BODY_TOP, BOGIE_TOP))
    for spring in springs:  # they end below the mass that they carry
        spring["spring"] = [(x, max(y, spring["top"] + CARRIED_HEIGHT)) for x, y in spring["spring"]]
    return {"masses": masses, "springs": springs, "height": CARRIED_HEIGHT, "width": CARRIED_WIDTH}


def _soft(stiffness):
    """Return a stiffness [kN/mm] with the place and half of the width of its spring [px]."""
    return stiffness / NEWTON_PER_METRE, 0.0, 2 * CONTACT_REACH


def _feet(design, half):
    """Return the feet of the supports and the springs below them, or None on rigid ground."""
    if design.ground is None:
        return None
    top = FLOOR if design.two_stage else SLAB_TOP
    floor, stiffness = FLOOR + GROUND_ROOM, design.ground.stiffness / NEWTON_PER_METRE
    spring = _spring(stiffness, 0.0, 0.34 * half, FLOOR + FOOT_HEIGHT, floor)
    return {**spring, "top": top, "bottom": FLOOR + FOOT_HEIGHT, "half": half, "floor": floor}


def _next_axle(design):
    """Return where the next wheel stands, in words; empty where there is none."""
    ahead = [each for each in design.axle_positions if each > 0]
    return f"next axle at {formats.quantity_text(min(ahead))} m →" if ahead else ""


def _drawn_spacing(design):
    low, high = DesignInputs.param.fastener_spacing.bounds
    return min(max(design.fastener_spacing, low), high)


def _rail_height(rail):
    stiffnesses = [each.bending_stiffness for each in tig.RAILS.values()]
    return between(RAIL_HEIGHT, share(rail.bending_stiffness, min(stiffnesses), max(stiffnesses)))


def _block(design, narrowest, widest):
    """Return the block, or None; its area grows with its mass, as far as the spacing leaves room."""
    if not design.two_stage:
        return None
    part = _share_of_slider("block_mass", design.block_mass)
    height = between(BLOCK_HEIGHT, part)
    return {
        "width": between((narrowest, widest), part),
        "top": BLOCK_CENTRE - height / 2,
        "bottom": BLOCK_CENTRE + height / 2,
    }


def _boot(design, block, half):
    """Return the boot, or None: the wall around the block, and the layer under it."""
    if block is None:
        return None
    layer = _layer(design, "boot", block["bottom"], FLOOR - BOOT_LINING, half)
    pocket = block["width"] / 2 + BOOT_ROOM + BOOT_LINING / 2
    return {**layer, "pocket": pocket, "rim": BOOT_RIM, "lining": BOOT_LINING}


def _ground(supports, boot):
    """Return the ground's outline, its surface, and where its hatching begins."""
    if boot is None:
        surface = f"M{LEFT},{SLAB_TOP} H{WIDTH}"
    else:
        outer = boot["pocket"] + BOOT_LINING / 2
        walls = (f"H{x - outer:.2f} V{FLOOR} H{x + outer:.2f} V{BOOT_RIM}" for x in supports)
        surface = f"M{LEFT},{BOOT_RIM} {' '.join(walls)} H{WIDTH}"
    return {
        "top": SLAB_TOP if boot is None else BOOT_RIM,
        "surface": surface,
        "outline": f"{surface} V{FLOOR} H{LEFT} z",
        "hatch": range(LEFT + 10, WIDTH + 10, 14),
    }


def _layer(design, part, top, bottom, half):
    """Return a pad or a boot: a spring and a damper side by side.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The track.
    part : str
        ``"pad"`` or ``"boot"``.
    top, bottom : float
        Levels between which it stands [px].
    half : float
        Half of its width [px].
    """
    middle = (top + bottom) / 2
    fullness = min(_loss_factor(design, part) / FULL_LOSS, 1.0)
    return {
        **_spring(_stiffness(design, part), -0.5 * half, 0.34 * half, top, bottom),
        "half": half,
        "damper": {
            "x": 0.5 * half,
            "half": 0.32 * half,
            "top": middle - DAMPER_REACH,
            "bottom": middle + DAMPER_REACH,
            "piston": middle - DAMPER_REACH / 3,
            "fluid": 2 * DAMPER_REACH * fullness,
        },
    }


def _spring(stiffness, x, reach, top, bottom):
    """Return a zigzag between two levels, its wire as thick and its turns as few as its stiffness asks."""
    part = _share_of_springs(stiffness)
    turns = round(TURNS[0] + (TURNS[1] - TURNS[0]) * part)
    lead = 0.1 * (bottom - top)
    length = bottom - top - 2 * lead
    corners = [
        (x + (reach if corner % 2 else -reach), top + lead + length * (corner + 0.5) / (2 * turns))
        for corner in range(2 * turns)
    ]
    ends = [(x, top), (x, top + lead)], [(x, bottom - lead), (x, bottom)]
    return {
        "spring": [*ends[0], *corners, *ends[1]],
        "wire": between(WIRE, part),
        "top": top,
        "bottom": bottom,
        "turns": turns,
    }


def _stiffness(design, part):
    """Return a spring's stiffness [kN/mm], at 50 Hz if it was measured over frequency."""
    value = getattr(design, f"{part}_stiffness")
    if isinstance(value, tig.StiffnessCurve):
        value = float(value.stiffness(REFERENCE_FREQUENCY))
    return to_display(f"{part}_stiffness", value)


def _loss_factor(design, part):
    """Return a layer's loss factor [-], at 50 Hz if it was measured over frequency."""
    stiffness, loss_factor = getattr(design, f"{part}_stiffness"), getattr(design, f"{part}_loss_factor")
    for curve in (stiffness, loss_factor):
        if isinstance(curve, tig.StiffnessCurve | tig.LossFactorCurve):
            return float(curve.loss_factor(REFERENCE_FREQUENCY))
    return loss_factor


def labels(design, parts):
    """Return the labels of the parts, from top to bottom.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The track.
    parts : dict
        Its :func:`geometry`.

    Returns
    -------
    list of dict
        Level of the first line [px], lines of text, and where the line to the part ends [px] or None.
    """
    wheel, pad, block = parts["wheel"], parts["pad"], parts["block"]
    above = wheel["centre"] - WHEEL_LABEL + LEADER_RISE
    wheel_edge = WHEEL_X - math.sqrt(wheel["radius"] ** 2 - above**2)
    spring_edge = WHEEL_X - 0.5 * pad["half"]
    rows = [
        (WHEEL_LABEL, ("Wheel", f"{_mass_text(design.wheel_mass)} unsprung"), wheel_edge),
        (CONTACT_LABEL, ("Contact", _stiffness_text(design, "contact")), WHEEL_X - CONTACT_REACH),
        (RAIL_LABEL, (_rail_name(design.rail, LONGEST_NAME), _rail_text(design.rail)), LEFT + 14),
        (PAD_LABEL, ("Pad", *_layer_text(design, "pad")), spring_edge),
    ]
    if block:
        block_edge = WHEEL_X - block["width"] / 2 + 6
        rows += [
            (BLOCK_LABEL, ("Block", _mass_text(design.block_mass)), block_edge),
            (BOOT_LABEL, ("Boot", *_layer_text(design, "boot")), spring_edge),
        ]
    else:
        rows.append((SLAB_LABEL, ("Slab", "no blocks, no boots"), LEFT + 14))
    if design.suspension is not None:
        rows += _carried_labels(design.suspension)
    to_scale = design.fastener_spacing == _drawn_spacing(design)
    if design.ground is None:
        rows.append((GROUND_LABEL, ("Ground, rigid",), LEFT + 14))
    else:
        foot_edge = WHEEL_X - 0.34 * pad["half"]
        rows.append((GROUND_LABEL + LABEL_DROP, ("Ground", _ground_text(design.ground)), foot_edge))
    rows += [
        (SPACING_LABEL + _ground_room(design), ("Spacing", "to scale" if to_scale else "not to scale"), None),
    ]
    return [{"y": y, "lines": lines, "target": target} for y, lines, target in rows]


def _carried_labels(carried):
    edge = WHEEL_X - CARRIED_WIDTH / 2 + 6
    yield BOGIE_LABEL, ("Bogie", f"{_mass_text(carried.bogie_mass)} a wheel"), edge
    if carried.body_mass is not None:
        yield BODY_LABEL, ("Body", f"{_mass_text(carried.body_mass)} a wheel"), edge


def _ground_text(ground):
    return f"{ground.stiffness / NEWTON_PER_METRE:.3g} kN/mm"


def _mass_text(mass):
    return f"{formats.quantity_text(mass)} kg"


def _rail_name(rail, longest):
    return f"Rail {formats.name_text(rail.name, longest)}"


def _rail_text(rail):
    return f"{formats.quantity_text(rail.mass_per_metre)} kg/m"


def _stiffness_text(design, part):
    return f"{formats.quantity_text(_stiffness(design, part))} kN/mm"


def _layer_text(design, part):
    return _stiffness_text(design, part), f"loss factor {formats.quantity_text(_loss_factor(design, part))}"


def description(design):
    """Return the drawing in words, for those who cannot see it."""
    rail = f"{_rail_name(design.rail, LONGEST_SPOKEN_NAME)}, {_rail_text(design.rail)}"
    layers = [f"a pad of {', '.join(_layer_text(design, 'pad'))}"]
    if design.two_stage:
        layers.append(f"a block of {_mass_text(design.block_mass)}")
        layers.append(f"a boot of {', '.join(_layer_text(design, 'boot'))}")
    return (
        f"A wheel of {_mass_text(design.wheel_mass)} unsprung mass stands on a contact spring of "
        f"{_stiffness_text(design, 'contact')}. {rail}. Under the rail, every "
        f"{formats.quantity_text(design.fastener_spacing)} m: {'; '.join(layers)}; "
        f"then {_ground_words(design)}."
        f"{_vehicle_words(design)}"
    )


def _ground_words(design):
    if design.ground is None:
        return "rigid ground"
    return f"a foot on ground of its own, {_ground_text(design.ground)}"


def _vehicle_words(design):
    """Return what stands above and beside the wheel, in words; empty if nothing does."""
    carried, words = design.suspension, ""
    if carried is not None:
        words += f" The wheel carries {_mass_text(carried.bogie_mass)} of a bogie"
        words += "." if carried.body_mass is None else f" and {_mass_text(carried.body_mass)} of a body."
    if len(design.axle_positions) > 1:
        at = ", ".join(formats.quantity_text(each) for each in design.axle_positions)
        words += f" Wheels stand at {at} m."
    return words
