//! ARCHITECTURE.md against the code: which module of the engine uses which, which crate depends on which, and that no
//! modules of a crate use each other. The book's list of a run's numbers against the engine's. Files of tests against
//! the programs that run them.

use brinell::result::fields::{self, Field};
use brinell::signal::Indicator;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Uses = BTreeMap<String, BTreeSet<String>>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Rows of the table under a heading, as cells.
fn table(page: &str, heading: &str) -> Vec<Vec<String>> {
    let (_, from) = page.split_once(heading).expect(heading);
    let lines = from.lines().skip_while(|line| !line.starts_with('|'));
    let rows = lines.take_while(|line| line.starts_with('|')).skip(2);
    rows.map(|row| {
        let cells = row.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().to_owned()).collect()
    })
    .collect()
}

/// Text without comments and tests, which may use anything; strings that hold `//` do not matter here.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let text = text.split("#[cfg(test)]").next().unwrap_or("");
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

fn files(of: &Path) -> Vec<PathBuf> {
    if of.is_file() {
        return vec![of.to_owned()];
    }
    let entries = fs::read_dir(of).unwrap().map(|e| e.unwrap().path());
    entries.flat_map(|path| files(&path)).collect()
}

/// Names that follow `prefix` in the text, those in braces among them.
fn named(text: &str, prefix: &str) -> BTreeSet<String> {
    let name = |part: &str| part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut all = BTreeSet::new();
    for after in text.split(prefix).skip(1) {
        match after.strip_prefix('{') {
            Some(group) => {
                let group = group.split(';').next().unwrap_or("");
                all.extend(group.split([',', '{']).map(|part| name(part.trim_start())));
            }
            None => {
                all.insert(name(after));
            }
        }
    }
    all
}

/// Modules of a crate and what each names of the others, also by what the root gives on of them.
fn modules(src: &Path) -> Uses {
    let root = code(&src.join("lib.rs"));
    let mut given_on = BTreeMap::new();
    for after in root.split("use ").skip(1) {
        let used = after.split(';').next().unwrap_or("");
        if let Some((module, names)) = used.split_once("::") {
            let names = names.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|n| !n.is_empty());
            given_on.extend(names.map(|n| (n.to_owned(), module.to_owned())));
        }
    }
    let mut all = Uses::new();
    for path in fs::read_dir(src).unwrap().map(|e| e.unwrap().path()) {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if name == "lib" || name == "main" {
            continue;
        }
        let uses = all.entry(name).or_default();
        for file in files(&path).iter().filter(|f| f.extension().is_some_and(|e| e == "rs") && !f.ends_with("tests.rs"))
        {
            let text = code(file);
            uses.extend(named(&text, "crate::"));
            if path.is_file() {
                uses.extend(named(&text, "super::"));
            }
        }
    }
    let known: BTreeSet<String> = all.keys().cloned().collect();
    for (name, uses) in &mut all {
        let modules =
            uses.iter().map(|used| if known.contains(used) { used } else { given_on.get(used).unwrap_or(used) });
        *uses = modules.filter(|used| known.contains(*used) && *used != name).cloned().collect();
    }
    all
}

/// A cycle, if there is one.
fn cycle(uses: &Uses) -> Option<String> {
    let mut left = uses.clone();
    loop {
        let free = left.iter().find(|(_, uses)| !uses.iter().any(|u| left.contains_key(u)));
        let Some(name) = free.map(|(name, _)| name.clone()) else {
            return (!left.is_empty()).then(|| format!("{:?}", left.keys()));
        };
        left.remove(&name);
    }
}

#[test]
fn prop_architecture_says_which_module_uses_which() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let code = modules(&root().join("crates/brinell/src"));
    assert_eq!(cycle(&code), None, "modules that use each other");
    let mut told = Uses::new();
    for row in table(&page, "of `crates/brinell/src`") {
        let uses: BTreeSet<String> = (row.get(2).into_iter())
            .flat_map(|cell| cell.split(','))
            .map(|name| name.trim().to_owned())
            .filter(|name| code.contains_key(name))
            .collect();
        for name in row[0].split(',') {
            let name = name.trim().trim_matches('`').trim_end_matches('/').trim_end_matches(".rs");
            told.entry(name.to_owned()).or_default().extend(uses.clone());
        }
    }
    let names = |uses: &Uses| uses.keys().cloned().collect::<BTreeSet<_>>();
    assert_eq!(names(&told), names(&code), "modules in the table, and in the code");
    for (name, uses) in &code {
        let missing: Vec<_> = uses.difference(&told[name]).collect();
        let stale: Vec<_> = told[name].difference(uses).collect();
        assert!(
            missing.is_empty() && stale.is_empty(),
            "{name} uses {missing:?}, which ARCHITECTURE.md does not say; it says {stale:?}, which it does not use"
        );
    }
}

#[test]
fn prop_modules_of_no_crate_use_each_other() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let src = entry.unwrap().path().join("src");
        if src.join("lib.rs").exists() {
            assert_eq!(cycle(&modules(&src)), None, "modules of {} that use each other", src.display());
        }
    }
}

