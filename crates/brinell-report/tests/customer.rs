//! The customer's report: two pages of A4, the same words in both files, and nothing beyond the margins whatever is given.

use crate::report::print::streams;
use brinell::analysis::{Levels, MachineClass, NamedBearing, Options, Unit, Verdict, Zone, analyze};
use brinell::random::Random;
use brinell_report::{Analyzed, CustomerReport, DamageKind, Findings, Heading, Judged, JudgedOf};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::sync::LazyLock;

const FS: f64 = 12_000.0;
const SHAFT: f64 = 30.0;

/// Three seconds of noise, and impacts of a height at the rate of the outer race of a 6205-2RS.
fn judged(height: f64) -> Judged {
    let mut noise = Random::new(11);
    let mut x: Vec<f64> = (0..36_000).map(|_| noise.normal()).collect();
    let mut at = 0.002;
    while height > 0.0 && at < 2.99 {
        let first = (at * FS).ceil() as usize;
        for (i, value) in x.iter_mut().enumerate().skip(first).take(90) {
            let since = i as f64 / FS - at;
            *value += height * (-since / 8e-4).exp() * (TAU * 3000.0 * since).sin();
        }
        at += (1.0 + 0.005 * noise.normal()) / (3.585 * SHAFT);
    }
    let orders = NamedBearing::find("6205-2RS").unwrap().orders();
    let analysis = analyze(&x, FS, &Options::new(SHAFT, orders)).unwrap();
    let unit = Unit::of("m/s^2");
    let levels = Levels::of(&[&x], &unit, &analysis, Some(MachineClass::MediumRigid));
    Judged::of(JudgedOf {
        findings: Findings {
            signal: Analyzed { name: "pump.csv", x: &x, rate: FS, analysis: &analysis },
            unit: &unit,
            verdict: &analysis.verdict(),
            notes: &[],
            warnings: &[],
            speed: "shaft speed 1800 r/min, as given",
            bearing: "6205-2RS",
            levels: &levels,
            velocity: None,
            against: None,
        },
        files: &["pump.csv".into()],
        notes: &["unit m/s^2, as given".into()],
        simulated: false,
        channel: "acc",
        bearing: "6205-2RS",
        bearings: vec![("6205-2RS".into(), "outer race, very clear".into())],
        speed: "1800 r/min, as given".into(),
        alike: None,
        size: Some("2.0 mm along the rolling direction.".into()),
    })
}

static DAMAGED: LazyLock<Judged> = LazyLock::new(|| judged(6.0));

fn heading() -> Heading {
    let text = |text: &str| text.to_owned();
    Heading {
        title: text("Pump P-301 <b>"),
        machine: text("P-301"),
        point: text("drive end"),
        date: text("2026-03-02"),
        author: text("A. Writer"),
        remark: text("Noise since May."),
        kind: None,
    }
}

fn report(heading: Heading, signals: Vec<Judged>) -> CustomerReport {
    CustomerReport::of(heading, signals, &[]).unwrap()
}

/// The SVG elements of a page.
fn drawings(html: &str) -> Vec<&str> {
    html.split("<svg ").skip(1).map(|rest| rest.split_inclusive("</svg>").next().unwrap()).collect()
}

/// The lines of text of an SVG element, as they are read.
fn lines(drawing: &str) -> Vec<String> {
    let svg = format!("<svg {drawing}");
    let tree = roxmltree::Document::parse(&svg).unwrap();
    let texts = tree.descendants().filter(|node| node.has_tag_name("text"));
    texts.map(|text| text.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect()).collect()
}

