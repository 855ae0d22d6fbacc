//! Every key of a scenario file: name, meaning, range, default, once and in order; those of the bearing are in
//! [`super::bearing_keys`], of damage in [`super::damage`], the sensor's in [`super::sensor`].

use std::f64::consts::PI;

use super::bearing_keys::{ROLLERS, STEEL, bearing, tilt_key};
use super::damage::defect;
use super::keys::Fallback::{self, Needed, Required};
use super::keys::{Keys, PAPER, assumed, derived, stated};
use super::sensor::sensor;
use super::spec::{Spec, key};
use super::unset;
use crate::contact::{ball, is_line_exponent, palmgren_stiffness};
use crate::scenario::*;

/// Exponent of a line contact (`docs/src/theory/contact.md`).
const LINE_EXPONENT: f64 = 10.0 / 9.0;
/// Exponent of a point contact (Hertz).
const POINT_EXPONENT: f64 = 1.5;

const POINT_OF_SCOPE: &str = "not in the paper's model";

pub(crate) fn scenario<K: Keys>(k: &mut K, s: &mut Scenario) {
    let name = key("name", "name of the run, free text");
    k.key(name, stated("unnamed".into(), "no name given"), &mut s.name);
    // Which keys act, and what others default to, depends on the equations.
    if let Some(model) = k.foretold("simulation", "model") {
        s.simulation.model = model;
    }
    if let Some(laws) = k.foretold("simulation", "laws") {
        s.simulation.laws = laws;
    }
    let (model, laws) = (s.simulation.model, s.simulation.laws);
    k.section(key("bearing", "geometry and masses"), |k| bearing(k, model, &mut s.bearing));
    k.section(key("cage", "one cage for each row"), |k| cage(k, (laws, &s.bearing), &mut s.cage));
    k.section(key("contact", "rollers on raceways, along the normal"), |k| {
        contact(k, (laws, model, &s.bearing), &mut s.contact)
    });
    k.section(key("friction", "rollers on raceways, along the surface"), |k| friction(k, laws, &mut s.friction));
    k.section(key("housing", "fixed to the outer ring, moves with it"), |k| {
        let mass = match laws {
            Laws::Mechanics => {
                derived(20.0 * s.bearing.outer_ring_mass_kg, "20 times the outer ring: a small pillow block")
            }
            Laws::Li2023 => stated(0.0, PAPER),
        };
        k.key(key("mass_kg", "added to the outer ring's").from(0.0), mass, &mut s.housing.mass_kg);
    });
    k.section(key("lubricant", "oil"), |k| lubricant(k, &s.bearing, &mut s.lubricant));
    k.section(key("operation", "speed, load and gravity"), |k| operation(k, (model, &s.bearing), &mut s.operation));
    k.section(key("support", "springs and dampers that hold the rings"), |k| {
        support(k, (model, &s.bearing, s.operation.load_on), &mut s.support)
    });
    let load = s.operation.load_n;
    k.tables(key("defects", "damage: none, one or many"), &mut s.defects, unset::defect, |k, d| defect(k, load, d));
    k.section(key("sensor", "from the outer ring to the record: nothing, unless a key says so"), |k| {
        sensor(k, &mut s.sensor)
    });
    k.section(key("simulation", "what to compute and to record"), |k| simulation(k, &mut s.simulation));
}

/// Force of an oiled pocket whose clearance is used up, N: the linear law that models of ball bearings take from Meeks
/// and Ng (1985), K_c = 11/C_p. Taken for rollers too, of which no such number was found.
const OILED_POCKET_N: f64 = 11.0;
/// Stiffness of a pocket of steel on steel, N/m, as assumed for the paper's bearing.
const STEEL_POCKET: f64 = 1e7;

