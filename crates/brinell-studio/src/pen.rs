//! Damage that is drawn, or read from a file, as shapes of a scenario.

use crate::answers::{Drawn, Outline, Reply};
use crate::message::Arrays;
use crate::report::{Answer, Trouble};
use crate::text;
use brinell::defect::Extent;
use brinell::document::Loaded;
use brinell::scenario::{self, Scenario, Shape, Surface, TableData};
use brinell_damage::{Stroke, brush, scratch, shape_of_bytes, table_of_bytes};
use serde_json::{Map, Value, json};

/// A bearing that any shape of damage fits on, to read and write shapes with.
const WIDE: &str = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n";

/// A shape as its defect states it.
fn stated(shape: Shape) -> Answer<Value> {
    let mut scenario = Scenario::from_toml(WIDE)?;
    scenario.defects.push(scenario::Defect {
        on: Surface::OuterRaceway,
        row: 1,
        center_deg: 0.0,
        depth_um: 10.0,
        axial_offset_mm: 0.0,
        shape,
        table: None,
    });
    Ok(text::stated(&scenario.to_toml())["defects"][0]["shape"].clone())
}

/// The shape that a defect would state.
fn read(shape: &Value) -> Answer<Shape> {
    let mut whole = text::stated(WIDE);
    whole["defects"] = json!([{ "on": "outer-raceway", "center_deg": 0, "depth_um": 10, "shape": shape }]);
    let text = text::of_stated(&whole)?;
    let mut loaded = text::read(&text)?;
    Ok(loaded.scenario.defects.remove(0).shape)
}

fn points(request: &Value, arrays: &Arrays) -> Answer<Vec<[f64; 2]>> {
    let flat = request.get("points_mm").and_then(|p| arrays.doubles(p));
    let flat = flat.ok_or_else(|| Trouble::of("\"points_mm\" must be an array of f64"))?;
    Ok(flat.as_chunks::<2>().0.to_vec())
}

fn number(request: &Value, key: &str) -> Answer<f64> {
    let number = request.get(key).and_then(Value::as_f64);
    number.ok_or_else(|| Trouble::of(format!("\"{key}\" must be a number")))
}

/// What is drawn, between its least and its greatest s and z, mm, with its middle at a place of the stroke.
fn drawn(shape: Shape, [low, high]: [[f64; 2]; 2], center_mm: [f64; 2]) -> Answer<Reply> {
    let [length_mm, width_mm] = [0, 1].map(|k| high[k] - low[k]);
    Ok(Reply::Drawn(Drawn { shape: stated(shape)?, center_mm, length_mm, width_mm }))
}

/// `scratch`: the area under a round pen.
pub(crate) fn scratched(request: &Value, arrays: &Arrays) -> Answer<Reply> {
    let points = points(request, arrays)?;
    let stroke = Stroke { points_mm: &points, width_mm: number(request, "width_mm")? };
    let outline = scratch(&stroke).map_err(|e| Trouble::of(e.to_string()))?;
    let bounds = outline.bounds_mm().ok_or_else(|| Trouble::of("nothing is drawn"))?;
    let [low, high] = bounds;
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    // To a ten-thousandth of a millimetre: the page draws no finer, and a share link carries every digit.
    let near = |x: f64| (x * 1e4).round() / 1e4;
    let about = |p: &[f64; 2]| [near(p[0] - middle[0]), near(p[1] - middle[1])];
    let polygons_mm: Vec<Vec<[f64; 2]>> =
        (outline.polygons_mm.iter()).map(|ring| ring.iter().map(about).collect()).collect();
    drawn(Shape::Outline { polygons_mm }, bounds, middle)
}

/// `brush`: depth under a round brush, added to a grid.
pub(crate) fn brushed(request: &Value, arrays: &Arrays) -> Answer<Reply> {
    let points = points(request, arrays)?;
    let stroke = Stroke { points_mm: &points, width_mm: number(request, "width_mm")? };
    let sign = if request["raise"] == true { -1.0 } else { 1.0 };
    let before = match request.get("grid").filter(|g| !g.is_null()) {
        Some(shape) => match read(shape)? {
            Shape::DepthMap { grid } => Some(grid),
            _ => return Err(Trouble::of("\"grid\" must be a shape with a depth map")),
        },
        None => None,
    };
    let depth = sign * number(request, "depth_um")?;
    let mut grid = brush(before.as_ref(), &stroke, depth).map_err(|e| Trouble::of(e.to_string()))?;
    // To a nanometre, and of one nanometre nothing: as much as an earlier rounding leaves where a stroke is taken back.
    let rounded = |d: f64| if d.abs() < 1.5e-3 { 0.0 } else { (d * 1e3).round() / 1e3 };
    grid.depth_um.iter_mut().for_each(|d| *d = rounded(*d));
    let damaged = grid.damaged_bounds().ok_or_else(|| Trouble::of("nothing is left of the damage; delete it"))?;
    let place =
        |[column, row]: [usize; 2]| [grid.s0_mm + grid.ds_mm * column as f64, grid.z0_mm + grid.dz_mm * row as f64];
    let [low, high] = damaged.map(place);
    let middle = if before.is_some() { [0.0; 2] } else { [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])] };
    grid.s0_mm -= middle[0];
    grid.z0_mm -= middle[1];
    drawn(Shape::DepthMap { grid }, [low, high], middle)
}

