//! A scenario as the model it stands for: from the file's names and units to SI.

use super::stable_steps::StableSteps;
use super::{BroadPhase, Custom, Geometry, Inertia, Kernel, Layout, Model, Support, Tilt};
use crate::cage::{Guide, LandLaw, OIL_FORCE, OiledWall, Pocket};
use crate::contact::ball;
use crate::contact::film::SqueezeFilm;
use crate::contact::{Damping, LoadDeflection, Place};
use crate::defect::{Defect, SIDES, Side, relative_radius};
use crate::effective::Table;
use crate::elementary::Exponent;
use crate::friction::{Friction, drag_factor};
use crate::half_space::{self, error::BuildError};
use crate::kernel;
use crate::lanes::Column;
use crate::operation::{Load, Rotation};
use crate::scenario::{
    Bearing, Cage, ContactDamping, DefectTable, Element, GeometryLaw, Guidance, GuidanceFilm, Housing, Law, Lubricant,
    ModelKind, Pockets, RacewayFilm, Scenario, TableData, TableValues, Walls,
};
use crate::slices::{Healthy, Slices};
use crate::waviness::Waviness;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// A scenario that no model can be made of.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key} = {value}: {requirement}")]
pub struct ModelError {
    /// Scenario key.
    pub key: String,
    /// Offending value.
    pub value: String,
    /// What it must be.
    pub requirement: &'static str,
}

/// The gap of padding, m: its contacts never close.
const NEVER_CLOSES: f64 = 1e3;

/// Millimetres of diameter to metres of radius.
fn half_mm(diameter: f64) -> f64 {
    0.5e-3 * diameter
}

impl Model {
    /// The model of a scenario in which [`Scenario::problems`] finds no error; of any other it may panic.
    ///
    /// # Errors
    /// Where damage is still a file or has no shape, grooves make no ellipse, or the process's kernel is not there.
    pub fn new(s: &Scenario) -> Result<Self, ModelError> {
        let mut model = Self::planned(s)?;
        if s.contact.law == Law::HalfSpace {
            model.add_tables(s, true)?;
        }
        Ok(model)
    }

    /// The same where the tables of damage are at hand; `None` where one has to be made first, which takes up to seconds.
    ///
    /// # Errors
    /// As [`Self::new`].
    #[doc(hidden)]
    pub fn at_hand(s: &Scenario) -> Result<Option<Self>, ModelError> {
        let mut model = Self::planned(s)?;
        let whole = s.contact.law != Law::HalfSpace || model.add_tables(s, false)?;
        Ok(whole.then_some(model))
    }

