//! Finds the name that was probably meant.

/// The known name most similar to `name`, if any is similar enough.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    all_nearest(name, known.into_iter()).first().map(|nearest| (*nearest).to_owned())
}

/// The candidates most similar to `name`, best first: those that differ only in case, otherwise those a few
/// edits away, before others those that begin with it, then those with as many letters, as letters are swapped more often than
/// forgotten.
///
/// ```
/// assert_eq!(slideway_modes::names::all_nearest("colums", ["columns", "rows"].into_iter()), ["columns"]);
/// ```
pub fn all_nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let lower = name.to_lowercase();
    let length = name.chars().count();
    let allowed = if length < 2 { 0 } else { (length / 3).max(1) };
    let mut alike: Vec<(usize, &str)> = candidates
        .map(|candidate| (strsim::damerau_levenshtein(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .collect();
    alike.sort_by_key(|(distance, candidate)| {
        let begins = candidate.to_lowercase().starts_with(&lower);
        (*distance, !begins, candidate.chars().count().abs_diff(length))
    });
    let best = alike.first().map(|(distance, _)| *distance);
    alike.into_iter().take_while(|(distance, _)| Some(*distance) == best).map(|(_, name)| name).collect()
}
