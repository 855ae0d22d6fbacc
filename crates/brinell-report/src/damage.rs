//! Pictures of damage: the raceway unrolled, what a roller meets on its way over it, and the ring's section under it.

use crate::chart::{Chart, Domain, Size, Spec, left_margin, range, right_margin};
use crate::data::Fact;
use crate::font;
use crate::number::significant;
use crate::picture::{Anchor, Paint, Picture, Rect, Shape, Text, ink};
use crate::plots::{Layout, legend};

/// One defect, seen before it is simulated. Vectors of a panel are as long as the panel's axis.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct DamageView {
    /// "Defect 1: outer raceway, row 1".
    pub title: String,
    /// "outer raceway".
    pub surface: String,
    /// What the view from above shows, as the picture's heading.
    pub plan_title: String,
    /// What the curves over the angle show.
    pub passage_title: String,
    /// What the section's curves show.
    pub section_title: String,
    /// Numbers: length, area, time to pass.
    pub facts: Vec<Fact>,
    /// Seen from above, (s, z) in mm from the defect's centre; a polygon within another is a hole.
    pub polygons_mm: Vec<Vec<[f64; 2]>>,
    /// Depths, where the damage has more than one; drawn instead of the polygons.
    pub depths: Option<DepthPatch>,
    /// L of the roller.
    pub roller_length_mm: f64,
    /// d of the roller.
    pub roller_diameter_mm: f64,
    /// Of a roller, half its circumference: the view from above goes once around, and either contact meets the damage half a turn after the
    /// other.
    pub half_turn_mm: Option<f64>,
    /// s of the load zone's ends, where the surface stands still in it.
    pub load_zone_mm: Option<[f64; 2]>,
    /// Angle of a roller from the defect's centre.
    pub angle_deg: Vec<f64>,
    /// What the roller meets there.
    pub passage: Vec<DamagePanel>,
    /// At which approach, by which laws.
    pub passage_note: String,
    /// s along the damage.
    pub section_s_mm: Vec<f64>,
    /// Section properties there.
    pub section: Vec<DamagePanel>,
    /// For which ring.
    pub section_note: String,
}

/// Depths at the nodes of a grid.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthPatch {
    /// (s, z) of the first node, mm.
    pub start_mm: [f64; 2],
    /// Distance of nodes, mm.
    pub step_mm: [f64; 2],
    /// Nodes along s.
    pub columns: usize,
    /// `depth_um[row * columns + column]`; 0 is undamaged, negative a raised edge.
    pub depth_um: Vec<f64>,
}

/// Curves on one pair of axes.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DamagePanel {
    /// "Depth".
    pub label: String,
    /// "um".
    pub unit: String,
    /// Whether the axis starts at 0.
    pub from_zero: bool,
    /// The curves.
    pub curves: Vec<DamageCurve>,
}

/// One curve.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DamageCurve {
    /// "envelope, ecl".
    pub name: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// Undamaged to deepest.
const SHADES: [&str; 8] = [
    "#fbe3cb", "#f8c99c", "#f2aa6b", "#e78a42", "#d46a22", "#b34e12", "#8a380b", "#602506",
];
/// Raised edges.
const RAISED: &str = "#9fd0ee";
/// Where the roller touches.
const TRACK: &str = "#eef2f6";
/// Largest picture of a raceway, px.
const TALLEST: f64 = 440.0;
/// Side of a shaded cell, px.
const CELL: f64 = 1.4;
/// Less than this share of the largest depth is round-off.
const LEAST: f64 = 1e-3;

