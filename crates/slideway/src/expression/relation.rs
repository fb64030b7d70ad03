//! Relations: the parts of an expression whose value jumps or has a kink where an argument passes a
//! threshold.
//!
//! Between two such places the expression is smooth if each relation keeps the *piece* that it is on: the
//! sign of the argument of `sign`, `step` and `abs`, the argument that `min` or `max` takes, the rows between
//! which the argument of a table lies. An integrator holds the pieces, watches the margins of the arguments,
//! and goes over to the next piece where a margin vanishes; so no step goes across a jump. Modelling
//! languages treat relations in the same way (Modelica Language Specification 3.6, section 8.5).

use super::evaluate::{Values, run};
use super::fault::ExpressionFault;
use super::function::{Binary, Unary};
use super::names::Symbol;
use super::program::{Expression, Operation};
use super::table::End;
use crate::interval::Real;

/// On which piece a relation is: the sign of its argument (`sign`, `step`, `abs`), 0 or 1 for the first or
/// second argument (`min`, `max`), the number of rows before the argument of a table, counted through all its
/// periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Piece {
    /// The relation stays on this piece.
    Held(i64),
    /// The argument decides at every evaluation.
    Free,
}

/// A relation within an expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RelationKind {
    /// Whether its arguments depend on time and parameters alone.
    pub(crate) of_time: bool,
    /// Whether its arguments depend on rates.
    pub(crate) of_rates: bool,
    /// Whether its value jumps somewhere; otherwise it has kinks only.
    pub(crate) jumps: bool,
}

impl Operation {
    fn is_relation(&self) -> bool {
        matches!(
            self,
            Self::Unary(Unary::Abs | Unary::Sign | Unary::Step)
                | Self::Binary(Binary::Min | Binary::Max)
                | Self::Table(_)
        )
    }

    /// The value with the piece that is held; smooth in the arguments.
    fn held<T: Real>(&self, arguments: &[T], piece: i64) -> T {
        match self {
            Self::Unary(Unary::Abs) if piece < 0 => -arguments[0],
            Self::Unary(Unary::Abs) => arguments[0],
            Self::Unary(Unary::Sign) => T::exactly(piece.signum() as f64),
            Self::Unary(Unary::Step) => {
                if piece < 0 {
                    T::zero()
                } else {
                    T::one()
                }
            }
            Self::Table(table) => table.on_piece(arguments[0], piece),
            _ => arguments[usize::from(piece != 0)],
        }
    }

    /// The piece on which numbers are.
    fn piece(&self, arguments: &[f64]) -> i64 {
        match self {
            Self::Unary(Unary::Step | Unary::Abs) => {
                if arguments[0] < 0.0 {
                    -1
                } else {
                    1
                }
            }
            Self::Binary(Binary::Min) => i64::from(arguments[1] < arguments[0]),
            Self::Binary(Binary::Max) => i64::from(arguments[1] > arguments[0]),
            Self::Table(table) => table.piece(arguments[0]),
            _ => arguments[0].partial_cmp(&0.0).map_or(0, |order| order as i64),
        }
    }

    /// How far arguments are from an end of a piece, positive within it; nothing where there is no end.
    fn margin<T: Real>(&self, arguments: &[T], piece: i64, end: End) -> Option<T> {
        match self {
            Self::Unary(_) => match (piece, end) {
                (piece, End::Lower) if piece > 0 => Some(arguments[0]),
                (piece, End::Upper) if piece < 0 => Some(-arguments[0]),
                _ => None,
            },
            Self::Binary(function) => {
                let excess = arguments[1] - arguments[0];
                let first_is_less = *function == Binary::Min;
                match (piece, end) {
                    (0, End::Upper) => Some(if first_is_less { excess } else { -excess }),
                    (1, End::Lower) => Some(if first_is_less { -excess } else { excess }),
                    _ => None,
                }
            }
            Self::Table(table) => table.margin(arguments[0], piece, end),
            Self::Number { .. } | Self::Symbol(_) => None,
        }
    }

    /// The piece beyond an end.
    fn beyond(&self, piece: i64, end: End) -> i64 {
        match self {
            Self::Table(table) => table.beyond(piece, end),
            Self::Unary(_) => -piece,
            _ => 1 - piece,
        }
    }
}

