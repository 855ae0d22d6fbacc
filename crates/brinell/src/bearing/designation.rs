//! Names of bearings as people write them: `NU 206 ECP`, `nu206`, `6205-2RS`, `SKF 6205 2RSH/C3`.
//!
//! A designation is a series and a size (letters, then digits), and suffixes for cage, seals, clearance and the like,
//! which do not change the bearing's inner geometry. The class of clearance among them is reported, because it does
//! change the clearance.

/// Makers, whose names may be in front.
const MAKERS: [&str; 17] = [
    "SKF",
    "FAG",
    "INA",
    "NSK",
    "NTN",
    "SNR",
    "KOYO",
    "NACHI",
    "TIMKEN",
    "LDK",
    "REXNORD",
    "ZKL",
    "RHP",
    "SCHAEFFLER",
    "MB",
    "FYH",
    "ASAHI",
];

/// Letters and digits, the letters large.
pub(super) fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| c.is_alphanumeric());
    kept.flat_map(char::to_uppercase).collect()
}

/// Series and size with what follows them: `NU206` and ` ECP`. Several readings, the likeliest first; none where the
/// name is no designation.
pub(super) fn readings(name: &str) -> Vec<(String, String)> {
    let name = name.trim().to_uppercase();
    let mut rest = name.as_str();
    for maker in MAKERS {
        if let Some(after) = rest.strip_prefix(maker)
            && !after.starts_with(char::is_alphabetic)
        {
            rest = after;
        }
    }
    let letters: String = rest.chars().filter(|c| !is_gap(*c)).take_while(|c| c.is_ascii_alphabetic()).collect();
    let mut at = 0;
    let mut left = letters.len();
    for (k, c) in rest.char_indices() {
        if left == 0 && !is_gap(c) {
            at = k;
            break;
        }
        left -= usize::from(!is_gap(c));
        at = k + c.len_utf8();
    }
    let digits = rest[at..].bytes().take_while(u8::is_ascii_digit).count();
    let suffix = &rest[at + digits..];
    let size = &rest[at..at + digits];
    let mut found = Vec::new();
    if digits > 0 && is_suffix(suffix) {
        found.push((format!("{letters}{size}"), suffix.to_owned()));
    }
    // Seals and shields on both sides, written without a gap: 62052RS.
    if let Some(shorter) = size.strip_suffix('2')
        && suffix.starts_with(['R', 'Z'])
    {
        found.push((format!("{letters}{shorter}"), format!("2{suffix}")));
    }
    found
}

pub(super) fn is_gap(c: char) -> bool {
    c.is_whitespace() || matches!(c, '-' | '.' | '_')
}

/// What follows a size without changing it: letters first, or the number of seals.
fn is_suffix(text: &str) -> bool {
    let bare = text.trim_start_matches(|c| is_gap(c) || c == '/');
    let seals = bare.strip_prefix('2').is_some_and(|after| after.starts_with(['R', 'Z', 'L', 'N']));
    let letters = bare.is_empty() || seals || bare.starts_with(|c: char| c.is_ascii_alphabetic());
    // C1 to C5 are classes of clearance; C9 and C33 are slips of the finger.
    let no_class =
        |word: &str| matches!(word.as_bytes(), [b'C', b'0' | b'6'..=b'9'] | [b'C', b'2'..=b'5', b'0'..=b'9']);
    letters && !words(text).any(no_class)
}

/// Suffixes between gaps and slashes.
pub(super) fn words(suffix: &str) -> impl Iterator<Item = &str> {
    suffix.split(|c: char| is_gap(c) || c == '/')
}

/// The name with the digit in place of each letter O behind its first digit: `NU2O6`, `62O5`. `None` where there is
/// none.
pub(super) fn with_zeros(name: &str) -> Option<String> {
    let size = name.find(|c: char| c.is_ascii_digit())?;
    let (series, rest) = name.split_at(size);
    rest.contains(['O', 'o']).then(|| format!("{series}{}", rest.replace(['O', 'o'], "0")))
}

/// The type of bearing that a designation's series means, by ISO and DIN's systems; `None` where it is none of these.
pub(super) fn kind(name: &str) -> Option<&'static str> {
    let (base, _) = readings(name).into_iter().next()?;
    let (letters, size) = base.split_at(base.find(|c: char| c.is_ascii_digit())?);
    let two = size.get(..2)?;
    Some(match (letters, size.len(), two) {
        ("NA" | "RNA" | "NK" | "NKI" | "HK" | "BK", ..) => "needle roller bearing",
        ("ER" | "UER" | "UEL" | "YAR" | "YEL", ..) => "insert ball bearing",
        (letters, ..) if letters.starts_with("UC") => "insert ball bearing",
        ("QJ", ..) => "four-point contact ball bearing",
        (letters, ..) if letters.starts_with('N') => "cylindrical roller bearing",
        ("", 4, "32" | "33" | "52" | "53") => "double row angular contact ball bearing",
        ("", 4, "10" | "11" | "12" | "13" | "22" | "23") => "self-aligning ball bearing",
        ("", 4 | 5, _) if size.starts_with('7') => "angular contact ball bearing",
        ("", 4 | 5, _) if size.starts_with('6') || (two == "16" && size.len() == 5) => "deep groove ball bearing",
        ("", 3, _) if size.starts_with('6') => "miniature deep groove ball bearing",
        ("", 5, "21" | "22" | "23" | "24") => "spherical roller bearing",
        ("", 5, "29") => "spherical roller thrust bearing",
        ("", 5, "30" | "31" | "32" | "33") => "tapered roller bearing",
        ("", 5, "51" | "52" | "53" | "54") => "thrust ball bearing",
        ("", 5, "81" | "87" | "89") => "cylindrical roller thrust bearing",
        _ => return None,
    })
}

