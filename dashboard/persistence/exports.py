"""Curves as CSV files, for spreadsheets and scripts.

Insertion gain: dB per band [Hz]. Force into the ground: kN over time [s]; each design has a time of its
own, since each run has a step of its own. Comma-separated, decimal points. Numbers are those of the
solution, not those that fit a screen.
"""

import csv
import io
import itertools
import re

import trackig_core as tig


def gain_csv(results):
    """Return insertion gain per band as CSV.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution.

    Returns
    -------
    str
        A column of bands, ``frequency_hz``, and a column per design, ``insertion_gain_db`` and its name.
    """
    results = list(results)
    header = ["frequency_hz", *(f"insertion_gain_db {each.name}" for each in results)]
    columns = [tig.BAND_LABELS, *(map(float, each.levels) for each in results)]
    return _written(header, zip(*columns, strict=True))


def force_csv(results):
    """Return the force into the ground over time as CSV.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution.

    Returns
    -------
    str
        Three columns per design that was stepped in time: ``time_s``, ``total_force_kN`` summed over all
        supports and ``loaded_support_force_kN`` under the wheel, each with the design's name; shorter
        records end in empty cells.
    """
    header, columns = [], []
    for each in results:
        summary = each.summary
        if summary.time is None:
            continue
        header += [f"{name} {each.name}" for name in ("time_s", "total_force_kN", "loaded_support_force_kN")]
        curves = (summary.time, summary.total_force, summary.loaded_support_force)
        columns += [[f"{value:.9g}" for value in curve] for curve in curves]
    return _written(header, itertools.zip_longest(*columns, fillvalue=""))


def _written(header, rows):
    """Return a table as CSV."""
    # headers begin with a word of ours, so that no spreadsheet takes a user's name for a formula
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return file.getvalue()


def file_name(title, suffix):
    """Return a name for a file that every system takes.

    Parameters
    ----------
    title : str
        What the study is called.
    suffix : str
        What the name ends with, such as ``"gain.csv"``.
    """
    stem = re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()
    return "-".join(part for part in ("trackig", stem, suffix) if part).replace("-.", ".")