/// The surface unrolled, s to the right and z upwards to one scale: damage, the track of the roller, the roller as it comes onto the damage, and
/// the load zone. Of a roller the whole circumference, with both lines of contact.
pub fn damage_plan(view: &DamageView, index: usize, layout: Layout) -> Picture {
    let Size { width, font, .. } = layout.size(0.0);
    let positive = |x: f64, or: f64| if x.is_finite() && x > 0.0 { x } else { or };
    let length = positive(view.roller_length_mm, 1.0).min(1e6);
    let radius = 0.5 * positive(view.roller_diameter_mm, length).min(1e6);
    let extent = extent(view).unwrap_or([0.0, 0.0, 0.0, 0.0]);
    let [first, last, lowest, highest] = extent;
    let tall = 1.08 * length.max(2.0 * lowest.abs()).max(2.0 * highest.abs());
    let half_turn = view.half_turn_mm.filter(|x| x.is_finite() && *x > 0.0);
    let wanted = match half_turn {
        Some(half) => 1.04 * (2.0 * half).max(last - first),
        None => 1.04 * (last - first + 2.0 * radius),
    };
    let middle = half_turn.map_or(0.5 * (first + last), |_| 0.0);
    let along = if half_turn.is_some() {
        "Around the roller, rolling direction".to_owned()
    } else if view.surface.is_empty() {
        "Along the raceway, rolling direction".to_owned()
    } else {
        format!("Along the {}, rolling direction", view.surface)
    };
    // From the room between the margins follows the scale, from the scale the height.
    let spec = |height: f64, left: f64, half: f64| Spec {
        name: format!("damage-{}", index + 1),
        title: view.title.clone(),
        size: Size {
            width,
            height,
            font,
        },
        x: Domain::exact(middle - half, middle + half),
        y: Domain::exact(-0.5 * tall, 0.5 * tall),
        x_label: along.clone(),
        x_unit: "mm".into(),
        y_label: "Across".into(),
        y_unit: "mm".into(),
        lanes: vec![],
        left,
        right: 0.0,
        x_axis: true,
    };
    let around = 8.0 + 3.4 * font;
    let draft = spec(TALLEST + around, 0.0, wanted);
    let left = left_margin(&draft).max(4.8 * font);
    let room = width - left - right_margin(&draft);
    let scale = (room / wanted).min(TALLEST / tall);
    let height = (scale * tall).max(30.0) + around;
    let mut chart = Chart::new(spec(height, left, 0.5 * room / scale));
    let frame = chart.frame;
    let (x, y) = (chart.x, chart.y);
    let clipped = |lines: Vec<Vec<(f64, f64)>>, close: bool, paint: Paint| Shape::Path {
        lines,
        close,
        paint,
        clip: Some(frame),
    };
    let track = [0.5 * length, -0.5 * length].map(|z| y.at(z));
    let ends = match half_turn {
        Some(half) => [x.at(-half), x.at(half)],
        None => [frame.left, frame.right],
    };
    // Under the grid, so that it stays visible.
    chart.picture.shapes.insert(
        0,
        clipped(
            vec![vec![
                (ends[0], track[0]),
                (ends[1], track[0]),
                (ends[1], track[1]),
                (ends[0], track[1]),
            ]],
            true,
            Paint::fill(TRACK, 1.0),
        ),
    );
    let deepest = view.depths.as_ref().map(|patch| {
        shade(&mut chart, patch, extent, clipped)
            .into_iter()
            .fold(0.0, f64::max)
    });
    if deepest.is_none() {
        let lines: Vec<Vec<(f64, f64)>> = wound(&view.polygons_mm)
            .iter()
            .map(|p| drawn(p.iter().map(|q| (x.at(q[0]), y.at(q[1])))))
            .collect();
        let paint = Paint::line(SHADES[6], 1.4).filled(SHADES[2], 1.0);
        if lines.is_empty() {
            chart.say("No damage");
        } else {
            chart.picture.shapes.push(clipped(lines, true, paint));
        }
    }
    for z in track {
        chart.picture.shapes.push(clipped(
            vec![vec![(ends[0], z), (ends[1], z)]],
            false,
            Paint::line(ink::FRAME, 1.0),
        ));
    }
    if half_turn.is_some() {
        chart.picture.shapes.push(clipped(
            ends.iter()
                .map(|&end| vec![(end, track[0]), (end, track[1])])
                .collect(),
            false,
            Paint::line(ink::FRAME, 1.0),
        ));
    }
    let line = Paint::line(ink::BLUE, 2.4);
    let hint = match half_turn {
        Some(_) => Paint::line(ink::BLUE, 2.0).dashed(&[5.0, 4.0]),
        None => Paint::line(ink::BLUE, 1.2).dashed(&[5.0, 4.0]),
    };
    let zone_paint = Paint::line(ink::GREEN, 5.0);
    let mut upright = |s: f64, paint: Paint| {
        let at = x.at(s);
        chart.picture.shapes.push(clipped(
            vec![vec![(at, track[0]), (at, track[1])]],
            false,
            paint,
        ));
    };
    let mut entries = match half_turn {
        Some(half) => {
            upright(
                if first > 0.0 {
                    first - half
                } else {
                    first + half
                },
                hint,
            );
            upright(first, line);
            vec![
                ("line of contact as the damage comes to it", line),
                ("the contact with the other raceway then", hint),
            ]
        }
        None => {
            let (from, to) = (x.at(first - radius), x.at(first + radius));
            upright(first, line);
            chart.picture.shapes.push(clipped(
                vec![vec![
                    (from, track[0]),
                    (to, track[0]),
                    (to, track[1]),
                    (from, track[1]),
                ]],
                true,
                hint,
            ));
            vec![
                ("line of contact as the roller comes on", line),
                ("the roller above it", hint),
            ]
        }
    };
    let mut zone_words = String::new();
    if let Some([from, to]) = view
        .load_zone_mm
        .filter(|z| z.iter().all(|x| x.is_finite()))
    {
        let (lo, hi) = (x.at(from).max(frame.left), x.at(to).min(frame.right));
        let base = frame.bottom - 2.5;
        if hi > lo {
            chart.picture.shapes.push(clipped(
                vec![vec![(lo, base), (hi, base)]],
                false,
                zone_paint,
            ));
            for end in [from, to].map(|s| x.at(s)) {
                if end > frame.left && end < frame.right {
                    chart.picture.shapes.push(clipped(
                        vec![vec![(end, frame.top), (end, frame.bottom)]],
                        false,
                        Paint::line(ink::GREEN, 1.4).dashed(&[2.0, 3.0]),
                    ));
                }
            }
            zone_words = if lo <= frame.left && hi >= frame.right {
                "load zone (reaches beyond the picture)".into()
            } else {
                "load zone".into()
            };
        } else {
            zone_words = "load zone: not in the picture".into();
        }
    }
    if !zone_words.is_empty() {
        entries.push((&zone_words, zone_paint));
    }
    let plan = chart.finish();
    let mut picture = Picture::new(&plan.name, &plan.title, width, 0.0);
    let mut top = heading(&mut picture, &view.plan_title, left, width, font);
    top += legend(&mut picture, &entries, left, width, top, font);
    if let Some(deepest) = deepest {
        let room = (left, width);
        top += colour_bar(&mut picture, deepest, raised(view), room, top + 2.0, font);
    }
    picture.place(plan, 0.0, top);
    picture.height = top + height;
    picture
}

