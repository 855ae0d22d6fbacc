//! Orbits of the cages' centres.

use crate::chart::{Chart, Domain, Size, Spec, left_margin, range, right_margin};
use crate::font;
use crate::layout::{Layout, legend};
use crate::picture::{Anchor, Paint, Picture, Text, ink};

/// Paths of the cages' centres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CageOrbits {
    /// The cages.
    pub rows: Vec<CageOrbit>,
    /// How far a cage can go before it touches its land, where it has one.
    pub clearance_um: Option<f64>,
    /// What is shown, as a sentence.
    pub note: String,
}

/// The way of one cage's centre; vectors are of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CageOrbit {
    /// "Cage of row 1".
    pub title: String,
    /// Along X.
    pub x_um: Vec<f64>,
    /// Along Y.
    pub y_um: Vec<f64>,
    /// How many points at the end make up the last turn of the cage.
    pub last_turn: usize,
}

const EARLIER: Paint = Paint::line(ink::SKY, 0.9);
const LAST: Paint = Paint::line(ink::BLUE, 1.8);

fn land() -> Paint {
    Paint::line(ink::VERMILLION, 1.4).dashed(&[6.0, 3.0])
}

/// Points drawn of a part of the way, at most.
const MOST: usize = 2048;

/// A square a cage, both axes to one scale.
pub fn cage_orbit(orbits: &CageOrbits, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let (cell, places) = layout.grid(orbits.rows.len(), 440.0);
    let finite = |row: &CageOrbit| -> Vec<(f64, f64)> {
        let points = row.x_um.iter().copied().zip(row.y_um.iter().copied());
        points.filter(|(x, y)| x.is_finite() && y.is_finite()).collect()
    };
    let rows: Vec<Vec<(f64, f64)>> = orbits.rows.iter().map(finite).collect();
    let farthest = range(rows.iter().flatten().map(|(x, y)| x.hypot(*y))).map_or(0.0, |r| r.1);
    let clearance = orbits.clearance_um.filter(|c| c.is_finite() && *c > 0.0);
    // An orbit that stays near the middle is shown large, without the land.
    let seen = clearance.filter(|c| farthest > 0.2 * c);
    let reach = 1.06 * farthest.max(seen.unwrap_or(0.0));
    let reach = if reach > 0.0 { reach } else { 1.0 };

    let mut picture = Picture::new("cage-orbit", "Orbit of the cages’ centres", size.width, 0.0);
    let mut entries = vec![("last turn of the cage", LAST), ("turns before it", EARLIER)];
    let words = clearance.map(|c| {
        let c = crate::number::significant(c, 3);
        match seen {
            Some(_) => format!("land, {c} µm from the centre"),
            None => format!("land: {c} µm from the centre, beyond this picture"),
        }
    });
    if let Some(words) = &words {
        entries.push((words, land()));
    }
    let top = legend(&mut picture, &entries, 12.0, size.width - 12.0, 2.0, size.font);
    let mut height = 0.0f64;
    for ((row, points), (left, line)) in orbits.rows.iter().zip(&rows).zip(places) {
        let (chart, tall) = orbit_chart(row, points, (reach, seen), (cell, size));
        let down = top + line * tall;
        let title = font::fitted(&row.title, size.font, true, cell);
        let middle = left + 0.5 * (chart.frame.left + chart.frame.right);
        let at = down + 1.1 * size.font;
        picture.text(Text::new(middle, at, size.font, Anchor::Middle, &title).bold());
        picture.place(chart.finish(), left, down + 1.4 * size.font);
        height = height.max(down + tall);
    }
    picture.height = height.max(top);
    picture
}

/// One cage's orbit, with the land (um) where it is `seen`, and the height that it takes with its title, px.
fn orbit_chart(
    row: &CageOrbit,
    points: &[(f64, f64)],
    (reach, seen): (f64, Option<f64>),
    (cell, size): (f64, Size),
) -> (Chart, f64) {
    let mut spec = Spec::new(
        "",
        "",
        Size { width: cell, ..size },
        (Domain::exact(-reach, reach), "X", "µm"),
        (Domain::exact(-reach, reach), "Y", "µm"),
    );
    // What numbers and labels leave of the width is the side of the square.
    spec.size.height = cell;
    let side = cell - left_margin(&spec) - right_margin(&spec);
    spec.size.height = side + 8.0 + 3.4 * size.font;
    let tall = spec.size.height + 2.0 * size.font;
    let mut chart = Chart::new(spec);
    if points.is_empty() {
        chart.say("Not recorded");
    } else {
        chart.of(&row.title);
        let (xs, ys) = points.iter().copied().unzip();
        chart.keep("", xs, ys);
    }
    let turn = points.len().saturating_sub(row.last_turn.max(1));
    let before = &points[..(turn + 1).min(points.len())];
    for (part, paint) in [(before, EARLIER), (&points[turn..], LAST)] {
        // A loop visits a column of pixels again and again, so nothing is thinned.
        let line = part
            .iter()
            .step_by(part.len().div_ceil(MOST).max(1))
            .map(|(x, y)| (chart.x.at(*x), chart.y.at(*y)))
            .collect::<Vec<_>>();
        if line.len() > 1 {
            chart.picture.path(&line, paint);
        }
    }
    if let Some(c) = seen {
        let circle: Vec<(f64, f64)> = (0..=120)
            .map(|k| (f64::from(k) * 3.0).to_radians().sin_cos())
            .map(|(sin, cos)| (chart.x.at(c * cos), chart.y.at(c * sin)))
            .collect();
        chart.picture.path(&circle, land());
    }
    (chart, tall)
}
