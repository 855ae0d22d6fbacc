//! From a scenario that names files of damage to one that holds their geometry.

use std::fmt;
use std::io::Read;
use std::path::Path;

use brinell::document::{Problem, Severity};
use brinell::scenario::{Defect, DefectTable, DepthGrid, ScanFile, ScanForm, Scenario, Shape, SvgFile, TableData};
use brinell_io::LARGEST_TEXT;

use crate::form_doubts::form_doubts;
use crate::{DamageError, DepthMap, FileKind, Form, Traced, read_depth_map};

/// Bytes of a file of damage.
const LARGEST: u64 = 256 << 20;
/// Nodes of the damaged part of a scan: they all are in the resolved scenario, 10 bytes each.
const MOST_NODES: usize = 1 << 18;
/// Share of a scan's points above which it shows nothing sound.
const MOST_DAMAGED: f64 = 0.95;
/// Share of a scan's rim above which it is worth a word that the rim is damage.
const DOUBTFUL_RIM: f64 = 0.05;
/// Depths are kept to this many parts of a um: 0.1 nm, below any instrument's noise.
const PARTS_OF_UM: f64 = 1e4;

/// A file that a scenario names and that cannot be what it names it for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unresolved {
    /// Which one of its bearing, from 0; 0 where the file is another one.
    pub defect: usize,
    /// The scenario's key that names the file.
    pub key: String,
    /// The file, as the scenario names it.
    pub file: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Unresolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, file, .. } = self;
        write!(f, "{key} = \"{file}\"")?;
        if key.contains("defects.") {
            write!(f, " (defect {})", self.defect + 1)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Unresolved {}

/// The key that names a shape's file, and the file.
fn named(defect: usize, shape: &Shape) -> Option<(String, String)> {
    let name = match shape {
        Shape::Image(_) => "image",
        Shape::Svg(_) => "svg",
        Shape::Scan(_) => "depth_map",
        _ => return None,
    };
    let key = format!("defects.{defect}.shape.{name}.file");
    shape.file().map(|file| (key, file.to_owned()))
}

/// Reads the table of a defect from its file; `None` where it names none.
fn table(defect: &Defect, folder: &Path) -> Option<Result<TableData, String>> {
    let read = |file: &str| table_of_bytes(&read_bytes(&folder.join(file), LARGEST)?);
    defect.table_file().map(read)
}

/// The table delta_eff(s, delta) that a file holds.
///
/// # Errors
/// In words, with the line.
pub fn table_of_bytes(bytes: &[u8]) -> Result<TableData, String> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count();
        format!(
            "line {line}: not a text file in UTF-8; a CSV file with the columns s_mm,delta_um,delta_eff_um (or energy_j) is needed"
        )
    })?;
    TableData::from_csv_text(text).map_err(|fault| fault.to_string())
}

/// A defect by its index, the key that names its file, and the file.
type Named = (usize, String, String);

/// What was found in the file of a defect, and is none of its geometry.
pub(crate) struct Found {
    pub(crate) defect: usize,
    pub(crate) threshold: Option<f64>,
    pub(crate) form: Option<Form>,
}

