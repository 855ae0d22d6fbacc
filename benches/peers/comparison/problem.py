"""The one problem that all solve, and how far a solution is off."""

import csv
import hashlib
import math
import random
import statistics
import subprocess
import sys
import tomllib

from .settings import (CHANNELS, FROM_S, HERE, RATE, REFERENCE_STEP, RHS_LIMIT, ROOT, SCENARIO, WINDOW_S, WINDOWS)
from .tools import capture, one_thread, say

sys.path.insert(0, str(ROOT / "validation" / "independent"))
import generate  # noqa: E402


class Problem:
    """The scenario as plain numbers, the table of right-hand sides and the trajectory, all from the independent
    implementation.
    """

    def __init__(self, programs):
        self.build = programs.build
        # The peers know the paper's laws and film only; the example says nothing of its laws and cage.
        self.example = self.build / SCENARIO.name
        self.example.write_text(SCENARIO.read_text().replace("[simulation]\n", '[simulation]\nlaws = "li2023"\n') + '\n[cage]\nguidance_film = "quasi-static"\n')
        text = capture([*programs.commands["brinell"], "resolve", self.example])
        scenario = tomllib.loads(text)
        scenario["simulation"] |= {"duration_s": FROM_S + WINDOWS * WINDOW_S, "sample_rate_hz": RATE}
        self.scenario = scenario
        self.file = self.build / "problem.txt"
        self.file.write_text(self.numbers())
        self.states = self.build / "states.txt"
        self.table = self.make_table()
        self.reference, self.trust = self.make_reference()

    def parameters(self, step):
        return generate.parameters(self.scenario, step, 0.0, ["t", *CHANNELS])

    def numbers(self):
        """One number to a name: what the peers read."""
        words = ("element", "profile", "guidance", "guidance_film", "law", "roller_path", "slices", "load_on", "model",
                 "start", "speed", "defect", "record", "step", "perturb", "tolerance")
        sc = self.scenario
        (defect,), o = sc["defects"], sc["operation"]
        expected = {
            "guidance": (sc["cage"]["guidance"], "outer-ring"),
            "guidance_film": (sc["cage"]["guidance_film"], "quasi-static"),
            "load_on": (o["load_on"], "outer-ring"),
            "on": (defect["on"], "outer-raceway"),
            "model": (sc["simulation"]["model"], "full"),
            "start": (sc["simulation"]["start"], "rolling"),
            "gravity": (o["gravity_m_per_s2"], [0.0, 0.0]),
            "drag": (sc["lubricant"]["drag_coefficient"], 0.0),
            "gap": (sc["bearing"]["outer_gap_um"], 0.0),
        }
        for name, (value, wanted) in expected.items():
            assert value == wanted, f"the peers know {name} = {wanted} only, not {value}"
        lines = [line for line in self.parameters(REFERENCE_STEP).splitlines() if line.split()[0] not in words]
        shape = defect["shape"]["rectangle"]
        more = {
            "speed": o["speed_rpm"] * math.pi / 30,
            "defect_row": defect["row"],
            "defect_angle": math.radians(defect["center_deg"]),
            "defect_depth": defect["depth_um"] * 1e-6,
            "defect_length": shape["length_mm"] * 1e-3,
            "defect_width": shape["width_mm"] * 1e-3,
        }
        return "\n".join([*lines, *(f"{name} {value!r}" for name, value in more.items())]) + "\n"

    def make_table(self):
        exe, parameters = self.build / "reference", self.build / "parameters.txt"
        capture(["gcc", "-std=c99", "-O2", "-o", exe, *generate.sources(HERE / "c" / "reference.c"), "-lm"])
        parameters.write_text(self.parameters(REFERENCE_STEP))
        states = list(self.random_states(24))
        lines = [str(len(states)), *(" ".join(map(repr, [t, *y])) for t, y in states)]
        self.states.write_text("\n".join(lines) + "\n")
        self.count = len(states)
        table = [float(x) for x in capture([exe, parameters, self.states]).split()]
        self.dof = len(table) // (self.count + 2)
        return table

    def random_states(self, count):
        """Contacts loaded, open, and pulled apart faster than their damper lets them push; rollers on the spall, over
        its floor and beside either edge, some turns on; pockets pressed on both sides, and grazed; slow and fast slip
        in them; a cage on its land.
        """
        b, c = self.scenario["bearing"], self.scenario["cage"]
        rows, rollers = b["rows"], b["rollers_per_row"]
        n = rows * rollers
        pitch = b["pitch_diameter_mm"] * 0.5e-3
        stagger, play = math.radians(b["row_stagger_deg"]), c["guide_clearance_mm"] * 1e-3
        side = c["pocket_clearance_mm"] * 1e-3 / pitch
        length = self.scenario["defects"][0]["shape"]["rectangle"]["length_mm"]
        edge = length / b["outer_raceway_diameter_mm"]
        shaft = self.scenario["operation"]["speed_rpm"] * math.pi / 30
        orbit = shaft * b["inner_raceway_diameter_mm"] * 0.5e-3 / (2 * pitch)
        rng = random.Random(3007)
        u = rng.uniform
        for k in range(count):
            grazing, land = k % 4 == 0, k == 3
            reach = 2e-6 if grazing else 5e-5
            speed = 0.5 if grazing else 2e-2
            turn = rng.choice([-1, 0, 0, 1]) * math.tau + u(-0.06, 0.06)
            theta = []
            for i in range(rows):
                for j in range(rollers):
                    off = rng.choice([-1, 1]) * side + u(-3e-5, 3e-5) if grazing else u(-1.5, 1.5) * side
                    theta.append(turn + i * stagger + math.tau * j / rollers + off)
            theta[0] = math.tau * rng.choice([-1, 0, 1]) + rng.choice([-1, 1]) * edge * rng.choice([0.997, 1.003])
            spin = (orbit - 15, orbit + 15) if k % 2 else (-700, -600)
            # Near the outer raceway's touch, or the inner one's.
            touch = [rng.choice([0.0, -b["radial_clearance_um"] * 1e-6]) for _ in range(n)]
            q = [x + u(-reach, reach) for x in touch] + theta + [u(-50, 50) for _ in range(n)]
            v = [u(-speed, speed) for _ in range(n)]
            v += [orbit * u(0.9, 1.1) for _ in range(n)] + [u(*spin) for _ in range(n)]
            for row in range(rows):
                away = 1.1 * play if land and row else 1e-7 * u(0, 1) if grazing else u(0, 0.9) * play
                way = u(0, math.tau)
                q += [away * math.cos(way), away * math.sin(way), turn + (0.0 if grazing else u(-0.5, 0.5) * side)]
                v += [u(-1e-2, 1e-2), u(-1e-2, 1e-2), orbit * u(0.97, 1.03)]
            q += [u(-reach, reach) for _ in range(4)]
            v += [u(-speed, speed) for _ in range(4)]
            yield u(0, 0.04), q + v

    def groups(self):
        """Coordinates of one kind, within which errors are relative to the largest value."""
        b = self.scenario["bearing"]
        n, rows = b["rows"] * b["rollers_per_row"], b["rows"]
        cages = [3 * n + 3 * row + k for row in range(rows) for k in (0, 2)]
        bounds = [0, n, 2 * n, *cages, self.dof - 4, self.dof - 2, self.dof]
        return list(zip(bounds, bounds[1:]))

    def check(self, name, command, argument):
        """Stops everything where a peer's right-hand side or start is another."""
        got = [float(x) for x in capture([*command, argument, self.states], env=one_thread()).split()]
        if len(got) != len(self.table):
            raise SystemExit(f"{name}: {len(got)} values where {len(self.table)} were requested")
        worst = 0.0
        for block in range(self.count + 2):
            for a, b in self.groups():
                span = range(block * self.dof + a, block * self.dof + b)
                size = max(abs(self.table[k]) for k in span)
                gap = max(abs(got[k] - self.table[k]) for k in span)
                if not gap <= RHS_LIMIT * size:
                    what = f"state {block + 1}" if block < self.count else "start"
                    where = f"{what}, coordinates {a} to {b}: off by {gap:g} of {size:g}"
                    raise SystemExit(f"{name} SOLVES ANOTHER PROBLEM: {where}")
                worst = max(worst, gap / size if size else 0.0)
        say(f"  {name}: right-hand side within {worst:.1e} of the table")
        return worst

    def make_reference(self):
        """Samples by classical Runge-Kutta at fixed steps, and the error of twice the step by the measure below.

        Cached.
        """
        source = "".join(path.read_text() for path in sorted(generate.HERE.glob("*.[ch]")))
        texts = {step: self.parameters(step) for step in (REFERENCE_STEP, 2 * REFERENCE_STEP)}
        key = hashlib.sha256((source + "".join(texts.values())).encode()).hexdigest()[:16]
        files = {step: self.build / f"trajectory-{key}-{step:g}.csv" for step in texts}
        if not all(path.exists() for path in files.values()):
            say("the trajectory to measure errors against (a minute)")
            exe = generate.build(self.build)
            running = []
            for step, path in files.items():
                text, part = path.with_suffix(".txt"), path.with_suffix(".partial")
                text.write_text(texts[step])
                running.append((subprocess.Popen([exe, text], stdout=part.open("w")), part, path))
            for process, part, path in running:
                if process.wait():
                    raise SystemExit("the independent implementation failed")
                part.rename(path)
        fine, coarse = ([[float(x) for x in row[1:]] for row in list(csv.reader(f.open()))[1:]] for f in files.values())
        self.reference = fine
        return fine, self.errors(coarse, WINDOWS)

    def errors(self, samples, windows):
        """Median over windows of the relative L2 error, for each channel."""
        result = {}
        for c, channel in enumerate(CHANNELS):
            each = []
            for w in range(windows):
                lo, hi = (math.ceil((FROM_S + (w + k) * WINDOW_S) * RATE - 1e-9) for k in (0, 1))
                num = sum((samples[k][c] - self.reference[k][c]) ** 2 for k in range(lo, hi))
                each.append(math.sqrt(num / sum(self.reference[k][c] ** 2 for k in range(lo, hi))))
            result[channel] = statistics.median(each)
        return result
