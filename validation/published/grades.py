"""What `brinell analyze` says of the records that a published benchmark graded.

    python3 validation/published/grades.py RECORDS BRINELL

RECORDS is the folder with records.csv and the signals. Prints the rows of a Markdown table, a row for each grade of Smith and Randall. Standard
library only. See README.md beside this file for where cwru.csv is from.
"""

import collections
import csv
import json
import shlex
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
PARTS = {"IR": "inner_race", "OR": "outer_race", "B": "rolling_element"}


def first(brinell, folder, record):
    """The part named first; `None` where no damage is called."""
    command = [brinell, "analyze", folder / record["file"], *shlex.split(record["options"]), "--json", "-"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return next(iter(json.loads(output)["verdict"]["damage"]), None)


def main():
    folder, brinell = Path(sys.argv[1]), sys.argv[2]
    records = {row["id"]: row for row in csv.DictReader(open(folder / "records.csv"))}
    counts = collections.defaultdict(collections.Counter)
    for row in csv.DictReader(open(HERE / "cwru.csv")):
        record = records[row["id"]]
        said, truth = first(brinell, folder, record), PARTS[record["damaged"]]
        for grade in (row["grade"], "all"):
            counts[grade]["records"] += 1
            counts[grade]["right" if said == truth else "wrong" if said else "not called"] += 1
            # The cage's frequency is a damaged element's too: `analyze` names the element there, and so it is counted of the other.
            counts[grade]["other right"] += row["other_program"].replace("FTF", "B") == record["damaged"]
    for grade, n in sorted(counts.items(), key=lambda item: ("Y1", "Y2", "P1", "P2", "N1", "N2", "all").index(item[0])):
        other = n["records"] - n["other right"]
        print(f"| {grade} | {n['records']} | {n['right']} / {n['wrong']} / {n['not called']} | {n['other right']} / {other} |")


main()
