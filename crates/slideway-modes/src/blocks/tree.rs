//! The tree of pieces (theory of hinges, section 8).

use super::at_most_one::has_at_most_one;
use super::equations::Piece;
use super::open::{Undecided, point_of_continuum};
use super::problem::BlockProblem;
use super::relaxation::{Relaxed, RelaxedPoint, relax};
use super::result::OpenLabel;
use super::rigid::is_out_of_line;
use super::zero::{Zero, newton, prove, start};
use crate::interval::Interval;
use crate::problem::ContactState;
use crate::progress::{Callback, Progress};
use crate::search::{SearchOptions, StopReason};
use nalgebra::DVector;

/// Open contacts are decided once all sectors have at most this half angle, in rad.
const DECIDE_CONTACTS: f64 = 0.25;
/// Curves of solutions are looked for in pieces of at most this half angle, in rad.
const LOOK_FOR_CURVES: f64 = 0.01;
/// Sectors of this half angle are not divided further; a relaxation of them is as near as numbers are.
const SMALLEST: f64 = 1e-7;
/// Reactions below this share of the largest have no direction that is worth dividing.
const UNLOADED: f64 = 1e-9;

/// Gaps of the relaxation below this are rounding.
const MET: f64 = 1e-12;

/// What was found in the tree.
pub(super) struct Found {
    pub(super) zeros: Vec<Zero>,
    pub(super) undecided: Vec<Undecided>,
    pub(super) stopped: Option<StopReason>,
    pub(super) nodes: u64,
}

/// How the tree is searched.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Manner {
    /// Turns the first division of directions.
    pub(super) first_angle: f64,
    /// Whether the search ends at the first piece that cannot be decided.
    pub(super) all_or_nothing: bool,
}

/// Searches all pieces.
pub(super) struct Tree<'a, 'c> {
    problem: &'a BlockProblem,
    options: &'a SearchOptions,
    progress: &'a mut Callback<'c>,
    manner: Manner,
    smallest: f64,
    pivots: u64,
    found: Found,
}

/// What is known of a piece.
enum Decision {
    /// Everything.
    Done,
    /// It is to be divided.
    Open(Option<RelaxedPoint>),
}

impl<'a, 'c> Tree<'a, 'c> {
    pub(super) fn new(
        problem: &'a BlockProblem,
        options: &'a SearchOptions,
        progress: &'a mut Callback<'c>,
        manner: Manner,
    ) -> Self {
        // A relaxation is off by the square of the half angle.
        let smallest = SMALLEST.max(0.1 * problem.relative_radius().sqrt());
        let found = Found { zeros: Vec::new(), undecided: Vec::new(), stopped: None, nodes: 0 };
        Self { problem, options, progress, manner, smallest, pivots: 0, found }
    }

    /// Searches the tree below a piece.
    pub(super) fn search(mut self, root: Piece) -> Found {
        let mut stack = vec![root];
        while let Some(piece) = stack.pop() {
            if self.manner.all_or_nothing && !self.found.undecided.is_empty() {
                break;
            }
            if let Some(reason) = self.visit() {
                self.found.stopped = Some(reason);
                break;
            }
            if let Decision::Open(relaxed) = self.decide(&piece) {
                match self.parts(&piece, relaxed.as_ref()) {
                    Some(parts) => stack.extend(parts.into_iter().rev()),
                    None => self.found.undecided.push(Undecided::new(self.problem, piece, relaxed)),
                }
            }
        }
        self.found
    }

    /// Counts a node; why the search must end before it, if so.
    fn visit(&mut self) -> Option<StopReason> {
        if self.found.nodes >= self.options.nodes {
            return Some(StopReason::NodeLimit);
        }
        if self.found.zeros.len() > self.options.limits.solutions {
            return Some(StopReason::SolutionLimit);
        }
        let told = Progress {
            counted: "nodes",
            done: self.found.nodes,
            fraction: None,
            found: Some(self.found.zeros.len() as u64),
        };
        self.found.nodes += 1;
        (self.progress)(&told).is_break().then_some(StopReason::Cancelled)
    }

