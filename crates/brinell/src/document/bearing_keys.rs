//! The keys of `[bearing]`: geometry, masses, clearance, grooves, profile; and those that act where rings tilt.

use std::f64::consts::PI;

use super::keys::Fallback::{self, Catalogued};
use super::keys::{Keys, PAPER, assumed, derived, stated};
use super::spec::{Spec, key};
use crate::bearing::USUAL_CONFORMITY;
use crate::bearing::clearance::{ClearanceClass, bore_diameter_mm, largest_bore_mm};
use crate::bearing::rating::roller_length_mm;
use crate::scenario::*;
use crate::steel::DENSITY;

/// What tells raceways beside a name.
const OR_CIRCLE: &str = ", or pitch_diameter_mm and roller_diameter_mm";
/// Where some keys have a meaning.
pub(super) const ROLLERS: &str = "bearing.element is \"roller\"";
pub(super) const BALLS: &str = "bearing.element is \"ball\"";

/// Mass of a roller or ball of steel, kg.
pub(super) fn steel_element_kg(b: &Bearing) -> f64 {
    let d = b.roller_diameter_mm;
    match b.element {
        Element::Roller => DENSITY * PI / 4.0 * d.powi(2) * b.roller_length_mm,
        Element::Ball => DENSITY * PI / 6.0 * d.powi(3),
    }
}

