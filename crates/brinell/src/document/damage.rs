//! Every key of a `[[defects]]` entry and of its shape.

use super::damage_files;
use super::enum_strings::SurfaceWord;
use super::keys::Fallback::{Needed, Required};
use super::keys::{Keys, PAPER, Variant, assumed, derived, stated};
use super::spec::{Spec, key};
use crate::scenario::*;

const NONE: f64 = f64::NAN;

/// Name, pattern, one without values, meaning.
macro_rules! shapes {
    ($($name:literal: $shape:pat, $blank:expr, $doc:literal;)+) => {
        &[$(Variant { name: $name, doc: $doc, blank: || $blank, is: |shape| matches!(shape, $shape) }),+]
    };
}

/// The shapes of a defect.
const SHAPES: &[Variant<Shape>] = shapes! {
    "rectangle": Shape::Rectangle { .. }, Shape::unset(), "as wide all along";
    "circle": Shape::Circle { .. }, Shape::Circle { diameter_mm: NONE }, "a round pit";
    "profile": Shape::Profile { .. }, Shape::Profile { arc_mm: Vec::new(), width_mm: Vec::new(), depth_um: None },
        "points joined by lines; where arc_mm repeats, it jumps";
    "li2023_irregular": Shape::Li2023Irregular { .. }, Shape::Li2023Irregular { max_width_mm: NONE },
        "the paper's irregular spall, 7 mm long";
    "outline": Shape::Outline { .. }, Shape::Outline { polygons_mm: Vec::new() },
        "polygons seen from above; a polygon within another is a hole";
    "depth_map": Shape::DepthMap { .. } | Shape::Scan(_), Shape::DepthMap { grid: DepthGrid::unset() },
        "depths on a grid, bilinear between its nodes (the law ecl takes each damaged node as wide as dz): in a file, or \
         written out";
    "grown": Shape::Grown { .. }, Shape::Grown { outline: Vec::new(), max_width_mm: None, area_mm2: None },
        "an outline scaled alike in both directions to a width or an area";
    "random": Shape::Random { .. }, Shape::Random { seed: 0, length_mm: NONE, width_mm: NONE, roughness: NONE },
        "a ragged spall drawn from a seed, its mean depth the defect's";
    "image": Shape::Image(_), Shape::Image(ImageFile::default()), "a photo or a mask, PNG or JPEG";
    "svg": Shape::Svg(_), Shape::Svg(SvgFile::default()), "a drawing from a vector editor";
};

impl Shape {
    /// As the scenario file says it: `rectangle`, `random`, ...
    pub fn word(&self) -> &'static str {
        let known = SHAPES.iter().find(|variant| (variant.is)(self));
        known.map_or("", |variant| variant.name)
    }
}

pub(super) fn defect(k: &mut Keys, load: [f64; 2], d: &mut Defect) {
    let mut word = SurfaceWord::from(d.on);
    let mut roller = match d.on {
        Surface::Roller(number) => number,
        _ => 1,
    };
    k.key(key("on", "damaged surface"), Required, &mut word);
    k.only_where(
        key("roller", "which roller of the row, from 1").from(1.0),
        word == SurfaceWord::Roller,
        "on = \"roller\"",
        &mut roller,
    );
    d.on = match word {
        SurfaceWord::OuterRaceway => Surface::OuterRaceway,
        SurfaceWord::InnerRaceway => Surface::InnerRaceway,
        SurfaceWord::Roller => Surface::Roller(roller),
    };
    k.key(key("row", "which row, from 1").from(1.0), assumed(1, "the first row"), &mut d.row);
    let center = if word == SurfaceWord::OuterRaceway {
        derived(load[1].atan2(load[0]).to_degrees(), "the middle of the load zone")
    } else {
        assumed(0.0, "it turns through the load anyway")
    };
    k.key(key("center_deg", "psi, counter-clockwise from +x"), center, &mut d.center_deg);
    k.one_of(
        key("shape", "outline; length along s, counter-clockwise around the surface, width along the axis"),
        SHAPES,
        &mut d.shape,
        shape,
    );
    let depth = match &d.shape {
        Shape::Profile { depth_um: Some(_), .. } => stated(0.0, "the profile has depths of its own"),
        Shape::DepthMap { .. } | Shape::Scan(_) => stated(0.0, "the depth map has depths of its own"),
        _ => Needed("a profile with depth_um of its own, or a depth map, does without"),
    };
    let spec = key("depth_um", "h; depths of a profile or a depth map override it");
    k.key(spec.from(0.0), depth, &mut d.depth_um);
    k.key(
        key("axial_offset_mm", "moves the shape along the axis, +z"),
        stated(0.0, "z = 0 of the shape is the middle of the row"),
        &mut d.axial_offset_mm,
    );
    k.optional(
        key(
            "table",
            "delta_eff(s, delta) of the contact over this damage, from elsewhere; CSV from the scenario's folder",
        ),
        &mut d.table,
    );
}

