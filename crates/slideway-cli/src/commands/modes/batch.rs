//! `slideway modes --json-lines`: one problem in each line, one answer in each line.

use super::{answer, no_problem};
use crate::arguments::ModesArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Alarm, Watch, outcome};
use rayon::prelude::*;
use slideway::Report;
use slideway::progress::Progress;
use slideway::raw_problem::{FaultyLine, RawFault, RawProblem, SIZE_LIMIT};
use std::io::{self, BufRead, BufReader, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Bytes that are read at once: the lines in them are answered together, by all threads.
const BUFFER: usize = 1 << 18;

/// Answers every line. A line that has arrived is answered before another one is waited for.
pub(super) fn batch(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    let path = arguments.file.as_path();
    let output = Files::new(output, &arguments.destination, Some(path)).answer()?;
    let failed = |error| no_problem(input::cannot_read(path, error));
    let (source, _) = input::open(path).map_err(no_problem)?;
    let mut source = BufReader::with_capacity(BUFFER, source);
    let mut stream = output.stream()?;
    let mut watch = Watch::beside_rows(None);
    let alarm = Alarm::within(arguments.time_limit());
    let (mut line, mut all_understood) = (0, true);
    loop {
        let lines = arrived(&mut source).map_err(failed)?;
        let answers: Vec<(String, bool)> = lines
            .par_iter()
            .enumerate()
            .map(|(at, text)| answer_to(line + at as u64 + 1, text.as_deref(), arguments, alarm.afresh()))
            .collect();
        line += lines.len() as u64;
        all_understood &= answers.iter().all(|(_, understood)| *understood);
        let text: String = answers.into_iter().map(|(text, _)| text).collect();
        match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => break,
            written => written.map_err(|error| output.failure(error))?,
        }
        let progress = Progress { counted: "problems", done: line, fraction: None, found: None };
        if watch.look(&progress).is_break() || lines.is_empty() {
            break;
        }
    }
    Ok(outcome(watch.finish(), if all_understood { Outcome::Done } else { Outcome::Refused }))
}

/// The answer to a line, or what is wrong with it, and whether it is an answer.
fn answer_to(line: u64, text: Option<&[u8]>, arguments: &ModesArguments, alarm: Alarm) -> (String, bool) {
    let problem = match text {
        Some(text) => RawProblem::from_json(text),
        None => Err(RawFault::TooLarge { limit: SIZE_LIMIT }.into()),
    };
    let problem = match problem {
        Ok(problem) => problem,
        Err(faults) => return (FaultyLine::new(line, &faults).json_line(), false),
    };
    // A fault of the program in one line must not cost the others their answers.
    let answered =
        catch_unwind(AssertUnwindSafe(|| answer(&problem, arguments, &mut |_| alarm.flow()).json_line()));
    match answered {
        Ok(text) => (text, true),
        Err(_) => (FaultyLine::of_program(line).json_line(), false),
    }
}

/// The next line, and all others that have arrived with it; none at the end. A line that is too long is `None`.
fn arrived(source: &mut BufReader<Box<dyn Read>>) -> io::Result<Vec<Option<Vec<u8>>>> {
    let mut lines = Vec::new();
    loop {
        let mut line = Vec::new();
        source.by_ref().take(SIZE_LIMIT + 1).read_until(b'\n', &mut line)?;
        if line.is_empty() {
            return Ok(lines);
        }
        let too_long = line.len() as u64 > SIZE_LIMIT;
        if too_long && line.last() != Some(&b'\n') {
            source.skip_until(b'\n')?;
        }
        lines.push((!too_long).then_some(line));
        if !source.buffer().contains(&b'\n') {
            return Ok(lines);
        }
    }
}
