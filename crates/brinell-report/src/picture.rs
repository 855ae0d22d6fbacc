//! A picture as a list of shapes, written as SVG or drawn as PNG.

use std::fmt::Write as _;

mod curve;
pub(crate) mod pdf;
mod pixels;

use crate::font;
use crate::markup::{coordinate, escape};
use crate::raster;

pub(crate) use crate::shape::{Anchor, Paint, Rect, Shape, Text, ink};
use crate::shape::{run_drop, run_size};
pub use curve::CurveTable;
pub(crate) use curve::{Axis, Curve};

/// Of CSS: what a length without unit means.
const CSS_PX_PER_INCH: f64 = 96.0;

/// Why a picture could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The pixels do not fit: zero, or too many.
    #[error("a picture of {width} x {height} pixels cannot be drawn (1 to 16384 each way)")]
    Size {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The PNG encoder failed.
    #[error("the PNG could not be written: {0}")]
    Png(String),
}

/// A plot, ready to be written as SVG or PNG.
#[derive(Clone, Debug)]
pub struct Picture {
    /// A name fit for a file: "envelope-spectrum".
    pub name: String,
    /// What it shows, in words.
    pub title: String,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) shapes: Vec<Shape>,
    /// Width on paper, where it is drawn for that.
    pub(crate) print_mm: Option<f64>,
    /// What its curves are drawn from.
    pub(crate) curves: Vec<Curve>,
    /// Attributes for the page's script.
    pub(crate) attributes: String,
}

