//! Text from models, file names and arguments on a terminal: whatever it holds, nothing of it acts there.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

mod command;

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use slideway::printable;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Sets the title of a terminal, rings, makes a link, clears it (as C1), colours as the program does, hides,
/// reverses the order of letters, goes back on the line, and begins a line of its own.
const HOSTILE: &str = "A\u{1b}]0;owned\u{7}\u{1b}]8;;http://example.org\u{1b}\\B\u{1b}]8;;\u{1b}\\\u{9b}2J\u{90}q\u{9c}\
                       \u{1b}[32mC\u{1b}[0m\u{200b}\u{feff}\u{202e}D\u{2066}\u{200f}\u{61c}\u{7f}\u{8}\rE\nOne solution.\u{2028}F\u{e0041}";

/// What a program wrote on a terminal, standard output and standard error together, and its exit code.
fn on_terminal(command: &mut Command) -> (String, i32) {
    typing("", command)
}

/// The same if this has been typed before it begins: the terminal shows it first.
fn typing(typed: &str, command: &mut Command) -> (String, i32) {
    let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&master).unwrap();
    unlockpt(&master).unwrap();
    let name = ptsname(&master, Vec::new()).unwrap();
    let path = Path::new(std::ffi::OsStr::from_bytes(name.as_bytes()));
    let slave = OpenOptions::new().read(true).write(true).open(path).unwrap();
    let mut master = File::from(master);
    master.write_all(typed.as_bytes()).unwrap();
    let stream = || Stdio::from(slave.try_clone().unwrap());
    let mut child = command
        .env("TERM", "xterm-256color")
        .stdin(stream())
        .stdout(stream())
        .stderr(stream())
        .spawn()
        .unwrap();
    // The command keeps its streams until it is dropped or given others.
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    drop(slave);
    let mut bytes = Vec::new();
    // Reading ends with an error once the program has closed the terminal.
    let _ = master.read_to_end(&mut bytes);
    let code = child.wait().unwrap().code().unwrap();
    (without_progress(&String::from_utf8(bytes).unwrap().replace("\r\n", "\n")), code)
}

/// The text without the lines of progress, which a slow machine shows, each in the place of the last one.
fn without_progress(text: &str) -> String {
    let is_progress = |line: &&str| line.starts_with('[') && line.contains(" %, ");
    text.split("\r\u{1b}[K").filter(|line| !is_progress(line)).collect()
}

/// The text without the styles that the program uses (ECMA-48, SGR: bold and colours of letters), and whether
/// it had any.
fn without_styles(text: &str) -> (String, bool) {
    let mut parts = text.split("\u{1b}[");
    let mut out = parts.next().unwrap_or_default().to_owned();
    let mut styled = false;
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_digit() && c != ';').unwrap_or(part.len());
        match part[end..].strip_prefix('m') {
            Some(rest)
                if ["", "0", "1", "4"].contains(&&part[..end]) || part[..end].starts_with(['3', '9']) =>
            {
                out.push_str(rest);
                styled = true;
            }
            _ => out.extend(["\u{1b}[", part]),
        }
    }
    (out, styled)
}

/// Sees to it that nothing in a text acts on who shows it.
fn assert_inert(text: &str, what: &str) {
    let shown = printable::lines(text);
    let differs = text.chars().zip(shown.chars()).position(|(c, shown)| c != shown);
    let around = differs.map(|at| text.chars().skip(at.saturating_sub(30)).take(60).collect::<String>());
    assert!(text == shown, "{what}: {around:?}");
}

/// A text as a string of TOML.
fn toml_text(text: &str) -> String {
    let escaped = text.chars().map(|c| format!("\\U{:08x}", u32::from(c)));
    format!("\"{}\"", escaped.collect::<String>())
}

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("terminal").join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = command::command(arguments);
        command.current_dir(&self.0);
        command
    }
}

/// A model of the gallery with another title.
fn titled(model: &str, title: &str) -> String {
    let text = fs::read_to_string(command::top().join("models").join(model)).unwrap();
    let lines = text.lines().map(|line| {
        if line.starts_with("title = ") { format!("title = {}", toml_text(title)) } else { line.to_owned() }
    });
    lines.collect::<Vec<_>>().join("\n")
}

const ANSWERS: [&str; 12] = [
    "solve drawer.toml",
    "solve drawer.toml --set mu=0.7",
    "limits drawer.toml --vary mu",
    "size drawer.toml --vary L --margin 2",
    "drive drawer.toml",
    "check drawer.toml",
    "hold drawer.toml --rate x=0 --load resistance",
    "simulate oscillator.toml --until 0.2s",
    "simulate oscillator.toml --until 0.2s --all-branches",
    "draw drawer.toml",
    "report drawer.toml",
    "sweep drawer.toml --vary mu=0..1:3",
];

