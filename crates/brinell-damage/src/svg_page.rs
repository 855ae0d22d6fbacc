//! A drawing's scale and origin, from its width, height and viewBox.

use kurbo::Affine;
use roxmltree::Node;

use crate::error::DamageError;
use crate::svg_shape::{broken, length, mm_per, numbers};

/// The map from user units to mm, `z` up, the page's centre at the origin.
pub(crate) fn page(root: Node<'_, '_>, mm_per_unit: Option<f64>) -> Result<Affine, DamageError> {
    let view = match root.attribute("viewBox") {
        None => None,
        Some(text) => match numbers(root, text)?.as_slice() {
            &[x, y, w, h] if w > 0.0 && h > 0.0 => Some([x, y, w, h]),
            _ => {
                return Err(broken(root, "its viewBox must be four numbers, the last two above 0"));
            }
        },
    };
    let side = |name: &str| root.attribute(name).and_then(length).filter(|l| l.0 > 0.0);
    let (width, height) = (side("width"), side("height"));
    let physical = |side: Option<(f64, &str)>| side.and_then(|(v, unit)| Some(v * mm_per(unit)?));
    let own_scale = || -> Result<f64, DamageError> {
        let (Some(w), Some(h)) = (physical(width), physical(height)) else {
            return Err(DamageError::NoScale {
                why: "its width and height are not in mm, cm, in, pt or pc".to_owned(),
            });
        };
        let Some([_, _, view_w, view_h]) = view else {
            // Without a viewBox a user unit is a CSS pixel, 96 to the inch.
            return Ok(25.4 / 96.0);
        };
        let (across, down) = (w / view_w, h / view_h);
        if (across - down).abs() > 1e-3 * across.max(down) {
            return Err(DamageError::NoScale {
                why: format!("it is {across:.5} mm per unit across and {down:.5} mm down"),
            });
        }
        Ok(0.5 * (across + down))
    };
    let scale = match mm_per_unit {
        Some(scale) => scale,
        None => own_scale()?,
    };
    let user =
        |side: Option<(f64, &str)>| side.map_or(0.0, |(v, unit)| v * mm_per(unit).map_or(1.0, |mm| mm * 96.0 / 25.4));
    let [x, y, w, h] = view.unwrap_or([0.0, 0.0, user(width), user(height)]);
    Ok(Affine::scale_non_uniform(scale, -scale) * Affine::translate((-x - 0.5 * w, -y - 0.5 * h)))
}
