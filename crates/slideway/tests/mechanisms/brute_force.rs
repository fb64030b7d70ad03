//! The mode problem by an LU factorization for every pattern, from the numbers of the report and the drawing.

use crate::answers::try_report_on;
use crate::drawing::{Drawing, SliderKind};
use nalgebra::{DMatrix, DVector};
use slideway::configuration::Configuration;
use slideway::fault::FaultKind;
use slideway::ids::ContactId;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::report::{Solution, SolveReport};

/// A drawing with its report and all solutions by brute force.
pub(crate) struct Solved {
    pub(crate) drawing: Drawing,
    pub(crate) report: SolveReport,
    pub(crate) patterns: Vec<Pattern>,
}

/// A pattern of signs and what its equations give.
pub(crate) struct Pattern {
    pub(crate) signs: Vec<f64>,
    /// |N_k|; a negative one contradicts the pattern.
    pub(crate) y: DVector<f64>,
    pub(crate) determinant: f64,
    /// Whether rounding may decide about it: ill-conditioned, or some y near zero.
    pub(crate) delicate: bool,
}

impl Pattern {
    pub(crate) fn is_solution(&self) -> bool {
        self.y.iter().all(|y| *y >= 0.0)
    }

    pub(crate) fn normal_forces(&self) -> Vec<f64> {
        self.y.iter().zip(&self.signs).map(|(y, sign)| y * sign).collect()
    }

    pub(crate) fn name(&self) -> String {
        self.signs.iter().map(|sign| if *sign > 0.0 { '+' } else { '-' }).collect()
    }
}

impl Solved {
    /// Nothing where the random state cannot be reached.
    pub(crate) fn new(drawing: Drawing) -> Option<Self> {
        let text = drawing.text();
        let report = match try_report_on(&text) {
            Ok(report) => report,
            Err(faults) => {
                let accepted = faults.sorted().iter().all(|fault| unreachable(&fault.kind));
                assert!(accepted, "{faults}\n{text}");
                return None;
            }
        };
        let patterns = patterns(&drawing, &report);
        Some(Self { drawing, report, patterns })
    }

    /// Whether rounding may decide which patterns are solutions, or whether a guided slider tips.
    pub(crate) fn is_delicate(&self) -> bool {
        let tips_barely = self.report.rejected.iter().any(|rejection| {
            (rejection.couple.abs() - rejection.limit).abs() < 1e-6 * rejection.couple.abs()
        });
        tips_barely || self.patterns.iter().any(|pattern| pattern.delicate)
    }

    /// The report's solution with this pattern.
    pub(crate) fn solution(&self, pattern: &str) -> Option<&Solution> {
        self.report.solutions.iter().find(|solution| solution.pattern == pattern)
    }
}

/// Whether a random state cannot be reached for this reason.
pub(crate) fn unreachable(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::NotAssembled { .. }
            | FaultKind::SingularPosition { .. }
            | FaultKind::DependentCoordinates { .. }
            | FaultKind::OverlapVanished { .. }
    )
}

/// s_k, the signs of the sliding velocities.
pub(crate) fn velocity_signs(drawing: &Drawing) -> Vec<f64> {
    let mechanism = Mechanism::new(&Model::parse(&drawing.text()).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let contacts = 0..mechanism.contacts.len();
    contacts.map(|k| configuration.contact(&mechanism, ContactId(k)).sliding_velocity.signum()).collect()
}

fn patterns(drawing: &Drawing, report: &SolveReport) -> Vec<Pattern> {
    let contacts = drawing.contacts();
    let r = contacts.len();
    let speeds = velocity_signs(drawing);
    let matrix = |rows: &[Vec<f64>]| DMatrix::from_fn(r, r, |j, k| rows[j][k]);
    let eta = [matrix(&report.influence.eta_positive), matrix(&report.influence.eta_negative)];
    let frictionless = DVector::from_row_slice(&report.influence.normal_forces);
    let mut patterns = Vec::new();
    for number in 0..1_usize << r {
        let signs: Vec<f64> =
            (0..r).map(|k| if number >> (r - 1 - k) & 1 == 0 { 1.0 } else { -1.0 }).collect();
        let mut columns = DMatrix::zeros(r, r);
        let mut load = frictionless.clone();
        for (k, (_, slider, contact)) in contacts.iter().enumerate() {
            let side = usize::from(signs[k] < 0.0);
            // The couple of a guided slider takes up the moment of friction, so both versions are the same.
            let guided = slider.kind == SliderKind::Guided;
            let column = eta[if guided { 0 } else { side }].column(k);
            let preload_column = if contact.centred_preload {
                (eta[0].column(k) + eta[1].column(k)) / 2.0
            } else {
                column.into_owned()
            };
            columns.set_column(k, &(-contact.mu[side] * speeds[k] * column));
            columns[(k, k)] += signs[k];
            load += contact.preload[side] * speeds[k] * preload_column;
        }
        let values = columns.clone().singular_values();
        let ill_conditioned = values.min() < 1e-5 * values.max();
        let determinant = columns.determinant();
        let y = columns.lu().solve(&load).unwrap_or_else(|| DVector::from_element(r, f64::NAN));
        let delicate = ill_conditioned || !y.iter().all(|value| value.abs() > 1e-6 * y.amax());
        patterns.push(Pattern { signs, y, determinant, delicate });
    }
    patterns
}
