//! The page of several signals: a row for each, and their numbers in order.

use std::fmt::Write as _;

use crate::frame::{close, figure, none, open, section};
use crate::layout::Layout;
use crate::markup::escape;
use crate::picture::Picture;
use crate::sweep::{IndicatorPlot, embed, indicator_plot};
use crate::tables::{Table, failures, table};

/// Everything that the page of several signals shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrendReport {
    /// Heading of the page.
    pub title: String,
    /// One line under it.
    pub subtitle: String,
    /// The version of the program.
    pub version: String,
    /// A row for each signal.
    pub table: Table,
    /// What is said of each.
    pub verdicts: Table,
    /// Numbers over the signals in their order.
    pub plots: Vec<IndicatorPlot>,
    /// Signal and reason of those without a result.
    pub failures: Vec<(String, String)>,
}

/// The page's pictures, for saving as files.
pub fn trend_pictures(report: &TrendReport, layout: Layout) -> Vec<Picture> {
    let drawn = report.plots.iter().map(|p| indicator_plot(p, layout));
    layout.finished(drawn.collect())
}

/// The self-contained page.
pub fn trend_html(report: &TrendReport) -> String {
    let mut page = open(&report.title, &report.subtitle, ("Analysed", &report.version), []);
    page.push_str("<main>\n");
    table(&mut page, &report.table);
    if !report.verdicts.rows.is_empty() {
        table(&mut page, &report.verdicts);
    }
    failures(&mut page, "Files without a result", "File", &report.failures);
    section(&mut page, "trend", "Trend", |page| {
        none(
            page,
            "In the order of the table; numbers on the axis are those of its first column. Bars: 95 % intervals; rings: values without one; crosses on the axis: no value; \
             dashed: boundaries of the zones, the scores from which a family is beyond noise or high, the record that each is compared with. The score says only how far a family's harmonics rise over the noise; the verdict also takes how deep they \
             modulate the envelope, and leaves out lines that another part's damage accounts for: a high score alone is no damage.",
        );
        for (index, plot) in report.plots.iter().enumerate() {
            let _ = writeln!(page, "<h3>{}</h3>", escape(&plot.label));
            let draw = |layout| indicator_plot(plot, layout);
            figure(page, &format!("trend{index}"), draw, "");
            embed(page, plot);
        }
    });
    close(page, "", &[])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_rows_plots_and_failures_are_on_the_page_and_nothing_is_markup() {
        let report = TrendReport {
            table: Table {
                title: "Files".into(),
                columns: vec!["File".into()],
                rows: vec![vec!["a<b.csv".into()]],
                ..Table::default()
            },
            verdicts: Table { rows: vec![vec!["all > well".into()]], ..Table::default() },
            plots: vec![IndicatorPlot {
                name: "trend-rms".into(),
                label: "RMS & more".into(),
                ..IndicatorPlot::default()
            }],
            failures: vec![("c.csv".into(), "empty <".into())],
            ..TrendReport::default()
        };
        let page = trend_html(&report);
        for part in ["a&lt;b.csv", "RMS &amp; more", "empty &lt;", "all &gt; well", "Files without a result"] {
            assert!(page.contains(part), "{part}");
        }
        assert_eq!(trend_pictures(&report, Layout::Wide)[0].name, "trend-rms");
    }
}