/// First s, last s, lowest and highest z of what is drawn.
fn extent(view: &DamageView) -> Option<[f64; 4]> {
    if let Some(p) = &view.depths {
        let rows = p.depth_um.len().checked_div(p.columns)?;
        let end = |k: usize, n: usize| p.start_mm[k] + p.step_mm[k] * n.saturating_sub(1) as f64;
        let (first, last) = range([p.start_mm[0], end(0, p.columns)])?;
        let (low, high) = range([p.start_mm[1], end(1, rows)])?;
        return Some([first, last, low, high].map(|x| x.clamp(-1e6, 1e6)));
    }
    let along = |k: usize| range(view.polygons_mm.iter().flatten().map(|p| p[k]));
    let ((first, last), (low, high)) = (along(0)?, along(1)?);
    Some([first, last, low, high].map(|x| x.clamp(-1e6, 1e6)))
}

/// Height of the highest raised edge, um; `None` where none is.
fn raised(view: &DamageView) -> Option<f64> {
    let depths = || view.depths.iter().flat_map(|p| p.depth_um.iter().copied());
    let (highest, deepest) = range(depths())?;
    (highest < -LEAST * deepest.max(-highest)).then_some(-highest)
}

/// What a picture shows, above it, in as many lines as that takes; returns the height used.
fn heading(picture: &mut Picture, words: &str, left: f64, right: f64, font: f64) -> f64 {
    let mut top = 2.0;
    let mut line = String::new();
    let mut put = |line: &mut String, top: &mut f64| {
        let text = font::fitted(line, font, true, right - left);
        picture.text(Text::new(left, *top + font, font, Anchor::Start, &text).bold());
        *top += 1.5 * font;
        line.clear();
    };
    for word in words.split_whitespace() {
        let longer = format!("{line}{}{word}", if line.is_empty() { "" } else { " " });
        if !line.is_empty() && font::width(&longer, font, true) > right - left {
            put(&mut line, &mut top);
            line = word.to_owned();
        } else {
            line = longer;
        }
    }
    if !line.is_empty() {
        put(&mut line, &mut top);
        top += 0.4 * font;
    }
    top
}

