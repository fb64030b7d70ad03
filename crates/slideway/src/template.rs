//! Templates: commented models of everyday problems to start one's own from, each with the rule of the
//! textbooks that it must meet.
//!
//! A template is a model file whose parameters are to be set. Its opening comment says what it is, the rule with
//! its source, and commands to try in which `FILE` stands for the file it is written to; the first of them
//! answers the question that is usually asked of it.

use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults, Source};
use crate::mechanism::Mechanism;
use crate::model::{Model, POSITIVE, Settings};
use crate::printable;
use std::fmt::Write;

/// A model to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Template {
    /// Its name: that of its file without the ending.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

/// A relation between dimensions of a template.
#[derive(Debug, Clone, Copy)]
struct Need {
    /// As it stands in the opening comment: "l <= h".
    relation: &'static str,
    /// Both sides, the greater one first.
    sides: [&'static str; 2],
    /// Whether they must not be equal.
    strict: bool,
    /// Meaning of the relation.
    meaning: &'static str,
}

impl Need {
    /// From "l <= h: meaning".
    fn of(line: &'static str) -> Option<Self> {
        let (relation, meaning) = line.split_once(": ")?;
        let operators =
            [(" >= ", false, false), (" <= ", true, false), (" > ", false, true), (" < ", true, true)];
        operators.into_iter().find_map(|(operator, swapped, strict)| {
            let (left, right) = relation.split_once(operator)?;
            let sides = if swapped { [right, left] } else { [left, right] };
            Some(Self { relation, sides, strict, meaning })
        })
    }

    /// Whether it is met if its greater side exceeds the other one by so much.
    fn is_met(&self, excess: f64) -> bool {
        if self.strict { excess > 0.0 } else { excess >= 0.0 }
    }
}

/// A parameter of a template.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TemplateParameter {
    /// Its name.
    pub name: &'static str,
    /// Its value in the template, with its unit.
    pub value: &'static str,
    /// Meaning of the parameter, from the comment behind it.
    pub meaning: &'static str,
}

macro_rules! templates {
    ($($name:literal),* $(,)?) => {
        &[$(Template {
            name: $name,
            text: include_str!(concat!("../templates/", $name, ".toml")),
        }),*]
    };
}

/// All templates.
pub const TEMPLATES: &[Template] = templates![
    "drawer",
    "sash",
    "carriage",
    "axis",
    "column",
    "bushing",
    "telescope",
    "cylinder",
    "bracket",
    "wedge",
    "slider-crank",
    "peg",
];

/// How the parameters begin as which needs are evaluated.
const EXCESS: &str = "excess_of_need_";

/// Placeholder of the model's file in the commands of a template.
pub const FILE: &str = "FILE";

/// The template with this name.
///
/// ```
/// assert!(slideway::template::find("peg").is_some());
/// assert!(slideway::template::find("windmill").is_none());
/// ```
pub fn find(name: &str) -> Option<&'static Template> {
    TEMPLATES.iter().find(|template| template.name == name)
}