pub(super) fn bearing(k: &mut Keys, (model, laws): (ModelKind, Laws), b: &mut Bearing) {
    k.preset(key("preset", "catalogue bearing that fills the keys left out"), laws, &mut b.preset);
    k.key(
        key("element", "what rolls; the keys named after rollers are then a ball's"),
        stated(Element::Roller, "cylindrical rollers, as in the paper"),
        &mut b.element,
    );
    let of_bearing = |k: &mut Keys, name| k.foretold::<f64>("bearing", name);
    let of_circle = of_bearing(k, "pitch_diameter_mm").zip(of_bearing(k, "roller_diameter_mm")).filter(|(p, d)| p > d);
    // Where a sheet prints pitch circle and balls, and no grooves.
    let raceway =
        |of: fn((f64, f64)) -> f64, how| of_circle.map_or(Catalogued(OR_CIRCLE), |circle| derived(of(circle), how));
    k.key(
        key("inner_raceway_diameter_mm", "D_i").above(0.0),
        raceway(|(p, d)| p - d, "pitch diameter less roller diameter"),
        &mut b.inner_raceway_diameter_mm,
    );
    k.key(
        key("outer_raceway_diameter_mm", "D_o").above(0.0),
        raceway(|(p, d)| p + d, "pitch diameter plus roller diameter"),
        &mut b.outer_raceway_diameter_mm,
    );
    let mean = 0.5 * (b.inner_raceway_diameter_mm + b.outer_raceway_diameter_mm);
    k.key(
        key("pitch_diameter_mm", "D_m, circle of the roller centres").above(0.0),
        derived(mean, "mean of the raceway diameters"),
        &mut b.pitch_diameter_mm,
    );
    // Where a sheet prints the raceways alone, F and E of a cylindrical roller bearing.
    let between = 0.5 * (b.outer_raceway_diameter_mm - b.inner_raceway_diameter_mm);
    k.key(
        key("roller_diameter_mm", "d").above(0.0),
        if between > 0.0 && b.inner_raceway_diameter_mm > 0.0 {
            derived(between, "half of what the raceway diameters differ by")
        } else {
            Catalogued("")
        },
        &mut b.roller_diameter_mm,
    );
    k.key(key("rollers_per_row", "Z").from(3.0).to(1000.0), Catalogued(""), &mut b.rollers_per_row);
    k.key(key("rows", "N_r").from(1.0).to(100.0), assumed(1, "a single row"), &mut b.rows);
    k.optional(
        key(
            "static_load_rating_n",
            "C0, as a maker prints it; gives roller_length_mm by ISO 76 where that is left out",
        )
        .above(0.0),
        &mut b.static_load_rating_n,
    );
    k.key_where(
        key("roller_length_mm", "L, effective contact length").plausible_times(0.9, 1.1).above(0.0),
        (!b.has_balls(), ROLLERS),
        match b.static_load_rating_n.map(|c0| roller_length_mm(b, c0)) {
            Some(length) if length.is_finite() => {
                derived(length, "from static_load_rating_n by ISO 76: C0 = 44 (1 - d / D_m) i Z L d")
            }
            _ => Catalogued(""),
        },
        &mut b.roller_length_mm,
    );
    if b.has_balls() {
        b.roller_length_mm = b.roller_diameter_mm;
    }
    grooves(k, b);
    let stagger = key("row_stagger_deg", "row i starts (i - 1) times this later");
    let stagger_default = if b.rows == 1 {
        stated(0.0, "a single row")
    } else {
        derived(180.0 / b.rollers_per_row as f64, "half a roller pitch")
    };
    k.key(stagger, stagger_default, &mut b.row_stagger_deg);
    clearance(k, laws, b);
    k.key(
        key("outer_gap_um", "gap subtracted at the outer contact too").from(0.0),
        stated(0.0, "all clearance is at the inner contact"),
        &mut b.outer_gap_um,
    );
    // Rings of rectangular section. Of rollers: wall 0.6 d, width 1.6 L for each row, within 8 % of the NN3007's sum;
    // of balls: wall 0.45 d, width 1.75 d, within 12 % of what makers print for 6204 to 6206 less balls and cage.
    let (width, ring_how) = match b.element {
        Element::Roller => (1.6, "steel ring, wall 0.6 roller diameters, width 1.6 roller lengths a row"),
        Element::Ball => (1.75, "steel ring, wall 0.45 and width 1.75 ball diameters"),
    };
    let wall = ring_wall_mm(b);
    let ring = |mean_diameter: f64| DENSITY * PI * mean_diameter * wall * width * b.roller_length_mm * b.rows as f64;
    let inner_ring = ring(b.inner_raceway_diameter_mm - wall);
    let outer_ring = ring(b.outer_raceway_diameter_mm + wall);
    k.key(
        key("inner_ring_mass_kg", "m_i, with all that moves with it").plausible_times(0.7, 1.5).above(0.0),
        derived(inner_ring, ring_how),
        &mut b.inner_ring_mass_kg,
    );
    k.key(
        key("outer_ring_mass_kg", "m_o, with all that moves with it").plausible_times(0.7, 1.5).above(0.0),
        derived(outer_ring, ring_how),
        &mut b.outer_ring_mass_kg,
    );
    let how = if b.has_balls() { "steel ball" } else { "steel cylinder" };
    k.key(key("roller_mass_kg", "m").above(0.0), derived(steel_element_kg(b), how), &mut b.roller_mass_kg);
    // A catalogue bearing's profile is no reason to refuse a scenario that has no slices.
    let unsliced = |how| Fallback::Instead { value: RollerProfile::Straight, how, assumed: false };
    let profile = match (model, k.foretold("contact", "law")) {
        (ModelKind::Lumped, _) => unsliced("the lumped model has no slices, and so no profile"),
        (ModelKind::Full, Some(Law::Ecl)) => unsliced("law \"ecl\" has no slices, and so no profile"),
        (ModelKind::Full, None) if laws == Laws::Li2023 => unsliced("the paper's rollers are straight"),
        _ => stated(RollerProfile::Straight, PAPER),
    };
    k.key_where(
        key("profile", "p(z), the drop of roller and raceway together"),
        (!b.has_balls(), ROLLERS),
        profile,
        &mut b.profile,
    );
    k.optional(key("waviness", "waves of every raceway, A_k = amplitude_um k^-exponent"), &mut b.waviness);
    k.optional(key("element_waviness", "waves of every rolling element, likewise"), &mut b.element_waviness);
    tilt_key(
        k,
        (model, b.element),
        key("width_mm", "B, width of the rings").above(0.0),
        derived(1.6 * b.roller_length_mm * b.rows as f64, "1.6 roller lengths a row"),
        &mut b.width_mm,
    );
    let spacing =
        if b.rows == 1 { stated(0.0, "a single row") } else { derived(1.5 * b.roller_length_mm, "1.5 roller lengths") };
    tilt_key(
        k,
        (model, b.element),
        key("row_spacing_mm", "b, between the middles of two rows").from(0.0),
        spacing,
        &mut b.row_spacing_mm,
    );
}

/// A key of `tilting`, which balls do not do.
pub(super) fn tilt_key(
    k: &mut Keys,
    (model, element): (ModelKind, Element),
    spec: Spec,
    fallback: Fallback<f64>,
    value: &mut f64,
) {
    let acts = (model == ModelKind::Tilting, "simulation.model is \"tilting\"");
    match element {
        Element::Roller => k.key_acting_where(spec, acts, fallback, value),
        Element::Ball => {
            // Nothing acts on it: what it holds is no matter.
            let mut none = f64::NAN;
            k.key_where(spec, (false, ROLLERS), fallback.clone(), &mut none);
            *value = fallback.value().unwrap_or(none);
        }
    }
}

