"""Gives a brinell command inputs that were made to hurt it, and holds each answer against its limits.

    python3 validation/hostile/check.py target/release/brinell [WORDS OF A CASE ...]

An answer is an exit code and words on standard error, never a signal, within 200 MB of memory (a large photo 300) and 5 s of processor time. Standard library only.
A case is a function under `@case`: it makes its files in the folder it is given and returns the arguments of the command. See README.md.
"""

import os
import random
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

MEGABYTES = 200
# Of 64 million pixels the light is evened out, which needs the picture a second time: 4.2 bytes a pixel.
MORE_MEGABYTES = {"large_image": 300}
CPU_SECONDS = 5.0
# A command that hangs without computing is ended.
WALL_SECONDS = 60

CASES = []


def case(says, code=2):
    """Registers a case: `says` must be in what the command prints on standard error, and `code` be its exit code."""

    def register(make):
        CASES.append((make.__name__, make, says, code))
        return make

    return register


SCENARIO = """name = "hostile"

[bearing]
preset = "NN3007"

[operation]
speed_rpm = 3000
load_n = [0.0, -1000.0]
"""


def scenario(folder, more="", name="scenario.toml", text=SCENARIO):
    path = folder / name
    path.write_text(text + more)
    return str(path)


# --- Paths of keys: longer than any scenario's, they ended on the stack.
LONG = ".".join(["a"] * 60_000)
PARTS = "has 60000 parts; there are at most 32"


@case(PARTS)
def long_key_in_set(folder):
    return ["check", scenario(folder), "--set", LONG + "=1"]


@case(PARTS)
def long_key_in_a_run(folder):
    return ["run", scenario(folder), "-o", str(folder / "out"), "--set", LONG + "=1"]


@case(PARTS)
def long_key_in_vary(folder):
    return ["sweep", scenario(folder), "-o", str(folder / "out"), "--vary", LONG + "=1,2"]


@case(PARTS)
def long_key_in_variant(folder):
    return ["compare", scenario(folder), "-o", str(folder / "out"), "--variant", f"b: {LONG}=1"]


@case(PARTS)
def long_key_in_fit(folder):
    targets = ["--target", "outer_ax_rms=5~1"]
    return ["calibrate", scenario(folder), "-o", str(folder / "out"), "--fit", LONG + "=1:2", *targets]


@case(PARTS)
def long_key_in_a_preview(folder):
    return ["defect", "preview", scenario(folder, DEFECT), "--set", LONG + "=1", "-o", str(folder / "preview.html")]


@case("at most 32")
def long_key_in_a_plan(folder):
    scenario(folder)
    plan = folder / "plan.toml"
    plan.write_text(f'base = "scenario.toml"\nruns = 2\n\n[vary]\n"{LONG}" = 1\n')
    return ["dataset", str(plan), "-o", str(folder / "out")]


@case("more than 32 levels deep")
def tables_in_tables(folder):
    # As deep as TOML's parser lets them be: eighty parts of a key, in each of eighty tables.
    key = ".".join(["a"] * 79)
    return ["check", scenario(folder, f"{key} = {{ " * 79 + f"{key} = 1" + " }" * 79)]


@case("more than 32 levels deep")
def lists_in_lists_in_set(folder):
    return ["check", scenario(folder), "--set", "operation.load_n=" + "[" * 60 + "]" * 60]


@case("max recursion depth met")
def lists_in_lists(folder):
    return ["check", scenario(folder, "x = " + "[" * 100_000 + "]" * 100_000)]


# --- Work that grew with the square of the file.
DEFECT = """
[[defects]]
on = "outer-raceway"
depth_um = 10.0
shape = { rectangle = { length_mm = 1.0, width_mm = 1.0 } }
"""


@case("and 1998980 more like defects.", code=0)
def overlapping_defects(folder):
    return ["check", scenario(folder, DEFECT * 2000)]


