"""How far a ball or a roller sinks into a pit that takes part of its contact's width: the laws `sliced` and `ecl` beside the elastic half-space.

    python3 validation/half_space/half_space.py [BRINELL]

Prints Markdown tables of drops: the normal displacement under a given load, less that of the healthy contact, which is printed beside Hertz's. Half-space: conjugate gradients of Polonsky & Keer (Wear 231,
1999) with Love's coefficients (1929) of a rectangle under uniform pressure, summed by FFT; two grids. Pits are longer than the contact where they are not round, and deep: the bottom is not reached where no depth is given.
With BRINELL, the command: the same drops in an equilibrium of the program, and RMS of runs. Needs NumPy and SciPy; takes a minute.
"""

import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.fft import irfft2, rfft2
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

E_STAR = 206e9 / (1 - 0.3**2) / 2  # of two bodies of steel
DEEP, UM, MM = 1e-3, 1e6, 1e-3
WIDTHS, DIAMETERS, LENGTHS = np.array([0.2, 0.5, 1.0, 2.4]) * MM, np.array([7, 14, 21]) * 0.0254 * MM, np.array([0.5, 1.0, 2.0, 4.4]) * MM


def across(z, width, depth=DEEP):
    return np.where(np.abs(z) < width / 2, depth, 0)


class Ball:
    """Outer contact of the 6205 (docs/src/theory/balls.md). Gap and strips; x along the raceway, z across."""

    d, raceway, conformity = 7.94e-3, 46.98e-3, 0.52

    def __init__(self):
        self.rx, self.ry = 1 / (2 / self.d - 2 / self.raceway), 1 / (2 / self.d - 1 / (self.conformity * self.d))
        r = 1 / (1 / self.rx + 1 / self.ry)
        gamma = r * (1 / self.rx - 1 / self.ry)
        integrals = lambda k: (ellipk(1 - k**-2), ellipe(1 - k**-2))
        equation = lambda k: (2 * integrals(k)[0] - integrals(k)[1] * (1 + gamma)) / (integrals(k)[1] * (1 - gamma)) - k * k
        self.kappa = brentq(equation, 1.01, 1000)
        f, e = integrals(self.kappa)
        self.k = np.pi * self.kappa * 2 * E_STAR * np.sqrt(2 * e * r / (9 * f**3))
        self.rw = self.kappa**2 * r * e / f
        self.c = 3 * self.k / (4 * np.sqrt(2 * self.rw))
        self.gap = lambda x, z: x**2 / (2 * self.rx) + z**2 / (2 * self.ry)
        self.hertz = lambda load: (load / self.k) ** (2 / 3)

    def drop(self, load, depth):
        """Drop of the strips; depth(z) is that of the path under the ball's centre."""
        z = np.linspace(-3e-3, 3e-3, 60_001)
        bed = z**2 / (2 * self.rw) + depth(z)
        return brentq(lambda delta: self.c * np.clip(delta - bed, 0, None).sum() * (z[1] - z[0]) - load, 0, 1e-4) - self.hertz(load)


class Roller:
    """Inner contact of the NU206, straight or with the profile of ISO/TS 16281 (docs/src/theory/tilting.md)."""

    d, raceway, length = 9e-3, 37.5e-3, 8.8e-3

    def __init__(self, profile):
        self.r, self.profile = 1 / (2 / self.d + 2 / self.raceway), profile
        self.k = 8.06e4 * (self.length / MM) ** (8 / 9) * 1e3 ** (10 / 9)
        self.gap = lambda x, z: x**2 / (2 * self.r) + self.relief(z)

    def relief(self, z):
        t = np.clip(2 * np.abs(z) / self.length, 0, 1 - 1e-9)
        profile = -0.00035 * self.d * np.log(1 - t**2) if self.profile == "logarithmic" else 0 * t
        return np.where(np.abs(z) < self.length / 2, profile, DEEP)

    def sliced(self, load, depth):
        z = ((np.arange(4400) + 0.5) / 4400 - 0.5) * self.length
        return brentq(lambda delta: self.k * (np.clip(delta - self.relief(z) - depth(z), 0, None) ** (10 / 9)).mean() - load, 0, 1e-3)

    def ecl(self, load, width, h):
        g = (1 - width / self.length) ** (8 / 9)
        return brentq(lambda delta: self.k * (g * delta ** (10 / 9) + (1 - g) * max(delta - h, 0) ** (10 / 9)) - load, 0, 1e-3)


