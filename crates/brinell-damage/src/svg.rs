//! An outline drawn in a vector editor. All shapes that show, filled or stroked, are damage; their colours mean
//! nothing. Overlapping shapes unite, holes follow each path's fill rule, self-intersections are resolved by it.
//! A stroke's width is not part of the outline. Clips, masks, text and embedded images are left out, with a warning.

use brinell::defect::check_crossings;
use brinell::scenario::SvgFile;
use i_overlay::core::fill_rule::FillRule;
use kurbo::{Affine, BezPath, PathEl, Point};
use roxmltree::{Document, Node, NodeId};

use crate::error::{DamageError, check_range, excerpt};
use crate::geometry::Polygons;
use crate::kind::{FileKind, describe};
use crate::svg_page::page;
use crate::svg_shape::{broken, number, outline, place, transform};
use crate::svg_style::{Sheets, Style};
use crate::svg_union::{Rings, united};

/// Farther out than this (mm), a drawing's scale must be wrong.
const MAX_MM: f64 = 1e4;
/// Points of all outlines together.
const MAX_POINTS: usize = 1_000_000;
/// Groups within groups, `use` included: a drawing that uses itself stops here.
const MAX_DEPTH: usize = 64;
/// Elements visited, `use` counted each time.
const MAX_ELEMENTS: usize = 200_000;
/// Bytes of the file.
pub(crate) const MAX_BYTES: usize = 4 << 20;

/// Reads the shapes of an SVG drawing as polygons: `s` to the right, `z` up.
pub fn read_svg(bytes: &[u8], options: &SvgFile) -> Result<Polygons, DamageError> {
    check_range("tolerance_mm", options.tolerance_mm, 9.9e-6, 1.0, "1e-5 to 1 mm")?;
    if let Some(scale) = options.mm_per_unit {
        check_range("mm_per_unit", scale, 0.0, 1e4, "a number of mm above 0, at most 10000")?;
    }
    if FileKind::of_content(bytes) != Some(FileKind::Svg) {
        return Err(DamageError::WrongKind {
            what: describe(bytes),
            wanted: "a drawing",
            way_out: "save it as plain SVG",
        });
    }
    if bytes.len() > MAX_BYTES {
        return Err(DamageError::TooLarge {
            what: "the drawing",
            value: format!("{} bytes", bytes.len()),
            limit: format!("{} MiB", MAX_BYTES >> 20),
            way_out: "save the damage's outline alone",
        });
    }
    let fault = |at: String, why: String| DamageError::Broken { kind: FileKind::Svg, at, why };
    let text =
        std::str::from_utf8(bytes).map_err(|e| fault(format!("byte {}", e.valid_up_to()), "not UTF-8".to_owned()))?;
    let parsing =
        roxmltree::ParsingOptions { allow_dtd: true, nodes_limit: 4 * MAX_ELEMENTS as u32, ..Default::default() };
    let document = Document::parse_with_options(text.trim_start_matches('\u{feff}'), parsing)
        .map_err(|e| fault(format!("line {}", e.pos().row), e.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(broken(root, "its outermost element must be `svg`"));
    }
    let wanted = options.path_id.as_ref().map(|id| find(&document, id)).transpose()?;
    let mut reader = Reader {
        sheets: Sheets::of(&document),
        options,
        wanted: wanted.map(|n| n.id()),
        shapes: Vec::new(),
        points: 0,
        elements: 0,
        warnings: Vec::new(),
    };
    let page = page(root, options.mm_per_unit)?;
    let style = reader.sheets.style(root, Style::default());
    let inside = reader.wanted.is_none() || reader.wanted == Some(root.id());
    reader.children(root, page, style, inside, 0)?;
    reader.finish()
}

fn find<'a, 'i>(document: &'a Document<'i>, id: &str) -> Result<Node<'a, 'i>, DamageError> {
    let with_id = |n: &Node<'_, '_>| n.attribute("id").is_some();
    let mut nodes = document.descendants().filter(with_id);
    if let Some(node) = nodes.find(|n| n.attribute("id") == Some(id)) {
        return Ok(node);
    }
    let known: Vec<String> = document
        .descendants()
        .filter(|n| {
            with_id(n) && matches!(n.tag_name().name(), "path" | "g" | "rect" | "circle" | "ellipse" | "polygon")
        })
        .take(8)
        .map(|n| excerpt(n.attribute("id").unwrap_or_default()))
        .collect();
    Err(DamageError::NoSuchId {
        id: excerpt(id),
        known: if known.is_empty() {
            "it has no ids at all".to_owned()
        } else {
            format!("it has {}", known.join(", "))
        },
    })
}

fn nested(node: Node<'_, '_>) -> DamageError {
    DamageError::Unsupported {
        at: place(node),
        what: format!("a nested `{}`", node.tag_name().name()),
        way_out: "ungroup it, or save as plain SVG",
    }
}

struct Reader<'a> {
    sheets: Sheets<'a>,
    options: &'a SvgFile,
    /// The element that `path_id` names.
    wanted: Option<NodeId>,
    /// Each shape's rings, its fill rule applied.
    shapes: Vec<Rings>,
    points: usize,
    elements: usize,
    warnings: Vec<String>,
}

