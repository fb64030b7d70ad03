//! How many threads share the work.

use crate::output::complain;
use anstream::ColorChoice;
use std::thread::available_parallelism;

/// The variables of the environment that say how many, in the order in which they count.
const VARIABLES: [&str; 2] = ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"];
/// More threads than this for each processor are of no use to anyone, and some thousands cannot be started.
const FOR_EACH_PROCESSOR: usize = 4;

/// Sees to it that the environment asks for no absurd number of threads, and tells if it does.
pub(crate) fn bound(color: ColorChoice) {
    let asked = |name: &'static str| {
        let count = std::env::var(name).ok()?.parse::<usize>().ok()?;
        (count > 0).then_some((name, count))
    };
    let Some((name, count)) = VARIABLES.into_iter().find_map(asked) else { return };
    let most = FOR_EACH_PROCESSOR * available_parallelism().map_or(1, usize::from);
    if count > most && rayon::ThreadPoolBuilder::new().num_threads(most).build_global().is_ok() {
        complain(
            &format!(
                "note: {name} asks for {count} threads; {most} are used, {FOR_EACH_PROCESSOR} for each processor"
            ),
            color,
        );
    }
}
