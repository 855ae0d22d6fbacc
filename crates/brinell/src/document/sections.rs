//! Every key of a scenario file: name, meaning, range, default, once and in order; those of the bearing are in
//! [`super::bearing_keys`], the cage's in [`super::cage_keys`], of contacts in [`super::contact_keys`], of damage in
//! [`super::damage`], the sensor's in [`super::sensor`].

use super::bearing_keys::{ROLLERS, bearing, tilt_key};
use super::cage_keys::cage;
use super::contact_keys::contact;
use super::damage::defect;
use super::keys::Fallback::{self, Required};
use super::keys::{Keys, PAPER, assumed, derived, stated};
use super::sensor::sensor;
use super::spec::key;
use crate::scenario::*;
use crate::signal::rounded;

/// Default of `simulation.most_steps`.
const MOST_STEPS: f64 = 1e8;

const POINT_OF_SCOPE: &str = "not in the paper's model";

/// The bearing of Li et al.
const PAPERS_BEARING: &str = "NN3007";

/// Why a value is the one that it is: of the paper's bearing alone that the paper leaves it open. Who has another bearing knows no paper.
fn left_open(b: &Bearing, of_papers: &'static str, of_others: &'static str) -> &'static str {
    if b.preset.as_deref() == Some(PAPERS_BEARING) { of_papers } else { of_others }
}

pub(crate) fn scenario(k: &mut Keys, s: &mut Scenario) {
    let name = key("name", "name of the run, free text");
    k.key(name, stated("unnamed".into(), "no name given"), &mut s.name);
    // Which keys act, and what others default to, depends on the equations.
    if let Some(model) = k.foretold("simulation", "model") {
        s.simulation.model = model;
    }
    let model = s.simulation.model;
    match k.foretold("simulation", "laws") {
        Some(laws) => s.simulation.laws = laws,
        None if k.gives("simulation", "laws").is_some() => s.simulation.laws = Laws::default_of(model),
        None => {}
    }
    let laws = s.simulation.laws;
    let geometry = k.foretold("simulation", "geometry").unwrap_or(s.simulation.geometry);
    k.section(key("bearing", "geometry and masses"), |k| bearing(k, (model, laws), &mut s.bearing));
    k.section(key("cage", "one cage for each row"), |k| cage(k, (laws, &s.bearing), &mut s.cage));
    k.section(key("contact", "rollers on raceways, along the normal"), |k| {
        contact(k, (laws, model, &s.bearing), &mut s.contact)
    });
    k.section(key("friction", "rollers on raceways, along the surface"), |k| {
        friction(k, (laws, geometry, &s.bearing), &mut s.friction)
    });
    k.section(key("lubricant", "oil"), |k| lubricant(k, &s.bearing, &mut s.lubricant));
    k.section(key("operation", "speed, load and gravity"), |k| operation(k, (model, &s.bearing), &mut s.operation));
    k.section(key("housing", "fixed to the outer ring"), |k| housing(k, (laws, &s.bearing), &mut s.housing));
    let masses = [s.bearing.inner_ring_mass_kg, s.bearing.outer_ring_mass_kg + s.housing.mass_kg];
    k.section(key("support", "springs and dampers that hold the rings"), |k| {
        support(k, (laws, model, &s.bearing, &s.operation), masses, &mut s.support)
    });
    let load = s.operation.load_n;
    k.tables(key("defects", "damage: none, one or many"), &mut s.defects, Defect::unset, |k, d| defect(k, load, d));
    k.section(key("sensor", "from the outer ring to the record: nothing, unless a key says so"), |k| {
        sensor(k, &mut s.sensor)
    });
    let pushes = s.has_damage_that_pushes() || s.waves().next().is_some();
    k.section(key("simulation", "what to compute and to record"), |k| {
        simulation(k, (&s.bearing, &s.operation, pushes), &mut s.simulation)
    });
}

