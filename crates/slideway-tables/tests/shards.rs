//! Shards of a sweep: together they are the sweep, byte for byte, and what is wrong with them is noticed.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::progress::Progress;
use slideway::sweep::{
    GridAxis, SampledAxis, Sampling, Shard, Spread, Sweep, SweepOptions, SweepPoints, SweepState,
};
use slideway_tables::{
    Control, Difference, Encoder, Layout, Metadata, Resume, RowSource, ShardedSweep, Shards, TableError,
    TableFormat, Written, shard_path, write_shard, write_table, written_shard,
};
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use tempfile::TempDir;

/// A sweep over a model of the gallery with a parameter set.
fn sharded(model: &str, (name, value): (&str, &str), options: SweepOptions) -> (ShardedSweep, Sweep) {
    let text = gallery::find(model).unwrap().text;
    let settings = Settings::default().parameter(name, value);
    let parsed = Model::parse(text).unwrap().with(&settings).unwrap();
    let sweep = Sweep::new(&parsed, &options).unwrap();
    let metadata = Metadata { command: "slideway sweep".to_owned(), model: text.to_owned() };
    (ShardedSweep { metadata, settings, options }, sweep)
}

fn grid(axes: &[&str]) -> SweepOptions {
    SweepOptions::grid(axes.iter().map(|axis| axis.parse::<GridAxis>().unwrap()))
}

fn samples(spread: Spread) -> SweepOptions {
    let axes = ["mu=normal(0.6, 0.05)", "a=0.1..0.3"].map(|axis| axis.parse::<SampledAxis>().unwrap());
    SweepOptions::over(SweepPoints::Samples(Sampling { count: 3000, spread, seed: 5 }, axes.into()))
}

/// A sweep of the example that has 804 points in 7 chunks, one of them an inserted end of a mode.
fn example() -> (ShardedSweep, Sweep) {
    sharded("klepp-2002", ("F_20", "0"), grid(&["mu_1=0..0.8:803"]).attainability(true))
}

