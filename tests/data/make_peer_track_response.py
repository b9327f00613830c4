"""Make peer_track_response.csv: receptance and decay sum of the presets by the package Rolland 26.8.

Run with Python 3.12 or later and the packages rolland (26.8) and trackig:
``python make_peer_track_response.py``.

Rolland solves a beam on 241 discrete supports semi-analytically; its TSBDiscr1L and TSBDiscr2L share the
method that is called here. The support's dynamic stiffness at each frequency is that of the relaxation fit,
passed as a complex stiffness. Rail 60 kg/m, EI = 6.3798e6 N m2. The "timoshenko" rail has G = 81 GPa,
kappa = 0.4 and A = m'/rho, rho = 7850 kg/m3; the "euler" rail is rigid in shear and has no rotary inertia.
The sum over supports is one-sided, half a spacing at the force, to the end of the track.
"""

import csv
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from rolland.methods.semi_analytical.tsb_analytical import TSBDiscr

import trackig_core as tig
from trackig_core.track.viscoelastic_law import laws

SUPPORTS, DENSITY, SHEAR, KAPPA = 241, 7850.0, 81e9, 0.4
POINTS = ["support_re", "support_im", "midspan_re", "midspan_im"]
COLUMNS = ["case", "rail", "frequency_hz", *POINTS, "decay_db_per_m"]
FREQUENCY = 10.0 ** (np.arange(14, 31) / 10)


@dataclass(kw_only=True)
class Peer(TSBDiscr):
    """The package's common method on any support."""

    track: SimpleNamespace

    def _validate_track(self):
        """Take any track."""

    def compute_mobility(self):
        """Do what TSBDiscr1L and TSBDiscr2L do."""
        self.compute_mobility_common(self.track, self.track.block, self.track.boot, 0.0)


def solved(design, shear, place):
    """Return receptances (supports or one, frequencies) [m/N] under a force at a place."""
    pad, boot = laws(design)
    spacing, rail = design.fastener_spacing, design.rail
    area = rail.mass_per_metre / DENSITY
    second_moment = rail.bending_stiffness / 210e9
    properties = SimpleNamespace(
        mr=rail.mass_per_metre, rho=DENSITY if shear else 1e-3, kapz=KAPPA, E=210e9, etar=0.0,
        G=SHEAR if shear else 1e16, Ar=area, Iyr=second_moment,
    )  # fmt: skip
    track = SimpleNamespace(
        rail=properties,
        pad=SimpleNamespace(sp_z=pad.dynamic_stiffness(FREQUENCY), etap_z=0.0),
        E=[0.0, 1.0],
        mount_prop=dict.fromkeys(spacing * np.arange(SUPPORTS)),
        block=1.0 if boot is None else design.block_mass,
        boot=1e20 if boot is None else boot.dynamic_stiffness(FREQUENCY),
    )
    middle = SUPPORTS // 2 * spacing + (spacing / 2 if place == "midspan" else 0.0)
    x = middle + spacing * np.arange(SUPPORTS // 2 if place == "support" else 2)
    peer = Peer(
        track=track, f=FREQUENCY, force=np.ones_like(FREQUENCY), x_excit=middle, x=x, damp_type="hysteretic"
    )
    return peer.ux


def rows():
    """Return the rows of the file."""
    for name, design in tig.PRESETS.items():
        for theory, shear in (("euler", False), ("timoshenko", True)):
            over, between = solved(design, shear, "support"), solved(design, shear, "midspan")[0]
            squares = np.abs(over / over[0]) ** 2
            along = design.fastener_spacing * (squares.sum(axis=0) - 0.5)
            for i, frequency in enumerate(FREQUENCY):
                points = (over[0, i].real, over[0, i].imag, between[i].real, between[i].imag)
                numbers = [f"{value:.8e}" for value in points]
                yield [name, theory, f"{frequency:.6f}", *numbers, f"{4.343 / along[i]:.6f}"]


if __name__ == "__main__":
    with (Path(__file__).parent / "peer_track_response.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows())
