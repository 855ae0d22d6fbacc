//! Pictures for print: their size, their text, their typeface, and the numbers of their curves.

use super::sample::{Report, ordinary};
use brinell_report::{Layout, Picture, pictures};
use miniz_oxide::inflate::decompress_to_vec_zlib;

const PT_PER_MM: f64 = 72.0 / 25.4;
/// Of a letter raised or lowered, to the letters beside it.
const INDEX: f64 = 0.72;
const WIDTHS: [f64; 5] = [80.0, 90.0, 140.0, 190.0, 200.0];

fn printed(mm: f64) -> Vec<Picture> {
    pictures(&ordinary().page(), Layout::Print(mm))
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

/// 7 to 9 points, and of an index its share of that; a hundredth for rounding.
fn legible(points: f64) -> bool {
    (6.99..=9.01).contains(&points) || (6.99..=9.01).contains(&(points / INDEX))
}

#[test]
fn analytic_svg_is_as_wide_as_asked_with_text_of_seven_to_nine_points() {
    for mm in WIDTHS {
        for picture in printed(mm) {
            let svg = picture.svg();
            let tree = roxmltree::Document::parse(&svg).unwrap();
            let root = tree.root_element();
            assert_eq!(root.attribute("width"), Some(format!("{mm}mm").as_str()));
            let view: Vec<f64> = root.attribute("viewBox").unwrap().split(' ').map(number).collect();
            let height = number(root.attribute("height").unwrap().trim_end_matches("mm"));
            assert!((height / view[3] - mm / view[2]).abs() < 1e-3 * mm / view[2]);
            let mut words = 0;
            for node in tree.descendants().filter(|n| n.has_tag_name("text")) {
                let size = number(node.attribute("font-size").unwrap()) * mm / view[2] * PT_PER_MM;
                assert!((6.99..=9.01).contains(&size), "{} at {mm} mm: {size} pt", picture.name);
                words += 1;
            }
            assert!(words > 0, "{}", picture.name);
            assert!(svg.contains("@font-face") && svg.contains("url(data:font/otf;base64,"));
        }
    }
    // On the screen as ever: sizes without a unit, the page's typeface.
    let screen = pictures(&ordinary().page(), Layout::Wide).remove(1).svg();
    assert!(screen.contains("width=\"960\"") && !screen.contains("@font-face"));
}

/// The streams of a PDF after inflating, each with its dictionary.
pub(crate) fn streams(pdf: &[u8]) -> Vec<(String, Vec<u8>)> {
    let find = |from: usize, what: &[u8]| {
        let rest = &pdf[from..];
        rest.windows(what.len()).position(|w| w == what).map(|at| from + at)
    };
    let mut found = vec![];
    let mut from = 0;
    while let Some(at) = find(from, b"\nstream\n") {
        let open = pdf[..at].windows(5).rposition(|w| w == b" obj\n").unwrap();
        let about = String::from_utf8_lossy(&pdf[open..at]).into_owned();
        let length = about.split("/Length ").nth(1).unwrap();
        let length: usize = length.split(|c: char| !c.is_ascii_digit()).next().unwrap().parse().unwrap();
        let first = at + 8;
        let data = &pdf[first..first + length];
        let data = match about.contains("FlateDecode") {
            true => decompress_to_vec_zlib(data).unwrap(),
            false => data.to_vec(),
        };
        found.push((about, data));
        from = first + length;
    }
    found
}

#[test]
fn analytic_pdf_is_as_wide_as_asked_with_text_of_seven_to_nine_points() {
    for mm in WIDTHS {
        for picture in printed(mm) {
            let pdf = picture.pdf();
            let text = String::from_utf8_lossy(&pdf).into_owned();
            let page = text.split("/MediaBox [").nth(1).unwrap();
            let corners: Vec<f64> = page.split(']').next().unwrap().split(' ').map(number).collect();
            assert!((corners[2] - mm * PT_PER_MM).abs() < 0.01, "{corners:?}");
            let drawn = streams(&pdf).into_iter().map(|(_, data)| data);
            let drawn = drawn.map(|data| String::from_utf8_lossy(&data).into_owned());
            let content = drawn.filter(|data| data.contains(" Tf")).collect::<String>();
            let scale = number(content.split(' ').next().unwrap());
            let mut words = 0;
            for line in content.lines().filter(|line| line.ends_with(" Tf")) {
                let size = scale * number(line.split(' ').nth(1).unwrap());
                assert!(legible(size), "{} at {mm} mm: {size} pt", picture.name);
                words += 1;
            }
            assert!(words > 0, "{}", picture.name);
        }
    }
}

#[test]
fn analytic_pdf_holds_the_outlines_of_its_letters_and_what_they_mean() {
    for picture in printed(90.0) {
        let pdf = picture.pdf();
        let text = String::from_utf8_lossy(&pdf).into_owned();
        assert!(pdf.starts_with(b"%PDF-1.") && text.trim_end().ends_with("%%EOF"));
        let fonts = text.matches("/Subtype /Type0").count();
        assert!((1..=2).contains(&fonts), "{}: {fonts}", picture.name);
        for part in ["/FontFile3 ", "/ToUnicode ", "/Encoding /Identity-H", "/Subtype /CIDFontType0C"] {
            assert_eq!(text.matches(part).count(), fonts, "{}: {part}", picture.name);
        }
        // A font program of the Compact Font Format, version 1.
        let programs = streams(&pdf).into_iter().filter(|(about, _)| about.contains("CIDFontType0C"));
        assert!(programs.into_iter().all(|(_, data)| data.starts_with(&[1, 0]) && data.len() > 10_000));
        assert_eq!(pdf, picture.pdf(), "the same picture, the same bytes");
    }
}

/// The vertices of the first line that an SVG draws as a curve.
fn vertices(svg: &str) -> Vec<(f64, f64)> {
    let tree = roxmltree::Document::parse(svg).unwrap();
    let series = tree.descendants().find(|n| n.attribute("class") == Some("series"));
    let path = series.unwrap().children().find_map(|p| p.attribute("d")).unwrap();
    let pair = |text: &str| {
        let (x, y) = text.split_once(' ').unwrap();
        (number(x), number(y))
    };
    path.split(['M', 'L']).filter(|t| !t.is_empty()).map(pair).collect()
}

fn ends(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    [low, values.fold(f64::NEG_INFINITY, f64::max)]
}

/// Linear axes move and stretch: with the extremes known, where each number is drawn.
fn placed(numbers: &[f64], [from, to]: [f64; 2]) -> impl Fn(f64) -> f64 {
    let [low, high] = ends(numbers.iter().copied());
    move |value| from + (value - low) / (high - low) * (to - from)
}

/// A spectrum of so many lines without a mean; the second is the highest.
fn envelope_of(lines: usize) -> Report {
    let amplitude = |k: usize| match k {
        1 => 13.0,
        k => (1.7 * k as f64).sin().powi(2) * (k % 13) as f64,
    };
    let mut report = Report::default();
    report.signals.envelope_spectrum.label = "Envelope amplitude".into();
    report.signals.envelope_spectrum.unit = "m/s^2".into();
    report.signals.envelope_spectrum.df_hz = 0.5;
    report.signals.envelope_spectrum.amplitude = (0..lines).map(amplitude).collect();
    report
}

/// The numbers of the envelope spectrum, and the vertices of its curve.
fn in_numbers(report: &Report, layout: Layout) -> (Vec<f64>, Vec<f64>, Vec<(f64, f64)>) {
    let all = pictures(&report.page(), layout);
    let picture = all.iter().find(|p| p.name == "envelope-spectrum").unwrap();
    let tables = picture.tables();
    assert_eq!(tables.len(), 1);
    assert_eq!(tables[0].name, "envelope-spectrum");
    let [(frequency, hertz, xs), (amplitude, unit, ys)] = &tables[0].columns[..] else { panic!("{tables:?}") };
    assert_eq!([frequency, hertz], ["Frequency (Hz)", "Hz"]);
    assert_eq!([amplitude, unit], ["Envelope amplitude (m/s^2)", "m/s^2"]);
    (xs.clone(), ys.clone(), vertices(&picture.svg()))
}

#[test]
fn analytic_the_curves_in_numbers_are_those_that_are_drawn() {
    for layout in [Layout::Wide, Layout::Print(90.0)] {
        let few = envelope_of(40);
        let (xs, ys, drawn) = in_numbers(&few, layout);
        assert_eq!(ys, few.signals.envelope_spectrum.amplitude);
        assert!((0..40).all(|k| xs[k] == 0.5 * k as f64));
        // Room for every one of them; pixels grow downwards.
        assert_eq!(drawn.len(), 40);
        let x = placed(&xs, ends(drawn.iter().map(|p| p.0)));
        let [top, bottom] = ends(drawn.iter().map(|p| p.1));
        let y = placed(&ys, [bottom, top]);
        for (point, (a, b)) in drawn.iter().zip(xs.iter().zip(&ys)) {
            // Drawn to a tenth of a pixel.
            assert!((x(*a) - point.0).abs() < 0.11 && (y(*b) - point.1).abs() < 0.11);
        }
        // On the same axes more than there are columns of pixels, of which each shows its highest.
        let many = envelope_of(5000);
        let (xs, ys, drawn) = in_numbers(&many, layout);
        assert_eq!(ys, many.signals.envelope_spectrum.amplitude);
        assert!(drawn.len() < 1000);
        let heights: Vec<f64> = ys.iter().map(|v| y(*v)).collect();
        for point in drawn {
            assert!(heights.iter().any(|h| (h - point.1).abs() < 0.11), "{point:?}");
        }
        assert_eq!(xs.len(), 5000);
    }
}

#[test]
fn prop_every_table_of_curves_has_columns_of_one_length_each_named_once() {
    for picture in printed(90.0) {
        for table in picture.tables() {
            let mut names: Vec<&str> = table.columns.iter().map(|c| c.0.as_str()).collect();
            assert!(table.columns.iter().all(|c| c.2.len() == table.columns[0].2.len()));
            assert!(names.iter().all(|name| !name.is_empty() && !name.contains([',', '"'])));
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), table.columns.len(), "{}", table.name);
        }
    }
}