    fn decide(&mut self, piece: &Piece) -> Decision {
        let told = Progress { counted: "nodes", done: self.found.nodes, fraction: None, found: None };
        let mut proceed = || (self.progress)(&told).is_continue();
        if is_out_of_line(self.problem, piece, &mut self.pivots, &mut proceed) {
            return Decision::Done;
        }
        let relaxed = match relax(self.problem, piece, &mut self.pivots, &mut proceed) {
            Relaxed::Empty => return Decision::Done,
            Relaxed::Point(point) => Some(point),
            Relaxed::Unsolved => None,
        };
        if has_at_most_one(self.problem, piece) && self.settles(piece) {
            return Decision::Done;
        }
        let half_angle = piece.half_angle();
        if half_angle <= LOOK_FOR_CURVES
            && half_angle > 0.25 * LOOK_FOR_CURVES
            && let Some(point) = point_of_continuum(self.problem, piece)
        {
            let undecided = Undecided { label: OpenLabel::Continuum, piece: piece.clone(), point };
            self.found.undecided.push(undecided);
            return Decision::Done;
        }
        Decision::Open(relaxed)
    }

    /// Whether the only candidate for a solution of a piece with at most one is found, or none is left.
    ///
    /// The zero of the equations that Newton's method finds may lie outside the piece. If there is at most one
    /// in the hull of the piece and the zero, the piece holds no other. The states of its contacts may then be
    /// wrong: it is no solution, and there is none.
    fn settles(&mut self, piece: &Piece) -> bool {
        if self.problem.has_no_load() {
            // Zero is in every piece.
            return true;
        }
        let near = start(self.problem, piece).and_then(|start| newton(self.problem, &piece.states, start));
        let Some(point) = near else { return false };
        let Some(zero) = prove(self.problem, &piece.states, &point) else {
            // The proof does not depend on the sectors: it fails in every part, too.
            let is_hopeless = self.manner.all_or_nothing && self.is_of(piece, &point);
            if is_hopeless {
                let (piece, point) = (piece.clone(), point.as_slice().to_vec());
                self.found.undecided.push(Undecided { label: OpenLabel::TooSmall, piece, point });
            }
            return is_hopeless;
        };
        let wider = with_zero(self.problem, piece, &zero);
        if wider != *piece && !has_at_most_one(self.problem, &wider) {
            return false;
        }
        self.file(zero)
    }

    /// Whether a point lies in a piece in which all contacts are decided.
    fn is_of(&self, piece: &Piece, point: &DVector<f64>) -> bool {
        let is_on_side = |contact: usize| match piece.states[contact] {
            Some(ContactState::Gap) => (0.0..=1.0).contains(&point[contact]),
            Some(state) => state.sign() * point[contact] > 0.0,
            None => false,
        };
        let is_in_sector = |hinge: usize| {
            let reaction = self.problem.rows_of_hinge(hinge).map(|row| Interval::point(point[row]));
            piece.sectors[hinge].with(reaction) == piece.sectors[hinge]
        };
        (0..self.problem.contacts()).all(is_on_side) && (0..self.problem.hinges()).all(is_in_sector)
    }

    /// Keeps a zero if it is a solution; `false` if that is open.
    fn file(&mut self, zero: Zero) -> bool {
        let doubts =
            |contact: usize| zero.states[contact].map_or(Some(true), |state| zero.agrees(contact, state));
        let doubts: Vec<Option<bool>> = (0..self.problem.contacts()).map(doubts).collect();
        if doubts.contains(&Some(false)) {
            return true;
        }
        let open: Vec<usize> = (0..doubts.len()).filter(|&contact| doubts[contact].is_none()).collect();
        if open.is_empty() {
            self.found.keep(zero);
            return true;
        }
        if open.iter().any(|&contact| self.problem.has_jump(contact)) {
            return false;
        }
        let mut states = zero.states.clone();
        open.iter().for_each(|&contact| states[contact] = None);
        let Some(at_border) = prove(self.problem, &states, &zero.point) else { return false };
        let is_same =
            zero.enclosure.iter().zip(&at_border.isolation).all(|(inner, outer)| outer.encloses(*inner));
        if is_same {
            self.found.keep(at_border);
        }
        is_same
    }

