//! The findings of a check as text for people.

use super::{CheckReport, ContactFit, ContactSummary, Finding, JointSummary, Question};
use crate::model::Stop;
use crate::report::number::number;
use crate::report::page::Page;
use crate::report::{Report, Style, count, followed};
use crate::units::Unit;
use anstyle::AnsiColor;

impl Report for CheckReport {
    /// Which questions it can answer: "Ready for: hold, simulate. For solve, give a rate."
    fn answer(&self) -> String {
        if !self.is_ready() {
            let faults = count(self.hindrances().len(), "fault", "faults");
            return format!("No question can be answered in this state: {faults}.");
        }
        let ready: Vec<&str> = self
            .questions
            .iter()
            .filter(|question| question.ready)
            .flat_map(Question::names)
            .copied()
            .collect();
        let mut sentences = vec![format!("Ready for: {}.", ready.join(", "))];
        let hindered: Vec<&Question> = self.hindered().collect();
        for alike in hindered.chunk_by(|one, next| one.needs == next.needs) {
            let names = alike.iter().map(|question| question.name).collect::<Vec<_>>().join(", ");
            sentences.push(match alike[0].needs.as_slice() {
                [] => format!("Not for {names}: see below."),
                needs => format!("For {names}, give {}.", needs.join(" and ")),
            });
        }
        if !self.warnings.is_empty() {
            sentences.push(format!("{}.", count(self.warnings.len(), "warning", "warnings")));
        }
        sentences.join(" ")
    }

    /// The verdict first, then what the model consists of.
    fn text(&self, style: Style) -> String {
        let mut text = Page::new(self, style);
        text.heading();
        text.verdict();
        text.mobility();
        text.inertia();
        text.tables();
        text.text()
    }
}

impl CheckReport {
    /// The questions that it cannot answer; `drive` only where there is one.
    fn hindered(&self) -> impl Iterator<Item = &Question> {
        let asked = |question: &&Question| question.name != "drive" || !self.drives.is_empty();
        self.questions.iter().filter(|question| !question.ready).filter(asked)
    }

    /// The hindrances, each once, with the questions that it concerns.
    fn hindrances(&self) -> Vec<(&Finding, Vec<&str>)> {
        let mut all: Vec<(&Finding, Vec<&str>)> = Vec::new();
        for question in self.hindered() {
            for finding in &question.findings {
                match all.iter_mut().find(|(known, _)| *known == finding) {
                    Some((_, names)) => names.push(question.name),
                    None => all.push((finding, vec![question.name])),
                }
            }
        }
        all
    }
}

type Text<'r> = Page<'r, CheckReport>;

