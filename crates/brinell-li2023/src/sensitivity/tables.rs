//! Tables of the sensitivity: the three RMS values under every assumption, and what the nearest sets assume.

use super::{Candidate, Nearest, Sensitivity, Tried};
use crate::figures::cell;
use crate::{FREQUENCY, RANGES, RMS, Reading, Record, SEARCHED, distance};
use brinell_report::Table;
use brinell_report::short;

/// The record from t = 0 that is shown beside the steady part where a variant names none.
const SHOWN_MS: u32 = 285;

impl Sensitivity {
    /// The paper's three RMS values under every assumption, steady and from t = 0.
    pub(super) fn three_rms(&self) -> Table {
        let mut columns = vec!["#No.".to_owned(), "Assumed".to_owned()];
        for record in ["steady", "from t = 0"] {
            for case in ["irregular", "simplified", "reference"] {
                columns.push(format!("#{case}, {record}"));
            }
        }
        columns.push("#Nearest".to_owned());
        let paper = || RMS.map(|rms| rms.to_string());
        let mut rows = vec![vec!["".to_owned(), "the paper".to_owned()]];
        rows[0].extend(paper().into_iter().chain(paper()));
        rows[0].push("0".into());
        rows.extend(self.variants.iter().enumerate().map(|(k, tried)| row(k, tried)));
        Table::new(
            "The three RMS values under each assumption",
            columns,
            rows,
            format!(
                "RMS of the outer ring’s x acceleration, m/s²: full model with the irregular and with the simplified defect, reference model with \
                 the simplified one. Instantaneous, with its 95 % interval where there is one, / behind the anti-alias filter. From t = 0: over \
                 {} s, or what the assumption names; one start a record, so no interval. Nearest: the smallest root mean square of ln(ours/paper’s) \
                 among the four readings; 0.05 is 5 %.",
                f64::from(SHOWN_MS) / 1e3
            ),
        )
    }

    /// What the best sets are.
    pub(super) fn best_sets(&self) -> Table {
        let mut columns = vec!["Quantity".to_owned(), "#Paper".to_owned()];
        columns.extend(self.candidates.iter().map(|c| format!("#Set {}", c.draw.number)));
        let mut rows = Vec::new();
        let mut row = |name: &str, paper: &str, of: &dyn Fn(&Candidate) -> String| {
            let mut row = vec![name.to_owned(), paper.to_owned()];
            row.extend(self.candidates.iter().map(of));
            rows.push(row);
        };
        row("Claims that hold, of the checkable", "", &|c| format!("{} of {}", c.held(), c.checkable()));
        let cases = ["RMS full, irregular (m/s²)", "RMS full, simplified (m/s²)", "RMS reference, simplified (m/s²)"];
        for (k, name) in cases.into_iter().enumerate() {
            row(name, &RMS[k].to_string(), &|c| short(c.distance.values[k], 4));
        }
        row("Distance of the three RMS", "0", &|c| short(c.distance.rms, 3));
        let frequency = format!("Defect frequency less {FREQUENCY:.2} Hz");
        row(&frequency, "0", &|c| c.distance.frequency.map_or("–".into(), |f| short(f, 3)));
        row("RMS over", "", &|c| c.draw.reading.record.words());
        row("Outer ring behind the filter", "", &|c| if c.draw.reading.filtered { "yes" } else { "no" }.into());
        row("Eq. (27)", "", &|c| c.draw.outline.words().into());
        for range in RANGES.iter() {
            for key in &range.keys {
                let of = |c: &Candidate| {
                    let found = c.draw.settings.iter().find(|(k, _)| k == key);
                    found.map_or("–".into(), |(_, v)| v.clone())
                };
                row(key, "", &of);
            }
        }
        Table::new(
            "The nearest sets",
            columns,
            rows,
            "Distance: root mean square of ln(ours/paper's); 0.05 is 5 %. In all cases, longer than in the search.",
        )
    }

    /// How near the sets came, by the stretch of the record.
    pub(super) fn by_record(&self) -> Table {
        let row = |n: &Nearest| {
            let best = n.best.as_ref();
            let value = |k: usize| best.map_or("–".into(), |b| short(b.1.values[k], 4));
            vec![
                n.record.words(),
                n.sets.to_string(),
                best.map_or("–".into(), |b| b.0.to_string()),
                best.map_or("–".into(), |b| short(b.1.rms, 3)),
                value(0),
                value(1),
                value(2),
            ]
        };
        let [irregular, simplified, reference] = RMS;
        let columns = ["RMS over", "#Sets", "#Nearest set", "#Distance", "#irregular", "#simplified", "#reference"];
        Table::new(
            "How near the sets came, by the stretch of the record",
            columns,
            self.nearest.iter().map(row),
            format!(
                "The paper: {irregular}, {simplified}, {reference} m/s². By the distance of the three RMS alone, whatever else holds."
            ),
        )
    }
}

fn row(k: usize, tried: &Tried) -> Vec<String> {
    let chosen = tried.variant.reading.record;
    let ms = match chosen {
        Record::FromStart(ms) => ms,
        Record::Steady => SHOWN_MS,
    };
    let usual = Reading::USUAL;
    let readings = [usual, usual.over_start(ms)];
    let mut row = vec![k.to_string(), format!("{}: {}", tried.variant.about, tried.variant.words)];
    let mut nearest: Option<f64> = None;
    for reading in readings {
        let plain = tried.numbers.read(reading);
        let filtered = tried.numbers.read(reading.behind_filter());
        for case in SEARCHED {
            let behind = filtered.get(case, "outer_ax.rms").map(|n| short(n.value, 4));
            row.push(format!("{} / {}", cell(plain.get(case, "outer_ax.rms")), behind.unwrap_or("–".into())));
        }
        let all = [distance(&plain), distance(&filtered)];
        let least = all.into_iter().flatten().map(|d| d.rms).min_by(f64::total_cmp);
        nearest = [nearest, least].into_iter().flatten().min_by(f64::total_cmp);
    }
    row.push(nearest.map_or("–".into(), |d| short(d, 2)));
    row
}
