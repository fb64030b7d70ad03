//! Parameters that are known within bounds, in sentences.

use super::text::{capital, count};
use super::{CountStretch, SolveReport, UncertainParameter, Uncertainty};

impl SolveReport {
    /// The answer for all values of parameters that are known within bounds, in sentences: "1 solution for
    /// every value, proven with 3 parts."; none without such parameters.
    pub fn for_all_values(&self) -> Vec<String> {
        let Some(uncertainty) = &self.uncertainty else { return Vec::new() };
        let proven = format!(
            "{} Proven with {}.",
            uncertainty.counts_in_words(),
            count(uncertainty.parts, "part", "parts")
        );
        let open =
            uncertainty.open.iter().map(|reason| format!("Not all values could be decided: {reason}."));
        std::iter::once(proven).chain(open).collect()
    }
}

impl Uncertainty {
    /// What holds for all values, and the words before the answer, which holds for the middle: "One solution for every
    /// mu from 0.3 to 0.4. In the middle, mu = 0.35: it moves: push needs 30 N."
    pub(super) fn before(&self, answer: &str) -> String {
        let middle = |parameter: &UncertainParameter| {
            format!("{} = {}", parameter.name, parameter.shown_in.brief(parameter.value))
        };
        let middle: Vec<String> = self.parameters.iter().map(middle).collect();
        let answer =
            answer.strip_prefix("It ").map_or_else(|| answer.to_owned(), |rest| format!("it {rest}"));
        format!("{} In the middle, {}: {answer}", self.counts_in_words(), middle.join(", "))
    }

    /// The number of solutions: "One solution for every mu from 0.6 to 0.65." Where it depends on the only parameter:
    /// "From mu = 0.6 to 0.6667 one solution, from 0.6667 to 0.7 no solution."
    fn counts_in_words(&self) -> String {
        let range = |range: &UncertainParameter| {
            let value = |value: f64| range.shown_in.brief(value);
            format!("{} from {} to {}", range.name, value(range.from), value(range.to))
        };
        let ranges = self.parameters.iter().map(range).collect::<Vec<_>>().join(", ");
        if self.most_solutions == Some(self.least_solutions) {
            return format!("{} for every {ranges}.", capital(&solutions(self.least_solutions)));
        }
        if let Some(stretches) = self.stretches_in_words() {
            return stretches;
        }
        let numbers: Vec<String> = self.proven_counts.iter().map(ToString::to_string).collect();
        match (numbers.as_slice(), self.most_solutions) {
            ([_, .., _], _) => {
                format!(
                    "The number of solutions depends on {ranges}: {} for some values.",
                    numbers.join(" or ")
                )
            }
            (_, Some(most)) => {
                format!("Between {} and {most} solutions for {ranges}.", self.least_solutions)
            }
            (_, None) => format!("At least {} for every {ranges}.", solutions(self.least_solutions)),
        }
    }

    /// Returns the numbers of solutions along the only parameter. Returns `None` with several parameters, and where
    /// nothing is proven of any value.
    fn stretches_in_words(&self) -> Option<String> {
        let parameter = self.parameters.first().filter(|_| !self.proven_counts.is_empty())?;
        let value = |value: f64| parameter.shown_in.brief(value);
        let is_told = |stretch: &&CountStretch| value(stretch.from) != value(stretch.to);
        let told: Vec<&CountStretch> = self.stretches.iter().filter(is_told).collect();
        let words = told.iter().enumerate().map(|(index, stretch)| {
            let name = if index == 0 { format!("{} = ", parameter.name) } else { String::new() };
            let number = match stretch.most_solutions {
                Some(most) if most == stretch.least_solutions => solutions(most),
                _ => "not decided".to_owned(),
            };
            format!("from {name}{} to {} {number}", value(stretch.from), value(stretch.to))
        });
        let words: Vec<String> = words.collect();
        (!words.is_empty()).then(|| capital(&words.join(", ")) + ".")
    }
}

/// "one solution", "3 solutions", "none"
fn solutions(number: usize) -> String {
    match number {
        0 => "no solution".to_owned(),
        1 => "one solution".to_owned(),
        several => format!("{several} solutions"),
    }
}
