//! What the page offers before anything runs.

use crate::answers::{About, Example, Offered, Reply, Text};
use crate::report::{Answer, Trouble};
use crate::{pen, text};
use brinell::analysis::NAMED;
use brinell::bearing::catalogue;
use brinell::bearing::rating::normal_load;
use brinell::document::json_schema;
use brinell::scenario::Scenario;
use serde_json::Value;

/// Examples of the repository: name, text.
const EXAMPLES: [(&str, &str); 12] = [
    ("healthy", include_str!("../examples/healthy.toml")),
    ("rectangle", include_str!("../examples/rectangle.toml")),
    ("circle", include_str!("../examples/circle.toml")),
    ("irregular", include_str!("../examples/irregular.toml")),
    ("inner-race", include_str!("../examples/inner-race.toml")),
    ("roller", include_str!("../examples/roller.toml")),
    ("photo", include_str!("../examples/photo.toml")),
    ("scan", include_str!("../examples/scan.toml")),
    ("single-row", include_str!("../examples/single-row.toml")),
    ("run-up", include_str!("../examples/run-up.toml")),
    ("one-sided", include_str!("../examples/one-sided.toml")),
    ("ball-6205", include_str!("../examples/ball-6205.toml")),
];

/// Files that they name.
const FILES: [(&str, &[u8]); 2] = [
    ("photo-spall.png", include_bytes!("../examples/photo-spall.png")),
    ("scan.csv", include_bytes!("../examples/scan.csv")),
];

/// A file that the examples name: `photo-spall.png` or `scan.csv`.
pub fn example_file(name: &str) -> Option<&'static [u8]> {
    FILES.iter().find(|(n, _)| *n == name).map(|(_, bytes)| *bytes)
}

/// The answer to `about`.
pub(crate) fn about() -> Reply {
    let bearing = |entry: &'static catalogue::Entry| {
        let element = if entry.has_balls() { "ball" } else { "roller" };
        let alone = Scenario::of_bearing(&entry.name, 60.0, [1.0, 0.0]);
        let load_n = alone.ok().map(|of| normal_load(&of.bearing));
        Offered { name: &entry.name, words: &entry.title, element, load_n }
    };
    // Also those of data sets that are of a catalogued size, as 6205-2RS: a measured file may be of them.
    let named = NAMED.iter().map(|b| b.name).filter(|name| catalogue::find_exactly(name).is_none());
    Reply::About(About {
        version: brinell::VERSION,
        engine: if cfg!(target_family = "wasm") { "webassembly" } else { "native" },
        schema: json_schema(),
        bearings: catalogue::all().iter().map(bearing).collect(),
        known: catalogue::all().iter().map(|entry| entry.name.as_str()).chain(named).collect(),
        examples: EXAMPLES.map(|(name, text)| Example { name, words: words(text) }).into(),
    })
}

/// The answer to `example`: its text, with what its files hold, as a file of the same name beside another scenario is
/// another file.
pub(crate) fn example(request: &Value) -> Answer<Reply> {
    let name = request["name"].as_str().unwrap_or_default();
    let (_, text) = (EXAMPLES.iter().find(|(n, _)| *n == name))
        .ok_or_else(|| Trouble::of(format!("no example is named {name:?}")))?;
    let (_, toml) = pen::resolved(text::read(text)?, (*text).to_owned(), example_file)?;
    Ok(Reply::Example(Text { toml }))
}

/// The first sentence of the comment on top of an example.
fn words(text: &str) -> String {
    let comment: Vec<&str> = (text.lines()).map_while(|line| line.strip_prefix('#')).map(str::trim).collect();
    let comment = comment.join(" ");
    comment.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