class HalfSpace:  # x and z are those of the cells' centres
    def __init__(self, dx, dz, width, height):
        self.cell, self.n = dx * dz, (round(width / dx / 2) * 2, round(height / dz / 2) * 2)
        self.x, self.z = np.meshgrid(*((np.arange(k) - k / 2 + 0.5) * d for k, d in zip(self.n, (dx, dz))), indexing="ij")
        a, b = np.meshgrid(*(np.fft.fftfreq(2 * k, 1 / (2 * k)) * d for k, d in zip(self.n, (dx, dz))), indexing="ij")
        corner = lambda u, v: u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))
        self.love = rfft2(sum(i * j * corner(a + i * dx / 2, b + j * dz / 2) for i in (1, -1) for j in (1, -1)) / (np.pi * E_STAR), workers=-1)

    def deflection(self, p):
        size = (2 * self.n[0], 2 * self.n[1])
        return irfft2(rfft2(p, s=size, workers=-1) * self.love, s=size, workers=-1)[: self.n[0], : self.n[1]]

    def press(self, gap, load, tolerance=1e-6):
        """Displacement under a load, and pressures."""
        p = np.where(gap < np.quantile(gap, 0.3), load / (0.3 * gap.size * self.cell), 0)
        t, before, conjugate = np.zeros_like(p), 1.0, 0.0
        for _ in range(1000):
            touching, g = p > 0, self.deflection(p) + gap
            g -= g[touching].mean()
            square = (g[touching] ** 2).sum()
            t, before = np.where(touching, g + conjugate * square / before * t, 0.0), square
            r = self.deflection(t)
            r -= r[touching].mean()
            step = (g[touching] * t[touching]).sum() / (r[touching] * t[touching]).sum()
            old, p = p, np.clip(np.where(touching, p - step * t, 0.0), 0, None)
            entering = (p == 0) & (g < 0)
            conjugate = 0.0 if entering.any() else 1.0
            p[entering] -= step * g[entering]
            p *= load / (p.sum() * self.cell)
            if np.abs(p - old).sum() * self.cell < tolerance * load:
                break
        assert np.abs(p - old).sum() * self.cell < tolerance * load, "no convergence"
        assert max(p[0].max(), p[-1].max(), p[:, 0].max(), p[:, -1].max()) == 0, "the contact leaves the grid"
        return (self.deflection(p) + gap)[p > 0].mean(), p


def solve(grids, body, load, pits):
    """Healthy displacement, and pressures on the last grid; drop into each pit, a depth over x and z, on each grid."""
    found = []
    for grid in grids:
        healthy, p = grid.press(gap := body.gap(grid.x, grid.z), load)
        found.append([grid.press(gap + pit(grid.x, grid.z), load)[0] - healthy for pit in pits])
    return healthy, p, np.array(found)


def row(*words, drop, laws):
    print("|", " | ".join(words), f"| {drop[1] * UM:.4g} ({drop[0] * UM:.4g}) |", " | ".join(f"{law * UM:.4g} | {law / drop[1]:.2f}" for law in laws), "|")


def balls():
    """Prints; returns the ball and the drops into WIDTHS."""
    ball = Ball()
    print(f"Ball, outer contact of the 6205: R_w = {ball.rw / MM:.1f} mm, R_y = {ball.ry / MM:.1f} mm\n\n| load, N | pit | half-space, µm (coarse grid) | strips, µm | ratio |\n| --- | --- | --- | --- | --- |")
    # Each with its depth over x and z and that of the path: over a round pit the ball reaches down between the edges before and behind it.
    wide = lambda w, h, name: (name, lambda x, z: across(z, w, h), lambda z: across(z, w, h))
    disk = lambda c: (f"round, {c / MM:.3f} mm", lambda x, z: across(np.hypot(x, z), c), lambda z: np.clip((c * c / 4 - z**2) / (2 * ball.rx), 0, None))
    long, shallow = [wide(w, DEEP, f"{w / MM:.1f} mm wide") for w in WIDTHS], [wide(0.5e-3, h / UM, f"0.5 mm wide, {h} µm deep") for h in (0.2, 1.0)]
    large, small = ([HalfSpace(k * dx, k * dz, *size) for k in (2, 1)] for dx, dz, *size in ((3.5e-6, 5e-6, 0.49e-3, 4.2e-3), (2e-6, 4e-6, 0.28e-3, 1.6e-3)))
    checks, drops = [], []
    for load, pits, grids in ((424.0, long + shallow, large), (20.0, long, large), (68.0, [disk(c) for c in DIAMETERS], small)):
        healthy, p, found = solve(grids, ball, load, [pit[1] for pit in pits])
        delta, pressure = ball.hertz(load), 1.5 * load * ball.kappa / (np.pi * 2 * ball.rw * ball.hertz(load))
        checks.append(f"{load:.0f} N: {healthy * UM:.4f} µm, Hertz {delta * UM:.4f}; {p.max() / 1e6:.1f} MPa, Hertz {pressure / 1e6:.1f}")
        for (name, _, depth), drop in zip(pits, found.T):
            row(f"{load:.0f}", name, drop=drop, laws=[ball.drop(load, depth)])
        drops.append(found[1])
    print("\nHealthy", *checks, sep="\n")
    return ball, drops[0]


