//! Runs that are one scenario: their signals are the same to the bit.

use super::split::Part;
use brinell::scenario::Scenario;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Runs that nothing drawn tells apart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Repeats {
    /// How many runs have others like them.
    pub runs: usize,
    /// Of how many scenarios these are.
    pub scenarios: usize,
    /// How many of the runs have others like them in another split.
    pub across: usize,
    /// Two such runs, in different splits where there are any.
    pub such_as: [(usize, Part); 2],
}

/// Of what a run sets, so that runs that set the same can be found. The seed of a noise of 0 makes no difference.
pub(super) fn print(settings: &[(String, String)], scenario: &Scenario) -> u64 {
    let sensor = &scenario.sensor;
    let silent = sensor.noise_snr_db.is_none() && sensor.noise_rms_m_per_s2.is_none_or(|rms| rms == 0.0);
    let mut hasher = DefaultHasher::new();
    for setting in settings.iter().filter(|(key, _)| !(silent && key == "sensor.noise_seed")) {
        setting.hash(&mut hasher);
    }
    hasher.finish()
}

impl Repeats {
    /// Of the runs' prints; `None` where no two are alike.
    pub fn of(prints: &[(usize, u64)], part: impl Fn(usize) -> Part) -> Option<Self> {
        let mut alike: HashMap<u64, Vec<usize>> = HashMap::new();
        for (run, print) in prints {
            alike.entry(*print).or_default().push(*run);
        }
        let mut groups: Vec<Vec<usize>> = alike.into_values().filter(|runs| runs.len() > 1).collect();
        groups.sort();
        let other = |runs: &[usize]| runs.iter().copied().find(|run| part(*run) != part(runs[0]));
        let divided = groups.iter().find_map(|runs| Some([runs[0], other(runs)?]));
        let pair = divided.or(groups.first().map(|runs| [runs[0], runs[1]]))?;
        Some(Self {
            runs: groups.iter().map(Vec::len).sum(),
            scenarios: groups.len(),
            across: groups.iter().filter(|runs| other(runs).is_some()).map(Vec::len).sum(),
            such_as: pair.map(|run| (run, part(run))),
        })
    }

    /// The same in words; `looked` is how many runs were looked at.
    pub fn words(&self, looked: usize) -> String {
        let [(first, its), (second, other)] = self.such_as;
        let across = match self.across {
            0 => String::new(),
            all => format!("; {all} of them have it in several splits ({} and {})", its.word(), other.word()),
        };
        format!(
            "{} of {looked} runs looked at have the scenario of another run, such as run {first} and run {second} ({} scenario{} in all){across}: nothing \
             that they draw differs, so their signals are the same to the bit; draw a key from a distribution, or give sensor.noise_rms_m_per_s2",
            self.runs,
            self.scenarios,
            if self.scenarios == 1 { "" } else { "s" }
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_runs_alike_are_counted_and_where_they_lie() {
        let part = |run: usize| if run < 4 { Part::Train } else { Part::Test };
        assert_eq!(Repeats::of(&[(0, 7), (1, 8)], part), None);
        let found = Repeats::of(&[(0, 7), (1, 7), (2, 9), (3, 8), (4, 9), (5, 9)], part).unwrap();
        assert_eq!((found.runs, found.scenarios, found.across), (5, 2, 3));
        let words = found.words(6);
        assert!(words.starts_with(
            "5 of 6 runs looked at have the scenario of another run, such as run 2 and run 4 (2 scenarios in all); 3 of them have it in several splits \
             (train and test): "
        ));
    }

    #[test]
    fn regress_the_seed_of_no_noise_makes_no_difference() {
        let of = |rms: f64, seed: &str| {
            let mut s = Scenario::example();
            s.sensor.noise_rms_m_per_s2 = Some(rms);
            print(&[("sensor.noise_seed".into(), seed.into())], &s)
        };
        assert_eq!(of(0.0, "1"), of(0.0, "2"));
        assert_ne!(of(0.1, "1"), of(0.1, "2"));
    }
}
