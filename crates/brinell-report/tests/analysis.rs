//! The page of an analysis: what must be on it, and that nothing odd breaks it.

use brinell::signal::kurtogram::Level;
use brinell_report::{
    AnalysisReport, Fact, Kurtogram, Layout, Marker, Picture, Series, Spectrum, Table, Tone, html, pictures,
};
use proptest::prelude::*;

fn analysis_html(report: &AnalysisReport) -> String {
    html(&report.clone().into())
}

fn analysis_pictures(report: &AnalysisReport, layout: Layout) -> Vec<Picture> {
    pictures(&report.clone().into(), layout)
}

const HOSTILE: &str = "</script><img src=\"x\" onerror='y'>&\u{0}\u{2028}";

fn report(text: &str, values: &[f64]) -> AnalysisReport {
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
    let spectrum =
        Spectrum { label: text.into(), df_hz: at(0), amplitude: values.to_vec(), unit: text.into(), note: text.into() };
    AnalysisReport {
        title: text.into(),
        subtitle: text.into(),
        version: text.into(),
        verdict: text.into(),
        tone: Tone::Bad,
        warnings: vec![text.into()],
        notes: vec![text.into()],
        facts: vec![Fact::new(text, at(2), text, text)],
        names: vec![text.into(); 2],
        waveforms: vec![
            Series {
                label: text.into(),
                unit: text.into(),
                t0_s: at(3),
                dt_s: at(0),
                values: values.to_vec(),
            };
            2
        ],
        close_up_s: at(4),
        order_tracked: values.len() % 2 == 1,
        spectra: vec![spectrum.clone(); 2],
        envelopes: vec![spectrum; 2],
        markers: vec![Marker {
            label: text.into(),
            meaning: text.into(),
            frequency_hz: at(5),
            pure_rolling_hz: None,
            harmonics: 5,
            present: at(6) > 0.0,
            sidebands: vec![(at(4), text.into())],
        }],
        band_hz: Some((at(7), at(8))),
        kurtogram: Some(Kurtogram {
            levels: values
                .chunks(2)
                .map(|v| Level { bandwidth: at(0), kurtosis: v.to_vec(), noise_scatter: 0.0 })
                .collect(),
            chosen_hz: Some((at(7), at(8))),
            demodulated_hz: Some((at(7), at(8))),
            note: text.into(),
        }),
        tables: vec![Table {
            title: text.into(),
            columns: vec![text.into(), format!("#{text}")],
            rows: vec![vec![text.into(); 2]],
            note: text.into(),
        }],
    }
}

/// Eight samples, a spectrum with one line, and a kurtogram of 1, 2 and 4 bands.
fn plain() -> AnalysisReport {
    let mut r = report("plain", &[0.5, 1.0, 2.0, 0.0, 1.0, 1.5, 1.0, 1.0, 2.0]);
    let level = |bandwidth: f64, kurtosis: &[f64]| Level { bandwidth, kurtosis: kurtosis.to_vec(), noise_scatter: 0.0 };
    r.kurtogram = Some(Kurtogram {
        levels: vec![level(4000.0, &[0.1]), level(2000.0, &[0.0, 0.4]), level(1000.0, &[0.0, 0.0, 3.5, 0.2])],
        chosen_hz: Some((2000.0, 3000.0)),
        demodulated_hz: Some((1000.0, 4000.0)),
        note: String::new(),
    });
    r
}

#[test]
fn prop_the_page_holds_every_part_and_escapes_all_of_it() {
    let page = analysis_html(&report(HOSTILE, &[0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 1.0, 7.0, 8.0]));
    for part in ["verdict", "waveform", "spectrum", "kurtogram", "envelope", "given"] {
        assert!(page.contains(&format!("<section id=\"{part}\">")), "{part}");
    }
    assert!(!page.contains("<img"));
    // The numbers of three plots and the script itself; none of them ends early.
    let (opened, closed) = (page.matches("<script").count(), page.matches("</script>").count());
    assert_eq!((opened, closed), (4, 4));
    for plot in ["close-up", "spectrum", "envelope"] {
        assert!(page.contains(&format!("data-chart=\"{plot}\"")), "{plot}");
        assert!(page.contains(&format!("data-plot=\"{plot}\"")), "{plot}");
    }
    // Nothing is fetched.
    assert!(!page.contains("http://") && !page.contains("src=\"http"));
    assert_eq!(page.matches("<html").count(), 1);
    assert!(page.ends_with("</html>\n"));
}

