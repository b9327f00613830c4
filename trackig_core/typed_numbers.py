"""Numbers as people type, paste and print them: one reader for every box, table and command line.

Read are decimal points and commas, groups of three digits (``1 000``, ``1_000``, ``1'000``), powers of ten
(``1e3``, ``1.2×10⁹``), ``k``, ``M`` and ``G`` (``1k``, ``1k25``), every dash that is used for a minus,
digits of any script, and a unit behind the number, which is converted exactly. What may mean two numbers
(``1,200``) is refused, as is a unit of another quantity.
"""

import re
import unicodedata
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, lru_cache

from trackig_core.names import brief

_MINUS = dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2212\ufe58\ufe63\uff0d", "-")
"""Hyphens, dashes and the minus sign; a soft hyphen is invisible, so that it is refused."""

_INVISIBLE = dict.fromkeys("\u200b\u200c\u200d\u200e\u200f\u2060\u2066\u2067\u2068\u2069\ufeff", "")
"""Characters without width that spreadsheets and web pages leave in what is copied."""

_APOSTROPHES = dict.fromkeys("\u2019\u02bc\uff07", "'")

_TIMES = dict.fromkeys("\u00b7\u2022\u22c5\u2219\u00d7\u2715", "*")

_PLAIN = str.maketrans(_MINUS | _INVISIBLE | _APOSTROPHES | _TIMES)

_SUPERSCRIPT = re.compile("[\u207a\u207b]?[\u2070\u00b9\u00b2\u00b3\u2074-\u2079]+")

_NUMBER = re.compile(
    r"(?P<sign>[+-]?) ?(?P<body>[0-9][0-9.,'_ ]{0,40}|[.,][0-9]{1,40})"
    r"(?: ?(?:[eE]|[*x] ?10(?:\^|\*\*))(?P<power>[+-]?[0-9]{1,3}))?(?P<rest>.*)",
    re.ASCII,
)

_FORMS = (
    (re.compile(r"[0-9]+|[0-9]*\.[0-9]*|(?:0*|[0-9]{4,}),[0-9]*|[0-9]{1,3},(?![0-9]{3}$)[0-9]*"), None),
    (re.compile(r"[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]*)?"), ","),
    (re.compile(r"[1-9][0-9]{0,2}(?:\.[0-9]{3})+(?:,[0-9]*)?"), "."),
    (re.compile(r"[1-9][0-9]{0,2}(?:([ '_])[0-9]{3})(?:\1[0-9]{3})*(?:[.,][0-9]*)?"), " '_"),
)
"""Forms of digits, and the marks in them that only set groups of three apart."""

_AMBIGUOUS = re.compile(r"[1-9][0-9]{0,2},[0-9]{3}")

_PREFIXES = {"k": 3, "K": 3, "M": 6, "G": 9}

_STEEL_MODULUS = 210 * 10**9
"""Young's modulus of rail steel [N/m2]: a second moment of area stands for a rail's bending stiffness."""

_FORCES = {"N": 0, "kN": 3, "MN": 6, "GN": 9}
_LENGTHS = {"m": 0, "cm": -2, "mm": -3}


@dataclass(frozen=True)
class Unit:
    """A unit that people write behind a number.

    Attributes
    ----------
    name : str
        How it is written.
    quantity : str
        What is measured in it.
    factor : Fraction
        What it is in the quantity's SI unit; one for decibels.
    """

    name: str
    quantity: str
    factor: Fraction

    def convert(self, value: float, wanted: "Unit") -> float:
        """Return a number of this unit in another one of the same quantity, exactly rounded."""
        return value if self == wanted else float(Fraction(str(value)) * self.factor / wanted.factor)


_PURE = Unit("", "ratio", Fraction(1))
"""Unit of a number without one."""


@cache
def _power(exponent: int) -> Fraction:
    return Fraction(10) ** exponent


def _units() -> dict[str, Unit]:
    """Return every unit by the name that :func:`_folded` makes of it."""
    found: list[Unit] = []

    def add(quantity: str, **factors: Fraction | int) -> None:
        found.extend(Unit(name, quantity, Fraction(factor)) for name, factor in factors.items())

    add("frequency", Hz=1, kHz=1000)
    add("level", dB=1)
    add("mass", kg=1, t=1000, g=Fraction(1, 1000))
    add("time", s=1, ms=Fraction(1, 1000))
    add("length", **{name: _power(length) for name, length in {**_LENGTHS, "km": 3}.items()})
    add("speed", **{"m/s": Fraction(1), "km/h": Fraction(5, 18)})
    add("mass per length", **{"kg/m": 1, "t/m": 1000})
    add("ratio", **{"%": Fraction(1, 100)})
    for force, much in _FORCES.items():
        add("force", **{force: _power(much)})
        for length, long in _LENGTHS.items():
            stiffness = _power(much - long)
            add("stiffness", **{f"{force}/{length}": stiffness, f"{force} {length}-1": stiffness})
            add("stiffness per length", **{f"{force}/{length}2": _power(much - 2 * long)})
            add("stiffness per area", **{f"{force}/{length}3": _power(much - 3 * long)})
            add("bending stiffness", **{f"{force} {length}2": _power(much + 2 * long)})
            add("damping", **{f"{force} s/{length}": stiffness})
    for length, long in _LENGTHS.items():
        add("bending stiffness", **{f"{length}4": _STEEL_MODULUS * _power(4 * long)})
    units: dict[str, Unit] = {"": _PURE, "-": _PURE}
    for unit in found:
        units[_folded(unit.name)] = unit
        units.setdefault(_folded(unit.name).casefold(), unit)
    return units


