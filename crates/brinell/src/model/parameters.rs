//! The parameters of a model, and what follows from them alone.

use super::broad_phase::BroadPhase;
use super::custom::Custom;
use super::geometry::{Geometry, Inertia, Support};
use super::layout::Layout;
use super::stable_steps::StableSteps;
use super::tilt::Tilt;
use crate::bearing::kinematics::{self, Kinematics};
use crate::cage::{Guide, Pocket};
use crate::contact::film::SqueezeFilm;
use crate::contact::{Damping, LoadDeflection, Place};
use crate::defect::{Defect, Defects, Side};
use crate::friction::Friction;
use crate::lanes::Column;
use crate::operation::{Load, Rotation};
use crate::scenario::{Element, Guidance, Law, LoadOn, ModelKind, Start};
use crate::slices::{Healthy, Slices};
use crate::waviness::Waviness;

/// The ring with the cages' land among the coordinates.
#[derive(Debug, Clone, Copy)]
pub struct Land<'a> {
    at: usize,
    /// Its slope among the coordinates, and Z_i of the rows.
    tilt: Option<(usize, &'a [f64])>,
}

impl Land<'_> {
    /// x and y of the ring's centre at the middle of `row`, of positions or of their rates.
    #[inline(always)]
    pub fn centre(&self, row: usize, of: &[f64]) -> [f64; 2] {
        let x = [of[self.at], of[self.at + 1]];
        match self.tilt {
            None => x,
            Some((slope, levers)) => [0, 1].map(|k| x[k] + levers[row] * of[slope + k]),
        }
    }
}

/// One bearing under one operation: everything that does not change while it runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Which equations hold.
    pub kind: ModelKind,
    /// Rollers or balls.
    pub element: Element,
    /// State layout.
    pub layout: Layout,
    /// Geometry.
    pub geometry: Geometry,
    /// Masses.
    pub inertia: Inertia,
    /// Law of the inner contacts.
    pub inner_contact: LoadDeflection,
    /// Law of the outer contacts.
    pub outer_contact: LoadDeflection,
    /// Law of both contacts in series, damping c/2 (section 10).
    pub series_contact: LoadDeflection,
    /// Longest steps of the solver by the largest contact force.
    pub(super) stable_steps: StableSteps,
    /// Whether levers and rates are those of displaced bodies (section 18), or the centred bearing's.
    pub exact: bool,
    /// Raceway friction.
    pub friction: Friction,
    /// Drag of a roller, kg/m.
    pub drag: f64,
    /// Films of open contacts, indexed by `Side as usize`, where there are any.
    pub film: Option<[SqueezeFilm; 2]>,
    /// Pockets.
    pub pocket: Pocket,
    /// Guiding ring.
    pub guidance: Guidance,
    /// Film and land.
    pub guide: Guide,
    /// Support of the inner ring.
    pub inner_support: Support,
    /// Support of the outer ring.
    pub outer_support: Support,
    /// The inner ring's rotation.
    pub rotation: Rotation,
    /// The load.
    pub load: Load,
    /// g, m/s^2.
    pub gravity: [f64; 2],
    /// alpha of each slot, rad: the pocket's angle on its cage.
    pub pocket_angle: Column,
    /// sin alpha and cos alpha of each slot.
    pub(crate) pocket_direction: [Column; 2],
    /// 1 for the slots of rollers, 0 for padding.
    pub roller_mask: Column,
    /// Gap of each slot's contact where all is centred, m, by side; so wide for padding that it never closes.
    pub(crate) gaps: [Column; 2],
    /// C_p of each slot, m; so wide for padding that it never closes.
    pub(crate) pocket_gap: Column,
    /// 1/C_p of each slot, 1/m.
    pub(crate) per_pocket_gap: Column,
    /// Damage.
    pub defects: Vec<Defect>,
    /// Where damage can meet the contacts of each side, indexed by `Side as usize`.
    pub broad_phase: [BroadPhase; 2],
    /// For each row, over one period of the rows' pattern: 1 for its own slots, else 0.
    pub(crate) row_lanes: Vec<Column>,
    /// Law of contacts on damage.
    pub law: Law,
    /// Waviness, where any surface has it.
    pub waviness: Option<Waviness>,
    /// The slices, where each counts by itself: where rollers tilt or have a profile.
    pub slices: Option<Slices>,
    /// What tilts, where anything does.
    pub tilt: Option<Tilt>,
    /// Start.
    pub start: Start,
    /// What the user's program adds.
    pub custom: Custom,
    /// Where that has a contact law: the contacts of either side that statics and the longest step are for.
    pub(super) usual: Option<[Place; 2]>,
}

impl Model {
    /// The same bearing before it was damaged, for statics: where damage was looked for stays.
    pub(crate) fn without_damage(&self) -> Self {
        Self { defects: Vec::new(), ..self.clone() }
    }

    /// Law of the contacts on `side`.
    #[inline]
    pub fn contact(&self, side: Side) -> &LoadDeflection {
        match side {
            Side::Inner => &self.inner_contact,
            Side::Outer => &self.outer_contact,
        }
    }

