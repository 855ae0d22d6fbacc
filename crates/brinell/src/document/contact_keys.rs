//! The keys of `[contact]`.

use super::bearing_keys::ROLLERS;
use super::enum_strings::EdgeReaction;
use super::keys::Fallback::{self, Needed};
use super::keys::{Keys, PAPER, assumed, derived, stated};
use super::spec::key;
use crate::contact::{ball, is_line_exponent, palmgren_stiffness};
use crate::scenario::*;
use crate::steel::{POISSONS_RATIO, YOUNGS_MODULUS_GPA};

/// Exponent of a line contact (`docs/src/theory/contact.md`).
const LINE_EXPONENT: f64 = 10.0 / 9.0;
/// Exponent of a point contact (Hertz).
const POINT_EXPONENT: f64 = 1.5;

pub(super) fn contact(k: &mut Keys, (laws, model, b): (Laws, ModelKind, &Bearing), c: &mut Contact) {
    let of_li2023 = laws == Laws::Li2023 && b.element == Element::Roller;
    let law = match (model, &b.profile) {
        (ModelKind::Lumped, _) => stated(Law::Ecl, PAPER),
        (ModelKind::Full, RollerProfile::Straight) if of_li2023 => stated(Law::Ecl, PAPER),
        _ => stated(Law::HalfSpace, "damage as on elastic steel"),
    };
    let path = match of_li2023 {
        true => stated(RollerPath::Point, PAPER),
        false => stated(RollerPath::Envelope, "what an element's radius lets it reach"),
    };
    k.key(
        key("law", "force of a contact on damage; ecl of straight rollers that do not tilt, and of the lumped model"),
        law,
        &mut c.law,
    );
    k.key_where(
        key("roller_path", "how an element follows the damage's depth"),
        (c.law == Law::Ecl, "contact.law is \"ecl\": the solution of \"half-space\" contains the element's size"),
        path,
        &mut c.roller_path,
    );
    if c.law == Law::Ecl {
        // What files of the paper's laws may say, and all that they may.
        k.optional(key("edge_reaction", "none: slopes of the damage do not push"), &mut None::<EdgeReaction>);
    }
    k.key(
        key("slices", "slices across rollers that have a profile or tilt; those of the load along a roller")
            .from(1.0)
            .to(10000.0),
        stated(30, "as ISO/TS 16281 asks for"),
        &mut c.slices,
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
    steel(k, b, c);
    let [inner, outer] = stiffness(b, c);
    k.key(
        key("inner_stiffness", "K_in of a healthy contact").plausible_times(0.8, 1.25).above(0.0).unit("N/m^n"),
        inner,
        &mut c.inner_stiffness,
    );
    k.key(
        key("outer_stiffness", "K_out of a healthy contact").plausible_times(0.8, 1.25).above(0.0).unit("N/m^n"),
        outer,
        &mut c.outer_stiffness,
    );
    damping(k, laws, c);
    k.key_acting_where(
        key("edge_radius_um", "length of the running mean that rounds the edges of damage")
            .plausible(2.0, 50.0)
            .from(0.0)
            .to(1000.0),
        (c.law == Law::HalfSpace, HALF_SPACE),
        assumed(10.0, "edges of spalls are no sharper"),
        &mut c.edge_radius_um,
    );
    k.key_acting_where(
        key("tables", "how exact the tables of damage are"),
        (c.law == Law::HalfSpace, HALF_SPACE),
        stated(Tables::Standard, "0.5 % of the deformation"),
        &mut c.tables,
    );
}

const HALF_SPACE: &str = "contact.law is \"half-space\"";

/// Damping by a time or by a constant: what the file gives, or the set of laws has.
fn damping(k: &mut Keys, laws: Laws, c: &mut Contact) {
    const TIME: &str = "damping_time_us";
    const CONSTANT: &str = "damping_ns_per_m";
    let [by_time, by_constant] = match (k.gives("contact", TIME), k.gives("contact", CONSTANT)) {
        // Both, of which the checks say something.
        (Some(true), Some(true)) => [true, true],
        (Some(false), Some(false)) => [laws == Laws::Mechanics, laws != Laws::Mechanics],
        (Some(time), Some(constant)) => [time, constant],
        _ => match c.damping {
            ContactDamping::Time { .. } => [true, false],
            ContactDamping::Constant { .. } => [false, true],
        },
    };
    let (mut us, mut ns_per_m) = match c.damping {
        ContactDamping::Time { us } => (us, f64::NAN),
        ContactDamping::Constant { ns_per_m } => (f64::NAN, ns_per_m),
    };
    k.key_where(
        key(TIME, "tau, damping is tau times the contact's stiffness; or damping_ns_per_m")
            .above(0.0)
            .to(1e4)
            .plausible(2.5, 25.0),
        (by_time, "contact.damping_ns_per_m is left out, or by default with the laws \"mechanics\""),
        assumed(
            2.5,
            "the lower end of the 2.5 to 25 us that Kraemer gives for whole bearings: levels may be some 7 dB lower",
        ),
        &mut us,
    );
    k.key_where(
        key(CONSTANT, "c, at each raceway; or damping_time_us").from(0.0).plausible_times(0.2, 5.0),
        (by_constant, "contact.damping_time_us is left out, or by default with the laws \"li2023\""),
        assumed(200.0, PAPER),
        &mut ns_per_m,
    );
    c.damping = if by_time { ContactDamping::Time { us } } else { ContactDamping::Constant { ns_per_m } };
    k.key_acting_where(
        key("roughness_um", "delta_s, over which damping sets in").plausible(0.03, 0.4).above(0.0).to(100.0),
        (by_time, "the damping is contact.damping_time_us"),
        assumed(0.1, "ground and honed raceways"),
        &mut c.roughness_um,
    );
}

const STEEL_ACTS: &str = "bearing.element is \"ball\", or contact.law \"half-space\"";

/// What Hertz's ellipse and the half-space need of the material; of healthy rollers Palmgren's constant has it in it.
fn steel(k: &mut Keys, b: &Bearing, c: &mut Contact) {
    let wanted = (b.has_balls() || c.law == Law::HalfSpace, STEEL_ACTS);
    let mut modulus = c.youngs_modulus_gpa.unwrap_or(f64::NAN);
    k.key_where(
        key("youngs_modulus_gpa", "E of elements and rings").above(0.0),
        wanted,
        stated(YOUNGS_MODULUS_GPA, "rolling bearing steel (ISO/TS 16281)"),
        &mut modulus,
    );
    let mut ratio = c.poisson_ratio.unwrap_or(f64::NAN);
    k.key_where(
        key("poisson_ratio", "Poisson's ratio of elements and rings").from(0.0).to(0.5),
        wanted,
        stated(POISSONS_RATIO, "steel"),
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
