//! From what stands in the envelope spectra to findings.

use super::family::{Families, SCORE, VERY_CLEAR};
use super::frequencies::Component;
use super::view::{USUAL_FTF, View, candidates, looking, side_by_side};
use super::{AnalysisError, Options};
use crate::signal::{
    Candidate, Evidence, Line, SidebandEvidence, Spectrum, diagnose_beside, without,
};

/// A line stands where noise would show as much less often than this.
pub(super) const LINE_LEVEL: f64 = 1e-3;
/// Power over the median from which a bin belongs to a line: noise goes beyond in one of 500 (two degrees of freedom).
const STANDS: f64 = 9.0;
/// A cage's lines lie close to the shaft's and to zero: fewer than this many are not called the cage's.
const FEWEST_OF_CAGE: usize = 3;
/// Chance under noise at which the sidebands of an element count as found. An element passes through the load once for each turn of
/// the cage, so that lines at its frequency without any sidebands are somebody else's: of slip in BPFO, most often.
const MODULATED: f64 = 0.01;
/// Rollers that enter the load of a healthy bearing strike the resting race at the same rate as its damage is struck (varying compliance):
/// healthy simulated NN3007s of 150 to 3000 N modulate the envelope by up to 0.39 at BPFO, for want of any other noise. Evidence below is weak.
/// Single-row bearings in such silence go beyond, so that more is no proof either.
const PASSING: f64 = 0.4;
/// Bins from one sideband to the next from which sidebands tell for one source and against another: a line fills five, so that in a shorter
/// record they hold most of the spectrum, and whatever else stands in it.
const APART: f64 = 10.0;

/// How much a finding says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Strength {
    /// Its lines stand in all bands together, higher and deeper than in a sound bearing's records ([`super::Family::is_damage`]).
    Damage,
    /// Lines stand, but hardly modulate the envelope, or are far weaker than another's.
    Faint,
}

/// A defect frequency that stands out.
#[derive(Debug, Clone)]
pub struct Finding {
    /// What is struck.
    pub component: Component,
    /// Name of its frequency: `BPFO`.
    pub name: &'static str,
    /// Where pure rolling has it, Hz.
    pub expected: f64,
    /// Its lines in the view that shows them best; `frequency` is where they stand.
    pub evidence: Evidence,
    /// That view, by index.
    pub view: usize,
    /// Views in which it stands.
    pub standing_in: usize,
    /// Chance that noise alone shows as much anywhere that was searched: an upper bound.
    pub false_alarm: f64,
    /// RMS of its standing lines times sqrt 2 over the envelope's mean: depth of modulation.
    pub modulation: f64,
    /// Score of its family over all bands ([`super::Family::score`]).
    pub score: f64,
    /// The score from which a record of this length shows damage.
    pub limit: f64,
    /// How much it says.
    pub strength: Strength,
    /// Stronger findings whose lines account for all of this one's.
    pub explained_by: Vec<&'static str>,
    /// Others that claim some of its lines.
    pub alternatives: Vec<&'static str>,
    /// Others that stand too, and that so short a record does not tell from it: a rolling element's sidebands fill it.
    pub untold_from: Vec<&'static str>,
    /// Whether the rollers of a healthy bearing may show as much, where nothing drowns them ([`Options::silent`]).
    pub may_be_passing: bool,
}

impl Finding {
    /// Whether it is called damage: strong enough, and not explained by a stronger one.
    pub fn is_cause(&self) -> bool {
        self.strength == Strength::Damage && self.explained_by.is_empty()
    }

    /// Its harmonics that stand by themselves.
    pub fn standing(&self) -> impl Iterator<Item = &Line> {
        self.evidence.harmonics.standing(LINE_LEVEL)
    }

    /// `very clear`, `clear` or `weak`, by its score over all bands, and whether something else may show as much.
    pub fn clarity(&self) -> &'static str {
        if self.may_be_passing || !self.untold_from.is_empty() {
            return "weak";
        }
        match self.score {
            score if score >= VERY_CLEAR - SCORE + self.limit => "very clear",
            _ if self.is_cause() => "clear",
            _ => "weak",
        }
    }

    /// Its standing sidebands and their distance, Hz, where more than one stands and noise would not show them.
    pub fn sidebands(&self) -> Option<(usize, f64)> {
        let s = self.evidence.sidebands.as_ref()?;
        (s.standing >= 2 && s.false_alarm < 0.01).then_some((s.standing, s.spacing))
    }
}

