//! The seal of a shard: the checksum of all bytes of its file, in the metadata of that file.
//!
//! The checksum is that of the file with zeros in its own place, as in the headers of tar archives: so that a
//! shard is one file, which is there as a whole or not at all. It is XXH3 with 128 bits, which the library of
//! Parquet files brings along: against accidents, not against forgery. (The format of the metadata, Apache
//! Thrift's compact protocol: a text is preceded by one byte for its field and one for its length, if that is
//! below 128.)

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use twox_hash::XxHash3_128;

/// The entry of the metadata that holds it: the last one of them.
const KEY: &str = "slideway.checksum";
/// Hexadecimal digits of the checksum.
const DIGITS: usize = 32;
/// Bytes behind the metadata: their length, and the mark of the format.
const TAIL: usize = 8;

/// The entry of the metadata before the checksum is known.
pub(super) fn placeholder() -> (&'static str, String) {
    (KEY, "0".repeat(DIGITS))
}

/// Writes the checksum into a file that was written with [`placeholder`].
///
/// # Errors
/// If it cannot be read or written.
pub(crate) fn seal(mut file: &File) -> io::Result<()> {
    let Some(Seal { place, digits, .. }) = find(file)? else {
        return Err(io::Error::other("the metadata of the file have no place for its checksum"));
    };
    file.seek(SeekFrom::Start(place))?;
    file.write_all(&digits)
}

/// Whether a file is sealed, and all its bytes are those that were.
///
/// # Errors
/// If it cannot be read.
pub(crate) fn is_whole(file: &File) -> io::Result<bool> {
    Ok(find(file)?.is_some_and(|seal| seal.digits == seal.found))
}

/// The place of the checksum, what it has to be, and what is found there.
struct Seal {
    place: u64,
    digits: [u8; DIGITS],
    found: [u8; DIGITS],
}

/// None if there is no place for one.
fn find(mut file: &File) -> io::Result<Option<Seal>> {
    let Some(footer) = footer(file)? else { return Ok(None) };
    let bytes = &footer.bytes;
    let Some(key) = bytes.windows(KEY.len()).rposition(|window| window == KEY.as_bytes()) else {
        return Ok(None);
    };
    let at = key + KEY.len() + 2;
    let Some(found) = bytes.get(at..at + DIGITS).and_then(|found| found.try_into().ok()) else {
        return Ok(None);
    };
    let mut hasher = XxHash3_128::new();
    file.seek(SeekFrom::Start(0))?;
    let mut before = file.take(footer.start);
    let mut buffer = vec![0; 1 << 16];
    loop {
        match before.read(&mut buffer)? {
            0 => break,
            read => hasher.write(&buffer[..read]),
        }
    }
    hasher.write(&bytes[..at]);
    hasher.write(&[b'0'; DIGITS]);
    hasher.write(&bytes[at + DIGITS..]);
    let mut digits = [0; DIGITS];
    write!(&mut digits[..], "{:032x}", hasher.finish_128())?;
    Ok(Some(Seal { place: footer.start + at as u64, digits, found }))
}

/// The end of a Parquet file: metadata, their length, and the mark of the format.
struct Footer {
    start: u64,
    bytes: Vec<u8>,
}

/// None if the file is too short for what it says.
fn footer(mut file: &File) -> io::Result<Option<Footer>> {
    let size = file.seek(SeekFrom::End(0))?;
    let Some(tail) = size.checked_sub(TAIL as u64) else { return Ok(None) };
    file.seek(SeekFrom::Start(tail))?;
    let mut length = [0; 4];
    file.read_exact(&mut length)?;
    let Some(start) = tail.checked_sub(u64::from(u32::from_le_bytes(length))) else { return Ok(None) };
    file.seek(SeekFrom::Start(start))?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    Ok(Some(Footer { start, bytes }))
}