/// Whether two names may be meant for each other: not where their types are known, and different.
pub(super) fn of_one_kind(name: &str, other: &str) -> bool {
    kind(name).is_none_or(|known| kind(other) == Some(known))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bearing::clearance::{ClearanceClass, clearance_of};

    #[test]
    fn prop_designations_are_read_however_they_are_written() {
        for (name, base) in [
            ("NU206", "NU206"),
            ("nu 206 ecp", "NU206"),
            ("SKF NU 206 ECP", "NU206"),
            ("FAG NU206-E-XL-TVP2", "NU206"),
            ("NU-206-EM1", "NU206"),
            ("6205", "6205"),
            ("6205-2RS", "6205"),
            ("6205 2RSH/C3", "6205"),
            ("6205-2Z/C3WT", "6205"),
            ("6205/C3", "6205"),
            ("NN 3007 KTN/SP", "NN3007"),
            ("NICE", ""),
        ] {
            let read = readings(name).into_iter().next().unwrap_or_default();
            assert_eq!(read.0, base, "{name}");
        }
        assert_eq!(readings("62052RS")[1].0, "6205");
        // Another bore, and another bearing.
        assert!(readings("UC204-12").is_empty());
        assert!(readings("6205-C33").is_empty() && !readings("6205-C3").is_empty());
        assert_eq!(readings("NUP 206 ECP")[0].0, "NUP206");
        for name in ["", "-", " 2", "\u{b5}2\u{1f600}", "SKF", "2RS"] {
            let _ = readings(name);
        }
    }

    #[test]
    fn lit_series_have_their_types() {
        // Designations of SKF's and Schaeffler's catalogues.
        for (names, known) in [
            (&["7205", "SKF 7205 BECBP", "71905"][..], Some("angular contact ball bearing")),
            (&["3205 A"], Some("double row angular contact ball bearing")),
            (&["1205", "2205 E-2RS1TN9"], Some("self-aligning ball bearing")),
            (&["22205 E", "FAG 23024-E1A-M"], Some("spherical roller bearing")),
            (&["30205", "32005 X", "33205"], Some("tapered roller bearing")),
            (&["51105"], Some("thrust ball bearing")),
            (&["81105 TN"], Some("cylindrical roller thrust bearing")),
            (&["29412 E"], Some("spherical roller thrust bearing")),
            (&["6205-2RS", "16005", "61905"], Some("deep groove ball bearing")),
            (&["608-2Z", "626"], Some("miniature deep groove ball bearing")),
            (&["NUP 206 ECP", "NN3007", "N 205"], Some("cylindrical roller bearing")),
            (&["NA4905"], Some("needle roller bearing")),
            (&["UC205", "UER204"], Some("insert ball bearing")),
            (&["NICE", "ZA-2115", "9999", "", "7"], None),
        ] {
            for name in names {
                assert_eq!(kind(name), known, "{name}");
            }
        }
    }

    #[test]
    fn prop_the_letter_o_is_read_as_the_digit_in_a_size_alone() {
        for (name, meant) in [
            ("62O5", Some("6205")),
            ("KOYO nu2o6", Some("KOYO nu206")),
            ("NN3OO7", Some("NN3007")),
            ("6205", None),
            ("KOYO", None),
        ] {
            assert_eq!(with_zeros(name).as_deref(), meant, "{name}");
        }
    }

    #[test]
    fn prop_the_class_of_clearance_is_found_among_suffixes() {
        for (name, class) in [
            ("6205 2RSH/C3", Some(ClearanceClass::C3)),
            ("6205-2Z/C3WT", Some(ClearanceClass::C3)),
            ("NU 206 ECP/C4", Some(ClearanceClass::C4)),
            ("NU206-C3", Some(ClearanceClass::C3)),
            ("6205ZZC3", Some(ClearanceClass::C3)),
            ("NSK 6205DDUC3", Some(ClearanceClass::C3)),
            ("6205LLUC3/5K", Some(ClearanceClass::C3)),
            ("6205-2RSC4", Some(ClearanceClass::C4)),
            ("6205CN", Some(ClearanceClass::CN)),
            ("6205TCN", None),
            ("6205/HC5", None),
            ("NU206 CC3", None),
            ("6205/C3VC244", Some(ClearanceClass::C3)),
            ("6205TCNC3", Some(ClearanceClass::C3)),
            ("6205C2HRS", None),
            ("6205", None),
            ("NU 206 ECP", None),
            ("6205/P63", Some(ClearanceClass::C3)),
            ("6205-2Z/P62", Some(ClearanceClass::C2)),
            ("6205/P6", None),
        ] {
            assert_eq!(clearance_of(name), class, "{name}");
        }
    }
}
