//! ARCHITECTURE.md against the code: which module of the engine uses which, which crate depends on which, and that no
//! files or modules of a crate use each other. The book's list of a run's numbers against the engine's. Files of tests against
//! the programs that run them.

use brinell::result::fields::{self, Field};
use brinell::result::names;
use brinell::scenario::Scenario;
use brinell::signal::Indicator;
use brinell::simulate::Simulation;
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
    let tests =
        text.match_indices("#[cfg(test)]\nmod ").find(|(k, _)| text[*k..].lines().nth(1).unwrap().ends_with('{'));
    let lines = text[..tests.map_or(text.len(), |(k, _)| k)].lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

fn files(of: &Path) -> Vec<PathBuf> {
    files_but(of, &[])
}

/// The files in a folder, without those in folders of these names.
fn files_but(of: &Path, left_out: &[&str]) -> Vec<PathBuf> {
    if of.is_file() {
        return vec![of.to_owned()];
    }
    let entries = fs::read_dir(of).unwrap().map(|e| e.unwrap().path());
    let wanted = entries.filter(|path| !left_out.iter().any(|name| path.ends_with(name)));
    wanted.flat_map(|path| files_but(&path, left_out)).collect()
}

/// The paths of a `use`: `a::{b, c::{d}}` is `a::b` and `a::c::d`.
fn paths(used: &str) -> Vec<String> {
    let used = used.trim();
    let Some((before, group)) = used.split_once('{') else {
        return vec![used.to_owned()];
    };
    let group = group.trim_end().trim_end_matches('}');
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in group.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        match c {
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().unwrap().push(c),
        }
    }
    // The brace that closes an inner group may have been taken with the outer one.
    parts.last_mut().unwrap().push_str(&"}".repeat(depth.max(0) as usize));
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| paths(part)).map(|path| format!("{before}{path}")).collect()
}

/// The files of a crate by the path of their module.
struct Sources(BTreeMap<Vec<String>, Source>);

struct Source {
    /// What is imported, by the name that it has here.
    imports: Vec<(String, String)>,
    /// What is handed on, the same.
    exports: Vec<(String, String)>,
    /// Paths within the code.
    paths: BTreeSet<String>,
}

impl Source {
    fn of(text: &str) -> Self {
        let mut source = Self { imports: Vec::new(), exports: Vec::new(), paths: BTreeSet::new() };
        let mut statement = String::new();
        for line in text.lines() {
            let start = line.trim_start();
            let uses = start.starts_with("use ") || (start.starts_with("pub") && start.contains(" use "));
            if !uses && statement.is_empty() {
                source.paths.extend(
                    line.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':')
                        .map(|word| word.trim_end_matches(':').to_owned())
                        .filter(|word| word.contains("::")),
                );
                continue;
            }
            statement.push_str(start);
            statement.push(' ');
            if !start.ends_with(';') {
                continue;
            }
            let (visibility, used) = statement.split_once("use ").unwrap();
            let list = if visibility.is_empty() { &mut source.imports } else { &mut source.exports };
            for path in paths(used.trim_end().trim_end_matches(';')) {
                let (path, name) = path.split_once(" as ").unwrap_or((&path, path.rsplit("::").next().unwrap()));
                list.push((name.trim().to_owned(), path.trim_end_matches("::self").to_owned()));
            }
            statement.clear();
        }
        source
    }
}

impl Sources {
    fn of(src: &Path) -> Self {
        let mut all = BTreeMap::new();
        for file in files(src) {
            if file.extension().is_none_or(|e| e != "rs") || file.ends_with("tests.rs") {
                continue;
            }
            let within = file.strip_prefix(src).unwrap().with_extension("");
            let mut module: Vec<String> = within.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
            if ["mod", "lib", "main"].contains(&module.last().unwrap().as_str()) {
                module.pop();
            }
            all.insert(module, Source::of(&code(&file)));
        }
        Self(all)
    }

    /// A path from the root of the crate; `None` for another crate's.
    fn absolute(&self, module: &[String], path: &str) -> Option<Vec<String>> {
        let mut parts: Vec<String> = path.split("::").map(str::to_owned).collect();
        let mut base = module.to_vec();
        match parts[0].as_str() {
            "crate" => base.clear(),
            "self" => {}
            "super" => {
                while parts.first().is_some_and(|part| part == "super") {
                    base.pop();
                    parts.remove(0);
                }
                return Some([base, parts].concat());
            }
            first => {
                base.push(first.to_owned());
                if !self.0.contains_key(&base) {
                    return None;
                }
            }
        }
        Some([base, parts[1..].to_vec()].concat())
    }

    /// The file that holds what a path names, also where others hand it on; `None` for a module as such.
    fn home(&self, path: &[String], depth: usize) -> Option<Vec<String>> {
        let known = (0..=path.len()).rev().find(|k| self.0.contains_key(&path[..*k]))?;
        let (module, name) = (&path[..known], path.get(known)?);
        let export = self.0[module].exports.iter().find(|(known, _)| known == name);
        let elsewhere = export.and_then(|(_, from)| self.absolute(module, from)).filter(|_| depth < 8);
        match elsewhere {
            Some(from) => self.home(&[&from[..], &path[known + 1..]].concat(), depth + 1),
            None => Some(module.to_vec()),
        }
    }