/// Reads the files of damage of one bearing, with what was found beside geometry.
pub(crate) fn resolve_one(
    scenario: &mut Scenario,
    folder: &Path,
    found: &mut Vec<Found>,
) -> Result<Vec<String>, Vec<Unresolved>> {
    let shapes: Vec<Named> = scenario
        .defects
        .iter()
        .enumerate()
        .filter_map(|(i, d)| named(i, &d.shape).map(|(key, file)| (i, key, file)))
        .collect();
    let of_table = |(i, d): (usize, &Defect)| Some((i, format!("defects.{i}.table"), d.table_file()?.to_owned()));
    let tables: Vec<Named> = scenario.defects.iter().enumerate().filter_map(of_table).collect();
    let files = [shapes.clone(), tables.clone()].concat();
    if files.is_empty() {
        return Ok(Vec::new());
    }
    let mut resolved = scenario.clone();
    let (mut warnings, mut errors) = (Vec::new(), Vec::new());
    let mut hints: Vec<(usize, Vec<String>)> = Vec::new();
    for (i, key, file) in &shapes {
        match read_noting(&scenario.defects[*i].shape, folder) {
            Ok(ReadShape { shape, warnings: mut said, threshold, form, .. }) => {
                resolved.defects[*i].shape = shape;
                said.extend(form.iter().flat_map(|form| form_doubts(scenario, *i, form)));
                found.push(Found { defect: *i, threshold, form });
                warnings.extend(said.iter().map(|text| format!("{key} = \"{file}\" (defect {}): {text}", i + 1)));
                hints.push((*i, said));
            }
            Err(message) => errors.push(Unresolved { defect: *i, key: key.clone(), file: file.clone(), message }),
        }
    }
    for (i, key, file) in &tables {
        match table(&scenario.defects[*i], folder) {
            Some(Err(message)) => {
                errors.push(Unresolved { defect: *i, key: key.clone(), file: file.clone(), message });
            }
            read => resolved.defects[*i].table = read.and_then(Result::ok).map(DefectTable::Read),
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    can_be_read_again(&resolved, &files)?;
    let (said, mut errors) = new_problems(scenario, &resolved, &files);
    // Why a scan is refused may be what it was warned of.
    for error in errors.iter_mut().filter(|e| e.message.contains("raised")) {
        let said = hints.iter().filter(|(i, _)| *i == error.defect);
        for hint in said.flat_map(|(_, said)| said) {
            error.message += &format!("; {hint}");
        }
    }
    warnings.extend(said);
    if !errors.is_empty() {
        return Err(errors);
    }
    *scenario = resolved;
    Ok(warnings)
}

/// That the scenario with its geometry is no longer than what is read.
fn can_be_read_again(resolved: &Scenario, files: &[Named]) -> Result<(), Vec<Unresolved>> {
    let text = resolved.to_toml().len() as u64;
    if text > LARGEST_TEXT {
        let numbers = |(i, key, _): &Named| match (&resolved.defects[*i].table, key.ends_with(".table")) {
            (Some(DefectTable::Read(table)), true) => table.values.list().len(),
            _ => size(&resolved.defects[*i].shape),
        };
        let largest = files.iter().max_by_key(|named| numbers(named)).unwrap_or(&files[0]);
        let message = format!(
            "with what its files hold the scenario takes {:.1} MiB, more than the {} MiB that are read again; this file has {} numbers: \
             simplify its damage, or thin it out",
            text as f64 / f64::from(1 << 20),
            LARGEST_TEXT >> 20,
            numbers(largest)
        );
        let (defect, key, file) = largest.clone();
        return Err(vec![Unresolved { defect, key, file, message }]);
    }
    Ok(())
}

/// What the scenario with its geometry is warned of and refused for, beyond what it was without.
fn new_problems(scenario: &Scenario, resolved: &Scenario, files: &[Named]) -> (Vec<String>, Vec<Unresolved>) {
    let (mut warnings, mut errors) = (Vec::new(), Vec::new());
    let before = scenario.problems();
    for problem in resolved.problems() {
        if before.contains(&problem) {
            continue;
        }
        let of = |(i, ..): &&Named| {
            problem.key.starts_with(&format!("defects.{i}.")) || problem.key == format!("defects.{i}")
        };
        // What no defect is named for (memory of slices, for one) has come with the files all the same.
        let (defect, key, file) = files.iter().find(of).unwrap_or(&files[0]);
        let mut message = words(&problem);
        // Against the bearing it is the size that does not fit.
        if problem.also.iter().any(|(key, _)| key.starts_with("bearing.")) {
            message += &scale(&scenario.defects[*defect].shape);
        }
        match problem.severity {
            Severity::Warning => warnings.push(format!("{key} = \"{file}\" (defect {}): {message}", defect + 1)),
            Severity::Error => {
                errors.push(Unresolved { defect: *defect, key: key.clone(), file: file.clone(), message })
            }
        }
    }
    (warnings, errors)
}

/// Numbers of a shape's geometry.
fn size(shape: &Shape) -> usize {
    match shape {
        Shape::Outline { polygons_mm } => 2 * polygons_mm.iter().map(Vec::len).sum::<usize>(),
        Shape::DepthMap { grid } => grid.depth_um.len(),
        _ => 0,
    }
}

/// A problem without its key and value, which are in no file of the user's.
fn words(problem: &Problem) -> String {
    let mut text = problem.message.clone();
    if let Some(allowed) = &problem.allowed {
        text.push_str(&format!(" (allowed: {allowed})"));
    }
    if !problem.also.is_empty() {
        let keys: Vec<&str> = problem.also.iter().map(|(key, _)| key.as_str()).collect();
        text.push_str(&format!("; see also {}", keys.join(", ")));
    }
    text
}

/// What the size of a file's damage follows from.
fn scale(shape: &Shape) -> String {
    match shape {
        Shape::Image(image) => format!("; its size follows from mm_per_pixel = {}", image.mm_per_pixel),
        Shape::Svg(SvgFile { mm_per_unit: Some(scale), .. }) => {
            format!("; its size follows from mm_per_unit = {scale}")
        }
        Shape::Svg(_) => "; its size is the drawing's own, or give mm_per_unit".into(),
        Shape::Scan(ScanFile { ds_mm: Some(ds), dz_mm: Some(dz), .. }) => {
            format!("; its size follows from ds_mm = {ds} and dz_mm = {dz}")
        }
        Shape::Scan(_) => "; its size is what the file says of its spacing".into(),
        _ => String::new(),
    }
}

/// A shape that was read from its file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadShape {
    /// With geometry in place of the file.
    pub shape: Shape,
    /// What may be wrong, in sentences.
    pub warnings: Vec<String>,
    /// What the reader decided or left out, in sentences.
    pub notes: Vec<String>,
    /// The threshold that was found in an image: 0 black to 1 white, or the share of the sound surface's brightness.
    pub threshold: Option<f64>,
    /// The curved form that was taken off a scan.
    pub form: Option<Form>,
    /// Outlines in an image, pixels from its upper left corner.
    pub rings_px: Vec<Vec<[f64; 2]>>,
}

impl ReadShape {
    /// Without a word about it.
    fn of(shape: Shape) -> Self {
        Self { shape, warnings: Vec::new(), notes: Vec::new(), threshold: None, form: None, rings_px: Vec::new() }
    }
}

/// Reads the file of one shape; a shape without a file comes back as it is.
fn read_noting(shape: &Shape, folder: &Path) -> Result<ReadShape, String> {
    if shape.file().is_none() {
        return shape_of_bytes(shape, &[]);
    }
    shape_of_bytes(shape, &bytes_of(shape, folder)?)
}

/// Reads the content of the file that a shape names; a shape without a file comes back as it is.
///
/// # Errors
/// In words.
pub fn shape_of_bytes(shape: &Shape, bytes: &[u8]) -> Result<ReadShape, String> {
    let Some(file) = shape.file() else {
        return Ok(ReadShape::of(shape.clone()));
    };
    if bytes.is_empty() {
        return Err("the file is empty".into());
    }
    let kind = FileKind::check(file, bytes).map_err(|e| e.to_string())?;
    let read: Result<Traced, DamageError> = match shape {
        Shape::Image(image) => crate::trace_image(bytes, image),
        Shape::Svg(drawing) => crate::read_svg(bytes, drawing).map(|polygons| Traced { polygons, ..Traced::default() }),
        Shape::Scan(scan) => {
            let DepthMap { grid, warnings, notes, form } =
                read_depth_map(bytes, Some(kind), scan).map_err(|e| e.to_string())?;
            // What may be wrong explains what cannot be used.
            let with_hints = |error: String| [&[error], &warnings[..]].concat().join("; ");
            let doubt = doubt(&grid, scan.remove_form).map_err(with_hints)?;
            return Ok(ReadShape {
                warnings: warnings.iter().cloned().chain(doubt).collect(),
                notes,
                form,
                ..ReadShape::of(cut_out(&grid).map_err(with_hints)?)
            });
        }
        _ => return Ok(ReadShape::of(shape.clone())),
    };
    let Traced { polygons, rings_px, .. } = read.map_err(|e| e.to_string())?;
    Ok(ReadShape {
        warnings: polygons.warnings,
        notes: polygons.notes,
        threshold: polygons.threshold,
        rings_px,
        ..ReadShape::of(Shape::Outline { polygons_mm: polygons.polygons_mm })
    })
}

/// The content of a shape's file.
pub(crate) fn bytes_of(shape: &Shape, folder: &Path) -> Result<Vec<u8>, String> {
    read_bytes(&folder.join(shape.file().unwrap_or_default()), largest(shape))
}

/// Bytes of a file for a shape at most.
fn largest(shape: &Shape) -> u64 {
    match shape {
        Shape::Svg(_) => crate::svg::MAX_BYTES as u64,
        _ => LARGEST,
    }
}

pub(crate) fn read_bytes(path: &Path, largest: u64) -> Result<Vec<u8>, String> {
    let failed = |error| format!("cannot read {}: {}", path.display(), brinell_io::why_unread(&error));
    let facts = std::fs::metadata(path).map_err(failed)?;
    if !facts.is_file() {
        return Err(format!("{} is not a plain file", path.display()));
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(failed)?;
    file.take(largest + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > largest {
        return Err(format!("{} is larger than {} MiB; cut out the damage", path.display(), largest >> 20));
    }
    Ok(bytes)
}

/// A word on a scan whose rim is damage: its form is still in it, or it shows only a part.
///
/// # Errors
/// Where nearly all of it is damage.
fn doubt(grid: &DepthGrid, removed: ScanForm) -> Result<Option<String>, String> {
    let form = match removed {
        ScanForm::None => "the surface's own form may be in it (`remove_form`)".to_owned(),
        other => format!(
            "the surface's own form may be in it (`remove_form` is \"{}\"; where damage takes half of the scan, give `radius_mm` or scan more around it)",
            other.word()
        ),
    };
    let damaged = |d: &&f64| **d != 0.0;
    let share = grid.depth_um.iter().filter(damaged).count() as f64 / grid.depth_um.len() as f64;
    if share > MOST_DAMAGED {
        return Err(format!(
            "all of it would be damage ({:.0} % of its points): {form}, or `zero` and `threshold_um` do not fit",
            100.0 * share
        ));
    }
    let rim = (0..grid.rows)
        .flat_map(|row| (0..grid.columns).map(move |column| (column, row)))
        .filter(|&(c, r)| c == 0 || r == 0 || c + 1 == grid.columns || r + 1 == grid.rows);
    let (mut points, mut off) = (0_usize, 0_usize);
    for (column, row) in rim {
        points += 1;
        off += usize::from(grid.at(column, row) != 0.0);
    }
    let share = off as f64 / points as f64;
    Ok((share > DOUBTFUL_RIM).then(|| {
        format!(
            "{:.0} % of the scan's rim is damage: {form}, or the damage continues beyond the scan, where it counts as sound",
            100.0 * share
        )
    }))
}

/// The damaged nodes of a grid and one undamaged around them, where there is one.
fn cut_out(grid: &DepthGrid) -> Result<Shape, String> {
    let Some([[c0, r0], [c1, r1]]) = grid.damaged_bounds() else {
        return Err("there is no damage in it".to_owned());
    };
    let (c0, r0) = (c0.saturating_sub(1), r0.saturating_sub(1));
    let (c1, r1) = ((c1 + 1).min(grid.columns - 1), (r1 + 1).min(grid.rows - 1));
    let (columns, rows) = (c1 - c0 + 1, r1 - r0 + 1);
    if columns.saturating_mul(rows) > MOST_NODES {
        return Err(format!(
            "its damage takes {columns} x {rows} points, more than the {MOST_NODES} that a run holds; \
             thin the scan out and adapt ds_mm and dz_mm"
        ));
    }
    let depth_um = (r0..=r1)
        .flat_map(|row| (c0..=c1).map(move |column| (column, row)))
        .map(|(column, row)| {
            let depth = (grid.at(column, row) * PARTS_OF_UM).round() / PARTS_OF_UM;
            // No negative zero.
            depth + 0.0
        })
        .collect();
    Ok(Shape::DepthMap {
        grid: DepthGrid {
            s0_mm: grid.s0_mm + c0 as f64 * grid.ds_mm,
            z0_mm: grid.z0_mm + r0 as f64 * grid.dz_mm,
            ds_mm: grid.ds_mm,
            dz_mm: grid.dz_mm,
            columns,
            rows,
            depth_um,
        },
    })
}
