//! The keys of `[cage]`.

use std::f64::consts::PI;

use super::keys::Fallback;
use super::keys::{Keys, PAPER, assumed, derived, stated};
use super::spec::{Spec, key};
use crate::scenario::*;
use crate::steel::DENSITY;

/// Force of an oiled pocket whose clearance is used up, N: the linear law that models of ball bearings take from Meeks
/// and Ng (1985), K_c = 11/C_p. Taken for rollers too, of which no such number was found.
const OILED_POCKET_N: f64 = 11.0;
/// Stiffness of a pocket of steel on steel, N/m, as assumed for the paper's bearing.
const STEEL_POCKET: f64 = 1e7;

pub(super) fn cage(k: &mut Keys, (laws, b): (Laws, &Bearing), c: &mut Cage) {
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
                DENSITY * thickness * b.roller_length_mm * area,
                "steel ring, width 1.25 roller lengths, pockets cut out",
            )
        }
        Element::Ball => derived(
            DENSITY * thickness * 0.2 * d * PI * b.pitch_diameter_mm,
            "two pressed steel strips, each 0.1 ball diameters thick",
        ),
    };
    k.key(key("mass_kg", "m_c").plausible_times(0.5, 2.0).above(0.0), mass, &mut c.mass_kg);
    k.key(
        key("pocket_clearance_mm", "C_p, to each side").plausible_times(0.3, 2.0).from(0.0),
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
        key("guide_clearance_mm", "C_g, radial gap of the land").plausible_times(0.5, 2.0).above(0.0),
        derived(gap, how),
        &mut c.guide_clearance_mm,
    );
    k.key(
        key("guide_width_mm", "L_1, width of the land").plausible_times(0.5, 2.0).above(0.0),
        match b.element {
            Element::Roller => derived(b.roller_length_mm, "the roller's length"),
            Element::Ball => derived(0.25 * d, "a quarter of the ball's diameter"),
        },
        &mut c.guide_width_mm,
    );
    walls(k, (laws, b), c);
}

/// What pockets and lands hold with.
fn walls(k: &mut Keys, (laws, b): (Laws, &Bearing), c: &mut Cage) {
    let walls = match laws {
        Laws::Mechanics => stated(Walls::Oiled, "of the set \"mechanics\""),
        Laws::Li2023 => stated(Walls::Linear, PAPER),
    };
    k.key(key("walls", "law of pockets and lands"), walls, &mut c.walls);
    let pockets = match (laws, b.element) {
        (Laws::Mechanics, Element::Ball) => stated(Pockets::Round, "cages of balls have round ones"),
        (Laws::Mechanics, Element::Roller) => stated(Pockets::Slot, "cages of rollers have oblong ones"),
        (Laws::Li2023, _) => stated(Pockets::Slot, PAPER),
    };
    k.key(key("pockets", "shape of the pockets"), pockets, &mut c.pockets);
    let oiled = (c.walls == Walls::Oiled, OILED);
    k.key_acting_where(
        key("friction_coefficient", "mu_p, of elements in pockets").plausible(0.02, 0.15).from(0.0),
        oiled,
        assumed(0.05, "boundary lubrication between steel and a cage"),
        &mut c.friction_coefficient,
    );
    let linear = c.walls == Walls::Linear;
    linear_key(
        k,
        linear,
        key("contact_stiffness_n_per_m", "k_c, of pockets").plausible_times(0.2, 5.0).above(0.0),
        assumed(
            OILED_POCKET_N / (1e-3 * c.pocket_clearance_mm.max(0.01)),
            "11 N over the pocket's clearance: oil cushions it (Meeks)",
        ),
        &mut c.contact_stiffness_n_per_m,
    );
    linear_key(
        k,
        linear,
        key("contact_damping_ns_per_m", "c_c, of pockets").plausible_times(0.2, 5.0).from(0.0),
        assumed(
            20.0 * (c.contact_stiffness_n_per_m / STEEL_POCKET).sqrt(),
            "as large a share of the critical damping as 20 N s/m are at 1e7 N/m",
        ),
        &mut c.contact_damping_ns_per_m,
    );
    linear_key(
        k,
        linear,
        key("land_stiffness_n_per_m", "k_l, where the cage meets a ring").above(0.0),
        derived(c.contact_stiffness_n_per_m, "that of pockets"),
        &mut c.land_stiffness_n_per_m,
    );
    linear_key(
        k,
        linear,
        key("land_damping_ns_per_m", "c_l, where the cage meets a ring").from(0.0),
        derived(c.contact_damping_ns_per_m, "that of pockets"),
        &mut c.land_damping_ns_per_m,
    );
}

const OILED: &str = "cage.walls is \"oiled\"";
const LINEAR: &str = "cage.walls is \"linear\"";

/// A key of linear walls; elsewhere its field holds what its default is.
fn linear_key(k: &mut Keys, linear: bool, spec: Spec, fallback: Fallback<f64>, value: &mut f64) {
    if linear {
        return k.key_where(spec, (true, LINEAR), fallback, value);
    }
    // Nothing acts on it: what it holds is no matter.
    let mut none = f64::NAN;
    k.key_where(spec, (false, LINEAR), fallback.clone(), &mut none);
    *value = fallback.value().unwrap_or(none);
}