def _folded(text: str) -> str:
    """Return a unit's name without what may be written in several ways."""
    return re.sub(r"\^|\*|[ ]", "", _plain(text))


def _plain(text: str) -> str:
    """Return text with one form of digits, minus, space and multiplication; superscripts become powers."""
    if text.isascii():
        return " ".join(text.split())
    text = _SUPERSCRIPT.sub(lambda found: "^" + unicodedata.normalize("NFKC", found[0]), text)
    text = unicodedata.normalize("NFKC", text.translate(_PLAIN)).translate(_PLAIN)
    text = "".join(str(unicodedata.decimal(each)) if each.isdecimal() else each for each in text)
    return " ".join(text.split())


_UNITS = _units()


class NumberError(ValueError):
    """Text is not the number that is wanted; the message says why and what to give."""


def find_unit(text: str) -> Unit | None:
    """Return the unit that a text names.

    Parameters
    ----------
    text : str
        A name such as ``"kN/mm"``, ``"N·m²"``, ``"HZ"``; empty for a number without unit.

    Returns
    -------
    Unit or None
        The unit, or None if it is none that is known.
    """
    name = _folded(text)
    if text and not name:
        return None
    return _UNITS.get(name) or _UNITS.get(name.casefold())


def read_number(text: str, unit: str = "", *, decimal: str | None = None) -> float:
    """Return the number that a text holds.

    Parameters
    ----------
    text : str
        What was typed, such as ``"31,5 Hz"`` or ``"20kN/mm"``.
    unit : str
        Unit of a number without one, and of what is returned; empty for a number without unit.
    decimal : str, optional
        What ``1,200`` means, where the reader knows it: ``","`` makes it 1.2 and ``"."`` 1200; by default
        it is refused.

    Returns
    -------
    float
        The number [unit].

    Raises
    ------
    NumberError
        If the text holds no number, none that is certain, or one in a unit of another quantity.
    """
    value, written = _split(text, decimal)
    if not written:
        return _finite(value, text)
    given, wanted = _known_unit(written, text), find_unit(unit)
    if wanted is None:
        raise ValueError(f"{unit}: no unit of which anything is known")
    if given.quantity != wanted.quantity:
        message = f"{brief(text)}: {given.name} is a unit of {given.quantity}; give {_allowed(unit)}"
        raise NumberError(message)
    return _finite(value * given.factor / wanted.factor, text)


def read_quantity(text: str, *, decimal: str | None = None) -> tuple[float, Unit | None]:
    """Return the number that a text holds, as it stands there, and its unit.

    Parameters
    ----------
    text : str
        What was typed, such as ``"31,5 Hz"``.
    decimal : str, optional
        As for :func:`read_number`.

    Returns
    -------
    value : float
        The number [unit].
    unit : Unit or None
        The unit; None if there is none.

    Raises
    ------
    NumberError
        If the text holds no number, none that is certain, or a unit that is not known.
    """
    value, written = _split(text, decimal)
    return _finite(value, text), _known_unit(written, text) if written else None


def _known_unit(written: str, text: str) -> Unit:
    unit = find_unit(written)
    if unit is None:
        raise NumberError(f"{brief(text)}: {brief(written)} is no unit that is known")
    return unit


def decimal_mark(text: str) -> str | None:
    """Return the decimal mark that a number certainly has, ``","`` or ``"."``; None if it shows none."""
    found = _NUMBER.fullmatch(_plain(text))
    body = found["body"].strip() if found is not None else ""
    if not re.search("[.,][0-9]", body) or _AMBIGUOUS.fullmatch(body):
        return None
    return "," if body.rfind(",") > body.rfind(".") else "."


@lru_cache(maxsize=4096)
def _split(text: str, decimal: str | None) -> tuple[Fraction, str]:
    """Return the exact value of a text's number, and the unit behind it as it is written."""
    # 1k25 stands on scales of frequency for 1.25 kHz
    plain = re.sub(r"^([+-]?[0-9]+)k([0-9]+)", r"\1.\2k", _plain(text))
    found = _NUMBER.fullmatch(plain)
    if found is None:
        raise NumberError(f"{brief(text)} is no number" if plain else "give a number")
    value = Fraction(_digits(found["body"].strip(), text, decimal)) * _power(int(found["power"] or 0))
    rest = found["rest"].strip()
    if rest in _PREFIXES:
        value, rest = value * _power(_PREFIXES[rest]), ""
    return -value if found["sign"] == "-" else value, rest


def _digits(body: str, text: str, decimal: str | None) -> str:
    """Return digits as Python writes them, or raise a NumberError."""
    if _AMBIGUOUS.fullmatch(body):
        readings = {".": body.replace(",", ""), ",": body.replace(",", ".")}
        if decimal is None:
            raise NumberError(f"{brief(text)} may be {' or '.join(readings.values())}: write one of them")
        return readings[decimal]
    for form, groups in _FORMS:
        if form.fullmatch(body):
            for mark in groups or "":
                body = body.replace(mark, "")
            return "0" + body.replace(",", ".").rstrip(".")
    raise NumberError(f"{brief(text)} is no number")


def _finite(value: Fraction, text: str) -> float:
    try:
        return float(value)
    except OverflowError:
        raise NumberError(f"{brief(text)} is too large") from None


def _allowed(unit: str) -> str:
    """Return what may be given where a number in a unit is due."""
    if not unit:
        return "a number without a unit"
    if unit in ("N/m", "kN/mm", "N/mm", "MN/m"):
        return "N/m, N/mm, kN/mm or MN/m"
    return unit
