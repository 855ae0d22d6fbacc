//! Pictures as files, for the screen or for print, and the numbers of their curves.

use crate::failure::Failure;
use crate::files::make_folder;
use brinell::document::reading::quantity;
use brinell_io::{Cells, Column, Complete, Table, atomic_prepare};
use brinell_report::{CurveTable, Layout, Picture};
use clap::ValueEnum;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Folder of the pictures.
pub(crate) const PLOTS: &str = "plots";

/// Formats of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotFormat {
    /// Vector drawing
    Svg,
    /// Pixels: twice the drawing's size, or 600 an inch with --width
    Png,
    /// One page, its typeface inside
    Pdf,
}

/// Folder of the numbers of their curves.
const CURVES: &str = "curves";

/// How pictures are drawn for files.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct Print {
    /// Draw the pictures for print, this wide (mm, cm or in): 90mm for a column, 190mm for two. Text is 7 to 9 pt
    /// there, SVG and PDF hold their typeface, PNG has 600 dots an inch
    #[arg(long, value_name = "WIDTH", allow_hyphen_values = true)]
    pub(crate) width: Option<Width>,
}

impl Print {
    /// What pictures of these formats are drawn for.
    pub(crate) fn layout(self, formats: &[PlotFormat]) -> Result<Layout, Failure> {
        match self.width {
            Some(_) if formats.is_empty() => {
                Err(Failure::Usage("--width is that of pictures in files: say which with --plots svg,png,pdf".into()))
            }
            Some(Width(mm)) => Ok(Layout::Print(mm)),
            None => Ok(Layout::Wide),
        }
    }
}

/// Width of a printed picture, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Width(f64);

impl FromStr for Width {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (least, most) = (Layout::WIDTHS_MM.start(), Layout::WIDTHS_MM.end());
        match quantity(text, "mm") {
            Ok(mm) if Layout::WIDTHS_MM.contains(&mm) => Ok(Self(mm)),
            Ok(_) => Err(format!("expected {least} to {most} mm")),
            Err(_) => Err(format!("expected a number with its unit, mm, cm or in, of {least} to {most} mm: 90mm")),
        }
    }
}

fn file_name(picture: &Picture, format: PlotFormat) -> String {
    let ending = match format {
        PlotFormat::Svg => "svg",
        PlotFormat::Png => "png",
        PlotFormat::Pdf => "pdf",
    };
    format!("{}.{ending}", picture.name)
}

fn bytes(picture: &Picture, format: PlotFormat) -> Result<Vec<u8>, Failure> {
    match format {
        PlotFormat::Svg => Ok(picture.svg().into_bytes()),
        PlotFormat::Png => Ok(picture.png_file()?),
        PlotFormat::Pdf => Ok(picture.pdf()),
    }
}

/// Pictures as files of a folder, up to their names.
pub(crate) fn drawn(pictures: &[Picture], formats: &[PlotFormat], folder: &Path) -> Result<Vec<Complete>, Failure> {
    let mut ready = Vec::new();
    for picture in pictures {
        for format in formats {
            let path = folder.join(file_name(picture, *format));
            ready.push(atomic_prepare(path, bytes(picture, *format)?)?);
        }
    }
    Ok(ready)
}

/// Pictures as files of `folder`/plots, without their numbers.
pub(crate) fn write_plots(
    pictures: &[Picture],
    formats: &[PlotFormat],
    folder: &Path,
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let folder = folder.join(PLOTS);
    make_folder(&folder)?;
    for file in drawn(pictures, formats, &folder)? {
        written.push(file.publish()?);
    }
    Ok(())
}

fn tables(pictures: &[Picture], formats: &[PlotFormat]) -> Vec<CurveTable> {
    match formats.is_empty() {
        true => Vec::new(),
        false => pictures.iter().flat_map(Picture::tables).collect(),
    }
}

fn curve_file(table: &CurveTable) -> String {
    format!("{}.csv", table.name)
}

/// What [`ready_pictures`] will write.
pub(crate) fn picture_files(pictures: &[Picture], formats: &[PlotFormat], folder: &Path) -> Vec<PathBuf> {
    let file = |picture: &Picture, format: &PlotFormat| folder.join(PLOTS).join(file_name(picture, *format));
    let of = |picture| formats.iter().map(move |format| file(picture, format));
    let curves = tables(pictures, formats);
    let curves = curves.iter().map(|table| folder.join(CURVES).join(curve_file(table)));
    pictures.iter().flat_map(of).chain(curves).collect()
}

/// Pictures as files of `folder`/plots and their curves as files of `folder`/curves, up to the files' names.
pub(crate) fn ready_pictures(
    pictures: &[Picture],
    formats: &[PlotFormat],
    folder: &Path,
) -> Result<Vec<Complete>, Failure> {
    if pictures.is_empty() || formats.is_empty() {
        return Ok(Vec::new());
    }
    let plots = folder.join(PLOTS);
    make_folder(&plots)?;
    let mut ready = drawn(pictures, formats, &plots)?;
    let tables = tables(pictures, formats);
    if !tables.is_empty() {
        make_folder(&folder.join(CURVES))?;
    }
    for numbers in tables {
        let path = folder.join(CURVES).join(curve_file(&numbers));
        let mut table = Table::default();
        for (name, unit, values) in numbers.columns {
            let cells = values.into_iter().map(|v| v.is_finite().then_some(v));
            table.push(Column::new(name, unit, ""), Cells::Numbers(cells.collect()));
        }
        ready.push(table.prepare_csv(path)?);
    }
    Ok(ready)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_widths_of_three_units() {
        for (text, mm) in [("90mm", 90.0), ("9 cm", 90.0), ("3.5in", 88.9), ("190.0mm", 190.0)] {
            let Width(found) = text.parse().unwrap();
            assert!((found - mm).abs() < 1e-9, "{text}: {found}");
        }
    }

    #[test]
    fn regress_a_bad_width_is_refused_with_range_and_unit() {
        for text in ["90", "79mm", "201mm", "-90mm", "NaNmm", "mm", "", "9m", "infin"] {
            let words = text.parse::<Width>().unwrap_err();
            assert!(words.contains("80 to 200 mm"), "{text}: {words}");
        }
    }
}
