//! Damage from above: the raceway unrolled, or a roller's surface once around.

use super::shades::{LEAST, SHADES, colour_bar, shade};
use super::{DamageView, heading};
use crate::chart::{Chart, Domain, Size, Spec, left_margin, range, right_margin};
use crate::layout::{Layout, legend};
use crate::picture::{Paint, Picture, Shape, ink};
use brinell::derived::Passing;

/// Where the roller touches.
const TRACK: &str = "#eef2f6";
/// Largest picture of a raceway, px.
const TALLEST: f64 = 440.0;

/// The surface unrolled, s to the right and z upwards to one scale: damage, the track of the roller, the roller at
/// defect entry, and the load zone. Of a roller the whole circumference, with both lines of contact.
pub fn damage_plan(view: &DamageView, index: usize, layout: Layout) -> Picture {
    let Size { width, font, .. } = layout.size(0.0);
    let mut plan = Plan::new(view, index, layout);
    plan.draw_track();
    let deepest = plan.draw_damage();
    plan.draw_against();
    plan.draw_rims();
    let words = contact_words(view);
    let paints = plan.draw_rollers();
    let mut entries: Vec<(&str, Paint)> = words.iter().map(String::as_str).zip(paints).collect();
    if !view.against_mm.is_empty() {
        entries.push((&view.against, against()));
    }
    if let Some(words) = plan.draw_load_zone() {
        entries.push((words, Paint::line(ink::GREEN, 5.0)));
    }
    let left = plan.left;
    let height = plan.height;
    let plan = plan.chart.finish();
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

/// Another shape, to hold the damage against.
fn against() -> Paint {
    Paint::line(ink::VERMILLION, 1.8).dashed(&[6.0, 3.0])
}

/// The plan as it is drawn.
struct Plan<'a> {
    view: &'a DamageView,
    chart: Chart,
    /// First s, last s, lowest and highest z, mm.
    extent: [f64; 4],
    /// Of the roller, mm.
    radius: f64,
    /// Of a roller that is damaged, mm.
    half_turn: Option<f64>,
    /// Upper and lower edge of the track, px.
    track: [f64; 2],
    /// Its ends, px.
    ends: [f64; 2],
    left: f64,
    height: f64,
}

impl<'a> Plan<'a> {
    fn new(view: &'a DamageView, index: usize, layout: Layout) -> Self {
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
        // From the room between the margins follows the scale, from the scale the height.
        let spec = |height: f64, left: f64, half: f64| Spec {
            left,
            ..Spec::new(
                format!("damage-{}", index + 1),
                match view.plan_title.is_empty() {
                    true => view.title.clone(),
                    false => view.plan_title.clone(),
                },
                Size { width, height, font },
                (Domain::exact(middle - half, middle + half), &along(view, half_turn.is_some()), "mm"),
                (Domain::exact(-0.5 * tall, 0.5 * tall), "Axial", "mm"),
            )
        };
        let around = 8.0 + 3.4 * font;
        let draft = spec(TALLEST + around, 0.0, wanted);
        let left = left_margin(&draft).max(4.8 * font);
        let room = width - left - right_margin(&draft);
        let scale = (room / wanted).min(TALLEST / tall);
        let height = (scale * tall).max(30.0) + around;
        let chart = Chart::new(spec(height, left, 0.5 * room / scale));
        let track = [0.5 * length, -0.5 * length].map(|z| chart.y.at(z));
        let ends = match half_turn {
            Some(half) => [chart.x.at(-half), chart.x.at(half)],
            None => [chart.frame.left, chart.frame.right],
        };
        Self { view, chart, extent, radius, half_turn, track, ends, left, height }
    }

    fn clipped(&self, lines: Vec<Vec<(f64, f64)>>, close: bool, paint: Paint) -> Shape {
        Shape::Path { lines, close, paint, clip: Some(self.chart.frame) }
    }

