//! `brinell dataset sheet`: a few runs of each class on a page, or one machine's history.

use super::args::SheetArgs;
use crate::failure::{ExitCode, Failure};
use crate::say::{plural, say};
use brinell::document;
use brinell_io::atomic_write;
use brinell_measured::{Asked, Called, GivenSpeed, Measurement, Request, examine};
use brinell_report::{Page, html};
use brinell_study::dataset::{Size, WholeSignal, history, sheet};

/// Beside the data set's card.
const FILE: &str = "sheet.html";

pub(super) fn draw(args: &SheetArgs) -> Result<ExitCode, Failure> {
    let (page, file, what) = match args.machine {
        None => {
            let found = sheet(&args.folder, args.runs.get())?;
            let shown = found.classes.iter().map(|class| class.shown.len()).sum();
            (Page::of_sheet(found), FILE.to_owned(), plural(shown, "run"))
        }
        Some(machine) => {
            let found = history(&args.folder, machine, args.runs.get(), size)?;
            let shown = format!("{}. Length: {}", plural(found.snapshots.len(), "snapshot"), found.told());
            (Page::of_history(found), format!("machine-{machine}.html"), shown)
        }
    };
    let path = args.folder.join(file);
    atomic_write(&path, html(&page))?;
    if !args.quiet {
        say!("{}: {what}", path.display());
    }
    Ok(ExitCode::SUCCESS)
}

/// What `brinell analyze --size` tells of the signal as it is, given the bearing and the speed: no machine's noise is added.
fn size(of: WholeSignal) -> Size {
    let rpm = of.speed_rpm.ok_or("the speed varies")?;
    let loaded = document::read(&of.scenario, &[]).map_err(|_| "the bearing is held out")?;
    let name = "that of the scenario".to_owned();
    let bearing = Box::new(loaded.scenario.bearing.clone());
    let request = Request {
        rate: Some(of.rate_hz),
        unit: Some(of.unit.to_owned()),
        judged: true,
        speed: Some(GivenSpeed { rpm, is_bare: false }),
        bearings: vec![Asked::Scenario { words: name.clone(), name, bearing }],
        size: true,
        simulated: true,
        ..Request::new(Called::Fields)
    };
    let told = Measurement::of_samples(of.samples, &request, None, None).and_then(|(m, _)| examine(m, &request));
    let found = told.map_err(|problem| problem.to_string())?;
    let Some(told) = found.bearings.into_iter().next().and_then(|bearing| bearing.size) else {
        return Err("nothing is found".into());
    };
    told.map(|told| [told.interval.low, told.value, told.interval.high])
}
