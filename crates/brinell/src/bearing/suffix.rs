//! Suffixes of designations that makers have: seals, cages, classes of clearance and tolerance, greases, bores.
//!
//! From the tables of supplementary designations in the catalogues of SKF, Schaeffler, NSK and NTN. None of them
//! changes the inner geometry; what is not here may be a slip of the finger, or another bearing.

/// As they are written, one after the other where several are in a word: `ZZC3`, `2RS1TN9`. A suffix of seals may have
/// a 2 before it.
const KNOWN: &[&str] = &[
    // Seals and shields.
    "RS", "RS1", "RS2", "RSH", "RSL", "RSR", "RSJ", "RST", "RZ", "ZZ", "ZR", "HRS", "LS", "LU", "LLU", "LLB", "LLH",
    "DDU", "DD", "DU", "VV", "NSE", "NSL", "NKE", "ZS", "ZN", "ZNR", "EE", // Snap rings, rows and rings.
    "NR", "DB", "DF", "DT", "W33", "W20", // Inner design and cages.
    "EC", "ECP", "ECJ", "ECM", "ECMA", "ECML", "ECPH", "EW", "ET", "ETN", "ETN9", "EG", "EM", "EMA", "EJ", "JEM", "MA",
    "MB", "ML", "PH", "PP", "TN", "TN9", "TNH", "TNG", "TVP", "TVP2", "TVPB", "TVH", "T2X", "T2", "TCN", "FA", "XL",
    "KTN", "KTN9", "CM", "CN", "CC3", // Tolerances, heat treatment, greases; those with numbers are below.
    "SP", "UP", "HT", "HTF", "MT", "WT", "GJN", "LHT", "LT", "GE", "5K",
];
/// Single letters, with nothing but a number behind them: any word is made of letters.
const LETTERS: &[u8] = b"ABCDEFHJKLMNPTVXYZ";
/// Letters that digits follow: classes of clearance and tolerance, variants, coatings, greases.
const NUMBERED: &[&str] = &["C", "P", "S", "G", "VA", "VC", "VE", "VL", "VG", "VT", "HC", "HA", "HB", "MT", "EM", "L"];

/// Whether a word behind a size is made of suffixes.
pub(super) fn is_known_suffix(word: &str) -> bool {
    let goes_on = |rest: &str| rest.is_empty() || is_known_suffix(rest);
    let by_name = |known: &str| word.strip_prefix(known).is_some_and(goes_on);
    let seals = word.strip_prefix('2').is_some_and(|rest| rest.starts_with(['R', 'Z', 'L', 'N', 'H']) && goes_on(rest));
    let by_letter = word.as_bytes().split_first().is_some_and(|(letter, rest)| {
        LETTERS.contains(letter) && (rest.is_empty() || numbered(&word[1..]).is_some_and(goes_on))
    });
    word.is_empty() || seals || by_letter || KNOWN.iter().any(|k| by_name(k)) || numbered(word).is_some_and(goes_on)
}

/// What is behind letters with a number.
fn numbered(word: &str) -> Option<&str> {
    NUMBERED.iter().filter_map(|letters| word.strip_prefix(letters)).find_map(|rest| {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        (1..=4).contains(&digits).then(|| &rest[digits..])
    })
}

#[cfg(test)]
mod tests {
    use crate::bearing::KnownBearing;

    /// Designations as they stand in the makers' catalogues.
    #[test]
    fn lit_suffixes_of_makers_are_known() {
        for name in [
            "6205",
            "6205-2RSH/C3",
            "6205-2Z/C3WT",
            "SKF 6205-2RS1TN9/C3VT162",
            "NSK 6205DDUC3",
            "NSK 6205ZZC3",
            "6205LLUC3/5K",
            "FAG 6205-C-2HRS-C3",
            "FAG 6205-2RSR-C3",
            "NU 206 ECP",
            "FAG NU206-E-XL-TVP2",
            "NU-206-EM1",
            "NU 206 ECML/C4",
            "6205 N",
            "6205-2RS",
            "62052RS",
            "6205/P6",
            "6205TCN",
            "6205-RZ",
            "6205 ETN9",
            "nu206ecj",
        ] {
            assert_eq!(KnownBearing::unknown_suffix(name), None, "{name}");
        }
        for (name, unknown) in [("6205XYZZY", "XYZZY"), ("6205-2RS/QUX", "QUX"), ("SKF 6205 WRONG", "WRONG")] {
            assert_eq!(KnownBearing::unknown_suffix(name).as_deref(), Some(unknown), "{name}");
        }
    }
}