impl Reader<'_> {
    /// Reads what is below `node`; shapes count only `inside` the wanted element.
    fn children(
        &mut self,
        node: Node<'_, '_>,
        to_mm: Affine,
        style: Style,
        inside: bool,
        depth: usize,
    ) -> Result<(), DamageError> {
        for child in node.children().filter(Node::is_element) {
            self.element(child, to_mm, style, inside, depth + 1)?;
        }
        Ok(())
    }

    fn element(
        &mut self,
        node: Node<'_, '_>,
        to_mm: Affine,
        parent: Style,
        inside: bool,
        depth: usize,
    ) -> Result<(), DamageError> {
        self.elements += 1;
        let too_large = |what, value: usize, limit: usize| DamageError::TooLarge {
            what,
            value: format!("{value} or more"),
            limit: limit.to_string(),
            way_out: "save the damage's outline alone, as plain SVG",
        };
        if self.elements > MAX_ELEMENTS {
            return Err(too_large("the number of elements", self.elements, MAX_ELEMENTS));
        }
        if depth > MAX_DEPTH {
            return Err(too_large("the depth of groups", depth, MAX_DEPTH));
        }
        let inside = inside || self.wanted == Some(node.id());
        let style = self.sheets.style(node, parent);
        if style.removed {
            return Ok(());
        }
        let name = node.tag_name().name();
        match name {
            "g" | "a" | "switch" => {
                self.mention_clips(node, inside);
                let to_mm = to_mm * transform(node)?;
                return self.children(node, to_mm, style, inside, depth);
            }
            // A copy of the wanted element is not the wanted element.
            "use" if !inside => return Ok(()),
            "use" => {
                let target = used(node)?;
                let shift = Affine::translate((number(node, "x")?, number(node, "y")?));
                let to_mm = to_mm * transform(node)? * shift;
                return self.element(target, to_mm, style, inside, depth + 1);
            }
            "svg" if inside => return Err(nested(node)),
            "text" | "image" | "foreignObject" | "line" if inside => {
                self.warn(format!("{}: left out; only closed shapes are damage", place(node)));
                return Ok(());
            }
            _ => {}
        }
        if !inside || !style.visible {
            return Ok(());
        }
        let Some(path) = outline(node)? else {
            return Ok(());
        };
        if !style.filled && !style.stroked {
            self.warn(format!("{}: left out; neither its fill nor its stroke shows", place(node)));
            return Ok(());
        }
        self.mention_clips(node, inside);
        let path = to_mm * transform(node)? * path;
        self.shape(node, &path, style)
    }

    fn mention_clips(&mut self, node: Node<'_, '_>, inside: bool) {
        if inside && (node.has_attribute("clip-path") || node.has_attribute("mask")) {
            self.warn(format!("{}: its clip or mask is not applied", place(node)));
        }
    }

    fn warn(&mut self, warning: String) {
        if self.warnings.len() < 16 {
            self.warnings.push(warning);
        }
    }

    fn shape(&mut self, node: Node<'_, '_>, path: &BezPath, style: Style) -> Result<(), DamageError> {
        check_reach(node, path)?;
        let tolerance = self.options.tolerance_mm;
        let (rings, open) = self.flatten(path)?;
        for (ring, open) in rings.iter().zip(open) {
            let (first, last) = (ring[0], ring[ring.len() - 1]);
            let gap_mm = (first[0] - last[0]).hypot(first[1] - last[1]);
            if !open || gap_mm <= tolerance || ring.len() < 3 {
                continue;
            }
            if !style.filled {
                return Err(DamageError::OpenOutline { at: place(node), gap_mm, tolerance_mm: tolerance });
            }
            self.warn(format!("{}: open by {gap_mm:.4} mm; closed by a straight line, as its fill is", place(node)));
        }
        let rule = if style.even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
        check_crossings(&rings).map_err(|why| DamageError::Tangled { at: place(node), why: why.to_string() })?;
        let rings = united(&rings, rule);
        if rings.is_empty() {
            self.warn(format!("{}: left out; it encloses nothing", place(node)));
        } else {
            self.shapes.push(rings);
        }
        Ok(())
    }

    /// A path as rings of points, and which of them are open.
    fn flatten(&mut self, path: &BezPath) -> Result<(Rings, Vec<bool>), DamageError> {
        let mut rings: Rings = Vec::new();
        let mut open: Vec<bool> = Vec::new();
        let mut points = self.points;
        kurbo::flatten(path.elements().iter().copied(), self.options.tolerance_mm, |element| match element {
            _ if points > MAX_POINTS => {}
            PathEl::MoveTo(p) => {
                rings.push(vec![[p.x, p.y]]);
                open.push(true);
            }
            PathEl::LineTo(p) => {
                points += 1;
                if let (Some(ring), Some(true)) = (rings.last_mut(), open.last()) {
                    ring.push([p.x, p.y]);
                } else if let Some(start) = rings.last().map(|ring| ring[0]) {
                    // Drawing on after closing starts anew at the same point.
                    rings.push(vec![start, [p.x, p.y]]);
                    open.push(true);
                }
            }
            PathEl::ClosePath => {
                if let Some(open) = open.last_mut() {
                    *open = false;
                }
            }
            PathEl::QuadTo(..) | PathEl::CurveTo(..) => {}
        });
        self.points = points;
        if points > MAX_POINTS {
            return Err(DamageError::TooLarge {
                what: "the number of points on the outlines",
                value: format!("above {MAX_POINTS}"),
                limit: MAX_POINTS.to_string(),
                way_out: "raise `tolerance_mm` or simplify the drawing",
            });
        }
        Ok((rings, open))
    }

    fn finish(mut self) -> Result<Polygons, DamageError> {
        let rings = match self.shapes.len() {
            0 => {
                let mut why = "no shape with an area shows".to_owned();
                if let Some(warning) = self.warnings.first() {
                    why = format!("{why} ({warning})");
                }
                return Err(DamageError::NothingDamaged { why });
            }
            1 => self.shapes.remove(0),
            _ => {
                let all = self.shapes.concat();
                check_crossings(&all)
                    .map_err(|why| DamageError::Tangled { at: "its shapes together".into(), why: why.to_string() })?;
                united(&all, FillRule::NonZero)
            }
        };
        let mut result = Polygons { polygons_mm: rings, warnings: self.warnings, notes: Vec::new(), threshold: None };
        if self.options.center {
            result.centre();
        }
        Ok(result)
    }
}

