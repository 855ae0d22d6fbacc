//! Pressures over damage from above, where they are largest while a contact passes it.

use super::{DamageView, heading};
use crate::chart::{Chart, Domain, SCALE_MARGIN, Shades, Spec};
use crate::layout::{Layout, legend};
use crate::number::short;
use crate::picture::{Paint, Picture, Shape, ink};

/// Pressures on cells of one contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PressureView {
    /// What it shows.
    pub title: String,
    /// Which contact: "outer" or "inner".
    pub contact: String,
    /// (s, z) of the first cell's middle from the defect's centre, mm.
    pub start_mm: [f64; 2],
    /// Size of a cell along both axes, mm.
    pub step_mm: [f64; 2],
    /// Cells along s.
    pub columns: usize,
    /// Pressures, row by row of z, MPa.
    pub pressure_mpa: Vec<f64>,
    /// The largest.
    pub largest_mpa: f64,
    /// Its (s, z), mm.
    pub at_mm: [f64; 2],
    /// s of the contact's middle, mm.
    pub middle_mm: f64,
    /// Deformation of the contact, um.
    pub deformation_um: f64,
    /// Its force, N.
    pub force_n: f64,
    /// Largest pressure of the healthy contact at the same deformation.
    pub healthy_mpa: f64,
    /// Largest pressure of a smooth contact at which bearing steel begins to yield.
    pub yield_mpa: f64,
    /// Share of the pressed area beyond that.
    pub share_beyond_yield: f64,
    /// What to know.
    pub note: String,
}

impl PressureView {
    fn rows(&self) -> usize {
        self.pressure_mpa.len().checked_div(self.columns).unwrap_or(0)
    }

    /// What it is in single numbers: names, as files and Python have them, and values.
    pub fn numbers(&self) -> [(&'static str, f64); 7] {
        [
            ("largest_pressure_mpa", self.largest_mpa),
            ("contact_at_s_mm", self.middle_mm),
            ("deformation_um", self.deformation_um),
            ("force_n", self.force_n),
            ("healthy_pressure_mpa", self.healthy_mpa),
            ("yield_begins_at_mpa", self.yield_mpa),
            ("share_beyond_yield", self.share_beyond_yield),
        ]
    }

    /// Middles of the cells along s and z, mm.
    pub fn middles_mm(&self) -> [Vec<f64>; 2] {
        let middles = |axis: usize, cells: usize| {
            (0..cells).map(|k| self.start_mm[axis] + k as f64 * self.step_mm[axis]).collect()
        };
        [middles(0, self.columns), middles(1, self.rows())]
    }

    /// First and last edge of the cells along an axis, mm.
    fn span(&self, axis: usize) -> [f64; 2] {
        let cells = [self.columns, self.rows()][axis];
        [-0.5, cells as f64 - 0.5].map(|k| self.start_mm[axis] + k * self.step_mm[axis])
    }

    /// Edges (mm) between cells beyond yield and others.
    fn yield_edges(&self) -> Vec<[[f64; 2]; 2]> {
        let (columns, rows) = (self.columns as i64, self.rows() as i64);
        let beyond = |c: i64, r: i64| {
            let within = (0..columns).contains(&c) && (0..rows).contains(&r);
            within && self.yield_mpa.is_finite() && self.pressure_mpa[(r * columns + c) as usize] > self.yield_mpa
        };
        let corner = |c: i64, r: i64| {
            [
                self.start_mm[0] + (c as f64 - 0.5) * self.step_mm[0],
                self.start_mm[1] + (r as f64 - 0.5) * self.step_mm[1],
            ]
        };
        let mut edges = Vec::new();
        for (r, c) in (0..=rows).flat_map(|r| (0..=columns).map(move |c| (r, c))) {
            if beyond(c, r) != beyond(c - 1, r) {
                edges.push([corner(c, r), corner(c, r + 1)]);
            }
            if beyond(c, r) != beyond(c, r - 1) {
                edges.push([corner(c, r), corner(c + 1, r)]);
            }
        }
        edges
    }
}

/// Pressures with the damage's outline and the place of the largest; s to the right and z upwards, each to its own scale.
pub fn damage_pressure(view: &DamageView, of: &PressureView, index: usize, layout: Layout) -> Picture {
    let size = layout.size(if layout.roomy() { 340.0 } else { 280.0 });
    let name = match view.pressures.len() > 1 {
        true => format!("damage-{}-pressure-{}", index + 1, of.contact),
        false => format!("damage-{}-pressure", index + 1),
    };
    let domain = |axis: usize| {
        let [from, to] = of.span(axis);
        if to > from && (to - from).is_finite() { Domain::exact(from, to) } else { Domain::exact(-1.0, 1.0) }
    };
    let mut chart = Chart::new(Spec {
        right: SCALE_MARGIN * size.font,
        ..Spec::new(
            &name,
            &of.title,
            size,
            (domain(0), "s from the defect’s centre", "mm"),
            (domain(1), "Axial, z", "mm"),
        )
    });
    if of.rows() == 0 {
        chart.say("Nothing touches");
    } else {
        let rows: Vec<f64> = of.pressure_mpa.chunks_exact(of.columns).rev().flatten().copied().collect();
        let range = (0.0, if of.largest_mpa.is_finite() { of.largest_mpa.max(1.0) } else { 1.0 });
        chart.shades(&Shades { columns: of.columns, values: &rows, range, ticks: 6, head: "MPa" });
    }
    let clip = Some(chart.frame);
    let (x, y) = (chart.x, chart.y);
    let place = |p: &[f64; 2]| (x.at(p[0]), y.at(p[1]));
    let mut draw = |lines: &[Vec<(f64, f64)>], close: bool, paint: Paint| {
        let known = lines.iter().filter(|line| line.iter().all(|(x, y)| x.is_finite() && y.is_finite()));
        let lines = known.cloned().collect();
        chart.picture.shapes.push(Shape::Path { lines, close, paint, clip });
    };
    let outlines: Vec<Vec<(f64, f64)>> = view.polygons_mm.iter().map(|p| p.iter().map(place).collect()).collect();
    draw(&outlines, true, Paint::line("#ffffff", 3.4).faded(0.7));
    draw(&outlines, true, DAMAGE);
    let mut entries = vec![("damage".to_owned(), DAMAGE)];
    let edges: Vec<Vec<(f64, f64)>> = of.yield_edges().iter().map(|edge| edge.iter().map(place).collect()).collect();
    if !edges.is_empty() {
        draw(&edges, false, YIELD);
        entries.push((format!("beyond {} MPa", short(of.yield_mpa, 4)), YIELD));
    }
    if of.largest_mpa.is_finite() {
        let (x, y) = place(&of.at_mm);
        // A disc, as the legend has it.
        chart.picture.shapes.push(Shape::Circle { x, y, r: 3.5, paint: LARGEST });
        entries.push((format!("largest, {} MPa", short(of.largest_mpa, 4)), LARGEST));
    }
    let entries: Vec<(&str, Paint)> = entries.iter().map(|(words, paint)| (words.as_str(), *paint)).collect();
    let left = chart.frame.left;
    chart.under("", |picture| {
        let top = heading(picture, &of.title, left, size.width, size.font);
        top + legend(picture, &entries, left, size.width, top, size.font)
    })
}

const DAMAGE: Paint = Paint::line(ink::BLACK, 1.6);
const YIELD: Paint = Paint::line(ink::VERMILLION, 1.8);
const LARGEST: Paint = Paint::fill(ink::GREEN, 1.0);
