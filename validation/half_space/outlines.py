"""Tables of damage of oblique and ragged outline under a roller: an elastic half-space (section 19), coded apart from the program.

    python3 validation/half_space/outlines.py [NAME ...]

Reads crates/brinell-damage/tests/half_space/NAME.toml (roller, raceway and outline; a straight roller) and writes NAME.csv beside it: s, delta,
delta_eff and its slope Q_d/Q_h(delta_eff), extrapolated from two grids, which differ by the last two columns. The approach is given, unlike in
half_space.py, whose coefficients and convolution serve. Needs NumPy and SciPy; takes some ten minutes of one core.
"""

import csv
import sys
import tomllib
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from half_space import MM, UM, HalfSpace

FOLDER = Path(__file__).resolve().parents[2] / "crates/brinell-damage/tests/half_space"
# NN3007: diameters of roller and outer raceway, length of the roller.
D, RACEWAY, LENGTH = 6e-3, 55e-3, 6e-3
R_X = 1 / (2 / D - 2 / RACEWAY)
EDGE = 10e-6  # contact.edge_radius_um
PIXEL = 1e-6
# delta, um, with the cell along s of the finer grid; across both have the same.
DELTA = {0.6: 1.0, 1.5: 1.5, 3.3: 2.5, 6.3: 3.5}
ACROSS = 4e-6
# s, mm.
ALONG = {"slot": [-1.75, -1.62, -1.4, -1.0, -0.4, 0.0, 0.7], "ragged": [-1.5, -1.32, -1.1, -0.7, -0.15, 0.35, 0.8, 1.25]}


class Outline:
    """Depth over s and z, with edges rounded by the running mean of EDGE along both axes."""

    def __init__(self, polygons, depth):
        points = np.concatenate(polygons)
        self.low, high = points.min(axis=0) - 2 * EDGE, points.max(axis=0) + 2 * EDGE
        n = np.ceil((high - self.low) / PIXEL).astype(int)
        z = self.low[1] + (np.arange(n[1]) + 0.5) * PIXEL
        inside = np.zeros(n, dtype=bool)
        for row, s in enumerate(self.low[0] + (np.arange(n[0]) + 0.5) * PIXEL):
            for polygon in polygons:  # even-odd
                (a, c), (b, d) = polygon.T, np.roll(polygon, -1, axis=0).T
                cut = (a > s) != (b > s)
                crossing = c[cut] + (s - a[cut]) / (b[cut] - a[cut]) * (d[cut] - c[cut])
                inside[row] ^= np.searchsorted(np.sort(crossing), z) % 2 == 1
        self.sums = np.zeros(n + 1)
        self.sums[1:, 1:] = depth * inside.cumsum(axis=0).cumsum(axis=1)

    def before(self, s, z):
        """Integral of the depth before the corners (s, z) of a grid, in pixels."""
        places = [np.clip((x - low) / PIXEL, 0, n - 1) for x, low, n in zip((s, z), self.low, self.sums.shape)]
        (i, a), (j, b) = [((k := np.minimum(x.astype(int), n - 2)), x - k) for x, n in zip(places, self.sums.shape)]
        rows = self.sums[i] + a[:, None] * (self.sums[i + 1] - self.sums[i])
        return rows[:, j] + b * (rows[:, j + 1] - rows[:, j])

    def __call__(self, s, z):
        h = EDGE / 2
        return (self.before(s + h, z + h) - self.before(s - h, z + h) - self.before(s + h, z - h) + self.before(s - h, z - h)) / (EDGE / PIXEL) ** 2


def press(grid, gap, delta, p, tolerance=1e-6):
    """Energy, force and pressures at an approach: conjugate gradients of Polonsky and Keer without the load's condition."""
    t, before, conjugate = np.zeros_like(gap), 1.0, 0.0
    p = np.where(gap < delta, p, 0.0)
    for _ in range(2000):
        g = grid.deflection(p) + gap - delta
        touching = p > 0
        entering = (p == 0) & (g < 0)
        worst = max(np.abs(g[touching]).max(initial=0.0), -g[entering].min(initial=0.0))
        if worst < tolerance * delta:
            u = p * grid.cell
            return (u * (delta - gap)).sum() / 2, u.sum(), p
        touching |= entering
        square = (g[touching] ** 2).sum()
        t, before = np.where(touching, g + (0.0 if entering.any() else conjugate) * square / before * t, 0.0), square
        step = (g[touching] * t[touching]).sum() / (grid.deflection(t)[touching] * t[touching]).sum()
        old = p > 0
        p = np.where(touching, np.clip(p - step * t, 0, None), 0.0)
        conjugate = 1.0 if ((p > 0) >= old).all() else 0.0
    raise AssertionError("no convergence")


class Healthy:
    """Energy of the healthy contact on a grid up to delta: what a damaged one's is compared with."""

    def __init__(self, grid, gap, delta):
        nodes, p = [], np.zeros_like(gap) + 1e8
        for d in delta * np.array([1, 0.8, 0.62, 0.48, 0.36, 0.27, 0.2]):
            u, q, p = press(grid, gap, d, p)
            nodes.append((np.log(d), np.log(u), d * q / u))
        self.x, log_u, slope = np.array(nodes[::-1]).T
        self.log_u = CubicHermiteSpline(self.x, log_u, slope)

    def effective(self, u, q):
        x = brentq(lambda x: self.log_u(x) - np.log(u), self.x[0], self.x[-1] + 1e-3)
        return np.exp(x), q / (self.log_u(x, 1) * u / np.exp(x))


def table(outline, along):
    for delta_um, cell_um in DELTA.items():
        delta, found = delta_um / UM, []
        for k in (2, 1):
            dx, dz = k * cell_um / UM, k * ACROSS
            columns = 2 * np.ceil(np.sqrt(2 * R_X * delta) / dx)
            grid = HalfSpace(dx, dz, columns * dx, LENGTH)
            x, z = grid.x[:, 0], grid.z[0]
            gap = np.broadcast_to((x**2 / (2 * R_X))[:, None], grid.n)
            healthy, p = Healthy(grid, gap, delta), np.full(grid.n, 1e8)
            row = []
            for s in along:
                u, q, p = press(grid, gap + outline(s * MM + x, z), delta, p + 1e6)
                row.append(healthy.effective(u, q))
            found.append(np.array(row))
        coarse, fine = found
        for s, value, change in zip(along, 2 * fine - coarse, fine - coarse):
            print(s, delta_um, value[0] * UM, value[1], change / (delta, 1), flush=True)
            yield [s, delta_um, f"{value[0] * UM:.5f}", f"{value[1]:.5f}", f"{change[0] * UM:.5f}", f"{change[1]:.5f}"]


if __name__ == "__main__":
    for name in sys.argv[1:] or ALONG:
        defect = tomllib.loads((FOLDER / f"{name}.toml").read_text())["defects"][0]
        polygons = [np.array(polygon) * MM for polygon in defect["shape"]["outline"]["polygons_mm"]]
        with open(FOLDER / f"{name}.csv", "w", newline="") as file:
            out = csv.writer(file, lineterminator="\n")
            out.writerow(["s_mm", "delta_um", "delta_eff_um", "slope", "delta_eff_finer_less_coarser_um", "slope_finer_less_coarser"])
            out.writerows(table(Outline(polygons, defect["depth_um"] / UM), ALONG[name]))
