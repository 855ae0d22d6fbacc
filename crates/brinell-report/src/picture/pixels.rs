//! A picture as pixels.

use tiny_skia as skia;
use ttf_parser::OutlineBuilder;

use super::{Error, Picture};
use crate::font;
use crate::raster;
use crate::shape::{Anchor, Paint, Rect, Shape, Text, run_drop, run_size};

impl Picture {
    /// A PNG file, `scale` pixels to the CSS pixel, on white.
    pub fn png(&self, scale: f64) -> Result<Vec<u8>, Error> {
        let (width, height) = ((self.width * scale).round(), (self.height * scale).round());
        let fits = |pixels: f64| (1.0..=16384.0).contains(&pixels);
        let size = Error::Size { width, height };
        if !fits(width) || !fits(height) {
            return Err(size);
        }
        let Some(mut pixels) = skia::Pixmap::new(width as u32, height as u32) else {
            return Err(size);
        };
        pixels.fill(skia::Color::WHITE);
        let transform = skia::Transform::from_scale(scale as f32, scale as f32);
        for shape in &self.shapes {
            match shape {
                Shape::Path {
                    lines,
                    close,
                    paint,
                    clip,
                } => {
                    let mask = clip
                        .and_then(|clip| clip_mask(clip, width as u32, height as u32, transform));
                    let mut builder = skia::PathBuilder::new();
                    for line in lines {
                        let mut points = line.iter();
                        let Some(&(x, y)) = points.next() else {
                            continue;
                        };
                        builder.move_to(x as f32, y as f32);
                        for &(x, y) in points {
                            builder.line_to(x as f32, y as f32);
                        }
                        if *close {
                            builder.close();
                        }
                    }
                    draw(&mut pixels, builder, paint, transform, mask.as_ref());
                }
                Shape::Circle { x, y, r, paint } => {
                    let mut builder = skia::PathBuilder::new();
                    builder.push_circle(*x as f32, *y as f32, *r as f32);
                    draw(&mut pixels, builder, paint, transform, None);
                }
                Shape::Text(text) => draw_text(&mut pixels, text, transform),
                Shape::Image {
                    place,
                    columns,
                    pixels: image,
                } => raster::draw(&mut pixels, *place, *columns, image, transform),
                Shape::Open(_) | Shape::Close => {}
            }
        }
        pixels
            .encode_png()
            .map_err(|error| Error::Png(error.to_string()))
    }
}

fn clip_mask(
    clip: Rect,
    width: u32,
    height: u32,
    transform: skia::Transform,
) -> Option<skia::Mask> {
    let rect = skia::Rect::from_ltrb(
        clip.left as f32,
        clip.top as f32,
        clip.right as f32,
        clip.bottom as f32,
    )?;
    let mut mask = skia::Mask::new(width, height)?;
    mask.fill_path(
        &skia::PathBuilder::from_rect(rect),
        skia::FillRule::Winding,
        true,
        transform,
    );
    Some(mask)
}

fn skia_paint(color: &str, opacity: f64) -> skia::Paint<'static> {
    let part =
        |at: usize| u8::from_str_radix(color.get(at..at + 2).unwrap_or("0"), 16).unwrap_or(0);
    let mut paint = skia::Paint::default();
    paint.set_color_rgba8(
        part(1),
        part(3),
        part(5),
        (opacity.clamp(0.0, 1.0) * 255.0).round() as u8,
    );
    paint.anti_alias = true;
    paint
}

fn draw(
    pixels: &mut skia::Pixmap,
    builder: skia::PathBuilder,
    paint: &Paint,
    transform: skia::Transform,
    mask: Option<&skia::Mask>,
) {
    let Some(path) = builder.finish() else { return };
    if let Some((color, opacity)) = paint.fill {
        let fill = skia_paint(color, opacity * paint.opacity);
        pixels.fill_path(&path, &fill, skia::FillRule::Winding, transform, mask);
    }
    if paint.width > 0.0 {
        let stroke = skia::Stroke {
            width: paint.width as f32,
            line_join: skia::LineJoin::Round,
            dash: skia::StrokeDash::new(paint.dash.iter().map(|d| *d as f32).collect(), 0.0),
            ..skia::Stroke::default()
        };
        pixels.stroke_path(
            &path,
            &skia_paint(paint.stroke, paint.opacity),
            &stroke,
            transform,
            mask,
        );
    }
}

fn draw_text(pixels: &mut skia::Pixmap, text: &Text, transform: skia::Transform) {
    let shift = match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5 * text.width(),
        Anchor::End => -text.width(),
    };
    let mut glyphs = Glyphs(skia::PathBuilder::new());
    let mut pen = shift;
    for run in &text.runs {
        let size = run_size(text.size, run);
        let drop = run_drop(text.size, run);
        pen = font::outline(&run.text, size, text.bold, pen, drop, &mut glyphs);
    }
    let Some(path) = glyphs.0.finish() else {
        return;
    };
    let mut place = transform.pre_translate(text.x as f32, text.y as f32);
    if text.upright {
        place = place.pre_rotate(-90.0);
    }
    pixels.fill_path(
        &path,
        &skia_paint(text.color, 1.0),
        skia::FillRule::Winding,
        place,
        None,
    );
}

struct Glyphs(skia::PathBuilder);

impl OutlineBuilder for Glyphs {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.0.close();
    }
}