@case("and 1980 more like defects.")
def wrong_defects(folder):
    return ["check", scenario(folder, DEFECT.replace("10.0", "-1.0") * 2000)]


@case("at most 5000 of them")
def six_thousand_defects(folder):
    return ["check", scenario(folder, DEFECT * 6000)]


@case("tables are more than the 50000 of a document")
def defects_without_end(folder):
    one = '[[defects]]\non="roller"\nrow=1\ndepth_um=1\nshape={circle={diameter_mm=1}}\n'
    return ["check", scenario(folder, one * 40_000)]


@case("and 99980 more like ")
def unknown_keys(folder):
    return ["check", scenario(folder, "".join(f"k{i} = 1\n" for i in range(100_000)))]


@case("and 99980 more like ")
def unknown_keys_on_one_line(folder):
    keys = ", ".join(f"k{i} = 1" for i in range(100_000))
    return ["check", scenario(folder, text=f"cage = {{ {keys} }}\n" + SCENARIO)]


@case("and 7980 more like ")
def unknown_tables(folder):
    return ["check", scenario(folder, "".join(f"[t{i}]\nx = 1\n" for i in range(8000)))]


@case("100000 keys vary")
def unknown_keys_in_a_plan(folder):
    scenario(folder)
    plan = folder / "plan.toml"
    plan.write_text('base = "scenario.toml"\nruns = 2\n\n[vary]\n' + "".join(f"k{i} = 1\n" for i in range(100_000)))
    return ["dataset", str(plan), "-o", str(folder / "out")]


@case("not valid TOML")
def broken_lines(folder):
    return ["check", scenario(folder, "=\n" * 400_000)]


@case("values are more than the 500000 of a document")
def a_list_of_two_million(folder):
    return ["check", scenario(folder, f"x = [{'1,' * 2_000_000}]")]


@case("larger than 4 MiB")
def long_scenario(folder):
    return ["check", scenario(folder, f"x = [{'1,' * 4_000_000}]")]


@case("larger than 4 MiB")
def long_plan(folder):
    plan = folder / "plan.toml"
    plan.write_text("#" * (5 << 20))
    return ["dataset", str(plan), "-o", str(folder / "out")]


# --- Files of damage.
def damage(folder, shape):
    return scenario(folder, f'\n[[defects]]\non = "outer-raceway"\ndepth_um = 10.0\nshape = {{ {shape} }}\n')


def drawing(folder, body, size=8):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}mm" height="{size}mm" viewBox="0 0 {size} {size}">{body}</svg>'
    (folder / "spall.svg").write_text(text)
    return damage(folder, 'svg = { file = "spall.svg" }')


def tangle(count):
    points = random.Random(1)
    return [(points.uniform(0, 8), points.uniform(0, 8)) for _ in range(count)]


@case("cross in more than 10000 places")
def tangled_drawing(folder):
    path = " ".join(f"{x:.3f} {y:.3f}" for x, y in tangle(200_000))
    return ["check", drawing(folder, f'<path d="M {path} Z"/>')]


@case("cross in more than 10000 places")
def tangled_shapes(folder):
    shapes = "".join(f'<rect x="{x:.2f}" y="{y:.2f}" width="4" height="4"/>' for x, y in tangle(50_000))
    return ["check", drawing(folder, shapes)]


@case("cross in more than 10000 places")
def tangled_outline(folder):
    points = ", ".join(f"[{x - 4:.3f}, {y - 4:.3f}]" for x, y in tangle(100_000))
    return ["check", damage(folder, f"outline = {{ points_mm = [{points}] }}")]


@case("larger than 4 MiB")
def long_drawing(folder):
    return ["check", drawing(folder, "<!--" + "x" * (5 << 20) + "-->")]