fn friction(k: &mut Keys, (laws, geometry, b): (Laws, GeometryLaw, &Bearing), f: &mut Friction) {
    k.key(
        key("raceway_coefficient", "mu").plausible(0.005, 0.1).from(0.0),
        assumed(0.02, PAPER),
        &mut f.raceway_coefficient,
    );
    k.key(
        key("slip_velocity_m_per_s", "v_s of tanh(slip / v_s)").plausible_times(0.2, 5.0).above(0.0),
        assumed(
            0.05,
            left_open(
                b,
                "regularises friction; the paper does not state it",
                "regularises friction: from 0.15 m/s of slip on it is Coulomb's within 0.5 %",
            ),
        ),
        &mut f.slip_velocity_m_per_s,
    );
    let rolling = match laws {
        // Levers of the centred bearing have no reaction for it.
        Laws::Mechanics if geometry == GeometryLaw::Centred => stated(0.0, "of centred geometry"),
        Laws::Mechanics => {
            assumed(7e-4, "drive torques of whole bearings in the makers' estimates, within a factor of two")
        }
        Laws::Li2023 => stated(0.0, PAPER),
    };
    k.key(
        key("rolling_coefficient", "k_r of the couple k_r r Q that resists rolling at each contact")
            .plausible_times(0.5, 2.0)
            .from(0.0),
        rolling,
        &mut f.rolling_coefficient,
    );
}

fn lubricant(k: &mut Keys, b: &Bearing, l: &mut Lubricant) {
    k.key(
        key("viscosity_pa_s", "eta of the cage's guidance film and of the raceway film")
            .plausible(0.003, 0.1)
            .from(0.0),
        assumed(0.01, left_open(b, "warm spindle oil; the paper does not state it", "warm spindle oil")),
        &mut l.viscosity_pa_s,
    );
    k.key_where(
        key("raceway_film", "film of rollers and raceways that do not touch"),
        (!b.has_balls(), ROLLERS),
        stated(RacewayFilm::None, PAPER),
        &mut l.raceway_film,
    );
    k.key(
        key("drag_coefficient", "C_d of a roller in the oil-air mixture").from(0.0),
        stated(0.0, POINT_OF_SCOPE),
        &mut l.drag_coefficient,
    );
    k.key(
        key("effective_density_kg_per_m3", "rho_f of the oil-air mixture").from(0.0),
        stated(0.0, POINT_OF_SCOPE),
        &mut l.effective_density_kg_per_m3,
    );
}

fn operation(k: &mut Keys, (model, b): (ModelKind, &Bearing), o: &mut Operation) {
    k.key(
        key(
            "speed_rpm",
            "inner ring, counter-clockwise, negative is clockwise; a number other than 0, or points [[t_s, rpm], ...]",
        ),
        Required,
        &mut o.speed_rpm,
    );
    k.key(key("load_n", "F = [x, y], from the bearing's centre to the load zone"), Required, &mut o.load_n);
    k.key(key("load_on", "ring that carries the load"), stated(LoadOn::OuterRing, "the paper's rig"), &mut o.load_on);
    k.key(
        key("load_ramp_s", "time over which the load rises").from(0.0),
        assumed(
            0.02,
            left_open(
                b,
                "the paper does not state it",
                "long beside the periods of contacts, short beside a usual run",
            ),
        ),
        &mut o.load_ramp_s,
    );
    k.key(
        key("gravity_m_per_s2", "g = [x, y], on every body"),
        stated([0.0, 0.0], POINT_OF_SCOPE),
        &mut o.gravity_m_per_s2,
    );
    tilt_key(
        k,
        (model, b.element),
        key("load_offset_mm", "Z_F, where along the axis the load acts; 0 is the bearing's middle"),
        stated(0.0, "in the middle"),
        &mut o.load_offset_mm,
    );
}

/// How much larger than the NN3007, for which they were chosen, a bearing is to its supports: as its load rating over its
/// pitch radius is, of which the rating goes as Z N_r L d, of balls as 0.3 of that (ISO 76: f_0 of 13, and 44). A shaft
/// and a housing grow with what they carry, and a heavy bearing on a small one's supports would sink by millimetres. No
/// less than 1: small bearings stand in rigs like the NN3007's.
fn support_scale(b: &Bearing) -> f64 {
    const NN3007_MM: f64 = 38.0 * 6.0 * 6.0 / 49.0;
    let elements = b.rollers_per_row as f64 * b.rows as f64;
    let of_element = match b.element {
        Element::Roller => 1.0,
        Element::Ball => 0.3,
    };
    let size = of_element * elements * b.roller_length_mm * b.roller_diameter_mm / b.pitch_diameter_mm;
    // What could not be read raises no objection.
    (size / NN3007_MM).max(1.0)
}

