//! SVG drawings against closed forms.

use std::f64::consts::PI;

use crate::common::{Noise, holds, width_at};
use brinell::scenario::SvgFile;
use brinell_damage::{DamageError, Polygons, read_svg};

fn page(inside: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 20 10">{inside}</svg>"#)
}

fn read(inside: &str) -> Polygons {
    read_svg(page(inside).as_bytes(), &SvgFile::default()).unwrap()
}

fn refuse(text: &str, options: &SvgFile) -> DamageError {
    read_svg(text.as_bytes(), options).unwrap_err()
}

#[test]
fn analytic_rectangle_has_its_area_and_widths() {
    let damage = read(r#"<rect x="3" y="1" width="3" height="4"/>"#);
    assert!((damage.area_mm2() - 12.0).abs() < 1e-9);
    assert_eq!(damage.polygons_mm.len(), 1);
    for s in [-1.49, 0.0, 1.49] {
        assert!((width_at(&damage.polygons_mm, s) - 4.0).abs() < 1e-9);
    }
    assert_eq!(width_at(&damage.polygons_mm, 1.51), 0.0);
}

#[test]
fn analytic_circle_in_five_ways_has_its_area_and_chords_within_the_tolerance() {
    let four_cubics = "M7 5C7 6.1046 6.1046 7 5 7C3.8954 7 3 6.1046 3 5C3 3.8954 3.8954 3 5 3C6.1046 3 7 3.8954 7 5Z";
    // The error of an arc as cubics that kurbo takes from path data, relative to the radius.
    let arc = 2.8e-4;
    for (shape, shape_error) in [
        (r#"<circle cx="5" cy="5" r="2"/>"#.to_owned(), 1e-6),
        (r#"<ellipse cx="5" cy="5" rx="2" ry="2"/>"#.to_owned(), 1e-6),
        (r#"<g transform="translate(5 5) scale(0.02)"><circle r="100"/></g>"#.to_owned(), 1e-6),
        (r#"<path d="M7 5A2 2 0 0 1 3 5A2 2 0 0 1 7 5"/>"#.to_owned(), arc),
        (format!(r#"<path d="{four_cubics}"/>"#), arc),
    ] {
        for tolerance_mm in [1e-2, 1e-3, 1e-4] {
            let options = SvgFile { tolerance_mm, ..Default::default() };
            let damage = read_svg(page(&shape).as_bytes(), &options).unwrap();
            let off = tolerance_mm + 2.0 * shape_error;
            let area_error = (damage.area_mm2() - 4.0 * PI).abs();
            assert!(area_error < 4.0 * PI * off, "{shape}: {area_error}");
            for s in [-1.5_f64, 0.0, 0.7] {
                let chord = 2.0 * (4.0 - s * s).sqrt();
                // Across the chord the boundary's distance counts by 1/cos of its slope.
                let bound = 2.0 * off * 4.0 / chord + 1e-6;
                let error = (width_at(&damage.polygons_mm, s) - chord).abs();
                assert!(error < bound, "{shape}, s = {s}: {error} >= {bound}");
            }
        }
    }
}

#[test]
fn analytic_holes_follow_the_fill_rule_and_overlaps_unite() {
    let twice = "M0 0H4V4H0ZM1 1H3V3H1Z";
    let opposite = "M0 0H4V4H0ZM1 1V3H3V1Z";
    for (shape, area) in [
        (format!(r#"<path d="{twice}"/>"#), 16.0),
        (format!(r#"<path fill-rule="evenodd" d="{twice}"/>"#), 12.0),
        (format!(r#"<path style="fill-rule:evenodd" d="{twice}"/>"#), 12.0),
        (format!(r#"<path d="{opposite}"/>"#), 12.0),
        (r#"<rect width="4" height="4"/><rect x="2" y="2" width="4" height="4"/>"#.to_owned(), 28.0),
        // A second shape fills half of the first one's hole.
        (format!(r#"<path d="{opposite}"/><rect x="1" y="1" width="1" height="2"/>"#), 14.0),
        // A bow tie: two triangles, whatever their sense.
        (r#"<polygon points="0,0 4,4 4,0 0,4"/>"#.to_owned(), 8.0),
    ] {
        let damage = read(&shape);
        assert!((damage.area_mm2() - area).abs() < 1e-6, "{shape}: {}", damage.area_mm2());
        let even_odd = (0..4000).filter(|i| {
            let point = [f64::from(i % 80) * 0.1 - 3.97, f64::from(i / 80) * 0.16 - 3.93];
            holds(&damage.polygons_mm, point)
        });
        assert!((even_odd.count() as f64 * 0.016 - area).abs() < 0.5, "{shape}");
    }
}

#[test]
fn analytic_an_l_stays_an_l() {
    // Upright on the screen: the long stroke on the left, the short one at the bottom to the right.
    let damage = read(r#"<path d="M2 1H3V6H5V7H2Z"/>"#);
    assert!((damage.area_mm2() - 8.0).abs() < 1e-9);
    assert!(holds(&damage.polygons_mm, [-1.0, 2.5]), "the top of the long stroke");
    assert!(holds(&damage.polygons_mm, [1.0, -2.5]), "the end of the short stroke");
    assert!(!holds(&damage.polygons_mm, [1.0, 2.5]));
    let turned = read(r#"<path transform="rotate(90)" d="M2 1H3V6H5V7H2Z"/>"#);
    // Clockwise on the screen: the long stroke now on top, the short one down on the left.
    assert!(holds(&turned.polygons_mm, [2.5, 1.0]) && holds(&turned.polygons_mm, [-2.5, -1.0]));
    assert!(!holds(&turned.polygons_mm, [2.5, -1.0]));
}

#[test]
fn analytic_without_center_the_page_centre_is_the_origin() {
    let options = SvgFile { center: false, ..Default::default() };
    let damage = read_svg(page(r#"<rect x="12" y="1" width="2" height="1"/>"#).as_bytes(), &options).unwrap();
    let [low, high] = damage.bounds_mm().unwrap();
    for (got, expected) in low.into_iter().chain(high).zip([2.0, 3.0, 4.0, 4.0]) {
        assert!((got - expected).abs() < 1e-9);
    }
}

#[test]
fn analytic_scale_from_the_page_or_from_the_option() {
    let drawing =
        |head: &str| format!(r#"<svg xmlns="http://www.w3.org/2000/svg" {head}><rect width="10" height="5"/></svg>"#);
    let by_hand = SvgFile { mm_per_unit: Some(0.5), ..Default::default() };
    for (head, options, area) in [
        (r#"width="40mm" height="20mm" viewBox="0 0 20 10""#, SvgFile::default(), 200.0),
        (r#"width="1in" height="1in" viewBox="0 0 254 254""#, SvgFile::default(), 0.5),
        (r#"width="10cm" height="5cm""#, SvgFile::default(), 50.0 * (25.4_f64 / 96.0).powi(2)),
        (r#"width="800px" height="600px""#, by_hand.clone(), 12.5),
        ("", by_hand, 12.5),
    ] {
        let damage = read_svg(drawing(head).as_bytes(), &options).unwrap();
        assert!((damage.area_mm2() / area - 1.0).abs() < 1e-8, "{head}");
    }
    for head in [r#"width="800" height="600""#, "", r#"width="10mm" height="10mm" viewBox="0 0 20 10""#] {
        let error = refuse(&drawing(head), &SvgFile::default());
        assert!(matches!(error, DamageError::NoScale { .. }), "{error}");
        assert!(error.to_string().contains("`mm_per_unit`"));
    }
}

#[test]
fn regress_a_drawing_as_inkscape_saves_it() {
    let text = r##"<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<!-- Created with Inkscape (http://www.inkscape.org/) -->
<svg width="210mm" height="297mm" viewBox="0 0 210 297" version="1.1" id="svg1"
   xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
   xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"
   xmlns:xlink="http://www.w3.org/1999/xlink" xmlns="http://www.w3.org/2000/svg">
  <sodipodi:namedview id="namedview1" pagecolor="#ffffff" inkscape:document-units="mm"/>
  <defs id="defs1"><rect id="hidden" width="50" height="50"/></defs>
  <g inkscape:label="photo" inkscape:groupmode="layer" id="layer1" style="display:none">
    <rect id="rect9" width="100" height="100"/></g>
  <g inkscape:label="spall" inkscape:groupmode="layer" id="layer2" transform="translate(-10,-20)">
    <path style="fill:none;stroke:#ff0000;stroke-width:0.264583" id="spall"
       d="m 50,60 c 0,-2 4,-2 4,0 l 0,3 h -4 z" inkscape:connector-curvature="0"/>
    <path style="fill:#00f" id="second" d="m 60,60 h 1 v 1 h -1 z"/>
    <use xlink:href="#second" x="2"/>
    <text x="1" y="1" id="text1">spall 7</text>
  </g>
</svg>"##;
    // The integral of y dx under the cubic (0, 0) (0, 2) (4, 2) (4, 0).
    let arch = 4.8;
    let options = |id: Option<&str>| SvgFile { path_id: id.map(str::to_owned), ..Default::default() };
    let all = read_svg(text.as_bytes(), &options(None)).unwrap();
    assert!((all.area_mm2() - (12.0 + arch + 2.0)).abs() < 0.01, "{}", all.area_mm2());
    assert_eq!(all.warnings, ["line 16, `text` #text1: left out; only closed shapes are damage"]);
    let one = read_svg(text.as_bytes(), &options(Some("second"))).unwrap();
    // Not its copy by `use`.
    assert!((one.area_mm2() - 1.0).abs() < 1e-6);
    let layer = read_svg(text.as_bytes(), &options(Some("layer2"))).unwrap();
    assert!((layer.area_mm2() - all.area_mm2()).abs() < 1e-9);
    let error = refuse(text, &options(Some("spal")));
    assert_eq!(
        error.to_string(),
        "the drawing has no element with the id `spal`; it has hidden, layer1, rect9, layer2, spall, second"
    );
}

#[test]
fn regress_a_drawing_as_illustrator_saves_it() {
    let text = r#"<?xml version="1.0" encoding="utf-8"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg version="1.1" id="Layer_1" xmlns="http://www.w3.org/2000/svg" x="0px" y="0px" viewBox="0 0 283.46 283.46" style="enable-background:new 0 0 283.46 283.46;" xml:space="preserve">
<style type="text/css">
	.st0{fill:none;}
	.st1{fill:none;stroke:#000000;stroke-miterlimit:10;}
</style>
<rect class="st0" width="283.46" height="283.46"/>
<path class="st1" d="M10,10h28.346v28.346H10V10z"/>
</svg>"#;
    let points = SvgFile { mm_per_unit: Some(25.4 / 72.0), ..Default::default() };
    let damage = read_svg(text.as_bytes(), &points).unwrap();
    assert!((damage.area_mm2() - 100.0).abs() < 0.01, "{}", damage.area_mm2());
    assert!(matches!(refuse(text, &SvgFile::default()), DamageError::NoScale { .. }));
}

#[test]
fn prop_unusable_drawings_are_refused_in_words() {
    let default = SvgFile::default();
    for (inside, words) in [
        (
            r#"<path fill="none" stroke="red" d="M0 0H4V4"/>"#,
            "line 1, `path`: the line is open by 5.6569 mm (at most 0.001 mm is closed); join its ends or fill it",
        ),
        ("", "there is no damage in it: no shape with an area shows"),
        (r#"<path d="M0 0L1 1"/>"#, "encloses nothing"),
        (r#"<path d="M0 0 Lx"/>"#, "this SVG file is broken at line 1, `path`: its path data:"),
        (r#"<circle r="-1"/>"#, "its r must be above 0"),
        (r#"<circle r="5%"/>"#, "use plain numbers"),
        (r#"<path d="M0 0A1e300 1e300 0 0 1 4 4Z"/>"#, "a number in the drawing is 1e300"),
        (r#"<rect width="99999" height="9"/>"#, "check `mm_per_unit`"),
        (r#"<g transform="spin(3)"><rect width="9" height="9"/></g>"#, "transform `spin(3)` is not understood"),
        (r##"<g id="a"><use href="#a"/></g>"##, "the depth of groups"),
        (r#"<svg><rect width="9" height="9"/></svg>"#, "a nested `svg` is not understood"),
    ] {
        let error = refuse(&page(inside), &default).to_string();
        assert!(error.contains(words), "{inside}: {error}");
    }
    let png = read_svg(b"\x89PNG\r\n\x1a\n", &default).unwrap_err();
    assert_eq!(png.to_string(), "PNG cannot be read as a drawing; save it as plain SVG");
    let coarse = SvgFile { tolerance_mm: f64::NAN, ..default };
    assert_eq!(refuse(&page(""), &coarse).to_string(), "`tolerance_mm` is NaN; it must be 1e-5 to 1 mm");
}

#[test]
fn prop_a_drawing_that_doubles_itself_is_refused_quickly() {
    let mut text = r#"<rect id="g0" width="1" height="1"/>"#.to_owned();
    for i in 1..40 {
        text.push_str(&format!(r##"<g id="g{i}"><use href="#g{0}"/><use href="#g{0}"/></g>"##, i - 1));
    }
    let begin = std::time::Instant::now();
    let error = refuse(&page(&text), &SvgFile::default());
    assert!(matches!(error, DamageError::TooLarge { .. }), "{error}");
    assert!(begin.elapsed().as_secs() < 20);
}

#[test]
fn regress_lines_that_cross_everywhere_are_refused() {
    let mut noise = Noise(1);
    let mut point = || format!("{:.3} {:.3}", 20.0 * noise.uniform(), 10.0 * noise.uniform());
    let points: Vec<String> = (0..2000).map(|_| point()).collect();
    let path = format!("<path d=\"M {} Z\"/>", points.join(" "));
    // Bars across bars: none crosses itself.
    let bar = |k: usize| {
        let at = 0.05 * k as f64;
        format!("<rect x=\"{at}\" width=\"0.02\" height=\"10\"/><rect y=\"{at}\" width=\"20\" height=\"0.02\"/>")
    };
    let bars: String = (0..100).map(bar).collect();
    for (drawing, at) in [(path, "line 1, `path`"), (bars, "its shapes together")] {
        let error = refuse(&page(&drawing), &SvgFile::default());
        assert!(matches!(error, DamageError::Tangled { .. }), "{error}");
        let expected = format!("{at}: sides cross in more than 10000 places; save");
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
}

#[test]
fn regress_a_drawing_has_4_mib_at_most() {
    let long = page(&format!("<!--{}-->", "x".repeat(4 << 20)));
    let error = refuse(&long, &SvgFile::default()).to_string();
    assert!(error.contains("more than the 4 MiB that are read"), "{error}");
}
