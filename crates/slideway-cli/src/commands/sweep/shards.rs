//! Sweeps in shards, and their merging.

use super::plot::Plotting;
use super::{Work, format, tell, unswept, watch};
use crate::arguments::{Destination, ModelArguments, SweepArguments};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::metadata::command_of_shards;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture;
use crate::watch::Watch;
use slideway::model::Model;
use slideway::printable;
use slideway::progress::Progress;
use slideway::sweep::{Shard, Sweep};
use slideway_tables::{
    Control, Encoder, Metadata, RowSource, ShardedSweep, Shards, Written, quoted, shard_path, write_shard,
    written_shard,
};
use std::path::Path;

/// Computes a shard and writes it into a folder, unless it is there.
pub(super) fn write(
    shard: Shard,
    (model, arguments): (&ModelArguments, &SweepArguments),
    output: &Output,
) -> Result<Outcome, Failure> {
    let Destination { output: folder, force } = &arguments.destination;
    let Some(folder) = folder.as_deref().filter(|folder| *folder != Path::new("-")) else {
        return Err(Failure::NoFolder);
    };
    let path = shard_path(folder, shard);
    // Whether it may be written is asked once it is known what is there.
    Files::new(output, &arguments.destination, Some(&model.file)).claim(&path)?;
    let input = Input::read(model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    let options = arguments.options().map_err(|faults| input.refused(faults))?;
    input.warn(options.points.warnings(&model))?;
    let metadata = Metadata { command: command_of_shards(), model: input.text() };
    let sharded = ShardedSweep { metadata, settings: input.settings.clone(), options };
    if !force && let Some(manifest) = written_shard(&sharded, shard, folder)? {
        let (points, rows) = (manifest.part.points, manifest.tally.rows);
        let file = path.display().to_string();
        let told =
            format!("Shard {shard} is there: `{}`, points: {points}, rows: {rows}\n", printable::line(&file));
        Output::standard(output.look()).write(&told)?;
        return Ok(Outcome::Done);
    }
    let mut watch = Watch::new(arguments.time.time_limit);
    let sweep = Sweep::new_with(&model, &sharded.options, &mut |progress| watch.look(progress));
    let Some(sweep) = sweep.map_err(|faults| input.refused(faults))? else {
        return watch.whole(None);
    };
    let alarm = watch.alarm();
    let mut look = |progress: &Progress| watch.look(progress);
    let mut control = Control { goes_on: &|| !alarm.rings(), callback: &mut look };
    let written = write_shard(&sharded, (&sweep, shard), (folder, *force), &mut control)?;
    let part = sweep.shard(shard);
    match written {
        Written::Early { state, path } => Err(unswept(watch, &state, &part, Some(path))),
        Written::Whole(state) => {
            watch.finish();
            tell(&part, &state, output)
        }
    }
}

/// Merges the shards in a folder into one table.
pub(super) fn merge(folder: &Path, arguments: &SweepArguments, output: &Output) -> Result<Outcome, Failure> {
    let format = format(arguments)?;
    let mut files = Files::new(output, &arguments.destination, None);
    let picture = picture::beside(&arguments.plot, &mut files)?;
    let destination = files.answer()?;
    let mut watch = watch(arguments, &destination);
    let Some(shards) = Shards::find(folder, &mut |progress| watch.look(progress))? else {
        return watch.whole(None);
    };
    shards.paths().try_for_each(|path| files.read(path))?;
    let ShardedSweep { metadata, settings, .. } = shards.sharded();
    let plot = match picture {
        Some(_) if shards.sweep().has_branches() && !shards.layout().attainability => {
            return Err(Failure::WithoutAttainability);
        }
        Some(file) => {
            let title = Model::parse(&metadata.model).ok().and_then(|model| model.title);
            Some(Plotting::new(shards.sweep(), arguments, file, (title.as_deref(), settings))?)
        }
        None => None,
    };
    // The command that would have written the same table at once.
    let command = match &arguments.destination.output {
        Some(path) => format!("{} --output {}", metadata.command, quoted(path.as_os_str())),
        None => metadata.command.clone(),
    };
    let metadata = Metadata { command, model: metadata.model.clone() };
    let encoder = Encoder::new(format, shards.layout(), metadata);
    Work { source: RowSource::Shards(&shards), encoder, plot }.write(arguments, &destination, watch)
}
