//! States in which hinges turn with friction, as the block mode problem has them: what sticks is held by equations of its
//! own, and the forces of the hinges that turn enter by their magnitudes.

use super::setup::Setup;
use super::state::Pattern;
use crate::configuration::null_space;
use crate::ids::ContactId;
use crate::kinetics::{Reaction, equilibration};
use crate::modes::blocks::{self, BlockProblem, BlockSolution};
use crate::modes::{ContactState, InfluenceCoefficients, SearchOptions, Side};
use crate::pattern::{ContactPhase, JointPhase};
use crate::problem::{TurningHinge, friction_of_contacts, preload_columns, without_rounding};
use crate::progress::Callback;
use nalgebra::{DMatrix, DVector, RowDVector};

/// Normal forces below this part of the greatest force may be on either side.
const ON_BOUNDARY: f64 = 1e-8;
/// A row that sticks is held by others already if it is no greater than this on the motions that they leave.
const HELD: f64 = 1e-9;

/// A state in which hinges turn.
pub(super) struct TurningState {
    /// What joints, hinges and contacts do.
    pub(super) pattern: Pattern,
    /// The force of each hinge with friction on its first body (N), zero where it sticks.
    pub(super) forces: Vec<[f64; 2]>,
}

/// States in which hinges turn.
pub(super) struct TurningStates {
    /// The states; where what sticks is statically indeterminate, those in which only some of it transmits friction.
    pub(super) list: Vec<TurningState>,
    /// Whether these are all.
    pub(super) decided: bool,
    /// Whether the friction of all that sticks is determined.
    pub(super) determinate: bool,
}

/// The states with these signs of all joints and hinges, of mechanisms whose guides share no load; nothing where the
/// equations are singular. Once the callback breaks they are not decided.
pub(super) fn turning_states(
    setup: &Setup,
    signs: &Pattern,
    motions: &DMatrix<f64>,
    progress: &mut Callback<'_>,
) -> Option<TurningStates> {
    let held = Held::new(setup, signs, motions);
    let blocks = Blocks::new(&held, signs);
    let problem = blocks.problem()?;
    let result = blocks::search(&problem, &SearchOptions::default(), progress);
    Some(TurningStates {
        list: result.solutions.iter().flat_map(|solution| blocks.states(solution)).collect(),
        decided: result.open.is_empty() && result.stopped.is_none(),
        determinate: held.determinate,
    })
}

/// The kinetic equations in which what sticks has rows of its own.
struct Held<'s> {
    setup: &'s Setup,
    matrix: DMatrix<f64>,
    load: DVector<f64>,
    /// Powers of two that bring rows and columns to order one.
    scales: [DVector<f64>; 2],
    /// Whether only hinges stick, and each has a row: how the friction of a joint is shared by its contacts is open.
    determinate: bool,
}

impl<'s> Held<'s> {
    fn new(setup: &'s Setup, signs: &Pattern, motions: &DMatrix<f64>) -> Self {
        let rows = independent_rows(setup, signs, motions);
        let sticking =
            |states: &[JointPhase]| states.iter().filter(|state| **state == JointPhase::Sticking).count();
        let determinate = sticking(&signs.joints) == 0 && sticking(&signs.hinges) == rows.len();
        let (size, given) = (setup.assembled.matrix.nrows(), setup.equations_of_motion());
        let mut matrix = setup.assembled.matrix.clone().resize(size + rows.len(), size + rows.len(), 0.0);
        let mut load = setup.assembled.load.clone().resize_vertically(size + rows.len(), 0.0);
        load.rows_mut(0, given).copy_from(&setup.loads());
        for (index, row) in rows.iter().enumerate() {
            matrix.view_mut((size + index, 0), (1, given)).copy_from(row);
            matrix.view_mut((0, size + index), (given, 1)).copy_from(&-row.transpose());
        }
        let (rows, columns) = equilibration(&matrix);
        let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
            rows[row] * matrix[(row, column)] * columns[column]
        });
        Self { setup, matrix: scaled, load, scales: [rows, columns], determinate }
    }

    /// The answers to some right-hand sides.
    fn answers(&self, right_hand_sides: &[DVector<f64>]) -> Option<Vec<DVector<f64>>> {
        let factors = self.matrix.clone().full_piv_lu();
        let one = |right_hand_side: &DVector<f64>| {
            let scaled = right_hand_side.component_mul(&self.scales[0]);
            factors.solve(&scaled).map(|answer| answer.component_mul(&self.scales[1]))
        };
        right_hand_sides.iter().map(one).collect()
    }

    /// Forces in the equations of motion, as a right-hand side.
    fn forces(&self, forces: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.load.len());
        let given = self.setup.equations_of_motion();
        all.rows_mut(0, given).copy_from(&forces.rows(0, given));
        all
    }
}

/// The rows of what sticks that say something which neither the joints of the mechanism nor the rows before say.
fn independent_rows(setup: &Setup, signs: &Pattern, motions: &DMatrix<f64>) -> Vec<RowDVector<f64>> {
    let mut motions = motions.clone();
    let mut found = Vec::new();
    let states = signs.joints.iter().chain(&signs.hinges).enumerate();
    for (joint, _) in states.filter(|(_, state)| **state == JointPhase::Sticking) {
        let row = setup.row(joint);
        let moves = &row * &motions;
        if moves.amax() > HELD * row.amax() * motions.amax() {
            motions = &motions * null_space(&DMatrix::from_rows(&[moves]));
            found.push(row);
        }
    }
    found
}

