//! Sweeps in shards: each is a Parquet file in a folder, and all of them are merged into one table.

use crate::parquet::{COMMAND, MANIFEST, MODEL, PROGRAM, ShardReader, seal};
use crate::shard::{ranges, shard_of_name};
use crate::writing::Take;
use crate::{
    Control, Difference, Encoder, Layout, Manifest, Metadata, Part, Resume, RowSource, ShardedSweep,
    TableError, Written, shard_path, write_table,
};
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use slideway::progress::{Callback, Progress};
use slideway::sweep::{Refusal, Rows, Shard, Sweep, SweepState};
use std::fs::{self, File};
use std::io;
use std::mem;
use std::path::{Path, PathBuf};

/// The shard of a sweep that is in a folder already: whole, and of this sweep. None if there is no file of
/// its name.
///
/// # Errors
/// If it cannot be read, is damaged, or belongs to another sweep or version of the program.
pub fn written_shard(
    sharded: &ShardedSweep,
    shard: Shard,
    folder: &Path,
) -> Result<Option<Manifest>, TableError> {
    let path = shard_path(folder, shard);
    let Some(file) = ShardFile::open(path)? else { return Ok(None) };
    match file.difference(sharded, shard) {
        None => Ok(Some(file.manifest)),
        Some(difference) => {
            let (path, command) = (file.path, file.metadata.command);
            Err(TableError::ShardOfAnotherSweep { path, command, difference })
        }
    }
}

/// Computes a shard of a sweep, which is `whole`, and writes it into a folder, which is made if it is not
/// there. What an interrupted run has left of it is continued. Ask [`written_shard`] before whether it is
/// there.
///
/// The bytes of the file depend on the sweep, the shard, and the command that it tells of itself alone.
///
/// # Errors
/// If it cannot be written; if a file of its name is there and must not be overwritten; if an unfinished one
/// belongs to another sweep.
pub fn write_shard(
    sharded: &ShardedSweep,
    (whole, shard): (&Sweep, Shard),
    (folder, overwrite): (&Path, bool),
    control: &mut Control<'_>,
) -> Result<Written, TableError> {
    fs::create_dir_all(folder).map_err(|error| TableError::writing(folder, error))?;
    let path = shard_path(folder, shard);
    if path.exists() && !overwrite {
        return Err(TableError::Exists { path });
    }
    let resume = if overwrite { Resume::No } else { Resume::IfAny };
    let encoder = Encoder::shard(sharded, whole, shard);
    write_table(RowSource::Sweep(&whole.shard(shard)), encoder, (&path, resume, overwrite), control)
}

/// The file of a shard whose checksum is right.
#[derive(Debug)]
struct ShardFile {
    path: PathBuf,
    metadata: Metadata,
    manifest: Manifest,
}

impl ShardFile {
    /// None if there is no such file.
    fn open(path: PathBuf) -> Result<Option<Self>, TableError> {
        let file = match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            opened => opened.map_err(|error| TableError::reading(&path, error))?,
        };
        if !seal::is_whole(&file).map_err(|error| TableError::reading(&path, error))? {
            return Err(TableError::ShardDamaged { path });
        }
        let Ok(reader) = SerializedFileReader::new(file) else {
            return Err(TableError::ShardDamaged { path });
        };
        let pairs = reader.metadata().file_metadata().key_value_metadata();
        let entry = |key: &str| {
            let pair = pairs.into_iter().flatten().find(|pair| pair.key == key);
            pair.and_then(|pair| pair.value.clone())
        };
        if let Some(program) = entry(PROGRAM).filter(|program| *program != Metadata::program()) {
            return Err(TableError::ShardOfVersion { path, program });
        }
        let manifest = entry(MANIFEST).and_then(|text| serde_json::from_str(&text).ok());
        match (entry(COMMAND), entry(MODEL), manifest) {
            (Some(command), Some(model), Some(manifest)) => {
                Ok(Some(Self { path, metadata: Metadata { command, model }, manifest }))
            }
            _ => Err(TableError::ShardDamaged { path }),
        }
    }

    /// In what it differs from a shard of a sweep.
    fn difference(&self, sharded: &ShardedSweep, shard: Shard) -> Option<Difference> {
        let Part { settings, options, shard: found, .. } = &self.manifest.part;
        [
            (self.metadata.model != sharded.metadata.model, Difference::Model),
            (*settings != sharded.settings, Difference::Settings),
            (*options != sharded.options, Difference::Options),
            (*found != shard, Difference::Shard),
        ]
        .into_iter()
        .find_map(|(differs, difference)| differs.then_some(difference))
    }
}