/// `outline`: a photo, a drawing or a depth map as a shape.
pub(crate) fn outlined(request: &Value, given: &Arrays, arrays: &mut Arrays) -> Answer<Reply> {
    let bytes = request.get("bytes").and_then(|b| given.octets(b));
    let bytes = bytes.ok_or_else(|| Trouble::of("\"bytes\" must be an array of u8"))?;
    let name = request["name"].as_str().unwrap_or("file");
    let key = match request["kind"].as_str() {
        Some("photo") => "image",
        Some("svg") => "svg",
        Some("depth") => "depth_map",
        _ => {
            return Err(Trouble::of("\"kind\" must be \"photo\", \"svg\" or \"depth\""));
        }
    };
    let mut options = match request.get("options") {
        None | Some(Value::Null) => Map::new(),
        Some(Value::Object(stated)) => stated.clone(),
        Some(_) => return Err(Trouble::of("\"options\" must be an object")),
    };
    options.insert("file".into(), name.into());
    let scenario = read(&Map::from_iter([(key.to_owned(), options.into())]).into())?;
    let read = shape_of_bytes(&scenario, bytes).map_err(Trouble::of)?;
    let (shape, notes) = (read.shape, [read.warnings, read.notes].concat());
    let made = brinell::defect::Shape::new(&shape, 0.0);
    let extent = made.map(|made| Extent::of(&made, 1e-5));
    let mm = |f: fn(&Extent) -> f64, scale: f64| extent.as_ref().map(|e| scale * f(e));
    let rings = read.rings_px.iter();
    Ok(Reply::Outline(Outline {
        shape: stated(shape)?,
        notes,
        rings_px: rings.map(|ring| arrays.rounded(ring.as_flattened())).collect(),
        length_mm: mm(|e| e.length, 1e3),
        width_mm: mm(|e| e.width, 1e3),
        area_mm2: mm(|e| e.area, 1e6),
    }))
}

/// The scenario of a request, and its text. Refuses one whose damage is in a file: a page has no folder to look into.
pub(crate) fn asked(request: &Value) -> Answer<(Loaded, String)> {
    let text = text::of_request(request)?;
    resolved(text::read(&text)?, text, |_| None)
}

/// Puts what files hold into a scenario and its text; `find` gives a file's bytes.
pub(crate) fn resolved(
    mut loaded: Loaded,
    text: String,
    find: impl Fn(&str) -> Option<&'static [u8]>,
) -> Answer<(Loaded, String)> {
    let mut stated_keys = None;
    for (k, defect) in loaded.scenario.defects.iter_mut().enumerate() {
        let bytes_of = |file: &str| {
            let missing = || Trouble::of(format!("defect {}: {file} is not here; drop the file on the raceway", k + 1));
            find(file).ok_or_else(missing)
        };
        if let Some(file) = defect.table_file() {
            let TableData { s_mm, delta_um, values } = table_of_bytes(bytes_of(file)?).map_err(Trouble::of)?;
            let keys = stated_keys.get_or_insert_with(|| text::stated(&text));
            keys["defects"][k]["table"] = json!({ "s_mm": s_mm, "delta_um": delta_um, values.name(): values.list() });
        }
        let Some(file) = defect.shape.file().map(str::to_owned) else {
            continue;
        };
        let bytes = bytes_of(&file)?;
        let shape = shape_of_bytes(&defect.shape, bytes).map_err(Trouble::of)?.shape;
        let keys = stated_keys.get_or_insert_with(|| text::stated(&text));
        keys["defects"][k]["shape"] = stated(shape)?;
    }
    match stated_keys {
        None => Ok((loaded, text)),
        Some(keys) => {
            let text = text::of_stated(&keys)?;
            Ok((text::read(&text)?, text))
        }
    }
}