/// Points closer together than a picture can show are left out.
fn drawn(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = vec![];
    for (x, y) in points {
        let near = |p: &(f64, f64)| (p.0 - x).abs() < 0.25 && (p.1 - y).abs() < 0.25;
        if !kept.last().is_some_and(near) {
            kept.push((x, y));
        }
    }
    kept
}

/// Polygons turned so that a hole winds against what it lies in: the inside is then the same by either fill rule.
fn wound(polygons: &[Vec<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
    let finite = polygons
        .iter()
        .filter(|p| p.len() > 2 && p.iter().flatten().all(|x| x.is_finite()));
    let all: Vec<&Vec<[f64; 2]>> = finite.collect();
    let sides = |p: &[[f64; 2]]| {
        let next: Vec<[f64; 2]> = p.iter().skip(1).chain(p.first()).copied().collect();
        p.iter().copied().zip(next).collect::<Vec<_>>()
    };
    let within = |q: [f64; 2], p: &[[f64; 2]]| {
        sides(p).iter().fold(false, |inside, (a, b)| {
            let passes = (a[1] <= q[1]) != (b[1] <= q[1])
                && q[0] < a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            inside != passes
        })
    };
    all.iter()
        .enumerate()
        .map(|(i, p)| {
            let others = all.iter().enumerate().filter(|(j, _)| *j != i);
            let hole = others.filter(|(_, other)| within(p[0], other)).count() % 2 == 1;
            let area: f64 = sides(p)
                .iter()
                .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
                .sum();
            let mut p = (*p).clone();
            if (area < 0.0) != hole {
                p.reverse();
            }
            p
        })
        .collect()
}

/// Depths as nested steps of colour, interpolated between nodes; returns them.
fn shade(
    chart: &mut Chart,
    patch: &DepthPatch,
    [first, last, low, high]: [f64; 4],
    clipped: impl Fn(Vec<Vec<(f64, f64)>>, bool, Paint) -> Shape,
) -> Vec<f64> {
    let columns = patch.columns;
    let rows = patch.depth_um.len().checked_div(columns).unwrap_or(0);
    let finite: Vec<f64> = patch
        .depth_um
        .iter()
        .map(|h| if h.is_finite() { *h } else { 0.0 })
        .collect();
    let deepest = finite.iter().copied().fold(0.0, f64::max);
    let (left, right) = (chart.x.at(first), chart.x.at(last));
    let (top, bottom) = (chart.y.at(high), chart.y.at(low));
    if columns < 2 || rows < 2 || right - left < 0.5 || bottom - top < 0.5 {
        return finite;
    }
    let across = ((right - left) / CELL).ceil().clamp(1.0, 600.0) as usize;
    let down = ((bottom - top) / CELL).ceil().clamp(1.0, 400.0) as usize;
    let (wide, high) = ((right - left) / across as f64, (bottom - top) / down as f64);
    let depth = |i: usize, j: usize| {
        let u = (i as f64 + 0.5) / across as f64 * (columns - 1) as f64;
        let v = (1.0 - (j as f64 + 0.5) / down as f64) * (rows - 1) as f64;
        let (c, r) = ((u as usize).min(columns - 2), (v as usize).min(rows - 2));
        let (u, v) = (u - c as f64, v - r as f64);
        let node = |dr: usize, dc: usize| finite[(r + dr) * columns + c + dc];
        (node(0, 0) * (1.0 - u) + node(0, 1) * u) * (1.0 - v)
            + (node(1, 0) * (1.0 - u) + node(1, 1) * u) * v
    };
    let cells: Vec<f64> = (0..down)
        .flat_map(|j| (0..across).map(move |i| (i, j)))
        .map(|(i, j)| depth(i, j))
        .collect();
    // Each shade lies over the lighter one, a little wider than its cells: no seams.
    let mut layer = |color: &'static str, shown: &dyn Fn(f64) -> bool| {
        let mut runs = vec![];
        for j in 0..down {
            let row = &cells[j * across..(j + 1) * across];
            let mut i = 0;
            while i < across {
                let from = i;
                while i < across && shown(row[i]) {
                    i += 1;
                }
                if i > from {
                    let x = |i: usize| left + wide * i as f64;
                    let (a, b) = (x(from) - 0.3, x(i) + 0.3);
                    let (c, d) = (
                        top + high * j as f64 - 0.3,
                        top + high * (j + 1) as f64 + 0.3,
                    );
                    runs.push(vec![(a, c), (b, c), (b, d), (a, d)]);
                }
                i = i.max(from + 1);
            }
        }
        if !runs.is_empty() {
            let path = clipped(runs, true, Paint::fill(color, 1.0));
            chart.picture.shapes.push(path);
        }
    };
    let least = LEAST * deepest.max(finite.iter().map(|h| h.abs()).fold(0.0, f64::max));
    layer(RAISED, &|h| h < -least);
    for (k, color) in SHADES.iter().enumerate() {
        let from = deepest * k as f64 / SHADES.len() as f64;
        layer(color, &|h| h > from.max(least));
    }
    finite
}

