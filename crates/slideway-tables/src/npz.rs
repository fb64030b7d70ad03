//! Tables as NumPy archives: a ZIP file, not compressed, whose member `rows.npy` is an array of records.
//!
//! Records are appended as they come; sizes and checksums at the beginning are filled in at the end. (The
//! formats: PKWARE, APPNOTE.TXT 6.3.10, sections 4.3 and 4.5.3; NumPy, `numpy.lib.format`.)

use crate::record::{FieldKind, fields, size};
use crate::{Layout, Metadata};
use crc32fast::Hasher;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};

/// The member with the rows.
const ROWS: &str = "rows.npy";
/// Version that a reader needs for ZIP64, and 1 January 1980, the first date of the format.
const VERSION: u16 = 45;
const DATE: u16 = 0x21;
/// Placeholder for a size that a ZIP64 field gives.
const LARGE: u32 = u32::MAX;

/// A member of the archive.
struct Member {
    name: String,
    crc: u32,
    size: u64,
    offset: u64,
}

/// Builds the bytes before the records, with zeros for sizes that are not known yet.
pub(crate) fn head(layout: &Layout) -> Vec<u8> {
    let mut head = local_header(&Member { name: ROWS.to_owned(), crc: 0, size: 0, offset: 0 });
    head.extend(array_header(layout, 0));
    head
}

/// Fills in the head, and appends what follows the records: metadata and directory. `data` is the checksum of
/// the records.
///
/// # Errors
/// If the file cannot be written.
pub(crate) fn finish(
    file: &mut File,
    layout: &Layout,
    metadata: &Metadata,
    (bytes, data): (u64, &Hasher),
) -> io::Result<()> {
    let header_size = head(layout).len() as u64 - local_header_size(ROWS) as u64;
    let count = (bytes - head(layout).len() as u64) / size(layout) as u64;
    let header = array_header(layout, count);
    let mut crc = Hasher::new();
    crc.update(&header);
    crc.combine(data);
    let size = header_size + bytes - head(layout).len() as u64;
    let rows = Member { name: ROWS.to_owned(), crc: crc.finalize(), size, offset: 0 };
    file.seek(SeekFrom::Start(0))?;
    file.write_all(&local_header(&rows))?;
    file.write_all(&header)?;
    file.seek(SeekFrom::Start(bytes))?;

    let units: Vec<&str> = layout.varied.iter().chain(&layout.numbers).map(|(_, unit)| *unit).collect();
    let names: Vec<&str> =
        layout.varied.iter().chain(&layout.numbers).map(|(name, _)| name.as_str()).collect();
    let program = Metadata::program();
    let texts: [(&'static str, Vec<&str>, bool); 5] = [
        ("names.npy", names, false),
        ("units.npy", units, false),
        ("model.npy", vec![&metadata.model], true),
        ("command.npy", vec![&metadata.command], true),
        ("program.npy", vec![&program], true),
    ];
    let mut members = vec![rows];
    let mut offset = bytes;
    for (name, texts, single) in texts {
        let content = text_array(&texts, single);
        let mut crc = Hasher::new();
        crc.update(&content);
        let member =
            Member { name: name.to_owned(), crc: crc.finalize(), size: content.len() as u64, offset };
        file.write_all(&local_header(&member))?;
        file.write_all(&content)?;
        offset += local_header_size(name) as u64 + member.size;
        members.push(member);
    }
    file.write_all(&directory(&members, offset))?;
    file.flush()
}

/// An archive of arrays with their names.
pub fn archive(arrays: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut members = Vec::with_capacity(arrays.len());
    for (name, content) in arrays {
        let mut crc = Hasher::new();
        crc.update(content);
        let (size, offset) = (content.len() as u64, out.len() as u64);
        let member = Member { name: format!("{name}.npy"), crc: crc.finalize(), size, offset };
        out.extend(local_header(&member));
        out.extend_from_slice(content);
        members.push(member);
    }
    let start = out.len() as u64;
    out.extend(directory(&members, start));
    out
}

/// Numbers as an array.
pub fn number_array(values: impl ExactSizeIterator<Item = f64>) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", values.len());
    let mut out = npy_header(&header, header.len());
    values.for_each(|value| out.extend_from_slice(&value.to_le_bytes()));
    out
}

fn local_header_size(name: &str) -> usize {
    30 + name.len() + 20
}

/// The header before a member, with its sizes in a ZIP64 field.
fn local_header(member: &Member) -> Vec<u8> {
    let mut out = b"PK\x03\x04".to_vec();
    short(&mut out, &[VERSION, 0, 0, 0, DATE]);
    long(&mut out, &[member.crc, LARGE, LARGE]);
    short(&mut out, &[name_size(member), 20]);
    out.extend_from_slice(member.name.as_bytes());
    short(&mut out, &[1, 16]);
    out.extend_from_slice(&member.size.to_le_bytes());
    out.extend_from_slice(&member.size.to_le_bytes());
    out
}

