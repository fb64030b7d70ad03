//! The NumPy array format: a header in Python notation, followed by the entries.
//!
//! Supports only what problems and answers need: versions 1 to 3 of the format, real numbers and texts (NumPy
//! documentation, "numpy.lib.format").

use super::GREATEST_SIZE;
use super::fault::RawFault;
use super::shape::Array;

const MAGIC: &[u8] = b"\x93NUMPY";
/// The header is padded so that the entries start at a multiple of this.
const ALIGNMENT: usize = 64;

/// A header and the bytes that follow it.
struct Npy<'b> {
    /// The type of the entries, for example `<f8`.
    entry_type: String,
    column_major: bool,
    sizes: Vec<usize>,
    data: &'b [u8],
}

/// The numbers of an array with up to `most` entries.
pub(super) fn numbers(key: &str, bytes: &[u8], most: usize) -> Result<Array, RawFault> {
    let broken = |reason| RawFault::Npy { key: key.to_owned(), reason };
    let npy = Npy::parse(bytes).map_err(broken)?;
    let Some(entry) = EntryType::of(&npy.entry_type) else {
        return Err(RawFault::EntryType { key: key.to_owned(), found: npy.entry_type });
    };
    let count = npy.sizes.iter().try_fold(1, |count: usize, &size| count.checked_mul(size));
    let Some(count) = count.filter(|&count| count <= most) else {
        let found = npy.sizes.iter().copied().max().unwrap_or(usize::MAX);
        return Err(RawFault::TooManyUnknowns { found, limit: GREATEST_SIZE });
    };
    if npy.data.len() != count * entry.width {
        return Err(broken("its length is not that of its entries"));
    }
    let mut values: Vec<f64> = npy.data.chunks_exact(entry.width).map(|bytes| entry.value(bytes)).collect();
    if let ([rows, columns], true) = (npy.sizes.as_slice(), npy.column_major) {
        values = (0..count).map(|at| values[at % columns * rows + at / columns]).collect();
    }
    Ok(Array { sizes: npy.sizes, values })
}

/// The text of an array that contains a single text.
pub(super) fn text(key: &str, bytes: &[u8]) -> Result<Option<String>, RawFault> {
    let npy = Npy::parse(bytes).map_err(|reason| RawFault::Npy { key: key.to_owned(), reason })?;
    if npy.sizes.iter().any(|&size| size != 1) {
        return Ok(None);
    }
    let characters: Option<String> = match npy.entry_type.as_bytes() {
        [b'|', b'S', ..] => {
            npy.data.iter().map(|&byte| byte.is_ascii().then_some(char::from(byte))).collect()
        }
        [order, b'U', ..] => npy
            .data
            .chunks_exact(4)
            .map(|code| {
                let code = code.try_into().ok()?;
                char::from_u32(if *order == b'>' {
                    u32::from_be_bytes(code)
                } else {
                    u32::from_le_bytes(code)
                })
            })
            .collect(),
        _ => None,
    };
    Ok(characters.map(|text| text.trim_end_matches('\0').to_owned()))
}

/// How the entries of an array are stored.
#[derive(Clone, Copy)]
struct EntryType {
    kind: Kind,
    /// Number of bytes per entry.
    width: usize,
    /// Whether the most significant byte comes first.
    big_endian: bool,
}

#[derive(Clone, Copy)]
enum Kind {
    Float,
    Signed,
    Unsigned,
}

impl EntryType {
    /// From NumPy's notation, such as `<f8`; `None` if it is not a real number.
    fn of(word: &str) -> Option<Self> {
        let (kind, width) = match word.get(1..)? {
            "f8" => (Kind::Float, 8),
            "f4" => (Kind::Float, 4),
            "i8" => (Kind::Signed, 8),
            "i4" => (Kind::Signed, 4),
            "i2" => (Kind::Signed, 2),
            "i1" => (Kind::Signed, 1),
            "u8" => (Kind::Unsigned, 8),
            "u4" => (Kind::Unsigned, 4),
            "u2" => (Kind::Unsigned, 2),
            "u1" => (Kind::Unsigned, 1),
            _ => return None,
        };
        let big_endian = match word.chars().next()? {
            '<' | '|' => false,
            '>' => true,
            '=' => cfg!(target_endian = "big"),
            _ => return None,
        };
        Some(Self { kind, width, big_endian })
    }

