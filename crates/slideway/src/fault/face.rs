//! How an interface names what hints speak of.

/// An interface to people: hints name its own options and questions.
pub trait Face {
    /// An option, as `--load`.
    fn option(&self, name: &str) -> String;

    /// An option with a value, as `--samples 10000`.
    fn option_with(&self, name: &str, value: &str) -> String;

    /// Rates of one for these coordinates, as `--rate x=1`.
    fn rates(&self, coordinates: &[String]) -> String;

    /// A question, as `slideway hold`; "models" lists the gallery.
    fn question(&self, name: &str) -> String;
}

/// The command line `slideway`.
#[derive(Debug, Clone, Copy)]
pub struct CommandLine;

impl Face for CommandLine {
    fn option(&self, name: &str) -> String {
        format!("--{name}")
    }

    fn option_with(&self, name: &str, value: &str) -> String {
        format!("--{name} {value}")
    }

    fn rates(&self, coordinates: &[String]) -> String {
        let rates = coordinates.iter().map(|coordinate| format!("--rate {coordinate}=1"));
        rates.collect::<Vec<_>>().join(" ")
    }

    fn question(&self, name: &str) -> String {
        format!("slideway {name}")
    }
}
