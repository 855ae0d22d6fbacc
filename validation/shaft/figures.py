"""Figures of ROSS (ross-rotordynamics 2.3.0, plotly below 6) that crates/brinell-shaft/tests hold the shaft against.

    python3 -m venv ross && ross/bin/pip install ross-rotordynamics==2.3.0 "plotly<6"
    ross/bin/python validation/shaft/figures.py

It prints all but the Campbell diagrams, which it writes to crates/brinell-shaft/tests/campbell.csv.
"""

from pathlib import Path

import numpy as np
import ross

STEEL = ross.Material(name="steel", rho=7810, E=211e9, G_s=81.2e9)


def rotor(bearings, outer=0.05, inner=0.0):
    shaft = [ross.ShaftElement(0.25, inner, outer, material=STEEL) for _ in range(6)]
    discs = [ross.DiskElement.from_geometry(n, STEEL, 0.07, 0.05, d) for n, d in ((2, 0.28), (4, 0.35))]
    held = [ross.BearingElement(n=n, **of) for n, of in zip((0, 6), bearings)]
    return ross.Rotor(shaft, discs, held)


ROUND = 2 * [{"kxx": 1e6, "cxx": 100.0}]
UNEQUAL = [
    {"kxx": 1e6, "kyy": 0.7e6, "kxy": 0.1e6, "kyx": -0.05e6, "cxx": 100.0, "cyy": 150.0},
    {"kxx": 2e7, "kyy": 1.5e7, "cxx": 300.0},
]

for name, held in (("round", ROUND), ("unequal", UNEQUAL)):
    for hollow in (0.0, 0.03):
        machine = rotor(held, inner=hollow)
        for rpm in (0.0, 4000.0):
            modes = machine.run_modal(rpm * np.pi / 30.0, num_modes=20)
            print(name, hollow, rpm, "Hz", [f"{w / 2 / np.pi:.6f}" for w in modes.wd[:6]], "ratios", [f"{r:.6e}" for r in modes.damping_ratio[:6]])
        for rpm in (700.0, 2400.0):
            w = rpm * np.pi / 30.0
            response = machine.run_unbalance_response([2, 4], [0.001, 0.002], [0.3, 1.7], frequency=[w])
            # All coordinates of a node are x, y, z, alpha, beta, theta.
            u = response.forced_resp[:, 0]
            per_node = len(u) // len(machine.nodes)
            print(name, hollow, rpm, "m", [f"{u[per_node * n + k]:.9e}" for n in (0, 2, 6) for k in (0, 1)])

machine = rotor(ROUND)
critical = machine.run_critical_speed(num_modes=12)
print("critical, rad/s", [f"{w:.6f}" for w in critical.wn()])

# From rest on springs alone, the disc at 0.5 m out of balance by 1e-3 kg m at 0.3 rad, at 2400 r/min.
machine = rotor(2 * [{"kxx": 1e6, "cxx": 0.0}])
w, t = 2400.0 * np.pi / 30.0, np.arange(0.0, 0.1 + 5e-6, 1e-5)
per_node = machine.ndof // len(machine.nodes)
force = np.zeros((len(t), machine.ndof))
force[:, per_node * 2] = 1e-3 * w**2 * np.cos(w * t + 0.3)
force[:, per_node * 2 + 1] = 1e-3 * w**2 * np.sin(w * t + 0.3)
response = machine.run_time_response(w, force, t)
for k in (2000, 5000, 10000):
    print(f"t = {t[k]:.3f} s", [f"{response.yout[k, per_node * n + i]:.9e}" for n in (0, 2, 4) for i in (0, 1)])

# Campbell diagrams: bearings that are unequal, and such whose stiffness and damping change with speed too.
SPEEDS = np.linspace(0.0, 10000.0, 11) * np.pi / 30.0
share = SPEEDS / SPEEDS[-1]
BY_SPEED = [
    {"kxx": 1e6 * (1 + 4 * share**2), "kyy": 0.7e6 * (1 + 2 * share), "kxy": 0.3e6 * share, "kyx": -0.2e6 * share,
     "cxx": 100.0 * (1 + share), "cyy": 150.0 * (1 - 0.5 * share)},
    {"kxx": 2e7 * (1 - 0.9 * share), "kyy": 1.5e7 * (1 - 0.8 * share), "cxx": 300.0 * (1 + 9 * share), "cyy": 300.0},
]


