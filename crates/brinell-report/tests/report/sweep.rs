//! The pages of a sweep and of runs side by side: what is in them, whatever the data.

use brinell_report::{
    Along, Chapter, HeatMap, IndicatorLine, IndicatorPlot, IndicatorPoint, Layout, OverlaidCurve, Overlay, Page, Piece,
    Vertical, html, pictures, sweep_lead, sweep_legend,
};

fn point(x: f64, value: f64, interval: Option<(f64, f64)>) -> IndicatorPoint {
    IndicatorPoint { x, value, interval }
}

fn plot(points: Vec<IndicatorPoint>, names: &[&str]) -> IndicatorPlot {
    IndicatorPlot {
        name: "sensor_ax.rms".into(),
        label: "RMS of sensor_ax".into(),
        unit: "m/s^2".into(),
        x_label: "operation.speed_rpm".into(),
        x_unit: "r/min".into(),
        x_names: names.iter().map(|n| (*n).to_owned()).collect(),
        lines: vec![IndicatorLine { label: "full".into(), points }],
        ..IndicatorPlot::default()
    }
}

fn study(pieces: Vec<Piece>) -> Page {
    Page {
        title: "Sweep of <x>".into(),
        chapters: vec![Chapter::new("plots", "Plots", "Plots", pieces)],
        ..Page::default()
    }
}

fn page(plot: IndicatorPlot) -> (String, String) {
    let report = study(vec![Piece::Trend(plot)]);
    let pictures = pictures(&report, Layout::Wide);
    assert_eq!(pictures.len(), 1);
    (html(&report), pictures[0].svg())
}

#[test]
fn regress_a_failed_point_is_a_gap_and_the_marks_are_explained() {
    let points = vec![point(1000.0, 3.0, Some((2.5, 3.5))), point(2000.0, f64::NAN, None), point(3000.0, 5.0, None)];
    let plot = plot(points, &[]);
    let marks = sweep_legend(std::slice::from_ref(&plot));
    for words in ["Dots: averages over whole revolutions", "Rings: a value", "Crosses on the axis"] {
        assert!(marks.contains(words), "no {words}");
    }
    assert!(!marks.contains("sideways"));
    let (page, svg) = page(plot);
    assert!(page.contains("Sweep of &lt;x&gt;"));
    // Two dots, none for the point that failed.
    assert_eq!(svg.matches("<circle").count(), 2);
    assert!(!svg.contains("NaN") && !page.contains("NaN"));
}

#[test]
fn regress_names_are_under_the_axis() {
    let points = vec![point(0.0, 3.0, None), point(1.0, 4.0, None)];
    let (_, svg) = page(plot(points, &["full", "lumped"]));
    for words in [">full<", ">lumped<", "operation.speed_rpm"] {
        assert!(svg.contains(words), "no {words} in {svg}");
    }
    assert!(!svg.contains(">0.5<"), "nothing lies between names");
}

