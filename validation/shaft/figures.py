"""Figures of ROSS (ross-rotordynamics 2.3.0, plotly below 6) that crates/brinell-shaft/tests hold the shaft against.

    python3 -m venv ross && ross/bin/pip install ross-rotordynamics==2.3.0 "plotly<6"
    ross/bin/python validation/shaft/figures.py
"""

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
