//! A profilometer's grid of heights or depths: read, levelled, filled, thresholded.
//!
//! Order: missing points are marked; units and sign; the turn to `s`, `z`; the form (fitted to the points that are
//! there); the zero; filling; the threshold; specks; the origin. Memory: three copies of the grid at most.

use crate::depth_doubts::{raised, tilt};
use crate::direction::{along_rows, turn_grid};
use crate::error::{DamageError, check_range};
use crate::form_fit::{Removed, remove};
use crate::geometry::DepthMap;
use crate::holes::{drop_specks, fill};
use crate::kind::{FileKind, describe};
use crate::numbers::quantile;
use crate::scan::{Raw, SAME, Scan};
use crate::{depth_csv, depth_npy, surface};
use brinell::scenario::{DepthGrid, FirstRow, ScanFile, ScanFill, ScanUnit, ScanZero};

/// Deeper than this (um) is not damage to a raceway but a wrong unit.
pub(crate) const MAX_DEPTH_UM: f64 = 5000.0;
/// Absolute values above this (um) are not lengths on a bearing.
const MAX_RAW_UM: f64 = 1e9;
/// The rim: this share of the grid's length and width on each side, one point at least.
const RIM: f64 = 0.05;

/// Reads a depth map of up to 2^24 points. `format`: what the file's name or the user says it is; the content must
/// agree. `None`: as the content shows.
pub fn read_depth_map(bytes: &[u8], format: Option<FileKind>, options: &ScanFile) -> Result<DepthMap, DamageError> {
    check(options)?;
    let found = FileKind::of_content(bytes);
    let kind = match format {
        Some(format) => Some(format.confirm(found)?),
        None => found,
    };
    let mut raw = raw(bytes, kind, options)?;
    if raw.width < 2 || raw.height < 2 {
        return Err(DamageError::Unsupported {
            at: "the map".to_owned(),
            what: format!("a grid of {} x {} points", raw.width, raw.height),
            way_out: "at least 2 x 2 are needed, one line per row",
        });
    }
    let (mut warnings, mut notes) = (std::mem::take(&mut raw.warnings), std::mem::take(&mut raw.notes));
    let spacing_mm = spacing(&raw, options)?;
    to_depth(&mut raw, options)?;
    let missing = check_missing(&raw, options)?;
    let mut scan = turned(raw, spacing_mm, options);
    let hint = tilt(&scan, options);
    let removed = remove(&mut scan, options)?;
    if let Some(Removed { used, apart, .. }) = removed.as_ref().filter(|of| of.apart > of.used) {
        warnings.push(format!(
            "the form was fitted to {used} points only, as {apart} are far from it; look at the result before using it"
        ));
    }
    let form = removed.and_then(|of| of.form);
    notes.extend(
        form.iter()
            .map(|form| format!("the {} has a radius of {} mm, {}", form.name, form.around.radius_mm(), form.sides())),
    );
    set_zero(&mut scan, options);
    if missing > 0 {
        let (count, layers) = fill(&mut scan);
        let filled =
            format!("{count} of {} points were missing and are filled from their neighbours", scan.depth_um.len());
        // With a measured point beside each there is nothing to doubt: `fill` asks for it.
        match layers {
            0 | 1 => notes.push(filled),
            _ => warnings.push(format!(
                "{filled}; some lie up to {layers} points from any measured one, where the surface is a guess: look at it, or scan again"
            )),
        }
    }
    finish_depths(&mut scan, options, &mut warnings)?;
    warnings.extend(hint.into_iter().chain(raised(&scan, options)));
    let (s0_mm, z0_mm) = scan.place(0, 0);
    let mut grid = DepthGrid {
        s0_mm,
        z0_mm,
        ds_mm: scan.ds_mm,
        dz_mm: scan.dz_mm,
        columns: scan.columns,
        rows: scan.rows,
        depth_um: scan.depth_um,
    };
    if let (true, Some([low, high])) = (options.center, grid.damaged_bounds()) {
        grid.s0_mm = -0.5 * (low[0] + high[0]) as f64 * grid.ds_mm;
        grid.z0_mm = -0.5 * (low[1] + high[1]) as f64 * grid.dz_mm;
    }
    Ok(DepthMap { grid, warnings, notes, form })
}

