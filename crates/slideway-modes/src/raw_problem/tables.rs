//! The report as a NumPy archive.

use std::iter;
use std::ops::Range;

use super::report::{BeyondRange, ContinuumPart, NamedRange, RawReport, RawSolution, Unknowns};
use super::{npy, npz};

/// The report as a NumPy archive (`.npz`).
///
/// Arrays with the unknowns have one row for each solution: `z` and `w`, or `x`, or `normal_forces` and `y`;
/// the same applies to `signs`, `on_boundary`, `residual` and `enclosure_radius` (NaN if not
/// determined). States in preload gaps are in arrays with the prefix `gap_`; `gap_shares` is NaN outside a
/// gap. The rows of `vertex_...` and `direction_...` belong to the continua and parts whose numbers are in
/// `vertex_continuum`, `vertex_part`, `direction_continuum` and `direction_part`; they are zero outside their
/// part, so that a continuum is the sum of its parts. Unknowns beyond the range of floating-point numbers are
/// NaN; if there are any, `beyond_range_row` (of the solution), `beyond_range_index`, `beyond_range_name` and
/// `beyond_range_value` describe each of them, with the prefix for those of gap states. `status`, `complete`,
/// `partial`, `open`, `type`, `count`, `gap_state_count`, `continuum_count` and `schema` are those of
/// [`RawReport`]. If there is no solution, `within_rounding` says whether there is one within rounding of the
/// numbers, which is then the row of `within_rounding_z`, ... If requested, `every_right_hand_side` is the
/// answer of [`RawReport::every_right_hand_side`].
pub fn to_npz(report: &RawReport) -> Vec<u8> {
    let mut archive = Archive { size: report.size, arrays: Vec::new() };
    let status = serde_json::to_value(report.status).ok();
    let status = status.as_ref().and_then(serde_json::Value::as_str).unwrap_or_default();
    for (name, text) in [
        ("schema", report.schema),
        ("type", report.kind.word()),
        ("status", status),
        ("complete", report.complete.as_str()),
        ("count", &report.count),
        ("gap_state_count", &report.gap_state_count),
        ("continuum_count", &report.continuum_count),
        ("strategy", &report.strategy),
    ] {
        archive.push(name, npy::write_texts(&[], &[text]));
    }
    archive.push("partial", npy::write_truths(&[], &[report.partial]));
    let open: Vec<&str> = report.open.iter().map(String::as_str).collect();
    archive.push("open", npy::write_texts(&[open.len()], &open));
    if let Some(within) = &report.within_rounding {
        archive.push("within_rounding", npy::write_texts(&[], &[within.answer.as_str()]));
        archive.unknowns(report, "within_rounding_", &within.unknowns.iter());
    }
    if let Some(every) = &report.every_right_hand_side {
        archive.push("every_right_hand_side", npy::write_texts(&[], &[every.answer.word()]));
    }
    archive.solutions(report);
    archive.gap_states(&report.gap_states);
    archive.continua(report);
    let arrays: Vec<(&str, Vec<u8>)> =
        archive.arrays.iter().map(|(name, bytes)| (name.as_str(), bytes.clone())).collect();
    npz::write(&arrays)
}

struct Archive {
    size: usize,
    arrays: Vec<(String, Vec<u8>)>,
}

impl Archive {
    fn push(&mut self, name: &str, bytes: Vec<u8>) {
        self.arrays.push((name.to_owned(), bytes));
    }

    /// One row for each list of unknowns, in one array for each name.
    fn unknowns<'r>(
        &mut self,
        report: &RawReport,
        prefix: &str,
        rows: &(impl Iterator<Item = &'r Unknowns> + Clone),
    ) {
        for (at, NamedRange { name, indices }) in report.names().into_iter().enumerate() {
            let values: Vec<f64> = rows.clone().flat_map(|row| row.named()[at].1.to_vec()).collect();
            let sizes = shape(rows.clone().count(), indices.as_ref());
            self.push(&format!("{prefix}{name}"), npy::write_numbers(&sizes, &values));
        }
    }

    fn solutions(&mut self, report: &RawReport) {
        let solutions = &report.solutions;
        self.unknowns(report, "", &solutions.iter().map(|solution| &solution.unknowns));
        self.push("signs", self.signs(solutions));
        let on_boundary: Vec<bool> = solutions.iter().map(|solution| solution.on_boundary).collect();
        self.push("on_boundary", npy::write_truths(&[solutions.len()], &on_boundary));
        let column = |value: fn(&RawSolution) -> f64| {
            npy::write_numbers(&[solutions.len()], &solutions.iter().map(value).collect::<Vec<_>>())
        };
        let radius = column(|solution| solution.enclosure_radius.unwrap_or(f64::NAN));
        let residual = column(|solution| solution.residual.unwrap_or(f64::NAN));
        self.push("enclosure_radius", radius);
        self.push("residual", residual);
        self.beyond_range("", solutions);
    }

    /// One entry for each unknown without a floating-point number.
    fn beyond_range(&mut self, prefix: &str, solutions: &[RawSolution]) {
        let rows = (0_i64..).zip(solutions);
        let all: Vec<(i64, &BeyondRange)> = rows
            .flat_map(|(row, solution)| solution.beyond_range.iter().map(move |one| (row, one)))
            .collect();
        if all.is_empty() {
            return;
        }
        let rows: Vec<i64> = all.iter().map(|(row, _)| *row).collect();
        let index: Vec<i64> =
            all.iter().map(|(_, one)| i64::try_from(one.index).unwrap_or(i64::MAX)).collect();
        let names: Vec<&str> = all.iter().map(|(_, one)| one.name.as_str()).collect();
        let values: Vec<&str> = all.iter().map(|(_, one)| one.value.as_str()).collect();
        let size = [all.len()];
        self.push(&format!("{prefix}beyond_range_row"), npy::write_integers(&size, &rows));
        self.push(&format!("{prefix}beyond_range_index"), npy::write_integers(&size, &index));
        self.push(&format!("{prefix}beyond_range_name"), npy::write_texts(&size, &names));
        self.push(&format!("{prefix}beyond_range_value"), npy::write_texts(&size, &values));
    }