impl Picture {
    pub(crate) fn new(name: &str, title: &str, width: f64, height: f64) -> Self {
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            width,
            height,
            shapes: vec![],
            print_mm: None,
            curves: vec![],
            attributes: String::new(),
        }
    }

    /// Width and height in CSS pixels.
    pub fn size(&self) -> (f64, f64) {
        (self.width, self.height)
    }

    /// Lengths on paper to those of the drawing, mm per px.
    fn mm_per_px(&self) -> f64 {
        self.print_mm.map_or(25.4 / CSS_PX_PER_INCH, |mm| mm / self.width)
    }

    /// The curves as tables, those over the same values of x together.
    pub fn tables(&self) -> Vec<CurveTable> {
        curve::tables(&self.name, &self.curves)
    }

    pub(crate) fn path(&mut self, points: &[(f64, f64)], paint: Paint) {
        self.shapes.push(Shape::Path { lines: vec![points.to_vec()], close: false, paint, clip: None });
    }

    pub(crate) fn rect(&mut self, rect: Rect, paint: Paint) {
        let Rect { left, top, right, bottom } = rect;
        let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom)];
        self.shapes.push(Shape::Path { lines: vec![corners], close: true, paint, clip: None });
    }

    pub(crate) fn text(&mut self, text: Text) {
        self.shapes.push(Shape::Text(text));
    }

    /// Lays `other` over this picture, its corner at (dx, dy).
    pub(crate) fn place(&mut self, other: Picture, dx: f64, dy: f64) {
        self.curves.extend(other.curves);
        for mut shape in other.shapes {
            match &mut shape {
                Shape::Path { lines, clip, .. } => {
                    for point in lines.iter_mut().flatten() {
                        *point = (point.0 + dx, point.1 + dy);
                    }
                    if let Some(clip) = clip {
                        clip.left += dx;
                        clip.right += dx;
                        clip.top += dy;
                        clip.bottom += dy;
                    }
                }
                Shape::Circle { x, y, .. } => {
                    *x += dx;
                    *y += dy;
                }
                Shape::Text(text) => {
                    text.x += dx;
                    text.y += dy;
                }
                Shape::Image { place, .. } => {
                    place.left += dx;
                    place.right += dx;
                    place.top += dy;
                    place.bottom += dy;
                }
                Shape::Open(_) | Shape::Figure(_) | Shape::Close => {}
            }
            self.shapes.push(shape);
        }
    }

    /// A stand-alone SVG file; one for print has its size in mm and holds its typeface.
    pub fn svg(&self) -> String {
        let (width, height) = (coordinate(self.width), coordinate(self.height));
        let mut svg = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\"");
        let _ = match self.print_mm {
            Some(mm) => {
                let tall = self.height * self.mm_per_px();
                write!(svg, " width=\"{mm}mm\" height=\"{tall:.3}mm\"")
            }
            None => write!(svg, " width=\"{width}\" height=\"{height}\""),
        };
        let _ = writeln!(
            svg,
            " viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"{}\"><title>{}</title>",
            font::FAMILY,
            escape(&self.title)
        );
        if self.print_mm.is_some() {
            svg.push_str("<style>\n");
            for bold in [false, true].into_iter().filter(|bold| self.has_text(*bold)) {
                svg.push_str(&font::css(bold));
            }
            svg.push_str("</style>\n");
        }
        svg.push_str("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
        self.body(&mut svg, &self.name);
        svg.push_str("</svg>\n");
        svg
    }

    /// Whether there are words of a weight.
    fn has_text(&self, bold: bool) -> bool {
        let of = |shape: &Shape| matches!(shape, Shape::Text(text) if text.bold == bold);
        self.shapes.iter().any(of)
    }

    /// The same inside a page: no background, no namespace, ids that start with `id`.
    pub(crate) fn inline(&self, id: &str, class: &str) -> String {
        let mut svg = format!(
            "<svg class=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" data-name=\"{}\"{}>",
            class,
            coordinate(self.width),
            coordinate(self.height),
            escape(&self.title),
            escape(&self.name),
            self.attributes
        );
        self.body(&mut svg, id);
        svg.push_str("</svg>\n");
        svg
    }

    /// The same as a sheet of text, which is read letter by letter, and not as one picture.
    pub(crate) fn sheet(&self, id: &str, class: &str) -> String {
        let (width, height) = (coordinate(self.width), coordinate(self.height));
        let mut svg = format!("<svg class=\"{class}\" viewBox=\"0 0 {width} {height}\">\n");
        self.body(&mut svg, id);
        svg.push_str("</svg>\n");
        svg
    }

    fn body(&self, svg: &mut String, id: &str) {
        let mut clips: Vec<Rect> = vec![];
        for shape in &self.shapes {
            if let Shape::Path { clip: Some(clip), .. } = shape
                && !clips.contains(clip)
            {
                let _ = write!(
                    svg,
                    "<clipPath id=\"{}-clip{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
                    escape(id),
                    clips.len(),
                    coordinate(clip.left),
                    coordinate(clip.top),
                    coordinate(clip.width()),
                    coordinate(clip.height())
                );
                clips.push(*clip);
            }
        }
        for shape in &self.shapes {
            match shape {
                Shape::Path { lines, close, paint, clip } => {
                    svg.push_str("<path d=\"");
                    for line in lines {
                        write_line(svg, line, *close);
                    }
                    svg.push('"');
                    write_paint(svg, paint);
                    if let Some(at) = clip.and_then(|clip| clips.iter().position(|c| *c == clip)) {
                        let _ = write!(svg, " clip-path=\"url(#{}-clip{at})\"", escape(id));
                    }
                    svg.push_str("/>\n");
                }
                Shape::Circle { x, y, r, paint } => {
                    let _ = write!(
                        svg,
                        "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"",
                        coordinate(*x),
                        coordinate(*y),
                        coordinate(*r)
                    );
                    write_paint(svg, paint);
                    svg.push_str("/>\n");
                }
                Shape::Text(text) => write_text(svg, text),
                Shape::Image { place, columns, pixels } => raster::write(svg, *place, *columns, pixels),
                Shape::Open(class) => {
                    let _ = write!(svg, "<g class=\"{class}\">");
                }
                Shape::Figure(words) => {
                    let _ = write!(svg, "<g role=\"img\" aria-label=\"{}\">", escape(words));
                }
                Shape::Close => svg.push_str("</g>"),
            }
        }
    }
}

fn write_line(svg: &mut String, line: &[(f64, f64)], close: bool) {
    for (index, (x, y)) in line.iter().enumerate() {
        svg.push(if index == 0 { 'M' } else { 'L' });
        svg.push_str(&coordinate(*x));
        svg.push(' ');
        svg.push_str(&coordinate(*y));
    }
    if close && !line.is_empty() {
        svg.push('Z');
    }
}

