"""Curves as CSV files, for spreadsheets and scripts.

Comment lines, each after a ``#``, say what the figures are. Insertion gain: dB per band [Hz]. Force into
the ground: kN over time [s], which is held once. Comma-separated, decimal points.
"""

import csv
import dataclasses
import io
import json
import re

import numpy as np
from scipy.interpolate import CubicSpline

import trackig_core as tig
from dashboard import formats
from dashboard.session.special import curve_text, is_curve

SAME_TIME = 1e-9
"""Difference of two times that are the same [s]."""


def gain_csv(results, heading, measured=()):
    """Return insertion gain per band as CSV.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution.
    heading : Heading
        What the file says of itself.
    measured : iterable of trackig_core.levels.MeasuredGain
        Curves from elsewhere; they are of one-third octaves, and left out beside octaves.

    Returns
    -------
    str
        A column ``frequency_hz`` of the bands that are shown, a column per design, ``insertion_gain_db`` and
        its name, and one per curve from elsewhere, ``measured_insertion_gain_db`` and its name, with four
        decimals; empty where there is none.
    """
    results, measured = list(results), list(measured)
    shown = [each.shown_gain for each in results]
    bands, remarks = shown[0].bands, [static_remark(each) for each in results if each.statics is not None]
    if bands.tenths != 1 and measured:
        remarks.append("measured curves are of one-third octaves, and are left out beside octaves")
        measured = []
    header = [
        "frequency_hz",
        *(f"insertion_gain_db {each.name}" for each in results),
        *(f"measured_insertion_gain_db {each.name}" for each in measured),
    ]
    elsewhere = [dict(zip(tig.BAND_LABELS, each.levels, strict=True)) for each in measured]
    levels = [each.levels for each in shown]
    levels += [[each.get(label, np.nan) for label in bands.labels] for each in elsewhere]
    columns = [bands.labels, *(map(_decibels, each) for each in levels)]
    return _written([*heading.lines, *remarks], header, zip(*columns, strict=True))


def _decibels(level):
    return "" if np.isnan(level) else f"{level:.4f}"


def static_remark(result):
    """Return how far the rail sinks with a design, in words (DesignResult, which has statics)."""
    statics = result.statics
    return (
        f"rail deflection {formats.deflection_text(statics)}, seat load "
        f"{formats.load_text(statics.largest_seat_load)} under {formats.wheels_text(statics)}: {result.name}"
    )


def force_csv(results, heading):
    """Return the force into the ground over time as CSV.

    Parameters
    ----------
    results : iterable of DesignResult
        Designs with a solution; those that were not stepped in time are left out.
    heading : Heading
        What the file says of itself.

    Returns
    -------
    str
        A column ``time_s``, that of the longest record, and two columns per design, ``total_force_kN`` summed
        over all supports and ``loaded_support_force_kN`` under the wheel, each with the design's name and to
        five figures. A run whose samples lie at other times is interpolated (cubic spline; its forces are
        low-passed far below the rate of its samples), and a comment says so. Shorter records end in empty
        cells.
    """
    stepped = [each for each in results if each.summary.time is not None]
    time = max((each.summary.time for each in stepped), key=len, default=np.zeros(0))
    header, columns, interpolated = ["time_s"], [[f"{each:.9g}" for each in time]], []
    for each in stepped:
        summary = each.summary
        header += [f"{name} {each.name}" for name in ("total_force_kN", "loaded_support_force_kN")]
        forces = np.stack([summary.total_force, summary.loaded_support_force])
        if not _same_time(summary.time, time):
            forces = _at(time, summary.time, forces)
            interpolated.append(each.name)
        columns += [[_figures(force) for force in row] for row in forces]
    remarks = [f"interpolated to the times of the longest record: {name}" for name in interpolated]
    return _written([*heading.lines, FORCE_REMARK, *remarks], header, zip(*columns, strict=True))


def answer_csv(answer, result, heading):
    """Return all figures of an answer as CSV.

    Parameters
    ----------
    answer : trackig_core.decide.Answer
        The answer.
    result : object
        What it was made of: anything with ``to_dataframe``.
    heading : Heading
        What the file says of itself; its design is that of the question.

    Returns
    -------
    str
        Columns as the library names them, in SI units and to six figures, below the question, its answer in
        a sentence, and what is needed to obtain it again: every setting, versions, and the digest of all
        figures. A measured curve stands as ``measured 1`` in its cells, and its points in a comment of that
        name, in full; so do a suspension and a ground.
    """
    question = answer.question
    remarks = [
        *heading.lines,
        f"question: {question.kind}, {json.dumps(question.settings)}",
        f"asked of: {question.design!r}",
        f"answer: {answer.sentence}",
        f"versions: {', '.join(' '.join(each) for each in answer.versions.items())}",
        f"digest: {answer.digest}",
    ]
    table, named = result.to_dataframe(), {}
    rows = [
        [_six_figures(_named(cell, named)) for cell in row]
        for row in table.itertuples(index=False, name=None)
    ]
    remarks += [f"{name}: {_record_text(record)}" for record, name in named.items()]
    return _written(remarks, table.columns, rows)


