//! Outlines of what lies above a level in a grid of pixels.
//!
//! One walk serves two kinds of outline. It follows the cracks between damaged and sound pixels with the damage on
//! its right (`y` down); what differs is the point put down for each crack: its corner (outlines along pixel edges),
//! or the place between the two pixels' centres where the level is crossed (marching squares). Outside the grid
//! everything is sound, and the outline runs along the grid's edge. Pixel (0, 0) covers [0, 1] x [0, 1].

use crate::error::DamageError;
use crate::geometry::signed_area;

/// More points than this is texture, not an outline.
const MAX_POINTS: usize = 2_000_000;

/// A grid and the level above which it is damage.
pub(crate) struct Field<'a, T> {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: &'a [T],
    pub(crate) level: f64,
    /// How far beyond the outermost pixels' centres the grid's edge lies, in pixels: 0.5 for pixels, 0 for nodes.
    pub(crate) rim: f64,
    /// Outlines cross between pixel centres; else they run along pixel edges.
    pub(crate) sub_pixel: bool,
}

/// Outlines, and what was dropped.
#[derive(Default)]
pub(crate) struct Outlines {
    /// Damage on the right as `y` runs down: outer rings have a positive [`signed_area`], holes a negative one.
    pub(crate) rings: Vec<Vec<[f64; 2]>>,
    /// Outer rings smaller than the smallest area.
    pub(crate) specks: usize,
    /// What the largest of them encloses, pixels.
    pub(crate) largest_speck: f64,
    /// Holes smaller than the smallest area, now filled.
    pub(crate) filled: usize,
}

/// Headings in the order in which a turn to the right steps.
const EAST: usize = 0;
const STEP: [[isize; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];
/// The pixel to the right of a crack that leaves a corner, relative to the corner; to its left: the one before.
const RIGHT_PIXEL: [[isize; 2]; 4] = [[0, 0], [-1, 0], [-1, -1], [0, -1]];

impl<T: Copy + Into<f64>> Field<'_, T> {
    /// All outlines whose ring encloses at least `smallest` pixels.
    pub(crate) fn outlines(&self, smallest: f64) -> Result<Outlines, DamageError> {
        let mut found = Outlines::default();
        let mut seen = vec![0_u64; (self.width * self.height).div_ceil(64)];
        let mut ring = Vec::new();
        let mut points = 0;
        for y in 0..self.height {
            for x in 0..self.width {
                // Every ring, outer or hole, has a damaged pixel below a sound one.
                let pixel = [x as isize, y as isize];
                let bit = y * self.width + x;
                if !self.damaged(pixel)
                    || self.damaged([pixel[0], pixel[1] - 1])
                    || seen[bit / 64] >> (bit % 64) & 1 == 1
                {
                    continue;
                }
                self.walk(pixel, &mut seen, &mut ring);
                let area = signed_area(&ring);
                if area.abs() < smallest || ring.len() < 3 || area == 0.0 {
                    found.specks += usize::from(area >= 0.0);
                    found.largest_speck = found.largest_speck.max(area);
                    found.filled += usize::from(area < 0.0);
                    continue;
                }
                points += ring.len();
                if points > MAX_POINTS {
                    return Err(DamageError::TooLarge {
                        what: "the number of points on the outlines",
                        value: format!("above {points}"),
                        limit: format!("{MAX_POINTS}"),
                        way_out: "this is texture rather than damage: blur, drop larger specks, or move the threshold",
                    });
                }
                found.rings.push(ring.clone());
            }
        }
        Ok(found)
    }

    /// The ring that leaves `start`, a pixel's upper left corner, to the east.
    fn walk(&self, start: [isize; 2], seen: &mut [u64], ring: &mut Vec<[f64; 2]>) {
        ring.clear();
        let (mut corner, mut heading, mut before) = (start, EAST, EAST + 1);
        loop {
            if heading == EAST {
                let bit = corner[1] as usize * self.width + corner[0] as usize;
                seen[bit / 64] |= 1 << (bit % 64);
            }
            if self.sub_pixel {
                let point = self.crossing(corner, heading);
                if ring.last() != Some(&point) {
                    ring.push(point);
                }
            } else if heading != before {
                ring.push([corner[0] as f64, corner[1] as f64]);
            }
            before = heading;
            corner = [corner[0] + STEP[heading][0], corner[1] + STEP[heading][1]];
            heading = self.turn(corner, heading);
            if corner == start && heading == EAST {
                break;
            }
        }
        if self.sub_pixel {
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
        } else if before == EAST {
            // The walk began in the middle of a straight edge.
            ring.remove(0);
        }
    }

    /// The heading after reaching `corner` with `heading`.
    fn turn(&self, corner: [isize; 2], heading: usize) -> usize {
        let ahead_left = self.damaged(Self::beside(corner, (heading + 3) % 4));
        let ahead_right = self.damaged(Self::beside(corner, heading));
        let left = match (ahead_left, ahead_right) {
            (false, true) => return heading,
            (true, true) => true,
            (false, false) => false,
            // Two damaged pixels touch at a corner: apart along pixel edges, else as the middle says.
            (true, false) => self.sub_pixel && self.middle(corner) > self.level,
        };
        (heading + if left { 3 } else { 1 }) % 4
    }

    /// The pixel to the right of the crack that leaves `corner` with `heading`.
    fn beside(corner: [isize; 2], heading: usize) -> [isize; 2] {
        let [dx, dy] = RIGHT_PIXEL[heading];
        [corner[0] + dx, corner[1] + dy]
    }

    /// The mean of the four pixels around an inner corner.
    fn middle(&self, corner: [isize; 2]) -> f64 {
        let sum: f64 = (0..4).map(|heading| self.value(Self::beside(corner, heading)).unwrap_or(0.0)).sum();
        0.25 * sum
    }

    /// Where the level is crossed between the centres on both sides of a crack.
    fn crossing(&self, corner: [isize; 2], heading: usize) -> [f64; 2] {
        let inside = Self::beside(corner, heading);
        let outside = Self::beside(corner, (heading + 3) % 4);
        let share = match (self.value(inside), self.value(outside)) {
            (Some(high), Some(low)) => (high - self.level) / (high - low),
            _ => self.rim,
        };
        let between = |i: usize| inside[i] as f64 + 0.5 + share * (outside[i] - inside[i]) as f64;
        [between(0), between(1)]
    }

    fn value(&self, [x, y]: [isize; 2]) -> Option<f64> {
        let x = usize::try_from(x).ok().filter(|&x| x < self.width)?;
        let y = usize::try_from(y).ok().filter(|&y| y < self.height)?;
        Some(self.values[y * self.width + x].into())
    }

    fn damaged(&self, pixel: [isize; 2]) -> bool {
        self.value(pixel).is_some_and(|value| value > self.level)
    }
}
