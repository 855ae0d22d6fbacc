//! Keys of which every run, or every machine, has a seed of its own.

use brinell::document::reading::{Node, Toml};

/// A seed that every run has one of its own of.
pub(super) struct Seeded {
    /// The table that holds it; `*` is any element of a list. A run whose scenario has no such table has no such seed.
    pub(super) table: &'static str,
    /// Its name there.
    pub(super) name: &'static str,
    /// Keys of which the table has one where the seed means something; none where it always does.
    pub(super) with: &'static [&'static str],
    /// The seed's key, where another table holds it.
    pub(super) elsewhere: Option<&'static str>,
    /// Whether each snapshot of a machine has one of its own, and not the machine.
    pub(super) anew: bool,
}

impl Seeded {
    /// The key, of a table that is there.
    pub(super) fn key(&self, holder: &str) -> String {
        self.elsewhere.map_or_else(|| format!("{holder}.{}", self.name), str::to_owned)
    }
}

/// Keys that are seeded per run, with histories per machine, where the plan does not set them.
pub(super) const SEEDED_PER_RUN: [Seeded; 5] = [
    Seeded { table: "defects.*.shape.random", name: "seed", with: &[], elsewhere: None, anew: false },
    Seeded { table: "bearing.*.defects.*.shape.random", name: "seed", with: &[], elsewhere: None, anew: false },
    Seeded {
        table: "sensor",
        name: "noise_seed",
        with: &["noise_rms_m_per_s2", "noise_snr_db"],
        elsewhere: None,
        anew: true,
    },
    Seeded {
        table: "bearing",
        name: "seed",
        with: &["waviness", "element_waviness"],
        elsewhere: Some("simulation.seed"),
        anew: false,
    },
    Seeded {
        table: "bearing.*",
        name: "seed",
        with: &["waviness", "element_waviness"],
        elsewhere: Some("simulation.seed"),
        anew: false,
    },
];

/// Paths of the tables that a pattern names and that have one of the keys `with`.
pub(super) fn holding(node: &Node, pattern: &str, with: &[&str], path: &str, all: &mut Vec<String>) {
    let join = |name: &str| {
        if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
    };
    let Some((head, rest)) = pattern.split_once('.').or((!pattern.is_empty()).then_some((pattern, ""))) else {
        if let Toml::Table(table) = &node.value
            && (with.is_empty() || with.iter().any(|key| table.contains_key(*key)))
        {
            all.push(path.to_owned());
        }
        return;
    };
    match &node.value {
        Toml::Array(items) if head == "*" => {
            for (k, item) in items.iter().enumerate() {
                holding(item, rest, with, &join(&k.to_string()), all);
            }
        }
        Toml::Table(table) => {
            if let Some(entry) = table.get(head) {
                holding(&entry.node, rest, with, &join(head), all);
            }
        }
        _ => {}
    }
}
