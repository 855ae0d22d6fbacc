//! A tilting bearing from the side: rings, rollers and the load along each roller, with the tilts exaggerated.

use std::fmt::Write;

use crate::encode::{list, packed};
use crate::layout::{Layout, legend};
use crate::number::{finite, round_below, significant};
use crate::picture::{Anchor, Paint, Picture, Shape, Text, ink};

/// A section along the bearing's axis, frame after frame. Lengths in mm, slopes and angles in rad, line loads in N/mm;
/// Z to the right, outwards up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxialSection {
    /// Through what, for the caption: "the damage".
    pub through: String,
    /// Of the rings.
    pub width_mm: f64,
    /// Of a roller.
    pub roller_length_mm: f64,
    /// Of a roller.
    pub roller_diameter_mm: f64,
    /// Slopes of the inner and the outer ring, a frame each.
    pub rings: Vec<[f32; 2]>,
    /// The rows.
    pub rows: Vec<AxialRow>,
    /// Line loads across a roller.
    pub strips: usize,
}

/// One row of a section: its roller nearest the section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxialRow {
    /// Z of the row's middle.
    pub middle_mm: f64,
    /// Its tilt, a frame each.
    pub tilt: Vec<f32>,
    /// Line loads at the inner raceway, `strips` a frame.
    pub inner: Vec<f32>,
    /// At the outer one.
    pub outer: Vec<f32>,
}

/// Slope at which the largest tilt is drawn.
const DRAWN: f64 = 0.12;
/// Height of the largest line load, px.
const LOAD: f64 = 64.0;
/// A ring's wall, in roller diameters.
const WALL: f64 = 0.35;

impl AxialSection {
    /// Frames that every list holds.
    pub(crate) fn frames(&self) -> usize {
        let sizes = [self.width_mm, self.roller_length_mm, self.roller_diameter_mm];
        let sound = |mm: f64| mm.is_finite() && mm > 0.0 && mm < 1e6;
        let middles = self.rows.iter().all(|row| row.middle_mm.abs() < 1e6);
        if self.strips == 0 || !middles || !sizes.into_iter().all(sound) {
            return 0;
        }
        let of = |row: &AxialRow| {
            let strips = self.strips.max(1);
            let loads = row.inner.len().min(row.outer.len()) / strips;
            row.tilt.len().min(loads)
        };
        let rows = self.rows.iter().map(of);
        rows.fold(self.rings.len(), usize::min)
    }

    /// Largest line load.
    fn heaviest(&self) -> f64 {
        let loads = self.rows.iter().flat_map(|r| r.inner.iter().chain(&r.outer));
        loads.fold(0.0, |m, q| m.max(finite(*q)))
    }

    /// Largest slopes of rings and of rollers that carry.
    fn steepest(&self) -> [f64; 2] {
        let rings = self.rings.iter().flatten();
        let rings = rings.fold(0.0_f64, |m, s| m.max(finite(*s).abs()));
        let mut rollers = 0.0_f64;
        for row in &self.rows {
            for (frame, tilt) in row.tilt.iter().enumerate() {
                if self.carries(row, frame) {
                    rollers = rollers.max(finite(*tilt).abs());
                }
            }
        }
        [rings, rollers]
    }

    fn carries(&self, row: &AxialRow, frame: usize) -> bool {
        row.inner[frame * self.strips..(frame + 1) * self.strips].iter().any(|q| *q > 0.0)
    }

    /// The frame in which a loaded roller tilts most: for a picture that does not move.
    pub(crate) fn telling_frame(&self) -> usize {
        let most = |frame: usize| {
            let tilts = self.rows.iter().filter(|row| self.carries(row, frame));
            tilts.fold(0.0_f64, |m, row| m.max(finite(row.tilt[frame]).abs()))
        };
        (0..self.frames()).max_by(|a, b| most(*a).total_cmp(&most(*b))).unwrap_or(0)
    }

    /// How many times as large tilts are drawn: 1, 2 or 5 times a power of ten.
    fn exaggeration(&self) -> f64 {
        let [rings, rollers] = self.steepest();
        let largest = rings.max(rollers);
        if largest <= 0.0 {
            return 1.0;
        }
        round_below(DRAWN / largest)
    }