/// A stiffness (N/m) with which the support of the loaded ring, of the mass `mass` (kg), takes little of its load over the clearance and the contacts'
/// deformations, some 0.02 mm: what presses the ring over 0.3 mm. `None` where nothing does.
fn least_of_load(o: &Operation, mass: f64) -> Option<f64> {
    let size = |[x, y]: [f64; 2]| x.hypot(y);
    let presses = size(o.load_n) + mass * size(o.gravity_m_per_s2);
    // Of four digits, as it is printed.
    let stiffness = rounded(presses / 0.3e-3, 4);
    (stiffness > 0.0).then_some(stiffness)
}

/// `masses` are those of the inner ring and of the outer one with its housing, kg.
fn support(
    k: &mut Keys,
    (laws, model, b, o): (Laws, ModelKind, &Bearing, &Operation),
    masses: [f64; 2],
    s: &mut Support,
) {
    // Soft where the load acts, or the support would carry it instead of the rollers
    // (`docs/src/theory/motion.md`).
    let (scale, why) = match laws {
        Laws::Mechanics => (
            support_scale(b),
            "soft on the loaded ring, no stiffer than its load over 0.3 mm, and stiff on the other; larger bearings than the NN3007 on stiffer ones",
        ),
        Laws::Li2023 => (
            1.0,
            left_open(
                b,
                "soft on the loaded ring, stiff on the other; the paper does not state it",
                "soft on the loaded ring, stiff on the other, as assumed for the paper's bearing",
            ),
        ),
    };
    let soft = |mass: f64| match laws {
        Laws::Mechanics => least_of_load(o, mass).map_or(1e6 * scale, |most| (1e6 * scale).min(most)),
        Laws::Li2023 => 1e6,
    };
    let (inner, outer) = match o.load_on {
        LoadOn::OuterRing => (5e7 * scale, soft(masses[1])),
        LoadOn::InnerRing => (soft(masses[0]), 5e7 * scale),
    };
    let damping = masses.map(|mass| match laws {
        Laws::Mechanics => derived(0.2 * (5e7 * scale * mass).sqrt(), "a tenth of critical on the stiff support"),
        Laws::Li2023 => {
            assumed(500.0, left_open(b, "the paper does not state it", "as assumed for the paper's bearing"))
        }
    });
    k.key(
        key("inner_stiffness_n_per_m", "k_i").plausible_times(0.2, 5.0).from(0.0),
        assumed(inner, why),
        &mut s.inner_stiffness_n_per_m,
    );
    let [of_inner, of_outer] = damping;
    k.key(
        key("inner_damping_ns_per_m", "c_i").plausible_times(0.2, 5.0).from(0.0),
        of_inner,
        &mut s.inner_damping_ns_per_m,
    );
    k.key(
        key("outer_stiffness_n_per_m", "k_o").plausible_times(0.2, 5.0).from(0.0),
        assumed(outer, why),
        &mut s.outer_stiffness_n_per_m,
    );
    k.key(
        key("outer_damping_ns_per_m", "c_o").plausible_times(0.2, 5.0).from(0.0),
        of_outer,
        &mut s.outer_damping_ns_per_m,
    );
    let lever = (0.5e-3 * b.pitch_diameter_mm).powi(2);
    let (stiffness, damping) = ("k R_m^2 of the same ring", "c R_m^2 of the same ring");
    let mut tilt = |name, symbol, own: f64, how, value: &mut f64| {
        let spec = key(name, symbol).from(0.0);
        tilt_key(k, (model, b.element), spec, derived(own * lever, how), value);
    };
    tilt(
        "inner_tilt_stiffness_nm_per_rad",
        "k_ti",
        s.inner_stiffness_n_per_m,
        stiffness,
        &mut s.inner_tilt_stiffness_nm_per_rad,
    );
    tilt(
        "inner_tilt_damping_nms_per_rad",
        "c_ti",
        s.inner_damping_ns_per_m,
        damping,
        &mut s.inner_tilt_damping_nms_per_rad,
    );
    tilt(
        "outer_tilt_stiffness_nm_per_rad",
        "k_to",
        s.outer_stiffness_n_per_m,
        stiffness,
        &mut s.outer_tilt_stiffness_nm_per_rad,
    );
    tilt(
        "outer_tilt_damping_nms_per_rad",
        "c_to",
        s.outer_damping_ns_per_m,
        damping,
        &mut s.outer_tilt_damping_nms_per_rad,
    );
}

