//! Defects where they are on their surfaces: which contacts they meet, and at which angle.

use super::angles::{Angles, wrap};
use super::envelope::envelope;
use super::piecewise::PiecewisePolynomial;
use super::shape::Shape;
use crate::contact::{ContactReduction, remaining_share};
use crate::contact::{SIDES, Side};
use crate::effective::{Table, Tilted};
use crate::scenario::{self, Element, Law, RollerPath, Surface};
use std::f64::consts::PI;
use std::sync::Arc;

/// Relative radius of curvature R_eq (m) of a roller of radius r on a raceway: 1/R_eq = 1/r - 1/R_o at the outer one,
/// 1/r + 1/R_i at the inner one.
pub fn relative_radius(bearing: &scenario::Bearing, side: Side) -> f64 {
    let roller = 2e3 / bearing.roller_diameter_mm;
    match side {
        Side::Outer => 1.0 / (roller - 2e3 / bearing.outer_raceway_diameter_mm),
        Side::Inner => 1.0 / (roller + 2e3 / bearing.inner_raceway_diameter_mm),
    }
}

/// Whether damage of a surface meets rolling elements on `side`.
#[inline]
fn meets(surface: Surface, side: Side) -> bool {
    match surface {
        Surface::OuterRaceway => side == Side::Outer,
        Surface::InnerRaceway => side == Side::Inner,
        Surface::Roller(_) => true,
    }
}

/// Local angles (rad) of what lies between two s (m) on a surface of a radius (m), a little wider, so that round-off decides in
/// `floor` alone.
fn angles_between([first, last]: [f64; 2], radius: f64) -> (f64, f64) {
    (first / radius - 1e-9, last / radius + 1e-9)
}

/// One defect on its surface, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Defect {
    /// What rolls over it.
    pub element: Element,
    /// Damaged surface; a roller counts from 0 here.
    pub surface: Surface,
    /// Row, from 0.
    pub row: usize,
    /// psi, rad.
    pub center: f64,
    /// h, m, where the shape has no depths of its own.
    pub depth: f64,
    /// Outline, where it lies.
    pub shape: Shape,
    /// z of the middle of a shape that is a width alone, m; outlines and depth maps have been moved instead.
    pub middle: f64,
    /// R of the surface, m.
    pub radius: f64,
    /// L of the roller, m; of a ball more than its groove is wide.
    pub roller_length: f64,
    /// delta_eff by side, under `half-space`; none where another defect's table holds this one too.
    tables: [Option<Arc<Table>>; 2],
    /// The same over tilt, where rollers tilt.
    tilted: [Option<Arc<Tilted>>; 2],
    /// The law `ecl`: depth along the path where that is the envelope, and under balls, of which the lumped model knows the groove's
    /// bottom alone.
    floors: [Option<PiecewisePolynomial>; 2],
    /// Local angles (rad) beyond which neither arc nor profile reaches, by side.
    windows: [(f64, f64); 2],
}

impl Defect {
    /// All defects of a scenario.
    ///
    /// # Errors
    /// The first of which [`Self::new`] would make none.
    pub fn all(
        defects: &[scenario::Defect],
        bearing: &scenario::Bearing,
        contact: &scenario::Contact,
    ) -> Result<Vec<Self>, usize> {
        defects.iter().enumerate().map(|(k, defect)| Self::new(defect, bearing, contact).ok_or(k)).collect()
    }