    /// The words under the picture.
    pub(crate) fn caption(&self) -> String {
        let [rings, rollers] = self.steepest();
        format!(
            "A section along the axis through {}; of each row the roller nearest to it. Tilts are drawn {} times as large as they are: \
             the rings tilt by up to {} mrad, loaded rollers by up to {} mrad. Shaded: the load along the roller at each raceway, up to {} N/mm.",
            self.through,
            self.exaggeration(),
            significant(1e3 * rings, 3),
            significant(1e3 * rollers, 3),
            significant(self.heaviest(), 3)
        )
    }
}

/// Where things are drawn.
struct Place {
    x: f64,
    y: f64,
    /// px per mm.
    scale: f64,
    /// Of slopes.
    factor: f64,
    /// px per N/mm.
    load: f64,
}

impl Place {
    fn at(&self, z: f64, out: f64, slope: f32) -> (f64, f64) {
        let slope = (self.factor * finite(slope)).clamp(-0.5, 0.5);
        (self.x + self.scale * z, self.y - self.scale * (out + slope * z))
    }
}

/// The section at one of the instants.
pub fn axial_section(section: &AxialSection, frame: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let font = size.font;
    let mut picture = Picture::new("tilt", "Tilts and loads along the rollers", size.width, 0.0);
    let [inner_paint, outer_paint] =
        [ink::BLUE, ink::VERMILLION].map(|colour| Paint::line(colour, 1.4).filled(colour, 0.35));
    let shown = [("load at the outer raceway", outer_paint), ("load at the inner raceway", inner_paint)];
    let top = legend(&mut picture, &shown, 12.0, size.width - 12.0, 2.0, font);
    let frames = section.frames();
    if frames == 0 {
        picture.height = top + 3.0 * font;
        return picture;
    }
    let frame = frame.min(frames - 1);
    let (half, diameter) = (0.5 * section.width_mm, section.roller_diameter_mm);
    let tall = diameter * (1.0 + 2.0 * WALL);
    let scale = (0.86 * size.width / section.width_mm).min(260.0 / tall);
    let heaviest = section.heaviest();
    let place = Place {
        x: 0.5 * size.width,
        y: top + LOAD + 0.5 * scale * (tall + 2.0 * DRAWN * half),
        scale,
        factor: section.exaggeration(),
        load: if heaviest > 0.0 { LOAD / heaviest } else { 0.0 },
    };
    let drawing = Drawing { section, frame, place: &place };
    drawing.rings(&mut picture.shapes);
    for row in &section.rows {
        drawing.row(row, [inner_paint, outer_paint], &mut picture.shapes);
    }
    let bottom = place.y + 0.5 * scale * (tall + 2.0 * DRAWN * half) + LOAD;
    for (index, row) in section.rows.iter().enumerate() {
        let x = place.x + scale * row.middle_mm;
        let words = format!("Row {}", index + 1);
        picture.text(Text::new(x, bottom + font, font, Anchor::Middle, &words).bold());
    }
    picture.height = bottom + 2.0 * font;
    picture.attributes = format!(
        " data-section=\"{:.3} {:.3} {:.5} {:.3} {:.6}\"",
        place.x, place.y, place.scale, place.factor, place.load
    );
    picture
}