    fn draw(&mut self, lines: Vec<Vec<(f64, f64)>>, close: bool, paint: Paint) {
        let shape = self.clipped(lines, close, paint);
        self.chart.picture.shapes.push(shape);
    }

    /// The track between two x, px.
    fn band(&self, [from, to]: [f64; 2]) -> Vec<Vec<(f64, f64)>> {
        let [upper, lower] = self.track;
        vec![vec![(from, upper), (to, upper), (to, lower), (from, lower)]]
    }

    fn draw_track(&mut self) {
        let track = self.clipped(self.band(self.ends), true, Paint::fill(TRACK, 1.0));
        // Under the grid, so that it stays visible.
        self.chart.picture.shapes.insert(0, track);
    }

    /// Depths or outlines; the deepest depth, um, where there are depths.
    fn draw_damage(&mut self) -> Option<f64> {
        if let Some(patch) = &self.view.depths {
            let clip = Some(self.chart.frame);
            let clipped = |lines, close, paint| Shape::Path { lines, close, paint, clip };
            let depths = shade(&mut self.chart, patch, self.extent, clipped);
            return Some(depths.into_iter().fold(0.0, f64::max));
        }
        for (k, outline) in self.view.polygons_mm.iter().enumerate() {
            let (s, z) = outline.iter().map(|[s, z]| (*s, *z)).unzip();
            self.chart.keep(&format!("outline {}", k + 1), s, z);
        }
        let (x, y) = (&self.chart.x, &self.chart.y);
        let lines: Vec<Vec<(f64, f64)>> =
            wound(&self.view.polygons_mm).iter().map(|p| drawn(p.iter().map(|q| (x.at(q[0]), y.at(q[1]))))).collect();
        if lines.is_empty() {
            self.chart.say("No damage");
        } else {
            let paint = Paint::line(SHADES[6], 1.4).filled(SHADES[2], 1.0);
            self.draw(lines, true, paint);
        }
        None
    }

    fn draw_against(&mut self) {
        if self.view.against_mm.is_empty() {
            return;
        }
        let (x, y) = (&self.chart.x, &self.chart.y);
        let finite = |q: &&[f64; 2]| q.iter().all(|v| v.is_finite());
        let known = self.view.against_mm.iter().filter(finite);
        let line = drawn(known.map(|q| (x.at(q[0]), y.at(q[1]))));
        self.draw(vec![line], true, against());
    }

    fn draw_rims(&mut self) {
        let (ends, track) = (self.ends, self.track);
        let rim = Paint::line(ink::FRAME, 1.0);
        for z in track {
            self.draw(vec![vec![(ends[0], z), (ends[1], z)]], false, rim);
        }
        if self.half_turn.is_some() {
            let upright = |end: f64| vec![(end, track[0]), (end, track[1])];
            self.draw(ends.map(upright).to_vec(), false, rim);
        }
    }

    /// Lines of contact as the damage and a roller meet; paints of the legend.
    fn draw_rollers(&mut self) -> [Paint; 2] {
        let first = self.extent[entered_at_its_last(self.view) as usize];
        let line = Paint::line(ink::BLUE, 2.4);
        let Some(half) = self.half_turn else {
            let hint = Paint::line(ink::BLUE, 1.2).dashed(&[5.0, 4.0]);
            let above = [first - self.radius, first + self.radius].map(|s| self.chart.x.at(s));
            self.draw_line_of_contact(first, line);
            self.draw(self.band(above), true, hint);
            return [line, hint];
        };
        let hint = Paint::line(ink::BLUE, 2.0).dashed(&[5.0, 4.0]);
        let other = match first > 0.0 {
            true => first - half,
            false => first + half,
        };
        self.draw_line_of_contact(other, hint);
        self.draw_line_of_contact(first, line);
        [line, hint]
    }

    fn draw_line_of_contact(&mut self, s: f64, paint: Paint) {
        let (at, track) = (self.chart.x.at(s), self.track);
        self.draw(vec![vec![(at, track[0]), (at, track[1])]], false, paint);
    }