    /// From the scenario. `None` where its shape makes no sense, or its row or roller counts from 0.
    pub fn new(defect: &scenario::Defect, bearing: &scenario::Bearing, contact: &scenario::Contact) -> Option<Self> {
        // No `..`: a key that is added is used, or its `_` says who reads it.
        let scenario::Defect { on, row, center_deg, depth_um, axial_offset_mm, shape, table: _ /* Model */ } = defect;
        let surface = match *on {
            Surface::Roller(k) => Surface::Roller(k.checked_sub(1)?),
            raceway => raceway,
        };
        let depth = 1e-6 * depth_um;
        let roller_length = 1e-3 * bearing.axial_reach_mm();
        let offset = 1e-3 * axial_offset_mm;
        let shape = Shape::new(shape, depth)?.placed(offset, roller_length);
        let middle = if shape.is_width() { offset } else { 0.0 };
        let floors = SIDES.map(|side| {
            if contact.law != Law::Ecl || !meets(surface, side) {
                return None;
            }
            let lines = match bearing.element {
                Element::Roller => shape.depths(depth),
                Element::Ball => shape.depths_at_bottom(depth, middle),
            };
            match (contact.roller_path, bearing.element) {
                (RollerPath::Envelope, _) => Some(envelope(&lines, relative_radius(bearing, side))),
                (RollerPath::Point, Element::Ball) => Some(PiecewisePolynomial::of_lines(&lines)),
                (RollerPath::Point, Element::Roller) => None,
            }
        });
        let radius = 0.5e-3 * bearing.diameter_mm(surface);
        Some(Self {
            windows: [angles_between(shape.arc().into(), radius); 2],
            element: bearing.element,
            surface,
            row: row.checked_sub(1)?,
            center: center_deg.to_radians(),
            depth,
            shape,
            middle,
            radius,
            roller_length,
            tables: [None, None],
            tilted: [None, None],
            floors,
        })
    }

    /// delta_eff under `side`, where this defect has a table.
    #[inline]
    pub fn table(&self, side: Side) -> Option<&Arc<Table>> {
        self.tables[side as usize].as_ref()
    }

    /// The same where the contact tilts.
    #[inline]
    pub fn tilted(&self, side: Side) -> Option<&Arc<Tilted>> {
        self.tilted[side as usize].as_ref()
    }

    /// Lets damage act by this table at its contacts on one side.
    pub(crate) fn use_table_at(&mut self, side: Side, table: Arc<Table>) {
        let k = side as usize;
        if self.meets_side(side) {
            self.windows[k] = angles_between(table.range_s(), self.radius);
            self.tables[k] = Some(table);
        }
    }

    /// The same where the contact tilts; `upright` is that without tilt.
    pub(crate) fn use_tilted_at(&mut self, side: Side, upright: Arc<Table>, tables: Tilted) {
        self.use_table_at(side, upright);
        let k = side as usize;
        if self.meets_side(side) {
            self.windows[k] = angles_between(tables.range_s(), self.radius);
            self.tilted[k] = Some(Arc::new(tables));
        }
    }

    /// Whether the defect meets rolling elements on `side`.
    #[inline]
    pub fn meets_side(&self, side: Side) -> bool {
        meets(self.surface, side)
    }

    /// Lowest and highest z, m.
    pub fn heights(&self) -> [f64; 2] {
        self.shape.heights(self.middle)
    }

    /// Whether the defect meets roller `roller` (from 0) of row `row` on `side` at all.
    pub fn meets(&self, row: usize, roller: usize, side: Side) -> bool {
        let is_on_another = matches!(self.surface, Surface::Roller(k) if k != roller);
        self.row == row && self.meets_side(side) && !is_on_another
    }

    /// Local angle u of a roller on `side`, rad.
    #[inline]
    pub fn local_angle(&self, angles: &Angles, side: Side) -> f64 {
        let Angles { orbit, spin, ring } = *angles;
        wrap(match (self.surface, side) {
            (Surface::OuterRaceway, _) => orbit - self.center,
            (Surface::InnerRaceway, _) => orbit - self.center - ring,
            (Surface::Roller(_), Side::Outer) => orbit - spin - self.center,
            (Surface::Roller(_), Side::Inner) => orbit + PI - spin - self.center,
        })
    }

    /// Local angles (rad) beyond which the defect never meets a roller on `side`.
    pub fn window(&self, side: Side) -> (f64, f64) {
        self.windows[side as usize]
    }

    /// Angles of a roller whose contact on a side is at the angle u (rad) from the damage's centre, at rest.
    pub fn met_at(&self, side: Side, u: f64) -> Angles {
        // A roller's damage meets the inner raceway half a turn after the outer one.
        let half_turn = match (self.surface, side) {
            (Surface::Roller(_), Side::Inner) => PI,
            _ => 0.0,
        };
        Angles { orbit: self.center + u - half_turn, spin: 0.0, ring: 0.0 }
    }