def png(folder, width, height):
    """A black image, one bit a pixel, of any size."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    pack = zlib.compressobj(9)
    row, data = bytes(1 + (width + 7) // 8), b""
    block = 1 << 16
    for start in range(0, height, block):
        data += pack.compress(row * min(block, height - start))
    data += pack.flush()
    head = struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0)
    parts = chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    (folder / "spall.png").write_bytes(b"\x89PNG\r\n\x1a\n" + parts)
    return damage(folder, 'image = { file = "spall.png", mm_per_pixel = 0.01 }')


@case("1 x 67108864 pixels")
def one_pixel_wide(folder):
    return ["check", png(folder, 1, 1 << 26)]


@case("67108864 x 1 pixels")
def one_pixel_high(folder):
    return ["check", png(folder, 1 << 26, 1)]


@case("2 x 33554432 pixels")
def two_pixels_wide(folder):
    return ["check", png(folder, 2, 1 << 25)]


# --- Large images that are read: the blur made a second picture.


@case("the image has one brightness only")
def large_image(folder):
    return ["check", png(folder, 8000, 8000)]


# --- Loads that steel flows under: such a run hardly moved.


@case("times the static load rating C0")
def load_beyond_steel(folder):
    return ["run", scenario(folder, ""), "-o", str(folder / "o"), "--set", "operation.load_n=[1e15, 0]"]


# --- Speeds beyond any bearing: their runs took steps of 1e-11 s.
@case("no bearing allows more than")
def speed_of_light(folder):
    return ["check", scenario(folder, text=SCENARIO.replace("3000", "2147483648"))]


@case("no bearing allows more than")
def speed_of_light_in_a_profile(folder):
    text = SCENARIO.replace("3000", "[[0.0, 1000.0], [1.0, -1e300]]")
    return ["run", scenario(folder, text=text), "-o", str(folder / "out")]


# --- Further cases: add them here.


def run(brinell, make, says, code):
    """What is wrong with an answer, in words, and what it took."""
    with tempfile.TemporaryDirectory(prefix="hostile-") as name:
        folder = Path(name)
        arguments = make(folder)
        with open(folder / "stderr", "wb+") as stderr:
            child = subprocess.Popen([brinell, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=stderr)
            # What is largest before the command takes the child over counts as well: the memory of this script, which makes files piece by piece.
            # `wait4` tells what this child alone took; Popen knows no such thing.
            late = subprocess.Popen(["sh", "-c", f"sleep {WALL_SECONDS}; kill -9 {child.pid}"], stdout=subprocess.DEVNULL, start_new_session=True)
            _, status, usage = os.wait4(child.pid, 0)
            late.kill()
            late.wait()
            child.returncode = os.waitstatus_to_exitcode(status)
            stderr.seek(0)
            text = stderr.read().decode(errors="replace")
    # Linux counts in KiB, macOS in bytes.
    megabytes = usage.ru_maxrss / (1e6 if sys.platform == "darwin" else 1e6 / 1024)
    seconds = usage.ru_utime + usage.ru_stime
    wrong = []
    if child.returncode < 0:
        wrong.append(f"ended by signal {-child.returncode}")
    elif child.returncode != code:
        wrong.append(f"exit code {child.returncode}, not {code}")
    if says not in text:
        wrong.append(f"does not say {says!r}: {text[:500]!r}")
    most = MORE_MEGABYTES.get(make.__name__, MEGABYTES)
    if megabytes > most:
        wrong.append(f"more than {most} MB")
    if seconds > CPU_SECONDS:
        wrong.append(f"more than {CPU_SECONDS} s")
    return wrong, seconds, megabytes


def main():
    brinell, wanted = sys.argv[1], sys.argv[2:]
    cases = [c for c in CASES if not wanted or any(word in c[0] for word in wanted)]
    failed = 0
    for name, make, says, code in cases:
        wrong, seconds, megabytes = run(brinell, make, says, code)
        failed += bool(wrong)
        print(f"{'FAILED' if wrong else 'ok':6} {name:30} {seconds:5.2f} s {megabytes:5.0f} MB  {'; '.join(wrong)}", flush=True)
    print(f"{len(cases) - failed} of {len(cases)} hostile inputs answered")
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
