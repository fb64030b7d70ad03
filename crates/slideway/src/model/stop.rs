//! Stops of a block at the ends of its travel.

use serde::Serialize;

/// Stop of a block at an end of its travel: by numbers (`T` is `f64` or an interval), or by formulas.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Stop<T = f64> {
    /// An impact.
    Impact {
        /// The part of the sliding velocity with which the block comes back, from 0 to 1.
        restitution: T,
    },
    /// A pad: at the depth d beyond the end it pushes with max(0, k d + c d').
    Pad {
        /// Stiffness k (N/m).
        stiffness: T,
        /// Damping coefficient c (N s/m).
        damping: T,
    },
}

impl<T: Copy> Stop<T> {
    /// Returns the stop with other numbers.
    pub(crate) fn map<U>(self, value: impl Fn(T) -> U) -> Stop<U> {
        match self {
            Self::Impact { restitution } => Stop::Impact { restitution: value(restitution) },
            Self::Pad { stiffness, damping } => {
                Stop::Pad { stiffness: value(stiffness), damping: value(damping) }
            }
        }
    }

    /// The restitution of an impact.
    pub fn restitution(self) -> Option<T> {
        match self {
            Self::Impact { restitution } => Some(restitution),
            Self::Pad { .. } => None,
        }
    }

    /// Stiffness and damping of a pad.
    pub fn pad(self) -> Option<[T; 2]> {
        match self {
            Self::Impact { .. } => None,
            Self::Pad { stiffness, damping } => Some([stiffness, damping]),
        }
    }
}
