//! The page of `slideway report`, also as a browser sees it.
//!
//! The browser is Chromium: the program that `CHROMIUM` names, or the first of the usual names on the path.
//! Without one the test in the browser says so and is skipped, unless `SLIDEWAY_REQUIRE_BROWSER` is set, as
//! it should be in automatic checks.

#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]

mod command;

use command::slideway;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const HOSTILE: &str = "models/klepp-2002.toml";

fn page(directory: &Path, arguments: &[&str]) -> (PathBuf, String) {
    let file = directory.join("page.html");
    let mut all = vec!["report"];
    all.extend(arguments);
    let path = file.to_str().unwrap().to_owned();
    all.extend(["--output", &path, "--force"]);
    let run = slideway(&all);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let html = std::fs::read_to_string(&file).unwrap();
    (file, html)
}

/// Every address within a page leads to the page itself or holds what it stands for.
fn assert_self_contained(html: &str) {
    for attribute in [" src=\"", " href=\"", " srcset=\"", "url("] {
        for part in html.split(attribute).skip(1) {
            assert!(
                part.starts_with('#') || part.starts_with("data:"),
                "{attribute}{}",
                part.chars().take(60).collect::<String>()
            );
        }
    }
    assert!(!html.contains("<script"));
}

#[test]
fn pages_have_all_parts_and_need_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let (_, html) = page(directory.path(), &["models/klepp-2002.toml", "--vary", "mu_1=0..0.8"]);
    assert_self_contained(&html);
    for part in [
        "<h1>A bar sliding in two horizontal slots</h1>",
        "It can go on in 2 ways, and what went before decides which.",
        "Proven: there are no other solutions.",
        "Solution 3 of 3",
        "Preload gap 1 of 1",
        "<h3>Margins of friction</h3>",
        "The number of solutions changes from 3.901 times this friction.",
        "<h3>At rest</h3>",
        "Not attainable: disturbed to one side, it locks up, its forces growing without limit; to the other, it goes over to solution 2.",
        "<svg ",
        "<table class=\"limits\">",
        "<img class=\"on-light\" src=\"data:image/svg+xml,",
        "# The example of H. J. Klepp",
        "--vary &quot;mu_1=0..0.8&quot;</code>",
    ] {
        assert!(html.contains(part), "{part}");
    }
    assert!(!html.contains("NaN") && !html.contains("undefined"));
}

#[test]
fn every_model_of_the_gallery_has_a_page() {
    let directory = tempfile::tempdir().unwrap();
    for model in std::fs::read_dir(command::top().join("models")).unwrap() {
        let path = model.unwrap().path();
        let (_, html) = page(directory.path(), &[path.to_str().unwrap()]);
        assert_self_contained(&html);
        assert!(html.contains("<svg ") && html.contains("</html>"), "{}", path.display());
    }
}

/// The drawer's efficiency is 1 - 2 mu a / L = 55 %, and its margin L / (2 a mu) = 20/9 (book, chapter Limits).
#[test]
fn efficiency_margins_and_rest_are_on_the_page() {
    let directory = tempfile::tempdir().unwrap();
    let (_, html) = page(directory.path(), &["models/drawer.toml"]);
    for part in [
        "<h3>Efforts and efficiency</h3>",
        "efficiency 55 %",
        "It would jam from mu = 0.6667 (2.222 times this friction).",
        "<p>Without the drive push</p>\n<p>It does not hold: it starts to slide (x: -4 m/s^2). More friction would not hold it.</p>",
    ] {
        assert!(html.contains(part), "{part}");
    }
}

/// The massless bracket is a question of rest, and holds with x = 2 B > B / (2 mu_static) (book, chapter Hold).
#[test]
fn a_page_about_rest_is_headed_by_whether_it_holds() {
    let directory = tempfile::tempdir().unwrap();
    let (_, html) = page(directory.path(), &["models/bracket-on-pole.toml"]);
    let header = html.split("</header>").next().unwrap().split("<header>").nth(1).unwrap();
    // x = 2 B is just enough for mu_static = 0.25, and the page says of which load.
    assert!(header.contains("<strong>At rest: "), "{header}");
    assert!(header.contains("`W`") && header.contains("mu_static = 0.25"), "{header}");
    assert!(header.contains(
        "In motion it has no answer:</p>\n<p>the acceleration cannot be computed, as the moving parts have no mass"
    ));
}

#[test]
fn names_and_titles_are_escaped() {
    let directory = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(command::top().join(HOSTILE)).unwrap();
    let title = "<script>alert('x')</script> & \\\"more\\\"";
    let text = text.replace("A bar sliding in two horizontal slots", title);
    let model = directory.path().join("hostile.toml");
    std::fs::write(&model, text).unwrap();
    let (_, html) = page(directory.path(), &[model.to_str().unwrap()]);
    assert!(!html.contains("<script>"));
    assert!(html.contains("&lt;script&gt;alert"));
}

