//! What every table tells of itself.

/// What every table tells of itself.
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
