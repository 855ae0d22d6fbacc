//! The run in one picture.

use super::spectrum::envelope_of_size;
use super::waveform::waveform_of_size;
use crate::chart::{Size, left_margin, right_margin};
use crate::data::Signals;
use crate::font;
use crate::layout::Layout;
use crate::picture::{Anchor, Picture, Text, ink};

/// Where title and charts are.
struct Plan {
    width: f64,
    /// Of the title and of the line that follows it.
    type_sizes: [f64; 2],
    /// Of the charts.
    chart: Size,
    /// Where the first chart begins.
    top: f64,
    /// Whether the run's subtitle has a line of its own.
    below: bool,
}

/// Pixels of a file of 1400 x 700 for each of the drawing.
const SCALE: f64 = 1.5;

impl Plan {
    fn of(layout: Layout) -> Self {
        let Layout::Print(_) = layout else {
            return Self {
                width: 1400.0 / SCALE,
                type_sizes: [16.0, 13.0],
                chart: Size { width: 1400.0 / SCALE - 12.0, height: 0.5 * (700.0 / SCALE - 34.0), font: 12.5 },
                top: 32.0,
                below: false,
            };
        };
        let chart = layout.size(210.0);
        Self { width: chart.width, type_sizes: [chart.font + 1.0, chart.font], top: 40.0, below: true, chart }
    }
}

/// Waveform over envelope spectrum under the run's title: the run in one picture.
pub fn headline(run: &Signals, layout: Layout) -> Picture {
    let plan = Plan::of(layout);
    let Plan { width, chart, .. } = plan;
    let [large, small] = plan.type_sizes;
    let height = plan.top + 2.0 * chart.height + 2.0;
    let mut picture = Picture::new("headline", &run.title, width, height);
    let mut upper = waveform_of_size(run, chart);
    let mut lower = envelope_of_size(run, chart);
    if lower.spec.lanes.iter().any(|lane| lane.through) {
        lower.spec.lanes.retain(|lane| lane.through);
    }
    let left = left_margin(&upper.spec).max(left_margin(&lower.spec));
    let right = right_margin(&upper.spec).max(right_margin(&lower.spec));
    for plot in [&mut upper, &mut lower] {
        (plot.spec.left, plot.spec.right) = (left, right);
    }
    let (title_room, start) = match plan.below {
        true => (width - 16.0, 8.0),
        false => (0.45 * width, left),
    };
    let title = font::fitted(&run.title, large, true, title_room);
    let first = 1.5 * large;
    let (beside, second) = match plan.below {
        true => (start, first + 1.4 * small),
        false => (start + font::width(&title, large, true) + 14.0, first),
    };
    let room = match plan.below {
        true => width - 16.0,
        false => width - beside - 26.0,
    };
    let subtitle = font::fitted(&run.subtitle, small, false, room);
    picture.text(Text::new(start, first, large, Anchor::Start, &title).bold().color(ink::BLACK));
    picture.text(Text::new(beside, second, small, Anchor::Start, &subtitle));
    picture.place(upper.picture(), 0.0, plan.top);
    picture.place(lower.picture(), 0.0, plan.top + chart.height);
    picture
}
