//! A fast test of patterns in which every joint slides: most of them are far from any state.

use super::instant::Instant;
use super::outputs::Group;
use super::system::Question;
use crate::pattern::{ContactPhase, JointPhase, Law, Phase};

/// Patterns are excluded only by slacks below this fraction of the greatest normal force, far beyond rounding
/// ...
const CLEAR: f64 = 1e-6;
/// ... and by equations in which no pivot is below this fraction of the greatest entry.
const REGULAR: f64 = 1e-6;

/// The equations `sigma_j p_j - sum_k eta_jk mu_k s_k p_k = N_j(0) + sum_k eta_jk F_k0 s_k` of a pattern
/// without preload gaps, with `p_k = |N_k|`, solved by elimination in reused memory.
pub(super) struct SlidingSieve<'s> {
    question: &'s Question<'s>,
    instant: &'s Instant<'s>,
    group: &'s Group,
    joint: Vec<Option<usize>>,
    laws: Vec<Law>,
    /// Row by row, with the right-hand side last.
    matrix: Vec<f64>,
    pressure: Vec<f64>,
}

impl<'s> SlidingSieve<'s> {
    /// A sieve for a question about the accelerations of a group of joints.
    pub(super) fn new(question: &'s Question<'s>, instant: &'s Instant<'s>, group: &'s Group) -> Self {
        let contacts = group.contacts.len();
        Self {
            question,
            instant,
            group,
            joint: group.contacts.iter().map(|&k| instant.joint_of(k)).collect(),
            laws: group.contacts.iter().map(|&k| instant.law(k, true)).collect(),
            matrix: vec![0.0; contacts * (contacts + 1)],
            pressure: vec![0.0; contacts],
        }
    }

    /// Whether a pattern is certainly not a state: a normal force has the wrong sign, or a joint that begins
    /// to slip accelerates against its direction. Patterns in which something sticks or is in a preload gap
    /// are not tested.
    pub(super) fn excludes(&mut self, phase: &Phase) -> bool {
        self.fill(phase).is_some() && self.solve() && (self.is_lifted() || self.is_pushed_back(phase))
    }

    /// Friction of a contact that slides and is pressed: at both faces, the factor of |N_k| and the constant.
    fn friction(&self, phase: &Phase, index: usize) -> Option<[[f64; 2]; 2]> {
        let k = self.group.contacts[index];
        let (JointPhase::Sliding(sign), ContactPhase::Pressed(side)) =
            (phase.joints[self.joint[index]?], phase.contacts[k])
        else {
            return None;
        };
        Some(self.laws[index].kinetic(side, sign))
    }

    /// What friction adds to an output, by the contact's own force for a unit of pressure and by the preload.
    fn effect(&self, row: usize, index: usize, [plus, minus]: [[f64; 2]; 2]) -> [f64; 2] {
        let k = self.group.contacts[index];
        let [at_plus, at_minus] = [0, 1].map(|side| self.question.outputs.columns[side][(row, k)]);
        [0, 1].map(|part| at_plus * plus[part] + at_minus * minus[part])
    }

    fn fill(&mut self, phase: &Phase) -> Option<()> {
        let contacts = self.pressure.len();
        let width = contacts + 1;
        for row in 0..contacts {
            self.matrix[row * width + contacts] = self.question.outputs.base[self.group.contacts[row]];
        }
        for k in 0..contacts {
            let friction = self.friction(phase, k)?;
            for row in 0..contacts {
                let [own, preload] = self.effect(self.group.contacts[row], k, friction);
                self.matrix[row * width + k] = -own;
                self.matrix[row * width + contacts] += preload;
            }
            let ContactPhase::Pressed(side) = phase.contacts[self.group.contacts[k]] else { return None };
            self.matrix[k * width + k] += side.sign();
        }
        Some(())
    }

    /// Elimination with partial pivoting; returns whether the equations are clearly regular.
    fn solve(&mut self) -> bool {
        let contacts = self.pressure.len();
        let width = contacts + 1;
        let entries = self.matrix.chunks_exact(width).flat_map(|row| &row[..contacts]);
        let greatest = entries.fold(0.0_f64, |greatest, entry| greatest.max(entry.abs()));
        for step in 0..contacts {
            let size = |row: usize| self.matrix[row * width + step].abs();
            let best =
                (step..contacts).fold(step, |best, row| if size(row) > size(best) { row } else { best });
            // Not `<`, so that NaN does not count as regular.
            if !(size(best) >= REGULAR * greatest && greatest.is_finite()) {
                return false;
            }
            for column in step..width {
                self.matrix.swap(step * width + column, best * width + column);
            }
            for row in step + 1..contacts {
                let factor = self.matrix[row * width + step] / self.matrix[step * width + step];
                for column in step..width {
                    self.matrix[row * width + column] -= factor * self.matrix[step * width + column];
                }
            }
        }
        for row in (0..contacts).rev() {
            let known: f64 =
                (row + 1..contacts).map(|k| self.matrix[row * width + k] * self.pressure[k]).sum();
            self.pressure[row] =
                (self.matrix[row * width + contacts] - known) / self.matrix[row * width + row];
        }
        true
    }

    fn clear(&self) -> f64 {
        CLEAR * self.pressure.iter().fold(1.0, |greatest: f64, pressure| greatest.max(pressure.abs()))
    }

    fn is_lifted(&self) -> bool {
        let clear = self.clear();
        self.pressure.iter().any(|pressure| *pressure < -clear)
    }

    fn is_pushed_back(&self, phase: &Phase) -> bool {
        let begins =
            |joint: &usize| self.question.stopped[*joint] && self.instant.joints[*joint].has_friction;
        self.group.joints.iter().copied().filter(begins).any(|joint| {
            let JointPhase::Sliding(sign) = phase.joints[joint] else { return false };
            let row = self.instant.sliding_output(joint);
            let mut acceleration = self.question.outputs.base[row];
            let mut greatest = acceleration.abs();
            for (k, pressure) in self.pressure.iter().enumerate() {
                let Some(friction) = self.friction(phase, k) else { return false };
                let [own, preload] = self.effect(row, k, friction);
                acceleration += own * pressure + preload;
                greatest = greatest.max((own * pressure).abs()).max(preload.abs());
            }
            sign * acceleration < -CLEAR * greatest.max(1.0)
        })
    }
}
