"""Where things are, and what every program is asked for."""

import pathlib

HERE = pathlib.Path(__file__).resolve().parents[1]
ROOT = HERE.parents[1]
SCENARIO = ROOT / "examples" / "rectangle.toml"

RATE = 25600.0  # samples a second: the scenario's
FROM_S, WINDOW_S, WINDOWS = 1e-3, 2.5e-3, 8
CHANNELS = ["inner_ax", "inner_ay", "outer_ax", "outer_ay"]
MATCHED = 0.01
RHS_LIMIT = 1e-10
# Fixed steps of the trajectory that errors are measured against, and twice that to see how far it can be trusted.
REFERENCE_STEP = 1e-8
# What a tolerance of 1 means: 1 m on a surface and 1000 m/s; nothing relative, for angles grow without bound.
LENGTH, SPEED, RTOL = 1.0, 1e3, 0.0
TIME_LIMIT_S = 400.0
LONG_S = 0.2
# Of the command under brinell's default laws, without files.
DEFAULT_LAWS_S = 2.5