/// The block mode problem of a pattern of signs.
struct Blocks<'h, 's> {
    held: &'h Held<'s>,
    signs: Vec<JointPhase>,
    hinges: Vec<TurningHinge>,
}

impl<'h, 's> Blocks<'h, 's> {
    fn new(held: &'h Held<'s>, signs: &Pattern) -> Self {
        let circles = held.setup.mechanism.friction_circles.iter().zip(&signs.hinges).enumerate();
        let turning = circles.filter(|(_, (_, state))| **state != JointPhase::Sticking);
        let hinge =
            |(circle, (friction, state)): (usize, (&crate::mechanism::FrictionCircle, &JointPhase))| {
                TurningHinge { circle, joint: friction.joint, sense: state.sign() }
            };
        let signs = signs.joints.iter().chain(&signs.hinges).copied();
        Self { held, signs: signs.collect(), hinges: turning.map(hinge).collect() }
    }

    /// The sign of the sliding velocity at a contact, 0 where it sticks.
    fn sign(&self, k: usize) -> f64 {
        let sliders = &self.held.setup.sliders;
        let slider = sliders.iter().position(|slider| slider.contacts.contains(&k));
        slider.map_or(0.0, |slider| self.signs[slider].sign())
    }

    fn problem(&self) -> Option<BlockProblem> {
        let setup = self.held.setup;
        let contacts = &setup.mechanism.contacts;
        let layout = &setup.assembled.layout;
        let normal = (0..contacts.len()).map(|k| layout.reaction(Reaction::Normal(ContactId(k))));
        let circles = &setup.mechanism.friction_circles;
        let force = self
            .hinges
            .iter()
            .flat_map(|hinge| circles[hinge.circle].reactions().map(|force| layout.reaction(force)));
        let rows: Vec<usize> = normal.chain(force).collect::<Option<_>>()?;
        let answers = |columns: Vec<&DVector<f64>>| {
            let columns: Vec<DVector<f64>> =
                columns.into_iter().map(|column| self.held.forces(column)).collect();
            let answers = self.held.answers(&columns)?;
            Some(DMatrix::from_fn(rows.len(), answers.len(), |row, column| answers[column][rows[row]]))
        };
        let friction =
            |side: usize| answers(setup.assembled.friction.iter().map(|both| &both[side]).collect());
        let eta = without_rounding(&setup.mechanism, [friction(0)?, friction(1)?]);
        let [mu, preload] = friction_of_contacts(&setup.mechanism, &|k| self.sign(k) != 0.0);
        let load = self.held.answers(std::slice::from_ref(&self.held.load))?;
        let couples =
            answers(self.hinges.iter().map(|hinge| &setup.assembled.couples[hinge.circle]).collect())?;
        let turning = self.hinges.iter().zip(couples.column_iter());
        let coefficients = InfluenceCoefficients {
            eta_preload: preload_columns(&setup.mechanism, &eta),
            eta,
            mu,
            preload,
            velocity_signs: DVector::from_fn(contacts.len(), |k, _| self.sign(k)),
            frictionless: DVector::from_fn(rows.len(), |row, _| load[0][rows[row]]),
            shared: None,
            one_sided: Vec::new(),
            turning: turning
                .map(|(hinge, answers)| (answers.into_owned(), hinge.leverage(&circles[hinge.circle])))
                .collect(),
        };
        coefficients.numbers().problem().ok()
    }

    /// The states of a solution: contacts without a normal force may be on either side.
    fn states(&self, solution: &BlockSolution) -> Vec<TurningState> {
        let setup = self.held.setup;
        let mut forces = vec![[0.0; 2]; setup.mechanism.friction_circles.len()];
        for (hinge, force) in self.hinges.iter().zip(&solution.reactions) {
            forces[hinge.circle] = *force;
        }
        let (joints, hinges) = self.signs.split_at(setup.sliders.len());
        let state = |contacts| TurningState {
            pattern: Pattern { joints: joints.to_vec(), hinges: hinges.to_vec(), contacts },
            forces: forces.clone(),
        };
        self.sides(solution).into_iter().map(state).collect()
    }

    fn sides(&self, solution: &BlockSolution) -> Vec<Vec<ContactPhase>> {
        let mut all = vec![Vec::new()];
        for (k, state) in solution.states.iter().enumerate() {
            let vanishes = solution.forces[k].abs() <= ON_BOUNDARY * self.held.setup.units.force;
            let jumps = self.held.setup.mechanism.preload_jumps(ContactId(k));
            let options: &[ContactPhase] = match state {
                ContactState::Gap => &[ContactPhase::PreloadGap],
                _ if vanishes && self.sign(k) != 0.0 => ContactPhase::options(jumps),
                ContactState::Positive => &[ContactPhase::Pressed(Side::Positive)],
                ContactState::Negative => &[ContactPhase::Pressed(Side::Negative)],
            };
            all = all
                .into_iter()
                .flat_map(|sides: Vec<ContactPhase>| {
                    options.iter().map(move |side| sides.iter().copied().chain([*side]).collect())
                })
                .collect();
        }
        all
    }
}