/// The shades with their depths; returns the height used.
fn colour_bar(
    picture: &mut Picture,
    deepest: f64,
    raised: Option<f64>,
    (left, right_end): (f64, f64),
    top: f64,
    font: f64,
) -> f64 {
    let swatch = 1.5 * font;
    let mut base = top + font;
    let text = |x: f64, base: f64, words: &str| Text::new(x, base, font, Anchor::Start, words);
    picture.text(text(left, base, "depth 0"));
    let mut x = left + font::width("depth 0", font, false) + 6.0;
    for color in SHADES {
        let (right, bottom) = (x + swatch, base + 1.0);
        let rect = Rect {
            left: x,
            top: base - 0.8 * font,
            right,
            bottom,
        };
        picture.rect(rect, Paint::fill(color, 1.0));
        x = right;
    }
    let words = format!("{} μm", significant(deepest, 3));
    picture.text(text(x + 6.0, base, &words));
    x += font::width(&words, font, false) + 30.0;
    if let Some(height) = raised {
        let words = format!("raised, up to {} μm", significant(height, 3));
        if x + swatch + 6.0 + font::width(&words, font, false) > right_end {
            x = left;
            base += 1.6 * font;
        }
        let rect = Rect {
            left: x,
            top: base - 0.8 * font,
            right: x + swatch,
            bottom: base + 1.0,
        };
        picture.rect(rect, Paint::fill(RAISED, 1.0));
        picture.text(text(x + swatch + 6.0, base, &words));
    }
    base - top + 0.9 * font
}

