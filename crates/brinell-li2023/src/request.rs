//! What is to be reproduced: figures of the paper, and the runs that decide what is said of them.

use crate::cases::{about_start, defaults, start, under};
use crate::models::OtherRuns;
use crate::sensitivity::Plan;
use crate::{Case, EXPERIMENTS, Error, Experiment, Length, Outline, Point, case};
use brinell::scenario::Laws;

/// What is to be reproduced.
pub struct Request {
    pub(crate) experiments: Vec<&'static Experiment>,
    /// Every case once.
    pub(crate) points: Vec<Point>,
    /// The same from further starts.
    pub(crate) repeats: Vec<Point>,
    /// The same with the default values of other laws than the paper's, once.
    pub(crate) defaults: Vec<Point>,
    pub(crate) length: Length,
    /// Those that every case is made under, but for the lumped model, which knows the paper's alone.
    pub(crate) laws: Laws,
    /// Whether it is all of section 4.
    pub(crate) whole: bool,
    pub(crate) plan: Option<Plan>,
    pub(crate) models: Option<OtherRuns>,
}

impl Request {
    /// Some figures of the paper, or all where `figures` is empty, under a set of laws; runs last `length`. Full runs are
    /// made from several starts.
    ///
    /// # Errors
    /// Where a case is no scenario.
    pub fn new(figures: &[u32], length: Length, laws: Laws) -> Result<Self, Error> {
        let wanted = |e: &&Experiment| figures.is_empty() || e.figures.iter().any(|f| figures.contains(f));
        let experiments: Vec<&Experiment> = EXPERIMENTS.iter().filter(wanted).collect();
        let mut cases: Vec<&'static Case> = Vec::new();
        for id in experiments.iter().flat_map(|e| &e.cases) {
            match case(id) {
                Some(case) if !cases.contains(&case) => cases.push(case),
                _ => {}
            }
        }
        // The lumped model is the paper's, and has its laws.
        let laws_of = |case: &Case| if case.is_lumped() { Laws::Li2023 } else { laws };
        let point = |case: &'static Case, more: &[(String, String)]| Point::new(case, more, Outline::Joined, length);
        let points = cases.iter().map(|case| point(case, &under(laws_of(case))));
        let steady = cases.iter().filter(|case| !about_start(case));
        let repeats = steady.flat_map(|case| {
            let further = 1..length.starts();
            further.map(move |k| point(case, &[under(laws_of(case)), start(k)].concat()))
        });
        let others = if laws == Laws::Li2023 { &[] } else { cases.as_slice() };
        let defaults = others.iter().map(|case| point(case, &defaults(laws_of(case))));
        Ok(Self {
            whole: figures.is_empty(),
            points: points.collect::<Result<_, Error>>()?,
            repeats: repeats.collect::<Result<_, Error>>()?,
            defaults: defaults.collect::<Result<_, Error>>()?,
            experiments,
            length,
            laws,
            plan: None,
            models: None,
        })
    }

    /// The same with every assumption varied, and searches for the set of assumptions that agrees best.
    ///
    /// # Errors
    /// Where a variant of a case is no scenario.
    pub fn with_sensitivity(self, quick: bool) -> Result<Self, Error> {
        Ok(Self { plan: Some(Plan::new(quick)?), ..self })
    }

    /// The same with every case also in slices and with tilting, the verdicts side by side.
    ///
    /// # Errors
    /// Where a case is no scenario of those models.
    pub fn with_tilting(self) -> Result<Self, Error> {
        let cases: Vec<_> = self.points.iter().map(|point| point.case).collect();
        Ok(Self { models: Some(OtherRuns::new(&cases, self.length)?), ..self })
    }

    /// All runs of the cases.
    pub(crate) fn starts(&self) -> impl Iterator<Item = &Point> {
        self.points.iter().chain(&self.repeats)
    }

    /// Points of which pictures show curves.
    pub(crate) fn with_curves(&self) -> impl Iterator<Item = &Point> {
        let has_curves = |e: &&&Experiment| e.figures[0] <= 15 || e.figures[0] == 20;
        self.points.iter().filter(move |p| {
            let mut experiments = self.experiments.iter().filter(has_curves);
            experiments.any(|e| e.cases.contains(&p.case.id))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BASE;

    #[test]
    fn prop_cases_under_mechanics_are_sound_scenarios_without_warnings() {
        let request = Request::new(&[], Length::QUICK, Laws::Mechanics).unwrap();
        assert_eq!(request.points.len(), request.defaults.len());
        for (kept, defaults) in request.points.iter().zip(&request.defaults) {
            assert_eq!(kept.case, defaults.case);
            let [a, b] = [kept, defaults].map(|point| {
                let loaded = brinell::document::read(BASE, &point.task.settings).unwrap();
                assert!(loaded.warnings.is_empty(), "{}: {:?}", point.case.id, loaded.warnings);
                loaded.scenario
            });
            let laws = if kept.case.is_lumped() { Laws::Li2023 } else { Laws::Mechanics };
            assert_eq!([a.simulation.laws, b.simulation.laws], [laws, laws], "{}", kept.case.id);
            // What is kept is the bearing's, so the paper's cases have it too.
            let case = Point::new(kept.case, &[], Outline::Joined, Length::QUICK).unwrap();
            let paper = brinell::document::read(BASE, &case.task.settings).unwrap().scenario;
            assert_eq!((a.support.clone(), a.housing.clone()), (paper.support, paper.housing));
            assert_eq!(a.cage.guide_clearance_mm, paper.cage.guide_clearance_mm);
            assert_eq!((a.cage.guidance, a.cage.guidance_film), (paper.cage.guidance, paper.cage.guidance_film));
            assert_eq!((a.operation, a.defects), (paper.operation, paper.defects));
        }
    }

    #[test]
    fn prop_the_papers_laws_need_no_setting() {
        let request = Request::new(&[], Length::FULL, Laws::Li2023).unwrap();
        assert!(request.defaults.is_empty());
        let mut settings = request.starts().flat_map(|point| &point.task.settings);
        assert!(settings.all(|(key, _)| key != "simulation.laws"));
    }
}