impl Text<'_> {
    fn heading(&mut self) {
        let report = self.report;
        if let Some(title) = &report.title {
            self.headline(title);
        }
        let parts = [
            count(report.bodies.len(), "body", "bodies"),
            count(report.joints.len(), "joint", "joints"),
            count(report.contacts.len(), "contact", "contacts"),
            count(report.loads.len(), "load", "loads"),
            count(report.drives.len(), "drive", "drives"),
            count(report.mobility.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
        ];
        self.line(&parts.join(", "));
        if let Some(steps) = report.steps_from_drawing.filter(|_| self.is_verbose()) {
            self.line(&followed(steps));
        }
        self.line("");
    }

    fn verdict(&mut self) {
        let report = self.report;
        let colour = match (report.is_ready(), report.warnings.is_empty()) {
            (true, true) => AnsiColor::Green,
            (true, false) => AnsiColor::Yellow,
            _ => AnsiColor::Red,
        };
        self.painted(colour.on_default().bold(), &report.answer());
        for (finding, questions) in report.hindrances() {
            let of_some = report.is_ready().then(|| format!("For {}: ", questions.join(", ")));
            // Where nothing is answered a hint must not lead to `solve` either, unless it helps that.
            let helps = report.is_ready() || questions.contains(&"solve");
            let hint = finding.hint.as_deref().filter(|_| helps);
            self.item(&format!("{}{}", of_some.unwrap_or_default(), finding.message), hint);
        }
        for warning in &report.warnings {
            self.item(&warning.message, Some(&warning.hint));
        }
        self.line("");
    }

    /// A finding of a list, and what helps.
    fn item(&mut self, message: &str, hint: Option<&str>) {
        self.hung(&format!("  - {message}"), "- ");
        if let Some(hint) = hint {
            self.hung(&format!("    help: {hint}"), "help: ");
        }
    }

    fn mobility(&mut self) {
        let mobility = &self.report.mobility;
        if self.is_verbose() {
            self.line(&format!(
                "{} of the bodies, {}: {}.",
                count(mobility.body_coordinates, "coordinate", "coordinates"),
                count(mobility.independent, "independent constraint", "independent constraints"),
                count(mobility.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
            ));
        }
        let determinacy = if mobility.determinate {
            "Statically determinate.".to_owned()
        } else if mobility.constraints == mobility.independent {
            // Further supports of one block.
            "Statically indeterminate: contacts are redundant.".to_owned()
        } else {
            let excess = mobility.constraints - mobility.independent;
            let excess = count(excess, "constraint is", "constraints are");
            let joints = mobility.joints_in_excess.join(", ");
            if mobility.singular_position {
                format!("Singular position: {excess} lost in it, among {joints}.")
            } else {
                format!("Statically indeterminate: {excess} redundant, among {joints}.")
            }
        };
        self.line(&determinacy);
        if let Some(sharing) = &self.report.sharing {
            let units = &self.report.units;
            let lines = if self.is_verbose() { sharing.in_words(units) } else { sharing.in_brief(units) };
            lines.iter().for_each(|line| self.line(line));
        }
    }

    fn inertia(&mut self) {
        let report = self.report;
        if report.mobility.degrees_of_freedom == 0 {
            // Nothing can move.
        } else if report.inertia.regular {
            if self.is_verbose() {
                self.line("Every motion has inertia: the mass matrix is regular.");
            }
        } else {
            let motions = &report.inertia.motions_without;
            let [these, them] =
                if motions.len() == 1 { ["this motion", "it"] } else { ["these motions", "them"] };
            let nevertheless =
                report.condition.map_or(String::new(), |_| format!(" The drives prescribe {them}."));
            self.line(&format!("No mass resists {these}: {}.{nevertheless}", motions.join("; ")));
        }
        if let Some(condition) = report.condition.filter(|_| self.is_verbose()) {
            self.line(&format!("Condition of the kinetic equations: {}.", number(condition)));
        }
        if !report.assembled {
            self.line("What follows holds for the drawing, as the state could not be assembled.");
        }
    }

    fn tables(&mut self) {
        let report = self.report;
        let units = &report.units;
        let [mass, inertia, length] = ["kg", "kg m^2", "m"].map(|si| units.of(si));
        let angle = units.of("rad");
        let has_moved = report.bodies.iter().any(|body| body.moved_by != 0.0 || body.turned_by != 0.0);
        let bodies = report.bodies.iter().map(|body| {
            let mut row =
                vec![body.name.clone(), mass.number(body.mass), inertia.number(body.moment_of_inertia)];
            row.extend(has_moved.then(|| length.number(body.moved_by)));
            row.extend(has_moved.then(|| angle.number(body.turned_by)));
            row
        });
        let mut header = vec!["body".to_owned(), mass.title("mass"), inertia.title("moment of inertia")];
        header.extend(has_moved.then(|| length.title("moved from the drawing by")));
        header.extend(has_moved.then(|| angle.title("turned by")));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        self.rows(&header, &bodies.collect::<Vec<_>>());
        let joints = report.joints.iter().map(|joint| {
            vec![
                joint.name.clone(),
                joint.kind.to_string(),
                joint.joins.join(", "),
                joint.positive.clone().unwrap_or_default(),
                joint.constraints.to_string(),
                joint.overlap.map_or(String::new(), |overlap| length.number(overlap)),
            ]
        });
        let header =
            ["joint", "kind", "joins", "positive direction", "constraints", &length.title("overlap")];
        self.rows(&header, &joints.collect::<Vec<_>>());
        let [force, speed] = ["N", "m/s"].map(|si| units.of(si));
        let contacts = report.contacts.iter().map(|contact| contact_row(contact, [&force, &speed]));
        let header = ["contact", "mu", "mu_static", &force.title("preload"), &speed.title("sliding")];
        self.rows(&header, &contacts.collect::<Vec<_>>());
        self.fits();
        self.speeds_and_stops();
        let coordinates = report.coordinates.iter().map(|coordinate| {
            vec![
                coordinate.name.clone(),
                coordinate.kind.to_string(),
                coordinate.positive.clone(),
                driven_by(report, &coordinate.name),
                units.of(coordinate.unit).show(coordinate.value),
                units.of_rate(coordinate.unit).show(coordinate.rate),
            ]
        });
        let header = ["coordinate", "kind", "positive direction", "drive", "value", "rate"];
        self.rows(&header, &coordinates.collect::<Vec<_>>());
    }

    /// How contacts fit that share their load.
    fn fits(&mut self) {
        let (report, units) = (self.report, &self.report.units);
        let [length, stiffness] = ["m", "N/m"].map(|si| units.of(si));
        let fits = report.contacts.iter().filter_map(|contact| Some((&contact.name, contact.fit.as_ref()?)));
        let row = |(name, fit): (&String, &ContactFit)| {
            vec![
                name.clone(),
                length.number(fit.play),
                length.number(fit.misalignment),
                fit.stiffness.map_or(String::new(), |value| stiffness.number(value)),
            ]
        };
        let rows: Vec<Vec<String>> = fits.map(row).collect();
        if !rows.is_empty() {
            let header = [
                "contact",
                &length.title("play"),
                &length.title("misalignment"),
                &stiffness.title("stiffness"),
            ];
            self.rows(&header, &rows);
        }
    }

    /// Facts that the tables do not show: friction over velocity, end stops.
    fn speeds_and_stops(&mut self) {
        let report = self.report;
        let depends = report.contacts.iter().filter(|contact| contact.mu_depends_on_speed);
        let names: Vec<&str> = depends.map(|contact| &*contact.name).collect();
        if !names.is_empty() {
            self.line("");
            self.line(&format!(
                "mu depends on the sliding speed at {}; it is that of this state.",
                names.join(", ")
            ));
        }
        let length = report.units.of("m");
        let circle = |joint: &JointSummary| {
            let of_pin = joint.friction_radii.map(|radii| (joint.name.clone(), radii));
            let of_collar = joint.collar_radii.map(|radii| (format!("{}.collar", joint.name), radii));
            [of_pin, of_collar].into_iter().flatten().map(|(name, [turning, at_rest])| {
                let rest = if at_rest == turning { String::new() } else { length.number(at_rest) };
                vec![name, length.number(turning), rest]
            })
        };
        let circles: Vec<Vec<String>> = report.joints.iter().flat_map(circle).collect();
        let header = ["hinge", &length.title("friction circle, radius"), &length.title("radius at rest")];
        self.rows(&header, &circles);
        if report.joints.iter().any(|joint| joint.stops.into_iter().flatten().any(|stop| stop.is_some())) {
            self.line("");
        }
        for joint in &report.joints {
            for (stop, end) in joint.stops.into_iter().flatten().zip(["least", "greatest"]) {
                let told = match stop {
                    None => continue,
                    Some(Stop::Impact { restitution }) => {
                        format!("a stop with restitution {}", number(restitution))
                    }
                    Some(Stop::Pad { stiffness, damping }) => {
                        let stiffness = report.units.of("N/m").show(stiffness);
                        let damping = report.units.of("N s/m").show(damping);
                        format!("a pad of {stiffness} and {damping}")
                    }
                };
                self.line(&format!("{} has {told} at its {end} displacement.", joint.name));
            }
        }
    }

    fn rows(&mut self, header: &[&str], rows: &[Vec<String>]) {
        if !rows.is_empty() {
            self.line("");
            self.table(header, rows);
        }
    }
}

fn driven_by(report: &CheckReport, coordinate: &str) -> String {
    let drive = report.drives.iter().find(|drive| drive.coordinate == coordinate);
    drive.map_or(String::new(), |drive| drive.name.clone())
}

fn contact_row(contact: &ContactSummary, [force, speed]: [&Unit; 2]) -> Vec<String> {
    vec![
        contact.name.clone(),
        sides(contact.mu, &Unit::default()),
        sides(contact.mu_static, &Unit::default()),
        sides(contact.preload, force),
        contact.sliding_velocity.map_or("unknown".to_owned(), |velocity| speed.number(velocity)),
    ]
}

/// One number, or both where the sides differ.
fn sides([positive, negative]: [f64; 2], unit: &Unit) -> String {
    if positive == negative {
        unit.number(positive)
    } else {
        format!("{} (+), {} (-)", unit.number(positive), unit.number(negative))
    }
}