/// L_s, L_e, depth and stiffness over the angle of a roller that passes the damage.
pub fn damage_passage(view: &DamageView, index: usize, layout: Layout) -> Picture {
    stack(
        &format!("damage-{}-passage", index + 1),
        [&view.title, &view.passage_title],
        (
            if view.half_turn_mm.is_some() {
                "Angle on the roller from the defect’s centre"
            } else {
                "Angle from the defect’s centre"
            },
            "°",
        ),
        &view.angle_deg,
        &view.passage,
        layout,
    )
}

/// Section properties along the damage.
pub fn damage_section(view: &DamageView, index: usize, layout: Layout) -> Picture {
    stack(
        &format!("damage-{}-section", index + 1),
        [&view.title, &view.section_title],
        ("Along the damage, from its centre", "mm"),
        &view.section_s_mm,
        &view.section,
        layout,
    )
}

const LINES: [(&str, f64, &[f64]); 4] = [
    (ink::BLUE, 2.2, &[]),
    (ink::ORANGE, 2.0, &[7.0, 3.0]),
    (ink::GREEN, 1.6, &[]),
    (ink::PURPLE, 1.6, &[3.0, 3.0]),
];

/// Panels over one axis, each with its own legend where it holds several curves.
fn stack(
    name: &str,
    [title, shown]: [&str; 2],
    (x_label, x_unit): (&str, &str),
    xs: &[f64],
    panels: &[DamagePanel],
    layout: Layout,
) -> Picture {
    let size = layout.size(0.0);
    let part = if layout == Layout::Wide { 118.0 } else { 112.0 };
    let (lo, hi) = range(xs.iter().copied()).unwrap_or((-1.0, 1.0));
    let mut specs: Vec<Spec> = panels
        .iter()
        .enumerate()
        .map(|(k, panel)| {
            let last = k + 1 == panels.len();
            let values = panel.curves.iter().flat_map(|c| c.values.iter().copied());
            Spec {
                name: String::new(),
                title: String::new(),
                size: Size {
                    height: part + if last { 3.4 * size.font } else { 0.0 },
                    ..size
                },
                x: Domain::exact(lo, hi),
                y: if panel.from_zero {
                    Domain::from_zero(values)
                } else {
                    Domain::around(values)
                },
                x_label: x_label.into(),
                x_unit: x_unit.into(),
                y_label: panel.label.clone(),
                y_unit: panel.unit.clone(),
                lanes: vec![],
                left: 0.0,
                right: 0.0,
                x_axis: last,
            }
        })
        .collect();
    let left = specs.iter().map(left_margin).fold(0.0, f64::max);
    specs.iter_mut().for_each(|spec| spec.left = left);
    let mut picture = Picture::new(name, title, size.width, 0.0);
    let mut top = heading(&mut picture, shown, left, size.width, size.font);
    for (spec, panel) in specs.into_iter().zip(panels) {
        let paint = |k: usize| {
            let (color, width, dash) = LINES[k % LINES.len()];
            Paint::line(color, width).dashed(dash)
        };
        let entries: Vec<(&str, Paint)> = panel
            .curves
            .iter()
            .enumerate()
            .map(|(k, c)| (c.name.as_str(), paint(k)))
            .filter(|(name, _)| !name.is_empty())
            .collect();
        if !entries.is_empty() {
            top += legend(&mut picture, &entries, left, size.width, top, size.font);
        }
        let height = spec.size.height;
        let mut chart = Chart::new(spec);
        if range(panel.curves.iter().flat_map(|c| c.values.iter().copied())).is_none()
            || xs.is_empty()
        {
            chart.say("Not computed");
        }
        for (k, curve) in panel.curves.iter().enumerate() {
            chart.points(xs, &curve.values, paint(k));
        }
        picture.place(chart.finish(), 0.0, top);
        top += height;
    }
    picture.height = top.max(1.0);
    picture
}
