//! The body of a page: one function for each part of it.

use super::summary::summary;
use super::{Figure, Page, all, text};
use crate::drawing::svg::{self, Colours};
use crate::drawing::{Sheet, number, quantity, signs};
use slideway::Report;
use slideway::limits::{LimitsReport, ModeLimits};
use slideway::report::{
    JointMode, LoadSharing, ModeEndCause, Proof, Solution, SolveReport, followed, of_contacts, precise,
};
use slideway::units::{Unit, Units};

/// Below this part of the greatest of its kind a velocity or an acceleration is rounding, as in texts.
const ROUNDING: f64 = 1e-13;

/// Everything between the ends of `body`.
pub(super) fn body(page: &Page<'_>) -> String {
    let solutions = page.report.map(solutions).unwrap_or_default();
    format!(
        "{}\n<div class=\"beside\">\n{}\n{}</div>\n{}\n{}\n{}",
        header(page, !solutions.is_empty()),
        drawing(page),
        summary(page),
        solutions,
        limits(page),
        model(page),
    )
}

/// So many of something.
fn count(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

fn header(page: &Page<'_>, has_states: bool) -> String {
    let answer = match page.report {
        Ok(report) => answer_at(page.at_middle, report),
        Err(refused) => {
            let reasons = all(refused, |line| format!("<p>{}</p>\n", text(line)));
            let words = match page.rest {
                Ok(rest) => format!("At rest: {}", rest.answer()),
                Err(_) => "The kinetic problem has no answer in this state.".to_owned(),
            };
            let motion = if page.rest.is_ok() { "<p>In motion it has no answer:</p>\n" } else { "" };
            let words = at_middle(page.at_middle, &words);
            format!("<p class=\"answer\"><strong>{}</strong></p>\n{motion}{reasons}", text(&words))
        }
    };
    let margins = if summary(page).is_empty() { "" } else { "<a href=\"#margins\">Margins</a>" };
    let solutions = if has_states { "<a href=\"#solutions\">Solutions</a>" } else { "" };
    let limits = if has_limits(page) { "<a\nhref=\"#limits\">Limits</a>" } else { "" };
    format!(
        "<header>\n<h1>{}</h1>\n{answer}<nav><a href=\"#drawing\">Drawing</a>{margins}{solutions}{limits}\
         <a href=\"#model\">Model</a></nav>\n</header>\n",
        text(page.title)
    )
}

/// An answer that holds for the middle of what is known within bounds.
fn at_middle(parameters: &[String], answer: &str) -> String {
    match parameters {
        [] => answer.to_owned(),
        [one] => format!("In the middle of its range, {one}: {answer}"),
        several => format!("In the middle of their ranges, {}: {answer}", several.join(", ")),
    }
}

/// The state that was solved, and how many solutions it has.
pub(super) fn answer(report: &SolveReport) -> String {
    answer_at(&[], report)
}

/// Says which state was solved, and how many solutions it has, in the middle of what is known within bounds.
fn answer_at(parameters: &[String], report: &SolveReport) -> String {
    let model = &report.model;
    let drives = match model.drives {
        0 => String::new(),
        number => format!(",\n{}", count(number, "drive", "drives")),
    };
    let coordinates: Vec<String> = report
        .state
        .iter()
        .map(|coordinate| {
            let value = quantity(coordinate.value, &model.units.of(coordinate.unit));
            let rate = quantity(coordinate.rate, &model.units.of_rate(coordinate.unit));
            format!("{} = {}, rate\n{}", text(&coordinate.name), text(&value), text(&rate))
        })
        .collect();
    let followed =
        report.steps_from_drawing.map_or_else(String::new, |steps| format!("; {}", text(&followed(steps))));
    let complete = if report.complete == Proof::Proven {
        "Proven: there are no other solutions."
    } else {
        "Not proven: there may be other solutions."
    };
    format!(
        "<p>{},\n{},\n{}{drives}.\nState: {}{followed}.</p>\n\
         <p class=\"answer\"><strong>{}</strong>\n{complete}</p>\n{}{}{}",
        count(model.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
        count(model.bodies, "body", "bodies"),
        count(model.contacts, "contact", "contacts"),
        coordinates.join("; "),
        text(&at_middle(parameters, &crate::drawing::answer(report))),
        all(
            report.undetermined_in_words().iter().chain(&report.for_all_values()).chain(&report.open),
            |line| format!("<p>{}</p>\n", text(line))
        ),
        all(report.remark(), |line| format!("<p>{}</p>\n", text(&line))),
        all(
            report.sharing.iter().flat_map(|sharing: &LoadSharing| sharing.in_words(&report.model.units)),
            |line| format!("<p>{}</p>\n", text(&line))
        ),
    )
}

fn drawing(page: &Page<'_>) -> String {
    let drawing = |sheet: &Sheet| svg::document(&sheet.scene, &sheet.frame(None, Colours::Page));
    format!(
        "<section id=\"drawing\">\n<h2>Drawing</h2>\n<div class=\"drawing\">\n{}\n</div>\n</section>\n",
        all(page.drawings, drawing)
    )
}

/// The solutions and the preload-gap states, each with its heading.
pub(super) fn states(report: &SolveReport) -> Vec<(String, &Solution)> {
    let heading = |kind: &str, index: usize, count: &str, solution: &Solution| {
        format!("{kind} {} of {count}: {}", index + 1, signs(&solution.pattern))
    };
    let of = |kind: &'static str, count, states| {
        let numbered = <[Solution]>::iter(states).enumerate();
        numbered.map(move |(index, state)| (heading(kind, index, count, state), state))
    };
    of("Solution", &report.count, &report.solutions)
        .chain(of("Preload gap", &report.gap_state_count, &report.preload_gap_states))
        .collect()
}

fn solutions(report: &SolveReport) -> String {
    let states = all(states(report), |(heading, solution)| state(report, &heading, solution));
    if states.is_empty() {
        return states;
    }
    format!(
        "<section id=\"solutions\">\n<h2>Solutions</h2>\n<div class=\"columns\">\n{states}</div>\n</section>\n"
    )
}

pub(super) fn state(report: &SolveReport, heading: &str, solution: &Solution) -> String {
    let units = &report.model.units;
    let of_contacts = &of_contacts(&solution.contacts, units);
    let [force, friction, sliding] = [("Normal force", "N"), ("Friction", "N"), ("Sliding", "m/s")]
        .map(|(what, si)| text(&of_contacts.of(si).title(what)));
    let deflection = if has_deflections(solution) {
        format!("\n<th class=\"number\">{}</th>", text(&units.of("m").title("Deflection")))
    } else {
        String::new()
    };
    // Hinges alone have no contacts.
    let contacts = match contacts(solution, of_contacts) {
        rows if rows.is_empty() => rows,
        rows => format!(
            "<table class=\"contacts\">\n<thead><tr><th>Contact</th><th class=\"number\">{force}</th>\
             <th class=\"number\">{friction}</th>\n<th class=\"number\">{sliding}</th>{deflection}</tr></thead>\n<tbody>\n\
             {rows}</tbody>\n</table>\n"
        ),
    };
    let joints: Vec<String> = solution.joints.iter().map(|joint| joint_mode(joint, ": ")).collect();
    let end = if joints.is_empty() { "" } else { "." };
    format!(
        "<section class=\"state\">\n<h3>{}</h3>\n<p>{}{end}\n{}{}</p>\n<div class=\"wide\">\n\
         {contacts}<table class=\"rest\">\n<thead><tr><th>Of</th><th>What</th><th class=\"number\">Value</th>\
         <th>Unit</th></tr></thead>\n<tbody>\n{}</tbody>\n</table>\n</div>\n</section>\n",
        text(heading.trim_end_matches([':', ' '])),
        joints.join("; "),
        all(report.speeds_in_words(solution), |sentence| text(&sentence) + "\n"),
        text(&solution.attainability.in_words()),
        everything_else(solution, units),
    )
}

fn joint_mode(joint: &JointMode, between: &str) -> String {
    format!("{}{between}{}", text(&joint.name), text(&joint.mode))
}

/// Whether contacts share a load, so that it is known how far they are displaced.
fn has_deflections(solution: &Solution) -> bool {
    solution.contacts.iter().any(|contact| contact.deflection.is_some())
}

fn contacts(solution: &Solution, units: &Units) -> String {
    let [force, speed, length] = ["N", "m/s", "m"].map(|si| units.of(si));
    let speeds = solution.contacts.iter().map(|contact| contact.sliding_velocity);
    let fastest = speeds.fold(0.0_f64, |fastest, value| fastest.max(value.abs()));
    all(&solution.contacts, |contact| {
        let slides = contact.sliding_velocity.abs() > ROUNDING * fastest;
        let sliding = if slides { contact.sliding_velocity } else { 0.0 };
        let deflection = if has_deflections(solution) {
            let value = contact.deflection.map(|value| number(length.number_of(value)));
            format!("<td class=\"number\">{}</td>", value.unwrap_or_default())
        } else {
            String::new()
        };
        format!(
            "<tr><td>{}</td><td class=\"number\">{}</td>\n<td class=\"number\">{}</td><td class=\"number\">{}</td>\
             {deflection}</tr>\n",
            text(&contact.name),
            number(force.number_of(contact.normal_force)),
            number(force.number_of(contact.friction_force)),
            number(speed.number_of(sliding)),
        )
    })
}

/// Rows of what is no contact: accelerations, efforts, forces and friction couples of hinges.
fn everything_else(solution: &Solution, units: &Units) -> String {
    let coordinates = all(&solution.coordinates, |coordinate| {
        row([&coordinate.name, "acceleration"], coordinate.acceleration, &units.of(coordinate.unit)) + "\n"
    });
    let drives =
        all(&solution.drives, |drive| row([&drive.name, "effort"], drive.effort, &units.of(drive.unit)));
    let hinges = all(&solution.hinges, |hinge| {
        let couple = hinge.friction.map(|friction| {
            row(["", &format!("friction couple on {}", hinge.on)], friction.couple, &units.of("N m"))
        });
        pair(&hinge.name, &format!("hinge force on {}", hinge.on), hinge.force, &units.of("N"))
            + &couple.unwrap_or_default()
    });
    let accelerations = solution.bodies.iter().flat_map(|body| body.acceleration);
    let greatest = accelerations.fold(0.0_f64, |greatest, value| greatest.max(value.abs()));
    let bodies = all(&solution.bodies, |body| {
        pair(&body.name, "acceleration", body.acceleration, &units.of("m/s^2"))
            + &Some(body.angular_acceleration)
                .filter(|value| value.abs() > ROUNDING * greatest)
                .map_or_else(String::new, |value| {
                    row(["", "angular acceleration"], value, &units.of("rad/s^2"))
                })
    });
    coordinates + &drives + &hinges + &bodies
}

/// The name of a unit with true exponents.
fn name_of(unit: &Unit) -> String {
    text(&unit.name().replace("^2", "²"))
}

/// A row with one value.
fn row([of, what]: [&str; 2], value: f64, unit: &Unit) -> String {
    let (of, what, value) = (text(of), text(what), number(unit.number_of(value)));
    let unit = name_of(unit);
    format!("<tr><td>{of}</td><td>{what}</td><td class=\"number\">{value}</td><td>{unit}</td></tr>\n")
}

/// A row with the two components of a vector.
fn pair(of: &str, what: &str, components: [f64; 2], unit: &Unit) -> String {
    let [x, y] = components.map(|component| number(unit.number_of(component)));
    format!(
        "<tr><td>{}</td><td>{}</td>\n<td class=\"number\">({x}, {y})</td><td>{}</td></tr>\n",
        text(of),
        text(what),
        name_of(unit)
    )
}

fn has_limits(page: &Page<'_>) -> bool {
    !page.limits.is_empty() || !page.figures.is_empty()
}

fn limits(page: &Page<'_>) -> String {
    if !has_limits(page) {
        return String::new();
    }
    let (limits, figures) = (all(page.limits, limits_of), all(page.figures, figure));
    format!(
        "<section id=\"limits\">\n<h2>Limits</h2>\n<div class=\"columns\">\n<div>\n{limits}</div>\n<div>\n{figures}</div>\n</div>\n</section>\n"
    )
}

/// The limits over one quantity.
pub(super) fn limits_of(limits: &LimitsReport) -> String {
    let name = match limits.vary.name.as_str() {
        "friction" => "Factor of all coefficients of friction",
        name => name,
    };
    let unit = &limits.vary.shown_in;
    // Without contacts, a mode throughout the range says nothing more.
    let is_whole =
        |mode: &ModeLimits| mode.joints.is_empty() && [mode.from_is, mode.to_is] == [ModeEndCause::Range; 2];
    let modes = if limits.modes.iter().all(is_whole) { String::new() } else { modes(limits, unit) };
    format!(
        "<h3>{}, from\n{} to {}</h3>\n{}{modes}<p class=\"quiet\">{}</p>\n",
        text(name),
        precise(unit.number_of(limits.vary.from)),
        text(&unit.precise(limits.vary.to)),
        all(limits.sentences(), |line| format!("<p class=\"conclusion\">{}</p>\n", text(line))),
        text(&limits.known_in_words()),
    )
}

/// The table of the modes.
fn modes(limits: &LimitsReport, unit: &Unit) -> String {
    format!(
        "<div class=\"wide\">\n<table class=\"limits\">\n<thead><tr><th>Signs</th>\
         <th class=\"number\">{}</th><th class=\"number\">{}</th><th>Ends with</th><th>Contact mode</th></tr></thead>\n\
         <tbody>\n{}</tbody>\n</table>\n</div>\n",
        text(&unit.title("From")),
        text(&unit.title("To")),
        all(&limits.modes, |row| mode(row, unit)),
    )
}

/// The row of a mode.
fn mode(mode: &ModeLimits, unit: &Unit) -> String {
    let end = |value: Option<f64>| value.map(|value| precise(unit.number_of(value))).unwrap_or_default();
    let at = if mode.to_at.is_empty() { String::new() } else { format!(": {}", mode.to_at.join(", ")) };
    let joints: Vec<String> = mode.joints.iter().map(|joint| joint_mode(joint, " ")).collect();
    format!(
        "<tr><td class=\"signs\">{}</td>\n<td class=\"number\">{}</td>\n<td class=\"number\">{}</td>\n<td>{}{}</td>\n\
         <td>{}</td></tr>\n",
        text(&signs(&mode.pattern)),
        end(mode.from),
        end(mode.to),
        match mode.to_is {
            ModeEndCause::Range => "end of the range",
            ModeEndCause::Locking => "it jams",
            other => other.in_words(),
        },
        text(&at),
        joints.join("; "),
    )
}

/// A figure in both themes, each picture as an address that holds it.
fn figure(figure: &Figure) -> String {
    let caption = text(&figure.caption);
    let [light, dark] = [&figure.light, &figure.dark].map(|svg| address(svg));
    format!(
        "<figure>\n<img class=\"on-light\" src=\"{light}\" alt=\"{caption}\">\n\
         <img class=\"on-dark\" src=\"{dark}\" alt=\"{caption}\">\n</figure>\n"
    )
}

/// A picture as an address that holds all of it (RFC 2397).
fn address(svg: &str) -> String {
    let byte = |byte: u8| match byte {
        b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' | b':' | b'=' => {
            char::from(byte).to_string()
        }
        other => format!("%{other:02X}"),
    };
    format!("data:image/svg+xml,{}", all(svg.bytes(), byte))
}

fn model(page: &Page<'_>) -> String {
    let name = text(page.name);
    let settings = if page.settings.is_empty() {
        format!("<p>{name}</p>\n")
    } else {
        let settings = all(page.settings, |setting| format!("<li><code>{}</code></li>\n", text(setting)));
        format!("<p>{name}, changed by</p>\n<ul>\n{settings}</ul>\n")
    };
    // Behind the model it would be all there is of the last printed page where the model fills the one before.
    let command = format!(
        "<p class=\"quiet\">Report made by <code>{}</code>, slideway {}.</p>\n",
        text(page.command),
        env!("CARGO_PKG_VERSION")
    );
    format!(
        "<section id=\"model\">\n<h2>Model</h2>\n{command}{settings}<pre>{}</pre>\n</section>\n",
        text(page.text)
    )
}
