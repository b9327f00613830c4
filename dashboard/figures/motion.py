"""The track from the side, in motion: rail, wheel, blocks and their springs, moved by the browser itself.

All frames of a film, or the complex shape of a steady vibration, are sent once; play, pause and scrub then
run in the browser and tell the server nothing (``syncable=False``). Movements are drawn larger than they
are by one factor everywhere, which the scale bar states; downward is towards the ground. Springs join what
they join: their drawn length shows how far they are squeezed. The browser adds nothing to what was solved but
mirror images and magnification.
"""

import numpy as np
from bokeh.core.properties import value
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, CustomJS, Range1d, Select, Slider, Toggle
from bokeh.plotting import figure

from dashboard import theme

WHEEL_AT, RAIL_AT, BLOCK_AT, GROUND_AT = 0.66, 0.0, -0.6, -1.1
"""Heights at rest: the wheel's centre, the rail, the blocks' centres, the ground [units of the drawing]."""

WHEEL_HEIGHT, BLOCK_HEIGHT = 0.62, 0.24
"""Heights of wheel, which is round, and block [units of the drawing]."""

BLOCK_WIDTH = 0.45
"""Width of a block over the spacing [-]."""

SEEN = (-1.2, 1.25)
"""Heights that are seen [units of the drawing]."""

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
        ``ground``, ``width`` [m]; left to right. Blocks are NaN when single-stage.
    wheel : bokeh.models.ColumnDataSource
        ``<name>_wheel``: ``x`` [m], heights ``y`` of its centre, ``foot`` and ``rail``.
    facts : bokeh.models.ColumnDataSource
        ``<name>_facts``: ``scale`` [units of the drawing per unit of movement].
    bar : bokeh.models.ColumnDataSource
        ``<name>_bar``: the scale bar's ``x``, ends ``low`` and ``high``, and ``text``.
    """

    def __init__(self, name):
        def source(part, *columns):
            # the browser moves these itself; nothing of that goes back
            return ColumnDataSource(name=f"{name}_{part}", data={key: [] for key in columns}, syncable=False)

        self.rail = source("rail", "x", "y")
        self.supports = source("supports", "x", "rail", "block", "top", "bottom", "ground", "width")
        self.wheel = source("wheel", "x", "y", "foot", "rail")
        self.facts = source("facts", "scale")
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
        self._draw()

    def _draw(self):
        plot, spring = self.model, {"line_color": theme.PRESET_GHOST, "line_width": theme.THIN_LINE_WIDTH}
        springs = {"x0": "x", "x1": "x", "source": self.supports, "line_dash": [2, 2], **spring}
        plot.segment(y0="rail", y1="top", **springs)
        plot.segment(y0="bottom", y1="ground", **springs)
        plot.hspan(y=GROUND_AT, line_color=theme.PRESET_GHOST, line_width=theme.LINE_WIDTH)
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

    def move(self, wheel, rail, block):
        """Draw one instant, as the browser draws all others.

        Parameters
        ----------
        wheel : float
            Displacement of the wheel [unit of the movements].
        rail, block : numpy.ndarray
            Displacements of elements and blocks to one side of the wheel; no blocks when single-stage.
        """
        scale, supports = self.facts.data["scale"][0], dict(self.supports.data)
        height = RAIL_AT - scale * np.concatenate([rail[:0:-1], rail])
        per_bay = (height.size - 1) // (supports["x"].size - 1)
        supports["rail"] = height[::per_bay]
        if block.size:
            supports["block"] = BLOCK_AT - scale * np.concatenate([block[:0:-1], block])
            supports["top"] = supports["block"] + BLOCK_HEIGHT / 2
            supports["bottom"] = supports["block"] - BLOCK_HEIGHT / 2
        centre = WHEEL_AT - scale * wheel
        self.rail.data = {**self.rail.data, "y": height}
        self.supports.data = supports
        self.wheel.data = {
            **self.wheel.data,
            "y": np.array([centre]),
            "foot": np.array([centre - WHEEL_HEIGHT / 2]),
            "rail": np.array([height[height.size // 2]]),
        }

    def parts(self):
        """Return the arguments by which scripts of the browser know the drawing."""
        return {"rail": self.rail, "supports": self.supports, "wheel": self.wheel, "facts": self.facts}

    def lay_out(self, rail_position, support_position, two_stage, largest, unit):
        """Draw a track at rest.

        Parameters
        ----------
        rail_position, support_position : numpy.ndarray
            Elements and supports to one side of the wheel, the wheel's own first [m].
        two_stage : bool
            Whether there are blocks.
        largest : float
            Largest movement that will be drawn [unit].
        unit : str
            What the movements are counted in.
        """
        elements, places = _both_sides(rail_position), _both_sides(support_position)
        reach = 1.04 * places[-1]
        self.model.x_range.update(start=-reach, end=reach)
        scale = LARGEST / largest
        block = np.full(places.size, BLOCK_AT if two_stage else np.nan)
        ground = np.full(places.size, GROUND_AT)
        self.facts.data = {"scale": [scale]}
        self.bar.data = _bar(-0.985 * reach, scale, unit)
        self.rail.data = {"x": elements, "y": np.full(elements.size, RAIL_AT)}
        self.supports.data = {
            "x": places,
            "rail": np.full(places.size, RAIL_AT),
            "block": block,
            "top": block + BLOCK_HEIGHT / 2 if two_stage else ground,
            "bottom": block - BLOCK_HEIGHT / 2,
            "ground": ground,
            "width": np.full(places.size, BLOCK_WIDTH * support_position[1]),
        }
        self.wheel.data = {
            "x": np.zeros(1),
            "y": np.array([WHEEL_AT]),
            "foot": np.array([WHEEL_AT - WHEEL_HEIGHT / 2]),
            "rail": np.array([RAIL_AT]),
        }


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
    const elements = (r.x.length - 1) / 2, bays = (s.x.length - 1) / 2
    const per_bay = elements / bays
    for (let e = -elements; e <= elements; e++)
        r.y[e + elements] = {RAIL_AT} - scale * of_rail(e)
    for (let b = -bays; b <= bays; b++) {{
        const i = b + bays
        s.rail[i] = r.y[b * per_bay + elements]
        if (!Number.isNaN(s.block[i])) {{
            s.block[i] = {BLOCK_AT} - scale * of_block(b)
            s.top[i] = s.block[i] + {BLOCK_HEIGHT / 2}
            s.bottom[i] = s.block[i] - {BLOCK_HEIGHT / 2}
        }}
    }}
    w.y[0] = {WHEEL_AT} - scale * of_wheel()
    w.foot[0] = w.y[0] - {WHEEL_HEIGHT / 2}
    w.rail[0] = r.y[elements]
    for (const source of [rail, supports, wheel])
        source.change.emit()
"""
"""Moves the drawing by what ``of_rail``, ``of_block`` and ``of_wheel`` say."""

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
        Script that defines ``of_rail``, ``of_block`` and ``of_wheel``; it knows the parts by their names.
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
        Named ``film``, a row per frame: ``time`` [ms], ``wheel``, ``rail_0`` ... and ``block_0`` ... from the
        wheel to one side [µm].
    slider, play, speed
        Time [ms], play and pause, and how slow.
    """

    def __init__(self):
        self.film = ColumnDataSource(name="film", data={"time": [], "wheel": []}, syncable=False)
        self.speed = Select(
            name="film_speed",
            value="50",
            options=[(factor, words) for words, factor in SPEEDS.items()],
            width=130,
            syncable=False,
            stylesheets=[theme.PLAYER_CSS],
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
        two_stage = motion.block is not None
        places = [motion.wheel[:, None], motion.rail, *([motion.block] if two_stage else [])]
        largest = MICROMETRES * max(np.abs(moved).max() for moved in places)
        self.view.lay_out(motion.position, motion.support_position, two_stage, largest, "µm")
        time = 1000 * motion.time
        self.slider.update(start=float(time[0]), end=float(time[-1]))
        columns = {"time": time, "wheel": _micrometres(motion.wheel)}
        columns |= {f"rail_{i}": _micrometres(moved) for i, moved in enumerate(motion.rail.T)}
        if two_stage:
            columns |= {f"block_{i}": _micrometres(moved) for i, moved in enumerate(motion.block.T)}
        start = int(np.argmin(np.abs(time - self.slider.value)))
        block = motion.block[start] if two_stage else np.zeros(0)
        self.view.move(
            *(MICROMETRES * moved[start] for moved in (motion.wheel, motion.rail)), MICROMETRES * block
        )
        # last, since it makes the browser draw the instant at which its own slider stands
        self.film.data = columns


def _micrometres(displacement):
    return (MICROMETRES * displacement).astype(np.float32)


FILM_FRAME = """
    const time = film.data.time
    if (time.length == 0)
        return
    const interval = (time[time.length - 1] - time[0]) / (time.length - 1)
    const at = Math.round((slider.value - time[0]) / interval)
    const frame = Math.max(0, Math.min(time.length - 1, at))
    const of_rail = element => film.data[`rail_${Math.abs(element)}`][frame]
    const of_block = support => film.data[`block_${Math.abs(support)}`][frame]
    const of_wheel = () => film.data.wheel[frame]
