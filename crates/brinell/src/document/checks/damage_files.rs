//! Files of damage: keys that need or exclude each other.

use super::{Checker, short};
use crate::document::damage_files::SCALE_BAR;
use crate::document::scale_value::ScaleBar;
use crate::document::value_type::ValueType;
use crate::scenario::{ImageFile, ScanFile, ScanForm};

impl Checker<'_> {
    /// Keys that mean something only beside others.
    pub(super) fn scan(&mut self, i: usize, scan: &ScanFile) {
        let form = self.shape_key(i, "depth_map", "remove_form");
        if scan.remove_form == ScanForm::Cylinder && self.s.bearing.has_balls() {
            let message = "no surface of a ball bearing is a cylinder; grooves and balls are curved along the axis too";
            self.warn(&form, message.into(), "\"torus\"".into(), &["bearing.element"]);
        }
        if scan.radius_mm.is_some() && !matches!(scan.remove_form, ScanForm::Cylinder | ScanForm::Torus) {
            self.error(
                &self.shape_key(i, "depth_map", "radius_mm"),
                "has a meaning only where remove_form is \"cylinder\" or \"torus\"".into(),
                String::new(),
                &[&form],
            );
        }
    }

    /// Keys that exclude or contradict each other.
    pub(super) fn image(&mut self, i: usize, image: &ImageFile) {
        /// How far the side of a pixel may be from that of the scale bar.
        const SAME: f64 = 0.01;
        let key = |name: &str| format!("defects.{i}.shape.image.{name}");
        let bar = self.finder.found.get(&key(SCALE_BAR.name));
        if let Some(of_bar) = bar.and_then(|node| ScaleBar::read(node, &SCALE_BAR).ok()).map(ScaleBar::mm_per_pixel)
            && (image.mm_per_pixel / of_bar - 1.0).abs() > SAME
        {
            self.error(
                &key("mm_per_pixel"),
                format!("scale_bar says {} mm; give one of them", short(of_bar)),
                String::new(),
                &[&key(SCALE_BAR.name)],
            );
        }
        if image.at_px.is_some() && image.pieces.is_some() {
            self.error(
                &key("pieces"),
                "has no meaning beside at_px, which chooses one piece".into(),
                String::new(),
                &[&key("at_px")],
            );
        }
    }
}
