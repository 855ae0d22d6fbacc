//! The part of a picture that is read.

use crate::error::DamageError;
use crate::pixels::Pixels;

/// The region (left, top, width, height in pixels) of a picture, and its upper left corner.
pub(crate) fn cut(picture: Pixels, region_px: Option<[f64; 4]>) -> Result<(Pixels, [usize; 2]), DamageError> {
    let Some([left, top, width, height]) = region_px else {
        return Ok((picture, [0, 0]));
    };
    let (w, h) = (picture.width as f64, picture.height as f64);
    let within = left >= 0.0 && top >= 0.0 && width >= 2.0 && height >= 2.0;
    if !(within && left + width <= w && top + height <= h) {
        return Err(DamageError::Option {
            option: "region_px",
            value: format!("[{left}, {top}, {width}, {height}]"),
            allowed: "[left, top, width, height] in pixels within the picture, 2 or more wide and high",
        });
    }
    let [left, top, width, height] = [left, top, width, height].map(|v| v as usize);
    let values = (top..top + height)
        .flat_map(|y| {
            let start = y * picture.width + left;
            picture.values[start..start + width].iter().copied()
        })
        .collect();
    let part = Pixels { width, height, values };
    Ok((part, [left, top]))
}