fn shape(k: &mut Keys, shape: &mut Shape) {
    const WIDTH: Spec = key("width_mm", "L_s, along the axis, at most the roller's length").from(0.0);
    match shape {
        Shape::Rectangle { length_mm, width_mm } => {
            let length = key("length_mm", "along s, around the surface").above(0.0);
            k.key(length, Required, length_mm);
            k.key(WIDTH, Required, width_mm);
        }
        Shape::Circle { diameter_mm } => {
            let diameter = key("diameter_mm", "2 a, at most the roller's length").above(0.0);
            k.key(diameter, Required, diameter_mm);
        }
        Shape::Profile { arc_mm, width_mm, depth_um } => {
            let arc = key("arc_mm", "s of each point, counter-clockwise around the surface, never decreasing");
            k.key(arc, Required, arc_mm);
            k.key(WIDTH, Required, width_mm);
            let depth = key("depth_um", "h_s at each point; left out: the defect's depth");
            k.optional(depth.from(0.0), depth_um);
        }
        Shape::Li2023Irregular { max_width_mm } => {
            let width = key("max_width_mm", "largest L_s, at most the roller's length");
            k.key(width.from(0.0), stated(4.0, PAPER), max_width_mm);
        }
        Shape::Outline { polygons_mm } => polygons(k, polygons_mm),
        Shape::DepthMap { .. } | Shape::Scan(_) => depth_map(k, shape),
        Shape::Image(image) => damage_files::image(k, image),
        Shape::Svg(drawing) => damage_files::svg(k, drawing),
        Shape::Grown { outline, max_width_mm, area_mm2 } => {
            polygons(k, outline);
            let width = key("max_width_mm", "largest L_s after scaling; this or the area");
            k.optional(width.above(0.0), max_width_mm);
            let area = key("area_mm2", "area after scaling; this or the width");
            k.optional(area.above(0.0), area_mm2);
        }
        Shape::Random { seed, length_mm, width_mm, roughness } => {
            k.key(key("seed", "which spall"), stated(1, "the first"), seed);
            let length = key("length_mm", "extent along s, around the surface").above(0.0);
            k.key(length, Required, length_mm);
            k.key(WIDTH.above(0.0), Required, width_mm);
            let rough = key("roughness", "0: even ellipse; 1: as ragged as it gets");
            k.key(rough.from(0.0).to(1.0), assumed(0.5, "between even and ragged"), roughness);
        }
    }
}

/// One polygon as `points_mm`, several as `polygons_mm`.
fn polygons(k: &mut Keys, polygons: &mut Vec<Vec<[f64; 2]>>) {
    let (mut one, mut several) = match &polygons[..] {
        [] => (None, None),
        [only] => (Some(only.clone()), None),
        _ => (None, Some(polygons.clone())),
    };
    k.optional(
        key("points_mm", "corners [s, z] of one polygon, in order; s counter-clockwise around the surface"),
        &mut one,
    );
    k.optional(key("polygons_mm", "lists of corners, for several polygons"), &mut several);
    *polygons = one.into_iter().chain(several.into_iter().flatten()).collect();
}

/// Columns or rows of a grid at the most.
const MOST_NODES: f64 = 20_000.0;

fn depth_map(k: &mut Keys, shape: &mut Shape) {
    let (mut file, mut g, mut scan) = match shape {
        Shape::DepthMap { grid } => (None, grid.clone(), ScanFile::default()),
        Shape::Scan(scan) => (Some(scan.file.clone()), DepthGrid::unset(), scan.clone()),
        _ => return,
    };
    k.optional(
        damage_files::FILE.doc(
            "CSV, NPY, 16-bit PNG, SDF, X3P or SUR, from the scenario's folder; instead of columns, rows, depth_um",
        ),
        &mut file,
    );
    let written = (file.is_none(), "there is no `file`");
    let spacing = |name, doc| key(name, doc).above(0.0);
    let count = |name, doc| key(name, doc).from(2.0).to(MOST_NODES);
    let centred = |n: usize, d: f64| {
        let start = -0.5 * n.saturating_sub(1) as f64 * d;
        derived(start, "the grid's middle at the defect's centre")
    };
    let ds = spacing(
        "ds_mm",
        "from point to point along s, around the surface: between columns, or between a file's rows where \
         rolling_direction is up or down; of a file that says its own, left out",
    );
    let dz = spacing(
        "dz_mm",
        "from point to point along the axis: between rows, or between a file's columns where \
         rolling_direction is up or down; of a file that says its own, left out",
    );
    match file {
        Some(_) => {
            k.optional(ds, &mut scan.ds_mm);
            k.optional(dz, &mut scan.dz_mm);
        }
        None => {
            k.only_where(ds, true, written.1, &mut g.ds_mm);
            k.only_where(dz, true, written.1, &mut g.dz_mm);
        }
    }
    k.key_where(count("columns", "nodes along s"), written, Required, &mut g.columns);
    k.key_where(count("rows", "nodes along z"), written, Required, &mut g.rows);
    k.key_where(key("s0_mm", "s of the first column"), written, centred(g.columns, g.ds_mm), &mut g.s0_mm);
    k.key_where(key("z0_mm", "z of the first row"), written, centred(g.rows, g.dz_mm), &mut g.z0_mm);
    k.key_where(
        key("depth_um", "depths row by row, columns of a row in order; 0 undamaged, negative raised"),
        written,
        Required,
        &mut g.depth_um,
    );
    damage_files::scan(k, file.is_some(), &mut scan);
    *shape = match file {
        Some(file) => {
            scan.file = file;
            Shape::Scan(scan)
        }
        None => Shape::DepthMap { grid: g },
    };
}
