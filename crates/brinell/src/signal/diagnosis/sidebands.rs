//! Lines to either side of a candidate's harmonics.

use super::super::distribution::chi_square_tail;
use super::super::lines::{Floor, Line, LineSet};
use super::{CAP, CLOSEST_SIDEBAND, DiagnosisOptions, LINE_LEVEL};

/// Sidebands of a candidate's harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct SidebandEvidence {
    /// Distance, Hz.
    pub spacing: f64,
    /// About each harmonic in turn; those that fall on the candidate's own harmonics, or where lines were taken out, are left out.
    pub lines: Vec<Line>,
    /// Of each line, the order of the harmonic that it is about.
    pub about: Vec<i32>,
    /// How many stand by themselves (chance under noise below 1e-3).
    pub standing: usize,
    /// Chance that noise shows as much in all of them together, for any candidate of the list.
    pub false_alarm: f64,
}

impl SidebandEvidence {
    /// Those that stand by themselves, with the order of their harmonic.
    pub fn standing_lines(&self) -> impl Iterator<Item = (i32, &Line)> {
        (self.about.iter().copied().zip(&self.lines)).filter(|(_, l)| l.false_alarm <= LINE_LEVEL)
    }

    /// Orders of the harmonics of which these tell although lines were taken out at their places, `aside` (Hz), within `reach` Hz.
    ///
    /// Sidebands as far from their harmonic as what was taken out lies from its like say nothing: they were taken out as well.
    pub(super) fn carry(&self, harmonics: &LineSet, aside: &[f64], reach: f64) -> Vec<i32> {
        let stand = |h: i32, below: bool| {
            (self.standing_lines()).any(|(about, l)| about == h && (l.order < 0) == below)
        };
        let apart = |hides: f64| {
            let spaced = |other: &f64| ((other - hides).abs() - self.spacing).abs() <= reach;
            !aside.iter().any(spaced)
        };
        let hidden = |l: &&Line| {
            let mut hiding = aside.iter().filter(|a| (*a - l.expected).abs() <= reach);
            hiding.next().is_some_and(|first| apart(*first)) && hiding.all(|a| apart(*a))
        };
        (harmonics.lines.iter().filter(hidden))
            .map(|l| l.order)
            .filter(|h| stand(*h, true) && stand(*h, false))
            .collect()
    }
}

/// The sidebands of a comb of `frequency`, `spacing` apart (Hz), but those that are `unseen`, judged together for so many candidates.
pub(super) fn about(
    floor: &Floor,
    frequency: f64,
    spacing: f64,
    options: &DiagnosisOptions,
    candidates: f64,
    unseen: &impl Fn(&Line) -> bool,
) -> Option<SidebandEvidence> {
    let step = floor.step();
    let (mut lines, mut whose) = (Vec::new(), Vec::new());
    let count = options.sidebands as i32;
    for h in 1..=options.harmonics {
        let carrier = h as f64 * frequency;
        let tolerance = step.min(0.4 * spacing);
        lines.extend(
            (-count..=count)
                .filter(|m| *m != 0)
                .filter_map(|m| floor.line(m, carrier + f64::from(m) * spacing, tolerance))
                .filter(|l| !unseen(l))
                .filter(|l| {
                    let order = (l.expected / frequency).round();
                    (l.expected - order * frequency).abs() >= CLOSEST_SIDEBAND * step
                }),
        );
        whose.resize(lines.len(), h as i32);
    }
    if lines.is_empty() {
        return None;
    }
    let statistic: f64 = lines
        .iter()
        .map(|l| -2.0 * l.false_alarm.max(CAP).ln())
        .sum();
    let chance = chi_square_tail(statistic, 2.0 * lines.len() as f64);
    Some(SidebandEvidence {
        spacing,
        standing: lines.iter().filter(|l| l.false_alarm <= LINE_LEVEL).count(),
        lines,
        about: whose,
        false_alarm: (chance * candidates).min(1.0),
    })
}
