//! The answer of a search.

use std::collections::BTreeMap;

use super::product::{SolutionProduct, StateCounts};
use super::report::{Completeness, GroupReport};

/// Everything that a search found, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchResult {
    /// All solutions, gap states and singular sets, in product form.
    pub product: SolutionProduct,
    /// Whether they are all there are.
    pub completeness: Completeness,
    /// How each group of contacts was searched. A group that depends on others is searched once for
    /// each of their solutions, and the reports are added up.
    pub groups: Vec<GroupReport>,
    /// Number `r` of contacts.
    pub contacts: usize,
}

impl SearchResult {
    /// The numbers of solutions, gap states and combinations with singular sets.
    pub fn counts(&self) -> StateCounts {
        self.product.counts()
    }

    /// Nodes visited.
    pub fn nodes(&self) -> u64 {
        self.groups.iter().map(|group| group.nodes).sum()
    }

    /// The strategy in words: how many groups were solved with which method.
    pub fn strategy(&self) -> String {
        let mut methods: BTreeMap<String, (usize, usize)> = BTreeMap::new();
        for group in &self.groups {
            let (groups, largest) = methods.entry(group.method.to_string()).or_default();
            *groups += 1;
            *largest = (*largest).max(group.contacts.len());
        }
        let words = methods.iter().map(|(method, (groups, largest))| match groups {
            1 => format!("a group of {largest} contacts: {method}"),
            _ => format!("{groups} groups of up to {largest} contacts: {method}"),
        });
        words.collect::<Vec<_>>().join("; ")
    }
}