fn housing(k: &mut Keys, (laws, b): (Laws, &Bearing), h: &mut Housing) {
    let mass = match laws {
        Laws::Mechanics => derived(20.0 * b.outer_ring_mass_kg, "20 times the outer ring's, a small plummer block"),
        Laws::Li2023 => stated(0.0, PAPER),
    };
    k.key(
        key("mass_kg", "of what moves with the outer ring").plausible_times(0.1, 5.0).from(0.0),
        mass,
        &mut h.mass_kg,
    );
}

/// Half a second; of a slow bearing four turns of the shaft after the load's ramp, in which every element passes the load
/// zone once.
fn duration(laws: Laws, (b, o): (&Bearing, &Operation)) -> Fallback<f64> {
    const USUAL: f64 = 0.5;
    const LONG_ENOUGH: &str = "long enough for statistics of a bearing that is not slow";
    let of_turns = o.speed_rpm.constant().map_or(0.0, |rpm| o.load_ramp_s + 4.0 * 60.0 / rpm.abs());
    match laws {
        Laws::Mechanics if of_turns > USUAL && of_turns <= 1e6 => {
            derived(of_turns, "four turns of the shaft after the load's ramp")
        }
        Laws::Mechanics => assumed(USUAL, LONG_ENOUGH),
        Laws::Li2023 => assumed(USUAL, left_open(b, "the paper does not state it", LONG_ENOUGH)),
    }
}

fn simulation(k: &mut Keys, (b, o, pushes): (&Bearing, &Operation, bool), s: &mut Simulation) {
    let laws = match s.model {
        ModelKind::Lumped => "the lumped model is the paper's",
        ModelKind::Full | ModelKind::Tilting => "the usual set",
    };
    k.key(
        key("laws", "set of laws that keys left out take their defaults from"),
        stated(Laws::default_of(s.model), laws),
        &mut s.laws,
    );
    let geometry = match s.laws {
        Laws::Mechanics => stated(GeometryLaw::Exact, "of the set \"mechanics\""),
        Laws::Li2023 if pushes => {
            stated(GeometryLaw::Exact, "waves, and damage on a half-space, push back on every body")
        }
        Laws::Li2023 => stated(GeometryLaw::Centred, PAPER),
    };
    k.key(key("geometry", "normals and levers of contacts"), geometry, &mut s.geometry);
    k.key(key("seed", "of the phases of waviness"), stated(1, "the first"), &mut s.seed);
    k.key(key("model", "equations"), stated(ModelKind::Full, "the model itself"), &mut s.model);
    k.key(key("duration_s", "simulated time").above(0.0).to(1e6), duration(s.laws, (b, o)), &mut s.duration_s);
    k.key(
        key("sample_rate_hz", "f_s").above(0.0).to(1e9),
        stated(25600.0, "the paper's data logger"),
        &mut s.sample_rate_hz,
    );
    k.key(key("start", "state at t = 0"), stated(Start::Rolling, PAPER), &mut s.start);
    k.key(
        key("accuracy", "tolerance of the integrator"),
        assumed(
            Accuracy::Standard,
            left_open(
                b,
                "the paper does not state its integrator",
                "the energy audit of a run says whether it is enough",
            ),
        ),
        &mut s.accuracy,
    );
    k.key(
        key("most_steps", "steps that the run may take: one that would take more is refused").from(1.0),
        stated(MOST_STEPS, "minutes to an hour; a second of most bearings takes some 1e5"),
        &mut s.most_steps,
    );
    let usual = ["inner_*", "outer_*", "cage*", "sensor_*"].map(String::from);
    k.key(
        key("record", "channels to keep; * matches any characters"),
        stated(usual.to_vec(), "rings, cages and the sensor pair"),
        &mut s.record,
    );
}