fn cage<K: Keys>(k: &mut K, (laws, b): (Laws, &Bearing), c: &mut Cage) {
    let d = b.roller_diameter_mm;
    k.key(
        key("inner_diameter_mm", "2 a").above(0.0),
        derived(b.pitch_diameter_mm - 2.0 / 3.0 * d, "pitch less 2/3 roller diameter"),
        &mut c.inner_diameter_mm,
    );
    k.key(
        key("outer_diameter_mm", "2 b").above(0.0),
        derived(b.pitch_diameter_mm + 2.0 / 3.0 * d, "pitch plus 2/3 roller diameter"),
        &mut c.outer_diameter_mm,
    );
    let thickness = 0.5 * (c.outer_diameter_mm - c.inner_diameter_mm);
    let mass = match b.element {
        // A ring of width 1.25 L with its pockets cut out.
        Element::Roller => {
            let area = 1.25 * PI * b.pitch_diameter_mm - b.rollers_per_row as f64 * d;
            derived(
                STEEL * thickness * b.roller_length_mm * area,
                "steel ring, width 1.25 roller lengths, pockets cut out",
            )
        }
        Element::Ball => derived(
            STEEL * thickness * 0.2 * d * PI * b.pitch_diameter_mm,
            "two pressed steel strips, each 0.1 ball diameters thick",
        ),
    };
    k.key(key("mass_kg", "m_c").above(0.0), mass, &mut c.mass_kg);
    k.key(
        key("pocket_clearance_mm", "C_p, to each side").from(0.0),
        derived(15.0 * d / 1000.0, "1.5 % of the roller diameter"),
        &mut c.pocket_clearance_mm,
    );
    k.key(
        key("guidance", "what centres the cage"),
        assumed(Guidance::Rollers, "most cages from stock are centred so"),
        &mut c.guidance,
    );
    let film = match c.guidance {
        Guidance::Rollers => stated(GuidanceFilm::Dynamic, "rollers guide: there is no film"),
        Guidance::OuterRing | Guidance::InnerRing => {
            assumed(GuidanceFilm::Dynamic, "with whirl and squeeze, which the paper's quasi-static film leaves out")
        }
    };
    k.key(key("guidance_film", "film between the cage and its guiding ring"), film, &mut c.guidance_film);
    let (gap, how) = match c.guidance {
        Guidance::Rollers => (c.pocket_clearance_mm.max(0.01), "the pocket's"),
        Guidance::InnerRing => {
            (0.5 * (c.inner_diameter_mm - b.inner_raceway_diameter_mm), "gap between cage and inner raceway")
        }
        Guidance::OuterRing => {
            (0.5 * (b.outer_raceway_diameter_mm - c.outer_diameter_mm), "gap between cage and outer raceway")
        }
    };
    k.key(
        key("guide_clearance_mm", "C_g, radial gap of the land").above(0.0),
        derived(gap, how),
        &mut c.guide_clearance_mm,
    );
    k.key(
        key("guide_width_mm", "L_1, width of the land").above(0.0),
        match b.element {
            Element::Roller => derived(b.roller_length_mm, "the roller's length"),
            Element::Ball => derived(0.25 * d, "a quarter of the ball's diameter"),
        },
        &mut c.guide_width_mm,
    );
    let (walls, pockets) = match (laws, b.element) {
        (Laws::Mechanics, Element::Roller) => {
            (stated(Walls::Oiled, OIL), stated(Pockets::Slot, "rollers lie in slots"))
        }
        (Laws::Mechanics, Element::Ball) => {
            (stated(Walls::Oiled, OIL), stated(Pockets::Round, "balls lie in round pockets"))
        }
        (Laws::Li2023, _) => (stated(Walls::Linear, PAPER), stated(Pockets::Slot, PAPER)),
    };
    k.key(key("walls", "walls of pockets and lands"), walls, &mut c.walls);
    k.key(key("pockets", "what pockets hold"), pockets, &mut c.pockets);
    let oiled = c.walls == Walls::Oiled;
    k.key_where(
        key("friction_coefficient", "mu_p, elements in pockets").from(0.0),
        (oiled, "cage.walls is \"oiled\""),
        assumed(0.05, "oiled steel or brass; no source for cages of its kind"),
        &mut c.friction_coefficient,
    );
    springs(k, !oiled, c);
    if oiled {
        c.contact_stiffness_n_per_m = 0.0;
        c.contact_damping_ns_per_m = 0.0;
        c.land_stiffness_n_per_m = 0.0;
        c.land_damping_ns_per_m = 0.0;
    } else {
        c.friction_coefficient = 0.0;
    }
}

const OIL: &str = "11 N of oil at the wall (Meeks and Ng 1985), Hertz behind it";

