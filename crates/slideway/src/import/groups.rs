//! The pairs of group code and value of which a DXF file consists.

use super::{ImportFault, shown};
use std::collections::BTreeMap;

/// One pair, with the line of its value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group<'t> {
    pub(super) code: i32,
    pub(super) value: &'t str,
    pub(super) line: usize,
}

/// An entity: its type and its groups.
#[derive(Debug, Clone)]
pub(super) struct Record<'t> {
    pub(super) kind: &'t str,
    pub(super) line: usize,
    pub(super) groups: Vec<Group<'t>>,
}

/// Parts of a file that are read: its unit, entities and blocks.
#[derive(Debug, Clone)]
pub(super) struct Sections<'t> {
    /// `$INSUNITS`
    pub(super) unit: Option<i32>,
    pub(super) entities: Vec<Record<'t>>,
    /// The blocks by their names in capital letters: these are the same in any.
    pub(super) blocks: BTreeMap<String, Block<'t>>,
}

/// Entities that are inserted together.
#[derive(Debug, Clone)]
pub(super) struct Block<'t> {
    pub(super) head: Record<'t>,
    pub(super) entities: Vec<Record<'t>>,
}

/// Reads a file as far as its `EOF`.
pub(super) fn sections(text: &str) -> Result<Sections<'_>, ImportFault> {
    if text.starts_with("AutoCAD Binary DXF") {
        return Err(ImportFault::Binary);
    }
    let records = records(text.strip_prefix('\u{feff}').unwrap_or(text))?;
    let mut unit = None;
    let mut entities = None;
    let mut blocks: Vec<Block<'_>> = Vec::new();
    let mut section = "";
    for record in records {
        match record.kind {
            "SECTION" => {
                section = record.first(2).map_or("", |group| group.value);
                if section == "HEADER" {
                    unit = record.header_number("$INSUNITS")?;
                } else if section == "ENTITIES" {
                    entities = Some(Vec::new());
                }
            }
            "ENDSEC" => section = "",
            "BLOCK" if section == "BLOCKS" => blocks.push(Block { head: record, entities: Vec::new() }),
            "ENDBLK" => {}
            _ if section == "BLOCKS" => {
                if let Some(block) = blocks.last_mut() {
                    block.entities.push(record);
                }
            }
            _ if section == "ENTITIES" => entities.iter_mut().for_each(|all| all.push(record.clone())),
            _ => {}
        }
    }
    let name = |block: &Block<'_>| {
        block.head.first(2).map_or_else(String::new, |group| group.value.to_ascii_uppercase())
    };
    let blocks = blocks.into_iter().map(|block| (name(&block), block)).collect();
    Ok(Sections { unit, entities: entities.ok_or(ImportFault::NoEntities)?, blocks })
}

/// The records of a file: each begins with a group 0.
fn records(text: &str) -> Result<Vec<Record<'_>>, ImportFault> {
    let mut lines = text.lines().zip(1..);
    let mut records: Vec<Record<'_>> = Vec::new();
    while let Some((written, line)) = lines.next() {
        let code: i32 = written
            .trim()
            .parse()
            .map_err(|_| ImportFault::GroupCode { line, found: shown(written.trim()) })?;
        let (value, line) = lines.next().ok_or(ImportFault::Truncated)?;
        let value = value.trim();
        match (code, records.last_mut()) {
            (0, _) if value == "EOF" => return Ok(records),
            (0, _) => records.push(Record { kind: value, line, groups: Vec::new() }),
            (999, _) | (_, None) => {}
            (_, Some(record)) => record.groups.push(Group { code, value, line }),
        }
    }
    Err(ImportFault::Truncated)
}

impl<'t> Record<'t> {
    /// The first group of a code.
    pub(super) fn first(&self, code: i32) -> Option<Group<'t>> {
        self.groups.iter().find(|group| group.code == code).copied()
    }

    /// The number of a group.
    pub(super) fn number_of(&self, group: Group<'_>) -> Result<f64, ImportFault> {
        let Group { code, value, line } = group;
        let number = value.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| ImportFault::Number {
            line,
            code,
            entity: shown(self.kind),
            found: shown(value),
        })
    }

    /// The number of a code that must be there.
    pub(super) fn number(&self, code: i32) -> Result<f64, ImportFault> {
        let missing = || ImportFault::Missing { line: self.line, code, entity: shown(self.kind) };
        self.number_of(self.first(code).ok_or_else(missing)?)
    }

    /// The number of a code, or another one.
    pub(super) fn number_or(&self, code: i32, otherwise: f64) -> Result<f64, ImportFault> {
        self.first(code).map_or(Ok(otherwise), |group| self.number_of(group))
    }

    /// A set of flags, none if it is not there.
    pub(super) fn flags(&self, code: i32) -> Result<u32, ImportFault> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        self.number_or(code, 0.0).map(|flags| flags as u32)
    }

    /// Whether it is on a sheet for printing (paper space).
    pub(super) fn is_on_sheet(&self) -> bool {
        self.first(67).is_some_and(|group| group.value == "1")
    }

    /// The number that follows a variable of the header.
    fn header_number(&self, variable: &str) -> Result<Option<i32>, ImportFault> {
        let at = self.groups.iter().position(|group| group.code == 9 && group.value == variable);
        let Some(group) = at.and_then(|at| self.groups.get(at + 1)) else { return Ok(None) };
        #[expect(clippy::cast_possible_truncation, reason = "saturates")]
        self.number_of(*group).map(|number| Some(number as i32))
    }
}