/// Tables without what each module uses: that they name all.
#[test]
fn prop_architecture_names_every_module() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    for name in ["brinell-io", "brinell-li2023", "brinell-report", "brinell-study"] {
        let src = root().join("crates").join(name).join("src");
        let told: BTreeSet<String> = (table(&page, &format!("of `crates/{name}/src`")).iter())
            .flat_map(|row| row[0].split(',').map(|n| n.trim().trim_matches('`').to_owned()).collect::<Vec<_>>())
            .filter(|n| n.ends_with(".rs") || n.ends_with('/'))
            .map(|n| n.trim_end_matches(".rs").trim_end_matches('/').to_owned())
            .collect();
        let there: BTreeSet<String> = modules(&src)
            .into_keys()
            .filter(|n| src.join(n).is_dir() || src.join(format!("{n}.rs")).exists())
            .collect();
        let missing: Vec<_> = there.difference(&told).collect();
        let stale: Vec<_> = told.difference(&there).collect();
        assert!(
            missing.is_empty() && stale.is_empty(),
            "{name}: not in ARCHITECTURE.md: {missing:?}; not there: {stale:?}"
        );
    }
}

#[test]
fn prop_architecture_says_which_crate_depends_on_which() {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows = table(&page, "# Architecture");
    let mut uses = Uses::new();
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let manifest = fs::read_to_string(path.join("Cargo.toml")).unwrap();
        let ours = manifest.lines().filter(|line| line.starts_with("brinell"));
        let ours = ours.map(|line| line.split(['.', ' ', '=']).next().unwrap_or("").to_owned());
        uses.insert(name.clone(), ours.collect());
        let row = rows.iter().find(|row| row[0].split('`').any(|part| part == format!("crates/{name}")));
        let row = row.unwrap_or_else(|| panic!("crates/{name} is not in the table of ARCHITECTURE.md"));
        let said = &row[2];
        for used in &uses[&name] {
            let whole = said.starts_with("all ");
            assert!(
                whole || said.contains(&format!("`crates/{used}`")),
                "{name} depends on {used}; ARCHITECTURE.md says: {said}"
            );
        }
        let stale =
            said.split('`').filter_map(|part| part.strip_prefix("crates/")).find(|part| !uses[&name].contains(*part));
        assert_eq!(stale, None, "{name} does not depend on it");
    }
    assert_eq!(cycle(&uses), None, "crates that depend on each other");
}

/// Cargo finds no test by itself where a crate names its test programs: a file that none of them holds would never run.
#[test]
fn prop_every_file_of_tests_is_run() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let path = entry.unwrap().path();
        let manifest = fs::read_to_string(path.join("Cargo.toml")).unwrap();
        if !manifest.contains("autotests = false") {
            continue;
        }
        let all = fs::read_to_string(path.join("tests/all.rs")).unwrap();
        for entry in fs::read_dir(path.join("tests")).unwrap() {
            let file = entry.unwrap().path();
            let name = file.file_stem().unwrap().to_str().unwrap();
            let is_test = file.extension().is_some_and(|e| e == "rs");
            assert!(
                !(is_test || file.join("mod.rs").exists())
                    || all.contains(&format!("mod {name};\n"))
                    || manifest.contains(&format!("path = \"tests/{name}.rs\"")),
                "{} is in no test program: add `mod {name};` to all.rs",
                file.display()
            );
        }
    }
}

/// Rows of the book's table.
fn rows<F>(subject: &str, list: &[Field<F>]) -> Vec<String> {
    let row = |f: &Field<F>| {
        let interval = if f.estimator.has_interval() { "95 %" } else { "" };
        let estimator = format!("{:?}", f.estimator).to_lowercase();
        let meaning = f.meaning.replace('|', "\\|");
        format!("| `{subject}{}` | {} | {meaning} | {estimator} | {interval} |\n", f.name, f.unit)
    };
    list.iter().map(row).collect()
}

#[test]
fn regress_the_book_lists_every_number() {
    let unit = "of the channel";
    let all = [
        rows("CHANNEL.", &Indicator::ALL.map(|i| fields::indicator(i, unit))),
        rows("CHANNEL.", &fields::record(unit)),
        rows("envelope.", fields::LINES),
        rows("defectN.", fields::DEFECT),
        rows("defectN.", fields::IMPACTS),
        rows("rowN.", fields::SLIP),
        rows("rowN.", fields::LOAD),
        rows("audit.", fields::AUDITS),
        rows("work.", fields::WORK),
        rows("", fields::ANALYSED),
        rows("", fields::COURSE),
    ];
    let all = all.concat();
    let mut once: Vec<&String> = all.iter().collect();
    once.sort();
    once.dedup();
    assert_eq!(once.len(), all.len(), "every name is there once");
    let page = fs::read_to_string(root().join("docs/src/results/numbers.md")).unwrap();
    let table = all.concat();
    assert!(page.contains(&table), "docs/src/results/numbers.md should hold\n{table}");
}