    /// The healthy contact on `side`.
    #[inline]
    pub fn healthy(&self, side: Side) -> Healthy<'_> {
        Healthy { law: self.contact(side), slices: self.slices.as_ref(), length: self.geometry.roller_length }
    }

    /// Whether no force jumps: nothing is damped before it is pressed.
    pub(crate) fn has_smooth_forces(&self) -> bool {
        matches!(self.outer_contact.damping, Damping::Time { .. })
            && self.pocket.wall.is_some()
            && self.law == Law::HalfSpace
    }

    /// Whether anything on a surface pushes rollers along it: damage by its table, waves, or a law of the user's own.
    pub(crate) fn pushes(&self) -> bool {
        self.waviness.is_some()
            || self.custom.contact.is_some()
            || (self.law == Law::HalfSpace && !self.defects.is_empty())
    }

    /// Defects that meet the contact of `slot` on `side`.
    #[inline]
    pub fn defects_of(&self, slot: usize, side: Side) -> Defects<'_> {
        Defects::under(&self.defects, (self.layout.row(slot), self.layout.roller(slot)), side)
    }

    /// Pure-rolling orbit speed at the inner ring's speed w_i, rad/s.
    #[inline]
    pub fn rolling_orbit_speed(&self, w: f64) -> f64 {
        self.kinematics(w).orbit_speed
    }

    /// Pure-rolling absolute spin speed at w_i, rad/s.
    #[inline]
    pub fn rolling_spin_speed(&self, w: f64) -> f64 {
        self.kinematics(w).spin_speed
    }

    /// Pure-rolling speeds and defect frequencies at w_i.
    #[inline]
    pub fn kinematics(&self, w: f64) -> Kinematics {
        let g = &self.geometry;
        let geometry = kinematics::Geometry {
            inner_raceway_diameter: 2.0 * g.inner_radius,
            pitch_diameter: 2.0 * g.pitch_radius,
            roller_diameter: 2.0 * g.roller_radius,
            rollers_per_row: self.layout.rollers_per_row,
        };
        Kinematics::pure_rolling(&geometry, w)
    }

    /// The ring that has the cages' land: the guiding one, and the outer where rollers guide.
    pub fn land_on(&self) -> Side {
        match self.guidance {
            Guidance::InnerRing => Side::Inner,
            Guidance::OuterRing | Guidance::Rollers => Side::Outer,
        }
    }

    /// Where that ring's centre is at the middle of each row.
    #[inline(always)]
    pub fn land(&self) -> Land<'_> {
        let (at, slope) = match self.land_on() {
            Side::Inner => (self.layout.inner(), self.layout.inner_tilt()),
            Side::Outer => (self.layout.outer(), self.layout.outer_tilt()),
        };
        Land { at, tilt: self.tilt.as_ref().map(|tilt| (slope, &tilt.rows[..])) }
    }

    /// Whether the outer ring of the lumped model is rigidly mounted (section 10).
    pub fn outer_ring_is_fixed(&self) -> bool {
        self.kind == ModelKind::Lumped && self.load.on == LoadOn::InnerRing
    }

    /// Support of the outer ring in the equations that hold.
    pub fn acting_outer_support(&self) -> Support {
        match self.kind {
            ModelKind::Full | ModelKind::Tilting => self.outer_support,
            ModelKind::Lumped => Support { stiffness: 0.0, damping: 0.0 },
        }
    }

    /// Support of the ring that the load acts on.
    pub fn loaded_support(&self) -> Support {
        match self.load.on {
            LoadOn::OuterRing => self.acting_outer_support(),
            LoadOn::InnerRing => self.inner_support,
        }
    }

    /// What acts on that ring, load and weight together, N.
    pub fn force_on_loaded_ring(&self) -> f64 {
        self.load.with_weight([self.inertia.inner_ring, self.inertia.outer_ring], self.gravity)
    }

    /// Masses of the positions, for norms and kinetic energies of the rates: kg for lengths, kg m^2 for angles. 0 for
    /// pads and for coordinates that are prescribed.
    pub fn mass(&self) -> Vec<f64> {
        let (l, m) = (&self.layout, &self.inertia);
        let mut mass = vec![0.0; l.dof()];
        if self.kind.moves_every_part() {
            for slot in 0..l.rollers() {
                mass[l.r() + slot] = m.roller;
                mass[l.theta() + slot] = m.roller * self.geometry.pitch_radius.powi(2);
                mass[l.phi() + slot] = m.roller_spin;
            }
            for row in 0..l.rows {
                let at = l.cage(row);
                mass[at..at + 3].copy_from_slice(&[m.cage, m.cage, m.cage_spin]);
            }
        }
        mass[l.inner()..l.inner() + 2].fill(m.inner_ring);
        mass[l.outer()..l.outer() + 2].fill(if self.outer_ring_is_fixed() { 0.0 } else { m.outer_ring });
        if let Some(tilt) = &self.tilt {
            mass[l.beta()..][..l.rollers()].fill(tilt.roller_inertia);
            mass[l.inner_tilt()..][..2].fill(tilt.inner.inertia);
            mass[l.outer_tilt()..][..2].fill(tilt.outer.inertia);
        }
        mass
    }
}
