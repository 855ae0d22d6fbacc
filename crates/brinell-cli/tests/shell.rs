//! What joins the command to a system: `--help`, `completions`, `man`, `--version`, `open`.

use crate::common::{SHORT, brinell, command, files, folder_with};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// The subcommands that `--help` lists.
fn subcommands() -> Vec<String> {
    let help = brinell(Path::new("."), &["--help"]).exits(0).out;
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let (list, _) = list.split_once("\n\n").unwrap();
    let names = list.lines().filter(|line| !line.starts_with("   "));
    let names: Vec<String> = names
        .filter_map(|line| Some(line.split_whitespace().next()?.to_owned()))
        .filter(|name| name != "help")
        .collect();
    assert!(names.len() > 10, "{names:?}");
    names
}

/// clap wraps at 100 columns where there is no terminal.
#[test]
fn prop_help_is_there_for_every_command_and_wrapped() {
    for name in subcommands().iter().map(String::as_str) {
        for flag in ["--help", "-h"] {
            let call = brinell(Path::new("."), &[name, flag]).exits(0).keeps_quiet().says(&["Usage: brinell"]);
            let widest = call.out.lines().map(|line| line.chars().count()).max();
            assert!(widest <= Some(100), "{}", call.out);
        }
    }
    let whole = brinell(Path::new("."), &["--help"]).exits(0).keeps_quiet();
    whole.says(&["First steps:", "Exit codes: 0 done, 1 the run failed"]);
}

#[test]
fn prop_completions_know_every_command_in_every_shell() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = brinell(Path::new("."), &["completions", shell]).exits(0).keeps_quiet().out;
        for name in subcommands() {
            assert!(script.contains(&name), "{shell}: no {name}");
        }
        assert!(script.contains("line-loads"), "{shell}: no options");
    }
    brinell(Path::new("."), &["completions", "tcsh"]).exits(2).complains(&["tcsh", "bash", "powershell"]);
}

#[test]
fn prop_every_command_has_a_manual_page() {
    let folder = tempdir().unwrap();
    brinell(folder.path(), &["man", "man1"]).exits(0).keeps_quiet().says(&["pages into man1"]);
    let pages = files(&folder.path().join("man1"));
    for name in subcommands() {
        assert!(pages.contains(&format!("brinell-{name}.1")), "{pages:?}");
    }
    for name in ["brinell.1", "brinell-bearing-show.1", "brinell-defect-preview.1"] {
        assert!(pages.iter().any(|page| page == name), "no {name} in {pages:?}");
    }
    let run = fs::read_to_string(folder.path().join("man1/brinell-run.1")).unwrap();
    assert!(run.contains(".TH brinell-run 1") && run.contains("overwrite"), "{run}");
    // Where no folder can be.
    fs::write(folder.path().join("file"), "").unwrap();
    brinell(folder.path(), &["man", "file"]).exits(2).complains(&["file"]);
}

#[test]
fn regress_version_tells_the_commit_and_the_kernel() {
    let told = command(Path::new("."), &["--version"]).env("BRINELL_KERNEL", "portable").output().unwrap();
    let told = String::from_utf8(told.stdout).unwrap();
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines[0], concat!("brinell ", env!("CARGO_PKG_VERSION")));
    let commit = lines[1].strip_prefix("commit ").unwrap();
    let digits = commit.len() == 12 && commit.chars().all(|c| c.is_ascii_hexdigit());
    assert!(commit == "unknown" || digits, "{told}");
    assert_eq!(lines[2], "kernel portable");
    let short = brinell(Path::new("."), &["-V"]).exits(0).out;
    assert_eq!(short.trim_end(), lines[0]);
}

/// An opener that notes what it is given, in a folder that is all of PATH.
#[cfg(target_os = "linux")]
fn opener(folder: &Path) -> std::path::PathBuf {
    use std::os::unix::fs::PermissionsExt;
    let bin = folder.join("bin");
    fs::create_dir_all(&bin).unwrap();
    let note = folder.join("opened");
    for name in ["xdg-open", "wslview"] {
        let script = format!("#!/bin/sh\necho \"$1\" > '{}'\n", note.display());
        fs::write(bin.join(name), script).unwrap();
        fs::set_permissions(bin.join(name), fs::Permissions::from_mode(0o755)).unwrap();
    }
    bin
}

