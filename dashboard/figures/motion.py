"""The track from the side, in motion: rail, wheel, blocks and their springs, moved by the browser itself.

All frames of a film, or the complex shape of a steady vibration, are sent once; play, pause and scrub then
run in the browser and tell the server nothing (``syncable=False``). Movements are drawn larger than they
are by one factor everywhere, which the scale bar states; downward is towards the ground. Springs join what
they join: their drawn length shows how far they are squeezed. The browser adds nothing to what was solved but
mirror images and magnification.
"""

from dataclasses import dataclass

import numpy as np
from bokeh.core.properties import value
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, CustomJS, Range1d, Select, Slider, Span, Toggle
from bokeh.plotting import figure

from dashboard import theme
from dashboard.figures.axes import keep_sizes

WHEEL_AT, RAIL_AT, BLOCK_AT, FOOT_AT, FLOOR_AT = 0.66, 0.0, -0.6, -1.1, -1.5
"""Heights at rest: the wheel's centre, the rail, the blocks' centres, the supports' feet, where rigid ground
lies too, and what carries ground that yields [units of the drawing]."""

WHEEL_HEIGHT, BLOCK_HEIGHT = 0.62, 0.24
"""Heights of wheel, which is round, and block [units of the drawing]."""

FOOT_HEIGHT = 0.06
"""Height of a support's foot [units of the drawing]."""

BLOCK_WIDTH = 0.45
"""Width of a block over the spacing [-]."""

SEEN = (-1.2, 1.25)
"""Heights that are seen [units of the drawing]."""

BELOW_FLOOR = 0.1
"""What is seen below rigid ground, and below the floor of ground that yields [units of the drawing]."""

LARGEST = 0.3
"""What the largest movement is drawn as [units of the drawing]."""

BAR_LONGEST = 0.4
"""Length of the scale bar, at most [units of the drawing]."""

MICROMETRES = 1e6
"""One metre in µm."""

SPEEDS = {"1/25 of life": "25", "1/50 of life": "50", "1/100 of life": "100"}
"""How much slower than life a film may run: what is shown, and the factor."""

PERIOD = 2000
"""One period of a steady vibration as it is shown [ms]."""


