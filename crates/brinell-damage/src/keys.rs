//! From the keys of a scenario's files of damage to the options of their readers.

use brinell::scenario::{self, ImageFile, RollingDirection, ScanFile, SvgFile};

#[cfg(not(all(feature = "image", feature = "svg")))]
use crate::FileKind;
use crate::{DamageError, DepthMapOptions, Direction, Fill, FirstRow, Form, Unit, Zero};

fn direction(direction: RollingDirection) -> Direction {
    match direction {
        RollingDirection::Right => Direction::Right,
        RollingDirection::Up => Direction::Up,
        RollingDirection::Left => Direction::Left,
        RollingDirection::Down => Direction::Down,
    }
}

#[cfg(feature = "image")]
pub(crate) fn read_outline(bytes: &[u8], image: &ImageFile) -> Result<crate::Polygons, DamageError> {
    crate::read_image(bytes, &image_options(image))
}

#[cfg(feature = "image")]
pub(crate) fn image_options(image: &ImageFile) -> crate::ImageOptions {
    crate::ImageOptions {
        mm_per_pixel: image.mm_per_pixel,
        threshold: image.threshold,
        use_alpha: image.use_alpha,
        invert: image.invert,
        rolling_direction: direction(image.rolling_direction),
        center: image.center,
        smooth: match image.edges {
            scenario::ImageEdges::SubPixel => crate::Smooth::SubPixel { blur_px: image.blur_px.unwrap_or(0.0) },
            scenario::ImageEdges::PixelEdges => crate::Smooth::PixelEdges,
        },
        speck_mm2: image.speck_mm2,
        region_px: image.region_px,
        pieces: match (image.at_px, image.pieces) {
            (Some(at), _) => Some(crate::Pieces::At(at)),
            (None, pieces) => pieces.map(|pieces| match pieces {
                scenario::ImagePieces::Largest => crate::Pieces::Largest,
                scenario::ImagePieces::All => crate::Pieces::All,
            }),
        },
    }
}

#[cfg(not(feature = "image"))]
pub(crate) fn read_outline(_: &[u8], _: &ImageFile) -> Result<crate::Polygons, DamageError> {
    Err(DamageError::LeftOut { kind: FileKind::Png, feature: "image" })
}

#[cfg(feature = "svg")]
pub(crate) fn read_drawing(bytes: &[u8], drawing: &SvgFile) -> Result<crate::Polygons, DamageError> {
    let options = crate::SvgOptions {
        path_id: drawing.path_id.clone(),
        mm_per_unit: drawing.mm_per_unit,
        tolerance_mm: drawing.tolerance_mm,
        center: drawing.center,
    };
    crate::read_svg(bytes, &options)
}

#[cfg(not(feature = "svg"))]
pub(crate) fn read_drawing(_: &[u8], _: &SvgFile) -> Result<crate::Polygons, DamageError> {
    Err(DamageError::LeftOut { kind: FileKind::Svg, feature: "svg" })
}

pub(crate) fn scan_options(scan: &ScanFile) -> DepthMapOptions {
    DepthMapOptions {
        ds_mm: scan.ds_mm,
        dz_mm: scan.dz_mm,
        unit: match scan.unit {
            scenario::ScanUnit::Um => Unit::Um,
            scenario::ScanUnit::Mm => Unit::Mm,
            scenario::ScanUnit::M => Unit::M,
            scenario::ScanUnit::Counts => Unit::NmPerCount(scan.nm_per_count.unwrap_or(f64::NAN)),
        },
        height_positive_up: scan.height_positive_up,
        missing: scan.missing,
        fill: match scan.fill {
            scenario::ScanFill::None => Fill::None,
            scenario::ScanFill::Neighbours => Fill::Neighbours,
        },
        remove_form: match scan.remove_form {
            scenario::ScanForm::None => Form::None,
            scenario::ScanForm::Plane => Form::Plane,
            scenario::ScanForm::Cylinder => Form::Cylinder { radius_mm: scan.radius_mm },
        },
        zero: match scan.zero {
            scenario::ScanZero::AsIs => Zero::AsIs,
            scenario::ScanZero::RimMedian => Zero::RimMedian,
            scenario::ScanZero::Percentile => Zero::Percentile(scan.zero_percentile.unwrap_or(f64::NAN)),
        },
        first_row: match scan.first_row {
            scenario::FirstRow::Top => FirstRow::Top,
            scenario::FirstRow::Bottom => FirstRow::Bottom,
        },
        rolling_direction: direction(scan.rolling_direction),
        threshold_um: scan.threshold_um,
        speck_mm2: scan.speck_mm2,
        center: scan.center,
    }
}
