//! Sweeps in parts that are computed by themselves.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One of so many parts of a sweep, counted from 1.
///
/// ```
/// use slideway::sweep::Shard;
///
/// assert_eq!("3/64".parse(), Shard::new(3, 64));
/// assert!("0/4".parse::<Shard>().is_err() && "5/4".parse::<Shard>().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    number: u32,
    of: u32,
}

/// Why something is no shard.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each variant says what its values mean")]
pub enum ShardFault {
    /// Not two numbers with a slash between them.
    #[error("`{text}` is no shard: expected its number and how many there are, such as 3/64")]
    Malformed { text: String },
    /// There is no shard of that number.
    #[error("there is no shard {number} of {of}: shards are counted from 1 to their number")]
    Outside { number: u32, of: u32 },
}

impl Shard {
    /// The shard of this number, from 1, of so many.
    ///
    /// # Errors
    /// If there is none of that number.
    pub fn new(number: u32, of: u32) -> Result<Self, ShardFault> {
        let exists = (1..=of).contains(&number);
        if exists { Ok(Self { number, of }) } else { Err(ShardFault::Outside { number, of }) }
    }

    /// All shards, if there are so many.
    pub fn all(of: u32) -> impl Iterator<Item = Self> {
        (1..=of).map(move |number| Self { number, of })
    }

    /// Its number, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// How many there are.
    pub fn of(self) -> u32 {
        self.of
    }

    /// Its part of so many things in their order: from floor((k - 1) m / n) to floor(k m / n), so that the
    /// parts of m things differ by one at most.
    pub(super) fn range(self, things: u64) -> Range<u64> {
        let end = |number: u32| {
            let end = u128::from(number) * u128::from(things) / u128::from(self.of);
            u64::try_from(end).unwrap_or(things)
        };
        end(self.number - 1)..end(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

/// From "3/64".
impl FromStr for Shard {
    type Err = ShardFault;

    fn from_str(text: &str) -> Result<Self, ShardFault> {
        let numbers = text.split_once('/').map(|(number, of)| (number.trim().parse(), of.trim().parse()));
        let Some((Ok(number), Ok(of))) = numbers else {
            return Err(ShardFault::Malformed { text: text.to_owned() });
        };
        Self::new(number, of)
    }
}

impl TryFrom<String> for Shard {
    type Error = ShardFault;

    fn try_from(text: String) -> Result<Self, ShardFault> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_follow_one_another_and_differ_by_one_at_most() {
        for things in [0, 1, 3, 4, 10, 1_000_000_000_007] {
            for of in [1, 2, 3, 4, 7, 64] {
                let parts: Vec<Range<u64>> = Shard::all(of).map(|shard| shard.range(things)).collect();
                assert_eq!((parts[0].start, parts[of as usize - 1].end), (0, things));
                assert!(parts.windows(2).all(|two| two[0].end == two[1].start), "{parts:?}");
                let sizes = parts.iter().map(|part| part.end - part.start);
                let (least, most) = (sizes.clone().min(), sizes.max());
                assert!(most.zip(least).is_some_and(|(most, least)| most - least <= 1), "{parts:?}");
            }
        }
    }

    #[test]
    fn what_is_no_shard_is_told() {
        let told = |text: &str| text.parse::<Shard>().expect_err("none").to_string();
        assert_eq!(told("0/4"), "there is no shard 0 of 4: shards are counted from 1 to their number");
        assert_eq!(told("5/4"), "there is no shard 5 of 4: shards are counted from 1 to their number");
        for text in ["3", "3/", "/3", "-1/4", "a/b", "1/2/3", "1/99999999999"] {
            assert!(told(text).contains("expected its number and how many there are"), "{text}");
        }
        assert_eq!(" 3 / 64".parse::<Shard>().map(|shard| shard.to_string()), Ok("3/64".to_owned()));
    }
}