_RECORDS = {
    tig.StiffnessCurve: "measured",
    tig.LossFactorCurve: "measured",
    tig.Suspension: "suspension",
    tig.Ground: "ground",
}
"""What cells call values that are no numbers or texts."""


def _named(cell, named):
    """Return a cell, a record by its name; each record (dict of names) has a name of its own."""
    if type(cell) not in _RECORDS:
        return cell
    kind = _RECORDS[type(cell)]
    count = sum(each.startswith(f"{kind} ") for each in named.values())
    return named.setdefault(cell, f"{kind} {count + 1}")


def _record_text(record):
    """Return a record in words and in full: points as a study holds them, else numbers by name [SI]."""
    if not is_curve(record):
        numbers = dataclasses.asdict(record).items()
        return ", ".join(f"{name} {value!r}" for name, value in numbers if value is not None)
    columns = "Hz, N/m, loss factor" if isinstance(record, tig.StiffnessCurve) else "Hz, loss factor"
    return f"{curve_text(record)}; rows of {columns}: {json.dumps(record.points)}"


def _six_figures(cell):
    """Return a number of a table as a design's numbers are given, with six figures; others as they are."""
    if not isinstance(cell, float):
        return cell
    return "" if np.isnan(cell) else f"{cell:.6g}"


def point_response_csv(responses, heading):
    """Return point receptance over frequency as CSV.

    Parameters
    ----------
    responses : iterable of (str, trackig_core.analysis.TrackResponse)
        Name and response of each design, all over the same frequencies.
    heading : Heading
        What the file says of itself.

    Returns
    -------
    str
        A column ``frequency_hz``, and per design real and imaginary part of the receptance over a support and
        half-way between two, m/N, to six figures.
    """
    responses = list(responses)
    header, columns = ["frequency_hz"], [[f"{each:.6g}" for each in responses[0][1].frequency]]
    for name, response in responses:
        for place in ("support", "midspan"):
            receptance = getattr(response, place)
            for part in ("real", "imag"):
                header.append(f"receptance_{place}_{part}_m_per_N {name}")
                columns.append([f"{each:.6g}" for each in getattr(receptance, part)])
    return _written([*heading.track_lines, RESPONSE_REMARK], header, zip(*columns, strict=True))


def decay_rate_csv(responses, heading):
    """Return track decay rate per band as CSV.

    Parameters
    ----------
    responses : iterable of (str, trackig_core.analysis.TrackResponse)
        Name and response of each design.
    heading : Heading
        What the file says of itself.

    Returns
    -------
    str
        A column of bands, ``frequency_hz``, and per design three columns, dB/m with four decimals: the sum of
        EN 15461 over a support and half-way between two, and the rate of the longest-lived wave.
    """
    responses = list(responses)
    header, columns = ["frequency_hz"], [responses[0][1].bands.labels]
    for name, response in responses:
        for field in ("support_decay_rate", "midspan_decay_rate", "longest_wave"):
            header.append(f"{field}_db_per_m {name}")
            columns.append([f"{each:.4f}" for each in getattr(response, field)])
    return _written([*heading.track_lines, DECAY_REMARK], header, zip(*columns, strict=True))


RESPONSE_REMARK = "point receptance of the rail, the wheel away, 24 elements a bay"
DECAY_REMARK = f"track decay rate, the sum of EN 15461:2008+A1:2010 carried to infinity; {RESPONSE_REMARK}"

FORCE_REMARK = "force into the ground after a sudden squeeze of the contact spring, low-passed at 600 Hz"


def _same_time(own, time):
    return own.size == time.size and np.abs(own - time).max() < SAME_TIME


def _at(time, own, forces):
    """Return forces (2, samples) of times of their own at other times, NaN beyond their record."""
    return CubicSpline(own, forces, axis=1, extrapolate=False)(time)


def _figures(force):
    return "" if np.isnan(force) else f"{force:.5g}"


def _written(remarks, header, rows):
    """Return a table as CSV, comment lines above it."""
    # headers begin with a word of ours, so that no spreadsheet takes a user's name for a formula; they are
    # quoted, so that no reader takes a sign in a name for a comment
    file = io.StringIO()
    file.writelines(f"# {remark}\n" for remark in remarks)
    csv.writer(file, lineterminator="\n", quoting=csv.QUOTE_ALL).writerow(header)
    csv.writer(file, lineterminator="\n").writerows(rows)
    return file.getvalue()


def file_name(*parts):
    """Return a name for a file that every system takes.

    Parameters
    ----------
    parts : str
        What the study is called, and the design if the file is about one; at last what the name ends with,
        such as ``"gain.csv"``.
    """
    *titles, suffix = parts
    stems = [re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower() for title in titles]
    return "-".join(part for part in ("trackig", *stems, suffix) if part).replace("-.", ".")