"""


class ShapePlayer(_Player):
    """The steady vibration at one frequency: play, pause, and scrub through the phase.

    Attributes
    ----------
    model : bokeh.models.Column
        Drawing and controls.
    view : SideView
        The drawing.
    rail, block, wheel : bokeh.models.ColumnDataSource
        Named ``shape_of_rail`` and so on: ``real`` and ``imag`` part per unit roughness [-], from the wheel
        to one side; no blocks when single-stage.
    slider, play
        Phase [degrees], play and pause.
    """

    def __init__(self):
        self.rail, self.block, self.wheel = parts = [
            ColumnDataSource(name=f"shape_of_{of}", data={"real": [], "imag": []}, syncable=False)
            for of in ("rail", "block", "wheel")
        ]
        phase = {"title": "Phase, degrees", "end": 360, "step": 1, "format": "0"}
        super().__init__("shape", phase, parts, SHAPE_PHASE, f"360 / {PERIOD}")

    def show(self, shape):
        """Show a steady shape at its first frequency.

        Parameters
        ----------
        shape : trackig_core.SteadyShape
            The shape.
        """
        two_stage = shape.block is not None
        right, own = shape.position >= 0, shape.support_position >= 0
        moved = {"rail": shape.rail[right, 0], "wheel": shape.wheel[:1]}
        moved["block"] = shape.block[own, 0] if two_stage else np.zeros(0)
        largest = max(np.abs(each).max(initial=0.0) for each in moved.values())
        unit = "× roughness"
        self.view.lay_out(shape.position[right], shape.support_position[own], two_stage, largest, unit)
        self.view.move(moved["wheel"][0].real, moved["rail"].real, moved["block"].real)
        # the wheel last, since it makes the browser draw the phase at which its own slider stands
        for source, key in ((self.rail, "rail"), (self.block, "block"), (self.wheel, "wheel")):
            source.data = {"real": moved[key].real, "imag": moved[key].imag}


SHAPE_PHASE = """
    if (shape_of_wheel.data.real.length == 0)
        return
    const phase = slider.value * Math.PI / 180
    const cosine = Math.cos(phase), sine = Math.sin(phase)
    const now = (of, i) => of.data.real[i] * cosine - of.data.imag[i] * sine
    const of_rail = element => now(shape_of_rail, Math.abs(element))
    const of_block = support => now(shape_of_block, Math.abs(support))
    const of_wheel = () => now(shape_of_wheel, 0)
"""
