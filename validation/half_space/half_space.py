"""How far a ball or a roller sinks into a pit that takes part of its contact's width: the program's law `half-space`, and `ecl`, beside an elastic half-space.

    python3 validation/half_space/half_space.py [BRINELL]

Prints Markdown tables of drops: the normal displacement under a given load, less that of the healthy contact, which is printed beside Hertz's. Half-space: conjugate gradients of Polonsky & Keer (Wear 231,
1999) with Love's coefficients (1929) of a rectangle under uniform pressure, summed by FFT; two grids. Pits are longer than the contact where they are not round, and deep: the bottom is not reached where no depth is given.
With BRINELL, the command: drops in an equilibrium of the program, beside those found here under the same load. Needs NumPy and SciPy; takes a minute.
"""

import csv
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
    """Outer contact of the 6205 (docs/src/theory/balls.md); x along the raceway, z across."""

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
        self.gap = lambda x, z: x**2 / (2 * self.rx) + z**2 / (2 * self.ry)
        self.hertz = lambda load: (load / self.k) ** (2 / 3)


class Roller:
    """Inner contact of the NU206, straight."""

    d, raceway, length = 9e-3, 37.5e-3, 8.8e-3

    def __init__(self):
        self.r = 1 / (2 / self.d + 2 / self.raceway)
        self.k = 8.06e4 * (self.length / MM) ** (8 / 9) * 1e3 ** (10 / 9)
        self.gap = lambda x, z: x**2 / (2 * self.r) + np.where(np.abs(z) < self.length / 2, 0, DEEP)

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


def balls():
    """Prints; returns the ball and the fine grid of its long pits."""
    ball = Ball()
    print(f"Ball, outer contact of the 6205: R_w = {ball.rw / MM:.1f} mm, R_y = {ball.ry / MM:.1f} mm\n\n| load, N | pit | drop, µm (coarse grid) |\n| --- | --- | --- |")
    wide = lambda w, h, name: (name, lambda x, z: across(z, w, h))
    disk = lambda c: (f"round, {c / MM:.3f} mm", lambda x, z: across(np.hypot(x, z), c))
    long, shallow = [wide(w, DEEP, f"{w / MM:.1f} mm wide") for w in WIDTHS], [wide(0.5e-3, h / UM, f"0.5 mm wide, {h} µm deep") for h in (0.2, 1.0)]
    large, small = ([HalfSpace(k * dx, k * dz, *size) for k in (2, 1)] for dx, dz, *size in ((3.5e-6, 5e-6, 0.49e-3, 4.2e-3), (2e-6, 4e-6, 0.28e-3, 1.6e-3)))
    checks = []
    for load, pits, grids in ((424.0, long + shallow, large), (20.0, long, large), (68.0, [disk(c) for c in DIAMETERS], small)):
        healthy, p, found = solve(grids, ball, load, [pit[1] for pit in pits])
        delta, pressure = ball.hertz(load), 1.5 * load * ball.kappa / (np.pi * 2 * ball.rw * ball.hertz(load))
        checks.append(f"{load:.0f} N: {healthy * UM:.4f} µm, Hertz {delta * UM:.4f}; {p.max() / 1e6:.1f} MPa, Hertz {pressure / 1e6:.1f}")
        for (name, _), drop in zip(pits, found.T):
            print(f"| {load:.0f} | {name} | {drop[1] * UM:.4g} ({drop[0] * UM:.4g}) |")
    print("\nHealthy", *checks, sep="\n")
    return ball, large[1]


def rollers():
    print("\nStraight roller, inner contact of the NU206, 1746 N; held parallel\n\n| damage | drop, µm (coarse grid) | `ecl`, µm | ratio |\n| --- | --- | --- | --- |")
    grids, load, roller, end = [HalfSpace(k * 4e-6, k * 12.5e-6, 0.6e-3, 9.2e-3) for k in (2, 1)], 1746.0, Roller(), Roller.length / 2
    damage = [(w, h, place) for place in ("middle", "end") for w, h in [*((w, DEEP) for w in LENGTHS), (1 * MM, 0.2e-6), (1 * MM, 1e-6)]]
    pits = [lambda x, z, w=w, h=h, place=place: across(z - (end - w / 2) * (place == "end"), w, h) for w, h, place in damage]
    healthy, p, found = solve(grids, roller, load, pits)
    middle = p[:, p.shape[1] // 2]
    hertz = np.sqrt(E_STAR * middle.sum() * 4e-6 / (np.pi * roller.r))
    for (w, h, place), drop in zip(damage, found.T):
        law = roller.ecl(load, w, h) - roller.ecl(load, 0, 0)
        print(f"| {w / MM:.1f} mm, {place}" + f", {h * UM:.1f} µm deep" * (h < DEEP) + f" | {drop[1] * UM:.4g} ({drop[0] * UM:.4g}) | {law * UM:.4g} | {law / drop[1]:.2f} |")
    print(f"\nHealthy\n{healthy * UM:.3f} µm, Palmgren {roller.ecl(load, 0, 0) * UM:.3f}; in the middle {middle.max() / 1e6:.1f} MPa, Hertz for the line load there {hertz / 1e6:.1f}")


SCENARIO = """
bearing = {{ preset = "6205", radial_clearance_um = 6.25 }}
contact = {{ edge_radius_um = 0 }}
operation = {{ speed_rpm = 1797, load_n = [800, 0] }}
defects = [{{ on = "outer-raceway", center_deg = 0, depth_um = 100, shape = {{ rectangle = {{ length_mm = 6, width_mm = {width} }} }} }}]
simulation = {{ duration_s = 0.002, sample_rate_hz = 25600, start = "equilibrium", record = ["*"] }}
"""


def runs(brinell, folder, ball, grid):
    """The program's own drop, at the first sample of an equilibrium."""
    print("\n| pit, mm | load in the run, N | drop in the run, µm | half-space, µm | ratio |\n| --- | --- | --- | --- | --- |")
    for w in WIDTHS:
        (folder / "pit.toml").write_text(SCENARIO.format(width=w / MM))
        subprocess.run([brinell, "run", folder / "pit.toml", "-o", folder / "out", "--signals", "csv", "--no-report", "--no-healthy", "--quiet", "--overwrite"], check=True)
        first = {name: float(value) for name, value in next(csv.DictReader((folder / "out" / "signals.csv").read_text().splitlines())).items()}
        load = first["contact1_01_outer_force"]
        own = first["roller1_01_r"] - first["outer_x"] - ball.hertz(load)
        drop = grid.press(ball.gap(grid.x, grid.z) + across(grid.z, w), load)[0] - ball.hertz(load)
        print(f"| {w / MM:.1f} | {load:.1f} | {own * UM:.4f} | {drop * UM:.4f} | {own / drop:.3f} |")


if __name__ == "__main__":
    found = balls()
    rollers()
    if len(sys.argv) > 1:
        with tempfile.TemporaryDirectory() as folder:
            runs(sys.argv[1], Path(folder), *found)