    /// L_s at the arc coordinate s (m): the covered z within the roller's length; 0 off the damage.
    #[inline]
    pub fn damaged_length(&self, s: f64) -> f64 {
        let (first, last) = self.shape.arc();
        if s < first || s > last {
            return 0.0;
        }
        let length = self.shape.damaged_length(s);
        if self.middle == 0.0 {
            return length.clamp(0.0, self.roller_length);
        }
        let end = 0.5 * self.roller_length;
        let [from, to] = [-0.5, 0.5].map(|side| (self.middle + side * length).clamp(-end, end));
        (to - from).max(0.0)
    }

    /// Area seen from above, within the roller's length, m^2; outlines and depth maps are cut to it where they are made.
    pub fn area(&self) -> f64 {
        self.shape.area_where(|s| self.damaged_length(s))
    }

    /// h_s at the arc coordinate s (m) on the damage, before any envelope.
    #[inline]
    pub fn depth_at(&self, s: f64) -> f64 {
        self.shape.own_depth(s).unwrap_or(self.depth)
    }

    /// Depth of the damage, and depth to which a roller can sink into it that meets it with the relative radius
    /// `radius` (m): the largest of h_s and of its envelope (section 3), m.
    pub fn reach(&self, radius: f64) -> (f64, f64) {
        let floor = self.shape.depths(self.depth);
        (PiecewisePolynomial::of_lines(&floor).largest(), envelope(&floor, radius).largest())
    }

    /// Depth of its deepest point, m.
    pub fn deepest(&self) -> f64 {
        match &self.shape {
            Shape::DepthMap(grid) => grid.extremes().0,
            _ => self.reach(self.radius).0,
        }
    }

    /// What the damage leaves at the local angle u under the law `ecl`; `None` outside its arc.
    ///
    /// Along an envelope L_s stays that of the point under the contact line and h_s is replaced by its envelope, which
    /// comes up to 0 at both ends of the arc: the force is continuous there, and the floor starts where the damage
    /// does.
    #[inline]
    pub fn floor(&self, u: f64, side: Side) -> Option<ContactReduction> {
        let s = u * self.radius;
        let (first, last) = self.shape.arc();
        if s < first || s > last {
            return None;
        }
        let damaged_length = self.damaged_length(s);
        Some(ContactReduction {
            share: remaining_share(self.roller_length, damaged_length),
            depth: match &self.floors[side as usize] {
                Some(floor) => floor.value(s).max(0.0),
                None => self.depth_at(s),
            },
            damaged_length,
        })
    }
}

/// Defects that may be under one side of a roller.
#[derive(Debug, Clone, Copy)]
pub struct Defects<'a> {
    among: &'a [Defect],
    which: Which,
    pub(super) side: Side,
}

#[derive(Debug, Clone, Copy)]
enum Which {
    All,
    /// What meets a roller: row and roller, from 0.
    Under(usize, usize),
    /// What is on a surface of a row.
    On(Surface, usize),
}

impl<'a> Defects<'a> {
    /// All of `among`.
    pub fn all(among: &'a [Defect], side: Side) -> Self {
        Self { among, which: Which::All, side }
    }

    /// One alone.
    pub fn one(defect: &'a Defect, side: Side) -> Self {
        Self::all(std::slice::from_ref(defect), side)
    }

    /// Of `among` those that meet roller `roller` of row `row`, both from 0.
    #[inline]
    pub(crate) fn under(among: &'a [Defect], (row, roller): (usize, usize), side: Side) -> Self {
        Self { among, which: Which::Under(row, roller), side }
    }

    /// Of `among` those on the surface of `one`.
    pub(crate) fn beside(among: &'a [Defect], one: &Defect, side: Side) -> Self {
        Self { among, which: Which::On(one.surface, one.row), side }
    }

    #[inline]
    pub(crate) fn iter(self) -> impl Iterator<Item = &'a Defect> + Clone {
        self.among.iter().filter(move |d| match self.which {
            Which::All => true,
            Which::Under(row, roller) => d.meets(row, roller, self.side),
            Which::On(surface, row) => d.surface == surface && d.row == row,
        })
    }
}