/// Every number within its range.
fn check(options: &ScanFile) -> Result<(), DamageError> {
    const SPACING: &str = "a number of mm above 0, at most 10";
    for (name, spacing) in [("ds_mm", options.ds_mm), ("dz_mm", options.dz_mm)] {
        if let Some(spacing) = spacing {
            check_range(name, spacing, 0.0, 10.0, SPACING)?;
        }
    }
    let least = -f64::MIN_POSITIVE;
    check_range("threshold_um", options.threshold_um, least, MAX_DEPTH_UM, "0 to 5000 um")?;
    check_range("speck_mm2", options.speck_mm2, least, 1e6, "an area of 0 mm^2 or more")?;
    if options.unit == ScanUnit::Counts {
        let nm = options.nm_per_count.unwrap_or(f64::NAN);
        check_range("nm_per_count", nm, 0.0, 1e6, "a number of nm above 0, at most 1e6")?;
    }
    if options.zero == ScanZero::Percentile {
        let percent = options.zero_percentile.unwrap_or(f64::NAN);
        check_range("zero_percentile", percent, least, 100.0, "a percentile from 0 to 100")?;
    }
    if let Some(radius) = options.radius_mm {
        check_range("radius_mm", radius, 0.0, 1e5, "a number of mm above 0, at most 100000")?;
    }
    Ok(())
}

/// The map as its file has it.
fn raw(bytes: &[u8], kind: Option<FileKind>, options: &ScanFile) -> Result<Raw, DamageError> {
    Ok(match kind {
        Some(FileKind::Csv) => depth_csv::read(bytes, stated(options))?,
        Some(FileKind::Sdf) => surface::read_sdf(bytes)?,
        Some(FileKind::Sur) => surface::read_sur(bytes)?,
        Some(FileKind::X3p) => surface::read_x3p(bytes)?,
        Some(FileKind::Npy) => depth_npy::read(bytes)?,
        Some(FileKind::Png) => crate::pixels::heights(bytes)?,
        _ => {
            return Err(DamageError::WrongKind {
                what: describe(bytes),
                wanted: "a depth map",
                way_out: "save it as CSV, NPY, 16-bit grey PNG, SDF, X3P or SUR",
            });
        }
    })
}

/// What is stated of the distances of columns and of rows.
fn stated(options: &ScanFile) -> [Option<f64>; 2] {
    match along_rows(options.rolling_direction) {
        true => [options.ds_mm, options.dz_mm],
        false => [options.dz_mm, options.ds_mm],
    }
}

/// Distances along s and z, mm: as the file says, or as stated.
fn spacing(raw: &Raw, options: &ScanFile) -> Result<[f64; 2], DamageError> {
    let own = raw.spacing_mm.map(|[x, y]| match along_rows(options.rolling_direction) {
        true => [x, y],
        false => [y, x],
    });
    let of = |k: usize, name: &'static str, stated: Option<f64>| match (stated, own) {
        (Some(mm), Some(own)) if (mm / own[k] - 1.0).abs() > SAME => Err(DamageError::Option {
            option: name,
            value: mm.to_string(),
            allowed: "as the file says, or left out; check the units of its columns",
        }),
        (_, Some(own)) => Ok(own[k]),
        (Some(mm), None) => Ok(mm),
        (None, None) => Err(DamageError::Unsupported {
            at: "the map".to_owned(),
            what: "a file that says no distance of its points".to_owned(),
            way_out: "give `ds_mm` and `dz_mm`",
        }),
    };
    Ok([of(0, "ds_mm", options.ds_mm)?, of(1, "dz_mm", options.dz_mm)?])
}

/// To depths in um, positive into the material; NaN where missing.
fn to_depth(raw: &mut Raw, options: &ScanFile) -> Result<(), DamageError> {
    let um = raw.unit_um.unwrap_or(match options.unit {
        ScanUnit::Um => 1.0,
        ScanUnit::Mm => 1e3,
        ScanUnit::M => 1e6,
        ScanUnit::Counts => 1e-3 * options.nm_per_count.unwrap_or(f64::NAN),
    });
    let factor = if options.height_positive_up { -um } else { um };
    for value in &mut raw.values {
        if !value.is_finite() || options.missing == Some(*value) {
            *value = f64::NAN;
            continue;
        }
        *value *= factor;
        if value.abs() > MAX_RAW_UM {
            return Err(absurd(*value, MAX_RAW_UM));
        }
    }
    Ok(())
}