/// The bytes of a string in a PDF from its first character on, and what follows it.
fn string(from: &[u8]) -> (Vec<u8>, &[u8]) {
    let mut bytes = Vec::new();
    if from[0] == b'<' {
        let end = from.iter().position(|b| *b == b'>').unwrap();
        let digits: Vec<u8> = from[1..end].iter().map(|b| (*b as char).to_digit(16).unwrap() as u8).collect();
        bytes.extend(digits.chunks(2).map(|pair| 16 * pair[0] + pair[1]));
        return (bytes, &from[end + 1..]);
    }
    let (mut k, mut depth) = (1, 1);
    loop {
        match from[k] {
            b'\\' => {
                k += 1;
                let octal = from[k..].iter().take(3).take_while(|b| (b'0'..=b'7').contains(b)).count();
                if octal > 0 {
                    let value = from[k..k + octal].iter().fold(0u32, |value, b| 8 * value + u32::from(b - b'0'));
                    bytes.push(value as u8);
                    k += octal - 1;
                } else {
                    bytes.push(match from[k] {
                        b'n' => b'\n',
                        b'r' => b'\r',
                        b't' => b'\t',
                        b'b' => 8,
                        b'f' => 12,
                        other => other,
                    });
                }
            }
            b')' if depth == 1 => return (bytes, &from[k + 1..]),
            other => {
                depth += i32::from(other == b'(') - i32::from(other == b')');
                bytes.push(other);
            }
        }
        k += 1;
    }
}

/// The lines of text of a PDF, page after page, as what its fonts say that their glyphs mean.
fn words_of(pdf: &[u8]) -> Vec<String> {
    let streams = streams(pdf);
    let text = |data: &[u8]| String::from_utf8_lossy(data).into_owned();
    let hex = |part: &str| u32::from_str_radix(part.trim_matches(['<', '>']), 16).unwrap();
    let maps: Vec<Vec<(u32, char)>> = streams
        .iter()
        .map(|(_, data)| text(data))
        .filter(|data| data.contains("begincmap"))
        .map(|map| {
            let pairs = map.lines().filter(|line| line.starts_with('<')).filter_map(|line| line.split_once(' '));
            let pairs = pairs.filter(|(_, to)| to.len() == 6);
            pairs.map(|(id, to)| (hex(id), char::from_u32(hex(to)).unwrap())).collect()
        })
        .collect();
    let mut found = Vec::new();
    for (_, data) in streams.iter().filter(|(_, data)| text(data).contains(" Tf")) {
        let (mut font, mut rest) = (0, &data[..]);
        while !rest.is_empty() {
            match rest {
                [b'B', b'T', b'\n', ..] => found.push(String::new()),
                [b'/', b'F', digit, ..] => font = usize::from(digit - b'0'),
                [b'(' | b'<', ..] => {
                    let (bytes, after) = string(rest);
                    for id in bytes.chunks(2).map(|pair| 256 * u32::from(pair[0]) + u32::from(pair[1])) {
                        let letter = maps[font].iter().find(|(known, _)| *known == id).unwrap().1;
                        found.last_mut().unwrap().push(letter);
                    }
                    rest = after;
                    continue;
                }
                _ => {}
            }
            rest = &rest[1..];
        }
    }
    found
}

#[test]
fn analytic_a_pdf_of_two_pages_of_a4_that_says_whose_it_is() {
    let pdf = report(heading(), vec![DAMAGED.clone()]).pdf();
    let text = String::from_utf8_lossy(&pdf).into_owned();
    assert_eq!(text.matches("/Type /Page\n").count(), 2);
    let boxes: Vec<&str> = text.split("/MediaBox [").skip(1).map(|rest| rest.split(']').next().unwrap()).collect();
    assert_eq!(boxes.len(), 2);
    for corners in boxes {
        let [x, y, width, height] = corners.split(' ').map(|v| v.parse::<f64>().unwrap()).collect::<Vec<_>>()[..]
        else {
            panic!("{corners}")
        };
        let points = |mm: f64| mm * 72.0 / 25.4;
        assert!(x == 0.0 && y == 0.0 && (width - points(210.0)).abs() < 0.01 && (height - points(297.0)).abs() < 0.01);
    }
    for part in ["/Title (Pump P-301 <b>)", "/Author (A. Writer)", "/Creator (brinell analyze)", "/Lang (en)"] {
        assert!(text.contains(part), "{part}");
    }
    // One font program for both pages.
    assert_eq!(text.matches("/Subtype /Type0").count(), 2);
}

