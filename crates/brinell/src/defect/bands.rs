//! Damage seen from above, cut along z = const into bands: within one its borders span the whole band and keep their
//! order.
//!
//! So what damage covers of a slice, and the mean depth there that a roller's envelope leaves, are sums of closed forms
//! (section 3). s and z in m.

/// One border of damage as a function s(z), monotone between two z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Border {
    /// First and last z.
    pub(super) z: [f64; 2],
    form: Form,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    /// s at the first and the last z.
    Straight([f64; 2]),
    /// A part of an ellipse that lies in one of its quadrants.
    Arc {
        /// Centre (s, z).
        center: [f64; 2],
        /// Half-axes along s and z.
        radii: [f64; 2],
        /// Quadrant: 1 or -1 along s and z.
        side: [f64; 2],
    },
}

/// A range of z; empty where the second is not above the first.
type Range = [f64; 2];

fn both(a: Range, b: Range) -> Range {
    [a[0].max(b[0]), a[1].min(b[1])]
}

fn long([from, to]: Range) -> f64 {
    (to - from).max(0.0)
}

impl Border {
    /// Between two points (s, z); `None` where it runs along s.
    pub(super) fn straight(p: [f64; 2], q: [f64; 2]) -> Option<Self> {
        let (low, high) = if p[1] <= q[1] { (p, q) } else { (q, p) };
        (low[1] < high[1]).then_some(Self { z: [low[1], high[1]], form: Form::Straight([low[0], high[0]]) })
    }

    /// A part of an ellipse about `center` (s, z) within the quadrant `side`, between two z.
    pub(super) fn arc(center: [f64; 2], radii: [f64; 2], side: [f64; 2], z: [f64; 2]) -> Option<Self> {
        (z[0] < z[1]).then_some(Self { z, form: Form::Arc { center, radii, side } })
    }

    /// Mirrored at z = 0.
    pub(super) fn mirrored(self) -> Self {
        let form = match self.form {
            Form::Straight([a, b]) => Form::Straight([b, a]),
            Form::Arc { center, radii, side } => {
                Form::Arc { center: [center[0], -center[1]], radii, side: [side[0], -side[1]] }
            }
        };
        Self { z: [-self.z[1], -self.z[0]], form }
    }

    /// Moved along z.
    pub(super) fn moved(mut self, by: f64) -> Self {
        self.z = self.z.map(|z| z + by);
        if let Form::Arc { center, .. } = &mut self.form {
            center[1] += by;
        }
        self
    }

    /// s at z.
    pub(super) fn s(&self, z: f64) -> f64 {
        match self.form {
            Form::Straight([a, b]) => a + (b - a) * (z - self.z[0]) / (self.z[1] - self.z[0]),
            Form::Arc { center, radii, side } => {
                let y = (z - center[1]) / radii[1];
                center[0] + side[0] * radii[0] * (1.0 - y * y).max(0.0).sqrt()
            }
        }
    }

    /// z at s, somewhere beyond where the border does not reach s.
    fn z(&self, s: f64) -> f64 {
        match self.form {
            Form::Straight([a, b]) => self.z[0] + (self.z[1] - self.z[0]) * (s - a) / (b - a),
            Form::Arc { center, radii, side } => {
                let x = (s - center[0]) / radii[0];
                center[1] + side[1] * radii[1] * (1.0 - x * x).max(0.0).sqrt()
            }
        }
    }

    /// Where in a range of z the border lies at or before s.
    fn before(&self, s: f64, range: Range) -> Range {
        self.part_where(s, range, |own| own <= s)
    }

    /// Where in a range of z the border lies at or after s.
    fn after(&self, s: f64, range: Range) -> Range {
        self.part_where(s, range, |own| own >= s)
    }

    /// Where in a range of z what is asked of the border's s holds, which changes at s alone.
    fn part_where(&self, s: f64, [a, b]: Range, holds: impl Fn(f64) -> bool) -> Range {
        match (holds(self.s(a)), holds(self.s(b))) {
            (true, true) => [a, b],
            (false, false) => [a, a],
            (true, false) => [a, self.z(s).clamp(a, b)],
            (false, true) => [self.z(s).clamp(a, b), b],
        }
    }