/// Chromium, if this machine has it.
fn browser() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path)
        .flat_map(|directory| names.map(|name| directory.join(name)))
        .find(|program| program.is_file());
    let browser = named.or(found);
    if browser.is_none() {
        assert!(
            std::env::var_os("SLIDEWAY_REQUIRE_BROWSER").is_none(),
            "SLIDEWAY_REQUIRE_BROWSER is set, but there is no Chromium: install it or name it in CHROMIUM"
        );
        eprintln!("SKIPPED: there is no Chromium on this machine; name one in CHROMIUM to run this test");
    }
    browser
}

fn browse(browser: &Path, profile: &Path, arguments: &[&str], page: &Path) -> Output {
    Command::new(browser)
        .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"])
        .args(["--disable-background-networking", "--disable-component-update", "--no-first-run"])
        .args(["--enable-logging=stderr", "--log-level=0"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(arguments)
        .arg(format!("file://{}", page.display()))
        .output()
        .unwrap()
}

/// A frame of a moving picture tells its mode in words, its buttons are 44 px high (WCAG 2.2, 2.5.5), and the
/// console is silent.
#[test]
fn a_browser_shows_a_moving_picture_without_complaint() {
    let Some(browser) = browser() else { return };
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("motion.html");
    let path = file.to_str().unwrap();
    let run = slideway(&["simulate", "models/thrown-drawer.toml", "--until", "0.5s", "--animate", path]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let html = std::fs::read_to_string(&file).unwrap();
    for part in ["prefers-reduced-motion", "ArrowLeft", "min-height: 44px"] {
        assert!(html.contains(part), "{part}");
    }
    // The last frame, where it has jammed.
    let page = PathBuf::from(format!("{path}?frame=1000"));
    let shown = browse(&browser, &directory.path().join("profile"), &["--dump-dom"], &page);
    let (dom, log) = (String::from_utf8_lossy(&shown.stdout), String::from_utf8_lossy(&shown.stderr));
    assert!(!log.contains("CONSOLE"), "{log}");
    assert!(dom.contains("<span id=\"words\">drawer sticks</span>"), "{dom}");
    assert!(dom.contains(">play</button>"), "it stands still where a frame is named");
}

/// The page forbids every request to the network by its own policy; a browser says on its console if anything
/// is asked for all the same, or if anything in the page is wrong.
#[test]
fn a_browser_shows_and_prints_the_page_without_complaint() {
    let Some(browser) = browser() else { return };
    let directory = tempfile::tempdir().unwrap();
    let (file, html) = page(directory.path(), &["models/klepp-2002.toml", "--vary", "mu_1=0..0.8"]);
    assert!(html.contains("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'"));
    let profile = directory.path().join("profile");
    let shown = browse(&browser, &profile, &["--dump-dom"], &file);
    let (dom, log) = (String::from_utf8_lossy(&shown.stdout), String::from_utf8_lossy(&shown.stderr));
    let complaints: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    assert_eq!(dom.matches("<svg").count(), 6, "the mechanism, four states, the key to the colours");
    assert_eq!(dom.matches("<table class=\"contacts\"").count(), 4, "three solutions and a preload gap");
    // One plot, for light and for dark screens; paper gets the light one, whatever the screen.
    for class in ["on-light", "on-dark"] {
        assert_eq!(dom.matches(&format!("<img class=\"{class}\"")).count(), 1);
    }
    let pdf = directory.path().join("page.pdf");
    let print = format!("--print-to-pdf={}", pdf.display());
    browse(&browser, &profile, &["--no-pdf-header-footer", &print], &file);
    let bytes = std::fs::read(&pdf).unwrap();
    assert!(bytes.starts_with(b"%PDF"));
    let text = String::from_utf8_lossy(&bytes);
    let pages = text.matches("/Type /Page\n").count() + text.matches("/Type /Page ").count();
    assert!((3..=9).contains(&pages), "{pages} pages");
}

#[test]
fn the_page_of_a_range_says_that_it_holds_for_its_middle() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("page.html");
    let path = file.to_str().unwrap();
    let run = slideway(&["report", "models/drawer.toml", "--set", "mu=0.2..0.4", "--output", path]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let html = std::fs::read_to_string(&file).unwrap();
    assert!(
        html.contains("<strong>In the middle of its range, mu = 0.3 (0.2 to 0.4): It moves: push needs 36.36 N (20 N without friction).</strong>")
    );
    assert!(html.contains("<p>One solution for every "));
}