/// All shards of one sweep.
///
/// ```
/// use slideway::model::Settings;
/// use slideway::progress::Progress;
/// use slideway::sweep::{Breakpoints, GridAxis, Shard, SweepOptions};
/// use slideway_tables::{
///     Control, Encoder, Metadata, Resume, RowSource, ShardedSweep, Shards, TableFormat, Written, write_shard,
///     write_table, written_shard,
/// };
/// use std::ops::ControlFlow;
///
/// let folder = tempfile::tempdir()?;
/// let results = folder.path().join("results");
/// let model = slideway::gallery::find("drawer").expect("in the gallery").text.to_owned();
/// let metadata = Metadata { command: "a sweep of the drawer".to_owned(), model };
/// let options = SweepOptions::grid([GridAxis::linear("mu", 0.0, 1.0, 101)]).breakpoints(false);
/// let sharded = ShardedSweep { metadata, settings: Settings::default(), options };
///
/// let mut callback = |_: &Progress| ControlFlow::Continue(());
/// let mut control = Control { goes_on: &|| true, callback: &mut callback };
/// for shard in Shard::all(2) {
///     if written_shard(&sharded, shard, &results)?.is_none() {
///         let sweep = sharded.sweep(Breakpoints::default())?;
///         write_shard(&sharded, (&sweep, shard), (&results, false), &mut control)?;
///     }
/// }
///
/// let shards = Shards::find(&results, control.callback)?.expect("the callback does not break");
/// let encoder = Encoder::new(TableFormat::Npz, shards.layout(), sharded.metadata.clone());
/// let path = folder.path().join("drawer.npz");
/// let how = (path.as_path(), Resume::No, false);
/// let written = write_table(RowSource::Shards(&shards), encoder, how, &mut control)?;
/// let Written::Whole(state) = written else { panic!("nothing ends it") };
/// // It jams from mu = L / (2 a) = 2/3 on (book, chapter Limits): at 0.67 and the 33 points behind it.
/// assert_eq!((state.tally.solutions[&1], state.tally.solutions[&0]), (67, 34));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Shards {
    sweep: Sweep,
    sharded: ShardedSweep,
    files: Vec<ShardFile>,
}

impl Shards {
    /// Finds the shards in a folder: all there, whole, and of one sweep. Returns `None` if the callback,
    /// which is called before each file, breaks.
    ///
    /// # Errors
    /// If there are none, or some are missing; if one cannot be read, is damaged, or belongs to another
    /// version of the program or to another sweep than the first one.
    pub fn find(folder: &Path, callback: &mut Callback<'_>) -> Result<Option<Self>, TableError> {
        let paths = paths(folder)?;
        let mut files = Vec::with_capacity(paths.len());
        for path in &paths {
            if callback(&Progress::of("shards", files.len() as u64, paths.len() as u64)).is_break() {
                return Ok(None);
            }
            files.extend(ShardFile::open(path.clone())?);
        }
        let Some(first) = files.first() else {
            return Err(TableError::NoShards { folder: folder.to_owned() });
        };
        let Part { settings, options, breakpoints, shard, .. } = first.manifest.part.clone();
        let sharded = ShardedSweep { metadata: first.metadata.clone(), settings, options };
        let refused = |faults| TableError::Refused { path: first.path.clone(), faults };
        let sweep = sharded.sweep(breakpoints).map_err(refused)?;
        for file in &files {
            if let Some(difference) = foreign(file, &sharded, (&sweep, shard.of())) {
                let paths = [first.path.clone(), file.path.clone()];
                return Err(TableError::ShardsDiffer { paths, difference });
            }
        }
        let is_there = |number: &u32| files.iter().any(|file| file.manifest.part.shard.number() == *number);
        let missing: Vec<u32> = (1..=shard.of()).filter(|number| !is_there(number)).collect();
        if !missing.is_empty() {
            let (folder, missing) = (folder.to_owned(), ranges(&missing));
            return Err(TableError::ShardsMissing { folder, missing, of: shard.of() });
        }
        files.sort_by_key(|file| file.manifest.part.shard.number());
        Ok(Some(Self { sweep, sharded, files }))
    }

    /// The whole sweep.
    pub fn sweep(&self) -> &Sweep {
        &self.sweep
    }

    /// Returns the sweep that was computed, with the command of the first shard.
    pub fn sharded(&self) -> &ShardedSweep {
        &self.sharded
    }

    /// The columns of the merged table.
    pub fn layout(&self) -> Layout {
        let options = &self.sharded.options;
        Layout::of(&self.sweep, options.points.dimensions(), options.attainability)
    }

