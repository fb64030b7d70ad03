//! The texts of a run beside what is wrong with them.

use slideway::fault::Faults;
use slideway::model::Settings;

/// Texts in which faults have their places, and the faults.
#[derive(Debug)]
pub(crate) struct FaultyInput {
    /// Name of the model file, for messages.
    pub(crate) name: String,
    /// The text of the model.
    pub(crate) text: String,
    /// The changes of the model by the command line.
    pub(crate) settings: Settings,
    /// The option of the command line that sets a parameter, as it stands before the name.
    pub(crate) parameter_option: &'static str,
    /// The faults, whose places are in these texts.
    pub(crate) faults: Faults,
}