    /// The same before the tables of damage are made, without which damage does nothing: for what is said of many scenarios beforehand.
    ///
    /// # Errors
    /// As [`Self::new`].
    #[doc(hidden)]
    pub fn planned(s: &Scenario) -> Result<Self, ModelError> {
        Kernel::chosen().map_err(|error| ModelError {
            key: kernel::SETTING.into(),
            value: format!("{:?}", error.value),
            requirement: &error.requirement,
        })?;
        let (b, c) = (&s.bearing, &s.cage);
        let geometry = Geometry::of(b);
        let inertia = Inertia::of(b, c, &s.housing, &geometry);
        let [inner_contact, outer_contact, series_contact] = contacts(s)?;
        let tilts = s.simulation.model == ModelKind::Tilting;
        let layout = Layout::new(b.rows, b.rollers_per_row, tilts);
        let defects = defects(s)?;
        let by_slot = |roller: f64, padding: f64| {
            let mut column = Column::new(layout.slots, padding);
            column[..layout.rollers()].fill(roller);
            column
        };
        Ok(Self {
            kind: s.simulation.model,
            element: b.element,
            roller_mask: by_slot(1.0, 0.0),
            gaps: [geometry.clearance, geometry.outer_gap].map(|gap| by_slot(gap, NEVER_CLOSES)),
            exact: s.simulation.geometry == GeometryLaw::Exact && s.simulation.model != ModelKind::Lumped,
            pocket_direction: [f64::sin, f64::cos].map(|of| pocket_angles(b, &layout).iter().map(|a| of(*a)).collect()),
            waviness: waviness(s),
            pocket_gap: by_slot(1e-3 * c.pocket_clearance_mm, NEVER_CLOSES),
            per_pocket_gap: by_slot(1.0 / (1e-3 * c.pocket_clearance_mm), 1.0 / NEVER_CLOSES),
            broad_phase: SIDES.map(|side| BroadPhase::new(&layout, &defects, side)),
            row_lanes: row_lanes(&layout),
            pocket_angle: pocket_angles(b, &layout),
            stable_steps: StableSteps::new(
                |side, force| {
                    let law = [&inner_contact, &outer_contact][side as usize];
                    let tangent = law.tangent_at(force);
                    [tangent, law.damping.of(tangent, law.deflection(force))]
                },
                inertia.roller,
            ),
            inner_contact,
            outer_contact,
            series_contact,
            friction: Friction {
                coefficient: s.friction.raceway_coefficient,
                slip_velocity: s.friction.slip_velocity_m_per_s,
                rolling: s.friction.rolling_coefficient,
            },
            drag: drag(b.element, &s.lubricant, &geometry),
            film: film(s, &geometry),
            pocket: Pocket {
                stiffness: c.contact_stiffness_n_per_m,
                damping: c.contact_damping_ns_per_m,
                clearance: 1e-3 * c.pocket_clearance_mm,
                wall: (c.walls == Walls::Oiled).then_some((OiledWall { film: OIL_FORCE }, c.friction_coefficient)),
                is_round: c.pockets == Pockets::Round,
            },
            guidance: c.guidance,
            guide: guide(c, &s.lubricant),
            inner_support: Support {
                stiffness: s.support.inner_stiffness_n_per_m,
                damping: s.support.inner_damping_ns_per_m,
            },
            outer_support: Support {
                stiffness: s.support.outer_stiffness_n_per_m,
                damping: s.support.outer_damping_ns_per_m,
            },
            rotation: Rotation::new(&s.operation.speed_rpm),
            load: load(s),
            gravity: s.operation.gravity_m_per_s2,
            slices: slices(s, &geometry),
            tilt: tilts.then(|| Tilt::new(s, &layout, &geometry, &inertia)),
            start: s.simulation.start,
            layout,
            geometry,
            inertia,
            defects,
            law: s.contact.law,
            custom: Custom::default(),
        })
    }

    /// The model of a scenario with what the user's program adds to it.
    ///
    /// # Errors
    /// As [`Self::new`], and where the equations have no place for it.
    pub fn with_custom(s: &Scenario, custom: Custom) -> Result<Self, ModelError> {
        let mut model = if custom.contact.is_some() { Self::planned(s) } else { Self::new(s) }?;
        let refuse = |key: &str, value: String, requirement| Err(ModelError { key: key.into(), value, requirement });
        if model.kind == ModelKind::Lumped {
            return refuse("simulation.model", "lumped".into(), "full or tilting, for further forces and contact laws");
        }
        if let Some(law) = &custom.contact {
            if !s.has_even_contacts() {
                return refuse(
                    "bearing.profile",
                    format!("{:?}", s.bearing.profile),
                    "straight, and simulation.model full: a contact law of one's own knows no slices",
                );
            }
            if !model.exact {
                return refuse(
                    "simulation.geometry",
                    "centred".into(),
                    "exact, where what a contact law pushes has a reaction on every body",
                );
            }
            let damping = SIDES.map(|side| model.contact(side).damping);
            let spring = |side: Side, force: f64| {
                let delta = law.deflection(side, force);
                let tangent = law.at(&Place::of(side), delta).tangent;
                [tangent, damping[side as usize].of(tangent, delta)]
            };
            model.stable_steps = StableSteps::new(spring, model.inertia.roller);
        }
        model.custom = custom;
        Ok(model)
    }

    /// Gives damage its tables (section 19), which say where its contacts are no longer healthy. `false`: one is not at hand, and
    /// `may_make` forbids to make it.
    fn add_tables(&mut self, s: &Scenario, may_make: bool) -> Result<bool, ModelError> {
        self.use_given_tables(s)?;
        let force = heaviest(s, &self.geometry, &self.inertia);
        let contacts = [&self.inner_contact, &self.outer_contact];
        let deflection = |side: Side| {
            let law = contacts[side as usize];
            let least = law.deflection(force);
            self.slices.as_ref().map_or(least, |slices| slices.deflection(law, force, least))
        };
        let how = (self.tilt.is_some(), may_make);
        in_its_units(&self.defects, deflection)?;
        match half_space::add_tables(&mut self.defects, (&s.bearing, &s.contact), how, deflection) {
            Ok(()) => {}
            Err(BuildError::NotAtHand) => return Ok(false),
            Err(error) => {
                return Err(ModelError {
                    key: "defects".into(),
                    value: error.to_string(),
                    requirement: "damage that a table of the half-space can hold: shorter, of a smoother outline, or with contact.tables = \"coarse\"",
                });
            }
        }
        self.broad_phase = SIDES.map(|side| BroadPhase::new(&self.layout, &self.defects, side));
        Ok(true)
    }
}

