"""What `brinell analyze` says of all damaged records of the CWRU bearing data at 12 kHz.

    python3 validation/benchmark/cwru.py FOLDER [BRINELL]

FOLDER has the data set's files under their own names (105.mat, 3001.mat and so on), from
https://engineering.case.edu/bearingdatacenter/download-data-file; the program gets the nominal speed and the bearing's name, nothing else.
Prints Markdown: right, wrong and no verdict by damaged part, by which loads had a part in setting the program's limits, and by Smith and
Randall's grade where it is at hand. Files that are missing are counted and left out. Standard library only. See README.md beside this file.
"""

import collections
import csv
import json
import subprocess
import sys
from pathlib import Path

# End, damaged part, diameter in thousandths of an inch (of the outer race with its place on the clock), and the file at each load from 0 to 3 hp.
FILES = """
drive IR 7 105 106 107 108
drive IR 14 169 170 171 172
drive IR 21 209 210 211 212
drive IR 28 3001 3002 3003 3004
drive B 7 118 119 120 121
drive B 14 185 186 187 188
drive B 21 222 223 224 225
drive B 28 3005 3006 3007 3008
drive OR 7@6 130 131 132 133
drive OR 7@3 144 145 146 147
drive OR 7@12 156 158 159 160
drive OR 14@6 197 198 199 200
drive OR 21@6 234 235 236 237
drive OR 21@3 246 247 248 249
drive OR 21@12 258 259 260 261
fan IR 7 278 279 280 281
fan IR 14 274 275 276 277
fan IR 21 270 271 272 273
fan B 7 282 283 284 285
fan B 14 286 287 288 289
fan B 21 290 291 292 293
fan OR 7@6 294 295 296 297
fan OR 7@3 298 299 300 301
fan OR 7@12 302 305 306 307
fan OR 14@6 313 - - -
fan OR 14@3 310 309 311 312
fan OR 21@6 315 - - -
fan OR 21@3 - 316 317 318
"""
SPEEDS = [1797, 1772, 1750, 1730]
BEARINGS = {"drive": ("DE", "6205-2RS"), "fan": ("FE", "6203-2RS")}
PARTS = {"IR": "inner_race", "OR": "outer_race", "B": "rolling_element"}
# The limits of `analyze` were set with records of the drive end at these loads in view, and with no damaged record of the fan end.
SEEN = {"drive": (0, 3), "fan": ()}
GRADES = Path(__file__).parent.parent / "published" / "cwru.csv"


def records():
    """End, part, load in hp and file number, of each record."""
    for line in FILES.split("\n"):
        if line:
            end, part, _, *files = line.split()
            yield from ((end, part, load, file) for load, file in enumerate(files) if file != "-")


def said(brinell, path, end, load):
    """How the program's first call is to be counted: the part, `None` of no verdict."""
    channel, bearing = BEARINGS[end]
    options = ["--channel", channel, "--rate", "12000", "--unit", "g", "--speed", str(SPEEDS[load]), "--bearing", bearing]
    done = subprocess.run([brinell, "analyze", path, *options, "--json", "-"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{path}: {done.stderr.strip()}")
    return next(iter(json.loads(done.stdout)["verdict"]["damage"]), None)


def main():
    folder, brinell = Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "brinell"
    grades = {row["cwru_file"]: row["grade"] for row in csv.DictReader(open(GRADES))}
    counts, missing = collections.defaultdict(collections.Counter), []
    for end, part, load, file in records():
        path = folder / f"{file}.mat"
        if not path.exists():
            missing.append(file)
            continue
        call = said(brinell, path, end, load)
        how = "none" if call is None else "right" if call == PARTS[part] else "wrong"
        seen = "in view" if load in SEEN[end] else "held out"
        groups = [f"{end} end", f"{end} end, {part}", f"{end} end, loads {seen} when limits were set"]
        if file in grades:
            groups.append(f"drive end, grade {grades[file]}")
        for group in groups:
            counts[group][how] += 1
    print("| records | number | right | wrong | no verdict |\n| --- | --- | --- | --- | --- |")
    for group, n in sorted(counts.items()):
        print(f"| {group} | {n.total()} | {n['right']} | {n['wrong']} | {n['none']} |")
    if missing:
        print(f"\n{len(missing)} of {len(missing) + sum(n.total() for g, n in counts.items() if g.count(' ') == 1)} files are not in {folder}: {', '.join(missing)}")


main()
