//! Radial internal clearance of cylindrical roller and of deep-groove ball bearings with a cylindrical bore: the
//! classes of ISO 5753-1.
//!
//! All values are diametral, as the standard and every catalogue give them. `bearing.radial_clearance_um` (C_r of the
//! model) is the gap on one side, half of that. They hold for the bearing before it is mounted: interference fits and a
//! warm inner ring make the clearance smaller.
//!
//! Source: ISO 5753-1:2009, radial internal clearance of cylindrical roller bearings with cylindrical bore, as
//! tabulated at original-bearing.com, article s103; C2 to C4 compared with ahrinternational.com, bearing clearance.
//! Deep-groove ball bearings as tabulated at bmzbearings.com, technical data 4, and the bore of 100 mm at
//! en.shjfbearing.com, news 2525, which agree elsewhere but for misprints.

use super::catalogue;
use super::designation::{readings, words};
use crate::scenario::{Bearing, Choice, Element, words};

words! { ClearanceClass:
    CN = "CN", "normal";
    C2 = "C2", "less than CN";
    C3 = "C3", "more than CN";
    C4 = "C4", "more than C3";
    C5 = "C5", "more than C4";
}

/// A class of radial internal clearance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClearanceClass {
    /// Less than normal.
    C2,
    /// Normal.
    CN,
    /// More than normal.
    C3,
    /// More than C3.
    C4,
    /// More than C4.
    C5,
}

impl ClearanceClass {
    /// All of them, from the smallest clearance to the largest.
    pub const ALL: [Self; 5] = [Self::C2, Self::CN, Self::C3, Self::C4, Self::C5];

    /// Its name in the standard.
    pub fn name(self) -> &'static str {
        self.word()
    }

    /// Smallest and largest diametral clearance (um) for a bore (mm); `None` outside the table, which ends at
    /// [`largest_bore_mm`].
    pub fn limits(self, of: Element, bore_mm: f64) -> Option<[f64; 2]> {
        let row = table(of).iter().find(|row| bore_mm > 0.0 && bore_mm <= f64::from(row.0))?;
        Some(row.1[self as usize].map(f64::from))
    }

    /// The middle of the class on one side (um): a quarter of the sum of its limits.
    pub fn one_sided_middle(self, of: Element, bore_mm: f64) -> Option<f64> {
        self.limits(of, bore_mm).map(|[low, high]| 0.25 * (low + high))
    }
}

/// The classes that hold a diametral clearance (um) for a bore (mm). They overlap, so there may be two; none beyond the
/// table.
pub fn classes_of(of: Element, bore_mm: f64, diametral_um: f64) -> Vec<ClearanceClass> {
    let holds = |class: &ClearanceClass| {
        class.limits(of, bore_mm).is_some_and(|[low, high]| (low..=high).contains(&diametral_um))
    };
    ClearanceClass::ALL.into_iter().filter(holds).collect()
}

/// The class of radial clearance that a name's suffixes give: `C3` of `6205-2RSH/C3` and `6205ZZC3`.
pub fn clearance_of(name: &str) -> Option<ClearanceClass> {
    let (_, suffix) = readings(name).into_iter().next()?;
    words(&suffix).find_map(|word| match word {
        // Class of tolerance and of clearance in one (SKF General catalogue, p. 301).
        "P52" | "P62" => Some(ClearanceClass::C2),
        "P63" => Some(ClearanceClass::C3),
        _ => (0..word.len()).find_map(|at| class_at(word, at)),
    })
}

/// The class that a word of suffixes names at a place.
fn class_at(word: &str, at: usize) -> Option<ClearanceClass> {
    let rest = word.get(at..)?;
    let class = ClearanceClass::ALL.into_iter().find(|class| rest.starts_with(class.name()))?;
    let after = &rest[class.name().len()..];
    let other = match class {
        // Letters of something else.
        ClearanceClass::CN => at > 0,
        // FAG's generation C with seals: C2HRS, C2Z.
        ClearanceClass::C2 => after.starts_with(['R', 'Z', 'H']),
        _ => false,
    };
    // HC5: SKF's hybrid bearings; CC3: NSK's classes without interchange; VC244: a variant. Letters of the grease may
    // follow a class: C3WT.
    let part_of_other = word[..at].ends_with(['H', 'C', 'V']);
    (!other && !part_of_other && !after.starts_with(|c: char| c.is_ascii_digit())).then_some(class)
}

