"""What in the simulated set a classifier of measured records needs: one part at a time is taken out.

    python3 validation/sim_to_real/ablation.py RECORDS FOLDER [SEEDS]

RECORDS is a folder with records.csv (docs/src/measured.md says which records), FOLDER takes four data sets; what is there is read. FOLDER/all is the notebook's (BRINELL_BALL_DATA). Prints a Markdown
table: balanced accuracy over CWRU's 6205 drive-end records of healthy, outer and inner, as the median, least and highest over SEEDS (3) draws of the machines around
the bearing; how many of each class are right at the first; how many sound bearings at the motor's other end are called healthy; and balanced accuracy over runs left out of
the complete simulated set. Needs the brinell package, polars, pandas, SciPy and scikit-learn.
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from sklearn.metrics import balanced_accuracy_score

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples/notebooks"))

import brinell  # noqa: E402
import sim_to_real  # noqa: E402

# Lines that a plan loses, and what stands in their place.
PLANS = {
    "all": None,
    "paths": (r"^sensor\.path = \[.*?^\]\n", ""),
    "noise": (r"^sensor\.noise_[^\n]*\n", ""),
    "masses": (r"^bearing\.inner_ring_mass_kg[^\n]*\n[^\n]*\nhousing\.mass_kg[^\n]*\n", "housing.mass_kg = 0\n"),
}


def data_set(folder, name):
    whole = ROOT / "examples/plans/ball-6205.toml"
    if name == "all":
        return brinell.Plan(whole).run(folder / name)
    lines, instead = PLANS[name]
    text, found = re.subn(lines, instead, whole.read_text(), flags=re.M | re.S)
    assert found, name
    plan = Path(tempfile.mkdtemp()) / "plan.toml"
    plan.write_text(text.replace('base = "..', f'base = "{(ROOT / "examples").as_posix()}'))
    return brinell.Plan(plan).run(folder / name)


def third(rows, by):
    """The runs of each class with the least third of `by`."""
    runs = rows.drop_duplicates("run").assign(by=by(rows.drop_duplicates("run")))
    return rows[rows["run"].isin(runs[runs.groupby("class")["by"].rank(pct=True) <= 1 / 3]["run"])]


def variants(sets, seed):
    """Name and training rows."""
    everything = sim_to_real.simulated(sets["all"], seed=seed)
    everything = everything[everything["class"] != "ball"]
    pits, spalls = (everything["kind"].str.endswith(kind) for kind in ("pit", "spall"))
    yield "everything", everything, {}
    yield "no random spalls: pits alone", everything[~spalls], {}
    yield "no pits: random spalls alone", everything[~pits], {}
    yield "a third of the runs", third(everything, lambda r: np.random.default_rng(seed).uniform(size=len(r))), {}
    yield "no slip: the third that slips least", third(everything, lambda r: r["cage_slip"].abs()), {}
    yield "damage that no loaded ball enters trained on as well", everything, {"least_force_n": -1.0}
    for name, source, options in (
        ("no transfer paths", "paths", {}),
        ("no noise, of sensor or machine", "noise", {"noise": False}),
        ("no machinery lines", "all", {"lines": False}),
        ("no noise and no machinery lines", "noise", {"noise": False, "lines": False}),
        ("rings without rotor and housing", "masses", {}),
    ):
        rows = sim_to_real.simulated(sets[source], seed=seed, **options)
        rows = rows[rows["class"] != "ball"].reset_index(drop=True)
        yield name, rows, {}


def left_out(rows, complete, options):
    """Trained on `rows` without a fifth of the runs, tested on these in `complete`."""
    truth, guessed = [], []
    for k in range(5):
        tested = complete[complete["run"] % 5 == k]
        truth.extend(tested["class"])
        guessed.extend(sim_to_real.train(rows[rows["run"] % 5 != k], **options).predict(tested[list(sim_to_real.PARTS)]))
    return balanced_accuracy_score(truth, guessed)


def main():
    records, folder, seeds = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 3
    measured = sim_to_real.measured(records)
    sound = measured[measured["set"] == "other-end"]
    measured = measured[((measured["set"] == "cwru-DE12") & (measured["class"] != "ball")) | (measured["id"] == "1797_Normal:DE")]
    sets = {name: data_set(folder, name) for name in PLANS}
    found = {}
    for seed in range(1, seeds + 1):
        for name, rows, options in variants(sets, seed):
            model = sim_to_real.train(rows, **options)
            score = sim_to_real.score(sim_to_real.verdicts(model, measured))
            score["sound"] = (sim_to_real.verdicts(model, sound)["named"] == "healthy").sum()
            if name == "everything":
                complete = rows[(rows["class"] == "healthy") | (rows["force_n"] > 5.0)]
            score["simulated"] = left_out(rows, complete, options)
            found.setdefault(name, []).append(score)
            print(seed, name, score["balanced accuracy"], file=sys.stderr, flush=True)
    print("| trained on | measured: balanced accuracy | healthy, outer, inner right | sound, of 26 | simulated runs left out |\n| --- | --- | --- | --- | --- |")
    for name, scores in found.items():
        values = [score["balanced accuracy"] for score in scores]
        right = ", ".join(scores[0][c] for c in ("healthy", "outer", "inner"))
        sound_right = [score["sound"] for score in scores]
        simulated = np.median([score["simulated"] for score in scores])
        print(f"| {name} | {np.median(values):.2f} ({min(values):.2f} to {max(values):.2f}) | {right} | {min(sound_right)} to {max(sound_right)} | {simulated:.2f} |")


main()
