"""What `brinell analyze --size` says of measured records whose damage has a stated length.

    python3 validation/size/measured.py BRINELL LIST FOLDER
    python3 validation/size/measured.py BRINELL --unsw FILE.parquet -- --rollers 9 --pitch 38.5 --diameter 7.94

LIST is a CSV of file (in FOLDER), options (of `brinell analyze`) and length_mm; `cwru.csv` beside this script lists records of the Case Western Reserve University Bearing Data Center,
whose pits have their diameter stated. The second form reads a file of the University of New South Wales' run-to-failure tests as published at huggingface.co/datasets/alidi/bearing-run2failure-unsw
(columns signal, sampling_frequency in Hz, speed in Hz, defect_size in mm), whose spalls grew by themselves and were measured between runs; it was not at hand when this was written, and the bearing's
numbers are for the reader to take from its publication. Prints a line for each record and a summary. The second form needs pandas and NumPy.
"""

import csv
import json
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path


def size(brinell, file, options):
    out = subprocess.run([brinell, "analyze", str(file), *options, "--size", "--json", "-"], capture_output=True, text=True)
    if out.returncode:
        return None, out.stderr.strip().splitlines()[0]
    told = json.loads(out.stdout)["size"]
    return told["length_mm"], told.get("reason")


def listed(brinell, table, folder):
    with open(table, newline="") as file:
        for row in csv.DictReader(file):
            yield row["file"], float(row["length_mm"]), *size(brinell, Path(folder) / row["file"], shlex.split(row["options"]))


def unsw(brinell, file, bearing):
    import numpy
    import pandas

    with tempfile.TemporaryDirectory() as folder:
        for k, row in pandas.read_parquet(file).iterrows():
            record = Path(folder) / "record.npz"
            numpy.savez(record, x=numpy.asarray(row.signal, dtype=float))
            options = ["--unit", "g", "--rate", str(row.sampling_frequency), "--speed", f"{60 * row.speed}", *bearing]
            yield f"{Path(file).name} {k}", float(row.defect_size), *size(brinell, record, options)


def main():
    brinell, *rest = sys.argv[1:]
    if not rest or (rest[0] == "--unsw" and "--" not in rest) or (rest[0] != "--unsw" and len(rest) != 2):
        sys.exit(__doc__)
    all_of = unsw(brinell, rest[1], rest[rest.index("--") + 1 :]) if rest[0] == "--unsw" else listed(brinell, *rest)
    count = told = held = 0
    for name, true, length, reason in all_of:
        count += 1
        if length is None:
            print(f"{name}: {true:.2f} mm stated; not told: {reason}")
            continue
        told += 1
        held += length["low"] <= true <= length["high"]
        print(f"{name}: {true:.2f} mm stated; {length['value']:.2f} mm, {length['low']:.2f} to {length['high']:.2f} mm")
    print(f"{count} records, {told} told, {held} of these intervals hold the stated length")


if __name__ == "__main__":
    main()
