//! `brinell defect preview`: damage as it is seen before it is simulated.

use super::entry::chosen;
use crate::args::PreviewArgs;
use crate::failure::Failure;
use crate::figures::drawn;
use crate::files::{Source, make_folder, safe_name};
use crate::results::{PREVIEW, Results};
use crate::say::{self, document, say, short};
use brinell::document::{Loaded, Origin, Provenance};
use brinell::made_by::MadeBy;
use brinell::scenario::Scenario;
use brinell_io::{Complete, atomic_prepare};
use brinell_report::{Damage, DamageCurves, DamagePanel, Layout, Picture, PressureView, damage_of};
use serde_json::json;
use std::path::Path;

/// The pictures, curves and numbers of each defect, and `preview.json` with all of them.
pub(super) fn preview(args: &PreviewArgs) -> Result<(), Failure> {
    let source = Source::open(&args.scenario.scenario, &args.scenario.set)?;
    let loaded = source.load(&[], false)?;
    let s = &loaded.scenario;
    let layout = args.print.layout(&args.formats)?;
    chosen(s, args.defect.unwrap_or(1))?;
    let mut all = damages(s, args)?;
    let mut photos = source.photos();
    for (index, damage) in &mut all {
        damage.view.photo = photos.get_mut(*index).and_then(Option::take);
    }
    let folder = args.output.clone().unwrap_or_else(|| Path::new("out").join(safe_name(&s.name)).join("damage"));
    // Any scenario's preview gives way to the next: it takes a moment to make.
    let earlier = Results::PREVIEW.earlier(&folder, &source.inputs(), args.overwrite, |_| true)?;
    make_folder(&folder)?;
    let mut ready = Vec::new();
    let mut entries = Vec::new();
    for (index, damage) in &all {
        if !args.json {
            tell(damage, form(&loaded, *index));
        }
        let pictures = pictures(*index, damage, layout);
        ready.extend(drawn(&pictures, &args.formats, &folder)?);
        tables(*index, damage, &folder, &mut ready)?;
        entries.push(entry(*index, damage));
    }
    let json = json!({ "scenario": s.name, "version": brinell::VERSION, "made_by": MadeBy::of_scenario(&s.to_toml()), "files": null, "defects": entries });
    let (written, text) = earlier.publish(ready, (PREVIEW, json), None, (&[], &[]))?;
    if args.json {
        document(text.trim_end());
        return Ok(());
    }
    say::wrote(written);
    Ok(())
}

/// The defects requested, each with its index, in a ring that is thick enough for them.
fn damages(s: &Scenario, args: &PreviewArgs) -> Result<Vec<(usize, Damage)>, Failure> {
    if let Some(x) = args.ring_thickness_mm.filter(|x| !(x.is_finite() && *x > 0.0)) {
        return Err(Failure::Usage(format!("--ring-thickness-mm {x}: expected a thickness above 0, in mm")));
    }
    let all = damage_of(s, args.ring_thickness_mm)?.into_iter().enumerate();
    let previewed: Vec<_> = all.filter(|(index, _)| args.defect.is_none_or(|n| n == index + 1)).collect();
    for (index, damage) in &previewed {
        let deepest_mm = 1e-3 * damage.measures.deepest_um;
        if let Some(x) = args.ring_thickness_mm.filter(|x| *x <= deepest_mm) {
            return Err(Failure::Usage(format!(
                "--ring-thickness-mm {x}: defect {} is {} mm deep; expected a thicker ring, in mm",
                index + 1,
                short(deepest_mm, 4)
            )));
        }
    }
    Ok(previewed)
}

fn pictures(index: usize, damage: &Damage, layout: Layout) -> Vec<Picture> {
    let view = &damage.view;
    let mut pictures: Vec<Picture> = brinell_report::damage_photo(view, index, layout).into_iter().collect();
    pictures.push(brinell_report::damage_plan(view, index, layout));
    pictures.push(brinell_report::damage_passage(view, index, layout));
    let pressures = view.pressures.iter();
    pictures.extend(pressures.map(|of| brinell_report::damage_pressure(view, of, index, layout)));
    if !view.section.panels.is_empty() {
        pictures.push(brinell_report::damage_section(view, index, layout));
    }
    layout.finished(pictures)
}

/// The curves of each picture as CSV.
fn tables(index: usize, damage: &Damage, folder: &Path, ready: &mut Vec<Complete>) -> Result<(), Failure> {
    let view = &damage.view;
    let both = [("passage", "angle_deg", &view.passage), ("section", "s_mm", &view.section)];
    for (name, axis, curves) in both.into_iter().filter(|(.., curves)| !curves.panels.is_empty()) {
        let path = folder.join(format!("damage-{}-{name}.csv", index + 1));
        ready.push(atomic_prepare(path, csv(axis, curves))?);
    }
    Ok(())
}