    /// The value of an entry; integers beyond 2^53 are rounded to the nearest number.
    fn value(self, bytes: &[u8]) -> f64 {
        let mut little = [0; 8];
        little[..self.width].copy_from_slice(bytes);
        if self.big_endian {
            little[..self.width].reverse();
        }
        let bits = u64::from_le_bytes(little);
        let unused = 64 - 8 * self.width;
        match self.kind {
            Kind::Float if self.width == 4 => {
                let [a, b, c, d, ..] = little;
                f32::from_le_bytes([a, b, c, d]).into()
            }
            Kind::Float => f64::from_bits(bits),
            Kind::Signed => ((bits << unused).cast_signed() >> unused) as f64,
            Kind::Unsigned => bits as f64,
        }
    }
}

impl<'b> Npy<'b> {
    fn parse(bytes: &'b [u8]) -> Result<Self, &'static str> {
        let rest = bytes.strip_prefix(MAGIC).ok_or("it does not begin as one")?;
        let (&[major, _], rest) = rest.split_first_chunk::<2>().ok_or("it ends within its header")?;
        let (length, rest) = match major {
            1 => rest.split_first_chunk().map(|(size, rest)| (usize::from(u16::from_le_bytes(*size)), rest)),
            2 | 3 => rest
                .split_first_chunk()
                .and_then(|(size, rest)| Some((usize::try_from(u32::from_le_bytes(*size)).ok()?, rest))),
            _ => return Err("its version of the format is unknown"),
        }
        .ok_or("it ends within its header")?;
        let (header, data) = rest.split_at_checked(length).ok_or("it ends within its header")?;
        let header = std::str::from_utf8(header).map_err(|_| "its header is not text")?;
        Self::with_header(header, data).ok_or("its header cannot be read")
    }

    /// For example `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }`.
    fn with_header(header: &str, data: &'b [u8]) -> Option<Self> {
        let mut rest = header.trim().strip_prefix('{')?.strip_suffix('}')?.trim_start();
        let (mut entry_type, mut column_major, mut sizes) = (None, None, None);
        while !rest.is_empty() {
            let (key, after) = quoted(rest)?;
            let value = after.trim_start().strip_prefix(':')?.trim_start();
            let after = match key {
                "descr" if value.starts_with(['\'', '"']) => {
                    let (text, after) = quoted(value)?;
                    entry_type = Some(text.to_owned());
                    after
                }
                // A list of the fields of structured entries.
                "descr" => {
                    let end = value.rfind(']')? + 1;
                    entry_type = Some(value[..end].to_owned());
                    &value[end..]
                }
                "fortran_order" => {
                    column_major = Some(value.starts_with("True"));
                    value.strip_prefix("True").or_else(|| value.strip_prefix("False"))?
                }
                "shape" => {
                    let (inside, after) = value.strip_prefix('(')?.split_once(')')?;
                    let numbers = inside.split(',').map(str::trim).filter(|number| !number.is_empty());
                    sizes = Some(numbers.map(|number| number.parse().ok()).collect::<Option<Vec<usize>>>()?);
                    after
                }
                _ => return None,
            };
            let after = after.trim_start();
            rest = after.strip_prefix(',').map_or(after, str::trim_start);
        }
        Some(Self { entry_type: entry_type?, column_major: column_major?, sizes: sizes?, data })
    }
}

/// A text in single or double quotes, and what follows it.
fn quoted(text: &str) -> Option<(&str, &str)> {
    let quote = text.chars().next().filter(|quote| ['\'', '"'].contains(quote))?;
    text[1..].split_once(quote)
}

/// An array of 64-bit floating-point numbers, row by row.
pub(super) fn write_numbers(sizes: &[usize], values: &[f64]) -> Vec<u8> {
    with_header("<f8", sizes, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// An array of 64-bit integers, row by row.
pub(super) fn write_integers(sizes: &[usize], values: &[i64]) -> Vec<u8> {
    with_header("<i8", sizes, values.iter().flat_map(|value| value.to_le_bytes()))
}

/// An array of truth values.
pub(super) fn write_truths(sizes: &[usize], values: &[bool]) -> Vec<u8> {
    with_header("|b1", sizes, values.iter().map(|&value| u8::from(value)))
}

/// An array of texts; for a single text without dimensions, `sizes` is empty.
pub(super) fn write_texts(sizes: &[usize], values: &[&str]) -> Vec<u8> {
    let width = values.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    let padded = |text: &&str| {
        let codes = text.chars().map(u32::from).chain(std::iter::repeat(0)).take(width);
        codes.flat_map(u32::to_le_bytes).collect::<Vec<u8>>()
    };
    with_header(&format!("<U{width}"), sizes, values.iter().flat_map(padded))
}

fn with_header(entry_type: &str, sizes: &[usize], data: impl Iterator<Item = u8>) -> Vec<u8> {
    let shape = match sizes {
        [length] => format!("{length},"),
        sizes => sizes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    };
    let header = format!("{{'descr': '{entry_type}', 'fortran_order': False, 'shape': ({shape}), }}");
    let before = MAGIC.len() + 4;
    let length = (before + header.len() + 1).next_multiple_of(ALIGNMENT) - before;
    let mut bytes = [MAGIC, &[1, 0]].concat();
    let short = u16::try_from(length).expect("a header with few dimensions is short");
    bytes.extend(short.to_le_bytes());
    bytes.extend(format!("{header:width$}\n", width = length - 1).bytes());
    bytes.extend(data);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_can_be_read() {
        let bytes = write_numbers(&[2, 3], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(bytes.len(), 128 + 48);
        let array = numbers("M", &bytes, 6).expect("an array");
        assert_eq!((array.sizes.as_slice(), array.values[4]), (&[2, 3][..], 5.0));
        let too_many = numbers("M", &bytes, 5).map_err(|fault| fault.to_string());
        assert_eq!(too_many, Err("the problem has 3 unknowns; at most 2000 are accepted".to_owned()));
        assert_eq!(text("type", &write_texts(&[], &["lcp"])), Ok(Some("lcp".to_owned())));
    }

    #[test]
    fn entries_of_every_type_have_their_value() {
        let table: [(&str, &[u8], f64); 8] = [
            ("<f8", &0.1_f64.to_le_bytes(), 0.1),
            (">f8", &0.1_f64.to_be_bytes(), 0.1),
            (">f4", &(-2.5_f32).to_be_bytes(), -2.5),
            ("<i8", &(-7_i64).to_le_bytes(), -7.0),
            (">i2", &(-300_i16).to_be_bytes(), -300.0),
            ("|i1", &(-1_i8).to_le_bytes(), -1.0),
            ("<u4", &u32::MAX.to_le_bytes(), 4_294_967_295.0),
            ("|u1", &[255], 255.0),
        ];
        for (word, bytes, value) in table {
            assert_eq!(EntryType::of(word).expect(word).value(bytes), value, "{word}");
        }
        assert!(["<c16", "|b1", "<U3", "|O", "f8", "", "é"].iter().all(|word| EntryType::of(word).is_none()));
    }

    #[test]
    fn headers_of_numpy_are_understood() {
        let headers = [
            ("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }", vec![3, 3]),
            ("{'shape': (), 'fortran_order': True, 'descr': '>i4'}", vec![]),
            ("{\"descr\": \"|S3\", \"fortran_order\": False, \"shape\": (4,)}  \n", vec![4]),
            ("{'descr': [('a', '<f8'), ('b', '<i4')], 'fortran_order': False, 'shape': (1,), }", vec![1]),
        ];
        for (header, sizes) in headers {
            assert_eq!(Npy::with_header(header, &[]).expect(header).sizes, sizes);
        }
        for header in ["", "{", "{}", "{'descr': '<f8'}", "{'descr': 3}", "{'shape': (-1,)}", "{'shape': (1"]
        {
            assert!(Npy::with_header(header, &[]).is_none(), "{header}");
        }
    }
}
