//! `slideway new`
//!
//! Every template is a subcommand and every parameter of it an option, so that help, completion and the
//! complaints about misspelt names are those of all commands. The templates say which there are.

use super::Destination;
use clap::builder::Command;
use clap::error::Error;
use clap::{Arg, ArgAction, ArgMatches, Args, FromArgMatches};
use slideway::model::Settings;
use slideway::template::{self, TEMPLATES, Template};

pub(super) const HELP: &str = "\
Examples:
  slideway new                        asks for everything, on a terminal
  slideway new drawer                 asks for each dimension
  slideway new drawer --L 400mm --a 150mm --mu 0.3
  slideway new peg --e \"2 mm\" --output mine.toml
  slideway new --list                 the templates, each with its rule
  slideway new wedge --help           the dimensions of a wedge

The model goes to NAME.toml, or to the file of --output. It has comments, and
its first question is answered at once. If no dimension is given, each is asked
for on a terminal; otherwise, and without a terminal, those that are not given
are as in the template. `--output -` writes the model to standard output, and
nothing else.

Exit codes:
  0    the model is written, whatever the first answer says
  2    invalid input: an unknown name, a wrong unit, dimensions that do not fit
       together, or a file that exists: nothing is written. Or the first
       question cannot be asked of the model";

/// The name of the option.
const LIST: &str = "list";

/// Arguments of `slideway new`.
#[derive(Debug)]
pub(crate) struct NewArguments {
    /// The template; none if it is not named.
    pub(crate) template: Option<&'static Template>,
    /// The parameters given on the command line; the others keep the values of the template.
    pub(crate) settings: Settings,
    /// A name that no template has.
    pub(crate) unknown: Option<String>,
    /// Only list the templates.
    pub(crate) list: bool,
    /// Where the model goes; none if no template is named.
    pub(crate) destination: Option<Destination>,
}

impl Args for NewArguments {
    fn augment_args(command: Command) -> Command {
        let list = Arg::new(LIST).long(LIST).action(ArgAction::SetTrue);
        command
            .arg(list.help("List the templates, each with the rule that it must meet"))
            .args_conflicts_with_subcommands(true)
            .subcommand_value_name("NAME")
            .subcommand_help_heading("Templates")
            .disable_help_subcommand(true)
            .allow_external_subcommands(true)
            .subcommands(TEMPLATES.iter().map(subcommand))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// A template with its parameters.
fn subcommand(template: &'static Template) -> Command {
    let options = template.parameters().map(|parameter| {
        Arg::new(parameter.name)
            .long(parameter.name)
            .value_name("VALUE")
            .allow_hyphen_values(true)
            .help(format!("{} [{}]", parameter.meaning, parameter.value))
    });
    let file = format!("Write to this file [{}.toml]; `-` is standard output", template.name);
    Destination::augment_args(Command::new(template.name).args(options))
        .mut_arg("output", |output| output.help(file))
        .about(template.summary())
        .long_about(None)
        .after_help(format!("Rule: {}", template.rule()))
}

impl FromArgMatches for NewArguments {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let list = matches.get_flag(LIST);
        let chosen = matches.subcommand().and_then(|(name, given)| Some((template::find(name)?, given)));
        let Some((template, given)) = chosen else {
            let unknown = matches.subcommand_name().map(str::to_owned);
            return Ok(Self {
                template: None,
                unknown,
                settings: Settings::default(),
                list,
                destination: None,
            });
        };
        let mut settings = Settings::default();
        for parameter in template.parameters() {
            if let Some(value) = given.get_one::<String>(parameter.name) {
                settings = settings.parameter(parameter.name, value);
            }
        }
        let destination = Some(Destination::from_arg_matches(given)?);
        Ok(Self { template: Some(template), unknown: None, settings, list, destination })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
