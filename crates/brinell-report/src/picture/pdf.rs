//! A picture as a PDF of one page: vectors, with the typeface inside it.

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect as Box, Ref, Str, TextStr};

use super::Picture;
use crate::font::{self, Glyph};
use crate::shape::{Paint, Rect, Shape, Text, rgb, run_drop, run_size};

/// PDF's unit of length is a point.
const PT_PER_MM: f64 = 72.0 / 25.4;
/// How hard streams are compressed, of 10.
const EFFORT: u8 = 6;
/// A quarter of a circle as a cubic: handles this share of the radius long.
const ROUND: f64 = 0.552_284_75;
const REGISTRY: SystemInfo = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The page's objects come first; each font, state and image takes what it needs after them.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
const FIRST_FREE: i32 = 6;

impl Picture {
    /// A PDF file of one page, as large as the picture; text stays text.
    pub fn pdf(&self) -> Vec<u8> {
        let scale = self.mm_per_px() * PT_PER_MM;
        let (width, height) = ((scale * self.width) as f32, (scale * self.height) as f32);
        let mut page = Page { content: Content::new(), glyphs: Default::default(), images: vec![], opacities: vec![] };
        page.content
            // From pixels, y down, to points, y up.
            .transform([scale as f32, 0.0, 0.0, -scale as f32, 0.0, height])
            .set_line_join(LineJoinStyle::RoundJoin);
        for shape in &self.shapes {
            page.draw(shape);
        }
        let mut pdf = Pdf::new();
        pdf.catalog(CATALOG).pages(PAGES);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        pdf.document_info(INFO).title(TextStr(&self.title)).producer(TextStr("brinell"));
        let mut free = Free(FIRST_FREE);
        let fonts = page.write_fonts(&mut pdf, &mut free);
        let images = page.write_images(&mut pdf, &mut free);
        let content = compress_to_vec_zlib(&page.content.finish(), EFFORT);
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        let mut leaf = pdf.page(PAGE);
        leaf.parent(PAGES).contents(CONTENT);
        leaf.media_box(Box::new(0.0, 0.0, width, height));
        let mut resources = leaf.resources();
        let mut named = resources.fonts();
        for (name, id) in &fonts {
            named.pair(Name(name.as_bytes()), *id);
        }
        named.finish();
        let mut named = resources.x_objects();
        for (k, id) in images.iter().enumerate() {
            named.pair(Name(format!("I{k}").as_bytes()), *id);
        }
        named.finish();
        let mut named = resources.ext_g_states();
        for (k, percent) in page.opacities.iter().enumerate() {
            let part = f32::from(*percent) / 100.0;
            let mut state =
                named.insert(Name(format!("G{k}").as_bytes())).start::<pdf_writer::writers::ExtGraphicsState>();
            state.stroking_alpha(part).non_stroking_alpha(part);
        }
        named.finish();
        resources.finish();
        leaf.finish();
        pdf.finish()
    }
}

/// Numbers of objects.
struct Free(i32);

impl Free {
    fn take(&mut self) -> Ref {
        self.0 += 1;
        Ref::new(self.0 - 1)
    }
}

/// The page as it is drawn, and what it refers to.
struct Page<'a> {
    content: Content,
    /// Glyphs that are shown of the regular and of the semi-bold face, by their numbers.
    glyphs: [BTreeMap<u16, Glyph>; 2],
    /// Columns and pixels of the images.
    images: Vec<(usize, &'a [[u8; 3]])>,
    /// In percent.
    opacities: Vec<u8>,
}

impl<'a> Page<'a> {
    fn draw(&mut self, shape: &'a Shape) {
        match shape {
            Shape::Path { lines, close, paint, clip } => {
                self.painted(paint, *clip, |content| trace(content, lines, *close))
            }
            Shape::Circle { x, y, r, paint } => {
                self.painted(paint, None, |content| circle(content, [*x, *y, *r]));
            }
            Shape::Text(text) => self.text(text),
            Shape::Image { place, columns, pixels } => self.image(*place, *columns, pixels),
            Shape::Open(_) | Shape::Close => {}
        }
    }