/// Conformities of the grooves, which only balls have.
fn grooves(k: &mut Keys, b: &mut Bearing) {
    let has_balls = b.has_balls();
    for (spec, value) in [
        (
            key("inner_groove_conformity", "radius of the inner groove's cross-section over the ball's diameter")
                .plausible(0.51, 0.53),
            &mut b.inner_groove_conformity,
        ),
        (
            key("outer_groove_conformity", "radius of the outer groove's cross-section over the ball's diameter")
                .plausible(0.51, 0.54),
            &mut b.outer_groove_conformity,
        ),
    ] {
        let mut conformity = value.unwrap_or(f64::NAN);
        k.key_where(
            spec.above(0.5).to(1.0),
            (has_balls, BALLS),
            assumed(USUAL_CONFORMITY, "the usual groove of deep-groove bearings (Harris)"),
            &mut conformity,
        );
        *value = has_balls.then_some(conformity);
    }
}

/// C_r of class CN; `None` where there is no bore.
fn usual_clearance_um(b: &Bearing) -> Option<f64> {
    let bore = bore_diameter_mm(b).unwrap_or(b.inner_raceway_diameter_mm - 2.0 * ring_wall_mm(b));
    let largest = f64::from(largest_bore_mm(b.element));
    // Beyond the standard's table in proportion to the bore, as it grows within.
    let (within, beyond) = (bore.min(largest), (bore / largest).max(1.0));
    ClearanceClass::CN.one_sided_middle(b.element, within).map(|gap| gap * beyond)
}

/// Wall of a ring under its raceway, mm.
fn ring_wall_mm(b: &Bearing) -> f64 {
    let diameters = match b.element {
        Element::Roller => 0.6,
        Element::Ball => 0.45,
    };
    diameters * b.roller_diameter_mm
}

/// The clearance: on one side, on the diameter, or as a class of ISO 5753-1. `checks` sees to it that only one is
/// given.
fn clearance(k: &mut Keys, laws: Laws, b: &mut Bearing) {
    k.optional(
        key("bore_diameter_mm", "bore, for clearance_class; left out, the preset's").above(0.0),
        &mut b.bore_diameter_mm,
    );
    let (mut diametral, mut class): (Option<f64>, Option<ClearanceClass>) = (None, None);
    k.optional(
        key(
            "diametral_clearance_um",
            "radial internal clearance of ISO 5753, twice radial_clearance_um; in place of it",
        ),
        &mut diametral,
    );
    k.optional(
        key("clearance_class", "class of ISO 5753-1 for the bore, its middle is used; in place of radial_clearance_um"),
        &mut class,
    );
    let of_class = |class: ClearanceClass| {
        let middle = bore_diameter_mm(b).and_then(|d| class.one_sided_middle(b.element, d));
        middle.unwrap_or(f64::NAN)
    };
    let default = match (diametral, class) {
        (Some(diametral), _) => {
            Fallback::Instead { value: 0.5 * diametral, how: "half of bearing.diametral_clearance_um", assumed: false }
        }
        (None, Some(class)) => Fallback::Instead {
            value: of_class(class),
            how: "bearing.clearance_class, half of the middle of its diametral range (ISO 5753-1)",
            assumed: true,
        },
        (None, None) if let Some(class) = k.named_clearance() => Fallback::Instead {
            value: of_class(class),
            how: "the class of clearance in the bearing's name, half of the middle of its diametral range (ISO 5753-1)",
            assumed: true,
        },
        (None, None) if let (Laws::Mechanics, Some(gap)) = (laws, usual_clearance_um(b)) => derived(
            gap,
            "half of the middle of class CN of ISO 5753-1 for the bore, beyond its table in proportion; a bore that leaves the inner ring's usual wall if none is given",
        ),
        (None, None) => match b.element {
            Element::Roller => assumed(10.0, "a small bearing's usual gap, and the NN3007's"),
            Element::Ball => assumed(6.25, "half of the middle of class CN of ISO 5753-1 for bores of 18 to 30 mm"),
        },
    };
    k.key(
        key("radial_clearance_um", "C_r, gap on one side, half of ISO 5753's; negative is preload")
            .plausible_times(0.4, 1.6),
        default,
        &mut b.radial_clearance_um,
    );
}
