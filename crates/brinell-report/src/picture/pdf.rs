//! Pictures as a PDF, a page each: vectors, with the typeface inside it.

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

/// Three objects come first; each page, font, state and image takes what it needs after them.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const INFO: Ref = Ref::new(3);
const FIRST_FREE: i32 = 4;

/// What a PDF says of itself.
pub(crate) struct Info<'a> {
    pub(crate) title: &'a str,
    /// Who wrote it; may be empty.
    pub(crate) author: &'a str,
    /// The command that made it; may be empty.
    pub(crate) creator: &'a str,
}

impl Picture {
    /// A PDF file of one page, as large as the picture; text stays text.
    pub fn pdf(&self) -> Vec<u8> {
        pdf(std::slice::from_ref(self), &Info { title: &self.title, author: "", creator: "" })
    }
}

/// A PDF file of a page a picture, each as large as that; text stays text.
pub(crate) fn pdf(pictures: &[Picture], info: &Info) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let mut free = Free(FIRST_FREE);
    let pages: Vec<[Ref; 2]> = pictures.iter().map(|_| [free.take(), free.take()]).collect();
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES).lang(TextStr("en"));
    catalog.viewer_preferences().display_doc_title(true);
    catalog.finish();
    pdf.pages(PAGES).kids(pages.iter().map(|[page, _]| *page)).count(pages.len() as i32);
    let mut about = pdf.document_info(INFO);
    about.title(TextStr(info.title)).producer(TextStr("brinell"));
    if !info.author.is_empty() {
        about.author(TextStr(info.author));
    }
    if !info.creator.is_empty() {
        about.creator(TextStr(info.creator));
    }
    about.finish();
    let mut glyphs = Default::default();
    let drawn: Vec<Page> = pictures.iter().map(|picture| Page::of(picture, &mut glyphs)).collect();
    let fonts = write_fonts(&glyphs, &mut pdf, &mut free);
    for (page, ids) in drawn.into_iter().zip(pages) {
        page.write(ids, &fonts, &mut pdf, &mut free);
    }
    pdf.finish()
}

/// Numbers of objects.
struct Free(i32);

impl Free {
    fn take(&mut self) -> Ref {
        self.0 += 1;
        Ref::new(self.0 - 1)
    }
}

/// Glyphs that are shown of the regular and of the semi-bold face, by their numbers.
type Glyphs = [BTreeMap<u16, Glyph>; 2];

/// A page as it is drawn, and what it refers to.
struct Page<'a> {
    content: Content,
    /// Points.
    size: [f32; 2],
    /// Columns and pixels of the images.
    images: Vec<(usize, &'a [[u8; 3]])>,
    /// In percent.
    opacities: Vec<u8>,
}

impl<'a> Page<'a> {
    fn of(picture: &'a Picture, glyphs: &mut Glyphs) -> Self {
        let scale = picture.mm_per_px() * PT_PER_MM;
        let size = [picture.width, picture.height].map(|length| (scale * length) as f32);
        let mut page = Self { content: Content::new(), size, images: vec![], opacities: vec![] };
        page.content
            // From pixels, y down, to points, y up.
            .transform([scale as f32, 0.0, 0.0, -scale as f32, 0.0, size[1]])
            .set_line_join(LineJoinStyle::RoundJoin);
        for shape in &picture.shapes {
            page.draw(shape, glyphs);
        }
        page
    }

    fn write(self, [id, content_id]: [Ref; 2], fonts: &[(&str, Ref)], pdf: &mut Pdf, free: &mut Free) {
        let images = self.write_images(pdf, free);
        let content = compress_to_vec_zlib(&self.content.finish(), EFFORT);
        pdf.stream(content_id, &content).filter(Filter::FlateDecode);
        let mut leaf = pdf.page(id);
        leaf.parent(PAGES).contents(content_id);
        leaf.media_box(Box::new(0.0, 0.0, self.size[0], self.size[1]));
        let mut resources = leaf.resources();
        let mut named = resources.fonts();
        for (name, id) in fonts {
            named.pair(Name(name.as_bytes()), *id);
        }
        named.finish();
        let mut named = resources.x_objects();
        for (k, id) in images.iter().enumerate() {
            named.pair(Name(format!("I{k}").as_bytes()), *id);
        }
        named.finish();
        let mut named = resources.ext_g_states();
        for (k, percent) in self.opacities.iter().enumerate() {
            let part = f32::from(*percent) / 100.0;
            let mut state =
                named.insert(Name(format!("G{k}").as_bytes())).start::<pdf_writer::writers::ExtGraphicsState>();
            state.stroking_alpha(part).non_stroking_alpha(part);
        }
        named.finish();
        resources.finish();
        leaf.finish();
    }

    fn draw(&mut self, shape: &'a Shape, glyphs: &mut Glyphs) {
        match shape {
            Shape::Path { lines, close, paint, clip } => {
                self.painted(paint, *clip, |content| trace(content, lines, *close))
            }
            Shape::Circle { x, y, r, paint } => {
                self.painted(paint, None, |content| circle(content, [*x, *y, *r]));
            }
            Shape::Text(text) => self.text(text, glyphs),
            Shape::Image { place, columns, pixels } => self.image(*place, *columns, pixels),
            Shape::Open(_) | Shape::Figure(_) | Shape::Close => {}
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

    fn text(&mut self, text: &Text, glyphs: &mut Glyphs) {
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
                glyphs[usize::from(text.bold)].insert(glyph.id, glyph);
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

/// The faces that are used, as names in the pages and objects.
fn write_fonts(glyphs: &Glyphs, pdf: &mut Pdf, free: &mut Free) -> Vec<(&'static str, Ref)> {
    let mut written = vec![];
    for (k, glyphs) in glyphs.iter().enumerate() {
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

/// Of the regular and the semi-bold face, in the pages' content.
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