/// The words of a command.
fn words(command: &str) -> Vec<&str> {
    command.split(' ').collect()
}

#[test]
fn a_title_is_told_as_if_it_were_plain_text() {
    let folder = |name: &str, title: &str| {
        let folder = Folder::new(name);
        folder.write("drawer.toml", &titled("drawer.toml", title));
        folder.write("oscillator.toml", &titled("frictional-oscillator.toml", title));
        folder
    };
    let hostile = folder("hostile", HOSTILE);
    let plain = folder("plain", &printable::line(HOSTILE));
    for command in ANSWERS {
        let (told, code) = on_terminal(&mut hostile.command(&words(command)));
        let (expected, expected_code) = on_terminal(&mut plain.command(&words(command)));
        let (without, styled) = without_styles(&told);
        assert_inert(&without, command);
        // A drawing and a page may be laid out otherwise; a page and a table tell the text of the model.
        if !matches!(words(command)[0], "draw" | "report" | "sweep") {
            assert!(styled, "{command}: {told}");
            assert_eq!(told, expected, "{command}");
        }
        let tells = ["solve", "limits", "check"].contains(&words(command)[0]);
        assert!(!tells || told.contains(r"\u001b]0;owned\u0007"), "{command}: {told}");
        assert_eq!(code, expected_code, "{command}");
    }
}

