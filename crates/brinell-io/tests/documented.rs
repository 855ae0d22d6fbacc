//! Lists of formats in the documentation against the formats that are read.

use brinell_io::FileKind;
use std::fs;
use std::path::Path;

/// By one of its extensions, in capitals or not, as a word of the line.
#[test]
fn prop_lists_of_formats_name_every_format() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for (page, start) in [
        ("docs/src/studio.md", "*Open* takes a file of signals too"),
        ("python/brinell/signals.py", "One channel of a measured signal's file:"),
    ] {
        let text = fs::read_to_string(root.join(page)).unwrap();
        let line = text.lines().find(|line| line.contains(start)).unwrap_or_else(|| panic!("{page}: {start}"));
        let words: Vec<String> = line.split(|c: char| !c.is_alphanumeric()).map(str::to_lowercase).collect();
        for extensions in FileKind::extensions_by_format() {
            let is_there = extensions.iter().any(|e| words.iter().any(|word| word == e));
            assert!(is_there, "{page} names no format of {extensions:?}: {line}");
        }
    }
}