/// Springs and dampers of linear walls.
fn springs<K: Keys>(k: &mut K, linear: bool, c: &mut Cage) {
    let acts = (linear, "cage.walls is \"linear\"");
    k.key_where(
        key("contact_stiffness_n_per_m", "k_c, of pockets").above(0.0),
        acts,
        assumed(
            OILED_POCKET_N / (1e-3 * c.pocket_clearance_mm.max(0.01)),
            "11 N over the pocket's clearance: oil cushions it (Meeks)",
        ),
        &mut c.contact_stiffness_n_per_m,
    );
    k.key_where(
        key("contact_damping_ns_per_m", "c_c, of pockets").from(0.0),
        acts,
        assumed(
            20.0 * (c.contact_stiffness_n_per_m / STEEL_POCKET).sqrt(),
            "as large a share of the critical damping as 20 N s/m are at 1e7 N/m",
        ),
        &mut c.contact_damping_ns_per_m,
    );
    k.key_where(
        key("land_stiffness_n_per_m", "k_l, where the cage meets a ring").above(0.0),
        acts,
        derived(c.contact_stiffness_n_per_m, "that of pockets"),
        &mut c.land_stiffness_n_per_m,
    );
    k.key_where(
        key("land_damping_ns_per_m", "c_l, where the cage meets a ring").from(0.0),
        acts,
        derived(c.contact_damping_ns_per_m, "that of pockets"),
        &mut c.land_damping_ns_per_m,
    );
}

fn contact<K: Keys>(k: &mut K, (laws, model, b): (Laws, ModelKind, &Bearing), c: &mut Contact) {
    let law = match (model, &b.profile) {
        (ModelKind::Full, _) if laws == Laws::Mechanics => stated(Law::HalfSpace, "damage as on elastic steel"),
        _ if b.has_balls() => stated(Law::Sliced, "strips across the groove"),
        (ModelKind::Tilting, _) => stated(Law::Sliced, "what tilts has slices"),
        (_, RollerProfile::Straight) => stated(Law::Ecl, PAPER),
        _ => stated(Law::Sliced, "a profile has slices"),
    };
    let path = match b.element {
        Element::Roller if laws == Laws::Mechanics => {
            stated(RollerPath::Envelope, "what a roller's radius lets it reach")
        }
        Element::Roller => stated(RollerPath::Point, PAPER),
        Element::Ball => stated(RollerPath::Envelope, "what a ball's radius lets it reach"),
    };
    k.key(key("law", "force of a damaged contact"), law, &mut c.law);
    let by_depth =
        (c.law != Law::HalfSpace, "contact.law is \"ecl\" or \"sliced\": of the half-space it is part of the solution");
    k.key_where(key("roller_path", "how a roller follows the damage's depth"), by_depth, path, &mut c.roller_path);
    let slices_why = match b.element {
        Element::Roller => "ecl does not use them",
        Element::Ball => "as of rollers",
    };
    k.key(
        key("slices", "slices across the roller, under balls across the damage; ecl does not use them")
            .from(1.0)
            .to(10000.0),
        stated(30, slices_why),
        &mut c.slices,
    );
    k.key_where(
        key("edge_reaction", "push of the damage's slopes along the orbit"),
        by_depth,
        stated(EdgeReaction::None, PAPER),
        &mut c.edge_reaction,
    );
    k.key_where(
        key("exponent", "n of Q = K delta^n").from(1.0).to(2.0),
        (!b.has_balls(), ROLLERS),
        stated(LINE_EXPONENT, "line contact, 10/9"),
        &mut c.exponent,
    );
    if b.has_balls() {
        c.exponent = POINT_EXPONENT;
    }
    k.key_where(
        key("edge_radius_um", "length over which edges of damage are rounded").above(0.0).to(1000.0),
        (c.law == Law::HalfSpace, "contact.law is \"half-space\""),
        assumed(10.0, "a sharp edge of a spall"),
        &mut c.edge_radius_um,
    );
    if c.law != Law::HalfSpace {
        c.edge_radius_um = 0.0;
    }
    steel(k, b, c);
    let [inner, outer] = stiffness(b, c);
    k.key(key("inner_stiffness", "K_in of a healthy contact").above(0.0).unit("N/m^n"), inner, &mut c.inner_stiffness);
    k.key(key("outer_stiffness", "K_out of a healthy contact").above(0.0).unit("N/m^n"), outer, &mut c.outer_stiffness);
    damping(k, laws, c);
}