def bending(machine, w):
    """Damped natural frequencies, Hz, damping ratios and whirls of the modes that bend: they move across, or tilt."""
    modes = machine.run_modal(w, num_modes=60)
    across = np.tile([True, True, False, True, True, False], len(machine.nodes))
    of = np.abs(modes.evectors[: machine.ndof]) ** 2
    bends = of[across].sum(axis=0)[: len(modes.wd)] > of[~across].sum(axis=0)[: len(modes.wd)]
    return [row for row, b in zip(zip(modes.wd / 2 / np.pi, modes.damping_ratio, modes.whirl_direction()), bends) if b]


with open(Path(__file__).parents[2] / "crates/brinell-shaft/tests/campbell.csv", "w") as table:
    print("bearings,rpm,mode,hz,damping_ratio,whirl", file=table)
    for name, held in (("unequal", UNEQUAL), ("by_speed", [{**of, "frequency": SPEEDS} for of in BY_SPEED])):
        machine = rotor(held, inner=0.03)
        for w in SPEEDS:
            for k, (hz, ratio, whirl) in enumerate(bending(machine, w)[:6]):
                # At rest on these nothing couples the planes: which way a motion goes round is round-off.
                whirl = "None" if name == "by_speed" and w == 0.0 else whirl
                print(f"{name},{w * 30 / np.pi:.0f},{k},{hz:.7f},{ratio:.7e},{whirl}", file=table)

# The rotor of Nelson and McVaugh (1976): critical speeds, and how far these are open by the rounding of what is printed of it.
ENDS = [1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67, 28.70, 30.48, 31.50, 34.54, 35.56]
RADII = [0.51, 1.02, 0.76, 2.03, 2.03, 3.30, 3.30, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27, 3.81, 2.03, 2.03]
HOLES = {6: 1.52, 7: 1.78, 17: 1.52}
generator = np.random.default_rng(0)


def nelson_mcvaugh(rounding):
    def cm(x):
        return 0.01 * (x + rounding * generator.uniform(-0.005, 0.005))

    steel = ross.Material(name="printed", rho=7806, E=2.078e11, G_s=0.8e11)
    places = [0.0] + [cm(z) for z in ENDS]
    shaft = [
        ross.ShaftElement(b - a, 2 * cm(HOLES[k]) if k in HOLES else 0.0, 2 * cm(r), material=steel, shear_effects=False)
        for k, (a, b, r) in enumerate(zip(places, places[1:], RADII))
    ]
    disc = ross.DiskElement(n=4, m=1.401, Id=0.00136, Ip=0.00203)
    held = [ross.BearingElement(n=n, kxx=4.378e7, cxx=0.0) for n in (10, 14)]
    return critical(ross.Rotor(shaft, [disc], held))


def critical(machine):
    """Critical speeds, r/min, in the plane of a circular motion: K u = w^2 (M -+ G) u, of the matrices of the program."""
    at = np.arange(machine.ndof).reshape(-1, 6)
    plane = at[:, [0, 4]].ravel(), at[:, [1, 3]].ravel()
    m, k, g = machine.M(0), machine.K(0), machine.G()
    # A tilt about X counts as the slope -dy/dz.
    sign = np.tile([1.0, -1.0], len(at))
    g = g[np.ix_(plane[0], plane[1])] * sign
    m, k = (matrix[np.ix_(plane[0], plane[0])] for matrix in (m, k))
    found = [np.linalg.eigvals(np.linalg.solve(k, m - way * g)).real for way in (1, -1)]
    return np.sort([v**-0.5 * 30 / np.pi for of in found for v in of if v > 0])[:6]


print("Nelson and McVaugh, r/min", [f"{n:.2f}" for n in nelson_mcvaugh(0.0)])
drawn = np.array([nelson_mcvaugh(1.0) for _ in range(200)])
print("standard deviation by rounding, %", [f"{x:.2f}" for x in 100 * drawn.std(axis=0) / drawn.mean(axis=0)])