    /// The files, in the order of the shards.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|file| file.path.as_path())
    }

    /// [`RowSource::run_while`].
    pub(crate) fn run_while<E: Send>(
        &self,
        goes_on: &(dyn Fn() -> bool + Sync),
        state: &mut SweepState,
        encode: &(dyn Fn(&Rows) -> E + Sync),
        take: &mut Take<'_, E>,
    ) -> Result<(), TableError> {
        let layout = Layout { numbered: false, ..self.layout() };
        for ShardFile { path, manifest, .. } in &self.files {
            let damaged = |_| TableError::ShardDamaged { path: path.clone() };
            let end = manifest.part.first_point + manifest.part.points;
            if state.done >= end {
                continue;
            }
            let file = File::open(path).map_err(|error| TableError::reading(path, error))?;
            let mut reader = ShardReader::new(file, &self.sweep, &layout).map_err(damaged)?;
            let mut refusals = refusals(manifest);
            while let Some(mut rows) = reader.rows().map_err(damaged)? {
                // What was merged before an interruption.
                if rows.heads.last().is_none_or(|head| head.point < state.done) {
                    continue;
                }
                if !goes_on() {
                    return Ok(());
                }
                rows.refusals = mem::take(&mut refusals);
                self.sweep.append(&mut rows, state);
                if take(vec![encode(&rows)], state).is_break() {
                    return Ok(());
                }
            }
            if state.done != end {
                return Err(TableError::ShardDamaged { path: path.clone() });
            }
        }
        Ok(())
    }
}

/// The first point of each kind in a shard that was not solved.
fn refusals(manifest: &Manifest) -> Vec<Refusal> {
    let refusals = manifest.tally.refusals.iter();
    refusals
        .map(|(status, (point, reason))| Refusal { point: *point, status: *status, reason: reason.clone() })
        .collect()
}

/// In what a file differs from one of the shards of a sweep, of which there are so many.
fn foreign(file: &ShardFile, sharded: &ShardedSweep, (whole, of): (&Sweep, u32)) -> Option<Difference> {
    let part = &file.manifest.part;
    let shard = part.shard;
    let name = file.path.file_name().and_then(|name| shard_of_name(name.to_str()?));
    if shard.of() != of || name != Some(shard) {
        return Some(Difference::Shard);
    }
    file.difference(sharded, shard)
        .or_else(|| (*part != Part::new(sharded, whole, shard)).then_some(Difference::Breakpoints))
}

/// The files of shards in a folder, in the order of their names.
fn paths(folder: &Path) -> Result<Vec<PathBuf>, TableError> {
    let reading = |error| TableError::reading(folder, error);
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(reading)? {
        let name = entry.map_err(reading)?.file_name();
        if name.to_str().and_then(shard_of_name).is_some() {
            paths.push(folder.join(name));
        }
    }
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use slideway::model::Settings;
    use slideway::sweep::{GridAxis, SweepOptions};
    use std::ops::ControlFlow;

    /// A file that another version has sealed.
    #[test]
    fn a_shard_of_another_version_is_not_taken() {
        let folder = tempfile::tempdir().expect("a folder");
        let model = slideway::gallery::find("drawer").expect("in the gallery").text.to_owned();
        let metadata = Metadata { command: String::new(), model };
        let options = SweepOptions::grid([GridAxis::linear("mu", 0.1, 0.5, 5)]);
        let sharded = ShardedSweep { metadata, settings: Settings::default(), options };
        let sweep = sharded.sweep(slideway::sweep::Breakpoints::default()).expect("a sweep");
        let shard = Shard::new(1, 1).expect("a shard");
        let mut look = |_: &Progress| ControlFlow::Continue(());
        let mut control = Control { goes_on: &|| true, callback: &mut look };
        write_shard(&sharded, (&sweep, shard), (folder.path(), false), &mut control).expect("written");
        assert!(written_shard(&sharded, shard, folder.path()).expect("of this version").is_some());

        let path = shard_path(folder.path(), shard);
        let mut bytes = fs::read(&path).expect("a shard");
        let (this, other) = (Metadata::program(), Metadata::program().replace("slideway ", "slideway-"));
        let key = bytes.windows(PROGRAM.len()).rposition(|window| window == PROGRAM.as_bytes());
        let at = key.expect("an entry") + PROGRAM.len() + 2;
        assert_eq!(&bytes[at..at + this.len()], this.as_bytes());
        bytes[at..at + this.len()].copy_from_slice(other.as_bytes());
        fs::write(&path, &bytes).expect("room");
        let damaged = written_shard(&sharded, shard, folder.path());
        assert!(matches!(damaged, Err(TableError::ShardDamaged { .. })), "{damaged:?}");
        let file = File::options().read(true).write(true).open(&path).expect("a shard");
        seal::seal(&file).expect("room");
        for found in [
            written_shard(&sharded, shard, folder.path()).map(|_| ()),
            Shards::find(folder.path(), &mut |_| ControlFlow::Continue(())).map(|_| ()),
        ] {
            match found {
                Err(TableError::ShardOfVersion { program, .. }) => assert_eq!(program, other),
                other => panic!("{other:?}"),
            }
        }
    }
}