impl Model {
    /// Gives damage the tables of files.
    fn use_given_tables(&mut self, s: &Scenario) -> Result<(), ModelError> {
        for (k, given) in s.defects.iter().enumerate() {
            let Some(DefectTable::Read(data)) = &given.table else { continue };
            let fault =
                |value: String, requirement| ModelError { key: format!("defects.{k}.table"), value, requirement };
            for side in SIDES {
                let values = match &data.values {
                    TableValues::DeltaEffUm(list) => list.clone(),
                    TableValues::EnergyJ(list) => effective(&self.healthy(side), &data.delta_um, list),
                };
                let data = TableData { values: TableValues::DeltaEffUm(values), ..data.clone() };
                if self.defects[k].meets_side(side) {
                    data.check().map_err(|error| fault(error.to_string(), "energies in J, at the first and the last s_mm those of the healthy contact: K delta^(n+1)/(n+1), all in SI units"))?;
                }
                let in_m = |list: &[f64], unit: f64| -> Vec<f64> { list.iter().map(|x| unit * x).collect() };
                let (at, by) = (in_m(&data.s_mm, 1e-3), in_m(&data.delta_um, 1e-6));
                let table = Table::from_grid(&at, &by, &in_m(data.values.list(), 1e-6))
                    .map_err(|error| fault(error.to_string(), "a full grid whose s and delta rise"))?;
                self.defects[k].use_table_at(side, Arc::new(table));
            }
        }
        Ok(())
    }
}

impl Geometry {
    fn of(b: &Bearing) -> Self {
        Self {
            inner_radius: half_mm(b.inner_raceway_diameter_mm),
            outer_radius: half_mm(b.outer_raceway_diameter_mm),
            pitch_radius: half_mm(b.pitch_diameter_mm),
            roller_radius: half_mm(b.roller_diameter_mm),
            roller_length: 1e-3 * b.roller_length_mm,
            clearance: 1e-6 * b.radial_clearance_um,
            outer_gap: 1e-6 * b.outer_gap_um,
        }
    }
}

impl Inertia {
    /// The housing is fixed to the outer ring and moves with it (section 24).
    fn of(b: &Bearing, c: &Cage, housing: &Housing, geometry: &Geometry) -> Self {
        let (cage_inner, cage_outer) = (half_mm(c.inner_diameter_mm), half_mm(c.outer_diameter_mm));
        Self {
            inner_ring: b.inner_ring_mass_kg,
            outer_ring: b.outer_ring_mass_kg + housing.mass_kg,
            roller: b.roller_mass_kg,
            roller_spin: b.element.spin_inertia() * b.roller_mass_kg * geometry.roller_radius.powi(2),
            cage: c.mass_kg,
            cage_spin: 0.5 * c.mass_kg * (cage_inner.powi(2) + cage_outer.powi(2)),
        }
    }
}

/// Laws of the inner contacts, of the outer, and of both in series.
fn contacts(s: &Scenario) -> Result<[LoadDeflection; 3], ModelError> {
    let (b, contact) = (&s.bearing, &s.contact);
    let exponent = Exponent::new(contact.exponent);
    let ellipses = match b.element {
        Element::Roller => None,
        Element::Ball => Some(ball::ellipses(b, contact).ok_or_else(|| ModelError {
            key: "bearing.inner_groove_conformity".into(),
            value: format!("{:?}", b.inner_groove_conformity),
            requirement: "balls need both conformities, a modulus and Poisson's ratio, and grooves wider than the ball",
        })?),
    };
    let damping = match contact.damping {
        ContactDamping::Constant { ns_per_m } => Damping::Constant(ns_per_m),
        ContactDamping::Time { us } => Damping::Time { tau: 1e-6 * us, roughness: 1e-6 * contact.roughness_um },
    };
    let hertz = |stiffness, side: Side| LoadDeflection {
        stiffness,
        exponent,
        damping,
        across: ellipses.map(|e| e[side as usize].across),
    };
    let (inner, outer) = (contact.inner_stiffness, contact.outer_stiffness);
    Ok([
        hertz(inner, Side::Inner),
        hertz(outer, Side::Outer),
        LoadDeflection {
            stiffness: series_stiffness(inner, outer, contact.exponent),
            exponent,
            damping: damping.in_series(),
            across: None,
        },
    ])
}

