//! Damage as people have it (drawn, photographed, scanned), read into plain geometry.
//!
//! - [`read_svg`]: an outline drawn in a vector editor -> [`Polygons`]
//! - [`read_image`]: a photo or a mask, PNG or JPEG -> [`Polygons`]
//! - [`read_depth_map`]: a profilometer's grid or point cloud, CSV, NPY, PNG, SDF, X3P or SUR -> [`DepthMap`]
//! - [`resolve`], [`resolve_loaded`]: every file that a scenario names -> the scenario with geometry in its place. For
//!   this the crate uses `brinell`, which opens no files: its scenario, and its checks on what came out. The readers
//!   know no bearing.
//! - [`outline`]: the line along which a grid has one depth -> [`Polygons`]
//!
//! Frame. `s` runs counter-clockwise around the damaged surface, in that surface's own frame, and `z` along the axis, both
//! in mm. With +s to the right in a picture, `z` points up. The key `rolling_direction` names where +s points in the
//! picture; it is not where rollers pass to, which depends on the surface and on the sign of the speed
//! ([`Passing`](brinell::derived::Passing)).
//! Files whose rows run downwards are turned, never mirrored. The origin is the centre of the
//! damage's bounding box with `center`, else the centre of the page, image or grid.
//!
//! Every reader takes bytes and what a scenario says of the file ([`SvgFile`](brinell::scenario::SvgFile),
//! [`ImageFile`](brinell::scenario::ImageFile), [`ScanFile`](brinell::scenario::ScanFile)), and gives a [`DamageError`]
//! for what it cannot use; no bytes make it panic, and none make it take more than about 1 GB. What it decided by
//! itself is said in `warnings`.
//!
//! ```
//! use brinell::scenario::SvgFile;
//! use brinell_damage::read_svg;
//!
//! let drawing = br#"<svg xmlns="http://www.w3.org/2000/svg" width="6mm" height="6mm" viewBox="0 0 6 6">
//!     <rect x="1" y="2" width="3" height="2"/></svg>"#;
//! let damage = read_svg(drawing, &SvgFile::default())?;
//! assert!((damage.area_mm2() - 6.0).abs() < 1e-6);
//! # Ok::<(), brinell_damage::DamageError>(())
//! ```

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod background;
mod blur;
mod bytes;
mod confirm;
mod contour;
mod depth;
mod depth_cloud;
mod depth_csv;
mod depth_doubts;
mod depth_npy;
mod direction;
mod error;
mod form_doubts;
mod form_fit;
mod geometry;
mod holes;
mod image;
#[cfg(not(target_family = "wasm"))]
mod kept_tables;
mod kind;
mod loaded;
mod named_files;
mod numbers;
mod outline;
mod photo;
mod pieces;
mod pixels;
#[doc(hidden)]
pub mod plan;
mod region;
mod resolve;
mod scan;
mod scan_header;
mod segment;
mod stroke;
mod surface;
mod svg;
mod svg_page;
mod svg_shape;
mod svg_style;
mod svg_union;
mod threshold;

pub use depth::read_depth_map;
pub use error::DamageError;
pub use geometry::{Curve, DepthMap, Form, Polygons};
pub use image::{Traced, read_image, trace_image};
#[cfg(not(target_family = "wasm"))]
pub use kept_tables::keep_tables;
pub use kind::FileKind;
pub use loaded::resolve_loaded;
pub use named_files::resolve;
pub use outline::{level_of_area, outline};
pub use photo::{Photo, photo, photos};
pub use resolve::{ReadShape, Unresolved, shape_of_bytes, table_of_bytes};
pub use stroke::{Stroke, brush, scratch};
pub use svg::read_svg;