fn absurd(um: f64, limit: f64) -> DamageError {
    DamageError::TooLarge {
        what: "the depth of a point",
        value: format!("{um:.3e} um"),
        limit: format!("{limit:e} um"),
        way_out: "check `unit`, `missing` and `zero`",
    }
}

/// How many points are missing, if that can be helped.
fn check_missing(raw: &Raw, options: &ScanFile) -> Result<usize, DamageError> {
    let missing = |v: &f64| v.is_nan();
    let Some(first) = raw.values.iter().position(missing) else {
        return Ok(0);
    };
    let count = raw.values.iter().filter(|v| missing(v)).count();
    let way_out = if 2 * count > raw.values.len() {
        "that is more than half; check `missing`, or scan again"
    } else if options.fill == ScanFill::None {
        "fill them from their neighbours with `fill`"
    } else {
        return Ok(count);
    };
    Err(DamageError::MissingPoints {
        count,
        total: raw.values.len(),
        row: first / raw.width + 1,
        column: first % raw.width + 1,
        way_out,
    })
}

fn turned(mut raw: Raw, [ds_mm, dz_mm]: [f64; 2], options: &ScanFile) -> Scan {
    if options.first_row == FirstRow::Bottom {
        let (width, height) = (raw.width, raw.height);
        for row in 0..height / 2 {
            let (upper, lower) = raw.values.split_at_mut((height - 1 - row) * width);
            upper[row * width..(row + 1) * width].swap_with_slice(&mut lower[..width]);
        }
    }
    let direction = options.rolling_direction;
    let (columns, rows) = if along_rows(direction) { (raw.width, raw.height) } else { (raw.height, raw.width) };
    Scan { columns, rows, ds_mm, dz_mm, depth_um: turn_grid(direction, raw.width, raw.height, &raw.values) }
}

fn set_zero(scan: &mut Scan, options: &ScanFile) {
    let (columns, rows) = (scan.columns, scan.rows);
    let there = |d: &f64| !d.is_nan();
    let level = match options.zero {
        ScanZero::AsIs => return,
        ScanZero::Percentile => {
            let share = 0.01 * options.zero_percentile.unwrap_or(f64::NAN);
            quantile(scan.depth_um.iter().copied().filter(there), share)
        }
        ScanZero::RimMedian => {
            let band = |n: usize| ((RIM * n as f64) as usize).max(1);
            let (across, along) = (band(columns), band(rows));
            let rim = (0..scan.depth_um.len()).filter(|i| {
                let (column, row) = (i % columns, i / columns);
                column < across || column + across >= columns || row < along || row + along >= rows
            });
            quantile(rim.map(|i| scan.depth_um[i]).filter(there), 0.5)
        }
    };
    scan.depth_um.iter_mut().for_each(|d| *d -= level);
}

fn finish_depths(scan: &mut Scan, options: &ScanFile, warnings: &mut Vec<String>) -> Result<(), DamageError> {
    for depth in &mut scan.depth_um {
        if depth.abs() < options.threshold_um {
            *depth = 0.0;
        } else if depth.abs() > MAX_DEPTH_UM {
            return Err(absurd(*depth, MAX_DEPTH_UM));
        }
    }
    let damaged = scan.depth_um.iter().filter(|&&d| d != 0.0).count();
    if damaged == scan.depth_um.len() {
        return Err(DamageError::AllDamaged {
            why: format!(
                "every point is {} um or more from the zero level; check `remove_form`, `zero` and `threshold_um`",
                options.threshold_um
            ),
        });
    }
    let smallest = options.speck_mm2 / (scan.ds_mm * scan.dz_mm);
    let dropped = if smallest > 0.0 { drop_specks(scan, smallest) } else { 0 };
    if dropped > 0 {
        warnings.push(format!("{dropped} damaged spots below {} mm^2 were dropped as noise", options.speck_mm2));
    }
    if scan.depth_um.iter().all(|&d| d == 0.0) {
        return Err(DamageError::NothingDamaged {
            why: format!(
                "no spot reaches both `threshold_um` = {} um and `speck_mm2` = {} mm^2",
                options.threshold_um, options.speck_mm2
            ),
        });
    }
    Ok(())
}
