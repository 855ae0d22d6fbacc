//! `brinell dataset sheet`: a few runs of each class on a page.

use super::args::SheetArgs;
use crate::failure::Failure;
use crate::say::say;
use crate::sweep::plural;
use brinell_io::atomic_write;
use brinell_report::{Series, SheetDamage, SheetGroup, SheetReport, SheetTile, Spectrum, sheet_html};
use brinell_study::dataset::{Sheet, SheetClass, SheetDefect, SheetRun, sheet};
use std::process::ExitCode;

/// Beside the data set's card.
const FILE: &str = "sheet.html";

pub(super) fn draw(args: &SheetArgs) -> Result<ExitCode, Failure> {
    let found = sheet(&args.folder, args.runs.get())?;
    let path = args.folder.join(FILE);
    let report = report(found);
    let shown = report.groups.iter().map(|group| group.tiles.len()).sum();
    atomic_write(&path, sheet_html(&report))?;
    if !args.quiet {
        say!("{}: {}", path.display(), plural(shown, "run"));
    }
    Ok(ExitCode::SUCCESS)
}

fn report(sheet: Sheet) -> SheetReport {
    SheetReport {
        title: sheet.name,
        version: sheet.version,
        signal: sheet.signal,
        unit: sheet.unit,
        groups: sheet.classes.into_iter().map(group).collect(),
    }
}

fn group(class: SheetClass) -> SheetGroup {
    SheetGroup {
        name: class.name,
        label: class.label,
        runs: class.runs,
        tiles: class.shown.into_iter().map(tile).collect(),
    }
}

fn tile(run: SheetRun) -> SheetTile {
    SheetTile {
        run: run.run,
        split: run.split,
        speed_rpm: run.speed_rpm,
        load_n: run.load_n,
        damage: run.defects.into_iter().map(damage).collect(),
        rms: run.rms,
        stretch: Series { t0_s: run.from_s, dt_s: run.dt_s, values: run.stretch, ..Series::default() },
        band_hz: run.band_hz,
        envelope: Spectrum { df_hz: run.df_hz, amplitude: run.envelope, ..Spectrum::default() },
        top_hz: run.top_hz,
    }
}

fn damage(defect: SheetDefect) -> SheetDamage {
    SheetDamage {
        on: defect.on,
        center_deg: defect.center_deg,
        length_mm: defect.length_mm,
        width_mm: defect.width_mm,
        depth_um: defect.depth_um,
        frequency_hz: defect.frequency_hz,
    }
}
