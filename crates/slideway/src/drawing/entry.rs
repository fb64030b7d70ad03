//! Tables of a model file in the order in which they are written.

use super::quantity::{Quantity, text};
use serde::{Deserialize, Serialize};

/// Keys and values. A key that is set again has the later value.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Table {
    values: Vec<(String, Quantity)>,
    inner: Vec<(String, Table)>,
}

impl Table {
    pub(super) fn is_empty(&self) -> bool {
        self.values.is_empty() && self.inner.is_empty()
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.values.iter().any(|(known, _)| known == key)
    }

    pub(super) fn set(&mut self, key: &str, value: Quantity) {
        match self.values.iter_mut().find(|(known, _)| known == key) {
            Some((_, old)) => *old = value,
            None => self.values.push((key.to_owned(), value)),
        }
    }

    pub(super) fn remove(&mut self, key: &str) {
        self.values.retain(|(known, _)| known != key);
    }

    /// Another key, even if there is one of this name: the reader refuses it.
    pub(super) fn add(&mut self, key: &str, value: Quantity) {
        self.values.push((key.to_owned(), value));
    }

    /// A table within this one.
    pub(super) fn inner(&mut self, key: &str) -> &mut Table {
        let index = self.inner.iter().position(|(known, _)| known == key).unwrap_or_else(|| {
            self.inner.push((key.to_owned(), Table::default()));
            self.inner.len() - 1
        });
        &mut self.inner[index].1
    }

    fn in_one_line(&self) -> Quantity {
        let inner: Vec<(String, Quantity)> =
            self.inner.iter().map(|(key, table)| (written_key(key), table.in_one_line())).collect();
        let values = self.values.iter().map(|(key, value)| (key.as_str(), value));
        Quantity::table(values.chain(inner.iter().map(|(key, value)| (key.as_str(), value))))
    }

    /// One line for each key.
    pub(super) fn lines(&self) -> String {
        let line = |key: &str, value: &Quantity| format!("{} = {}\n", written_key(key), value.written());
        let values = self.values.iter().map(|(key, value)| line(key, value));
        let inner = self.inner.iter().map(|(key, table)| line(key, &table.in_one_line()));
        values.chain(inner).collect()
    }
}

/// The entries of a section: names and tables.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Entries(Vec<(String, Table)>);

impl Entries {
    /// The number of a new entry.
    pub(super) fn add(&mut self, name: &str) -> usize {
        self.0.push((name.to_owned(), Table::default()));
        self.0.len() - 1
    }

    pub(super) fn table(&mut self, index: usize) -> &mut Table {
        &mut self.0[index].1
    }

    /// The name of an entry. A handle of another drawing has a name that no entry has, which the model
    /// refuses.
    pub(super) fn plain_name(&self, index: usize) -> String {
        self.0
            .get(index)
            .map_or_else(|| format!("entry {index} of another drawing"), |(name, _)| name.clone())
    }

    pub(super) fn name(&self, index: usize) -> Quantity {
        text(&self.plain_name(index))
    }

    pub(super) fn text(&self, section: &str) -> String {
        self.0.iter().map(|(name, table)| line(&[section, name]) + &table.lines()).collect()
    }
}

/// The head of a table.
pub(super) fn line(path: &[&str]) -> String {
    let path: Vec<String> = path.iter().map(|key| written_key(key)).collect();
    format!("\n[{}]\n", path.join("."))
}

/// A key with quotation marks where it needs them.
pub(crate) fn written_key(key: &str) -> String {
    let is_bare = |character: char| character.is_ascii_alphanumeric() || character == '_' || character == '-';
    if !key.is_empty() && key.chars().all(is_bare) { key.to_owned() } else { text(key).written().to_owned() }
}
