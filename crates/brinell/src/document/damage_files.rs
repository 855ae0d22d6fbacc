//! Every key of a shape that is in a file of its own: an image, a drawing, a scan.

use super::keys::Fallback::Required;
use super::keys::{Fallback, Keys, assumed, stated};
use super::scale_value::ScaleBar;
use super::spec::{Spec, key};
use super::value_type::ValueType;
use crate::scenario::*;

pub(super) const FILE: Spec = key("file", "path, from the scenario's folder");
pub(super) const SCALE_BAR: Spec = key("scale_bar", "a length in the picture, from which mm_per_pixel follows");
/// What the keys of a scan need; a `depth_map` may hold its numbers instead.
const FILED: &str = "there is a `file`";

/// A key that every file of damage has: of a scan only where there is one (`filed`), of an image or a drawing always
/// (`None`).
fn shared<T: ValueType>(k: &mut Keys, filed: Option<bool>, spec: Spec, fallback: Fallback<T>, value: &mut T) {
    match filed {
        None => k.key(spec, fallback, value),
        Some(wanted) => k.key_where(spec, (wanted, FILED), fallback, value),
    }
}

fn center(k: &mut Keys, filed: Option<bool>, value: &mut bool) {
    let spec = key("center", "the damage's bounding box at the defect's centre; false: the middle of the picture");
    shared(k, filed, spec, stated(true, "centred"), value);
}

fn direction(k: &mut Keys, filed: Option<bool>, value: &mut RollingDirection) {
    let doc = "where +s, counter-clockwise on the surface, points in the picture; rollers pass an outer raceway towards +s at \
               positive speed, an inner one towards -s";
    let spec = key("rolling_direction", doc);
    let fallback = assumed(RollingDirection::Right, "along the rows");
    shared(k, filed, spec, fallback, value);
}

fn speck(k: &mut Keys, filed: Option<bool>, fallback: Fallback<f64>, value: &mut f64) {
    let spec = key("speck_mm2", "spots smaller than this are left out").from(0.0);
    shared(k, filed, spec, fallback, value);
}

pub(super) fn image(k: &mut Keys, i: &mut ImageFile) {
    k.key(FILE, Required, &mut i.file);
    let mut bar: Option<ScaleBar> = None;
    k.optional(SCALE_BAR, &mut bar);
    let scale = key("mm_per_pixel", "the side of a pixel").above(0.0);
    let of_bar = |bar: ScaleBar| Fallback::Instead { value: bar.mm_per_pixel(), how: "from scale_bar", assumed: false };
    let fallback = bar.map_or(Required, of_bar);
    k.key(scale.to(10.0).unit("mm"), fallback, &mut i.mm_per_pixel);
    let threshold = key(
        "threshold",
        "darker is damage, 0 black, 1 white; left out: half of the damage's contrast, the light evened out",
    );
    k.optional(threshold.above(0.0).to(1.0), &mut i.threshold);
    k.key(
        key("use_alpha", "the mask is the alpha channel"),
        stated(false, "the picture's brightness"),
        &mut i.use_alpha,
    );
    k.key(key("invert", "lighter, or more transparent, is damage"), stated(false, "damage is darker"), &mut i.invert);
    direction(k, None, &mut i.rolling_direction);
    center(k, None, &mut i.center);
    k.key(key("edges", "how the outline runs between pixels"), stated(ImageEdges::SubPixel, "a photo"), &mut i.edges);
    let mut blur_px = i.blur_px.unwrap_or(f64::NAN);
    let blur = key("blur_px", "standard deviation of the blur before, pixels");
    k.key_where(
        blur.from(0.0).to(20.0),
        (i.edges == ImageEdges::SubPixel, "edges = \"sub-pixel\""),
        assumed(1.5, "calms a photo's noise"),
        &mut blur_px,
    );
    i.blur_px = (i.edges == ImageEdges::SubPixel).then_some(blur_px);
    let dirt = assumed(0.02, "dirt and grinding marks");
    speck(k, None, dirt, &mut i.speck_mm2);
    let region = "what of the picture is read: left, top, width, height; left out: all";
    k.optional(key("region_px", region).from(0.0).to(65_535.0), &mut i.region_px);
    let pieces = "which dark pieces are damage; left out: of a photo the largest, of a mask or with a threshold all";
    k.optional(key("pieces", pieces), &mut i.pieces);
    let at = "a point within the piece that is damage, from the upper left corner";
    k.optional(key("at_px", at).from(0.0).to(65_535.0), &mut i.at_px);
}

