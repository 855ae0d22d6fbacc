//! Outlines, depth maps, and damage that meets other damage.

use super::defects::MOST_ROLLERS;
use super::{Checker, short};
use crate::defect::{self, Fault};
use crate::document::{Problem, Severity};
use crate::scenario::{Defect, DepthGrid, Law, Shape};

const LENGTH: &str = "bearing.roller_length_mm";
const BALL: &str = "bearing.roller_diameter_mm";
/// A corner less than this beyond the roller's end, mm, is round-off.
const EDGE_SLACK: f64 = 1e-6;

fn at([s, z]: [f64; 2]) -> String {
    format!("s = {} mm, z = {} mm", short(1e3 * s), short(1e3 * z))
}

impl Checker<'_> {
    /// Path of one key of a shape.
    pub(super) fn shape_key(&self, i: usize, shape: &str, name: &str) -> String {
        format!("defects.{i}.shape.{shape}.{name}")
    }

    /// The key that holds an outline's polygons; `None` where what it holds could not be read or is ambiguous, which is
    /// then reported.
    fn polygons_key(&mut self, i: usize, shape: &str, polygons: &[Vec<[f64; 2]>]) -> Option<String> {
        let keys = ["points_mm", "polygons_mm"].map(|name| self.shape_key(i, shape, name));
        let given = keys.clone().map(|key| self.finder.value(&key));
        match given {
            [Some(_), Some(_)] => {
                self.error(
                    &keys[0],
                    "give points_mm or polygons_mm, not both".into(),
                    "one polygon, or a list of them".into(),
                    &[&keys[1]],
                );
                None
            }
            [None, None] => {
                self.error(
                    &keys[0],
                    "missing: the corners of one polygon, or polygons_mm for several".into(),
                    "points [s, z] in mm".into(),
                    &[&format!("defects.{i}.shape")],
                );
                None
            }
            [text, other] => {
                let key = keys[usize::from(text.is_none())].clone();
                let empty = text.or(other).is_some_and(|text| text.starts_with("[]"));
                // A list that came out empty and is not there as such was reported as unreadable.
                let unread = polygons.iter().all(Vec::is_empty) && !empty;
                (!unread).then_some(key)
            }
        }
    }

    pub(super) fn outline(&mut self, i: usize, defect: &Defect, shape: &str, polygons: &[Vec<[f64; 2]>]) {
        let Some(key) = self.polygons_key(i, shape, polygons) else {
            return;
        };
        let metres: Vec<Vec<[f64; 2]>> =
            polygons.iter().map(|p| p.iter().map(|x| x.map(|x| 1e-3 * x)).collect()).collect();
        let which = |polygon: usize| match polygons.len() {
            1 => "the outline".to_string(),
            _ => format!("polygon {}", polygon + 1),
        };
        for fault in defect::faults(&metres) {
            let (message, allowed) = match fault {
                Fault::Nothing => ("there is no polygon".into(), "one polygon or more"),
                Fault::Open { polygon } => (
                    format!("{} has fewer than three different corners and encloses nothing", which(polygon)),
                    "three corners or more; the last is joined to the first",
                ),
                Fault::NotFinite { polygon } => {
                    (format!("{} has a coordinate that is not a number", which(polygon)), "finite numbers")
                }
                Fault::Flat { polygon } => (
                    format!("{} has no area: its corners are on one line", which(polygon)),
                    "a polygon that encloses something",
                ),
                Fault::Tangled(tangle) => (tangle.to_string(), "sides that do not cross; fewer corners"),
                Fault::CrossesItself { polygon, at: p } => {
                    let message = format!(
                        "{} crosses itself at {}: what its sides enclose twice counts as undamaged (even-odd rule)",
                        which(polygon),
                        at(p)
                    );
                    let allowed = "sides that do not cross; several polygons for several spots";
                    self.warn(&key, message, allowed.into(), &[]);
                    continue;
                }
                Fault::Cross { polygons: [a, b], at: p } => {
                    let message = format!(
                        "polygons {} and {} cross at {}: where they overlap the surface counts as undamaged, as in a hole",
                        a + 1,
                        b + 1,
                        at(p)
                    );
                    self.warn(&key, message, "polygons apart or one within another".into(), &[]);
                    continue;
                }
            };
            self.error(&key, message, allowed.into(), &[]);
        }
        if shape == "outline"
            && let Some(outline) = defect::Outline::new(metres)
        {
            self.on_raceway(i, defect, &key, outline.heights());
        }
    }

    /// How far a ball reaches along z, mm, where damage (mm) lies wholly beyond: the groove's width is not known, and no
    /// groove is wider than its ball.
    fn beyond_ball(&self, (low, high): (f64, f64)) -> Option<f64> {
        let radius = 0.5 * self.s.bearing.roller_diameter_mm;
        (self.s.bearing.has_balls() && (low >= radius || high <= -radius)).then_some(radius)
    }

    /// Damage beyond the roller's ends, given its smallest and largest z in m before it is moved.
    pub(super) fn on_raceway(&mut self, i: usize, defect: &Defect, key: &str, (low, high): (f64, f64)) {
        let half = 0.5 * self.s.bearing.axial_reach_mm();
        let offset = defect.axial_offset_mm;
        let (low, high) = (1e3 * low + offset, 1e3 * high + offset);
        if let Some(touched) = self.beyond_ball((low, high)) {
            let message = format!(
                "no ball can touch this damage: z from {} to {} mm, and a ball reaches from -{2} to {2} mm",
                short(low),
                short(high),
                short(touched)
            );
            if offset != 0.0 {
                self.moved_off(i, message, (low - offset, high - offset, touched), &[key, BALL]);
            } else {
                self.error(
                    key,
                    message,
                    format!("damage that reaches into z from -{0} to {0} mm", short(touched)),
                    &[BALL],
                );
            }
            return;
        }
        // What an offset carries over the edge is left out, as long as anything stays.
        if offset != 0.0 && low < half && high > -half {
            if low < -half - EDGE_SLACK || high > half + EDGE_SLACK {
                self.warn(
                    &format!("defects.{i}.axial_offset_mm"),
                    format!(
                        "moves damage off the raceway's edge: z from {} to {} mm; the roller covers -{2} to {2} mm and what is beyond is left out",
                        short(low),
                        short(high),
                        short(half)
                    ),
                    String::new(),
                    &[LENGTH],
                );
            }
            return;
        }
        if low < -half - EDGE_SLACK || high > half + EDGE_SLACK {
            let covers = |hint: &str| {
                format!(
                    "off the raceway's edge: z from {} to {} mm, and the roller covers -{2} to {2} mm{hint}",
                    short(low),
                    short(high),
                    short(half)
                )
            };
            // Here nothing is left of what was moved.
            if offset != 0.0 {
                self.moved_off(i, covers(""), (low - offset, high - offset, half), &[key, LENGTH]);
            } else if low < half && high > -half && high - low <= MOST_ROLLERS * 2.0 * half {
                self.warn(key, covers("; what is beyond is left out"), String::new(), &[LENGTH]);
            } else {
                let message = covers(hint_of_scale(high - low, 2.0 * half));
                self.error(key, message, format!("z from -{0} to {0} mm", short(half)), &[LENGTH]);
            }
        }
    }

    /// Damage from `low` to `high` that its offset moves out of -`reach` to `reach`, all in mm.
    fn moved_off(&mut self, i: usize, message: String, (low, high, reach): (f64, f64, f64), also: &[&str]) {
        let allowed = format!("above {} and below {}", short(-reach - high), short(reach - low));
        self.error(&format!("defects.{i}.axial_offset_mm"), message, allowed, also);
    }

    pub(super) fn grown(&mut self, i: usize, defect: &Defect) {
        let Shape::Grown { outline, max_width_mm, area_mm2 } = &defect.shape else {
            return;
        };
        self.outline(i, defect, "grown", outline);
        let [width, area] = ["max_width_mm", "area_mm2"].map(|name| self.shape_key(i, "grown", name));
        match (max_width_mm, area_mm2) {
            (Some(_), Some(_)) => {
                self.error(&width, "give max_width_mm or area_mm2, not both".into(), "one of them".into(), &[&area])
            }
            (None, None) => self.error(
                &width,
                "missing: the width to grow to, or area_mm2".into(),
                "one of them".into(),
                &[&format!("defects.{i}.shape")],
            ),
            _ => {
                let key = if max_width_mm.is_some() { width } else { area };
                let depth = 1e-6 * defect.depth_um;
                if let Some(defect::Shape::Outline(grown)) = defect::Shape::new(&defect.shape, depth) {
                    self.on_raceway(i, defect, &key, grown.heights());
                }
            }
        }
    }

    pub(super) fn depth_map(&mut self, i: usize, defect: &Defect, grid: &DepthGrid) {
        for name in ["missing", "radius_mm"] {
            let key = self.shape_key(i, "depth_map", name);
            if self.finder.is_given(&key) {
                let message = "has a meaning only where there is a `file`".into();
                self.error(&key, message, String::new(), &[]);
            }
        }
        let key = self.shape_key(i, "depth_map", "depth_um");
        let text = self.finder.value(&key);
        if text.is_none() || (grid.depth_um.is_empty() && text.as_deref() != Some("[]")) {
            return;
        }
        if grid.columns == 0 || grid.rows == 0 {
            return;
        }
        let Some(map) = self.depths(i, &key, grid) else {
            return;
        };
        self.raised_edges(&key, &map);
        self.depth_map_on_raceway(i, defect, (&key, grid), &map);
    }

    /// The depths as a grid, where there is one for each node and damage among them.
    fn depths(&mut self, i: usize, key: &str, grid: &DepthGrid) -> Option<defect::Grid> {
        let (columns, rows, count) = (grid.columns, grid.rows, grid.depth_um.len());
        let sizes = ["columns", "rows"].map(|name| self.shape_key(i, "depth_map", name));
        let also = [sizes[0].as_str(), sizes[1].as_str()];
        if count != columns.saturating_mul(rows) {
            self.error(
                key,
                format!("{count} depths for {columns} columns and {rows} rows"),
                format!("a list of {} numbers", columns.saturating_mul(rows)),
                &also,
            );
            return None;
        }
        if let Some(hole) = grid.depth_um.iter().position(|h| !h.is_finite()) {
            self.error(
                key,
                format!("no depth in row {}, column {}", hole / columns + 1, hole % columns + 1),
                "a finite number at every node; 0 where nothing is damaged".into(),
                &[],
            );
            return None;
        }
        let map = defect::Grid::new(grid);
        if map.is_none() && grid.depth_um.iter().all(|h| *h == 0.0) {
            self.error(
                key,
                "every depth is 0: there is no damage".into(),
                "a depth other than 0 somewhere".into(),
                &[],
            );
        }
        map
    }

    /// What rises above the raceway, where it would not act, and where it would hold an element fast.
    fn raised_edges(&mut self, key: &str, map: &defect::Grid) {
        let highest = -1e6 * map.extremes().1;
        let b = &self.s.bearing;
        // Under the static load rating both contacts of an element give way by 0.3 to 0.7 % of its diameter.
        let most = 2.0 * (b.radial_clearance_um + b.outer_gap_um).max(0.0) + 7e-3 * (1e3 * b.roller_diameter_mm);
        if highest > 0.0 && self.s.contact.law == Law::Ecl {
            self.error(
                key,
                format!("raised edges (the highest {} um) act only in contact.law = \"half-space\"", short(highest)),
                ">= 0".into(),
                &["contact.law", "simulation.model"],
            );
        } else if highest > most {
            self.error(
                key,
                format!(
                    "edges raised by {} um never let an element go: the clearance and both contacts give way by less",
                    short(highest)
                ),
                format!(">= -{} um, the clearance and 0.7 % of the element's diameter", short(most)),
                &["bearing.radial_clearance_um", "bearing.roller_diameter_mm"],
            );
        }
    }

    fn depth_map_on_raceway(&mut self, i: usize, defect: &Defect, (key, grid): (&str, &DepthGrid), map: &defect::Grid) {
        let half = 0.5 * self.s.bearing.axial_reach_mm();
        let (low, high) = map.heights();
        let offset = defect.axial_offset_mm;
        let (low, high) = (1e3 * low + offset, 1e3 * high + offset);
        if low >= half || high <= -half || self.beyond_ball((low, high)).is_some() {
            self.on_raceway(i, defect, key, map.heights());
        } else if low < -half - grid.dz_mm || high > half + grid.dz_mm {
            self.warn(
                key,
                format!(
                    "damage from z = {} to {} mm goes off the raceway's edge; the roller covers -{3} to {3} mm and what is beyond is left out{2}",
                    short(low),
                    short(high),
                    hint_of_scale(high - low, 2.0 * half),
                    short(half)
                ),
                String::new(),
                &[LENGTH],
            );
        }
    }

    /// Depths that no raceway has: more than the roller's diameter, down or up.
    pub(super) fn depth_scale(&mut self, i: usize, defect: &Defect) {
        let most = 1e3 * self.s.bearing.roller_diameter_mm;
        let (key, depths) = match &defect.shape {
            Shape::DepthMap { grid } => (self.shape_key(i, "depth_map", "depth_um"), &grid.depth_um[..]),
            Shape::Profile { depth_um: Some(depths), .. } => (self.shape_key(i, "profile", "depth_um"), &depths[..]),
            _ => (format!("defects.{i}.depth_um"), std::slice::from_ref(&defect.depth_um)),
        };
        let deepest = depths.iter().fold(0.0, |m: f64, h| m.max(h.abs()));
        if deepest > most {
            self.error(
                &key,
                format!("{} um is more than the roller's diameter; lengths in nm instead of um?", short(deepest)),
                format!("<= {} um", short(most)),
                &["bearing.roller_diameter_mm"],
            );
        }
    }

    /// Damage that overlaps on one surface of one row.
    pub(super) fn overlaps(&mut self) {
        let s = self.s;
        let placed: Vec<(f64, f64, f64)> = s
            .defects
            .iter()
            .map(|d| {
                let depth = 1e-6 * d.depth_um;
                let arc = defect::Shape::new(&d.shape, depth).map_or((0.0, 0.0), |x| x.arc());
                let radius = 0.5e-3 * s.bearing.diameter_mm(d.on);
                (d.center_deg.to_radians(), arc.0 / radius, arc.1 / radius)
            })
            .collect();
        let rule = match s.contact.law {
            Law::HalfSpace => "together they are one surface, the deeper of the two at each point",
            Law::Ecl => "of the two the one that carries less acts: the deeper or wider",
        };
        for (i, a) in s.defects.iter().enumerate() {
            for (j, b) in s.defects[..i].iter().enumerate() {
                let ((ca, a0, a1), (cb, b0, b1)) = (placed[i], placed[j]);
                // From the middle of one arc to the middle of the other, the short way round.
                let apart = defect::wrap(ca + 0.5 * (a0 + a1) - cb - 0.5 * (b0 + b1)).abs();
                let meet = apart < 0.5 * (a1 - a0 + b1 - b0);
                let unread = a.shape.file().or(b.shape.file()).is_some();
                if a.on != b.on || a.row != b.row || !meet || unread {
                    continue;
                }
                let finder = self.finder;
                if let Some(k) = [i, j].into_iter().find(|k| self.s.defects[*k].table.is_some()) {
                    let (key, other) = (format!("defects.{k}.table"), format!("defects.{}", i + j - k));
                    self.error(
                        &key,
                        format!("overlaps defect {} along s, and a table from a file is of one surface", i + j - k + 1),
                        "one table of both, or damage that lies apart".into(),
                        &[&other],
                    );
                    continue;
                }
                self.problems.add_of(Severity::Warning, "overlaps", || {
                    let (key, other) = (format!("defects.{i}"), format!("defects.{j}"));
                    let message = format!("overlaps defect {} along s; {rule}", j + 1);
                    let problem = Problem::new(Severity::Warning, key, message);
                    (finder.complete(problem, &[&other]), None)
                });
            }
        }
    }
}

/// A guess at what is wrong with an extent that is many times the roller.
fn hint_of_scale(extent: f64, roller: f64) -> &'static str {
    if extent > 100.0 * roller { "; lengths in um instead of mm?" } else { "" }
}
