//! Of `brinell check`: a bearing.

use crate::say::{plain_number, plural, say, short, significant};
use brinell::bearing::clearance::{bore_diameter_mm, classes_of};
use brinell::bearing::estimated_elements;
use brinell::bearing::rating::static_rating;
use brinell::defect::wrap;
use brinell::derived::Derived;
use brinell::document::Loaded;
use brinell::model::Model;
use brinell::observe::passes::place;
use brinell::pressure::{pressure_beside, pressures, static_limit};
use brinell::scenario::{Bearing, ContactDamping, Element, GeometryLaw, Scenario, Speed, Surface};
use brinell::statics::StaticLoadZone;
use std::f64::consts::TAU;

/// Elements, clearance, rating.
pub(super) fn bearing(s: &Scenario) {
    let b = &s.bearing;
    let element = b.element.word();
    let size = match b.element {
        Element::Roller => format!("{} x {} mm", plain_number(b.roller_diameter_mm), plain_number(b.roller_length_mm)),
        Element::Ball => format!("of {} mm", plain_number(b.roller_diameter_mm)),
    };
    say!(
        "Bearing   {}{} of {} {}s {size} on a {} mm pitch circle",
        b.preset.as_ref().map_or(String::new(), |p| format!("{p}: ")),
        plural(b.rows, "row"),
        b.rollers_per_row,
        element,
        plain_number(b.pitch_diameter_mm),
    );
    say!("Clearance {}", clearance(b));
    say!("Rating    {}", rating(s));
}

pub(super) fn frequencies(s: &Scenario, d: &Derived) {
    let at = match s.operation.speed_rpm {
        Speed::Constant(rpm) if rpm < 0.0 => format!("at {} r/min, clockwise", plain_number(-rpm)),
        Speed::Constant(rpm) => format!("at {} r/min, counter-clockwise", plain_number(rpm)),
        Speed::Profile(_) => format!("at the top speed, {} r/min", short(60.0 * d.top_speed / TAU, 5)),
    };
    say!("Frequencies in pure rolling, {at}");
    for (name, value, meaning) in d.kinematics.table(d.top_speed / TAU) {
        say!("  {name:<7} {value:>10.3} Hz   {meaning}");
    }
    if let Some(how) = estimated_elements(&s.bearing) {
        say!("  the rolling elements: {how}, and so may these frequencies");
    }
}

pub(super) fn stiffnesses(s: &Scenario, d: &Derived) {
    say!("Stiffnesses");
    say!(
        "  healthy contacts        inner {}, outer {} N/m^n with n = {}",
        short(s.contact.inner_stiffness, 4),
        short(s.contact.outer_stiffness, 4),
        short(s.contact.exponent, 5)
    );
    say!(
        "  {:<23} inner {}, outer {} N/m",
        format!("at {} N", short(d.contact_force, 3)),
        short(d.contact_stiffness[0], 3),
        short(d.contact_stiffness[1], 3)
    );
    match s.contact.damping {
        ContactDamping::Constant { ns_per_m } => say!(
            "  damping                 {} N s/m, {} s times their mean; for whole bearings Kraemer gives 2.5e-6 to 2.5e-5 s",
            plain_number(ns_per_m),
            short(2.0 * ns_per_m / (d.contact_stiffness[0] + d.contact_stiffness[1]), 2)
        ),
        ContactDamping::Time { us } => say!(
            "  damping                 {} s times the stiffness at hand; for whole bearings Kraemer gives 2.5e-6 to 2.5e-5 s",
            short(1e-6 * us, 2)
        ),
    }
}

pub(super) fn time_scales(s: &Scenario, model: &Model, d: &Derived) {
    let element = s.bearing.element.word();
    say!("Time scales");
    say!(
        "  {:<23} {} Hz, damping ratio {}",
        format!("{element} between raceways"),
        short(d.roller_frequency, 3),
        short(d.roller_damping_ratio, 2)
    );
    let [inner, outer] = d.support_frequencies.map(|f| short(f, 3));
    match model.outer_ring_is_fixed() {
        true => say!("  ring on its support     inner {inner} Hz; the outer one is held"),
        false => say!("  rings on their supports inner {inner} Hz, outer {outer} Hz"),
    }
    say!("  ball-pass period        {} ms", short(1e3 * d.roller_period, 4));
    for (defect, time) in model.defects.iter().zip(&d.defect_passes) {
        let (first, last) = defect.shape.arc();
        say!(
            "  over the defect on the {}: {} ms for {} mm",
            place(defect),
            short(1e3 * time, 3),
            short(1e3 * (last - first), 3)
        );
    }
    say!("  longest step            {} us under the heaviest contact, without impacts", short(1e6 * d.longest_step, 3));
    say!("  centrifugal force       {} N a {element}", short(d.centrifugal_force, 3));
}

/// How many values nobody gave, or all of them.
pub(super) fn assumptions(loaded: &Loaded, listed: bool) {
    let assumed: Vec<_> = loaded.provenance.iter().filter(|p| p.assumed).collect();
    if listed {
        say!("Assumed, because it was not given:");
        for p in &assumed {
            let ends = |[low, high]: [f64; 2]| format!("; plausible {} to {}", short(low, 3), short(high, 3));
            let plausible = p.plausible.map_or(String::new(), ends);
            say!("  {} = {} {}  ({}{plausible})", p.key, rounded(&p.value), p.unit, p.reason());
        }
    } else {
        say!("{} values are assumed; --assumptions lists them", assumed.len());
    }
}