    fn signs(&self, solutions: &[RawSolution]) -> Vec<u8> {
        let signs: Vec<i64> = solutions
            .iter()
            .flat_map(|solution| solution.signs.iter().map(|&sign| i64::from(sign)))
            .collect();
        npy::write_integers(&[solutions.len(), self.size], &signs)
    }

    fn gap_states(&mut self, states: &[RawSolution]) {
        if states.is_empty() {
            return;
        }
        for (at, (name, _)) in states[0].unknowns.named().into_iter().enumerate() {
            let values: Vec<f64> =
                states.iter().flat_map(|state| state.unknowns.named()[at].1.to_vec()).collect();
            self.push(&format!("gap_{name}"), npy::write_numbers(&[states.len(), self.size], &values));
        }
        self.push("gap_signs", self.signs(states));
        let mut shares = vec![f64::NAN; states.len() * self.size];
        for (row, state) in states.iter().enumerate() {
            for gap in &state.gaps {
                shares[row * self.size + gap.index] = gap.lambda;
            }
        }
        self.push("gap_shares", npy::write_numbers(&[states.len(), self.size], &shares));
        let vary: Vec<bool> = states.iter().map(|state| state.shares_vary).collect();
        self.push("gap_shares_vary", npy::write_truths(&[vary.len()], &vary));
        self.beyond_range("gap_", states);
    }

    fn continua(&mut self, report: &RawReport) {
        let continua = &report.continua;
        if continua.is_empty() {
            return;
        }
        self.corners(report, "vertex", |part| &part.vertices);
        self.corners(report, "direction", |part| &part.directions);
        let patterns: Vec<&str> = continua.iter().map(|continuum| continuum.pattern.as_str()).collect();
        self.push("continuum_pattern", npy::write_texts(&[patterns.len()], &patterns));
    }

    /// Rows for the vertices or the directions of all parts, zero outside their part, with the indices of the
    /// continuum and part.
    fn corners(&mut self, report: &RawReport, name: &str, of: fn(&ContinuumPart) -> &[Unknowns]) {
        let mut rows: Vec<(i64, i64, &ContinuumPart, &Unknowns)> = Vec::new();
        for (number, continuum) in (0_i64..).zip(&report.continua) {
            for (part_number, part) in (0_i64..).zip(&continuum.parts) {
                rows.extend(of(part).iter().map(|row| (number, part_number, part, row)));
            }
        }
        for (at, NamedRange { name: unknown, indices }) in report.names().into_iter().enumerate() {
            let sizes = shape(rows.len(), indices.as_ref());
            let width = sizes.get(1).copied().unwrap_or(1);
            let mut values = vec![0.0; rows.len() * width];
            for ((_, _, part, row), values) in rows.iter().zip(values.chunks_exact_mut(width.max(1))) {
                let places: Vec<usize> = match &indices {
                    Some(range) => part
                        .indices
                        .iter()
                        .filter(|index| range.contains(index))
                        .map(|index| index - range.start)
                        .collect(),
                    None => vec![0],
                };
                places.iter().zip(row.named()[at].1).for_each(|(&place, &value)| values[place] = value);
            }
            self.push(&format!("{name}_{unknown}"), npy::write_numbers(&sizes, &values));
        }
        let (continua, parts): (Vec<i64>, Vec<i64>) = rows.iter().map(|row| (row.0, row.1)).unzip();
        self.push(&format!("{name}_continuum"), npy::write_integers(&[rows.len()], &continua));
        self.push(&format!("{name}_part"), npy::write_integers(&[rows.len()], &parts));
    }
}

/// The sizes of an array with a row for each of several solutions; a payoff, which has no index, is a number.
fn shape(rows: usize, indices: Option<&Range<usize>>) -> Vec<usize> {
    iter::once(rows).chain(indices.map(Range::len)).collect()
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};
    use std::ops::ControlFlow;

    use super::super::{RawProblem, npy, solve};
    use super::to_npz;
    use crate::search::SearchOptions;

    #[test]
    fn an_archive_holds_the_solutions_row_by_row() {
        let problem = RawProblem::from_json(br#"{"M": [[-1, 0], [0, -1]], "q": [1, 2]}"#).expect("a problem");
        let report = solve(&problem, &SearchOptions::default(), 3, &mut |_| ControlFlow::Continue(()))
            .expect("finite");
        let bytes = to_npz(&report);
        let mut archive = zip::ZipArchive::new(Cursor::new(&bytes)).expect("an archive");
        let mut content = |name: &str| {
            let mut content = Vec::new();
            archive.by_name(name).expect(name).read_to_end(&mut content).expect(name);
            content
        };
        let z = npy::numbers("z", &content("z.npy"), 100).expect("numbers");
        let w = npy::numbers("w", &content("w.npy"), 100).expect("numbers");
        assert_eq!(z.sizes, [3, 2]);
        for (at, (z, w)) in z.values.iter().zip(&w.values).enumerate() {
            assert_eq!(*w, [1.0, 2.0][at % 2] - z);
        }
        for (name, text) in [("count", "4"), ("complete", "proven"), ("type", "lcp"), ("status", "several")] {
            assert_eq!(npy::text(name, &content(&format!("{name}.npy"))), Ok(Some(text.to_owned())));
        }
        // The output contains no time.
        assert_eq!(bytes, to_npz(&report));
    }
}
