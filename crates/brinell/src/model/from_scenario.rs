//! A scenario as the model it stands for: from the file's names and units to SI.

use super::damage_tables::defects;
use super::stable_steps::StableSteps;
use super::{BroadPhase, Custom, Geometry, Inertia, Kernel, Layout, Model, ModelError, Support, Tilt};
use crate::cage::{Guide, LandLaw, OIL_FORCE, OiledWall, Pocket};
use crate::contact::ball;
use crate::contact::film::SqueezeFilm;
use crate::contact::{self, Damping, LoadDeflection};
use crate::defect::{SIDES, Side, relative_radius};
use crate::elementary::Exponent;
use crate::friction::{Friction, drag_factor};
use crate::kernel;
use crate::lanes::Column;
use crate::operation::{Load, Rotation};
use crate::scenario::{
    self, Bearing, Cage, Contact, ContactDamping, Element, GeometryLaw, Guidance, GuidanceFilm, Housing, Law,
    Lubricant, ModelKind, Pockets, RacewayFilm, RollerProfile, Scenario, Walls,
};
use crate::slices::Slices;
use crate::waviness::Waviness;
use std::f64::consts::{FRAC_PI_2, TAU};

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
        // Here and where sections are taken apart below no `..`: a key that is added is used there, or its `_` says who reads it.
        let Scenario {
            name: _,
            bearing: b,
            cage: c,
            contact,
            friction,
            lubricant,
            support,
            housing,
            operation,
            defects: _, // defects(s), add_tables
            sensor: _,  // Simulation
            simulation,
            machine: _,
        } = s;
        let scenario::Simulation {
            laws: _, // the reader's defaults
            geometry: normals,
            seed,
            model: kind,
            duration_s: _, // the next five: Simulation
            sample_rate_hz: _,
            start,
            accuracy: _,
            most_steps: _,
            record: _,
        } = simulation;
        let geometry = Geometry::of(b);
        let inertia = Inertia::of(b, c, housing, &geometry);
        let [inner_contact, outer_contact, series_contact] = contacts(b, contact)?;
        let tilts = *kind == ModelKind::Tilting;
        let layout = Layout::new(b.rows, b.rollers_per_row, tilts);
        let defects = defects(s)?;
        let (drag, film, viscosity) = oil(lubricant, b, &geometry);
        let (pocket, guide) = cage(c, viscosity);
        let [inner_support, outer_support] = supports(support);
        let scenario::Operation {
            speed_rpm,
            load_n,
            load_on,
            load_ramp_s: _,
            gravity_m_per_s2,
            load_offset_mm: _, /* Tilt */
        } = operation;
        let moves = kind.moves_every_part();
        let by_slot = |roller: f64, padding: f64| {
            let mut column = Column::new(layout.slots, padding);
            column[..layout.rollers()].fill(roller);
            column
        };
        Ok(Self {
            kind: *kind,
            element: b.element,
            roller_mask: by_slot(1.0, 0.0),
            gaps: [geometry.clearance, geometry.outer_gap].map(|gap| by_slot(gap, NEVER_CLOSES)),
            exact: *normals == GeometryLaw::Exact && moves,
            pocket_direction: [f64::sin, f64::cos].map(|of| pocket_angles(b, &layout).iter().map(|a| of(*a)).collect()),
            waviness: Waviness::new(b, *seed).filter(|_| moves),
            pocket_gap: by_slot(pocket.clearance, NEVER_CLOSES),
            per_pocket_gap: by_slot(1.0 / pocket.clearance, 1.0 / NEVER_CLOSES),
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
            friction: rubbing(friction),
            drag,
            film: film.filter(|_| moves),
            pocket,
            guidance: c.guidance,
            guide,
            inner_support,
            outer_support,
            rotation: Rotation::new(speed_rpm),
            load: Load { full: *load_n, on: *load_on, ramp: s.load_ramp_s() },
            gravity: *gravity_m_per_s2,
            slices: slices(s, &geometry),
            tilt: tilts.then(|| Tilt::new(s, &layout, &geometry, &inertia)),
            start: *start,
            layout,
            geometry,
            inertia,
            defects,
            law: contact.law,
            custom: Custom::default(),
            usual: None,
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
            if model.tilt.is_some() {
                return refuse(
                    "simulation.model",
                    "tilting".into(),
                    "full: a contact law of one's own knows no slices",
                );
            }
            if model.slices.is_some() {
                return refuse(
                    "bearing.profile",
                    profile_word(&s.bearing.profile),
                    "straight: a contact law of one's own knows no slices",
                );
            }
            if !model.exact {
                return refuse(
                    "simulation.geometry",
                    "centred".into(),
                    "exact, where what a contact law pushes has a reaction on every body",
                );
            }
            let counts = (s.bearing.rows, s.bearing.rollers_per_row);
            if let Err(words) = contact::check(&**law, counts) {
                return refuse("contact law", words, "finite, with derivatives that are those of its energy");
            }
            model.usual = Some(contact::usual(&**law, counts));
        }
        model.custom = custom;
        if model.usual.is_some() {
            let spring = |side: Side, force: f64| {
                let (tangent, delta) = (model.stiffness_at(side, force), model.deflection(side, force));
                [tangent, model.contact(side).damping.of(tangent, delta)]
            };
            model.stable_steps = StableSteps::new(spring, model.inertia.roller);
        }
        Ok(model)
    }
}