impl Expression {
    /// Its relations, in the order in which they are evaluated.
    pub(crate) fn relations(&self) -> Vec<RelationKind> {
        // What is on the stack during evaluation: whether it depends on coordinates, and on rates.
        let mut stack: Vec<[bool; 2]> = Vec::new();
        let mut relations = Vec::new();
        for step in self.steps() {
            let mut operand = || stack.pop().unwrap_or_default();
            let [of_coordinates, of_rates] = match &step.operation {
                Operation::Number { .. } | Operation::Symbol(Symbol::Parameter(_) | Symbol::Time) => {
                    [false; 2]
                }
                Operation::Symbol(symbol) => {
                    let is_coordinate = matches!(symbol, Symbol::Coordinate(_));
                    [is_coordinate, !is_coordinate]
                }
                Operation::Unary(_) | Operation::Table(_) => operand(),
                Operation::Binary(_) => {
                    let (one, other) = (operand(), operand());
                    [one[0] | other[0], one[1] | other[1]]
                }
            };
            stack.push([of_coordinates, of_rates]);
            if step.operation.is_relation() {
                let jumps = match &step.operation {
                    Operation::Unary(function) => *function != Unary::Abs,
                    Operation::Table(table) => table.jumps(),
                    _ => false,
                };
                relations.push(RelationKind { of_time: !(of_coordinates || of_rates), of_rates, jumps });
            }
        }
        relations
    }

    /// The value in SI units with every relation on its piece.
    ///
    /// # Errors
    /// As [`Expression::evaluate`].
    pub(crate) fn evaluate_on<T: Real>(
        &self,
        values: &Values<'_, T>,
        pieces: &[Piece],
    ) -> Result<T, ExpressionFault> {
        self.inspect(values, pieces, |_, _| {})
    }

    /// How far the arguments of a relation are from an end of its piece; nothing where there is no end or no
    /// value.
    pub(crate) fn margin<T: Real>(
        &self,
        values: &Values<'_, T>,
        pieces: &[Piece],
        (relation, end): (usize, End),
    ) -> Option<T> {
        let Some(Piece::Held(piece)) = pieces.get(relation) else { return None };
        let mut margin = None;
        let mut count = 0;
        let value = self.inspect(values, pieces, |operation, arguments| {
            if count == relation {
                margin = operation.margin(arguments, *piece, end);
            }
            count += 1;
        });
        // What is evaluated after the relation may fail: its arguments have a value.
        let _ = value;
        margin
    }

    /// The piece of a relation beyond an end of the one on which it is.
    pub(crate) fn beyond(&self, relation: usize, piece: i64, end: End) -> i64 {
        let mut operations = self.steps().iter().map(|step| &step.operation).filter(|one| one.is_relation());
        operations.nth(relation).map_or(piece, |operation| operation.beyond(piece, end))
    }

    /// The piece of a relation at numbers within these bounds; nothing where that is not certain.
    pub(crate) fn piece<T: Real>(
        &self,
        values: &Values<'_, T>,
        pieces: &[Piece],
        relation: usize,
    ) -> Option<i64> {
        let mut found = None;
        let mut count = 0;
        let value = self.inspect(values, pieces, |operation, arguments| {
            if count == relation {
                let middle: Vec<f64> = arguments.iter().map(|argument| argument.middle()).collect();
                let piece = operation.piece(&middle);
                let inside = |end: End| {
                    operation.margin(arguments, piece, end).is_none_or(|margin| margin.lower() > 0.0)
                };
                // The piece between both signs has no width.
                let has_width = !matches!(operation, Operation::Unary(_)) || piece != 0;
                found = (has_width && End::BOTH.into_iter().all(inside)).then_some(piece);
            }
            count += 1;
        });
        let _ = value;
        found
    }

    /// Evaluates on pieces and shows every relation with its arguments.
    fn inspect<T: Real>(
        &self,
        values: &Values<'_, T>,
        pieces: &[Piece],
        mut visit: impl FnMut(&Operation, &[T]),
    ) -> Result<T, ExpressionFault> {
        let mut pieces = pieces.iter();
        run(self, values, |operation, arguments| {
            if !operation.is_relation() {
                return operation.apply(arguments);
            }
            visit(operation, arguments);
            match pieces.next() {
                Some(Piece::Held(piece)) => operation.held(arguments, *piece),
                _ => operation.apply(arguments),
            }
        })
    }
}