/// Bore diameter of a bearing (mm): its own key, else that of its preset.
pub fn bore_diameter_mm(bearing: &Bearing) -> Option<f64> {
    let of_preset = || catalogue::find(bearing.preset.as_deref()?)?.fact(catalogue::BORE);
    bearing.bore_diameter_mm.or_else(of_preset)
}

/// Largest bore of the tables, mm.
pub fn largest_bore_mm(of: Element) -> u16 {
    table(of).last().map_or(0, |row| row.0)
}

/// Limits of the classes in um, C2 to C5, up to and including a bore in mm.
type Row = (u16, [[u16; 2]; 5]);

fn table(of: Element) -> &'static [Row] {
    match of {
        Element::Roller => &ROLLERS,
        Element::Ball => &BALLS,
    }
}

#[rustfmt::skip]
const BALLS: [Row; 9] = [
    (10, [[0, 7], [2, 13], [8, 23], [14, 29], [20, 37]]),
    (18, [[0, 9], [3, 18], [11, 25], [18, 33], [25, 45]]),
    (24, [[0, 10], [5, 20], [13, 28], [20, 36], [28, 48]]),
    (30, [[1, 11], [5, 20], [13, 28], [23, 41], [30, 53]]),
    (40, [[1, 11], [6, 20], [15, 33], [28, 46], [40, 64]]),
    (50, [[1, 11], [6, 23], [18, 36], [30, 51], [45, 73]]),
    (65, [[1, 15], [8, 28], [23, 43], [38, 61], [55, 90]]),
    (80, [[1, 15], [10, 30], [25, 51], [46, 71], [65, 105]]),
    (100, [[1, 18], [12, 36], [30, 58], [53, 84], [75, 120]]),
];