def rollers():
    print("\nRoller, inner contact of the NU206, 1746 N; held parallel\n\n| roller | damage | half-space, µm (coarse grid) | `sliced`, µm | ratio | `ecl`, µm | ratio |\n| --- | --- | --- | --- | --- | --- | --- |")
    grids, load, checks = [HalfSpace(k * 4e-6, k * 12.5e-6, 0.6e-3, 9.2e-3) for k in (2, 1)], 1746.0, []
    for profile in ("straight", "logarithmic"):
        roller, end = Roller(profile), Roller.length / 2
        damage = [(w, h, place) for place in ("middle", "end") for w, h in [*((w, DEEP) for w in LENGTHS), (1 * MM, 0.2e-6), (1 * MM, 1e-6)]]
        depths = [lambda z, w=w, h=h, place=place: across(z - (end - w / 2) * (place == "end"), w, h) for w, h, place in damage]
        healthy, p, found = solve(grids, roller, load, [lambda x, z, depth=depth: depth(z) for depth in depths])
        middle, none = p[:, p.shape[1] // 2], roller.sliced(load, lambda z: 0 * z)
        hertz = np.sqrt(E_STAR * middle.sum() * 4e-6 / (np.pi * roller.r))
        checks.append(f"{profile}: {healthy * UM:.3f} µm, slices {none * UM:.3f}; in the middle {middle.max() / 1e6:.1f} MPa, Hertz for the line load there {hertz / 1e6:.1f}")
        for (w, h, place), depth, drop in zip(damage, depths, found.T):
            laws = [roller.sliced(load, depth) - none, roller.ecl(load, w, h) - roller.ecl(load, 0, 0)]
            row(profile, f"{w / MM:.1f} mm, {place}" + f", {h * UM:.1f} µm deep" * (h < DEEP), drop=drop, laws=laws[: 2 if profile == "straight" else 1])  # `ecl` knows straight rollers alone
    print("\nHealthy", *checks, sep="\n")


SCENARIO = """
bearing = {{ preset = "6205", radial_clearance_um = 6.25 }}
contact = {{ law = "sliced", roller_path = "envelope", edge_reaction = "conservative", slices = 60 }}
operation = {{ speed_rpm = 1797, load_n = [800, 0] }}
defects = [{{ on = "outer-raceway", center_deg = 0, depth_um = 100, shape = {{ rectangle = {{ length_mm = {length}, width_mm = {width} }} }} }}]
simulation = {{ laws = "li2023", duration_s = {seconds}, sample_rate_hz = 25600, start = "equilibrium", record = ["*"] }}
"""


def runs(brinell, folder, ball, drops):
    """The program's own drop, at the first sample of an equilibrium; RMS of a pit, and of one so narrow that strips drop by what the half-space does into the pit."""

    def run(length, width, seconds, file):
        (folder / "pit.toml").write_text(SCENARIO.format(length=length, width=width / MM, seconds=seconds))
        subprocess.run([brinell, "run", folder / "pit.toml", "-o", folder, "--signals", "csv", "--no-report", "--no-healthy", "--quiet", "--overwrite"], check=True)
        return (folder / file).read_text()
    rms = lambda width: json.loads(run(2, width, 1, "summary.json"))["indicators"]["channels"]["sensor_ax"]["anti-aliased"]["rms"]["value"]
    print("\n| pit, mm | load in the run, N | drop in the run, µm | strips, µm | RMS, m/s² | narrow pit, mm | its RMS, m/s² | dB |\n| --- | --- | --- | --- | --- | --- | --- | --- |")
    for w, drop in zip(WIDTHS, drops):
        first = {name: float(value) for name, value in next(csv.DictReader(run(6, w, 0.002, "signals.csv").splitlines())).items()}
        load, own = first["contact1_01_outer_force"], first["roller1_01_r"] - first["outer_x"]
        narrow = brentq(lambda v: ball.drop(424.0, lambda z: across(z, v)) - drop, 0, w, xtol=1e-7)
        drops, levels = (own - ball.hertz(load), ball.drop(load, lambda z: across(z, w))), (rms(w), rms(narrow))
        print(f"| {w / MM:.1f} | {load:.1f} | {drops[0] * UM:.4f} | {drops[1] * UM:.4f} | {levels[0]:.2f} | {narrow / MM:.3f} | {levels[1]:.2f} | {20 * np.log10(levels[0] / levels[1]):.1f} |")


if __name__ == "__main__":
    found = balls()
    rollers()
    if len(sys.argv) > 1:
        with tempfile.TemporaryDirectory() as folder:
            runs(sys.argv[1], Path(folder), *found)