class SideView:
    """The drawing that both players move.

    Parameters
    ----------
    name : str
        Prefix of the names of its figure and sources.

    Attributes
    ----------
    model : bokeh.plotting.figure
        The figure, ``<name>_figure``.
    rail : bokeh.models.ColumnDataSource
        ``<name>_rail``: ``x`` [m] and height ``y`` of the elements, left to right.
    supports : bokeh.models.ColumnDataSource
        ``<name>_supports``: ``x`` [m], heights of ``rail``, block (``block``, its ``top`` and ``bottom``) and
        ``ground``, ``width`` and that of the ``foot`` [m], and ``floor``; left to right. Blocks are NaN
        when single-stage, the foot has no width where none moves.
    wheel : bokeh.models.ColumnDataSource
        ``<name>_wheel``, a row per wheel: ``x`` [m], heights ``y`` of its centre, ``foot`` and ``rail``, and
        the ``element`` of the drawing on which it stands.
    facts : bokeh.models.ColumnDataSource
        ``<name>_facts``: ``scale`` [units of the drawing per unit of movement], and how many elements and
        bays of the left are mirror images of those that were sent.
    bar : bokeh.models.ColumnDataSource
        ``<name>_bar``: the scale bar's ``x``, ends ``low`` and ``high``, and ``text``.
    """

    def __init__(self, name):
        def source(part, *columns):
            # the browser moves these itself; nothing of that goes back
            return ColumnDataSource(name=f"{name}_{part}", data={key: [] for key in columns}, syncable=False)

        self.rail = source("rail", "x", "y")
        self.supports = source(
            "supports", "x", "rail", "block", "top", "bottom", "ground", "width", "foot", "floor"
        )
        self.wheel = source("wheel", "x", "y", "foot", "rail", "element")
        self.facts = source("facts", "scale", "elements", "bays")
        self.bar = source("bar", "x", "low", "high", "text")
        self.model = figure(
            name=f"{name}_figure",
            tools="",
            toolbar_location=None,
            x_range=Range1d(-8, 8),
            y_range=Range1d(*SEEN),
            x_axis_label="Along the track, m",
            sizing_mode="stretch_width",
            stylesheets=[theme.MEDIUM],
        )
        self.model.yaxis.visible = False
        self.model.grid.visible = False
        keep_sizes(self.model)
        self._draw()

    def _draw(self):
        plot, spring = self.model, {"line_color": theme.PRESET_GHOST, "line_width": theme.THIN_LINE_WIDTH}
        springs = {"x0": "x", "x1": "x", "source": self.supports, "line_dash": [2, 2], **spring}
        plot.segment(y0="rail", y1="top", **springs)
        plot.segment(y0="bottom", y1="ground", **springs)
        plot.segment(y0="ground", y1="floor", **springs)
        plot.rect(
            x="x",
            y="ground",
            width="foot",
            height=FOOT_HEIGHT,
            source=self.supports,
            fill_color=theme.PRESET_GHOST,
            line_color=None,
        )
        self.floor = Span(
            location=FOOT_AT, dimension="width", line_color=theme.PRESET_GHOST, line_width=theme.LINE_WIDTH
        )
        plot.add_layout(self.floor)
        plot.rect(
            x="x",
            y="block",
            width="width",
            height=BLOCK_HEIGHT,
            source=self.supports,
            fill_color=theme.COUPLED_BLOCK,
            line_color=None,
        )
        plot.line(
            x="x", y="y", source=self.rail, line_color=theme.THIS_DESIGN, line_width=2 * theme.LINE_WIDTH
        )
        plot.segment(x0="x", x1="x", y0="foot", y1="rail", source=self.wheel, **spring)
        plot.circle(
            x="x",
            y="y",
            radius=WHEEL_HEIGHT / 2,
            radius_dimension="y",
            source=self.wheel,
            fill_color=theme.LOADED_TRACK,
            fill_alpha=theme.BAR_ALPHA,
            line_color=None,
        )
        plot.segment(
            x0="x", x1="x", y0="low", y1="high", source=self.bar, line_width=theme.LINE_WIDTH,
            line_color=theme.PRESET_GHOST,
        )  # fmt: skip
        plot.text(
            x="x",
            y="high",
            text="text",
            source=self.bar,
            x_offset=8,
            text_baseline="top",
            text_color=theme.PRESET_GHOST,
            text_font=value(theme.FONT),
            text_font_size=theme.SIDE_VIEW_LABEL_SIZE,
        )

    def move(self, wheels, rail, block, foot):
        """Draw one instant, as the browser draws all others.

        Parameters
        ----------
        wheels : numpy.ndarray (wheels,)
            Displacements of the wheels [unit of the movements].
        rail, block, foot : numpy.ndarray
            Displacements of elements, blocks and feet as they are sent: to one side where the left is a
            mirror image; no blocks when single-stage, no feet where none moves.
        """
        scale, supports = self.facts.data["scale"][0], dict(self.supports.data)
        height = RAIL_AT - scale * _whole(rail, self.facts.data["elements"][0])
        bays = self.facts.data["bays"][0]
        supports["rail"] = height[:: (height.size - 1) // (supports["x"].size - 1)]
        if block.size:
            supports["block"] = BLOCK_AT - scale * _whole(block, bays)
            supports["top"] = supports["block"] + BLOCK_HEIGHT / 2
            supports["bottom"] = supports["block"] - BLOCK_HEIGHT / 2
        if foot.size:
            supports["ground"] = FOOT_AT - scale * _whole(foot, bays)
            if not block.size:
                supports["top"] = supports["ground"]
        centres = WHEEL_AT - scale * wheels
        self.rail.data = {**self.rail.data, "y": height}
        self.supports.data = supports
        self.wheel.data = {
            **self.wheel.data,
            "y": centres,
            "foot": centres - WHEEL_HEIGHT / 2,
            "rail": height[self.wheel.data["element"]],
        }

    def parts(self):
        """Return the arguments by which scripts of the browser know the drawing."""
        return {"rail": self.rail, "supports": self.supports, "wheel": self.wheel, "facts": self.facts}

    def lay_out(self, places, two_stage, yields, largest, unit):
        """Draw a track at rest.

        Parameters
        ----------
        places : Places
            Where its parts stand.
        two_stage, yields : bool
            Whether there are blocks, and whether feet move.
        largest : float
            Largest movement that will be drawn [unit].
        unit : str
            What the movements are counted in.
        """
        supports, spacing = places.supports, places.supports[1] - places.supports[0]
        room = 0.02 * (supports[-1] - supports[0])
        self.model.x_range.update(start=supports[0] - room, end=supports[-1] + room)
        scale = LARGEST / largest
        block = np.full(supports.size, BLOCK_AT if two_stage else np.nan)
        foot, floor = np.full(supports.size, FOOT_AT), FLOOR_AT if yields else FOOT_AT
        self.floor.location = floor
        self.model.y_range.start = floor - BELOW_FLOOR
        self.facts.data = {"scale": [scale], "elements": [places.elements], "bays": [places.bays]}
        self.bar.data = _bar(supports[0] - 0.4 * room, scale, unit)
        self.rail.data = {"x": places.rail, "y": np.full(places.rail.size, RAIL_AT)}
        self.supports.data = {
            "x": supports,
            "rail": np.full(supports.size, RAIL_AT),
            "block": block,
            "top": block + BLOCK_HEIGHT / 2 if two_stage else foot,
            "bottom": block - BLOCK_HEIGHT / 2,
            "ground": foot,
            "width": np.full(supports.size, BLOCK_WIDTH * spacing),
            "foot": np.full(supports.size, BLOCK_WIDTH * spacing if yields else 0.0),
            "floor": np.full(supports.size, floor),
        }
        count = places.wheels.size
        self.wheel.data = {
            "x": places.wheels,
            "y": np.full(count, WHEEL_AT),
            "foot": np.full(count, WHEEL_AT - WHEEL_HEIGHT / 2),
            "rail": np.full(count, RAIL_AT),
            "element": np.abs(places.rail[:, None] - places.wheels).argmin(axis=0),
        }


@dataclass(frozen=True, eq=False)
class Places:
    """Where the parts of a drawn track stand, left to right.

    Attributes
    ----------
    rail, supports, wheels : numpy.ndarray
        Elements, supports and wheels [m].
    elements, bays : int
        Elements and supports at the left that are mirror images of those at the right: none where something
        is known of both sides.
    """

    rail: np.ndarray
    supports: np.ndarray
    wheels: np.ndarray
    elements: int
    bays: int

    @classmethod
    def of(cls, moved):
        """Return the places of a trackig_core.Motion or SteadyShape, one side of which may be known."""
        if moved.position[0] < 0:
            return cls(moved.position, moved.support_position, moved.wheel_position, 0, 0)
        return cls(
            _both_sides(moved.position),
            _both_sides(moved.support_position),
            moved.wheel_position,
            moved.position.size - 1,
            moved.support_position.size - 1,
        )


def _whole(moved, mirrored):
    """Return displacements from left to right, of which some at the left are mirror images."""
    return np.concatenate([moved[mirrored:0:-1], moved])


def _both_sides(position):
    return np.concatenate([-position[:0:-1], position])


def _bar(x, scale, unit):
    """Return a scale bar: the largest 1, 2 or 5 times a power of ten that is not too long."""
    power = 10.0 ** np.floor(np.log10(BAR_LONGEST / scale))
    size = max(factor * power for factor in (1, 2, 5) if factor * power * scale <= BAR_LONGEST)
    top = SEEN[1] - 0.12
    return {"x": [x], "low": [top - size * scale], "high": [top], "text": [f"{size:g} {unit}"]}


MOVE = f"""
    const scale = facts.data.scale[0], r = rail.data, s = supports.data, w = wheel.data
    const elements = facts.data.elements[0], bays = facts.data.bays[0]
    const per_bay = (r.x.length - 1) / (s.x.length - 1)
    for (let e = 0; e < r.x.length; e++)
        r.y[e] = {RAIL_AT} - scale * of_rail(Math.abs(e - elements))
    for (let b = 0; b < s.x.length; b++) {{
        s.rail[b] = r.y[b * per_bay]
        const two_stage = !Number.isNaN(s.block[b])
        if (two_stage) {{
            s.block[b] = {BLOCK_AT} - scale * of_block(Math.abs(b - bays))
            s.top[b] = s.block[b] + {BLOCK_HEIGHT / 2}
            s.bottom[b] = s.block[b] - {BLOCK_HEIGHT / 2}
        }}
        s.ground[b] = {FOOT_AT} - scale * of_foot(Math.abs(b - bays))
        if (!two_stage)
            s.top[b] = s.ground[b]
    }}
    for (let i = 0; i < w.x.length; i++) {{
        w.y[i] = {WHEEL_AT} - scale * of_wheel(i)
        w.foot[i] = w.y[i] - {WHEEL_HEIGHT / 2}
        w.rail[i] = r.y[w.element[i]]
    }}
    for (const source of [rail, supports, wheel])
        source.change.emit()
"""
"""Moves the drawing by what ``of_rail``, ``of_block``, ``of_foot`` and ``of_wheel`` say."""

PLAY = """
    play.label = play.active ? "Pause" : "Play"
    let last = null
    const frame = now => {
        if (!play.active)
            return
        if (Bokeh.index.find_one(play) == null) {
            play.active = false
            return
        }
        const span = slider.end - slider.start
        const moved = slider.value - slider.start + (last == null ? 0 : (now - last) * rate())
        last = now
        slider.value = slider.start + moved % span
        requestAnimationFrame(frame)
    }
    requestAnimationFrame(frame)
"""
"""Moves a slider on, frame by frame, until the button is up or nobody sees it."""


class _Player:
    """A moving drawing with its controls, all of which run in the browser.

    Parameters
    ----------
    name : str
        Prefix of the names of drawing, button and slider.
    slider : dict
        Title, end, step and format of the slider that runs through the movement.
    parts : sequence of bokeh.models.ColumnDataSource
        What moves; the last one, once sent, makes the browser draw.
    frame : str
        Script that defines ``of_rail``, ``of_block``, ``of_foot`` and ``of_wheel``; it knows the parts by
        their names.
    rate : str
        Script of how far the slider moves on in one millisecond.
    speed : bokeh.models.Select, optional
        Control that the rate depends on.
    """

    def __init__(self, name, slider, parts, frame, rate, speed=None):
        self.view = SideView(name)
        quiet = {"syncable": False, "stylesheets": [theme.PLAYER_CSS]}
        self.play = Toggle(name=f"{name}_play", label="Play", width=90, **quiet)
        self.slider = Slider(
            name=f"{name}_slider", start=0, value=0, sizing_mode="stretch_width", **slider, **quiet
        )
        controls = [self.play, self.slider] if speed is None else [self.play, self.slider, speed]
        self.model = column(
            self.view.model, row(*controls, sizing_mode="stretch_width"), sizing_mode="stretch_width"
        )
        known = {part.name: part for part in parts} | {"slider": self.slider} | self.view.parts()
        draw = CustomJS(args=known, code=frame + MOVE)
        self.slider.js_on_change("value", draw)
        parts[-1].js_on_change("data", draw)
        playing = {"play": self.play, "slider": self.slider} | ({} if speed is None else {"speed": speed})
        self.play.js_on_change("active", CustomJS(args=playing, code=f"const rate = () => {rate}" + PLAY))


class FilmPlayer(_Player):
    """A film of the track after the step: play, pause, scrub, slow motion.

    Attributes
    ----------
    model : bokeh.models.Column
        Drawing and controls.
    view : SideView
        The drawing.
    film : bokeh.models.ColumnDataSource
        Named ``film``, a row per frame: ``time`` [ms], ``wheel_0`` ..., ``rail_0`` ..., ``block_0`` ... and
        ``foot_0`` ... [µm], from one wheel to one side, or left to right.
    slider, play, speed
        Time [ms], play and pause, and how slow.
    """

    def __init__(self):
        self.film = ColumnDataSource(name="film", data={"time": [], "wheel_0": []}, syncable=False)
        self.speed = Select(
            name="film_speed",
            title="Speed of the film",
            value="50",
            options=[(factor, words) for words, factor in SPEEDS.items()],
            width=130,
            syncable=False,
            stylesheets=[theme.PLAYER_CSS, theme.SELECT_CSS],
        )
        time = {"title": "Time, ms", "end": 300, "step": 0.1, "format": "0.0"}
        super().__init__("film", time, [self.film], FILM_FRAME, "1 / Number(speed.value)", self.speed)

    def show(self, motion):
        """Show the film of a run.

        Parameters
        ----------
        motion : trackig_core.Motion
            The film.
        """
        parts = {"wheel": motion.wheels, "rail": motion.rail, "block": motion.block, "foot": motion.foot}
        moved = {part: each for part, each in parts.items() if each is not None}
        largest = MICROMETRES * max(np.abs(each).max() for each in moved.values())
        self.view.lay_out(Places.of(motion), "block" in moved, "foot" in moved, largest, unit="µm")
        time = 1000 * motion.time
        self.slider.update(start=float(time[0]), end=float(time[-1]))
        columns = {"time": time}
        for part, displacements in moved.items():
            columns |= {f"{part}_{i}": _micrometres(each) for i, each in enumerate(displacements.T)}
        start = int(np.argmin(np.abs(time - self.slider.value)))
        now = [moved[part][start] if part in moved else NOTHING for part in parts]
        self.view.move(*(MICROMETRES * each for each in now))
        # last, since it makes the browser draw the instant at which its own slider stands
        self.film.data = columns


NOTHING = np.zeros(0)
"""Displacements of what is not there."""


def _micrometres(displacement):
    return (MICROMETRES * displacement).astype(np.float32)


FILM_FRAME = """
    const time = film.data.time
    if (time.length == 0)
        return
    const interval = (time[time.length - 1] - time[0]) / (time.length - 1)
    const at = Math.round((slider.value - time[0]) / interval)
    const frame = Math.max(0, Math.min(time.length - 1, at))
    const of_rail = element => film.data[`rail_${element}`][frame]
    const of_block = support => film.data[`block_${support}`][frame]
    const yields = "foot_0" in film.data
    const of_foot = support => yields ? film.data[`foot_${support}`][frame] : 0
    const of_wheel = wheel => film.data[`wheel_${wheel}`][frame]
"""


class ShapePlayer(_Player):
    """The steady vibration at one frequency: play, pause, and scrub through the phase.

    Attributes
    ----------
    model : bokeh.models.Column
        Drawing and controls.
    view : SideView
        The drawing.
    parts : dict of bokeh.models.ColumnDataSource
        ``rail``, ``block``, ``foot`` and ``wheel``, named ``shape_of_rail`` and so on: ``real`` and ``imag``
        part per unit roughness [-], left to right; no blocks when single-stage, no feet on rigid ground.
    slider, play
        Phase [degrees], play and pause.
    """

    def __init__(self):
        self.parts = {
            of: ColumnDataSource(name=f"shape_of_{of}", data={"real": [], "imag": []}, syncable=False)
            for of in ("rail", "block", "foot", "wheel")
        }
        phase = {"title": "Phase, degrees", "end": 360, "step": 1, "format": "0"}
        super().__init__("shape", phase, list(self.parts.values()), SHAPE_PHASE, f"360 / {PERIOD}")

    def show(self, shape):
        """Show a steady shape at its first frequency.

        Parameters
        ----------
        shape : trackig_core.SteadyShape
            The shape.
        """
        parts = {"rail": shape.rail, "block": shape.block, "foot": shape.foot, "wheel": shape.wheels}
        moved = {name: NOTHING if part is None else part[:, 0] for name, part in parts.items()}
        largest = max(np.abs(each).max(initial=0.0) for each in moved.values())
        two_stage, yields = shape.block is not None, shape.foot is not None
        self.view.lay_out(Places.of(shape), two_stage, yields, largest, "× roughness")
        self.view.move(*(moved[name].real for name in ("wheel", "rail", "block", "foot")))
        # the wheel last, since it makes the browser draw the phase at which its own slider stands
        for name, source in self.parts.items():
            source.data = {"real": moved[name].real, "imag": moved[name].imag}


SHAPE_PHASE = """
    if (shape_of_wheel.data.real.length == 0)
        return
    const phase = slider.value * Math.PI / 180
    const cosine = Math.cos(phase), sine = Math.sin(phase)
    const now = (of, i) => of.data.real[i] * cosine - of.data.imag[i] * sine
    const yields = shape_of_foot.data.real.length > 0
    const of_rail = element => now(shape_of_rail, element)
    const of_block = support => now(shape_of_block, support)
    const of_foot = support => yields ? now(shape_of_foot, support) : 0
    const of_wheel = wheel => now(shape_of_wheel, wheel)
"""
