"""Holds the line that score.py prints against bounds: python check_score.py FILE

Of 38 damaged bearings, 30 sound ones (four of healthy machines, 26 at the other end of a damaged motor). The aim is 33 right; 30 is what it has.
"""

import re
import sys

line = open(sys.argv[1]).read().strip().splitlines()[-1]
counts = {}
for part in line.split("; "):
    group, told = part.split(": ", 1)
    counts[group] = {how: int(n) for how, n in re.findall(r"([a-z ]+?) (\d+)(?:, |$)", told)}
alarms = sum(counts[group].get("called damaged", 0) for group in ("healthy", "other-end"))
right, wrong = counts["fault"].get("right", 0), counts["fault"].get("wrong", 0)
assert right >= 30, f"{right} of 38 right"
assert wrong <= 1, f"{wrong} wrong"
assert alarms <= 3, f"{alarms} sound bearings called damaged"
print(f"{right} of 38 right, {wrong} wrong, {alarms} of 30 sound ones called damaged")