    /// Fills and strokes what `trace` draws.
    fn painted(&mut self, paint: &Paint, clip: Option<Rect>, trace: impl Fn(&mut Content)) {
        let mut part = |opacity: f64, color: &str, filled: bool| {
            self.content.save_state();
            if let Some(clip) = clip {
                self.content
                    .rect(clip.left as f32, clip.top as f32, clip.width() as f32, clip.height() as f32)
                    .clip_nonzero()
                    .end_path();
            }
            let percent = (100.0 * opacity.clamp(0.0, 1.0)).round() as u8;
            if percent < 100 {
                let known = self.opacities.iter().position(|o| *o == percent);
                let index = known.unwrap_or_else(|| {
                    self.opacities.push(percent);
                    self.opacities.len() - 1
                });
                self.content.set_parameters(Name(format!("G{index}").as_bytes()));
            }
            let [r, g, b] = rgb(color).map(|part| f32::from(part) / 255.0);
            if filled {
                self.content.set_fill_rgb(r, g, b);
                trace(&mut self.content);
                self.content.fill_nonzero();
            } else {
                self.content.set_stroke_rgb(r, g, b).set_line_width(paint.width as f32);
                if !paint.dash.is_empty() {
                    let dash = paint.dash.iter().map(|d| *d as f32);
                    self.content.set_dash_pattern(dash, 0.0);
                }
                trace(&mut self.content);
                self.content.stroke();
            }
            self.content.restore_state();
        };
        if let Some((color, opacity)) = paint.fill {
            part(opacity * paint.opacity, color, true);
        }
        if paint.width > 0.0 {
            part(paint.opacity, paint.stroke, false);
        }
    }

    fn text(&mut self, text: &Text) {
        let [r, g, b] = rgb(text.color).map(|part| f32::from(part) / 255.0);
        self.content.begin_text().set_fill_rgb(r, g, b);
        let mut pen = text.start();
        for run in &text.runs {
            let (size, drop) = (run_size(text.size, run), run_drop(text.size, run));
            // Glyphs are drawn y up.
            let matrix = match text.upright {
                false => [1.0, 0.0, 0.0, -1.0, text.x + pen, text.y + drop],
                true => [0.0, -1.0, -1.0, 0.0, text.x + drop, text.y - pen],
            };
            let mut shown = Vec::with_capacity(2 * run.text.len());
            for glyph in font::glyphs(&run.text, text.bold) {
                shown.extend(glyph.id.to_be_bytes());
                self.glyphs[usize::from(text.bold)].insert(glyph.id, glyph);
            }
            self.content
                .set_font(Name(NAMES[usize::from(text.bold)].as_bytes()), size as f32)
                .set_text_matrix(matrix.map(|m| m as f32))
                .show(Str(&shown));
            pen += font::width(&run.text, size, text.bold);
        }
        self.content.end_text();
    }

    fn image(&mut self, place: Rect, columns: usize, pixels: &'a [[u8; 3]]) {
        if columns == 0 || pixels.len() < columns {
            return;
        }
        let [left, bottom] = [place.left, place.bottom].map(|v| v as f32);
        let [width, height] = [place.width(), place.height()].map(|v| v as f32);
        self.content
            .save_state()
            .transform([width, 0.0, 0.0, -height, left, bottom])
            .x_object(Name(format!("I{}", self.images.len()).as_bytes()))
            .restore_state();
        self.images.push((columns, pixels));
    }

