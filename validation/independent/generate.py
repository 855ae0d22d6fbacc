#!/usr/bin/env python3
"""Run the independent implementation of model.md on scenario files.

    generate.py run SCENARIO.toml OUT.csv [--step 1e-8] [--tolerance 1e-11] [--perturb 0] [--record CHANNEL ...]
    generate.py verify FOLDER [NAME ...]     compare with the reference trajectories NAME.toml, NAME.csv in FOLDER
    generate.py facts                        the numbers that the text states for Part II
    generate.py balance SCENARIO.toml        momentum, angular momentum and energy at states near the start (Part II)
    generate.py goldens [NAME ...]   write crates/brinell/tests/xval/NAME.csv and tolerances.csv

Python 3.11, standard library only; needs gcc. Unit conversion is all that happens here: the physics is in the C files.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
XVAL = HERE.parents[1] / "crates" / "brinell" / "tests" / "xval"
STEP = 1e-8
TOLERANCE = 1e-11  # of a step of the extrapolation, Part II
SETTLED = 1e-3  # s; the start-up drop before it would hide everything else
WORST = 0.02  # the share of samples beside a force jump that may be left out


def sources(program="main.c"):
    """The C files; another program may stand in for main.c."""
    return [*sorted(path for path in HERE.glob("*.c") if path.name != "main.c"), HERE / program]


def build(folder):
    exe = pathlib.Path(folder) / "model"
    flags = ["-std=c99", "-O3", "-march=native", "-Wall", "-Wextra"]
    subprocess.run(["gcc", *flags, "-o", str(exe), *map(str, sources()), "-lm"], check=True)
    return exe


def is_part_two(sc):
    return sc["simulation"].get("laws", "li2023") == "mechanics"


def is_smooth(sc):
    return is_part_two(sc) and "damping_time_us" in sc["contact"]


def palmgren(length_mm):
    """N/m^(10/9): K = 8.06e4 L^(8/9) N/mm^(10/9), L in mm."""
    return 8.06e4 * length_mm ** (8 / 9) * 1000 ** (10 / 9)


def damage_table(path):
    """s_mm, delta_um, delta_eff_um on a full grid: nodes along s, nodes along delta, values by s then delta; SI."""
    rows = list(csv.reader(path.read_text().splitlines()))
    assert rows[0] == ["s_mm", "delta_um", "delta_eff_um"], path
    values = {(float(s), float(d)): float(e) for s, d, e in rows[1:]}
    along, deltas = sorted({s for s, _ in values}), sorted({d for _, d in values})
    flat = [values[s, d] * 1e-6 for s in along for d in deltas]
    assert len(flat) == len(rows) - 1, path
    return [s * 1e-3 for s in along], [d * 1e-6 for d in deltas], flat


def slices(sc, put):
    """The keys of tilting rollers and of profiles."""
    b = sc["bearing"]
    if sc["simulation"].get("model") == "tilting":
        put("width", b["width_mm"] * 1e-3)
        put("row_spacing", b["row_spacing_mm"] * 1e-3)
        put("load_offset", sc["operation"]["load_offset_mm"] * 1e-3)
        for ring in "inner", "outer":
            put(f"{ring}_tilt_stiffness", sc["support"][f"{ring}_tilt_stiffness_nm_per_rad"])
            put(f"{ring}_tilt_damping", sc["support"][f"{ring}_tilt_damping_nms_per_rad"])
    profile = b.get("profile", "straight")
    if isinstance(profile, str):
        put("profile", profile)
    elif "crowned_radius_mm" in profile:
        put("profile", "crowned", profile["crowned_radius_mm"] * 1e-3)
    else:
        pairs = zip(profile["z_mm"], profile["drop_um"], strict=True)
        put("profile", "drops", len(profile["z_mm"]), *(x for z, p in pairs for x in (z * 1e-3, p * 1e-6)))


def mechanics(sc, put, folder):
    """The keys of Part II; none has a default here."""
    b, c, k, f, sim = sc["bearing"], sc["cage"], sc["contact"], sc["friction"], sc["simulation"]
    assert sim["geometry"] == "exact" and k["law"] == "half-space" and sc["lubricant"].get("raceway_film", "none") == "none"
    put("geometry", "exact")
    put("walls", c["walls"])
    put("pockets", c["pockets"])
    put("pocket_friction", c["friction_coefficient"])
    if "damping_time_us" in k:
        put("damping_time", k["damping_time_us"] * 1e-6)
        put("roughness", k["roughness_um"] * 1e-6)
    put("rolling", f["rolling_coefficient"])
    put("housing_mass", sc["housing"]["mass_kg"])
    for key, name in ("waviness", "raceway_waves"), ("element_waviness", "element_waves"):
        if key in b:
            put(name, b[key]["amplitude_um"] * 1e-6, b[key]["exponent"], *b[key]["waves"])
            put("seed", sim["seed"])
    for d in sc.get("defects", []):
        along, deltas, values = damage_table(folder / d["table"])
        put("damage", d["on"], d["row"], d.get("roller", 0), math.radians(d["center_deg"]), len(along), len(deltas),
            *along, *deltas, *values)


def parameters(sc, step, perturb, record, folder=None, tolerance=0.0):
    """The flat SI text that parameters.c reads; tables of damage lie in `folder`."""
    b, c, k = sc["bearing"], sc["cage"], sc["contact"]
    f, l, s, o, sim = sc["friction"], sc["lubricant"], sc["support"], sc["operation"], sc["simulation"]
    ball = b.get("element") == "ball"
    part_two = is_part_two(sc)
    out = []

    def put(name, *values):
        out.append(" ".join([name, *(v if isinstance(v, str) else repr(v) for v in values)]))

    rpm = math.pi / 30
    put("element", b.get("element", "roller"))
    put("rows", b["rows"])
    put("rollers", b["rollers_per_row"])
    put("inner_raceway_diameter", b["inner_raceway_diameter_mm"] * 1e-3)
    put("outer_raceway_diameter", b["outer_raceway_diameter_mm"] * 1e-3)
    put("pitch_radius", b["pitch_diameter_mm"] * 0.5e-3)
    put("roller_radius", b["roller_diameter_mm"] * 0.5e-3)
    put("roller_length", 0.0 if ball else b["roller_length_mm"] * 1e-3)
    put("stagger", math.radians(b.get("row_stagger_deg", 180.0 / b["rollers_per_row"])))
    put("clearance", b["radial_clearance_um"] * 1e-6)
    put("outer_gap", b.get("outer_gap_um", 0.0) * 1e-6)
    put("inner_mass", b["inner_ring_mass_kg"])
    put("outer_mass", b["outer_ring_mass_kg"])
    put("roller_mass", b["roller_mass_kg"])
    put("cage_mass", c["mass_kg"])
    put("cage_inner_radius", c["inner_diameter_mm"] * 0.5e-3)
    put("cage_outer_radius", c["outer_diameter_mm"] * 0.5e-3)
    put("pocket_clearance", c["pocket_clearance_mm"] * 1e-3)
    put("guidance", c["guidance"])
    put("guidance_film", c.get("guidance_film", "dynamic"))
    put("guide_clearance", c["guide_clearance_mm"] * 1e-3)
    put("guide_width", c["guide_width_mm"] * 1e-3)
    if not part_two or c["walls"] == "linear":
        put("cage_stiffness", c["contact_stiffness_n_per_m"])
        put("cage_damping", c["contact_damping_ns_per_m"])
    put("exponent", 1.5 if ball else k.get("exponent", 10 / 9))
    for ring in "inner", "outer":
        key = f"{ring}_stiffness"
        if key in k or not ball:
            put(key, k[key] if key in k else palmgren(b["roller_length_mm"]))
    if ball:
        put("grooves", *(b.get(f"{ring}_groove_conformity", 0.52) for ring in ("inner", "outer")),
            k.get("youngs_modulus_gpa", 206.0) * 1e9, k.get("poisson_ratio", 0.3))
    put("law", k.get("law", "ecl"))
    put("roller_path", k.get("roller_path", "point"))
    put("slices", k.get("slices", 30))
    if not part_two or "damping_ns_per_m" in k:
        put("contact_damping", k["damping_ns_per_m"])
    put("friction", f["raceway_coefficient"])
    put("slip_velocity", f["slip_velocity_m_per_s"])
    put("viscosity", l["viscosity_pa_s"])
    put("drag", l.get("drag_coefficient", 0.0))
    put("density", l.get("effective_density_kg_per_m3", 0.0))
    for ring in "inner", "outer":
        put(f"support_{ring}_stiffness", s[f"{ring}_stiffness_n_per_m"])
        put(f"support_{ring}_damping", s[f"{ring}_damping_ns_per_m"])
    speed = o["speed_rpm"]
    points = speed if isinstance(speed, list) else [[0.0, speed]]
    put("speed", len(points), *(x for t, n in points for x in (float(t), n * rpm)))
    put("load_x", o["load_n"][0])
    put("load_y", o["load_n"][1])
    put("load_on", o["load_on"] if "load_on" in o else "outer-ring")
    put("ramp", o["load_ramp_s"])
    gravity = o.get("gravity_m_per_s2", [0.0, 0.0])
    put("gravity_x", gravity[0])
    put("gravity_y", gravity[1])
    slices(sc, put)
    if part_two:
        mechanics(sc, put, folder)
    for d in [] if part_two else sc.get("defects", []):
        (kind, shape), = d["shape"].items()
        depth = d.get("depth_um", 0.0) * 1e-6
        if kind == "rectangle":
            values = [shape["length_mm"] * 1e-3, shape["width_mm"] * 1e-3]
        elif kind == "circle":
            values = [shape["diameter_mm"] * 1e-3]
        elif kind == "li2023_irregular":
            values = [shape["max_width_mm"] * 1e-3]
        elif kind == "profile":
            depths = shape.get("depth_um", [depth * 1e6] * len(shape["arc_mm"]))
            values = [len(shape["arc_mm"])]
            for a, w, h in zip(shape["arc_mm"], shape["width_mm"], depths, strict=True):
                values += [a * 1e-3, w * 1e-3, h * 1e-6]
        elif kind == "outline":
            polygons = shape["polygons_mm"] if "polygons_mm" in shape else [shape["points_mm"]]
            values = [len(polygons)]
            for points in polygons:
                values += [len(points), *(x * 1e-3 for point in points for x in point)]
        elif kind == "depth_map" and "file" not in shape:
            columns, rows, ds, dz = shape["columns"], shape["rows"], shape["ds_mm"], shape["dz_mm"]
            s0, z0 = shape.get("s0_mm", -0.5 * ds * (columns - 1)), shape.get("z0_mm", -0.5 * dz * (rows - 1))
            values = [columns, rows, *(x * 1e-3 for x in (s0, z0, ds, dz)), *(h * 1e-6 for h in shape["depth_um"])]
        else:
            raise SystemExit(f"shape {kind} is not implemented")
        put("defect", d["on"], d["row"], d.get("roller", 0), math.radians(d["center_deg"]), depth,
            d.get("axial_offset_mm", 0.0) * 1e-3, kind, *values)
    put("model", sim.get("model", "full"))
    put("start", sim.get("start", "rolling"))
    put("duration", sim["duration_s"])
    put("sample_rate", sim["sample_rate_hz"])
    put("step", step)
    put("tolerance", tolerance)
    put("perturb", perturb)
    put("record", len(record), *record)
    return "\n".join(out) + "\n"


def simulate(exe, scenario, step=STEP, perturb=0.0, record=None, tolerance=None, flag=None):
    """CSV text of one run. Part II: extrapolation to a tolerance; fixed steps where it is 0 or the damping c jumps."""
    sc = tomllib.loads(pathlib.Path(scenario).read_text())
    if tolerance is None:
        tolerance = TOLERANCE if is_smooth(sc) else 0.0
    if record is None:
        record = sc["simulation"]["record"]
    record = ["t"] + [name for name in record if name != "t"]
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as text:
        text.write(parameters(sc, step, perturb, record, pathlib.Path(scenario).parent, tolerance))
        text.flush()
        return subprocess.run([str(exe), *([flag] if flag else []), text.name], check=True, stdout=subprocess.PIPE, text=True).stdout


def columns(text):
    rows = list(csv.reader(text.splitlines()))
    return {name: [float(r[i]) for r in rows[1:]] for i, name in enumerate(rows[0])}


def difference(a, b, times, drop=0.0):
    """Relative L2 difference of b from a from SETTLED on; `drop` is the share of worst samples left out."""
    pairs = [(x, y) for x, y, t in zip(a, b, times, strict=True) if t >= SETTLED - 1e-12]
    pairs.sort(key=lambda p: abs(p[0] - p[1]))
    pairs = pairs[: len(pairs) - int(drop * len(pairs))]
    size = math.sqrt(sum(x * x for x, _ in pairs))
    gap = math.sqrt(sum((x - y) ** 2 for x, y in pairs))
    return gap / size if size > 0 else gap


def verify(exe, folder, step, tolerance, names):
    for scenario in sorted(pathlib.Path(folder).glob("*.toml")):
        if names and scenario.stem not in names:
            continue
        want = columns(scenario.with_suffix(".csv").read_text())
        got = columns(simulate(exe, scenario, step, record=list(want), tolerance=tolerance))
        assert len(got["t"]) == len(want["t"])
        print(f"{scenario.stem}\n{'channel':28}{'all':>10}{'without worst 2 %':>20}")
        for name in want:
            if name != "t":
                full, part = (difference(want[name], got[name], want["t"], d) for d in (0.0, WORST))
                print(f"{name:28}{full:10.2e}{part:20.2e}")


def bump(x):
    """1 at 0, 0 from |x| = 1 on, C2."""
    return max(1 - x * x, 0.0) ** 3


def softened(delta, share, depth, soft, early):
    """Damage that takes `depth` off a large delta and less off a small one; all in um."""
    return delta - depth * share * (1 - math.exp(-(delta + early) / soft))


def rim(s, delta):
    """A rim raised by 3 um at |s| = 0.9 mm about a pit; um."""
    raised = 3.0 * (bump((s - 0.9) / 0.6) + bump((s + 0.9) / 0.6))
    return softened(delta, bump(s / 0.7), 3.5, 5.0, 3.5) + raised * math.exp(-(delta + 3.0) / 6.0)


# Smooth stand-ins for a half-space solution: half the range along s (mm), nodes along s, nodes along delta (um), law.
TABLES = {
    "mechanics-pit": (1.6, 41, [0.0, *(0.6 * 1.4**k for k in range(12))], lambda s, d: softened(d, bump(s / 1.6), 8.0, 12.0, 3.0)),
    "mechanics-shallow": (0.9, 37, [0.4 * k for k in range(14)], lambda s, d: softened(d, bump(s / 0.9), 2.5, 4.0, 1.0)),
    "mechanics-rim": (1.6, 65, [-3.0 + 0.05 * k * k for k in range(22)], rim),
}


def tables():
    for name, (half, nodes, deltas, law) in TABLES.items():
        lines = ["s_mm,delta_um,delta_eff_um"]
        for i in range(nodes):
            s = round(half * (2 * i / (nodes - 1) - 1), 6)
            lines += [f"{s:.6f},{d:.6f},{law(s, round(d, 6)):.9f}" for d in deltas]
        (XVAL / f"{name}.table.csv").write_text("\n".join(lines) + "\n")


def goldens(exe, names):
    table = XVAL / "tolerances.csv"
    rows = {}
    tables()
    if names and table.exists():
        for line in list(csv.reader(table.read_text().splitlines()))[1:]:
            rows.setdefault(line[0], []).append(line)
    for scenario in sorted(XVAL.glob("*.toml")):
        name = scenario.stem
        if names and name not in names:
            continue
        text = simulate(exe, scenario)
        scenario.with_suffix(".csv").write_text(text)
        base = columns(text)
        smooth = is_smooth(tomllib.loads(scenario.read_text()))
        rough = {"tolerance": 100 * TOLERANCE} if smooth else {"step": 2 * STEP}
        others = [columns(simulate(exe, scenario, **rough)), columns(simulate(exe, scenario, perturb=1e-15))]
        rows[name] = []
        for channel in base:
            if channel != "t":
                worst = [max(difference(base[channel], x[channel], base["t"], d) for x in others) for d in (0.0, WORST)]
                rows[name].append([name, channel, *(f"{w:.3e}" for w in worst)])
                print(f"{name:28}{channel:28}{worst[0]:10.2e}{worst[1]:10.2e}", flush=True)
    with table.open("w", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["scenario", "channel", "self_difference", "self_difference_without_worst_2_percent"])
        for name in sorted(rows):
            writer.writerows(rows[name])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run")
    run.add_argument("scenario")
    run.add_argument("out")
    run.add_argument("--step", type=float, default=STEP)
    run.add_argument("--tolerance", type=float)
    run.add_argument("--perturb", type=float, default=0.0)
    run.add_argument("--record", nargs="+")
    check = commands.add_parser("verify")
    check.add_argument("folder")
    check.add_argument("names", nargs="*")
    check.add_argument("--step", type=float, default=STEP)
    check.add_argument("--tolerance", type=float)
    flows = commands.add_parser("balance")
    flows.add_argument("scenario")
    commands.add_parser("facts")
    gold = commands.add_parser("goldens")
    gold.add_argument("names", nargs="*")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        exe = build(folder)
        if args.command == "run":
            text = simulate(exe, args.scenario, args.step, args.perturb, args.record, args.tolerance)
            pathlib.Path(args.out).write_text(text)
        elif args.command == "verify":
            verify(exe, args.folder, args.step, args.tolerance, args.names)
        elif args.command == "balance":
            print(simulate(exe, args.scenario, flag="--balance"), end="")
        elif args.command == "facts":
            return subprocess.run([str(exe), "--facts"], check=False).returncode
        else:
            goldens(exe, args.names)


if __name__ == "__main__":
    sys.exit(main())