/// What a candidate shows at best over all views.
struct Standing {
    /// Index of the candidate.
    candidate: usize,
    view: usize,
    views: usize,
    evidence: Evidence,
    /// Share of the power of all lines of a view that its own have, summed over the views in which it stands.
    share: f64,
}

/// Findings, the strongest first, and the view that shows most.
///
/// The family that stands highest in all bands together comes first. Its lines are then taken out of every envelope spectrum, and what still
/// stands comes next; what does not was the first one's. A cage's lines come last: what turns with the cage modulates all else.
///
/// A frequency nearer to a named one's than `resolution` (Hz) cannot be told from it, and is said to be explained by it.
pub(super) fn find(
    views: &[View],
    shaft: f64,
    resolution: f64,
    families: &Families,
    options: &Options,
) -> Result<(Vec<Finding>, usize), AnalysisError> {
    let candidates = candidates(shaft, options);
    let mut spectra: Vec<Spectrum> = views.iter().map(|v| v.searched.clone()).collect();
    let mut evidence: Vec<Vec<Evidence>> =
        (views.iter().map(|v| v.diagnosis.evidence.clone())).collect();
    let first = standing(&candidates, &spectra, &evidence, &[]);
    let mut left = first.len();
    let mut named: Vec<Component> = Vec::new();
    let mut findings: Vec<Finding> = Vec::new();
    while left > 0 {
        let all = standing(&candidates, &spectra, &evidence, &named);
        let leads = |s: &Standing| {
            findings.is_empty() && families.damage.first() == Some(&candidates[s.candidate].0)
        };
        let lead = all.iter().position(leads).unwrap_or(0);
        let Some(next) = all.into_iter().nth(lead) else {
            break;
        };
        left -= 1;
        let (component, name, candidate) = &candidates[next.candidate];
        named.push(*component);
        let mut finding = finding(
            views,
            options,
            &next,
            *component,
            name,
            candidate.frequency,
            families,
        );
        // The cage only where no element stands that would strike at its rate.
        let cage = *component == Component::Cage && !findings.is_empty();
        if families.damage.contains(component) && !cage {
            finding.strength = Strength::Damage;
        }
        let near =
            |f: &&Finding| (f.evidence.frequency - finding.evidence.frequency).abs() < resolution;
        finding.explained_by = findings.iter().filter(near).map(|f| f.name).collect();
        let spacings = [shaft, options.orders.ftf.unwrap_or(0.0) * shaft];
        let only: Vec<_> = candidates.iter().map(|c| c.2.clone()).collect();
        let looking = looking(options, views.len() as f64);
        let seen: Vec<_> = spectra.iter().zip(&evidence).zip(views).collect();
        let left = side_by_side(&seen, |((spectrum, evidence), view)| {
            let mine = &evidence[next.candidate];
            let mine = if mine.stands { mine } else { &next.evidence };
            let rest = without(spectrum, mine.frequency, &spacings)?;
            let found = diagnose_beside(&rest, &only, &looking, &view.removed)?;
            Ok((rest, found.evidence))
        })?;
        (spectra, evidence) = left.into_iter().unzip();
        findings.push(finding);
    }
    // What stood at first, and no longer does.
    for gone in &first {
        let (component, name, candidate) = &candidates[gone.candidate];
        if named.contains(component) {
            continue;
        }
        named.push(*component);
        let mut finding = finding(
            views,
            options,
            gone,
            *component,
            name,
            candidate.frequency,
            families,
        );
        finding.explained_by = findings.iter().map(|f| f.name).collect();
        findings.push(finding);
    }
    // Bins are half as wide as what they resolve.
    if tells_elements(shaft, options) > 2.0 / resolution {
        let all: Vec<_> = findings.iter().map(|f| (f.component, f.name)).collect();
        for finding in &mut findings {
            let untold = |other: &&(Component, _)| {
                let pair = [finding.component, other.0];
                pair[0] != pair[1]
                    && pair.contains(&Component::Element)
                    && !pair.contains(&Component::Cage)
            };
            finding.untold_from = all.iter().filter(untold).map(|o| o.1).collect();
        }
    }
    let best = findings
        .first()
        .map_or_else(|| quiet_view(views), |f| f.view);
    Ok((findings, best))
}

/// How long a record has to be, s, to tell a rolling element's lines from others'.
pub(super) fn tells_elements(shaft: f64, options: &Options) -> f64 {
    APART / (options.orders.ftf.unwrap_or(USUAL_FTF) * shaft)
}