/// On one side, on the diameter, and the classes that this is.
fn clearance(b: &Bearing) -> String {
    let diametral = 2.0 * b.radial_clearance_um;
    let both = format!(
        "{} um on one side, {} um on the diameter",
        plain_number(b.radial_clearance_um),
        plain_number(diametral)
    );
    if diametral < 0.0 {
        return format!("{both}: preload");
    }
    let Some(bore) = bore_diameter_mm(b) else {
        return both;
    };
    let classes: Vec<&str> = classes_of(b.element, bore, diametral).iter().map(|c| c.name()).collect();
    match classes.is_empty() {
        true => format!("{both}; in no class of ISO 5753-1 for a bore of {bore} mm"),
        false => format!("{both}; ISO 5753-1 {} for a bore of {bore} mm", classes.join(" and ")),
    }
}

/// The static load rating, and how far the load is from it.
fn rating(s: &Scenario) -> String {
    let rating = static_rating(&s.bearing);
    let load = s.operation.load_n[0].hypot(s.operation.load_n[1]);
    let factor = if load > 0.0 { format!(", {} times the load", short(rating.load / load, 3)) } else { String::new() };
    format!(
        "C0 = {} kN{factor} ({})",
        short(1e-3 * rating.load, 3),
        rating.source.unwrap_or("estimate by the formula of ISO 76")
    )
}

/// A value for a list: a number that takes more than eight digits is cut to six.
fn rounded(value: &str) -> String {
    let digits = value.bytes().filter(u8::is_ascii_digit).count();
    match value.parse::<f64>() {
        Ok(x) if digits > 8 => short(x, 6),
        _ => value.to_owned(),
    }
}

/// `on_supports`: whether its rings are on supports, not in a machine.
pub(super) fn static_balance(s: &Scenario, model: &Model, zone: &StaticLoadZone, on_supports: bool) {
    let size = zone.shift[0].hypot(zone.shift[1]);
    say!("Static balance under the full load, over a pitch of the cage");
    let with = match model.defects.iter().any(|defect| defect.surface != Surface::OuterRaceway) {
        _ if s.defects.is_empty() => "",
        true => " with the damage, turned through the load zone",
        false => " with the damage",
    };
    say!("  heaviest contact        {} N{with}", short(zone.largest, 4));
    // Where the load along a roller is not even, its slices say more.
    if s.has_even_contacts() {
        even_pressures(s, model, zone);
    }
    let from_to = match zone.extent > 0.0 && zone.extent < TAU {
        true => {
            let [from, to] = zone.arc().map(|end| wrap(end).to_degrees());
            format!(", from {from:.1} to {to:.1} deg")
        }
        false => String::new(),
    };
    let without = if s.defects.is_empty() { "" } else { " (of the bearing without its damage)" };
    say!("  load zone               {:.1} deg wide{from_to}{without}", zone.extent.to_degrees());
    say!(
        "  inner ring from outer   ({}, {}) um",
        significant(1e6 * zone.shift[0], 1e6 * size, 4),
        significant(1e6 * zone.shift[1], 1e6 * size, 4)
    );
    if !on_supports {
        return;
    }
    say!(
        "  bearing stiffness       xx {}, yy {}, xy {} N/m{}",
        short(zone.stiffness[0][0], 4),
        short(zone.stiffness[1][1], 4),
        significant(zone.stiffness[0][1], zone.stiffness[0][0], 2),
        if s.defects.is_empty() { "" } else { " (with its damage)" }
    );
    say!(
        "  loaded ring's support   takes {} N of the {} N of load{}; the heaviest contact and the life are those of the rest",
        short(zone.support, 3),
        short(model.force_on_loaded_ring(), 5),
        if s.operation.gravity_m_per_s2 == [0.0; 2] { "" } else { " and ring weight" }
    );
    // The lumped model's orbits are prescribed.
    if !s.simulation.model.moves_every_part() {
        return;
    }
    let by = short(1e6 * zone.sunk.abs(), 3);
    // Exact levers are those of where the rings are.
    if s.simulation.geometry == GeometryLaw::Exact {
        return say!("  support deflection      {by} um");
    }
    say!(
        "  support deflection      {by} um: FTF and BPFO come out up to {} % {} than of a centred bearing",
        short(100.0 * zone.sunk.abs() / model.geometry.pitch_radius, 2),
        if zone.sunk < 0.0 { "lower" } else { "higher" }
    );
}

/// Of contacts whose load is even along the roller. Damage outside the load zone never sees the heaviest of them.
fn even_pressures(s: &Scenario, model: &Model, zone: &StaticLoadZone) {
    let [inner, outer] = pressures(s, zone.heaviest()).map(|p| short(1e-6 * p, 4));
    say!(
        "  contact pressure        {inner} MPa at the inner raceway, {outer} MPa at the outer one; static limit {} MPa",
        plain_number(1e-6 * static_limit(&s.bearing))
    );
    for (k, defect) in model.defects.iter().enumerate().filter(|(_, defect)| zone.reaches(model, defect)) {
        if let Some((left, pressure)) = pressure_beside(model, s, k, zone.heaviest()) {
            say!(
                "  beside the damage       {} MPa at most on the {} mm of contact left on the {}",
                short(1e-6 * pressure, 4),
                short(1e3 * left, 3),
                place(defect)
            );
        }
    }
}