#[test]
fn faults_quote_a_model_without_its_controls() {
    let folder = Folder::new("faults");
    let hostile = toml_text(HOSTILE);
    let models = [
        (
            "key",
            format!("{hostile} = 1\n[bodies.{hostile}]\nmass = 1\n[joints.{hostile}]\ntype = {hostile}\n"),
        ),
        ("name", titled("drawer.toml", "").replace("block = \"drawer\"", &format!("block = {hostile}"))),
        ("unit", titled("drawer.toml", "").replace("\"0.4 m\"", &hostile)),
        ("raw", "x = \u{1b}]0;owned\u{7} # \u{9b}2J \u{202e}\r\n".to_owned()),
        ("comment", "[bodies] # \u{9b}2J \u{202e} \u{90}q\nx = 2 # \u{9b}2J\n".to_owned()),
    ];
    for (name, text) in &models {
        folder.write(&format!("{name}.toml"), text);
        let (told, code) = on_terminal(&mut folder.command(&["solve", &format!("{name}.toml")]));
        assert_eq!(code, 2, "{told}");
        let (without, styled) = without_styles(&told);
        assert!(styled && without.contains("error"), "{told}");
        assert_inert(&without, name);
    }
    let key = serde_json::to_string(HOSTILE).unwrap();
    folder.write("problem.json", &format!(r#"{{"type": "lcp", {key}: 1, "M": {key}}}"#));
    let (told, code) = on_terminal(&mut folder.command(&["modes", "problem.json"]));
    assert_eq!(code, 2, "{told}");
    assert_inert(&without_styles(&told).0, "modes");
}

#[test]
fn names_of_files_and_arguments_are_told_without_their_controls() {
    let folder = Folder::new("names");
    let name = HOSTILE.replace('/', "_");
    let set = format!("{name}=1");
    folder.write(&name, "mass = 1\n");
    folder.write("drawer.toml", &titled("drawer.toml", "A drawer"));
    let absent = format!("absent{name}");
    let output = format!("{absent}/x.toml");
    let commands: [&[&str]; 16] = [
        &["solve", &name],
        &["check", &absent],
        &["modes", &name],
        &["modes", &absent],
        &["models", &name],
        &["new", &name],
        &["new", "wedge", "--mu", &name],
        &["new", "drawer", "--output", &name],
        &["draw", "drawer.toml", "-o", &name],
        &["solve", "drawer.toml", "-o", &name],
        &["solve", "drawer.toml", "-o", &output],
        &["solve", "drawer.toml", "--set", &set],
        &["simulate", "drawer.toml", "--until", &name],
        &["sweep", "drawer.toml", "--vary", &set],
        &["solve", "drawer.toml", "--format", &name],
        &[&name],
    ];
    for arguments in commands {
        let (told, code) = on_terminal(&mut folder.command(arguments));
        assert_eq!(code, 2, "{arguments:?}: {told}");
        let (without, _) = without_styles(&told);
        assert!(without.contains(r"\u001b]0;owned\u0007"), "{arguments:?}: {told}");
        assert_inert(&without, &format!("{arguments:?}"));
    }
}

/// The command to check a proof with is one for a shell.
#[test]
fn the_note_of_a_proof_quotes_its_files() {
    let folder = Folder::new("proof");
    folder.write("p.json", r#"{"type": "lcp", "M": [[1]], "q": [-1]}"#);
    let (told, code) = on_terminal(&mut folder.command(&["modes", "p.json", "--proof", "q\u{1b}]0;x\u{7}"]));
    assert_eq!(code, 0, "{told}");
    assert!(told.contains(r"check_proof.py p.json $'q\033]0;x\007'"), "{told}");
    assert_inert(&without_styles(&told).0, "proof");
}

#[test]
fn files_hold_no_controls_and_json_gives_the_title_back() {
    let folder = Folder::new("files");
    folder.write("drawer.toml", &titled("drawer.toml", HOSTILE));
    folder.write("oscillator.toml", &titled("frictional-oscillator.toml", HOSTILE));
    let commands = [
        ("solve drawer.toml --format json -o", "solve.json"),
        ("check drawer.toml --format json -o", "check.json"),
        ("limits drawer.toml --vary mu --format json -o", "limits.json"),
        ("simulate oscillator.toml --until 0.1s -o", "simulate.json"),
        ("draw drawer.toml -o", "draw.svg"),
        ("draw drawer.toml -o", "draw.png"),
        ("report drawer.toml -o", "report.html"),
        ("limits drawer.toml --vary mu --plot", "limits.svg"),
        ("sweep drawer.toml --vary mu=0..1:5 -o sweep.csv --plot", "sweep.svg"),
        ("map drawer.toml --x mu=0..1 --y a=0..1 --size 20x20 -o", "map.svg"),
        ("simulate oscillator.toml --until 0.1s --plot", "motion.svg"),
        ("simulate oscillator.toml --until 0.1s --animate", "moving.svg"),
        ("simulate oscillator.toml --until 0.1s --animate", "moving.html"),
    ];
    for (command, file) in commands {
        let mut words = words(command);
        words.push(file);
        let run = folder.command(&words).output().unwrap();
        assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
        let bytes = fs::read(folder.0.join(file)).unwrap();
        if file.ends_with("png") {
            continue;
        }
        let text = String::from_utf8(bytes).unwrap();
        assert_inert(&text, file);
        if file.ends_with("json") {
            let value: serde_json::Value = serde_json::from_str(&text).unwrap();
            let title = value["model"]["title"].as_str().or(value["title"].as_str());
            assert_eq!(title.unwrap_or(HOSTILE), HOSTILE, "{file}");
        } else {
            assert!(text.contains("u001b]0;owned"), "{file}");
        }
    }
}

#[test]
fn a_new_model_is_asked_for() {
    let folder = Folder::new("new");
    folder.write("taken.toml", "mine");
    // A misspelt name, a number that no template has, the first one; the L of the template, a wrong unit, a number
    // without one, which is not right, then a right one; an end of the input (Ctrl-D) before mu; a file that is there.
    let typed = "drawr\n13\n1\n\n300 kg\n30\nn\n300\n\n\u{4}taken\nn\nmine\n";
    let (told, code) = typing(typed, &mut folder.command(&["new"]));
    assert_eq!(code, 0, "{told}");
    let (told, _) = without_styles(&told);
    for says in [
        " 1  drawer        A drawer, or anything else that is guided over a length and\n",
        "12  peg           A peg",
        "Number or name: There is no template `drawr`: did you mean `drawer`?\n",
        "Number or name: There is no template `13`: type a number from 1 to 12, or a name.\n",
        "L, length over which it is guided [400 mm]: ",
        "Not possible: a mass where a length is expected.\n",
        "a, distance of the push from the middle [150 mm]: 30 mm? [Enter: yes] a, distance",
        "a, distance of the push from the middle [150 mm]: 300 mm? [Enter: yes] mu, ",
        "mu, friction coefficient of the guide [0.3]: \n",
        "File [drawer.toml]: taken.toml exists. Overwrite it? [y/N] File [drawer.toml]: ",
        "Wrote mine.toml. Kept from the template: L = 400 mm, mu = 0.3, width = 400 mm,",
        "$ slideway drive mine.toml",
        // P = Q/(1 - 2 mu a/L)
        "36.36",
    ] {
        assert!(told.contains(says), "{says}: {told}");
    }
    let text = fs::read_to_string(folder.0.join("mine.toml")).unwrap();
    assert!(text.contains("\na = \"300 mm\" ") && text.contains("\nL = \"400 mm\" "), "{text}");
    assert_eq!(fs::read_to_string(folder.0.join("taken.toml")).unwrap(), "mine");
    // With a value on the command line nothing is asked.
    let (told, code) = on_terminal(&mut folder.command(&["new", "peg", "--mu", "0.1"]));
    assert_eq!(code, 0, "{told}");
    assert!(told.starts_with("Wrote peg.toml. Kept from the template: h = 60 mm, l = 15 mm,"), "{told}");
}

/// On a terminal a picture or page would be of no use: it goes into a file, none that exists, and the program of the
/// system opens it if that is asked for.
#[test]
fn pictures_and_pages_name_their_files() {
    let folder = Folder::new("own-files");
    folder.write("drawer.toml", &titled("drawer.toml", "A drawer"));
    // What opens files here says which.
    folder.write("xdg-open", "#!/bin/sh\nprintf %s \"$1\" > opened\n");
    fs::set_permissions(folder.0.join("xdg-open"), std::os::unix::fs::PermissionsExt::from_mode(0o755))
        .unwrap();
    let told = |arguments: &str| {
        let (told, code) = on_terminal(folder.command(&words(arguments)).env("PATH", &folder.0));
        assert_eq!(code, 0, "{arguments}: {told}");
        told.lines().last().unwrap().rsplit("\u{1b}[K").next().unwrap().to_owned()
    };
    let text = |file: &str| fs::read_to_string(folder.0.join(file)).unwrap();
    assert_eq!(told("draw drawer.toml"), "Wrote drawer.svg.");
    assert!(text("drawer.svg").starts_with("<svg"));
    assert_eq!(told("draw drawer.toml --set mu=0.7"), "Wrote drawer-2.svg.");
    assert_ne!(text("drawer.svg"), text("drawer-2.svg"));
    assert_eq!(told("draw drawer.toml --set mu=0.7 --force"), "Wrote drawer.svg.");
    assert_eq!(text("drawer.svg"), text("drawer-2.svg"));
    assert_eq!(told("map drawer.toml --x mu=0..1 --y a=0..0.5 --size 8x8"), "Wrote drawer-map.svg.");
    assert!(!folder.0.join("opened").exists());
    assert_eq!(told("report drawer.toml --open"), "Wrote drawer.html.");
    assert!(text("drawer.html").contains("</html>"));
    let opened = || Path::new(&text("opened")).file_name().unwrap().to_owned();
    if cfg!(target_os = "linux") {
        assert_eq!(opened(), "drawer.html");
    }
    // In a pipe it is written there, unless it is to be opened.
    let piped = folder.command(&["draw", "drawer.toml"]).output().unwrap();
    assert!(piped.stdout.starts_with(b"<svg"));
    let piped = folder.command(&["draw", "drawer.toml", "--open"]).env("PATH", &folder.0).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&piped.stdout), "Wrote drawer-3.svg.\n");
    if cfg!(target_os = "linux") {
        assert_eq!(opened(), "drawer-3.svg");
        // Without such a program it is written all the same.
        let absent = folder
            .command(&["draw", "drawer.toml", "--open"])
            .env("PATH", folder.0.join("nowhere"))
            .output()
            .unwrap();
        assert_eq!(absent.status.code(), Some(2));
        let complaint = String::from_utf8_lossy(&absent.stderr).into_owned();
        assert!(complaint.contains("drawer-4.svg` is written, but cannot be opened"), "{complaint}");
    }
}

/// What could be asked further stands below an answer that somebody reads.
#[test]
fn drive_names_what_it_could_be_tabulated_over() {
    let folder = Folder::new("drive");
    folder.write("drawer.toml", &titled("drawer.toml", "A drawer"));
    let (told, _) = on_terminal(&mut folder.command(&["drive", "drawer.toml"]));
    let told = without_styles(&told).0;
    let last = told.trim_end().rsplit("\n\n").next().unwrap().replace('\n', " ");
    assert!(
        last.starts_with("To see it over one of these, add `--vary NAME`: L = 0.4 m, a = 0.3 m, "),
        "{told}"
    );
    assert!(last.ends_with("x = 0 m, friction = 1."), "{told}");
}

#[test]
fn a_long_table_ends_early_on_a_terminal() {
    let folder = Folder::new("long");
    folder.write("drawer.toml", &titled("drawer.toml", "A drawer"));
    let (shown, code) = on_terminal(&mut folder.command(&words("sweep drawer.toml --vary mu=0..0.5:60")));
    let rows = shown.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit()));
    // The rows of points begin with their number and a comma; what is said of all of them does not.
    assert_eq!((code, rows.filter(|line| line.contains(",one,")).count()), (0, 40));
    assert!(shown.contains("20 more rows: `--output FILE.csv` writes all of them"), "{shown}");
    let (short, _) = on_terminal(&mut folder.command(&words("sweep drawer.toml --vary mu=0..0.5:40")));
    assert!(!short.contains("more rows"), "{short}");
}