/// Does work that nothing ends, unless `points` are done.
fn undisturbed<T>(points: Option<u64>, work: impl FnOnce(&mut Control<'_>) -> T) -> T {
    let mut callback = |progress: &Progress| {
        if points.is_some_and(|points| progress.done >= points) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    };
    work(&mut Control { goes_on: &|| true, callback: &mut callback })
}

fn write(sharded: &ShardedSweep, sweep: &Sweep, shard: Shard, folder: &Path) -> Result<Written, TableError> {
    undisturbed(None, |watch| write_shard(sharded, (sweep, shard), (folder, false), watch))
}

fn write_all(sharded: &ShardedSweep, sweep: &Sweep, of: u32, folder: &Path) {
    for shard in Shard::all(of) {
        assert!(matches!(write(sharded, sweep, shard, folder), Ok(Written::Whole(_))), "{shard}");
    }
}

fn find(folder: &Path) -> Result<Shards, TableError> {
    Ok(Shards::find(folder, &mut |_| ControlFlow::Continue(()))?.expect("not ended"))
}

/// The bytes of a table, and what it comes to.
fn table(source: RowSource<'_>, encoder: Encoder, folder: &Path) -> (Vec<u8>, SweepState) {
    let path = folder.join("table");
    let how = (path.as_path(), Resume::No, true);
    let written = undisturbed(None, |watch| write_table(source, encoder, how, watch)).unwrap();
    let Written::Whole(state) = written else { panic!("ended early") };
    (fs::read(&path).unwrap(), state)
}

fn names(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Grids over one and several quantities, with inserted ends of modes, preload gaps, refused points; samples.
/// Shards that have as many chunks, and more shards than chunks, so that some have no points.
#[test]
fn merged_tables_are_those_of_one_run() {
    let cases = [
        ("klepp-2002", ("F_20", "0"), grid(&["mu_1=0..0.8:3001"])),
        ("klepp-2002", ("F_20", "m*g"), grid(&["mu_1=0..0.8:131"])),
        ("klepp-2002", ("F_20", "0"), grid(&["mu_1=0..0.8:803"]).attainability(true)),
        ("drawer", ("Q", "5 N"), grid(&["mu=0..0.8:81", "a=0..0.4:41"]).all_columns(true)),
        ("drawer", ("Q", "5 N"), grid(&["x.rate=-0.1..0.1:601"])),
        ("slider-crank", ("mu", "0.2"), grid(&["l=30 mm..180 mm:301"])),
        ("drawer", ("Q", "5 N"), samples(Spread::Random)),
        ("drawer", ("Q", "5 N"), samples(Spread::Halton)),
    ];
    let mut refused = 0;
    for (model, setting, options) in cases {
        let (sharded, sweep) = sharded(model, setting, options);
        let dimensions = sharded.options.points.dimensions();
        let layout = Layout::of(&sweep, dimensions, sharded.options.attainability);
        let whole = TempDir::new().unwrap();
        let expected: Vec<_> = TableFormat::ALL
            .iter()
            .map(|&format| {
                let encoder = Encoder::new(format, layout.clone(), sharded.metadata.clone());
                table(RowSource::Sweep(&sweep), encoder, whole.path())
            })
            .collect();
        refused += expected[0].1.tally.refusals.len();
        for of in [1, 3, 40] {
            let folder = TempDir::new().unwrap();
            write_all(&sharded, &sweep, of, folder.path());
            let shards = find(folder.path()).unwrap();
            assert_eq!(shards.sharded(), &sharded);
            for (&format, expected) in TableFormat::ALL.iter().zip(&expected) {
                let encoder = Encoder::new(format, shards.layout(), sharded.metadata.clone());
                let (bytes, state) = table(RowSource::Shards(&shards), encoder, whole.path());
                assert!(bytes == expected.0, "{model} {of} {format:?}");
                assert_eq!(state, expected.1, "{model} {of}");
            }
        }
    }
    assert!(refused > 1, "points that are refused are among them");
}

/// A shard that is ended early leaves nothing under its name; it goes on where it was, and its bytes are those
/// of one that was not ended.
#[test]
fn a_shard_that_was_ended_goes_on() {
    // 156 chunks in the shard, so that it takes more than one turn on any machine that is likely.
    let options = grid(&["mu_1=0..0.8:40003"]).attainability(true);
    let (sharded, sweep) = sharded("klepp-2002", ("F_20", "0"), options);
    let [folder, other] = [TempDir::new().unwrap(), TempDir::new().unwrap()];
    let shard: Shard = "2/2".parse().unwrap();
    let path = shard_path(folder.path(), shard);
    let ended = undisturbed(Some(1), |watch| {
        write_shard(&sharded, (&sweep, shard), (folder.path(), false), watch).unwrap()
    });
    let Written::Early { state, path: partial } = ended else { panic!("not ended") };
    assert!(state.done > 0 && state.done < sweep.shard(shard).points(), "{}", state.done);
    assert!(!path.exists() && partial.exists());
    assert_eq!(written_shard(&sharded, shard, folder.path()).unwrap(), None);

    // Of another sweep it is not continued.
    let mut changed = sharded.clone();
    changed.settings = changed.settings.parameter("F_20", "1 N");
    let refused = write(&changed, &sweep, shard, folder.path());
    assert!(matches!(refused, Err(TableError::AnotherSweep { .. })), "{refused:?}");

    write(&sharded, &sweep, shard, folder.path()).unwrap();
    write(&sharded, &sweep, shard, other.path()).unwrap();
    assert_eq!(names(&folder), ["shard-2-of-2.parquet"]);
    assert_eq!(fs::read(path).unwrap(), fs::read(shard_path(other.path(), shard)).unwrap());
    let manifest = written_shard(&sharded, shard, folder.path()).unwrap().unwrap();
    assert_eq!(manifest.part.points, sweep.shard(shard).points());
}

/// A merge that is ended early goes on, too.
#[test]
fn a_merge_that_was_ended_goes_on() {
    let (sharded, sweep) = example();
    let folder = TempDir::new().unwrap();
    write_all(&sharded, &sweep, 5, folder.path());
    let shards = find(folder.path()).unwrap();
    let encoder = Encoder::new(TableFormat::Csv, shards.layout(), sharded.metadata.clone());
    let (expected, whole) = table(RowSource::Sweep(&sweep), encoder.clone(), folder.path());
    let path = folder.path().join("merged");
    let source = RowSource::Shards(&shards);
    let ended = undisturbed(Some(300), |watch| {
        write_table(source, encoder.clone(), (&path, Resume::No, false), watch).unwrap()
    });
    assert!(matches!(&ended, Written::Early { state, .. } if state.done >= 300), "{ended:?}");
    let merged =
        undisturbed(None, |watch| write_table(source, encoder, (&path, Resume::Yes, false), watch).unwrap());
    assert_eq!(merged, Written::Whole(whole));
    assert!(fs::read(&path).unwrap() == expected);
}

/// Whatever byte is changed, and wherever the file ends.
#[test]
fn a_shard_that_was_changed_is_noticed() {
    let (sharded, sweep) = sharded("drawer", ("Q", "5 N"), grid(&["mu=0.1,0.2,0.7"]));
    let folder = TempDir::new().unwrap();
    let shard: Shard = "1/1".parse().unwrap();
    write(&sharded, &sweep, shard, folder.path()).unwrap();
    let path = shard_path(folder.path(), shard);
    let good = fs::read(&path).unwrap();
    let damaged = || {
        let found = written_shard(&sharded, shard, folder.path());
        matches!(found, Err(TableError::ShardDamaged { .. }))
    };
    for at in 0..good.len() {
        let mut bad = good.clone();
        bad[at] ^= 1;
        fs::write(&path, &bad).unwrap();
        assert!(damaged(), "byte {at}");
    }
    for end in [0, 7, 8, good.len() / 2, good.len() - 1] {
        fs::write(&path, &good[..end]).unwrap();
        assert!(damaged(), "{end} bytes");
    }
    assert!(matches!(find(folder.path()), Err(TableError::ShardDamaged { .. })));
    fs::write(&path, &good).unwrap();
    assert!(written_shard(&sharded, shard, folder.path()).unwrap().is_some());
}

/// In what it differs is told, by the check before a shard is computed and by the one before a merge.
#[test]
fn shards_of_different_sweeps_do_not_mix() {
    let (sharded, sweep) = example();
    let mut other_model = sharded.clone();
    other_model.metadata.model.push('\n');
    let mut other_settings = sharded.clone();
    other_settings.settings = Settings::default().parameter("F_20", "1 N");
    let mut other_options = sharded.clone();
    other_options.options = grid(&["mu_1=0..0.8:804"]).attainability(true);
    for (other, expected) in [
        (other_model, Difference::Model),
        (other_settings, Difference::Settings),
        (other_options, Difference::Options),
    ] {
        let folder = TempDir::new().unwrap();
        let [first, second] = ["1/2", "2/2"].map(|shard| shard.parse().unwrap());
        write(&sharded, &sweep, first, folder.path()).unwrap();
        let other_sweep = other.sweep(sweep.breakpoints().clone()).unwrap();
        write(&other, &other_sweep, second, folder.path()).unwrap();
        match written_shard(&sharded, second, folder.path()) {
            Err(TableError::ShardOfAnotherSweep { difference, .. }) => assert_eq!(difference, expected),
            found => panic!("{found:?}"),
        }
        match find(folder.path()) {
            Err(TableError::ShardsDiffer { difference, .. }) => assert_eq!(difference, expected),
            found => panic!("{found:?}"),
        }
    }
}

/// Whoever copies a file to another name, divides anew, or inserts other ends of modes.
#[test]
fn shards_that_are_divided_otherwise_do_not_mix() {
    let (sharded, sweep) = example();
    let differs = |folder: &TempDir| match find(folder.path()) {
        Err(TableError::ShardsDiffer { difference, .. }) => difference,
        found => panic!("{found:?}"),
    };
    let folder = TempDir::new().unwrap();
    let [first, second] = ["1/2", "2/2"].map(|shard| shard.parse().unwrap());
    write(&sharded, &sweep, first, folder.path()).unwrap();
    fs::copy(shard_path(folder.path(), first), shard_path(folder.path(), second)).unwrap();
    assert_eq!(differs(&folder), Difference::Shard);

    let folder = TempDir::new().unwrap();
    write(&sharded, &sweep, first, folder.path()).unwrap();
    write(&sharded, &sweep, "2/3".parse().unwrap(), folder.path()).unwrap();
    assert_eq!(differs(&folder), Difference::Shard);

    let folder = TempDir::new().unwrap();
    write(&sharded, &sweep, first, folder.path()).unwrap();
    let without = sharded.sweep(slideway::sweep::Breakpoints::default()).unwrap();
    write(&sharded, &without, second, folder.path()).unwrap();
    assert_eq!(differs(&folder), Difference::Breakpoints);
}

#[test]
fn what_is_missing_is_told_as_ranges() {
    let (sharded, sweep) = example();
    let folder = TempDir::new().unwrap();
    assert!(matches!(find(folder.path()), Err(TableError::NoShards { .. })));
    for number in [1, 4, 12] {
        write(&sharded, &sweep, Shard::new(number, 12).unwrap(), folder.path()).unwrap();
    }
    match find(folder.path()) {
        Err(TableError::ShardsMissing { missing, of: 12, .. }) => assert_eq!(missing, "2-3,5-11"),
        found => panic!("{found:?}"),
    }
    let nowhere = folder.path().join("nowhere");
    assert!(matches!(find(&nowhere), Err(TableError::CannotRead { .. })));
}