/// The element that a `use` copies.
fn used<'a, 'input>(node: Node<'a, 'input>) -> Result<Node<'a, 'input>, DamageError> {
    let xlink = ("http://www.w3.org/1999/xlink", "href");
    let href = node.attribute("href").or_else(|| node.attribute(xlink)).unwrap_or_default();
    let id = href.trim().trim_start_matches('#');
    let target = find(node.document(), id)?;
    if matches!(target.tag_name().name(), "svg" | "symbol") {
        return Err(nested(target));
    }
    Ok(target)
}

/// That no point of a path lies further out than a drawing does.
fn check_reach(node: Node<'_, '_>, path: &BezPath) -> Result<(), DamageError> {
    for point in path.elements().iter().flat_map(control_points) {
        let far = point.x.abs().max(point.y.abs());
        if !point.is_finite() || far > MAX_MM {
            return Err(DamageError::TooLarge {
                what: "the distance from the page's centre",
                value: format!("{far:.3e} mm ({})", place(node)),
                limit: format!("{MAX_MM} mm"),
                way_out: "check `mm_per_unit`",
            });
        }
    }
    Ok(())
}

fn control_points(element: &PathEl) -> Vec<Point> {
    match *element {
        PathEl::MoveTo(a) | PathEl::LineTo(a) => vec![a],
        PathEl::QuadTo(a, b) => vec![a, b],
        PathEl::CurveTo(a, b, c) => vec![a, b, c],
        PathEl::ClosePath => vec![],
    }
}
