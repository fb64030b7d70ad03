//! `slideway import`

use crate::arguments::ImportArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::import::{DRAWING_LIMIT, ImportFault, ImportOptions, dxf_with};
use std::time::Instant;

/// Writes a model to complete from a drawing.
pub(crate) fn import(arguments: &ImportArguments, output: &Output) -> Result<Outcome, Failure> {
    let path = arguments.file.as_path();
    let output = Files::new(output, &arguments.destination, Some(path)).answer()?;
    let refused = |fault| Failure::Drawing { name: input::name(path), fault };
    let limit = ImportFault::DrawingTooLarge { limit: DRAWING_LIMIT };
    let begun = Instant::now();
    let bytes = input::read_bytes(path, DRAWING_LIMIT)?.ok_or_else(|| refused(limit))?;
    let text = String::from_utf8(bytes).map_err(|_| refused(ImportFault::Encoding))?;
    let title = path.file_stem().and_then(|stem| stem.to_str()).filter(|stem| *stem != "-");
    let options = ImportOptions { title: title.map(str::to_owned), unit: arguments.unit };
    let mut watch = Watch::since(begun, arguments.time.time_limit).whole_or_none(output.color());
    let model = dxf_with(&text, &options, &mut |progress| watch.look(progress)).map_err(refused)?;
    output.write(&watch.whole(model)?)?;
    Ok(Outcome::Done)
}
