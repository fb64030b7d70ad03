//! Typed indices, so that a body can never be looked up with the number of a contact.

use serde::{Deserialize, Serialize};

macro_rules! index {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        pub struct $name(pub usize);

        impl $name {
            /// Position in the list of its kind.
            pub fn index(self) -> usize {
                self.0
            }
        }
    )*};
}

index! {
    /// A body of the mechanism; ground has no number, see [`Frame`].
    BodyId,
    /// A joint, in the order of the model file.
    JointId,
    /// A contact with friction, in the order of the model file.
    ContactId,
    /// A chosen coordinate.
    CoordinateId,
    /// A drive.
    DriveId,
    /// A formula of the model.
    FormulaId,
}

/// Frame to which a joint, point or load is attached: ground or a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Frame {
    /// The fixed frame.
    Ground,
    /// A moving body.
    Body(BodyId),
}

impl Frame {
    /// The body, unless it is ground.
    pub fn body(self) -> Option<BodyId> {
        match self {
            Self::Ground => None,
            Self::Body(body) => Some(body),
        }
    }
}

impl From<BodyId> for Frame {
    fn from(body: BodyId) -> Self {
        Self::Body(body)
    }
}
