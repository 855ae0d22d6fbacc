//! A calibration as its page shows it.

use super::outcome::Outcome;
use super::runs::settings;
use crate::say::{plural, short};
use brinell_report::{CalibrationReport, Fact, Table, Tried};
use brinell_study::calibrate::search::STEP;

impl Outcome<'_> {
    pub(super) fn report(&self) -> CalibrationReport {
        let all = &self.fit.evaluations;
        let failed: Vec<(String, String)> = (all.iter().enumerate())
            .filter(|(_, e)| e.answers.is_none())
            .map(|(k, e)| {
                let settings = settings(self.runs.points.keys, &e.place);
                let texts: Vec<String> = settings.iter().map(|(k, v)| format!("{k} = {v}")).collect();
                let reason = self.runs.row(&e.place).err().unwrap_or_default();
                (format!("{}: {}", k + 1, texts.join(", ")), reason)
            })
            .collect();
        let determined = self.found.iter().filter(|f| f.is_determined()).count();
        let names: Vec<&str> = self.found.iter().map(|f| f.key.name.as_str()).collect();
        let p_value = self.p_value().map_or("no degree of freedom".to_owned(), |p| format!("p-value {}", short(p, 2)));
        let mut facts = vec![
            Fact::new(
                "Chi-square",
                short(self.chi_square(), 3),
                "",
                format!("{}; {p_value}", plural(self.compared.len(), "target")),
            ),
            Fact::new("Keys determined", format!("{determined} of {}", self.found.len()), "", "by their 95 % interval"),
            Fact::new("Runs", all.len().to_string(), "", format!("the best is run {}", self.fit.best + 1)),
        ];
        if !failed.is_empty() {
            facts.push(Fact::new("Failed", failed.len().to_string(), "", "reasons below"));
        }
        CalibrationReport {
            title: format!("Calibration of {}", self.best.scenario.name),
            subtitle: format!("{} to {}", names.join(", "), plural(self.compared.len(), "target")),
            version: brinell::VERSION.into(),
            met: self.is_met(),
            verdict: self.verdict(),
            facts,
            keys: self.found.iter().map(|f| f.key.clone()).collect(),
            found: (self.found.iter())
                .map(|f| Fact::new(&f.key.name, short(f.key.best, 5), &f.key.unit, f.interval_text()))
                .collect(),
            undetermined: self.undetermined(),
            targets: self.targets(),
            correlation: self.correlation(),
            directions: self.directions(),
            tried: self.tried(),
            failures: failed,
            method: self.method(),
            scenario_toml: self.best.to_toml(),
        }
    }

    fn tried(&self) -> Vec<Tried> {
        let best = &self.fit.evaluations[self.fit.best].place;
        let one = |e: &brinell_study::calibrate::Evaluation| Tried {
            values: self.plan.keys.iter().zip(&e.place).map(|(k, u)| k.value(*u)).collect(),
            chi_square: e.chi_square,
            alone: (0..best.len())
                .map(|k| (0..best.len()).all(|other| other == k || e.place[other] == best[other]))
                .collect(),
        };
        self.fit.evaluations.iter().map(one).collect()
    }

    fn targets(&self) -> Table {
        let row = |c: &super::outcome::Compared| {
            let own = if c.own > 0.0 { format!(" ± {}", short(c.own, 2)) } else { String::new() };
            vec![
                c.name.clone(),
                c.unit.clone(),
                format!("{} ± {}", short(c.target, 5), short(c.uncertainty, 2)),
                c.value.map_or("–".into(), |v| format!("{}{own}", short(v, 5))),
                format!("{:+.1}", c.residual),
            ]
        };
        Table::new(
            "Targets and the best run",
            ["Target", "Unit", "#Wanted", "#Best run", "#Residual"],
            self.compared.iter().map(row),
            "Uncertainties are standard ones (one sigma). A residual is the difference over the target's uncertainty and the runs' own together, \
             the latter being the median over the best few runs, the same for all, so that no run is preferred for being uncertain.",
        )
    }

    fn correlation(&self) -> Table {
        let identified = &self.fit.identified;
        let mut columns = vec!["Key".to_owned()];
        columns.extend(self.found.iter().map(|f| format!("#{}", f.key.name)));
        let row = |a: usize| {
            let mut row = vec![self.found[a].key.name.clone()];
            row.extend((0..self.found.len()).map(|b| format!("{:.2}", identified.correlation[(a, b)])));
            row
        };
        Table::new(
            "Correlation of the estimates",
            columns,
            (0..self.found.len()).map(row),
            "Near 1 or -1 only a combination of the two is determined.",
        )
    }

    fn directions(&self) -> Table {
        let mut columns = vec!["Direction".to_owned()];
        columns.extend(self.found.iter().map(|f| format!("#{}", f.key.name)));
        columns.extend(["#Singular value", "#Noise", "#Half 95 % interval", "Determined"].map(String::from));
        let rows = self.fit.identified.directions.iter().enumerate().map(|(k, d)| {
            let mut row = vec![(k + 1).to_string()];
            row.extend(d.vector.iter().map(|v| format!("{v:.2}")));
            row.push(short(d.singular_value, 3));
            row.push(short(d.noise, 2));
            row.push(if d.half_width.is_finite() { short(d.half_width, 2) } else { "∞".into() });
            row.push(if d.is_determined() { "yes" } else { "no" }.into());
            row
        });
        Table::new(
            "Directions, from the best to the least determined",
            columns,
            rows,
            "Each key counts in shares of its range. The singular value is how many standard uncertainties the targets change by over one \
             range along the direction; noise is what the runs' own uncertainty alone would show.",
        )
    }

    fn method(&self) -> Vec<String> {
        let steps: Vec<String> = (self.found.iter().zip(&self.fit.steps))
            .map(|(f, s)| format!("{} {} %", f.key.name, short(200.0 * s, 2)))
            .collect();
        let mut all = vec![
            format!(
                "Latin hypercube, particle swarm, then Levenberg and Marquardt's method from the best places; seed {}, {} of at most {} runs.",
                self.plan.settings.seed,
                self.fit.evaluations.len(),
                self.plan.settings.budget
            ),
            format!(
                "The Jacobian is made of differences around run {}, over these shares of the ranges: {}. Within {} % a difference would be below the \
                 scatter of runs, whose impacts amplify round-off.",
                self.fit.centre + 1,
                steps.join(", "),
                200.0 * STEP
            ),
            "Intervals hold where the targets depend nearly linearly on the keys over the interval, and where the model is right: what it leaves out \
             is in no interval."
                .into(),
        ];
        let inflation = self.fit.identified.inflation;
        if inflation > 1.0 {
            all.push(format!(
                "The misfit is larger than the uncertainties explain; they were multiplied by {} for the intervals.",
                short(inflation, 3)
            ));
        }
        all
    }
}
