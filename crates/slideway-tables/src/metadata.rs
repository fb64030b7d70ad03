//! The metadata that every table carries.

/// The origin of a table, which every table states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Metadata {
    /// The command that made it.
    pub command: String,
    /// The text of the model.
    pub model: String,
}

impl Metadata {
    /// The program that made it, with its version.
    pub fn program() -> String {
        format!("slideway {}", env!("CARGO_PKG_VERSION"))
    }
}
