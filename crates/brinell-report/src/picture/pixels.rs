//! A picture as pixels.

use tiny_skia as skia;

use super::{Error, Picture};
use crate::font;
use crate::raster;
use crate::shape::{Paint, Rect, Shape, Text, rgb, run_drop, run_size};

/// Of a PNG for print, as publishers ask it of line drawings with words.
const DOTS_PER_INCH: f64 = 600.0;
/// Of a PNG for the screen, to the CSS pixel.
const SCREEN: f64 = 2.0;

impl Picture {
    /// A PNG file, `scale` pixels to the CSS pixel, on white.
    pub fn png(&self, scale: f64) -> Result<Vec<u8>, Error> {
        encode(&self.pixels(scale)?, None)
    }

    /// A PNG file: 600 dots an inch where the picture is for print, and otherwise two pixels to the CSS pixel.
    pub fn png_file(&self) -> Result<Vec<u8>, Error> {
        if self.print_mm.is_none() {
            return self.png(SCREEN);
        }
        let per_mm = DOTS_PER_INCH / 25.4;
        let pixels = self.pixels(per_mm * self.mm_per_px())?;
        encode(&pixels, Some(1e3 * per_mm))
    }

    fn pixels(&self, scale: f64) -> Result<skia::Pixmap, Error> {
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
        let mut masks = Masks { size: (width as u32, height as u32), transform, made: vec![] };
        for shape in &self.shapes {
            match shape {
                Shape::Path { lines, close, paint, clip } => {
                    let clip = clip.filter(|clip| !within(lines, paint, clip));
                    let mask = clip.and_then(|clip| masks.of(clip));
                    draw(&mut pixels, traced(lines, *close), paint, transform, mask);
                }
                Shape::Circle { x, y, r, paint } => {
                    let mut builder = skia::PathBuilder::new();
                    builder.push_circle(*x as f32, *y as f32, *r as f32);
                    draw(&mut pixels, builder, paint, transform, None);
                }
                Shape::Text(text) => draw_text(&mut pixels, text, transform),
                Shape::Image { place, columns, pixels: image } => {
                    raster::draw(&mut pixels, *place, *columns, image, transform)
                }
                Shape::Open(_) | Shape::Figure(_) | Shape::Close => {}
            }
        }
        Ok(pixels)
    }
}

/// Nothing is transparent, so three bytes a pixel.
fn encode(pixels: &skia::Pixmap, per_metre: Option<f64>) -> Result<Vec<u8>, Error> {
    // A plain loop: this crate is not optimised, and the pixels are millions.
    let mut bytes = vec![0; pixels.data().len() / 4 * 3];
    for (rgb, rgba) in bytes.chunks_exact_mut(3).zip(pixels.data().chunks_exact(4)) {
        rgb.copy_from_slice(&rgba[..3]);
    }
    let failed = |error: png::EncodingError| Error::Png(error.to_string());
    let mut file = vec![];
    let mut encoder = png::Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    // Of drawings about as small as with filters and the usual effort, in a third of the time.
    encoder.set_deflate_compression(png::DeflateCompression::Level(2));
    encoder.set_filter(png::Filter::NoFilter);
    encoder.set_pixel_dims(per_metre.map(|dots| png::PixelDimensions {
        xppu: dots.round() as u32,
        yppu: dots.round() as u32,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&bytes).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(file)
}

fn traced(lines: &[Vec<(f64, f64)>], close: bool) -> skia::PathBuilder {
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
        if close {
            builder.close();
        }
    }
    builder
}

/// Whether nothing of lines leaves a clip, whatever their joins and ends look like.
fn within(lines: &[Vec<(f64, f64)>], paint: &Paint, clip: &Rect) -> bool {
    // Joins are round and ends are cut off square: neither reaches further than that.
    let reach = paint.width;
    let inside = |&(x, y): &(f64, f64)| {
        x >= clip.left + reach && x <= clip.right - reach && y >= clip.top + reach && y <= clip.bottom - reach
    };
    lines.iter().flatten().all(inside)
}

/// What clips leave free, each made once.
struct Masks {
    size: (u32, u32),
    transform: skia::Transform,
    made: Vec<(Rect, skia::Mask)>,
}

impl Masks {
    fn of(&mut self, clip: Rect) -> Option<&skia::Mask> {
        let known = self.made.iter().position(|(rect, _)| *rect == clip);
        let index = match known {
            Some(index) => index,
            None => {
                let mask = clip_mask(clip, self.size.0, self.size.1, self.transform)?;
                self.made.push((clip, mask));
                self.made.len() - 1
            }
        };
        self.made.get(index).map(|(_, mask)| mask)
    }
}

fn clip_mask(clip: Rect, width: u32, height: u32, transform: skia::Transform) -> Option<skia::Mask> {
    let rect = skia::Rect::from_ltrb(clip.left as f32, clip.top as f32, clip.right as f32, clip.bottom as f32)?;
    let mut mask = skia::Mask::new(width, height)?;
    mask.fill_path(&skia::PathBuilder::from_rect(rect), skia::FillRule::Winding, true, transform);
    Some(mask)
}

fn skia_paint(color: &str, opacity: f64) -> skia::Paint<'static> {
    let [r, g, b] = rgb(color);
    let mut paint = skia::Paint::default();
    paint.set_color_rgba8(r, g, b, (opacity.clamp(0.0, 1.0) * 255.0).round() as u8);
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
        pixels.stroke_path(&path, &skia_paint(paint.stroke, paint.opacity), &stroke, transform, mask);
    }
}

fn draw_text(pixels: &mut skia::Pixmap, text: &Text, transform: skia::Transform) {
    let mut glyphs = skia::PathBuilder::new();
    let mut pen = text.start();
    for run in &text.runs {
        let size = run_size(text.size, run);
        let drop = run_drop(text.size, run);
        pen = font::outline(&run.text, size, text.bold, pen, drop, &mut glyphs);
    }
    let Some(path) = glyphs.finish() else {
        return;
    };
    let mut place = transform.pre_translate(text.x as f32, text.y as f32);
    if text.upright {
        place = place.pre_rotate(-90.0);
    }
    pixels.fill_path(&path, &skia_paint(text.color, 1.0), skia::FillRule::Winding, place, None);
}