/// One of two keys: a damper of its own, or a time with the contact's stiffness.
fn damping<K: Keys>(k: &mut K, laws: Laws, c: &mut Contact) {
    const TIME: Spec =
        key("damping_time_us", "tau: damping tau times the tangent stiffness; in place of damping_ns_per_m")
            .from(0.0)
            .to(1e5);
    const CONSTANT: Spec = key("damping_ns_per_m", "c, at each raceway; in place of damping_time_us").from(0.0);
    let (mut time, mut constant) = match c.damping {
        ContactDamping::Time { us } => (Some(us), None),
        ContactDamping::Constant { ns_per_m } => (None, Some(ns_per_m)),
    };
    match laws {
        Laws::Mechanics => {
            k.optional(CONSTANT, &mut constant);
            let mut us = time.unwrap_or(f64::NAN);
            let why = "known to a factor of four either way (Kraemer: 2.5 to 25 us for whole bearings)";
            let case = (constant.is_none(), "contact.damping_ns_per_m is left out");
            k.key_where(TIME, case, assumed(2.5, why), &mut us);
            time = Some(us);
        }
        Laws::Li2023 => {
            k.optional(TIME, &mut time);
            let mut c = constant.unwrap_or(f64::NAN);
            let case = (time.is_none(), "contact.damping_time_us is left out");
            k.key_where(CONSTANT, case, assumed(200.0, PAPER), &mut c);
            constant = time.is_none().then_some(c);
        }
    }
    c.damping = match (constant, time) {
        (Some(ns_per_m), _) => ContactDamping::Constant { ns_per_m },
        (None, us) => ContactDamping::Time { us: us.unwrap_or(f64::NAN) },
    };
    let timed = matches!(c.damping, ContactDamping::Time { .. });
    k.key_where(
        key("roughness_um", "delta_s: the damper rises over this deformation").above(0.0).to(100.0),
        (timed, "contact.damping_time_us acts"),
        assumed(0.1, "ground raceways"),
        &mut c.roughness_um,
    );
    if !timed {
        c.roughness_um = 0.0;
    }
}

/// What Hertz's ellipse needs of the material; of rollers Palmgren's constant has it in it.
fn steel<K: Keys>(k: &mut K, b: &Bearing, c: &mut Contact) {
    let wanted =
        (b.has_balls() || c.law == Law::HalfSpace, "bearing.element is \"ball\" or contact.law is \"half-space\"");
    let mut modulus = c.youngs_modulus_gpa.unwrap_or(f64::NAN);
    k.key_where(
        key("youngs_modulus_gpa", "E of rolling elements and rings").above(0.0),
        wanted,
        stated(206.0, "rolling bearing steel (ISO/TS 16281)"),
        &mut modulus,
    );
    let mut ratio = c.poisson_ratio.unwrap_or(f64::NAN);
    k.key_where(
        key("poisson_ratio", "Poisson's ratio of rolling elements and rings").from(0.0).to(0.5),
        wanted,
        stated(0.3, "steel"),
        &mut ratio,
    );
    c.youngs_modulus_gpa = wanted.0.then_some(modulus);
    c.poisson_ratio = wanted.0.then_some(ratio);
}

/// Stiffness of the healthy inner and outer contact where the file gives none.
pub(super) fn stiffness(b: &Bearing, c: &Contact) -> [Fallback<f64>; 2] {
    if b.has_balls() {
        // Without ellipses a groove or the material is at fault, which is reported.
        let of = ball::ellipses(b, c).map_or([f64::NAN; 2], |ellipses| ellipses.map(|e| e.stiffness));
        return of.map(|of| derived(of, "Hertz, of the ball's and the groove's curvatures"));
    }
    let palmgren = || {
        if is_line_exponent(c.exponent) {
            derived(palmgren_stiffness(b.roller_length_mm), "Palmgren, 8.06e4 L^(8/9)")
        } else {
            Needed("where contact.exponent is not 10/9, Palmgren's stiffness does not hold")
        }
    };
    [palmgren(), palmgren()]
}

