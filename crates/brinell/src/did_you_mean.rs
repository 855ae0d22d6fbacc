//! The known word that a misspelt one most likely meant.

/// The few of `known` bearings that are nearest to `word`, and how to see all.
pub(crate) fn nearest_few<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> String {
    const FEW: usize = 5;
    let mut known: Vec<&str> = known.collect();
    let word: String = word.chars().take(40).collect::<String>().to_uppercase();
    known.sort_by_cached_key(|candidate| strsim::damerau_levenshtein(&word, candidate));
    let few = known[..known.len().min(FEW)].join(", ");
    format!("{few} and others: `brinell bearing list` shows all")
}

/// The nearest of `known` to `word`, if any is near.
pub fn did_you_mean<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    nearest(word, &known.collect::<Vec<_>>())
}

fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    // Edit distance is quadratic: a word that long was never a misspelt key.
    const LONGEST: usize = 80;
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_lowercase().replace('-', "_");
    known
        .iter()
        .map(|&candidate| {
            let plain = candidate.to_lowercase().replace('-', "_");
            let stem = |a: &str, b: &str| a.len() >= 4 && b.starts_with(a);
            // Most often the unit is missing or another one: `load`, `speed_hz`.
            let distance =
                if stem(&word, &plain) || stem(&plain, &word) { 1 } else { strsim::damerau_levenshtein(&word, &plain) };
            (distance, plain.len().max(word.len()), candidate)
        })
        .filter(|(distance, length, _)| *distance <= (*length / 3).max(1))
        .min_by_key(|(distance, ..)| *distance)
        .map(|(.., candidate)| candidate)
}

/// The word used here for what others call `word`.
pub(crate) fn other_word(word: &str) -> Option<&'static str> {
    Some(match word.to_lowercase().as_str() {
        "polygon" | "polygons" | "poly" | "points" | "contour" => "outline",
        "square" => "rectangle",
        "disc" | "disk" => "circle",
        "photo" | "picture" | "mask" => "image",
        "drawing" => "svg",
        "scan" | "map" | "heights" => "depth_map",
        "sliced" | "strips" => "half-space",
        _ => return None,
    })
}

/// What to say of a bearing's bore or outside diameter, which nothing in the model is made of: the key of the raceway
/// that is meant, and what `word` is.
pub(crate) fn boundary_dimension(word: &str) -> Option<(&'static str, &'static str)> {
    let bare = word.to_lowercase();
    match bare.strip_suffix("_mm").unwrap_or(&bare) {
        "outer_diameter" | "outside_diameter" | "outer_ring_diameter" | "od" => {
            Some(("outer_raceway_diameter_mm", "outside diameter"))
        }
        "inner_diameter" | "inside_diameter" | "bore_diameter" | "inner_ring_diameter" | "bore" | "id" => {
            Some(("inner_raceway_diameter_mm", "bore"))
        }
        _ => None,
    }
}

/// What `word` requests that the model leaves out.
pub(crate) fn left_out(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    let has = |part: &str| word.contains(part);
    if has("contact_angle") {
        Some("a contact angle is left out: elements press radially, and the angle is 0")
    } else if has("preload") {
        Some("a preload is a negative clearance, such as bearing.radial_clearance_um = -2; an axial one is left out")
    } else if (has("axial") && (has("load") || has("force"))) || has("thrust") {
        Some("axial load is left out: the load is radial, and no part moves along the axis")
    } else if word == "sliced" || word == "strips" {
        Some("the laws by slices and strips are gone: \"half-space\" has damage of part of the width, too")
    } else if has("edge_reaction") || has("conservative") {
        Some(
            "damage pushes with a reaction on every body under contact.law = \"half-space\", and under \"ecl\" not at all",
        )
    } else if has("outer") && (has("speed") || has("rpm")) {
        Some("a turning outer ring is left out: the inner ring turns")
    } else {
        None
    }
}