/// K_s of two contacts in series, K_s^(-1/n) = K_in^(-1/n) + K_out^(-1/n); 0 where either is.
pub fn series_stiffness(inner: f64, outer: f64, n: f64) -> f64 {
    if inner <= 0.0 || outer <= 0.0 {
        return 0.0;
    }
    (inner.powf(-1.0 / n) + outer.powf(-1.0 / n)).powf(-n)
}

/// Damage, its files read before.
fn defects(s: &Scenario) -> Result<Vec<Defect>, ModelError> {
    for (k, defect) in s.defects.iter().enumerate() {
        if let Some(file) = defect.shape.file() {
            return Err(ModelError {
                key: format!("defects.{k}.shape"),
                value: file.to_string(),
                requirement: "a shape, not a file: read it first, with brinell_damage::resolve",
            });
        }
    }
    for (k, defect) in s.defects.iter().enumerate() {
        if let Some(file) = defect.table_file() {
            return Err(ModelError {
                key: format!("defects.{k}.table"),
                value: file.to_string(),
                requirement: "a table, not a file: read it first, with brinell_damage::resolve",
            });
        }
    }
    Defect::all(&s.defects, &s.bearing, &s.contact).map_err(|k| ModelError {
        key: format!("defects.{k}"),
        // A scan has a million depths.
        value: format!("{:?}", s.defects[k]).chars().take(200).collect(),
        requirement: "rows and rollers count from 1, and the shape must make sense: lists equally long, arcs that do not go back, polygons with area, grids without holes",
    })
}

/// Force of the heaviest contact without clearance (Stribeck), N: of load and weight, or of the elements' own centrifugal force.
fn heaviest(s: &Scenario, g: &Geometry, m: &Inertia) -> f64 {
    let gravity = s.operation.gravity_m_per_s2;
    let count = (s.bearing.rows * s.bearing.rollers_per_row) as f64;
    let weight = gravity[0].hypot(gravity[1]) * (m.inner_ring + m.outer_ring + count * m.roller);
    let load = s.operation.load_n[0].hypot(s.operation.load_n[1]) + weight;
    let orbit = Rotation::new(&s.operation.speed_rpm).max_speed() * g.inner_radius / (2.0 * g.pitch_radius);
    (s.bearing.element.stribeck() * load / count).max(m.roller * g.pitch_radius * orbit * orbit)
}

/// delta_eff (um) of a table of energies on a healthy contact; where nothing touches, straight on down from the first two nodes that do.
fn effective(healthy: &Healthy, delta_um: &[f64], energies: &[f64]) -> Vec<f64> {
    let of = |energy: f64| if energy > 0.0 { 1e6 * healthy.deformation_of(energy) } else { 0.0 };
    let rows = energies.chunks(delta_um.len()).flat_map(|row| {
        let mut row: Vec<f64> = row.iter().map(|energy| of(*energy)).collect();
        let from = row.iter().position(|value| *value > 0.0).unwrap_or(0);
        let slope = match row[from..] {
            [first, second, ..] => (second - first) / (delta_um[from + 1] - delta_um[from]),
            _ => 1.0,
        };
        for k in 0..from {
            row[k] = (row[from] - slope * (delta_um[from] - delta_um[k])).min(0.0);
        }
        row
    });
    rows.collect()
}

/// That tables of files are in their units: none is meant for damage or a heaviest deformation ten times as large.
fn in_its_units(defects: &[Defect], deflection: impl Fn(Side) -> f64) -> Result<(), ModelError> {
    const SMALLEST: f64 = 0.1;
    for (k, defect) in defects.iter().enumerate() {
        let met = SIDES.into_iter().filter(|side| defect.meets_side(*side));
        let Some((side, table)) = met.filter_map(|side| Some((side, defect.table(side)?))).next() else { continue };
        let [begin, end] = table.range_s();
        let (from, to) = defect.shape.arc();
        let wrong = [
            ("s_mm go over", 1e3 * (end - begin), "the damage's length along the surface is", 1e3 * (to - from), "mm"),
            (
                "delta_um end at",
                1e6 * table.last_delta(),
                "the heaviest contact deforms by some",
                1e6 * deflection(side),
                "um",
            ),
        ];
        for (what, is, of, should, unit) in wrong {
            if is < SMALLEST * should {
                return Err(ModelError {
                    key: format!("defects.{k}.table"),
                    value: format!("its {what} {is:.3e} {unit}, and {of} {should:.3} {unit}"),
                    requirement: "columns in the units of their names: s_mm in mm, delta_um and delta_eff_um in um",
                });
            }
        }
    }
    Ok(())
}