/// The radius that was fitted to a defect's scan.
fn form(loaded: &Loaded, index: usize) -> Option<String> {
    let key = format!("defects.{index}.shape.depth_map.radius_mm");
    let found = |p: &&Provenance| p.key == key && matches!(p.origin, Origin::Found(_));
    let radius = loaded.provenance.iter().find(found)?;
    Some(format!("radius {} mm, {}", radius.value, radius.reason()))
}

fn tell(damage: &Damage, form: Option<String>) {
    let view = &damage.view;
    say!("{}", view.title);
    for fact in &view.facts {
        let brinell_report::Value::Text(value) = &fact.value else {
            continue;
        };
        let unit = fact.unit.replace('µ', "u").replace('°', "deg");
        say!("  {:<24} {value:>9} {unit:<5} {}", fact.label, fact.note.replace('µ', "u"));
    }
    for note in view.photo.iter().flat_map(|photo| &photo.notes) {
        say!("  Photo: {note}");
    }
    if let Some(form) = form {
        say!("  Form: {form}");
    }
    say!("  Passage: {}", plain(&view.passage.note));
    for of in &view.pressures {
        say!("  Pressure: {}", plain(&of.note));
    }
    say!("  Section: {}", view.section.note);
    say!("");
}

/// Words in ASCII.
fn plain(words: &str) -> String {
    words.replace('µ', "u").replace("δⁿ", "delta^n").replace('δ', "delta")
}

/// "stiffness_k_ecl_point".
fn slug(words: &[&str]) -> String {
    let mut slug = String::new();
    for c in plain(&words.join(" ")).chars() {
        if c.is_ascii_alphanumeric() {
            slug.push(c.to_ascii_lowercase());
        } else if !slug.is_empty() && !slug.ends_with('_') {
            slug.push('_');
        }
    }
    slug.trim_end_matches('_').to_owned()
}

/// Name and values of each curve.
fn columns(panels: &[DamagePanel]) -> Vec<(String, &[f64])> {
    panels
        .iter()
        .flat_map(|p| p.curves.iter().map(|c| (slug(&[&p.label, &c.name, &p.unit]), c.values.as_slice())))
        .collect()
}

fn csv(axis: &str, curves: &DamageCurves) -> String {
    let columns = columns(&curves.panels);
    let mut text = axis.to_owned();
    for (name, _) in &columns {
        text += ",";
        text += name;
    }
    for (k, x) in curves.along.iter().enumerate() {
        text += &format!("\n{x}");
        for (_, values) in &columns {
            text += &format!(",{}", values[k]);
        }
    }
    text + "\n"
}

/// Largest pressure on one contact, and all of them with the cells' middles.
fn pressure(of: &PressureView) -> serde_json::Value {
    let [s, z] = of.middles_mm();
    let mut all = json!({
        "contact": of.contact,
        "s_mm": of.at_mm[0],
        "z_mm": of.at_mm[1],
        "note": plain(&of.note),
        "cells": { "s_mm": s, "z_mm": z, "pressure_mpa": of.pressure_mpa.chunks(of.columns.max(1)).collect::<Vec<_>>() },
    });
    for (name, value) in of.numbers() {
        all[name] = value.into();
    }
    all
}

fn entry(index: usize, damage: &Damage) -> serde_json::Value {
    let (m, view) = (&damage.measures, &damage.view);
    let curves = |axis: &str, of: &DamageCurves| {
        let mut all = serde_json::Map::new();
        all.insert(axis.into(), of.along.as_slice().into());
        for (name, values) in columns(&of.panels) {
            all.insert(name, values.into());
        }
        all
    };
    json!({
        "defect": index + 1,
        "title": view.title,
        "length_mm": m.length_mm,
        "arc_deg": m.arc_deg,
        "width_mm": m.width_mm,
        "widest_mm": m.widest_mm,
        "area_mm2": m.area_mm2,
        "area_in_ecl_mm2": m.area_in_ecl_mm2,
        "mean_depth_um": m.mean_depth_um,
        "deepest_um": m.deepest_um,
        "raised_um": m.raised_um,
        "time_to_pass_ms": m.pass_ms,
        "speed_rpm": m.speed_rpm,
        "load_zone_share": m.load_zone_share,
        "load_zone_mm": view.load_zone_mm,
        "approach_um": m.approach_um,
        "heaviest_contact_n": m.force_n,
        "polygons_mm": view.polygons_mm,
        "passage_note": plain(&view.passage.note),
        "passage": curves("angle_deg", &view.passage),
        "pressure": view.pressures.iter().map(pressure).collect::<Vec<_>>(),
        "section_note": view.section.note,
        "section": curves("s_mm", &view.section),
    })
}