fn friction<K: Keys>(k: &mut K, laws: Laws, f: &mut Friction) {
    let rolling = match laws {
        Laws::Mechanics => {
            assumed(7e-4, "torque of deep-groove bearings; a third of SKF's estimate is sliding and oil")
        }
        Laws::Li2023 => stated(0.0, PAPER),
    };
    k.key(
        key("rolling_coefficient", "k_r, rolling resistance over radius and force").from(0.0).to(0.1),
        rolling,
        &mut f.rolling_coefficient,
    );
    k.key(key("raceway_coefficient", "mu").from(0.0), assumed(0.02, PAPER), &mut f.raceway_coefficient);
    k.key(
        key("slip_velocity_m_per_s", "v_s of tanh(slip / v_s)").above(0.0),
        assumed(0.05, "regularises friction; the paper does not state it"),
        &mut f.slip_velocity_m_per_s,
    );
}

fn lubricant<K: Keys>(k: &mut K, b: &Bearing, l: &mut Lubricant) {
    k.key(
        key("viscosity_pa_s", "eta of the cage's guidance film and of the raceway film").from(0.0),
        assumed(0.01, "warm spindle oil; the paper does not state it"),
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

fn operation<K: Keys>(k: &mut K, (model, b): (ModelKind, &Bearing), o: &mut Operation) {
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
        assumed(0.02, "the paper does not state it"),
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

fn support<K: Keys>(k: &mut K, (model, b, load_on): (ModelKind, &Bearing, LoadOn), s: &mut Support) {
    // Soft where the load acts, or the support would carry it instead of the rollers
    // (`docs/src/theory/motion.md`).
    let why = "soft on the loaded ring, stiff on the other; the paper does not state it";
    let (inner, outer) = match load_on {
        LoadOn::OuterRing => (5e7, 1e6),
        LoadOn::InnerRing => (1e6, 5e7),
    };
    k.key(key("inner_stiffness_n_per_m", "k_i").from(0.0), assumed(inner, why), &mut s.inner_stiffness_n_per_m);
    k.key(
        key("inner_damping_ns_per_m", "c_i").from(0.0),
        assumed(500.0, "the paper does not state it"),
        &mut s.inner_damping_ns_per_m,
    );
    k.key(key("outer_stiffness_n_per_m", "k_o").from(0.0), assumed(outer, why), &mut s.outer_stiffness_n_per_m);
    k.key(
        key("outer_damping_ns_per_m", "c_o").from(0.0),
        assumed(500.0, "the paper does not state it"),
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

fn simulation<K: Keys>(k: &mut K, s: &mut Simulation) {
    k.key(key("laws", "set of laws that gives the defaults"), stated(Laws::DEFAULT, "the default"), &mut s.laws);
    let geometry = match (s.laws, s.model) {
        (_, ModelKind::Lumped) => stated(GeometryLaw::Centred, "the lumped model's"),
        (Laws::Mechanics, _) => stated(GeometryLaw::Exact, "so that momentum and energy close"),
        (Laws::Li2023, _) => stated(GeometryLaw::Centred, PAPER),
    };
    k.key(key("geometry", "levers and rates of contacts"), geometry, &mut s.geometry);
    k.key(key("seed", "seed of the waves' phases"), stated(1, "the first"), &mut s.seed);
    k.key(key("model", "equations"), stated(ModelKind::Full, "the model itself"), &mut s.model);
    k.key(
        key("duration_s", "simulated time").above(0.0).to(1e6),
        assumed(0.5, "the paper does not state it"),
        &mut s.duration_s,
    );
    k.key(
        key("sample_rate_hz", "f_s").above(0.0).to(1e9),
        stated(25600.0, "the paper's data logger"),
        &mut s.sample_rate_hz,
    );
    k.key(key("start", "state at t = 0"), stated(Start::Rolling, PAPER), &mut s.start);
    k.key(
        key("accuracy", "tolerance of the integrator"),
        assumed(Accuracy::Standard, "the paper does not state its integrator"),
        &mut s.accuracy,
    );
    let usual = ["inner_*", "outer_*", "cage*", "sensor_*"].map(String::from);
    k.key(
        key("record", "channels to keep; * matches any characters"),
        stated(usual.to_vec(), "rings, cages and the sensor pair"),
        &mut s.record,
    );
}
