//! The files of the studio's page, for a server, and what its charts have in common with those of the pages of runs.
//! The page itself is HTML, CSS and JavaScript; its README lists the modules.

/// A script.
const JS: &str = "text/javascript; charset=utf-8";

/// Name, type and content.
macro_rules! files {
    ($($name:literal: $kind:expr,)*) => {
        /// Every file of the page: its path from the page's root, its type and its content. The first is the page
        /// itself.
        pub const PAGE: &[(&str, &str, &[u8])] =
            &[$(($name, $kind, include_bytes!(concat!("../", $name)))),*];
    };
}

files! {
    "index.html": "text/html; charset=utf-8",
    "studio.css": "text/css; charset=utf-8",
    "src/answers.js": JS,
    "src/assets.js": JS,
    "src/chart.js": JS,
    "src/controls.js": JS,
    "src/curves.js": JS,
    "src/damage-panel.js": JS,
    "src/damage-tools.js": JS,
    "src/dom.js": JS,
    "src/engine.js": JS,
    "src/files.js": JS,
    "src/healthy.js": JS,
    "src/help.js": JS,
    "src/live.js": JS,
    "src/main.js": JS,
    "src/measured.js": JS,
    "src/message.js": JS,
    "src/notices.js": JS,
    "src/opening.js": JS,
    "src/pace.js": JS,
    "src/photo.js": JS,
    "src/player.js": JS,
    "src/raceway-draw.js": JS,
    "src/raceway-surface.js": JS,
    "src/raceway.js": JS,
    "src/readout.js": JS,
    "src/saving.js": JS,
    "src/schema.js": JS,
    "src/server-engine.js": JS,
    "src/shortcuts.js": JS,
    "src/side.js": JS,
    "src/start.js": JS,
    "src/state.js": JS,
    "src/stored.js": JS,
    "src/studio.js": JS,
    "src/tools.js": JS,
    "src/trace.js": JS,
    "src/views/bearing.js": JS,
    "src/views/curve-drawing.js": JS,
    "src/views/curve.js": JS,
    "src/views/face.js": JS,
    "src/views/motion.js": JS,
    "src/views/passage.js": JS,
    "src/views/pen.js": JS,
    "src/views/plot.js": JS,
    "src/views/scale.js": JS,
    "src/views/sound.js": JS,
    "src/views/theme.js": JS,
    "src/views/trace.js": JS,
    "src/views/view.js": JS,
    "src/worker-engine.js": JS,
    "src/worker.js": JS,
}

/// What every chart has in common, as a module; the pages of runs have it in their script.
pub const CHART: &str = include_str!("chart.js");

#[cfg(test)]
mod tests {
    use super::PAGE;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// Every script that lies there is served, and nothing else.
    #[test]
    fn prop_the_list_is_what_lies_there() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut found = BTreeSet::from(["index.html".to_owned(), "studio.css".to_owned()]);
        let mut folders = vec![root.join("src")];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
                match path.extension().and_then(|e| e.to_str()) {
                    _ if path.is_dir() => folders.push(path),
                    Some("js") => drop(found.insert(name)),
                    _ => {}
                }
            }
        }
        let listed: BTreeSet<String> = PAGE.iter().map(|(name, ..)| (*name).to_owned()).collect();
        assert_eq!(listed, found);
    }
}
