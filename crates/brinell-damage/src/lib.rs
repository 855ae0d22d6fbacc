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
//! # #[cfg(feature = "svg")] {
//! use brinell::scenario::SvgFile;
//! use brinell_damage::read_svg;
//!
//! let drawing = br#"<svg xmlns="http://www.w3.org/2000/svg" width="6mm" height="6mm" viewBox="0 0 6 6">
//!     <rect x="1" y="2" width="3" height="2"/></svg>"#;
//! let damage = read_svg(drawing, &SvgFile::default())?;
//! assert!((damage.area_mm2() - 6.0).abs() < 1e-6);
//! # }
//! # Ok::<(), brinell_damage::DamageError>(())
//! ```

#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

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
mod kind;
mod loaded;
mod numbers;
mod outline;
#[doc(hidden)]
pub mod plan;
mod resolve;
mod scan;
mod surface;

#[cfg(feature = "image")]
mod background;
#[cfg(feature = "image")]
mod blur;
#[cfg(feature = "image")]
mod image;
#[cfg(feature = "image")]
mod photo;
#[cfg(feature = "image")]
mod pieces;
#[cfg(feature = "image")]
mod pixels;
#[cfg(feature = "image")]
mod region;
#[cfg(feature = "image")]
mod segment;
#[cfg(feature = "image")]
mod threshold;

#[cfg(feature = "svg")]
mod stroke;
#[cfg(feature = "svg")]
mod svg;
#[cfg(feature = "svg")]
mod svg_page;
#[cfg(feature = "svg")]
mod svg_shape;
#[cfg(feature = "svg")]
mod svg_style;
#[cfg(feature = "svg")]
mod svg_union;

pub use depth::read_depth_map;
pub use error::DamageError;
pub use geometry::{Curve, DepthMap, Form, Polygons};
pub use kind::FileKind;
pub use loaded::resolve_loaded;
pub use outline::{level_of_area, outline};
#[doc(hidden)]
pub use resolve::MOST_TEXT;
pub use resolve::{ReadShape, Unresolved, resolve, shape_of_bytes};

#[cfg(feature = "image")]
pub use image::{Traced, read_image, trace_image};
#[cfg(feature = "image")]
pub use photo::{Photo, photo, photos};
#[cfg(feature = "svg")]
pub use stroke::{Stroke, brush, scratch};
#[cfg(feature = "svg")]
pub use svg::read_svg;