#[rustfmt::skip]
const ROLLERS: [Row; 26] = [
    (24, [[0, 25], [20, 45], [35, 60], [50, 75], [65, 90]]),
    (30, [[0, 25], [20, 45], [35, 60], [50, 75], [70, 95]]),
    (40, [[5, 30], [25, 50], [45, 70], [60, 85], [80, 105]]),
    (50, [[5, 35], [30, 60], [50, 80], [70, 100], [95, 125]]),
    (65, [[10, 40], [40, 70], [60, 90], [80, 110], [110, 140]]),
    (80, [[10, 45], [40, 75], [65, 100], [90, 125], [130, 165]]),
    (100, [[15, 50], [50, 85], [75, 110], [105, 140], [155, 190]]),
    (120, [[15, 55], [50, 90], [85, 125], [125, 165], [180, 220]]),
    (140, [[15, 60], [60, 105], [100, 145], [145, 190], [200, 245]]),
    (160, [[20, 70], [70, 120], [115, 165], [165, 215], [225, 275]]),
    (180, [[25, 75], [75, 125], [120, 170], [170, 220], [250, 300]]),
    (200, [[35, 90], [90, 145], [140, 195], [195, 250], [275, 330]]),
    (225, [[45, 105], [105, 165], [160, 220], [220, 280], [305, 365]]),
    (250, [[45, 110], [110, 175], [170, 235], [235, 300], [330, 395]]),
    (280, [[55, 125], [125, 195], [190, 260], [260, 330], [370, 440]]),
    (315, [[55, 130], [130, 205], [200, 275], [275, 350], [410, 485]]),
    (355, [[65, 145], [145, 225], [225, 305], [305, 385], [455, 535]]),
    (400, [[100, 190], [190, 280], [280, 370], [370, 460], [510, 600]]),
    (450, [[110, 210], [210, 310], [310, 410], [410, 510], [565, 665]]),
    (500, [[110, 220], [220, 330], [330, 440], [440, 550], [625, 735]]),
    (560, [[120, 240], [240, 360], [360, 480], [480, 600], [690, 810]]),
    (630, [[140, 260], [260, 380], [380, 500], [500, 620], [780, 900]]),
    (710, [[145, 285], [285, 425], [425, 565], [565, 705], [865, 1005]]),
    (800, [[150, 310], [310, 470], [470, 630], [630, 790], [975, 1135]]),
    (900, [[180, 350], [350, 520], [520, 690], [690, 860], [1095, 1265]]),
    (1000, [[200, 390], [390, 580], [580, 770], [770, 960], [1215, 1405]]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lit_clearance_classes_of_common_bores() {
        // ISO 5753-1 as printed in makers' catalogues.
        for (class, bore, limits) in [
            (ClearanceClass::C2, 30.0, [0.0, 25.0]),
            (ClearanceClass::CN, 30.0, [20.0, 45.0]),
            (ClearanceClass::C3, 30.0, [35.0, 60.0]),
            (ClearanceClass::C4, 30.0, [50.0, 75.0]),
            (ClearanceClass::CN, 24.0, [20.0, 45.0]),
            (ClearanceClass::C3, 30.1, [45.0, 70.0]),
            (ClearanceClass::C3, 100.0, [75.0, 110.0]),
            (ClearanceClass::C5, 1000.0, [1215.0, 1405.0]),
        ] {
            assert_eq!(class.limits(Element::Roller, bore), Some(limits), "{class:?} at {bore} mm");
        }
        for bore in [0.0, -1.0, 1000.1, f64::NAN] {
            assert_eq!(ClearanceClass::CN.limits(Element::Roller, bore), None);
        }
        assert_eq!(ClearanceClass::CN.one_sided_middle(Element::Roller, 30.0), Some(16.25));
    }

    #[test]
    fn lit_clearance_classes_of_ball_bearings() {
        for (class, bore, limits) in [
            (ClearanceClass::CN, 17.0, [3.0, 18.0]),
            (ClearanceClass::CN, 25.0, [5.0, 20.0]),
            (ClearanceClass::C3, 30.0, [13.0, 28.0]),
            (ClearanceClass::C3, 31.0, [15.0, 33.0]),
        ] {
            let ours = class.limits(Element::Ball, bore);
            assert_eq!(ours, Some(limits), "{class:?} at {bore} mm");
        }
        assert_eq!(largest_bore_mm(Element::Ball), 100);
        assert_eq!(largest_bore_mm(Element::Roller), 1000);
    }

    #[test]
    fn prop_classes_and_bores_rise() {
        for (rows, k) in [&ROLLERS[..], &BALLS[..]].into_iter().flat_map(|rows| (0..rows.len()).map(move |k| (rows, k)))
        {
            let (bore, classes) = &rows[k];
            assert!(classes.iter().all(|[low, high]| low < high), "{bore}");
            assert!(classes.windows(2).all(|w| w[0][0] < w[1][0] && w[0][1] < w[1][1]), "{bore}");
            if k > 0 {
                let (before, smaller) = rows[k - 1];
                assert!(before < *bore);
                let no_less = |a: &[u16; 2], b: &[u16; 2]| a[0] <= b[0] && a[1] <= b[1];
                assert!(smaller.iter().zip(classes).all(|(a, b)| no_less(a, b)));
            }
        }
    }

    #[test]
    fn prop_a_clearance_is_found_in_its_classes() {
        use ClearanceClass::{C2, C3, CN};
        assert_eq!(classes_of(Element::Roller, 30.0, 32.5), [CN]);
        assert_eq!(classes_of(Element::Roller, 30.0, 22.0), [C2, CN]);
        assert_eq!(classes_of(Element::Roller, 30.0, 40.0), [CN, C3]);
        assert_eq!(classes_of(Element::Roller, 30.0, 96.0), []);
        assert_eq!(classes_of(Element::Roller, 2000.0, 30.0), []);
    }
}