    /// Words of the legend, where the load zone is known.
    fn draw_load_zone(&mut self) -> Option<&'static str> {
        let finite = |z: &[f64; 2]| z.iter().all(|x| x.is_finite());
        let zone = self.view.load_zone_mm.filter(finite)?;
        let frame = self.chart.frame;
        let [from, to] = zone.map(|s| self.chart.x.at(s));
        let (lo, hi) = (from.max(frame.left), to.min(frame.right));
        if hi <= lo {
            return Some("load zone: not in the picture");
        }
        let base = frame.bottom - 2.5;
        let zone = Paint::line(ink::GREEN, 5.0);
        self.draw(vec![vec![(lo, base), (hi, base)]], false, zone);
        for end in [from, to] {
            if end > frame.left && end < frame.right {
                let upright = vec![(end, frame.top), (end, frame.bottom)];
                let paint = Paint::line(ink::GREEN, 1.4).dashed(&[2.0, 3.0]);
                self.draw(vec![upright], false, paint);
            }
        }
        match lo <= frame.left && hi >= frame.right {
            true => Some("load zone (reaches beyond the picture)"),
            false => Some("load zone"),
        }
    }
}

/// Words for the two lines of [`Plan::draw_rollers`].
fn contact_words(view: &DamageView) -> [String; 2] {
    let around = view.half_turn_mm.is_some_and(|half| half.is_finite() && half > 0.0);
    let (who, other) = match around {
        true => ("contacts pass".to_owned(), "the contact with the other raceway then".to_owned()),
        false => (format!("{}s pass", view.element()), format!("{} outline", view.element())),
    };
    let entry = "line of contact at defect entry";
    let side = |plus: bool| if plus { "right" } else { "left" };
    let line = match view.passing {
        Passing::Never => "line of contact at one end of the damage; the shaft stands still".to_owned(),
        Passing::TowardsPlus => format!("{entry}; {who} to the right"),
        Passing::TowardsMinus => format!("{entry}; {who} to the left"),
        Passing::Both { plus_at_positive } => format!(
            "{entry} at positive speed; {who} to the {} then, to the {} at negative speed",
            side(plus_at_positive),
            side(!plus_at_positive)
        ),
    };
    [line, other]
}

/// Whether a roller comes onto the damage at its last s; where the sign of the speed changes, at positive speed.
fn entered_at_its_last(view: &DamageView) -> bool {
    matches!(view.passing, Passing::TowardsMinus | Passing::Both { plus_at_positive: false })
}

fn along(view: &DamageView, around_a_roller: bool) -> String {
    if around_a_roller {
        format!("Around the {}, s counter-clockwise", view.element())
    } else if view.surface.is_empty() {
        "Along the raceway, s counter-clockwise".to_owned()
    } else {
        format!("Along the {}, s counter-clockwise", view.surface)
    }
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
    let finite = polygons.iter().filter(|p| p.len() > 2 && p.iter().flatten().all(|x| x.is_finite()));
    let all: Vec<&Vec<[f64; 2]>> = finite.collect();
    let sides = |p: &[[f64; 2]]| {
        let next: Vec<[f64; 2]> = p.iter().skip(1).chain(p.first()).copied().collect();
        p.iter().copied().zip(next).collect::<Vec<_>>()
    };
    let within = |q: [f64; 2], p: &[[f64; 2]]| {
        sides(p).iter().fold(false, |inside, (a, b)| {
            let passes =
                (a[1] <= q[1]) != (b[1] <= q[1]) && q[0] < a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            inside != passes
        })
    };
    all.iter()
        .enumerate()
        .map(|(i, p)| {
            let others = all.iter().enumerate().filter(|(j, _)| *j != i);
            let hole = others.filter(|(_, other)| within(p[0], other)).count() % 2 == 1;
            let area: f64 = sides(p).iter().map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum();
            let mut p = (*p).clone();
            if (area < 0.0) != hole {
                p.reverse();
            }
            p
        })
        .collect()
}