pub(super) fn svg(k: &mut Keys, d: &mut SvgFile) {
    k.key(FILE, Required, &mut d.file);
    let id = "id of a path, shape or group; left out: the whole drawing";
    k.optional(key("path_id", id), &mut d.path_id);
    let scale = key("mm_per_unit", "scale; left out: the drawing's own").above(0.0);
    k.optional(scale.to(1e4).unit("mm"), &mut d.mm_per_unit);
    let tolerance = key("tolerance_mm", "how far polygons stray from curves");
    k.key(tolerance.from(1e-5).to(1.0), stated(0.001, "far below what is felt"), &mut d.tolerance_mm);
    center(k, None, &mut d.center);
}

/// The keys of a scan beside its file and spacing.
pub(super) fn scan(k: &mut Keys, wanted: bool, s: &mut ScanFile) {
    let filed = (wanted, FILED);
    k.key_where(key("unit", "what the numbers count"), filed, stated(ScanUnit::Um, "micrometres"), &mut s.unit);
    let mut nm_per_count = s.nm_per_count.unwrap_or(f64::NAN);
    k.only_where(
        key("nm_per_count", "height of one count").above(0.0).to(1e6).unit("nm"),
        wanted && s.unit == ScanUnit::Counts,
        "unit = \"counts\"",
        &mut nm_per_count,
    );
    s.nm_per_count = (wanted && s.unit == ScanUnit::Counts).then_some(nm_per_count);
    k.key_where(
        key("height_positive_up", "heights; false: depths"),
        filed,
        stated(true, "a profilometer's heights"),
        &mut s.height_positive_up,
    );
    k.optional(key("missing", "number that marks a missing point, beside empty cells and nan"), &mut s.missing);
    k.key_where(key("fill", "what to do about missing points"), filed, stated(ScanFill::None, "refused"), &mut s.fill);
    k.key_where(
        key("remove_form", "the surface's own form, fitted and taken off"),
        filed,
        stated(ScanForm::None, "nothing is taken off"),
        &mut s.remove_form,
    );
    let radius = key("radius_mm", "radius along s of the cylinder or torus; left out: fitted");
    k.optional(radius.above(0.0).to(1e5), &mut s.radius_mm);
    k.key_where(
        key("zero", "what counts as depth 0"),
        filed,
        assumed(ScanZero::RimMedian, "the rim is undamaged"),
        &mut s.zero,
    );
    let mut zero_percentile = s.zero_percentile.unwrap_or(f64::NAN);
    k.only_where(
        key("zero_percentile", "percent of the points").from(0.0).to(100.0).unit("%"),
        wanted && s.zero == ScanZero::Percentile,
        "zero = \"percentile\"",
        &mut zero_percentile,
    );
    s.zero_percentile = (wanted && s.zero == ScanZero::Percentile).then_some(zero_percentile);
    k.key_where(
        key("first_row", "where the file's first row is"),
        filed,
        stated(FirstRow::Top, "as in print"),
        &mut s.first_row,
    );
    direction(k, Some(wanted), &mut s.rolling_direction);
    k.key_where(
        key("threshold_um", "shallower is undamaged").from(0.0).to(5000.0),
        filed,
        assumed(1.0, "noise and roughness"),
        &mut s.threshold_um,
    );
    speck(k, Some(wanted), stated(0.0, "all count"), &mut s.speck_mm2);
    center(k, Some(wanted), &mut s.center);
}
