"""What each part of the verdict of `brinell analyze` adds, counted on measured records.

    python3 validation/ablation/ablate.py SCORE.PY [--harder] [--target FOLDER] [WORDS OF A VARIANT ...]
    python3 validation/ablation/ablate.py --tests [--target FOLDER] [WORDS OF A VARIANT ...]
    python3 validation/ablation/ablate.py --check

Copies the tracked files to a temporary folder, takes one part out of crates/brinell-signal/src/analysis/ for each variant, builds the command there and
runs SCORE.PY on it; with --harder ../robustness/robustness.py too, on the records beside SCORE.PY. Prints a row of a Markdown table a variant. With --tests
it runs the tests of the analysis on synthetic rigs, known evidence and simulated runs instead, and names those that fail.
Standard library only, but for --harder; see README.md.
"""

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ANALYSIS = "crates/brinell-signal/src/analysis/"

# In words, and the changes: file, text that is there once, text in its place.
VARIANTS = [("as it is", [])]


def variant(words, *changes):
    """Registers a variant."""
    VARIANTS.append((words, changes))


def constant(words, file, name, was, values):
    """Registers a variant for each other value of a constant."""
    for value in values:
        variant(f"{words} {value}", (file, f"const {name}: f64 = {was};", f"const {name}: f64 = {value};"))


def together(words, *names):
    """Registers a variant of all changes of those named."""
    changes = dict(VARIANTS)
    variant(words, *(change for name in names for change in changes[name]))


variant("plain sum over harmonics", ("family.rs", "sum += least;", "sum += ratio.max(f64::MIN_POSITIVE).ln();"))
variant("no modulation asked of a high score", ("family.rs", "const FAINT: f64 = 0.14;", "const FAINT: f64 = 0.0;"))
variant("no score limit: 14 % suffices beyond noise", ("family.rs", "limit: high(rise).max(noise),", "limit: noise,"))
variant("a high score is no way to damage", ("family.rs", "        high || deep\n", "        deep\n"))
variant("deep modulation is no way to damage", ("family.rs", "        high || deep\n", "        high\n"))
variant("a comb elsewhere not sought", ("verdict.rs", "if is_open { None } else { self.search().comb(lead.map(|k| &all[k])) };", "None;"))
variant("sidebands of another shaft not sought", ("verdict.rs", "of_other_shaft(&self.together, &all[lead], self.shaft, &self.options);", "None;"))
variant("outer race and element not exchanged by slip", ("verdict.rs", "self.others_slip(&all[lead]);", "None;"))
variant("damage beyond the tolerance passed over", ("verdict.rs", "f.finding == Finding::Silent && f.is_damage_beyond()", "f.is_damage_beyond() && false"))
variant("speed as given not tried", ("hypotheses.rs", "if !best.shaft_lines.is_empty() && !best.record.is_damage()", "if false"))
variant("lower parts of the range not tried", ("hypotheses.rs", "if options.band.is_none() && !options.exact && !best.record.is_damage()", "if false"))
variant("no least score", ("family.rs", "const LEAST_SCORE: f64 = 5.0;", "const LEAST_SCORE: f64 = 0.0;"))
variant("sidebands not counted in modulation", ("family.rs", "depth += line.depth.min(carrier.depth);", ""))
variant("sidebands not capped by their carrier", ("family.rs", "depth += line.depth.min(carrier.depth);", "depth += line.depth;"))
variant("one broad band", ("together.rs", "let width = top.max(whole / BANDS).min(whole);", "let width = whole;"))
variant("shaft and mains not hidden", ("together.rs", "together.hide_known(shaft, options);", ""))
variant("shaft's comb not placed anew", ("together.rs", "let of_shaft = (shaft.tolerance > 0.0)", "let of_shaft = false"))
variant(
    "speed as given",
    ("known_lines.rs", "Ok(told.is_own().then(", "Ok((told.is_own() && false).then("),
)
variant(
    "no speed beyond the tolerance",
    ("known_lines.rs", "if is_told && ", "if is_told && false && "),
)
variant("an element needs no sidebands", ("family.rs", "        !self.lacks_sidebands()\n            && detected", "        detected"))
variant("an element needs no lead", ("verdict.rs", "const LEAD: f64 = 2.0;", "const LEAD: f64 = 0.0;"))
variant("an element may run ahead", ("family.rs", "Component::Element => (tolerance, AHEAD.min(tolerance)),", "Component::Element => (tolerance, tolerance),"))
variant("the cage may run ahead", ("family.rs", "Component::Cage => (slips, AHEAD.min(tolerance)),", "Component::Cage => (slips, tolerance),"))
variant("no least number of lines", ("family.rs", "const FEWEST: (usize, usize) = (3, 2);", "const FEWEST: (usize, usize) = (0, 0);"))
variant("skirts of what lies beyond the tolerance not refused", ("family.rs", "|| outside && self::score(together, next) > score,", "&& false,"))
variant(
    "cepstral pre-whitening",
    ("../transformed.rs", "*bin += Complex::new(part(), part());", "*bin += Complex::new(part(), part()); *bin /= bin.norm().max(1e-300);"),
)
for turns in (60, 30):
    variant(
        f"segments of {turns} revolutions",
        ("together.rs", "const REVOLUTIONS: f64 = 120.0;", f"const REVOLUTIONS: f64 = {turns}.0;"),
    )