#[test]
fn prop_both_files_say_the_same_line_by_line() {
    let report = report(heading(), vec![DAMAGED.clone()]);
    let html = report.html();
    let sheets = drawings(&html);
    assert_eq!(sheets.len(), 3, "two sheets, and one column for a phone");
    let on_sheets = [lines(sheets[0]), lines(sheets[1])].concat();
    assert_eq!(on_sheets, words_of(&report.pdf()));
    assert!(on_sheets.len() > 80);
    // The column says it too, in other lines.
    let words = |lines: &[String]| lines.join(" ");
    let column = words(&lines(sheets[2]));
    for part in ["Pump P-301 <b>", "The outer race is damaged", "154.9", "Method", "pump.csv"] {
        assert_eq!(words(&on_sheets).contains(part), column.contains(part), "{part}");
    }
    // Tables are cards there: a line for each cell that says something, with the unit behind its value.
    assert!(!column.contains("; Unit") && !column.contains("Value:") && !column.contains("–"), "{column}");
    assert!(column.contains("Peak of the record Value"), "{column}");
    for part in ["<html lang=\"en\">", "<title>Pump P-301 &lt;b&gt;</title>", "@page { size: 210mm 297mm; margin: 0; }"]
    {
        assert!(html.contains(part), "{part}");
    }
    assert!(!html.contains("<script") && !html.contains("<b>") && !html.contains("http://"));
}

/// All words of both pages.
fn said(report: &CustomerReport) -> String {
    let html = report.html();
    drawings(&html)[..2].iter().flat_map(|sheet| lines(sheet)).collect::<Vec<_>>().join(" ")
}

#[test]
fn prop_the_kind_of_damage_is_what_somebody_saw_and_nothing_else() {
    let without = said(&report(heading(), vec![DAMAGED.clone()]));
    assert!(without.contains("Kind of damage: not stated. Vibration tells the part, not the kind"), "{without}");
    assert!(!without.contains("ISO 15243:2017"));
    for kind in DamageKind::all() {
        let words = said(&report(Heading { kind: Some(kind), ..heading() }, vec![DAMAGED.clone()]));
        assert!(words.contains(&kind.words()) && words.contains("stated by the author"), "{words}");
    }
}

/// What each verdict says of how bad it is and what to do.
#[test]
fn prop_each_verdict_and_zone_has_its_severity_and_its_steps() {
    let of = |verdict, clarity, zone: Option<Zone>| {
        let mut one = Judged { verdict, clarity, ..DAMAGED.clone() };
        one.whole.zone = zone;
        said(&report(heading(), vec![one]))
    };
    let damage = |zone| of(Verdict::Damage, "very clear", zone);
    let low = damage(Some(Zone::B));
    for part in [
        "Not graded: the bearing shows the damage",
        "plan its exchange for the next suitable stop",
        "No remaining life is given",
    ] {
        assert!(low.contains(part), "{part}: {low}");
    }
    assert!(
        damage(Some(Zone::C)).contains("Elevated:") && damage(Some(Zone::C)).contains("bring its exchange forward")
    );
    assert!(damage(Some(Zone::D)).contains("Severe:") && damage(Some(Zone::D)).contains("Zone D: act at once"));
    assert!(damage(None).contains("Not graded:"));
    let weak = of(Verdict::Damage, "weak", None);
    assert!(
        weak.contains("Signs of damage of the outer race") && weak.contains("Do not exchange the bearing"),
        "{weak}"
    );
    let open = of(Verdict::CannotTell, "", Some(Zone::A));
    assert!(open.contains("Cannot tell") && open.contains("Settle what is open"), "{open}");
    assert!(!open.contains("Order the bearing"));
    let none = of(Verdict::NothingFound, "", Some(Zone::D));
    assert!(none.contains("no proof of a healthy bearing") && none.contains("Look for the cause"), "{none}");
    assert!(!none.contains("Go on with the usual interval"));
}