/// The frames, for the page's script: slopes as 32767ths of the steepest, loads as 65535ths of the heaviest.
pub(crate) fn data(page: &mut String, section: &AxialSection, frames: usize) {
    let slopes = section.rings.iter().flatten();
    let slopes = slopes.chain(section.rows.iter().flat_map(|row| &row.tilt));
    let steepest = slopes.fold(1e-12_f64, |m, s| m.max(finite(*s).abs()));
    let heaviest = section.heaviest().max(1e-12);
    let slope = |s: &f32| ((finite(*s) / steepest * 32767.0).round() as i16) as u16;
    let load = |q: &f32| ((finite(*q) / heaviest).clamp(0.0, 1.0) * 65535.0).round() as u16;
    let row = |row: &AxialRow| {
        let loads = frames * section.strips;
        let outer_and_inner = row.outer[..loads].iter().chain(&row.inner[..loads]);
        let numbers = row.tilt[..frames].iter().map(slope).chain(outer_and_inner.map(load));
        format!("{{\"middle\":{},\"values\":\"{}\"}}", row.middle_mm, packed(numbers))
    };
    let _ = write!(
        page,
        ",\"section\":{{\"half\":{},\"length\":{},\"raceway\":{},\"wall\":{WALL},\"strips\":{},\"steepest\":{steepest:e},\"heaviest\":{heaviest:e},\"rings\":\"{}\",\"rows\":{}}}",
        0.5 * section.width_mm,
        section.roller_length_mm,
        0.5 * section.roller_diameter_mm,
        section.strips,
        packed(section.rings[..frames].iter().flatten().map(slope)),
        list(section.rows.iter().map(row)),
    );
}

fn closed(line: Vec<(f64, f64)>, paint: Paint) -> Shape {
    Shape::Path { lines: vec![line], close: true, paint, clip: None }
}

/// One instant of a section as it is drawn.
struct Drawing<'a> {
    section: &'a AxialSection,
    frame: usize,
    place: &'a Place,
}

impl Drawing<'_> {
    fn rings(&self, shapes: &mut Vec<Shape>) {
        let (section, place) = (self.section, self.place);
        let steel = Paint::line(ink::FRAME, 1.0).filled("#eef1f4", 1.0);
        let [inner_slope, outer_slope] = section.rings[self.frame];
        let (half, diameter) = (0.5 * section.width_mm, section.roller_diameter_mm);
        let raceway = 0.5 * diameter;
        let ring = |slope: f32, from: f64, to: f64| {
            vec![
                place.at(-half, from, slope),
                place.at(half, from, slope),
                place.at(half, to, slope),
                place.at(-half, to, slope),
            ]
        };
        let wall = raceway + WALL * diameter;
        for (name, slope, sign) in [("t-outer", outer_slope, 1.0), ("t-inner", inner_slope, -1.0)] {
            shapes.push(Shape::Open(name));
            shapes.push(closed(ring(slope, sign * raceway, sign * wall), steel));
            shapes.push(Shape::Close);
        }
    }

    /// A roller with the loads along it, in the paints of inner and outer.
    fn row(&self, row: &AxialRow, [inner, outer]: [Paint; 2], shapes: &mut Vec<Shape>) {
        let (section, place, frame) = (self.section, self.place, self.frame);
        let [inner_slope, outer_slope] = section.rings[frame];
        let raceway = 0.5 * section.roller_diameter_mm;
        let length = 0.5 * section.roller_length_mm;
        let tilt = row.tilt[frame];
        let corner = |z: f64, out: f64| {
            let (x, y) = place.at(z, out, tilt);
            (x + place.scale * row.middle_mm, y)
        };
        let body = vec![
            corner(-length, raceway),
            corner(length, raceway),
            corner(length, -raceway),
            corner(-length, -raceway),
        ];
        let load = |loads: &[f32], slope: f32, sign: f64| {
            let loads = &loads[frame * section.strips..(frame + 1) * section.strips];
            let step = section.roller_length_mm / section.strips as f64;
            let base = |z: f64| place.at(row.middle_mm + z, sign * raceway, slope);
            let mut line = vec![base(-length)];
            for (k, q) in loads.iter().enumerate() {
                let (x, y) = base(-length + (k as f64 + 0.5) * step);
                line.push((x, y - sign * place.load * finite(*q)));
            }
            line.push(base(length));
            line
        };
        shapes.push(Shape::Open("t-row"));
        shapes.push(closed(body, Paint::line(ink::TEXT, 1.0).filled("#ffffff", 1.0)));
        shapes.push(closed(load(&row.outer, outer_slope, 1.0), outer));
        shapes.push(closed(load(&row.inner, inner_slope, -1.0), inner));
        shapes.push(Shape::Close);
    }
}