    /// The faces that are used, as names of the page and objects.
    fn write_fonts(&self, pdf: &mut Pdf, free: &mut Free) -> Vec<(&'static str, Ref)> {
        let mut written = vec![];
        for (k, glyphs) in self.glyphs.iter().enumerate() {
            let Some(program) = font::program(k == 1).filter(|_| !glyphs.is_empty()) else {
                continue;
            };
            let [id, cid, descriptor, file, cmap] = std::array::from_fn(|_| free.take());
            let name = Name(program.name.as_bytes());
            pdf.type0_font(id)
                .base_font(Name(format!("{}-Identity-H", program.name).as_bytes()))
                .encoding_predefined(Name(b"Identity-H"))
                .descendant_font(cid)
                .to_unicode(cmap);
            let mut face = pdf.cid_font(cid);
            face.subtype(CidFontType::Type0)
                .base_font(name)
                .system_info(REGISTRY)
                .font_descriptor(descriptor)
                .default_width(0.0);
            let mut widths = face.widths();
            for (id, glyph) in glyphs {
                widths.consecutive(*id, [glyph.advance as f32]);
            }
            widths.finish();
            face.finish();
            let [low, high] = [program.descent, program.ascent].map(|v| v as f32);
            let [x0, y0, x1, y1] = program.bounds.map(|v| v as f32);
            pdf.font_descriptor(descriptor)
                .name(name)
                .flags(FontFlags::SYMBOLIC)
                .bbox(Box::new(x0, y0, x1, y1))
                .italic_angle(0.0)
                .ascent(high)
                .descent(low)
                .cap_height(program.cap_height as f32)
                .stem_v(if k == 1 { 120.0 } else { 80.0 })
                .font_file3(file);
            let bytes = compress_to_vec_zlib(program.cff, EFFORT);
            pdf.stream(file, &bytes).filter(Filter::FlateDecode).pair(Name(b"Subtype"), Name(b"CIDFontType0C"));
            let mut unicode = UnicodeCmap::new(Name(b"Custom"), REGISTRY);
            for (id, glyph) in glyphs {
                unicode.pair(*id, glyph.character);
            }
            pdf.cmap(cmap, &unicode.finish());
            written.push((NAMES[k], id));
        }
        written
    }

    fn write_images(&self, pdf: &mut Pdf, free: &mut Free) -> Vec<Ref> {
        let mut written = vec![];
        for (columns, pixels) in &self.images {
            let id = free.take();
            let bytes = compress_to_vec_zlib(pixels.as_flattened(), EFFORT);
            let mut image = pdf.image_xobject(id, &bytes);
            image.filter(Filter::FlateDecode);
            image.width(*columns as i32);
            image.height((pixels.len() / columns) as i32);
            image.color_space().device_rgb();
            image.bits_per_component(8).interpolate(false);
            written.push(id);
        }
        written
    }
}

/// Of the regular and the semi-bold face, in the page's content.
const NAMES: [&str; 2] = ["F0", "F1"];

fn trace(content: &mut Content, lines: &[Vec<(f64, f64)>], close: bool) {
    for line in lines {
        let mut points = line.iter().map(|(x, y)| (*x as f32, *y as f32));
        let Some((x, y)) = points.next() else {
            continue;
        };
        content.move_to(x, y);
        for (x, y) in points {
            content.line_to(x, y);
        }
        if close {
            content.close_path();
        }
    }
}

fn circle(content: &mut Content, [x, y, r]: [f64; 3]) {
    let at = |across: f64, down: f64| ((x + r * across) as f32, (y + r * down) as f32);
    let (sx, sy) = at(1.0, 0.0);
    content.move_to(sx, sy);
    let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0)];
    for ends in corners.windows(2) {
        let ((ax, ay), (bx, by)) = (ends[0], ends[1]);
        let (x1, y1) = at(ax + ROUND * bx, ay + ROUND * by);
        let (x2, y2) = at(bx + ROUND * ax, by + ROUND * ay);
        let (x3, y3) = at(bx, by);
        content.cubic_to(x1, y1, x2, y2, x3, y3);
    }
    content.close_path();
}