    /// Integral of (x - s(z))^2 over a range of z, m^3.
    fn squares(&self, x: f64, [a, b]: Range) -> f64 {
        match self.form {
            Form::Straight(_) => {
                let d = [a, 0.5 * (a + b), b].map(|z| x - self.s(z));
                (b - a) / 6.0 * (d[0] * d[0] + 4.0 * d[1] * d[1] + d[2] * d[2])
            }
            Form::Arc { center, radii, side } => {
                // z = z_c + r_z sin t, s = s_c +- r_s cos t.
                let (away, r) = (side[0] * (x - center[0]), radii[0]);
                let of = |z: f64| {
                    let sin = ((z - center[1]) / radii[1]).clamp(-1.0, 1.0);
                    let (t, cos) = (sin.asin(), (1.0 - sin * sin).sqrt());
                    away * away * sin - away * r * (t + sin * cos) + r * r * sin * (1.0 - sin * sin / 3.0)
                };
                radii[1] * (of(b) - of(a))
            }
        }
    }
}

/// All of a range of z, with the borders that span it in the order of s: damage begins and ends by turns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Band {
    /// First and last z.
    pub(super) z: [f64; 2],
    borders: Vec<Border>,
}

impl Band {
    /// The bands that borders leave, cut at `cuts` besides; nothing outside the first and the last cut. Both ascend.
    pub(super) fn all(borders: &[Border], crossings: &[f64], cuts: &[f64]) -> Vec<Self> {
        let (Some(&first), Some(&last)) = (cuts.first(), cuts.last()) else {
            return Vec::new();
        };
        let mut stops: Vec<f64> = borders
            .iter()
            .flat_map(|b| b.z)
            .chain(crossings.iter().copied())
            .chain(cuts.iter().copied())
            .filter(|z| (first..=last).contains(z))
            .collect();
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        let mut sorted: Vec<&Border> = borders.iter().collect();
        sorted.sort_by(|a, b| a.z[0].total_cmp(&b.z[0]));
        let mut coming = sorted.into_iter().peekable();
        let mut active: Vec<Border> = Vec::new();
        let mut bands = Vec::new();
        for pair in stops.windows(2) {
            let (z, middle) = ([pair[0], pair[1]], 0.5 * (pair[0] + pair[1]));
            while let Some(border) = coming.next_if(|b| b.z[0] <= z[0]) {
                active.push(*border);
            }
            active.retain(|b| b.z[1] >= z[1]);
            active.sort_by(|a, b| a.s(middle).total_cmp(&b.s(middle)));
            if active.len() >= 2 {
                bands.push(Self { z, borders: active.clone() });
            }
        }
        bands
    }

    fn pairs(&self) -> impl DoubleEndedIterator<Item = (&Border, &Border)> {
        self.borders.chunks_exact(2).map(|pair| (&pair[0], &pair[1]))
    }

