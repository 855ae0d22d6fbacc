//! The keys of histories: `machines`, `snapshots` and `[history]`.

use crate::design::history::{Edge, History, Law, Varied};
use crate::design::template::Template;
use brinell::document::reading::{Keys, Spec, key, stated};

/// Runs of a plan at most: what each of them draws is kept in memory.
pub(super) const MOST_RUNS: f64 = 1e6;

/// Longest life, h: a thousand years.
const LONGEST_H: f64 = 1e7;

/// Where `[history]` has a meaning.
const CASE: &str = "`machines` is given";

/// What is read of a plan's histories.
#[derive(Default)]
pub(super) struct HistoryKeys {
    machines: Option<usize>,
    snapshots: usize,
}

impl HistoryKeys {
    /// How many runs there are: that number, or machines with their snapshots.
    pub(super) fn of_all(&mut self, k: &mut Keys, runs: &mut usize) {
        k.optional(
            key("machines", "how many machines, each with a history of snapshots: in place of runs")
                .from(1.0)
                .to(MOST_RUNS),
            &mut self.machines,
        );
        let has = self.machines.is_some();
        k.only_where(key("runs", "how many runs").from(1.0).to(MOST_RUNS), !has, "`machines` is not given", runs);
        let spec = key(
            "snapshots",
            "runs of each machine at most: from new on one every history.every_h, and one at its failure",
        );
        k.only_where(spec.from(2.0).to(MOST_RUNS), has, CASE, &mut self.snapshots);
    }

    /// `[history]`.
    pub(super) fn section(&self, k: &mut Keys) -> Option<History> {
        let has = self.machines.is_some();
        let blank = || Varied::Fixed(f64::NAN);
        let mut h = History {
            machines: self.machines.unwrap_or(1),
            snapshots: self.snapshots.max(2),
            every_h: blank(),
            law: Law::default(),
            steepness: blank(),
            begins_mm: blank(),
            fails_mm: blank(),
            life_h: blank(),
            begins_at: blank(),
            observed: blank(),
            scatter: 0.0,
            edge: Edge::default(),
            depth_exponent: 1.0,
            widest_mm: None,
            snapshot: Template::default(),
        };
        k.section(key("history", "how damage of each machine begins and grows until it fails"), |k| {
            keys(k, &mut h, has)
        });
        has.then_some(h)
    }
}

fn keys(k: &mut Keys, h: &mut History, has: bool) {
    let case = (has, CASE);
    k.only_where(
        key("every_h", "running time between snapshots, which tells nothing of the life").above(0.0).to(LONGEST_H),
        has,
        CASE,
        &mut h.every_h,
    );
    k.only_where(key("law", "law of growth of the length, an assumption"), has, CASE, &mut h.law);
    let is_power = h.law == Law::Power;
    let (mut exponent, mut rate) = (h.steepness.clone(), h.steepness.clone());
    k.only_where(
        key("exponent", "of the time since damage began").above(0.0).to(100.0),
        has && is_power,
        if has { "`law` is \"power\"" } else { CASE },
        &mut exponent,
    );
    k.only_where(
        key("rate", "of the exponential or logistic function, over the time from the beginning of damage to failure")
            .above(0.0)
            .to(100.0),
        has && !is_power,
        if has { "`law` is \"exponential\" or \"logistic\"" } else { CASE },
        &mut rate,
    );
    h.steepness = if is_power { exponent } else { rate };
    let length = |name: &'static str, doc| -> Spec { key(name, doc).above(0.0) };
    k.only_where(
        length("begins_mm", "length along the rolling direction at which damage begins"),
        has,
        CASE,
        &mut h.begins_mm,
    );
    k.only_where(length("fails_mm", "length at which the machine counts as failed"), has, CASE, &mut h.fails_mm);
    k.only_where(key("life_h", "running time until then").above(0.0).to(LONGEST_H), has, CASE, &mut h.life_h);
    k.only_where(
        key("begins_at", "share of the life at which damage begins; the machine is healthy before").from(0.0).to(1.0),
        has,
        CASE,
        &mut h.begins_at,
    );
    k.key_where(
        key(
            "observed",
            "share of the life at which the machine is seen for the last time; below 1 its failure is not seen",
        )
        .above(0.0)
        .to(1.0),
        case,
        stated(Varied::Fixed(1.0), "until it fails"),
        &mut h.observed,
    );
    k.key_where(
        key("scatter", "standard deviation of the logarithm of each of 64 increments of the length").from(0.0).to(5.0),
        case,
        stated(0.0, "the law alone"),
        &mut h.scatter,
    );
    k.key_where(
        key("edge", "which edge moves as damage grows"),
        case,
        stated(Edge::Trailing, "rolling elements land there"),
        &mut h.edge,
    );
    k.key_where(
        key("depth_exponent", "power of the length that the depth follows, up to that of the class at failure")
            .from(0.0)
            .to(10.0),
        case,
        stated(1.0, "in proportion"),
        &mut h.depth_exponent,
    );
    k.optional(
        key("widest_mm", "most width of damage, such as that of the running track; up to it the width grows in proportion to the length")
            .above(0.0),
        &mut h.widest_mm,
    );
    k.key_where(
        key("snapshot", "keys of the scenario that are drawn anew at each snapshot: speed, load"),
        case,
        stated(Template::default(), "every snapshot runs alike"),
        &mut h.snapshot,
    );
}