variant("slip beyond the tolerance is no damage", ("verdict.rs", "elsewhere.and_then(|comb| self.by_slip(&comb, &mut all))", "None"))
variant("a speed by two lines of ten", ("known_lines.rs", "let told = lines.dense(lines.chosen_comb());", "let told = lines.chosen_comb();"))
variant("a family needs neither first nor second harmonic", ("family.rs", "const FIRST: usize = 2;", "const FIRST: usize = 5;"))
variant("damage at the speed given not said", ("hypotheses.rs", "self.at_given = as_given.lead().cloned();", ""))
variant("a slower comb not sought", ("elsewhere.rs", "if let Some(slower) = lead.and_then(|lead| self.slower(lead)) {", "if let Some(slower) = lead.and_then(|lead| self.slower(lead)).filter(|_| false) {"))
variant("another slip is no reason", ("verdict.rs", "        one_slip(&mut all, self.shaft, self.options.tolerance);\n", ""))
constant("score limit", "family.rs", "SCORE", "14.5", (12.0, 13.0, 16.0))
constant("bins hidden beside a line", "together.rs", "ASIDE", "2.0", (3.0,))
constant("deep from", "family.rs", "DEEP", "0.25", (0.2, 0.3))
constant("faint below", "family.rs", "FAINT", "0.14", (0.1, 0.18))
WITHOUT_EFFECT = [
    "no modulation asked of a high score",
    "sidebands not counted in modulation",
    "an element needs no sidebands",
    "an element may run ahead",
    "no least number of lines",
    "skirts of what lies beyond the tolerance not refused",
]
together("six that change nothing by themselves, at once", *WITHOUT_EFFECT)
together("the six, and an element needs no lead", *WITHOUT_EFFECT, "an element needs no lead")


def apply(changes, folder):
    """Makes the changes in the copy and gives the texts they replaced, by path."""
    before = {}
    for file, old, new in changes:
        path = folder / ANALYSIS / file
        text = path.read_text()
        if text.count(old) != 1:
            raise SystemExit(f"{file} has {text.count(old)} times, expected once: {old}")
        before.setdefault(path, text)
        path.write_text(text.replace(old, new))
    return before


def restore(before):
    for path, text in before.items():
        path.write_text(text)


def copy(folder):
    """The tracked files, as they are in the working tree."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    for name in filter(None, names.split("\0")):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / name)


def build(folder, target):
    """The command. Results do not depend on how it is cut for the compiler or, but for rounding, on how far what does not analyse is optimised."""
    env = os.environ | {"CARGO_TARGET_DIR": str(target), "CARGO_INCREMENTAL": "1"}
    command = ["cargo", "build", "--release", "--locked", "--quiet", "-p", "brinell-cli"]
    for crate, level in {"brinell-signal": 3, "brinell": 0, "brinell-report": 0, "brinell-damage": 0, "brinell-study": 0}.items():
        for setting in ("codegen-units=256", f"opt-level={level}"):
            command += ["--config", f"profile.release.package.{crate}.{setting}"]
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True)
    # Otherwise it warns of what a variant leaves unused.
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return target / "release" / "brinell"


def failing(folder, target):
    """Names of the tests that fail: on rigs and known evidence, then on simulated runs."""
    env = os.environ | {"CARGO_TARGET_DIR": str(target), "CARGO_INCREMENTAL": "1"}
    failed = []
    for package in (["brinell-signal"], ["brinell", "--test", "all", "--", "signal_on_runs"]):
        command = ["cargo", "test", "--locked", "--no-fail-fast", "-p", *package]
        done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True)
        if "test result:" not in done.stdout:
            raise SystemExit(done.stderr)
        failed += re.findall(r"^test (?:\w+::)*(\w+) \.\.\. FAILED", done.stdout, re.MULTILINE)
    return failed


def score(script, binary):
    """Counts by group, as the script's last line has them."""
    done = subprocess.run([sys.executable, script, binary], check=True, capture_output=True, text=True)
    groups = {}
    for part in done.stdout.strip().splitlines()[-1].split("; "):
        group, counts = part.split(": ", 1)
        groups[group] = {how: int(n) for how, n in re.findall(r"([a-z ]+?) (\d+)(?:, |$)", counts)}
    left = sum(counts.get("not analysed", 0) for counts in groups.values())
    if left:
        raise SystemExit(f"{left} records were not analysed:\n{done.stdout}")
    return groups


