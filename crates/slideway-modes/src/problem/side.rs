//! The sides of contacts, quantities that have one value for each side, and the names of the parts of a
//! problem.

use std::fmt;

/// The side on which a contact is pressed: the sign `sigma` of its normal force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// `N > 0`.
    Positive,
    /// `N < 0`.
    Negative,
}

impl Side {
    /// Both sides, in the order in which patterns are enumerated.
    pub const BOTH: [Self; 2] = [Self::Positive, Self::Negative];

    /// The sign `sigma` of the side, `1.0` or `-1.0`.
    ///
    /// ```
    /// use slideway_modes::Side;
    /// assert_eq!(Side::Negative.sign(), -1.0);
    /// ```
    pub fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }
}

/// A quantity that has one value for each side of the contacts.
#[derive(Debug, Clone, PartialEq)]
pub struct BySide<T> {
    /// The value for contacts pressed towards `+n`.
    pub positive: T,
    /// The value for contacts pressed towards `-n`.
    pub negative: T,
}

impl<T> BySide<T> {
    /// The value for one side.
    pub fn get(&self, side: Side) -> &T {
        match side {
            Side::Positive => &self.positive,
            Side::Negative => &self.negative,
        }
    }

    /// The value of a function for each side.
    pub fn of(mut value: impl FnMut(Side) -> T) -> Self {
        Self { positive: value(Side::Positive), negative: value(Side::Negative) }
    }

    /// A function of the value for each side.
    pub fn map<U>(&self, mut value: impl FnMut(&T) -> U) -> BySide<U> {
        BySide::of(|side| value(self.get(side)))
    }

    /// A function of the value for each side, which may fail.
    ///
    /// # Errors
    /// The first one of the function.
    pub fn try_map<U, E>(&self, value: impl Fn(Side, &T) -> Result<U, E>) -> Result<BySide<U>, E> {
        let [positive, negative] = Side::BOTH.map(|side| value(side, self.get(side)));
        Ok(BySide { positive: positive?, negative: negative? })
    }
}

impl<T: Clone> BySide<T> {
    /// The same value for both sides.
    ///
    /// ```
    /// use slideway_modes::{BySide, Side};
    /// assert_eq!(*BySide::same(0.1).get(Side::Negative), 0.1);
    /// ```
    pub fn same(value: T) -> Self {
        Self { positive: value.clone(), negative: value }
    }
}

/// The part of the data to which an error refers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProblemPart {
    /// Columns `c_k` of one side, or `eta`, `M`, `A`: one column per contact.
    Columns(Side),
    /// Jump vectors `d_k` of one side, or the preload's influence coefficients.
    Jumps(Side),
    /// Coefficients of friction of one side.
    Friction(Side),
    /// Preload friction `F_k0` of one side.
    Preload(Side),
    /// Signs of the sliding velocities.
    VelocitySigns,
    /// The right-hand side `N(0)`, `b` or `q`.
    RightHandSide,
}

impl fmt::Display for ProblemPart {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, side) = match self {
            Self::Columns(side) => ("columns", Some(side)),
            Self::Jumps(side) => ("jumps", Some(side)),
            Self::Friction(side) => ("coefficients of friction", Some(side)),
            Self::Preload(side) => ("preload friction", Some(side)),
            Self::VelocitySigns => ("velocity signs", None),
            Self::RightHandSide => ("right-hand side", None),
        };
        match side {
            Some(Side::Positive) => write!(formatter, "{name} of the positive side"),
            Some(Side::Negative) => write!(formatter, "{name} of the negative side"),
            None => formatter.write_str(name),
        }
    }
}