    /// The parts of a piece; `None` if it is too small to divide.
    fn parts(&self, piece: &Piece, relaxed: Option<&RelaxedPoint>) -> Option<Vec<Piece>> {
        let contacts = self.problem.contacts();
        let gap = |block: usize| relaxed.map_or(0.0, |point| point.gaps[block]);
        let open = (0..contacts).filter(|&contact| piece.states[contact].is_none());
        let contact = open.max_by(|&one, &other| gap(one).total_cmp(&gap(other)));
        let limit = if contact.is_some() { DECIDE_CONTACTS } else { self.smallest };
        let wide = (0..self.problem.hinges()).filter(|&hinge| {
            piece.sectors[hinge].half_angle() > limit && self.is_loaded(hinge, relaxed, limit)
        });
        let order = |hinge: usize| (gap(contacts + hinge), piece.sectors[hinge].half_angle());
        let hinge = wide.max_by(|&one, &other| {
            let (one, other) = (order(one), order(other));
            one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1))
        });
        // A point that meets the conditions of all hinges is not cut off by dividing them.
        let cuts =
            |hinge: &usize| contact.is_none_or(|contact| gap(contact) <= MET || gap(contacts + hinge) > MET);
        if let Some(hinge) = hinge.filter(cuts) {
            let part = |sector| {
                let mut part = piece.clone();
                part.sectors[hinge] = sector;
                part
            };
            return Some(piece.sectors[hinge].parts(self.manner.first_angle).into_iter().map(part).collect());
        }
        let contact = contact?;
        let part = |&state: &ContactState| {
            let mut part = piece.clone();
            part.states[contact] = Some(state);
            part
        };
        Some(ContactState::options(self.problem.has_jump(contact)).iter().map(part).collect())
    }

    /// Whether the direction of a hinge matters: its reaction does not vanish, or its sector is wide.
    fn is_loaded(&self, hinge: usize, relaxed: Option<&RelaxedPoint>, limit: f64) -> bool {
        let Some(point) = relaxed.filter(|_| limit < LOOK_FOR_CURVES) else { return true };
        let size = |rows: [usize; 2]| point.unknowns[rows[0]].hypot(point.unknowns[rows[1]]);
        let largest = point.unknowns.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        size(self.problem.rows_of_hinge(hinge)) > UNLOADED * largest
    }
}

/// The piece that contains a zero, too.
fn with_zero(problem: &BlockProblem, piece: &Piece, zero: &Zero) -> Piece {
    let sector = |hinge: usize| {
        let vector = problem.rows_of_hinge(hinge).map(|row| zero.enclosure[row]);
        piece.sectors[hinge].with(vector)
    };
    Piece { states: piece.states.clone(), sectors: (0..problem.hinges()).map(sector).collect() }
}

impl Found {
    /// The solution, if it is proven to be the only one.
    pub(super) fn only(&self) -> Option<&Zero> {
        let [zero] = self.zeros.as_slice() else { return None };
        (self.undecided.is_empty() && self.stopped.is_none()).then_some(zero)
    }

    /// Adds a solution unless it is known.
    ///
    /// Two zeros are one if one box without another zero contains the enclosure of the other, and the equations
    /// of the former hold for both.
    pub(super) fn keep(&mut self, zero: Zero) {
        if self.zeros.iter().any(|known| is_part(&zero, known) || is_part(known, &zero)) {
            return;
        }
        let overlaps = |known: &Zero| {
            let pairs = zero.enclosure.iter().zip(&known.enclosure);
            pairs.into_iter().all(|(one, other)| one.intersection(*other).is_some())
        };
        let is_open =
            self.zeros.iter().any(|known| may_be_of(&zero.states, &known.states) && overlaps(known));
        if is_open {
            self.undecided.push(Undecided::at(&zero, OpenLabel::TooSmall));
        }
        self.zeros.push(zero);
    }
}

/// Whether a zero is the one in the box of another.
fn is_part(zero: &Zero, known: &Zero) -> bool {
    // Where the side is open, the equations are those of the side on which the contact is certainly pressed.
    let is_pressed = |contact: usize, state: ContactState| {
        zero.states[contact].is_none()
            && state != ContactState::Gap
            && zero.agrees(contact, state) == Some(true)
    };
    let holds = |contact: usize| {
        known.states[contact]
            .is_none_or(|state| zero.states[contact] == Some(state) || is_pressed(contact, state))
    };
    let inside = |(inner, outer): (&Interval, &Interval)| outer.encloses(*inner);
    (0..known.states.len()).all(holds) && zero.enclosure.iter().zip(&known.isolation).all(inside)
}

/// Whether states of contacts have something in common.
fn may_be_of(one: &[Option<ContactState>], other: &[Option<ContactState>]) -> bool {
    one.iter().zip(other).all(|(one, other)| one.is_none() || other.is_none() || one == other)
}
