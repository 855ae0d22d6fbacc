"""Whether `brinell analyze --bearing unknown` finds the comb of a damaged race, on measured records.

    python3 validation/unknown/unknown.py RECORDS [BRINELL]

RECORDS is a folder with the files and a list records.csv as docs/src/measured.md describes it; a record whose id ends in `:other` is the sound bearing at
the other end of the machine of the record without that. Each is analysed twice, with its bearing and without one. Prints a Markdown table: of how many
records which comb is named, and whether it is BPFO, BPFI or 2 BSF of the machine's damaged bearing, to 0.5 % of the frequency found with it, or to 2 % of
pure rolling where nothing was found. Standard library only.
"""

import csv
import json
import shlex
import subprocess
import sys
from pathlib import Path

PARTS = {"OR": "outer race", "IR": "inner race", "B": "rolling element", "N": "healthy machine"}
# What says which bearing it is.
OF_BEARING = ["--bearing", "--rollers", "--pitch", "--diameter", "--contact-angle", "--bpfo", "--bpfi", "--bsf", "--ftf"]


def without_bearing(options):
    kept, k = [], 0
    while k < len(options):
        if options[k] in OF_BEARING:
            k += 2
        else:
            kept.append(options[k])
            k += 1
    return [*kept, "--bearing", "unknown"]


def analysed(brinell, path, options):
    call = [brinell, "analyze", str(path), *options, "--json", "-", "--quiet"]
    done = subprocess.run(call, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{shlex.join(call)}: {done.stderr}")
    return json.loads(done.stdout)


def name_of(comb, families, shaft):
    """The frequency of the bearing at which the comb lies, if any: that of `families` (of the analysis with the bearing)."""
    for family in families:
        if family["name"] not in ("BPFO", "BPFI", "2 BSF"):
            continue
        near = abs(comb / (family["order"] * shaft) - 1) <= 0.005
        if near or abs(comb / (family["expected_hz"] / family["shaft"] * shaft) - 1) <= 0.02:
            return family["name"]
    return None


def main():
    folder, brinell = Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "target/release/brinell"
    with open(folder / "records.csv", newline="", encoding="utf-8") as text:
        records = list(csv.DictReader(text))
    by_id = {record["id"]: record for record in records}
    rows = {}
    for record in records:
        options = shlex.split(record["options"])
        found = analysed(brinell, folder / record["file"], without_bearing(options))
        other = record["id"].endswith(":other")
        damaged = by_id[record["id"].removesuffix(":other")] if other else record
        of_damaged = analysed(brinell, folder / damaged["file"], shlex.split(damaged["options"]))
        for family in of_damaged["families"]:
            family["shaft"] = of_damaged["shaft"]["used_hz"]
        comb = found["elsewhere"]
        lies = name_of(comb["frequency_hz"], of_damaged["families"], found["shaft"]["used_hz"]) if comb else None
        # At the other end no bearing's damage is nearer than the one it is sought in.
        part = PARTS[damaged["damaged"]] + (", measured at the other end" if other else "")
        row = rows.setdefault(part, [0, 0, {}])
        row[0] += 1
        if comb:
            row[1] += 1
            row[2][lies or "none of them"] = row[2].get(lies or "none of them", 0) + 1
    print("| damaged | records | a comb is named | it is |")
    print("| --- | --- | --- | --- |")
    for part, (count, named, where) in sorted(rows.items()):
        words = ", ".join(f"{name} in {n}" for name, n in sorted(where.items()))
        print(f"| {part} | {count} | {named} | {words or '–'} |")


if __name__ == "__main__":
    main()