#[test]
fn analytic_values_over_decades_are_on_a_logarithmic_axis() {
    let heights = |values: [f64; 3]| -> [f64; 3] {
        let points = values.iter().zip([1.0, 2.0, 3.0]).map(|(v, x)| point(x, *v, None)).collect();
        let (_, svg) = page(plot(points, &[]));
        let tree = roxmltree::Document::parse(&svg).expect("valid");
        let circles = tree.descendants().filter_map(|n| n.attribute("cy"));
        circles.map(|y| y.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap()
    };
    // Of a geometric series the steps are equal on a logarithmic axis, and a tenth of the next on a linear one.
    let share = |[a, b, c]: [f64; 3]| (b - a) / (c - b);
    assert!((share(heights([10.0, 100.0, 1000.0])) - 1.0).abs() < 0.01);
    assert!((share(heights([10.0, 11.0, 21.0])) - 0.1).abs() < 0.01);
    // 0 has no logarithm.
    assert!(share(heights([0.0, 10.0, 1000.0])) < 0.02);
}

#[test]
fn prop_odd_data_make_a_page() {
    let odd = [f64::NAN, f64::INFINITY, -1e308, 0.0, 1e-320];
    for a in odd {
        for b in odd {
            let points = vec![point(a, b, Some((b, a))), point(b, a, None)];
            let (page, svg) = page(plot(points, &[]));
            assert!(page.ends_with("</html>\n"));
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{a} {b}");
        }
    }
    let (page, svg) = page(plot(vec![], &[]));
    assert!(svg.contains("No point has a value") && page.ends_with("</html>\n"));
}

fn overlaid(vertical: Vertical, values: Vec<f64>) -> Page {
    let curve = |of, along| OverlaidCurve { of, along, values: values.clone() };
    let places = (0..values.len()).map(|k| k as f64).collect();
    let even = Along::Even { first: 0.0, step: 1.0 };
    let overlay = Overlay {
        name: "spectrum".into(),
        x_label: "Frequency".into(),
        x_unit: "Hz".into(),
        y_label: "Amplitude".into(),
        y_unit: "m/s^2".into(),
        vertical,
        curves: vec![curve(0, even), curve(2, Along::At(places))],
        ..Overlay::default()
    };
    let names = ["actual", "unseen", "simple"].map(str::to_owned).to_vec();
    study(vec![Piece::Curves(overlay, names), Piece::Note("That is all.".into())])
}

#[test]
fn regress_an_overlay_names_the_runs_that_it_shows() {
    let report = overlaid(Vertical::FromZero, vec![1.0, 2.0, f64::NAN, 4.0]);
    let pictures = pictures(&report, Layout::Wide);
    let svg = pictures[0].svg();
    assert!(svg.contains(">actual<") && svg.contains(">simple<") && !svg.contains(">unseen<"));
    let page = html(&report);
    assert!(page.contains("That is all.") && page.contains("<h2>Plots</h2>"));
}

#[test]
fn regress_an_overlay_is_read_out_with_the_names_of_its_runs() {
    let mut report = overlaid(Vertical::FromZero, vec![1.0, 2.0, f64::NAN, 4.0]);
    let page = html(&report);
    for part in
        ["data-plot=\"spectrum\"", "data-chart=\"spectrum\"", "\"name\":\"actual\"", "\"name\":\"simple\",\"places\":"]
    {
        assert!(page.contains(part), "{part}");
    }
    // Places that go back and forth are no axis: such a plot is drawn, and not read out.
    let Piece::Curves(overlay, _) = &mut report.chapters[0].pieces[0] else {
        unreachable!("the sample begins with an overlay");
    };
    overlay.curves[1].along = Along::At(vec![0.0, 2.0, 1.0, 3.0]);
    assert!(!html(&report).contains("data-chart="));
}

#[test]
fn regress_two_keys_make_a_map_and_the_page_begins_with_the_ends() {
    let plots = [plot(vec![point(1000.0, 3.0, None), point(2000.0, 5.0, None)], &[])];
    let map = HeatMap {
        name: "map".into(),
        label: "RMS <of>".into(),
        x_names: vec!["1000".into(), "2000".into()],
        y_names: vec!["5".into()],
        values: vec![3.0, 5.0],
        ..HeatMap::default()
    };
    let report = Page { lead: sweep_lead(&plots), ..study(vec![Piece::Map(map)]) };
    let page = html(&report);
    for part in [
        "RMS of sensor_ax: from 3 m/s² (operation.speed_rpm = 1000 r/min) to 5 m/s² (operation.speed_rpm = 2000 r/min).",
        "RMS &lt;of&gt;",
        "data-name=\"map\"",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn prop_odd_curves_make_a_page() {
    for vertical in [Vertical::Around, Vertical::FromZero, Vertical::Decades] {
        for values in [vec![], vec![f64::NAN; 3], vec![f64::INFINITY, -1e308, 1e308], vec![0.0; 4]] {
            let page = html(&overlaid(vertical, values));
            assert!(page.ends_with("</html>\n") && !page.contains("NaN"));
        }
    }
}
