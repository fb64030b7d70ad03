//! Joints with two faces in the model that may have only one in the thing itself.

use serde::Serialize;

/// A joint of two faces whose answer needs the face that the thing itself may not have.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct OneFaceHint {
    /// The joint.
    pub joint: String,
    /// Its contacts that need the other face; all of them where it jams.
    pub contacts: Vec<String>,
    /// The reason why a second face is needed.
    pub reason: OneFaceReason,
    /// The type of joint that may lift off.
    pub instead: &'static str,
    /// In words.
    pub words: String,
}

/// Reasons why a joint needs its second face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum OneFaceReason {
    /// The block is drawn on one side of the face, and the face pulls it.
    Pulls,
    /// Under the weights alone the block lies on one face, and it presses the other one.
    ChangesSide,
    /// The block is drawn on one side of the face or lies on it, and it jams.
    Jams,
}