impl Template {
    /// The first line of its opening comment: what it is.
    pub fn summary(&self) -> &'static str {
        self.comment().next().unwrap_or_default()
    }

    /// The rule that it must meet, without its source.
    pub fn rule(&self) -> String {
        self.section("Rule: ", "Return: ")
    }

    /// Returns the rule that its motion the other way must meet.
    pub fn way_back(&self) -> String {
        self.section("Return: ", "Source: ")
    }

    /// The lines of its opening comment from the one that begins like this on, until one begins with the other.
    fn section(&self, first: &str, next: &str) -> String {
        let lines = self.comment().skip_while(|line| !line.starts_with(first));
        let lines: Vec<&str> = lines.take_while(|line| !line.starts_with(next)).collect();
        lines.join(" ").trim_start_matches(first).to_owned()
    }

    /// Returns the relations between its dimensions that make it what it is called and let its rule hold.
    fn needs(&self) -> impl Iterator<Item = Need> {
        self.comment().filter_map(|line| line.strip_prefix("Needs: ")).filter_map(Need::of)
    }

    /// Commands to try, [`FILE`] in the place of its file; the first one answers its question.
    pub fn commands(&self) -> impl Iterator<Item = &'static str> {
        self.comment().filter(|line| line.starts_with("slideway "))
    }

    /// Its parameters in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = TemplateParameter> {
        self.text.lines().skip_while(|line| *line != "[parameters]").skip(1).map_while(parameter)
    }

    /// The text of its model with other parameters, for a file whose name is written like `file` on a command
    /// line.
    ///
    /// ```
    /// use slideway::{Settings, template};
    ///
    /// let drawer = template::find("drawer").expect("a template");
    /// let text = drawer.model(&Settings::default().parameter("L", "0.5 m"), "mine.toml")?;
    /// assert!(text.contains("\nL = \"0.5 m\""));
    /// # Ok::<(), slideway::Faults>(())
    /// ```
    ///
    /// # Errors
    /// The faults of the settings, bare texts of numbers where the template has units among them, and of the
    /// model with them, such as joints that do not close.
    pub fn model(&self, settings: &Settings, file: &str) -> Result<String, Faults> {
        self.checked(settings).map_err(|faults| self.in_its_words(&faults, settings))?;
        let mut text = String::new();
        for line in self.text.lines() {
            let line = match parameter(line).and_then(|parameter| changed(parameter, settings)) {
                Some(changed) => changed,
                None if line.starts_with("#   slideway ") => line.replace(FILE, &printable::line(file)),
                None => line.to_owned(),
            };
            let _ = writeln!(text, "{line}");
        }
        Ok(text)
    }

    /// # Errors
    /// As [`Self::model`].
    fn checked(&self, settings: &Settings) -> Result<(), Faults> {
        let model = Model::parse(self.text)?.with(settings)?;
        // A bare number for what has a unit in the template is in SI units, which is hardly meant.
        let mut doubts = Faults::default();
        doubts.extend(model.doubts.iter().cloned());
        doubts.or(())?;
        self.check_needs(settings)?;
        Configuration::new(&Mechanism::new(&model)?)?;
        Ok(())
    }

    /// # Errors
    /// The needs that are not met: each is evaluated as a parameter of the template, what one side has over the other.
    fn check_needs(&self, settings: &Settings) -> Result<(), Faults> {
        let needs: Vec<Need> = self.needs().collect();
        let parameter = |(index, need): (usize, &Need)| {
            format!("{EXCESS}{index} = \"({}) - ({})\"\n", need.sides[0], need.sides[1])
        };
        let excesses: String = needs.iter().enumerate().map(parameter).collect();
        let text = self.text.replacen("[parameters]\n", &format!("[parameters]\n{excesses}"), 1);
        let model = Model::parse(&text)?.with(settings)?;
        let values = model.constants()?;
        let mut faults = Faults::default();
        for (index, need) in needs.iter().enumerate() {
            let name = format!("{EXCESS}{index}");
            let Some(excess) = model.parameters.iter().find(|parameter| *parameter.name == *name) else {
                continue;
            };
            if need.is_met(values[excess.value.index()]) {
                continue;
            }
            let kind =
                FaultKind::NeedUnmet { relation: need.relation.to_owned(), meaning: need.meaning.to_owned() };
            let place = model.setting_of(&[excess.value]);
            faults.push(
                place.map_or_else(|| Fault::general(kind.clone()), |place| Fault::new(kind.clone(), place)),
            );
        }
        faults.or(())
    }

    /// Faults that name the template's parameters instead of what its model makes of them: of a parameter that
    /// must not have its value one, the strictest; that a formula has no value says that the parts do not meet.
    fn in_its_words(&self, faults: &Faults, settings: &Settings) -> Faults {
        let named = |fault: &Fault| -> Option<Fault> {
            let Source::Setting(index) = fault.place.as_ref()?.source else { return None };
            let setting = settings.entries().get(index)?;
            let TemplateParameter { name, meaning, .. } =
                self.parameters().find(|parameter| parameter.name == setting.name)?;
            let typed = || printable::line(&setting.value.to_string()).into_owned();
            let kind = match fault.kind {
                FaultKind::OutOfRange { wanted, .. } => {
                    FaultKind::OutOfRange { what: format!("{name} ({meaning})"), wanted, value: typed() }
                }
                ref kind if kind.is_without_value() => FaultKind::PartsApart {
                    name: name.to_owned(),
                    value: typed(),
                    meaning: meaning.to_owned(),
                },
                _ => return None,
            };
            Some(Fault { kind, ..fault.clone() })
        };
        let told: Vec<Fault> =
            faults.sorted().into_iter().map(|fault| named(fault).unwrap_or_else(|| fault.clone())).collect();
        let is_stricter = |one: &Fault, other: &Fault| {
            let wanted = |fault: &Fault| match fault.kind {
                FaultKind::OutOfRange { wanted, .. } => Some(wanted),
                _ => None,
            };
            let both = wanted(one).zip(wanted(other));
            one.place == other.place && both.is_some_and(|(one, other)| one == POSITIVE && other != POSITIVE)
        };
        let mut all = Faults::default();
        all.extend(told.iter().filter(|one| !told.iter().any(|other| is_stricter(other, one))).cloned());
        all
    }

    /// The lines of its opening comment.
    fn comment(&self) -> impl Iterator<Item = &'static str> {
        let lines = self.text.lines().take_while(|line| line.starts_with('#'));
        lines.map(|line| line.trim_start_matches(['#', ' ']))
    }
}

/// The parameter of a line: `NAME = VALUE # MEANING`, which no other line of a template looks like.
fn parameter(line: &'static str) -> Option<TemplateParameter> {
    let (assignment, meaning) = line.split_once(" # ")?;
    let (name, value) = assignment.split_once(" = ")?;
    Some(TemplateParameter { name, value: value.trim().trim_matches('"'), meaning: meaning.trim() })
}

/// The line of a parameter with the value that the settings give to it, the last one if there are several.
fn changed(parameter: TemplateParameter, settings: &Settings) -> Option<String> {
    let setting = settings.entries().iter().rfind(|setting| setting.name == parameter.name)?;
    let value = setting.value.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
    // A number as the language writes it is one of TOML, too.
    let number = value.parse::<f64>().is_ok_and(|number| number.is_finite() && number.to_string() == value);
    let value = if number { value } else { format!("{value:?}") };
    let assignment = format!("{} = {value}", parameter.name);
    Some(format!("{assignment:26} # {}", parameter.meaning))
}