fn waviness(s: &Scenario) -> Option<Waviness> {
    Waviness::new(&s.bearing, s.simulation.seed).filter(|_| s.simulation.model != ModelKind::Lumped)
}

/// alpha of each slot, rad; 0 for padding.
fn pocket_angles(b: &Bearing, layout: &Layout) -> Column {
    let stagger = b.row_stagger_deg.to_radians();
    (0..layout.slots)
        .map(|slot| {
            let (row, roller) = (layout.row(slot) as f64, layout.roller(slot) as f64);
            if slot < layout.rollers() { TAU * roller / b.rollers_per_row as f64 + row * stagger } else { 0.0 }
        })
        .collect()
}

fn row_lanes(layout: &Layout) -> Vec<Column> {
    let own = |row| move |slot| f64::from(u8::from(layout.row(slot) == row));
    (0..layout.rows).map(|row| (0..layout.row_period()).map(own(row)).collect()).collect()
}

/// Drag of a roller, kg/m.
fn drag(element: Element, lubricant: &Lubricant, geometry: &Geometry) -> f64 {
    drag_factor(
        lubricant.drag_coefficient,
        lubricant.effective_density_kg_per_m3,
        // The area against the flow is L d, and pi d^2/4 of a ball.
        match element {
            Element::Roller => geometry.roller_length,
            Element::Ball => FRAC_PI_2 * geometry.roller_radius,
        },
        2.0 * geometry.roller_radius,
    )
}

/// Films of open inner and outer contacts.
fn film(s: &Scenario, geometry: &Geometry) -> Option<[SqueezeFilm; 2]> {
    let acts = s.lubricant.raceway_film == RacewayFilm::Squeeze
        && s.simulation.model != ModelKind::Lumped
        && !s.bearing.has_balls();
    let of = |side| {
        let radius = relative_radius(&s.bearing, side);
        SqueezeFilm::new(s.lubricant.viscosity_pa_s, geometry.roller_length, radius)
    };
    acts.then(|| SIDES.map(of))
}

fn guide(c: &Cage, lubricant: &Lubricant) -> Guide {
    Guide {
        // Where the rollers guide there is no film, and the land stops what strays.
        film: (c.guidance != Guidance::Rollers).then_some(c.guidance_film),
        viscosity: lubricant.viscosity_pa_s,
        clearance: 1e-3 * c.guide_clearance_mm,
        width: 1e-3 * c.guide_width_mm,
        radius: half_mm(if c.guidance == Guidance::InnerRing { c.inner_diameter_mm } else { c.outer_diameter_mm }),
        land_stiffness: c.land_stiffness_n_per_m,
        land_damping: match (c.guidance, c.guidance_film) {
            (Guidance::OuterRing | Guidance::InnerRing, GuidanceFilm::QuasiStatic) => 0.0,
            _ => c.land_damping_ns_per_m,
        },
        wall: match (c.walls, c.guidance, c.pockets) {
            // A round pocket holds its ball in every direction.
            (Walls::Oiled, Guidance::Rollers, Pockets::Round) => LandLaw::None,
            (Walls::Oiled, Guidance::Rollers, Pockets::Slot) => {
                LandLaw::Oiled(OiledWall { film: OIL_FORCE.max(4.0 * 9.81 * c.mass_kg) })
            }
            // The guidance film carries where there is one.
            (Walls::Oiled, Guidance::OuterRing | Guidance::InnerRing, _) => LandLaw::Oiled(OiledWall { film: 0.0 }),
            (Walls::Linear, ..) => LandLaw::Linear,
        },
    }
}

fn load(s: &Scenario) -> Load {
    Load { full: s.operation.load_n, on: s.operation.load_on, ramp: s.load_ramp_s() }
}

/// The slices, where rollers tilt or have a profile.
fn slices(s: &Scenario, geometry: &Geometry) -> Option<Slices> {
    (!s.has_even_contacts()).then(|| {
        Slices::new(s.contact.slices.max(1), geometry.roller_length, 2.0 * geometry.roller_radius, &s.bearing.profile)
    })
}