/// Power of everything in a spectrum that stands above its median.
fn line_power(spectrum: &Spectrum) -> f64 {
    let mut powers: Vec<f64> = spectrum.amplitude.iter().map(|a| 0.5 * a * a).collect();
    let middle = powers.len() / 2;
    let median = *powers.select_nth_unstable_by(middle, f64::total_cmp).1;
    let above = powers.iter().filter(|p| **p > STANDS * median);
    above.sum()
}

/// What stands in any view, the smallest chance first, the cage's last; one for each component not yet `named`.
fn standing(
    candidates: &[(Component, &'static str, Candidate)],
    spectra: &[Spectrum],
    evidence: &[Vec<Evidence>],
    named: &[Component],
) -> Vec<Standing> {
    let totals: Vec<f64> = spectra.iter().map(line_power).collect();
    let mut all: Vec<Standing> = Vec::new();
    for (index, (component, ..)) in candidates.iter().enumerate() {
        let fewest = match component {
            Component::Cage => FEWEST_OF_CAGE,
            _ => 1,
        };
        let stands = |e: &Evidence| {
            e.stands && e.shown() >= fewest && (*component != Component::Element || modulated(e))
        };
        let standing = || {
            evidence
                .iter()
                .enumerate()
                .filter(|(_, e)| stands(&e[index]))
        };
        let best = standing().min_by(|a, b| {
            (a.1[index].false_alarm.total_cmp(&b.1[index].false_alarm))
                .then(weight(&b.1[index]).total_cmp(&weight(&a.1[index])))
        });
        if let Some((view, e)) = best.filter(|_| !named.contains(component)) {
            all.push(Standing {
                candidate: index,
                view,
                views: standing().count(),
                evidence: e[index].clone(),
                share: standing()
                    .map(|(v, e)| power(&e[index], &spectra[v]) / totals[v].max(f64::MIN_POSITIVE))
                    .sum(),
            });
        }
    }
    all.sort_by(|a, b| {
        let cage = |s: &Standing| candidates[s.candidate].0 == Component::Cage;
        (cage(a).cmp(&cage(b))).then(b.share.total_cmp(&a.share))
    });
    // BSF and 2 BSF are one element's.
    let mut seen = Vec::new();
    all.retain(|s| {
        let component = candidates[s.candidate].0;
        let new = !seen.contains(&component);
        seen.push(component);
        new
    });
    all
}

/// Power of the lines that are its own as far as the spectrum tells.
fn power(e: &Evidence, spectrum: &Spectrum) -> f64 {
    let apart = |s: &SidebandEvidence| s.spacing >= APART * spectrum.frequency_step;
    match e.sidebands.as_ref().is_some_and(apart) {
        true => e.power(),
        false => 0.5 * e.modulation().powi(2),
    }
}

/// Whether the sidebands of something that turns stand together by more than chance, where they can be told from their carriers: in a
/// short record none may stand by itself.
fn modulated(e: &Evidence) -> bool {
    (e.sidebands.as_ref()).is_none_or(|s| s.false_alarm <= MODULATED)
}

/// Number and strength of the harmonics that stand.
fn weight(e: &Evidence) -> f64 {
    (e.harmonics.standing(LINE_LEVEL).chain(e.carrying()))
        .map(|l| l.snr_db)
        .sum()
}

fn finding(
    views: &[View],
    options: &Options,
    from: &Standing,
    component: Component,
    name: &'static str,
    expected: f64,
    families: &Families,
) -> Finding {
    let of = families.all.iter().find(|f| f.component == component);
    let evidence = from.evidence.clone();
    let modulation = evidence.modulation() / views[from.view].mean.max(f64::MIN_POSITIVE);
    let names: Vec<&str> = options.orders.strikes().map(|s| s.1).collect();
    Finding {
        component,
        name,
        expected,
        view: from.view,
        standing_in: from.views,
        false_alarm: (evidence.false_alarm * views.len() as f64).min(1.0),
        modulation,
        score: of.map_or(0.0, |f| f.score),
        limit: of.map_or(f64::INFINITY, |f| f.limit),
        strength: Strength::Faint,
        explained_by: Vec::new(),
        alternatives: (evidence.alternatives.iter()).map(|a| names[a.0]).collect(),
        untold_from: Vec::new(),
        may_be_passing: options.silent && component == Component::OuterRace && modulation < PASSING,
        evidence,
    }
}

/// The view to show where nothing stands: the broad band at the fine resolution.
fn quiet_view(views: &[View]) -> usize {
    use super::bands::BandChoice::{Broad, Given};
    (views.iter())
        .rposition(|v| matches!(v.band.choice, Broad | Given))
        .unwrap_or(0)
}
