//! Images within a picture: a PNG inside the SVG, pixels in a PNG; and the shades they use.

use std::fmt::Write as _;

use tiny_skia as skia;

use crate::encode::base64;
use crate::markup::coordinate;
use crate::shape::Rect;

/// Shades from least to most: lightness falls all the way, so they read in grey, and blue to the colour-blind.
const STOPS: [[f64; 3]; 6] = [
    [250.0, 251.0, 253.0],
    [205.0, 222.0, 240.0],
    [140.0, 184.0, 222.0],
    [66.0, 134.0, 190.0],
    [20.0, 78.0, 140.0],
    [8.0, 26.0, 58.0],
];
/// Steps from the first to the last shade: few enough for a small file.
pub(crate) const LEVELS: usize = 28;

/// The shade of a share of the range, 0 to 1.
pub(crate) fn shade(share: f64) -> [u8; 3] {
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    let level = (share * (LEVELS - 1) as f64).round() / (LEVELS - 1) as f64;
    let at = level * (STOPS.len() - 1) as f64;
    let low = (at as usize).min(STOPS.len() - 2);
    let part = at - low as f64;
    std::array::from_fn(|k| (STOPS[low][k] + part * (STOPS[low + 1][k] - STOPS[low][k])) as u8)
}

fn pixmap(columns: usize, pixels: &[[u8; 3]]) -> Option<skia::Pixmap> {
    let rows = pixels.len().checked_div(columns)?;
    let mut map = skia::Pixmap::new(columns as u32, rows as u32)?;
    for (to, [r, g, b]) in map.pixels_mut().iter_mut().zip(pixels) {
        *to = skia::ColorU8::from_rgba(*r, *g, *b, 255).premultiply();
    }
    Some(map)
}

pub(crate) fn write(svg: &mut String, place: Rect, columns: usize, pixels: &[[u8; 3]]) {
    let Some(png) = pixmap(columns, pixels).and_then(|map| map.encode_png().ok()) else {
        return;
    };
    let _ = writeln!(
        svg,
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
         href=\"data:image/png;base64,{}\"/>",
        coordinate(place.left),
        coordinate(place.top),
        coordinate(place.width()),
        coordinate(place.height()),
        base64(&png)
    );
}

pub(crate) fn draw(
    onto: &mut skia::Pixmap,
    place: Rect,
    columns: usize,
    pixels: &[[u8; 3]],
    transform: skia::Transform,
) {
    let Some(map) = pixmap(columns, pixels) else {
        return;
    };
    let across = place.width() / f64::from(map.width());
    let down = place.height() / f64::from(map.height());
    let to = transform.pre_translate(place.left as f32, place.top as f32).pre_scale(across as f32, down as f32);
    onto.draw_pixmap(0, 0, map.as_ref(), &skia::PixmapPaint::default(), to, None);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_shades_grow_darker_all_the_way() {
        let grey = |share: f64| {
            let [r, g, b] = shade(share).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let greys: Vec<f64> = (0..LEVELS).map(|k| grey(k as f64 / (LEVELS - 1) as f64)).collect();
        assert!(greys.windows(2).all(|w| w[1] < w[0] - 1.0), "{greys:?}");
        assert_eq!(shade(f64::NAN), shade(-1.0));
    }
}
