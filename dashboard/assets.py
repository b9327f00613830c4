"""Where the files of the folder ``assets`` are: pictures and texts that are not code.

A wheel keeps that folder as ``trackig_assets`` beside this package, since "assets" alone would be
anybody's; a clone, and so an editable installation, has it as ``assets``. Whoever
wants such a file asks here.
"""

from pathlib import Path

ROOT = Path(__file__).parent.parent

FOLDER = next(place for place in (ROOT / "trackig_assets", ROOT / "assets") if place.is_dir())
"""The folder of assets, installed or in a clone."""


LESSONS = FOLDER / "lessons"
"""The folder of lessons."""

METHOD = "method.md"
"""The method, written for readers."""


def read_text(name):
    """Return the text of an asset.

    Parameters
    ----------
    name : str
        Path below the folder ``assets``, such as ``"track.svg"``; never what a user has typed.

    Returns
    -------
    str
        Its text.

    Raises
    ------
    FileNotFoundError
        If the installation lacks the file.
    """
    return (FOLDER / name).read_text(encoding="utf-8")
