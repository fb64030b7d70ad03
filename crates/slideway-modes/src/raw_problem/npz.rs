//! Raw problems as NumPy archives (`numpy.savez`), and archives of answers.

use std::io::{Cursor, Read, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::assemble::{Given, GivenType};
use super::fault::RawFault;
use super::kind::RawKind;
use super::{GREATEST_SIZE, npy};

/// The maximum number of entries of a matrix.
const MOST_ENTRIES: usize = GREATEST_SIZE * GREATEST_SIZE;
/// The number of bytes of such a matrix and its header.
const MOST_BYTES: u64 = MOST_ENTRIES as u64 * 8 + 65536;

/// The names and arrays of an archive; faults of single arrays are added to `faults`.
pub(super) fn read(bytes: &[u8], faults: &mut Vec<RawFault>) -> Result<Given, RawFault> {
    let broken = |error: &dyn ToString| RawFault::Archive { reason: error.to_string() };
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| broken(&error))?;
    let mut given = Given::default();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(|error| broken(&error))?;
        let name = file.name().map_err(|error| broken(&error))?.into_owned();
        let key = name.strip_suffix(".npy").unwrap_or(&name).to_owned();
        if given.has(&key) {
            faults.push(RawFault::DuplicateKey { key });
            continue;
        }
        let known = RawKind::ALL.iter().any(|kind| kind.names().contains(&key.as_str()));
        if !known && key != "type" {
            // A name that belongs to no problem: reported later, without reading the array.
            given.add(key, None);
            continue;
        }
        let mut content = Vec::new();
        // One byte more shows that there are too many, whatever the header says.
        file.by_ref().take(MOST_BYTES + 1).read_to_end(&mut content).map_err(|error| broken(&error))?;
        if key == "type" {
            match npy::text(&key, &content) {
                Ok(Some(text)) => given.kind = GivenType::Text(text),
                Ok(None) => given.kind = GivenType::Other("an array of something else".to_owned()),
                Err(fault) => faults.push(fault),
            }
        } else {
            match npy::numbers(&key, &content, MOST_ENTRIES) {
                Ok(array) => given.add(key, Some(array)),
                Err(fault) => given.set_faulty(key, fault, faults),
            }
        }
    }
    Ok(given)
}

/// An archive of arrays that are already encoded.
pub(super) fn write(arrays: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default());
    for (name, bytes) in arrays {
        let options = options.large_file(bytes.len() as u64 > u64::from(u32::MAX) / 2);
        archive
            .start_file(format!("{name}.npy"), options)
            .and_then(|()| Ok(archive.write_all(bytes)?))
            .expect("writing to memory cannot fail");
    }
    archive.finish().expect("writing to memory cannot fail").into_inner()
}
