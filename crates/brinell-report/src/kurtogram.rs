//! The kurtogram: how impulsive each band is, rows of ever narrower bands; darker where more.

use crate::chart::{Chart, Domain, SCALE_MARGIN, Shades, Spec, range};
use crate::picture::{Paint, Picture, Rect, ink};
use crate::plots::Layout;
use brinell::signal::kurtogram::Level;

/// The whole map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kurtogram {
    /// From the whole band to the narrowest ones.
    pub levels: Vec<Level>,
    /// The band that was chosen, Hz.
    pub chosen_hz: Option<(f64, f64)>,
    /// In words; may be empty.
    pub note: String,
}

/// Columns of the image at most: rows of 1 to 64 bands and their thirds divide it.
const MOST_COLUMNS: usize = 192;

impl Kurtogram {
    /// Upper end of the bands, Hz; `None` without one.
    fn top(&self) -> Option<f64> {
        let width = |l: &Level| l.bandwidth * l.kurtosis.len() as f64;
        let top = self.levels.iter().map(width).fold(0.0, f64::max);
        (top > 0.0 && top.is_finite()).then_some(top)
    }

    /// Kurtosis at evenly spaced frequencies, the narrowest bands' row first.
    fn rows(&self, top: f64) -> Vec<f64> {
        let row = |l: &Level| {
            let at = |c: usize| {
                let frequency = (c as f64 + 0.5) / MOST_COLUMNS as f64 * top;
                let index = (frequency / l.bandwidth).max(0.0) as usize;
                l.kurtosis.get(index).copied().unwrap_or(f64::NAN)
            };
            (0..MOST_COLUMNS).map(at).collect::<Vec<_>>()
        };
        self.levels.iter().rev().flat_map(row).collect()
    }
}

pub(crate) fn kurtogram(view: &Kurtogram, layout: Layout) -> Picture {
    let size = layout.size(if layout.roomy() { 260.0 } else { 240.0 });
    let rows = view.levels.len().max(1) as f64;
    let top = view.top();
    let mut chart = Chart::new(Spec {
        right: SCALE_MARGIN * size.font,
        ..Spec::new(
            "kurtogram",
            "Kurtogram",
            size,
            (Domain::exact(0.0, top.unwrap_or(1.0)), "Frequency", "Hz"),
            (Domain::exact(0.0, rows), "Level", ""),
        )
    });
    let values = top.map(|top| view.rows(top)).unwrap_or_default();
    let (Some(top), Some((_, highest))) = (top, range(values.iter().copied())) else {
        chart.say("No kurtogram");
        return chart.finish();
    };
    let highest = if highest > 0.0 { highest } else { 1.0 };
    chart.shades(&Shades { columns: MOST_COLUMNS, values: &values, range: (0.0, highest), ticks: 5, head: "kurtosis" });
    let frame = chart.frame;
    let narrow = |l: &&Level| {
        let (low, high) = view.chosen_hz.unwrap_or((0.0, 0.0));
        ((high - low) / l.bandwidth - 1.0).abs() < 1e-6
    };
    if let Some((low, high)) = view.chosen_hz
        && let Some(level) = view.levels.iter().position(|l| narrow(&l))
        && high <= top * (1.0 + 1e-9)
    {
        let x = |f: f64| frame.left + f / top * (frame.right - frame.left);
        let y = |row: f64| frame.bottom - row / rows * frame.height();
        let around = Rect { left: x(low), right: x(high), top: y(level as f64 + 1.0), bottom: y(level as f64) };
        chart.picture.rect(around, Paint::line(ink::VERMILLION, 2.0));
    }
    chart.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> Kurtogram {
        let level =
            |bandwidth: f64, kurtosis: &[f64]| Level { bandwidth, kurtosis: kurtosis.to_vec(), noise_scatter: 0.0 };
        Kurtogram {
            levels: vec![level(3000.0, &[0.1]), level(1500.0, &[0.2, 0.3]), level(1000.0, &[1.0, 2.0, 3.0])],
            chosen_hz: Some((1000.0, 2000.0)),
            note: String::new(),
        }
    }

    #[test]
    fn analytic_each_band_fills_its_share_of_its_row() {
        let map = map();
        assert_eq!(map.top(), Some(3000.0));
        let rows = map.rows(3000.0);
        assert_eq!(rows.len(), 3 * MOST_COLUMNS);
        let third = MOST_COLUMNS / 3;
        assert_eq!([rows[0], rows[third], rows[3 * third - 1]], [1.0, 2.0, 3.0]);
        let second = &rows[MOST_COLUMNS..2 * MOST_COLUMNS];
        assert_eq!([second[MOST_COLUMNS / 2 - 1], second[MOST_COLUMNS / 2]], [0.2, 0.3]);
        assert!(rows[2 * MOST_COLUMNS..].iter().all(|k| *k == 0.1));
    }

    #[test]
    fn analytic_the_chosen_band_is_outlined() {
        let with = kurtogram(&map(), Layout::Wide).svg();
        let none = Kurtogram { chosen_hz: None, ..map() };
        assert!(with.len() > kurtogram(&none, Layout::Wide).svg().len());
    }

    #[test]
    fn prop_an_empty_map_says_so() {
        assert!(kurtogram(&Kurtogram::default(), Layout::Wide).svg().contains("No kurtogram"));
    }
}