    /// Which file uses which, what is only handed on apart.
    fn uses(&self) -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
        let uses = self.0.iter().map(|(module, source)| {
            let imported = source.imports.iter().filter_map(|(_, path)| self.absolute(module, path));
            let within = source.paths.iter().filter_map(|path| {
                let (first, rest) = path.split_once("::")?;
                let import = source.imports.iter().find(|(name, _)| name == first);
                match import {
                    Some((_, from)) => self.absolute(module, &format!("{from}::{rest}")),
                    None => self.absolute(module, path),
                }
            });
            let homes = imported.chain(within).filter_map(|path| self.home(&path, 0));
            (module.clone(), homes.filter(|home| home != module).collect())
        });
        uses.collect()
    }
}

/// Modules of a crate and which other ones each uses.
fn modules(src: &Path) -> Uses {
    let mut all = Uses::new();
    for (file, uses) in Sources::of(src).uses() {
        if let Some(module) = file.first() {
            let others = uses.iter().filter_map(|used| used.first()).filter(|used| *used != module);
            all.entry(module.clone()).or_default().extend(others.cloned());
        }
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
fn prop_files_of_no_crate_use_each_other() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let src = entry.unwrap().path().join("src");
        if src.exists() {
            let named = |path: &Vec<String>| path.join("::");
            let uses = Sources::of(&src).uses();
            let uses: Uses = uses.iter().map(|(file, used)| (named(file), used.iter().map(named).collect())).collect();
            assert!(uses.values().any(|used| !used.is_empty()) || uses.len() < 3, "{} is read", src.display());
            assert_eq!(cycle(&uses), None, "files of {} that use each other", src.display());
            assert_eq!(cycle(&modules(&src)), None, "modules of {} that use each other", src.display());
        }
    }
}

#[test]
fn prop_no_file_is_longer_than_500_lines() {
    let sources = ["crates", "docs/tool", "python", "validation"].map(|folder| root().join(folder));
    let built = ["target", "node_modules", "vendor", "build"];
    let long: Vec<_> = (sources.iter())
        .flat_map(|folder| files_but(folder, &built))
        .filter(|path| path.extension().is_some_and(|e| ["rs", "py", "js", "mjs"].iter().any(|known| e == *known)))
        .filter(|path| fs::read_to_string(path).unwrap().lines().count() > 500)
        .collect();
    assert_eq!(long, Vec::<PathBuf>::new(), "longer than 500 lines");
}

/// Tables without what each module uses: that they name all.
#[test]
fn prop_every_file_says_its_subject_first() {
    let crates =
        files_but(&root().join("crates"), &["target", "node_modules", "tests", "tests.rs", "examples", "build.rs"]);
    let rust = crates.into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs"));
    let silent: Vec<_> = rust.filter(|path| !fs::read_to_string(path).unwrap().starts_with("//!")).collect();
    assert!(silent.is_empty(), "{silent:?}");
}

/// The files of a crate that name another one.
fn users(src: &Path, of: &str) -> Vec<String> {
    let start = format!("{}::", of.replace('-', "_"));
    let names_it = |text: &str| {
        text.match_indices(&start)
            .any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || "_:".contains(c)))
    };
    let all =
        files(src).into_iter().filter(|file| file.extension().is_some_and(|e| e == "rs") && names_it(&code(file)));
    all.map(|file| file.strip_prefix(src).unwrap().to_str().unwrap().replace('\\', "/")).collect()
}

/// Which one, and where the table says in which files: in these, and in no others.
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
        for clause in said.split(';') {
            let places: BTreeSet<&str> = clause.split('`').skip(1).step_by(2).collect();
            let (used, places): (BTreeSet<&str>, BTreeSet<&str>) =
                places.into_iter().partition(|p| p.starts_with("crates/"));
            for used in used.iter().filter(|_| !places.is_empty()) {
                let there = users(&path.join("src"), &used["crates/".len()..]);
                let told = |file: &String| places.iter().any(|place| file.starts_with(place));
                let untold: Vec<_> = there.iter().filter(|file| !told(file)).collect();
                assert!(untold.is_empty(), "{name} uses {used} in {untold:?}; ARCHITECTURE.md says: {clause}");
                let stale = places.iter().find(|place| !there.iter().any(|file| file.starts_with(**place)));
                assert_eq!(stale, None, "{name} does not use {used} there");
            }
        }
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
    // The groups above are listed by hand: what a run has of others is not in the table.
    let path = root().join("examples/rectangle.toml");
    let scenario = Scenario::from_toml(&fs::read_to_string(path).unwrap()).unwrap();
    let names = names(&scenario, &Simulation::new(&scenario).unwrap());
    for name in &names {
        let (subject, number) = name.rsplit_once('.').unwrap_or(("", name));
        let subject = match subject.trim_end_matches(|c: char| c.is_ascii_digit()) {
            "" => String::new(),
            of @ ("defect" | "row") => format!("{of}N."),
            "envelope" | "audit" | "work" => format!("{subject}."),
            _ => "CHANNEL.".into(),
        };
        assert!(table.contains(&format!("| `{subject}{number}` |")), "{name} of a run is not in the table");
    }
    assert!(names.iter().any(|n| n.starts_with("defect1.entry")) && names.iter().any(|n| n.starts_with("row2.")));
}