def cells(groups):
    """Of damaged bearings right, second, wrong and missed; of sound ones how many were called damaged."""
    found = lambda group: " / ".join(str(groups[group].get(how, 0)) for how in ("right", "second", "wrong", "missed"))
    alarms = lambda group: str(groups[group].get("called damaged", 0))
    return [found("fault"), alarms("healthy"), alarms("other-end"), found("uestc"), alarms("uestc-healthy")]


HARDER = {
    "cut": "cut to 0.6 to 3 s", "speed given": "speed 1 to 10 % off", "far": "speed 17 to 50 % off", "sampled": "sampled 2 to 8 times as fast",
    "asked": "other bearings",
}


def harder(records, binary):
    """Sums over the rows of robustness.py: right / wrong / not called; called of sound ones."""
    script = ROOT / "validation/robustness/robustness.py"
    done = subprocess.run([sys.executable, script, records, binary, "cut,speed,far,rate,bearing"], check=True, capture_output=True, text=True)
    sums = {start: [0] * 4 for start in HARDER}
    for line in done.stdout.splitlines()[2:]:
        way, damaged, sound, _ = (cell.strip() for cell in line.strip("|\n ").split("|"))
        counts = [int(n) for n in damaged.split(" / ")] if "/" in damaged else [0, 0, 0]
        counts.append(int(sound.split(" of ")[0]) if "of" in sound else 0)
        start = next((start for start in HARDER if way.startswith(start)), None)
        if start == "speed given" and abs(float(way.split()[2])) > 10.0:
            start = "far"
        if start is None:
            continue
        sums[start] = [a + b for a, b in zip(sums[start], counts)]
    cell = lambda start, n: str(n[3]) if start == "asked" else f"{n[0]} / {n[1]} / {n[2]}; {n[3]}"
    return [cell(start, n) for start, n in sums.items()]


def main():
    parser = argparse.ArgumentParser(description="What each part of the verdict adds, counted on measured records.")
    parser.add_argument("score", type=Path, nargs="?", help="score.py beside its records")
    parser.add_argument("--check", action="store_true", help="only see that every variant still applies")
    parser.add_argument("--tests", action="store_true", help="name the tests that fail instead")
    parser.add_argument("--harder", action="store_true", help="also count the records made harder, by robustness.py")
    parser.add_argument("--target", type=Path, help="folder for what is built, kept [default: a temporary one]")
    parser.add_argument("words", nargs="*", help="only the variants that have one of these in their name")
    args = parser.parse_intermixed_args()
    if args.tests and args.score is not None:
        args.words.insert(0, str(args.score))
    elif not args.check and args.score is None:
        parser.error("SCORE.PY is missing")
    chosen = [v for v in VARIANTS if not args.words or any(word in v[0] for word in args.words)]
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "brinell"
        copy(folder)
        # All of them, before anything is built.
        for _, changes in VARIANTS:
            restore(apply(changes, folder))
        if args.check:
            print(f"{len(VARIANTS)} variants apply")
            return
        built = set()
        target = (args.target or Path(temporary) / "target").resolve()
        if args.tests:
            print("| | tests that fail |\n| --- | --- |", flush=True)
            for words, changes in chosen:
                before = apply(changes, folder)
                print(f"| {words} | {', '.join(f'`{name}`' for name in failing(folder, target)) or 'none'} |", flush=True)
                restore(before)
            return
        heads = ["", "right / second / wrong / missed", "healthy called", "other end called", "speed off", "its healthy called"]
        heads += [f"{words}: right / wrong / not called; sound called" for words in HARDER.values()] if args.harder else []
        print("| " + " | ".join(heads) + " |")
        print("| " + " | ".join("---" for _ in heads) + " |", flush=True)
        for words, changes in chosen:
            before = apply(changes, folder)
            binary = build(folder, target)
            digest = hashlib.sha256(binary.read_bytes()).digest()
            if digest in built:
                raise SystemExit(f"{words}: the same program as an earlier variant")
            built.add(digest)
            row = cells(score(args.score, binary))
            row += harder(args.score.parent, binary) if args.harder else []
            print("| " + " | ".join([words, *row]) + " |", flush=True)
            restore(before)


main()