/// A profile as a file names it.
fn profile_word(profile: &RollerProfile) -> String {
    let word = match profile {
        RollerProfile::Straight => "straight",
        RollerProfile::Logarithmic => "logarithmic",
        RollerProfile::Crowned { .. } => "{ crowned_radius_mm = .. }",
        RollerProfile::Table { .. } => "{ z_mm = .., drop_um = .. }",
    };
    word.into()
}

impl Geometry {
    fn of(b: &Bearing) -> Self {
        let Bearing {
            preset: _, // the reader's
            element: _,
            inner_raceway_diameter_mm,
            outer_raceway_diameter_mm,
            pitch_diameter_mm,
            roller_diameter_mm,
            static_load_rating_n: _, // the reader's, and ratings
            roller_length_mm,
            inner_groove_conformity: _, // ball::ellipses
            outer_groove_conformity: _,
            rollers_per_row: _, // Layout
            rows: _,
            row_stagger_deg: _,  // pocket_angles
            bore_diameter_mm: _, // the reader's
            radial_clearance_um,
            outer_gap_um,
            inner_ring_mass_kg: _, // Inertia
            outer_ring_mass_kg: _,
            roller_mass_kg: _,
            profile: _,  // slices
            waviness: _, // Waviness
            element_waviness: _,
            width_mm: _, // Tilt
            row_spacing_mm: _,
        } = b;
        Self {
            inner_radius: half_mm(*inner_raceway_diameter_mm),
            outer_radius: half_mm(*outer_raceway_diameter_mm),
            pitch_radius: half_mm(*pitch_diameter_mm),
            roller_radius: half_mm(*roller_diameter_mm),
            roller_length: 1e-3 * roller_length_mm,
            clearance: 1e-6 * radial_clearance_um,
            outer_gap: 1e-6 * outer_gap_um,
        }
    }
}

impl Inertia {
    /// The housing is fixed to the outer ring and moves with it (section 24).
    fn of(b: &Bearing, c: &Cage, Housing { mass_kg: housing }: &Housing, geometry: &Geometry) -> Self {
        let (cage_inner, cage_outer) = (half_mm(c.inner_diameter_mm), half_mm(c.outer_diameter_mm));
        Self {
            inner_ring: b.inner_ring_mass_kg,
            outer_ring: b.outer_ring_mass_kg + housing,
            roller: b.roller_mass_kg,
            roller_spin: b.element.spin_inertia() * b.roller_mass_kg * geometry.roller_radius.powi(2),
            cage: c.mass_kg,
            cage_spin: 0.5 * c.mass_kg * (cage_inner.powi(2) + cage_outer.powi(2)),
        }
    }
}