#[test]
fn regress_the_verdict_is_the_headline_and_has_its_colour() {
    let mut r = plain();
    for (tone, class) in [(Tone::Bad, "bad"), (Tone::Good, "good"), (Tone::Open, "open")] {
        (r.title, r.tone) = ("Damage: outer race".into(), tone);
        let page = analysis_html(&r);
        assert!(page.contains("<h1>Damage: outer race</h1>"));
        assert!(page.contains(&format!("<p class=\"verdict {class}\">")));
    }
}

#[test]
fn regress_pictures_and_their_names() {
    let names = |r: &AnalysisReport| -> Vec<String> {
        analysis_pictures(r, Layout::Wide).into_iter().map(|p| p.name).collect()
    };
    let mut r = plain();
    let all = ["envelope-spectrum", "waveform", "close-up", "spectrum", "kurtogram"];
    assert_eq!(names(&r), all);
    r.kurtogram = None;
    assert_eq!(names(&r), ["envelope-spectrum", "waveform", "close-up", "spectrum"]);
    assert!(!analysis_html(&r).contains("id=\"kurtogram\""));
}

/// The picture of this name.
fn picture(r: &AnalysisReport, name: &str) -> String {
    let all = analysis_pictures(r, Layout::Wide);
    all.iter().find(|picture| picture.name == name).unwrap_or_else(|| panic!("no {name}")).svg()
}

#[test]
fn analytic_a_second_signal_has_its_own_curve_and_name() {
    let mut r = plain();
    r.names = vec!["measured".into(), "simulated".into()];
    let svg = |r: &AnalysisReport| picture(r, "spectrum");
    assert!(svg(&r).contains("measured") && svg(&r).contains("simulated"));
    let two = svg(&r).matches("<path").count() + svg(&r).matches("<polyline").count();
    r.spectra.truncate(1);
    let one = svg(&r).matches("<path").count() + svg(&r).matches("<polyline").count();
    assert!(two > one, "{two} {one}");
    // Of waveforms the one that reaches farther lies below, and the script knows which is which.
    let mut r = plain();
    r.names = vec!["measured".into(), "simulated".into()];
    let mut loud = r.waveforms[0].clone();
    loud.values.iter_mut().for_each(|v| *v *= 10.0);
    r.waveforms.truncate(1);
    r.waveforms.push(loud);
    assert!(analysis_html(&r).contains("\"drawn\":[1, 0]"));
}

#[test]
fn analytic_sidebands_of_damage_are_marked_where_they_lie() {
    let mut r = plain();
    // Lines up to 4 Hz: the harmonic lies at a half, the sideband at three quarters of the frame.
    r.markers[0].frequency_hz = 2.0;
    r.markers[0].sidebands = vec![(3.0, "1 × BPFI + 1 × shaft".into())];
    let marks = |r: &AnalysisReport| {
        let svg = picture(r, "envelope-spectrum");
        let lane = svg.split("class=\"lane\"").nth(1).expect("a lane").to_owned();
        let lane = lane.split("</g>").next().expect("its end");
        let starts = lane.split(" d=\"M").skip(1);
        starts.map(|d| d.split(' ').next().and_then(|x| x.parse().ok()).expect("a place")).collect::<Vec<f64>>()
    };
    let with = marks(&r);
    assert!(analysis_html(&r).contains("[3,\"1 × BPFI + 1 × shaft\",\"\",1]"));
    r.markers[0].sidebands.clear();
    let without = marks(&r);
    assert_eq!(with[..with.len() - 1], without[..]);
    let (harmonic, sideband) = (with[0], with[with.len() - 1]);
    let frame = analysis_html(&r);
    let frame = frame.split("data-plot=\"envelope\" data-frame=\"").nth(1).expect("a frame");
    let left: f64 = frame.split(' ').next().and_then(|x| x.parse().ok()).expect("its left");
    assert!((sideband - left - 1.5 * (harmonic - left)).abs() < 0.1, "{left} {harmonic} {sideband}");
}

/// A drawing without the pixels of its images: base64 has every word of three letters now and then.
fn numbers(svg: &str) -> String {
    let mut parts = svg.split("base64,");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once('"').expect("an image ends").1)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn prop_odd_numbers_break_nothing(values in prop::collection::vec(prop_oneof![
        any::<f64>(), -10.0..10.0f64, Just(f64::NAN), Just(f64::INFINITY), Just(0.0)
    ], 0..40)) {
        let r = report("x", &values);
        let page = analysis_html(&r);
        prop_assert!(page.ends_with("</html>\n"));
        for picture in analysis_pictures(&r, Layout::Wide) {
            let svg = numbers(&picture.svg());
            prop_assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", picture.name);
        }
    }
}