#[cfg(target_os = "linux")]
#[test]
fn prop_pages_are_handed_to_the_systems_opener() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    let bin = opener(here);
    let call = |args: &[&str], path: &Path| -> crate::common::Call {
        command(here, args).env("PATH", path).output().unwrap().into()
    };
    call(&["run", "s.toml", "-o", "o", "-q", "--open"], &bin).exits(0);
    let note = here.join("opened");
    let page = here.join("o/report.html").canonicalize().unwrap();
    // The opener is not waited for.
    let noted = || {
        for _ in 0..1000 {
            match fs::read_to_string(&note) {
                Ok(text) if text.ends_with('\n') => return text.trim().to_owned(),
                _ => std::thread::sleep(std::time::Duration::from_millis(10)),
            }
        }
        panic!("nothing was opened");
    };
    assert_eq!(noted(), page.display().to_string());
    fs::remove_file(&note).unwrap();
    call(&["open", "o"], &bin).exits(0).says(&["opened o/report.html"]);
    assert_eq!(noted(), page.display().to_string());
    // A link may name anything, and the system would start it.
    fs::remove_file(&note).unwrap();
    fs::create_dir(here.join("theirs")).unwrap();
    std::os::unix::fs::symlink(here.join("s.toml"), here.join("theirs/report.html")).unwrap();
    for place in ["theirs", "theirs/report.html"] {
        call(&["open", place], &bin)
            .exits(2)
            .complains(&["theirs/report.html is a link, to ", "s.toml; links are not opened"]);
    }
    assert!(!note.exists());
    // No opener: the page's place is printed; a run is not failed by that.
    let none = here.join("none");
    fs::create_dir(&none).unwrap();
    call(&["open", "o/report.html"], &none)
        .exits(1)
        .complains(&["error: nothing on this system opened the page", &page.display().to_string()]);
    call(&["run", "s.toml", "-o", "o", "-q", "--open"], &none)
        .exits(0)
        .complains(&["warning: nothing on this system opened the page"]);
    // One that finds no browser: what to do, and not its exit status.
    for name in ["xdg-open", "wslview"] {
        fs::write(bin.join(name), "#!/bin/sh\nexit 3\n").unwrap();
    }
    let told = call(&["open", "o/report.html"], &bin)
        .exits(1)
        .complains(&["it is one file: open it in a browser", &page.display().to_string()]);
    assert!(!told.err.contains("tatus"), "{}", told.err);
}

#[test]
fn regress_a_word_that_is_none_is_answered_with_the_one_that_is_meant() {
    for (args, meant) in [
        (&["rnu", "x"][..], "'run'"),
        (&["simulate", "x"], "'run'"),
        (&["gui"], "'studio'"),
        (&["analyse", "x"], "a similar subcommand exists: 'analyze'"),
        (&["sweeps", "x"], "'sweep'"),
        (&["init", "--template", "spall"], "'outer-spall', 'inner-spall'"),
        (&["init", "--template", "bal"], "'ball'"),
    ] {
        brinell(Path::new("."), args).exits(2).complains(&["tip: ", meant]);
    }
    // `run` is no command of `defect`.
    let told = brinell(Path::new("."), &["defect", "rnu"]).exits(2);
    assert!(!told.err.contains("'run'"), "{}", told.err);
}

#[test]
fn regress_what_is_no_page_is_not_opened() {
    let folder = folder_with("s.toml", SHORT);
    let here = folder.path();
    for (args, words) in [
        (&["open", "none"][..], "cannot read none"),
        (&["open", "."], ". holds no page of results: none of"),
        (&["open", "s.toml"], "s.toml is no page"),
        (&["run", "s.toml", "s.toml", "--open"], "--open shows the report of one scenario; here are 2"),
        (&["run", "s.toml", "--open", "--no-report"], "cannot be used with"),
    ] {
        brinell(here, args).exits(2).complains(&[words]);
    }
    assert_eq!(files(here), ["s.toml"]);
}

#[test]
fn prop_what_to_cite_is_that_of_the_citation_file() {
    let told = brinell(Path::new("."), &["cite"]).exits(0).keeps_quiet().out;
    let file = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../CITATION.cff")).unwrap();
    let of_file = |key: &str| {
        let lines = file.lines().filter_map(|line| line.trim().trim_start_matches("- ").strip_prefix(key));
        lines.map(|value| value.trim().to_owned()).collect::<Vec<String>>()
    };
    assert!(told.contains(&format!("version = {{{}}}", of_file("version:")[0])), "{told}");
    for doi in of_file("doi:") {
        assert!(told.contains(&format!("{{{doi}}}")), "{doi}: {told}");
    }
    assert!(told.contains(&format!("title   = {{{}}}", of_file("title:")[1])), "{told}");
    let names = of_file("family-names:").into_iter().zip(of_file("given-names:"));
    let authors: Vec<String> = names.map(|(family, given)| format!("{family}, {given}")).collect();
    assert!(authors.len() == 6 && told.contains(&authors.join(" and ")), "{told}");
    // One entry closes before the next begins.
    assert_eq!(told.matches('{').count(), told.matches('}').count());
}
