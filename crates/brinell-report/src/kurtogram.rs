//! The kurtogram: the spectral kurtosis of each band, how impulsive it is, rows of ever narrower bands; darker where
//! more.

use crate::chart::{Chart, Domain, SCALE_MARGIN, Shades, Size, Spec, range};
use crate::layout::{Layout, legend};
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, ink};
use brinell::signal::kurtogram::Level;

/// The whole map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kurtogram {
    /// From the whole band to the narrowest ones.
    pub levels: Vec<Level>,
    /// The most impulsive band, Hz.
    pub chosen_hz: Option<(f64, f64)>,
    /// The band that was demodulated, Hz.
    pub demodulated_hz: Option<(f64, f64)>,
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

    /// Spectral kurtosis of each band, 0 for noise, at evenly spaced frequencies; the narrowest bands' row first.
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
    let mut picture = Picture::new("kurtogram", "Kurtogram", size.width, 0.0);
    let impulsive = ("Most impulsive band", Paint::line(ink::VERMILLION, 2.0));
    let demodulated = ("Band demodulated", Paint::line(ink::ORANGE, 2.0).dashed(&[6.0, 4.0]));
    let entries = [view.chosen_hz.map(|_| impulsive), view.demodulated_hz.map(|_| demodulated)];
    let entries: Vec<_> = entries.into_iter().flatten().collect();
    let beside = size.width - SCALE_MARGIN * size.font;
    let top = legend(&mut picture, &entries, 12.0, beside, 2.0, size.font);
    // Over the head of the scale, which has room for half of the words.
    picture.text(Text::new(size.width, top + 2.0, size.font, Anchor::End, "spectral kurtosis,"));
    let [impulsive, demodulated] = [impulsive, demodulated].map(|entry| entry.1);
    picture.place(map(view, size, impulsive, demodulated), 0.0, top);
    picture.height = top + size.height;
    picture
}

fn map(view: &Kurtogram, size: Size, impulsive: Paint, demodulated: Paint) -> Picture {
    let rows = view.levels.len().max(1) as f64;
    let top = view.top();
    let mut chart = Chart::new(Spec {
        right: SCALE_MARGIN * size.font,
        ..Spec::new(
            "kurtogram",
            "Kurtogram",
            size,
            (Domain::exact(0.0, top.unwrap_or(1.0)), "Frequency", "Hz"),
            (Domain::exact(0.0, rows), "Level, upwards narrower bands", ""),
        )
    });
    let values = top.map(|top| view.rows(top)).unwrap_or_default();
    let (Some(top), Some((_, highest))) = (top, range(values.iter().copied())) else {
        chart.say("No kurtogram");
        return chart.finish();
    };
    let shades = Shades {
        columns: MOST_COLUMNS,
        values: &values,
        range: (0.0, highest.max(1.0)),
        ticks: 5,
        head: "0 for noise",
    };
    chart.shades(&shades);
    let frame = chart.frame;
    let x = |f: f64| frame.left + f / top * (frame.right - frame.left);
    if let Some((low, high)) = view.demodulated_hz.filter(|(low, high)| low.is_finite() && high.is_finite()) {
        let edge = |f: f64| vec![(x(f.clamp(0.0, top)), frame.top), (x(f.clamp(0.0, top)), frame.bottom)];
        let lines = vec![edge(low), edge(high)];
        chart.picture.shapes.push(Shape::Path { lines, close: false, paint: demodulated, clip: None });
    }
    let narrow = |l: &&Level| {
        let (low, high) = view.chosen_hz.unwrap_or((0.0, 0.0));
        ((high - low) / l.bandwidth - 1.0).abs() < 1e-6
    };
    if let Some((low, high)) = view.chosen_hz
        && let Some(level) = view.levels.iter().position(|l| narrow(&l))
        && high <= top * (1.0 + 1e-9)
    {
        let y = |row: f64| frame.bottom - row / rows * frame.height();
        let around = Rect { left: x(low), right: x(high), top: y(level as f64 + 1.0), bottom: y(level as f64) };
        chart.picture.rect(around, impulsive);
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
            demodulated_hz: Some((500.0, 3000.0)),
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
        assert!(with.contains("Most impulsive band") && with.contains("Band demodulated"));
    }

    #[test]
    fn prop_an_empty_map_says_so() {
        assert!(kurtogram(&Kurtogram::default(), Layout::Wide).svg().contains("No kurtogram"));
    }
}
