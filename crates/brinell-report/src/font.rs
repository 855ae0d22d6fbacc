//! The typeface that pictures are measured with and, in PNG and PDF, drawn with. See `font/README.md`.

use std::sync::LazyLock;

use crate::encode::base64;
use tiny_skia::PathBuilder;
use ttf_parser::{Face, GlyphId, OutlineBuilder, Tag};

const REGULAR: &[u8] = include_bytes!("../font/Inter-Regular-subset.otf");
const SEMI_BOLD: &[u8] = include_bytes!("../font/Inter-SemiBold-subset.otf");

/// What an SVG asks for: the embedded face on the page, something close elsewhere.
pub(crate) const FAMILY: &str = "Inter, 'Helvetica Neue', Arial, sans-serif";

static FACES: LazyLock<[Option<Face<'static>>; 2]> =
    LazyLock::new(|| [Face::parse(REGULAR, 0).ok(), Face::parse(SEMI_BOLD, 0).ok()]);

fn face(bold: bool) -> Option<&'static Face<'static>> {
    FACES[usize::from(bold)].as_ref()
}

/// What is drawn in place of a letter that the face lacks; it has no U+FFFD.
const UNKNOWN: char = '?';

fn glyph(face: &Face<'_>, c: char) -> GlyphId {
    face.glyph_index(c).or_else(|| face.glyph_index(UNKNOWN)).unwrap_or(GlyphId(0))
}

/// Whether the face has all letters of `text`.
pub(crate) fn has(text: &str, bold: bool) -> bool {
    face(bold).is_some_and(|face| text.chars().all(|c| face.glyph_index(c).is_some()))
}

/// The style rule with which a page or a picture brings its typeface along.
pub(crate) fn css(bold: bool) -> String {
    let (weight, file) = if bold { (600, SEMI_BOLD) } else { (400, REGULAR) };
    format!(
        "@font-face {{ font-family: Inter; font-weight: {weight}; src: url(data:font/otf;base64,{}) format(\"opentype\"); }}\n",
        base64(file)
    )
}

/// One character as a face has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glyph {
    /// Its number in the face.
    pub(crate) id: u16,
    pub(crate) character: char,
    /// From here to the next, thousandths of the size.
    pub(crate) advance: f64,
}

/// The glyphs of `text`, one a character.
pub(crate) fn glyphs(text: &str, bold: bool) -> impl Iterator<Item = Glyph> {
    face(bold).into_iter().flat_map(move |face| {
        text.chars().map(move |c| {
            let id = glyph(face, c);
            let character = if face.glyph_index(c).is_some() { c } else { UNKNOWN };
            let units = f64::from(face.glyph_hor_advance(id).unwrap_or(0));
            Glyph { id: id.0, character, advance: 1000.0 * units / f64::from(face.units_per_em()) }
        })
    })
}

/// A face as a file of another format holds it; lengths in thousandths of the size.
pub(crate) struct Program {
    pub(crate) name: &'static str,
    /// Its outlines: the table `CFF` of OpenType.
    pub(crate) cff: &'static [u8],
    pub(crate) bounds: [f64; 4],
    pub(crate) ascent: f64,
    pub(crate) descent: f64,
    pub(crate) cap_height: f64,
}

pub(crate) fn program(bold: bool) -> Option<Program> {
    let face = face(bold)?;
    let length = |units: i16| 1000.0 * f64::from(units) / f64::from(face.units_per_em());
    let around = face.global_bounding_box();
    Some(Program {
        name: if bold { "Inter-SemiBold" } else { "Inter-Regular" },
        cff: face.raw_face().table(Tag::from_bytes(b"CFF "))?,
        bounds: [around.x_min, around.y_min, around.x_max, around.y_max].map(length),
        ascent: length(face.ascender()),
        descent: length(face.descender()),
        cap_height: length(face.capital_height().unwrap_or(face.ascender())),
    })
}

/// Width of `text` at `size`.
pub(crate) fn width(text: &str, size: f64, bold: bool) -> f64 {
    let Some(face) = face(bold) else {
        return 0.6 * size * text.chars().count() as f64;
    };
    let units: f64 = text.chars().map(|c| f64::from(face.glyph_hor_advance(glyph(face, c)).unwrap_or(0))).sum();
    units * size / f64::from(face.units_per_em())
}

/// `text` cut to `limit`, with an ellipsis where it was cut.
pub(crate) fn fitted(text: &str, size: f64, bold: bool, limit: f64) -> String {
    if width(text, size, bold) <= limit {
        return text.to_owned();
    }
    let (mut used, mut trimmed) = (width("…", size, bold), 0.0);
    // The longest that fits; spaces before the ellipsis go.
    let mut end = None;
    if used <= limit {
        end = Some(0);
    }
    for (at, c) in text.char_indices() {
        let own = width(c.encode_utf8(&mut [0; 4]), size, bold);
        if c.is_whitespace() {
            trimmed += own;
            continue;
        }
        used += trimmed + own;
        trimmed = 0.0;
        if used > limit {
            break;
        }
        end = Some(at + c.len_utf8());
    }
    end.map_or(String::new(), |end| format!("{}…", &text[..end]))
}

/// Sends the outline of `text` to `draw`, pen at (x, y) on the baseline, y down; returns the pen's x after it.
pub(crate) fn outline(text: &str, size: f64, bold: bool, x: f64, y: f64, draw: &mut PathBuilder) -> f64 {
    let Some(face) = face(bold) else { return x };
    let scale = size / f64::from(face.units_per_em());
    let mut pen = x;
    for c in text.chars() {
        let id = glyph(face, c);
        let mut placed = Placed { draw, scale: scale as f32, x: pen as f32, y: y as f32 };
        face.outline_glyph(id, &mut placed);
        pen += f64::from(face.glyph_hor_advance(id).unwrap_or(0)) * scale;
    }
    pen
}

/// Scales a glyph from font units, y up, to the page, y down.
struct Placed<'a> {
    draw: &'a mut PathBuilder,
    scale: f32,
    x: f32,
    y: f32,
}

impl Placed<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, self.y - y * self.scale)
    }
}

impl OutlineBuilder for Placed<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.draw.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.draw.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.draw.quad_to(x1, y1, x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.draw.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.draw.close();
    }
}
