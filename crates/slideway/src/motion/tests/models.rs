//! Models that several tests use, as text.

/// A block of 2 kg on a horizontal guide, g = 10 m/s^2.
pub(super) fn block(mu: &str, start: &str, more: &str) -> String {
    format!(
        r#"
gravity = "10 m/s^2"
[points]
C = [0, 0]
W = [-3, 0]
[bodies.block]
points = ["C"]
mass = "2 kg"
centre_of_mass = "C"
shape = {{ rectangle = ["0.2 m", "0.1 m"] }}
[joints.guide]
type = "block_slider"
block = "block"
at = "C"
along = "0 deg"
length = "0.2 m"
mu = {mu}
[coordinates.x]
slide = "guide"
{start}
{more}
"#
    )
}

/// The same with stops at 1 m to both sides.
pub(super) fn with_stop(text: &str, stop: &str) -> String {
    let travel = format!("length = \"0.2 m\"\ntravel = [\"-1 m\", \"1 m\"]\nstop = {stop}");
    text.replace("length = \"0.2 m\"", &travel)
}

/// A slab of 3 kg on a horizontal guide and a block of 2 kg on it, g = 10 m/s^2, with these keys of their
/// joints and these rates; their mass centres are on the guides' lines, so that nothing turns them.
pub(super) fn stacked([below, between]: [&str; 2], rates: [&str; 2], more: &str) -> String {
    format!(
        r#"
gravity = "10 m/s^2"
[points]
C = [0, 0]
[bodies.slab]
mass = "3 kg"
centre_of_mass = "C"
moment_of_inertia = "1 kg m^2"
[bodies.top]
points = ["C"]
mass = "2 kg"
centre_of_mass = "C"
moment_of_inertia = "1 kg m^2"
[joints.below]
type = "block_slider"
block = "slab"
at = "C"
along = "0 deg"
length = "6 m"
{below}
[joints.between]
type = "block_slider"
block = "top"
guide = "slab"
at = "C"
along = "0 deg"
length = "1 m"
{between}
[coordinates.x]
slide = "below"
rate = "{}"
[coordinates.s]
slide = "between"
rate = "{}"
{more}
"#,
        rates[0], rates[1]
    )
}