/// The directory at the end of the archive.
fn directory(members: &[Member], start: u64) -> Vec<u8> {
    let mut out = Vec::new();
    for member in members {
        out.extend_from_slice(b"PK\x01\x02");
        short(&mut out, &[VERSION, VERSION, 0, 0, 0, DATE]);
        long(&mut out, &[member.crc, LARGE, LARGE]);
        short(&mut out, &[name_size(member), 28, 0, 0, 0]);
        long(&mut out, &[0, LARGE]);
        out.extend_from_slice(member.name.as_bytes());
        short(&mut out, &[1, 24]);
        for number in [member.size, member.size, member.offset] {
            out.extend_from_slice(&number.to_le_bytes());
        }
    }
    let (size, count) = (out.len() as u64, members.len() as u64);
    let end = start + size;
    out.extend_from_slice(b"PK\x06\x06");
    out.extend_from_slice(&44_u64.to_le_bytes());
    short(&mut out, &[VERSION, VERSION]);
    long(&mut out, &[0, 0]);
    for number in [count, count, size, start] {
        out.extend_from_slice(&number.to_le_bytes());
    }
    out.extend_from_slice(b"PK\x06\x07");
    long(&mut out, &[0]);
    out.extend_from_slice(&end.to_le_bytes());
    long(&mut out, &[1]);
    out.extend_from_slice(b"PK\x05\x06");
    short(&mut out, &[0, 0, u16::MAX, u16::MAX]);
    long(&mut out, &[LARGE, LARGE]);
    short(&mut out, &[0]);
    out
}

fn name_size(member: &Member) -> u16 {
    u16::try_from(member.name.len()).unwrap_or(u16::MAX)
}

fn short(out: &mut Vec<u8>, numbers: &[u16]) {
    numbers.iter().for_each(|number| out.extend_from_slice(&number.to_le_bytes()));
}

fn long(out: &mut Vec<u8>, numbers: &[u32]) {
    numbers.iter().for_each(|number| out.extend_from_slice(&number.to_le_bytes()));
}

/// The header of the array of records: of the same length whatever their number.
fn array_header(layout: &Layout, count: u64) -> Vec<u8> {
    let kinds: Vec<String> = fields(layout)
        .iter()
        .map(|field| format!("({}, '{}')", text_literal(&field.name), element_type(field.kind)))
        .collect();
    let header = |count: u64| {
        format!("{{'descr': [{}], 'fortran_order': False, 'shape': ({count},), }}", kinds.join(", "))
    };
    npy_header(&header(count), header(u64::MAX).len())
}

/// The type of a field as NumPy writes it.
pub(crate) fn element_type(kind: FieldKind) -> String {
    match kind {
        FieldKind::Point => "<u8".to_owned(),
        FieldKind::Count | FieldKind::Branch => "<u4".to_owned(),
        FieldKind::Number => "<f8".to_owned(),
        FieldKind::Word(size) => format!("|S{size}"),
    }
}

/// A name as Python writes it.
fn text_literal(name: &str) -> String {
    format!("'{}'", name.replace('\\', "\\\\").replace('\'', "\\'"))
}

/// Magic number and header, filled with blanks to a multiple of 64 bytes. Version 2 is for long headers, 3
/// for names that are not ASCII.
fn npy_header(header: &str, room: usize) -> Vec<u8> {
    let whole = (12 + room + 1).next_multiple_of(64);
    let version = if header.is_ascii() { 2 } else { 3 };
    let mut out = b"\x93NUMPY".to_vec();
    out.extend([version, 0]);
    long(&mut out, &[u32::try_from(whole - 12).unwrap_or(u32::MAX)]);
    out.extend_from_slice(header.as_bytes());
    out.resize(whole - 1, b' ');
    out.push(b'\n');
    out
}

/// Texts as an array of UTF-32; a single one as an array without dimensions.
pub fn text_array(texts: &[&str], single: bool) -> Vec<u8> {
    let length = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    let shape = if single { "()".to_owned() } else { format!("({},)", texts.len()) };
    let header = format!("{{'descr': '<U{length}', 'fortran_order': False, 'shape': {shape}, }}");
    let mut out = npy_header(&header, header.len());
    for text in texts {
        let filled = text.chars().map(u32::from).chain(std::iter::repeat(0)).take(length);
        filled.for_each(|character| out.extend_from_slice(&character.to_le_bytes()));
    }
    out
}