fn write_paint(svg: &mut String, paint: &Paint) {
    match paint.fill {
        Some((color, opacity)) if opacity < 1.0 => {
            let _ = write!(svg, " fill=\"{color}\" fill-opacity=\"{opacity}\"");
        }
        Some((color, _)) => {
            let _ = write!(svg, " fill=\"{color}\"");
        }
        None => svg.push_str(" fill=\"none\""),
    }
    if paint.width > 0.0 {
        let _ = write!(svg, " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", paint.stroke, paint.width);
        if !paint.dash.is_empty() {
            let dash: Vec<String> = paint.dash.iter().map(f64::to_string).collect();
            let _ = write!(svg, " stroke-dasharray=\"{}\"", dash.join(" "));
        }
    }
    if paint.opacity < 1.0 {
        let _ = write!(svg, " opacity=\"{}\"", paint.opacity);
    }
}

fn write_text(svg: &mut String, text: &Text) {
    let (x, y) = (coordinate(text.x), coordinate(text.y));
    svg.push_str("<text");
    if text.upright {
        let _ = write!(svg, " transform=\"translate({x} {y}) rotate(-90)\"");
    } else {
        let _ = write!(svg, " x=\"{x}\" y=\"{y}\"");
    }
    let _ = write!(svg, " font-size=\"{}\" fill=\"{}\"", text.size, text.color);
    match text.anchor {
        Anchor::Start => {}
        Anchor::Middle => svg.push_str(" text-anchor=\"middle\""),
        Anchor::End => svg.push_str(" text-anchor=\"end\""),
    }
    if text.bold {
        svg.push_str(" font-weight=\"600\"");
    }
    if text.runs.iter().any(|run| !font::has(&run.text, text.bold)) {
        // What another typeface writes takes the room that was laid out for it.
        let _ = write!(svg, " textLength=\"{:.1}\" lengthAdjust=\"spacingAndGlyphs\"", text.width());
    }
    svg.push('>');
    let mut below = 0.0;
    for run in &text.runs {
        // Firefox knows no baseline-shift: move the baseline and move it back.
        let drop = run_drop(text.size, run);
        let words = escape(&run.text);
        if drop == 0.0 && below == 0.0 {
            svg.push_str(&words);
        } else {
            let (dy, size) = (drop - below, run_size(text.size, run));
            let _ = write!(svg, "<tspan dy=\"{dy:.1}\" font-size=\"{size:.1}\">{words}</tspan>");
        }
        below = drop;
    }
    svg.push_str("</text>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_markup_is_escaped() {
        assert_eq!(escape("<a href=\"x\">&'\u{1}"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;\u{fffd}");
        let mut picture = Picture::new("p", "a < b", 10.0, 10.0);
        picture.text(Text::with_unit(0.0, 0.0, 10.0, Anchor::Start, "N/m^(10/9) <b>"));
        let svg = picture.svg();
        assert!(svg.contains("<title>a &lt; b</title>") && svg.contains("&lt;b&gt;") && svg.contains("dy=\"-3.2\""));
    }

    #[test]
    fn regress_coordinates_are_short_and_finite() {
        for (value, text) in [(1.0, "1"), (-0.04, "0"), (-0.26, "-0.3"), (12.35, "12.4"), (-7.5, "-7.5")] {
            assert_eq!(coordinate(value), text);
        }
        assert_eq!(coordinate(f64::NAN), "0");
        assert_eq!(coordinate(1e300), "100000");
    }

    #[test]
    fn regress_impossible_sizes_are_errors() {
        assert!(Picture::new("p", "", 0.0, 10.0).png(1.0).is_err());
        assert!(Picture::new("p", "", 10.0, 10.0).png(1e9).is_err());
        assert!(Picture::new("p", "", 10.0, 10.0).png(f64::NAN).is_err());
        assert!(Picture::new("p", "", 10.0, 10.0).png(1.0).is_ok_and(|png| png.starts_with(b"\x89PNG")));
    }
}