#[test]
fn prop_noise_is_no_damage_and_the_clearest_of_several_leads() {
    let quiet = Judged { channel: "quiet".into(), ..judged(0.0) };
    assert_eq!(quiet.verdict, Verdict::NothingFound);
    assert!(said(&report(heading(), vec![quiet.clone()])).contains("No damage found"));
    let faint = Judged { channel: "faint".into(), score: Some(16.0), ..DAMAGED.clone() };
    let mut loud = Judged { channel: "loud".into(), ..quiet.clone() };
    loud.whole.velocity = Some(99.0);
    loud.whole.words = "Machine: 99.0 mm/s RMS.".into();
    let without = [("broken".to_owned(), "the file is empty".to_owned())];
    let report = CustomerReport::of(heading(), vec![loud, quiet, faint, DAMAGED.clone()], &without).unwrap();
    assert_eq!((report.lead.channel.as_str(), report.all.rows.len()), ("acc", 5));
    let words = said(&report);
    for part in ["Channel that leads acc", "no result: the file is empty", "99.0 mm/s RMS"] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(CustomerReport::of(heading(), Vec::new(), &without).is_none());
    assert!(!words.contains("Simulated:") && words.contains("unit m/s², as given"));
    let simulated = said(&self::report(heading(), vec![Judged { simulated: true, ..DAMAGED.clone() }]));
    assert!(simulated.contains("Simulated: no machine was measured"), "{simulated}");
}

/// Whether a page is white in its margins and between its text and its foot; what would cross the edge of the paper
/// crosses a margin first.
fn keeps_its_margins(report: &CustomerReport) {
    for page in report.pages() {
        assert_eq!(page.size(), (840.0, 1188.0));
        let png = page.png(1.0).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let (columns, rows) = (840, 1188);
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels.len(), 3 * columns * rows);
        let drawn = |y: usize, across: std::ops::Range<usize>| {
            let row = &pixels[3 * columns * y..3 * columns * (y + 1)];
            row[3 * across.start..3 * across.end].iter().filter(|part| **part < 250).count()
        };
        for y in 0..rows {
            let all = !(44..1147).contains(&y) || (1114..1124).contains(&y);
            let free = if all { drawn(y, 0..columns) } else { drawn(y, 0..58) + drawn(y, 783..columns) };
            assert_eq!(free, 0, "{}: drawn beyond the margins, {y} px from above", page.name);
        }
        assert!((44..1114).map(|y| drawn(y, 58..783)).sum::<usize>() > 10_000);
    }
}

fn hostile(text: &str, signals: usize, remarks: usize) -> CustomerReport {
    let one = || {
        let mut one = DAMAGED.clone();
        for field in [&mut one.channel, &mut one.bearing, &mut one.speed, &mut one.reason, &mut one.whole.words] {
            text.clone_into(field);
        }
        one.bearings = vec![(text.into(), text.into()); 2];
        one.severity = vec![format!("Bearing: {text}"), format!("Length: {text}")];
        one.provenance.iter_mut().for_each(|(_, words)| text.clone_into(words));
        one.report.verdict = text.repeat(4);
        one.report.warnings = vec![text.into(); remarks];
        one.levels.rows.iter_mut().flatten().for_each(|cell| text.clone_into(cell));
        one.evidence.rows.iter_mut().flatten().for_each(|cell| text.clone_into(cell));
        one
    };
    let given = || text.to_owned();
    let heading = Heading {
        title: given(),
        machine: given(),
        point: given(),
        date: given(),
        author: given(),
        remark: given(),
        kind: DamageKind::all().last(),
    };
    let without = vec![(given(), given()); signals];
    CustomerReport::of(heading, (0..signals).map(|_| one()).collect(), &without).unwrap()
}

#[test]
fn prop_hostile_lengths_stay_on_two_pages() {
    keeps_its_margins(&report(heading(), vec![DAMAGED.clone()]));
    for text in
        ["x".repeat(300), "漢字".repeat(150), "Verylongtitle ".repeat(25), "WWW\u{301}\n\t\u{202e}🛠 ".repeat(40)]
    {
        keeps_its_margins(&hostile(&text, 6, 9));
        let html = hostile(&text, 6, 9).html();
        assert!(drawings(&html).into_iter().all(|drawing| !lines(drawing).is_empty()));
    }
    assert_eq!(hostile("pump 漢字漢", 1, 0).missing_letters(), "字漢");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn prop_any_text_stays_on_two_pages(text in "\\PC{0,120}", signals in 1usize..9, remarks in 0usize..12) {
        keeps_its_margins(&hostile(&text, signals, remarks));
    }
}