/// Laws of the inner contacts, of the outer, and of both in series.
fn contacts(b: &Bearing, contact: &Contact) -> Result<[LoadDeflection; 3], ModelError> {
    let Contact {
        law: _,         // Model
        roller_path: _, // Defect
        slices: _,      // slices
        exponent: n,
        youngs_modulus_gpa: _, // ball::ellipses, half_space
        poisson_ratio: _,
        inner_stiffness,
        outer_stiffness,
        damping,
        roughness_um,
        edge_radius_um: _, // half_space
        tables: _,
    } = contact;
    let exponent = Exponent::new(*n);
    let ellipses = match b.element {
        Element::Roller => None,
        Element::Ball => Some(ball::ellipses(b, contact).ok_or_else(|| ModelError {
            key: "bearing.inner_groove_conformity".into(),
            value: format!("{:?}", b.inner_groove_conformity),
            requirement: "balls need both conformities, a modulus and Poisson's ratio, and grooves wider than the ball",
        })?),
    };
    let damping = match *damping {
        ContactDamping::Constant { ns_per_m } => Damping::Constant(ns_per_m),
        ContactDamping::Time { us } => Damping::Time { tau: 1e-6 * us, roughness: 1e-6 * roughness_um },
    };
    let hertz = |stiffness, side: Side| LoadDeflection {
        stiffness,
        exponent,
        damping,
        across: ellipses.map(|e| e[side as usize].across),
    };
    let (inner, outer) = (*inner_stiffness, *outer_stiffness);
    Ok([
        hertz(inner, Side::Inner),
        hertz(outer, Side::Outer),
        LoadDeflection {
            stiffness: series_stiffness(inner, outer, *n),
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

fn rubbing(friction: &scenario::Friction) -> Friction {
    let scenario::Friction { raceway_coefficient, slip_velocity_m_per_s, rolling_coefficient } = *friction;
    Friction { coefficient: raceway_coefficient, slip_velocity: slip_velocity_m_per_s, rolling: rolling_coefficient }
}

/// What the oil does: drag of a roller (kg/m), films of open inner and outer contacts, viscosity (Pa s).
fn oil(lubricant: &Lubricant, b: &Bearing, geometry: &Geometry) -> (f64, Option<[SqueezeFilm; 2]>, f64) {
    let Lubricant { viscosity_pa_s, raceway_film, drag_coefficient, effective_density_kg_per_m3 } = *lubricant;
    // The area against the flow is L d, and pi d^2/4 of a ball.
    let height = match b.element {
        Element::Roller => geometry.roller_length,
        Element::Ball => FRAC_PI_2 * geometry.roller_radius,
    };
    let drag = drag_factor(drag_coefficient, effective_density_kg_per_m3, height, 2.0 * geometry.roller_radius);
    let film = |side| SqueezeFilm::new(viscosity_pa_s, geometry.roller_length, relative_radius(b, side));
    let has_film = raceway_film == RacewayFilm::Squeeze && !b.has_balls();
    (drag, has_film.then(|| SIDES.map(film)), viscosity_pa_s)
}

/// Supports of the inner and of the outer ring.
fn supports(support: &scenario::Support) -> [Support; 2] {
    let scenario::Support {
        inner_stiffness_n_per_m,
        inner_damping_ns_per_m,
        outer_stiffness_n_per_m,
        outer_damping_ns_per_m,
        inner_tilt_stiffness_nm_per_rad: _, // Tilt
        inner_tilt_damping_nms_per_rad: _,
        outer_tilt_stiffness_nm_per_rad: _,
        outer_tilt_damping_nms_per_rad: _,
    } = *support;
    [
        Support { stiffness: inner_stiffness_n_per_m, damping: inner_damping_ns_per_m },
        Support { stiffness: outer_stiffness_n_per_m, damping: outer_damping_ns_per_m },
    ]
}

/// Pockets, and what guides the cage.
fn cage(c: &Cage, viscosity: f64) -> (Pocket, Guide) {
    let Cage {
        mass_kg,
        inner_diameter_mm,
        outer_diameter_mm,
        pocket_clearance_mm,
        guidance,
        guidance_film,
        guide_clearance_mm,
        guide_width_mm,
        walls,
        pockets,
        friction_coefficient,
        contact_stiffness_n_per_m,
        contact_damping_ns_per_m,
        land_stiffness_n_per_m,
        land_damping_ns_per_m,
    } = *c;
    let pocket = Pocket {
        stiffness: contact_stiffness_n_per_m,
        damping: contact_damping_ns_per_m,
        clearance: 1e-3 * pocket_clearance_mm,
        wall: (walls == Walls::Oiled).then_some((OiledWall { film: OIL_FORCE }, friction_coefficient)),
        is_round: pockets == Pockets::Round,
    };
    let guide = Guide {
        // Where the rollers guide there is no film, and the land stops what strays.
        film: (guidance != Guidance::Rollers).then_some(guidance_film),
        viscosity,
        clearance: 1e-3 * guide_clearance_mm,
        width: 1e-3 * guide_width_mm,
        radius: half_mm(if guidance == Guidance::InnerRing { inner_diameter_mm } else { outer_diameter_mm }),
        land_stiffness: land_stiffness_n_per_m,
        land_damping: match (guidance, guidance_film) {
            (Guidance::OuterRing | Guidance::InnerRing, GuidanceFilm::QuasiStatic) => 0.0,
            _ => land_damping_ns_per_m,
        },
        wall: match (walls, guidance, pockets) {
            // A round pocket holds its ball in every direction.
            (Walls::Oiled, Guidance::Rollers, Pockets::Round) => LandLaw::None,
            (Walls::Oiled, Guidance::Rollers, Pockets::Slot) => {
                LandLaw::Oiled(OiledWall { film: OIL_FORCE.max(4.0 * 9.81 * mass_kg) })
            }
            // The guidance film carries where there is one.
            (Walls::Oiled, Guidance::OuterRing | Guidance::InnerRing, _) => LandLaw::Oiled(OiledWall { film: 0.0 }),
            (Walls::Linear, ..) => LandLaw::Linear,
        },
    };
    (pocket, guide)
}

/// The slices, where rollers tilt or have a profile.
fn slices(s: &Scenario, geometry: &Geometry) -> Option<Slices> {
    (!s.has_even_contacts()).then(|| {
        Slices::new(s.contact.slices.max(1), geometry.roller_length, 2.0 * geometry.roller_radius, &s.bearing.profile)
    })
}