    /// Damaged intervals of s at z, ascending.
    pub(super) fn chords(&self, z: f64) -> impl DoubleEndedIterator<Item = [f64; 2]> + '_ {
        self.pairs().map(move |(l, r)| [l.s(z), r.s(z)])
    }

    /// How much of the band's z is damaged at s, m.
    pub(super) fn covered(&self, s: f64) -> f64 {
        self.pairs().map(|(l, r)| long(both(l.before(s, self.z), r.after(s, self.z)))).sum()
    }

    /// Integral over what is damaged at s of min(floor, d^2 / (2 R)), m^2, d being the distance along s from the
    /// damage's end: the depth that a roller of relative radius R reaches over a floor that it would follow to the
    /// depth `floor` (m) if damage had no ends.
    pub(super) fn reached(&self, s: f64, floor: f64, radius: f64) -> f64 {
        let reach = (2.0 * radius * floor.max(0.0)).sqrt();
        let mut sum = 0.0;
        for (l, r) in self.pairs() {
            let range = both(l.before(s, self.z), r.after(s, self.z));
            if long(range) == 0.0 {
                continue;
            }
            sum += floor * long(range);
            let mut lose = |border: &Border, at: Range| {
                if long(at) > 0.0 {
                    sum -= floor * long(at) - border.squares(s, at) / (2.0 * radius);
                }
            };
            let (near_l, near_r) = (l.after(s - reach, range), r.before(s + reach, range));
            let shared = both(near_l, near_r);
            if long(shared) == 0.0 {
                lose(l, near_l);
                lose(r, near_r);
                continue;
            }
            for (border, near) in [(l, near_l), (r, near_r)] {
                lose(border, [near[0], shared[0]]);
                lose(border, [shared[1], near[1]]);
            }
            // Where both ends are in reach the nearer one acts.
            let right = |z: f64| 2.0 * s > l.s(z) + r.s(z);
            let [a, b] = shared;
            match (right(a), right(b)) {
                (false, false) => lose(l, shared),
                (true, true) => lose(r, shared),
                (first, _) => {
                    let (mut low, mut high) = (a, b);
                    loop {
                        let middle = 0.5 * (low + high);
                        if middle <= low || middle >= high {
                            break;
                        }
                        if right(middle) == first {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    let (below, above) = if first { (r, l) } else { (l, r) };
                    lose(below, [a, high]);
                    lose(above, [high, b]);
                }
            }
        }
        sum
    }

    /// The next z above z at which what is damaged at s begins or ends, or the band.
    pub(super) fn next(&self, s: f64, z: f64) -> f64 {
        let crosses = |b: &Border| {
            let (first, last) = (b.s(self.z[0]), b.s(self.z[1]));
            ((first - s) * (last - s) < 0.0).then(|| b.z(s))
        };
        let above = self.borders.iter().filter_map(crosses).filter(|at| *at > z);
        above.fold(self.z[1], f64::min)
    }

    /// The band of ascending ones that holds z.
    pub(super) fn at(bands: &[Self], z: f64) -> Option<&Self> {
        let band = bands.get(bands.partition_point(|b| b.z[1] <= z))?;
        (band.z[0] <= z).then_some(band)
    }

    /// s at which the covered length or, for a floor that is reached `reach` (m) from an end, the depth changes its
    /// form.
    pub(super) fn kinks(&self, reach: Option<f64>) -> Vec<f64> {
        let mut kinks = Vec::new();
        for (l, r) in self.pairs() {
            for z in self.z {
                let (a, b) = (l.s(z), r.s(z));
                kinks.extend([a, b]);
                if let Some(reach) = reach {
                    kinks.extend([a + reach, b - reach, 0.5 * (a + b)]);
                }
            }
        }
        kinks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const R: f64 = 3.367e-3;

    /// The definitions by the midpoint rule in z.
    fn tried(bands: &[Band], s: f64, floor: f64) -> (f64, f64) {
        const CELLS: u32 = 20_000;
        let (mut covered, mut reached) = (0.0, 0.0);
        for band in bands {
            let dz = (band.z[1] - band.z[0]) / f64::from(CELLS);
            for k in 0..CELLS {
                let z = band.z[0] + (f64::from(k) + 0.5) * dz;
                if let Some([a, b]) = band.chords(z).find(|[a, b]| (*a..=*b).contains(&s)) {
                    let d = (s - a).min(b - s);
                    covered += dz;
                    reached += dz * floor.min(d * d / (2.0 * R));
                }
            }
        }
        (covered, reached)
    }

    fn circle(radius: f64) -> Vec<Border> {
        let quadrant = |side: [f64; 2]| {
            let z = if side[1] > 0.0 { [0.0, radius] } else { [-radius, 0.0] };
            Border::arc([0.0, 0.0], [radius; 2], side, z).unwrap()
        };
        [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(quadrant).to_vec()
    }

    #[test]
    fn analytic_bands_of_a_circle_and_of_slanted_edges_agree_with_fine_sums() {
        let corners = [[-1.7, 0.15], [0.4, -0.65], [1.6, 0.9], [1.1, 2.75], [-0.3, 1.35], [-1.2, 2.4]]
            .map(|p: [f64; 2]| p.map(|x| 1e-3 * x));
        let slanted: Vec<Border> = (0..6).filter_map(|k| Border::straight(corners[k], corners[(k + 1) % 6])).collect();
        let cuts = [-3e-3, -0.4e-3, 0.3e-3, 1.7e-3, 3e-3];
        for borders in [circle(1.1e-3), slanted] {
            let bands = Band::all(&borders, &[], &cuts);
            for (k, floor) in [(0, 2e-6), (1, 20e-6), (2, 400e-6)] {
                for j in -9..=9 {
                    let s = 1.7e-4 * f64::from(j) + 3e-5 * f64::from(k);
                    let (covered, reached) = tried(&bands, s, floor);
                    let ours: f64 = bands.iter().map(|b| b.covered(s)).sum();
                    assert!((ours - covered).abs() < 1e-7, "at {s}: {ours} {covered}");
                    let ours: f64 = bands.iter().map(|b| b.reached(s, floor, R)).sum();
                    assert!((ours - reached).abs() < 1e-7 * floor.min(5e-5), "at {s}, floor {floor}: {ours} {reached}");
                }
            }
        }
    }
}
