//! Sets of contacts of any size.

/// A set of contacts as bits.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct ContactSet {
    words: Vec<u64>,
}

impl ContactSet {
    /// The empty set, for the given number of contacts.
    pub(crate) fn none_of(contacts: usize) -> Self {
        Self { words: vec![0; contacts.div_ceil(64)] }
    }

    pub(crate) fn insert(&mut self, contact: usize) {
        self.words[contact / 64] |= 1 << (contact % 64);
    }

    pub(crate) fn remove(&mut self, contact: usize) {
        self.words[contact / 64] &= !(1 << (contact % 64));
    }

    pub(crate) fn contains(&self, contact: usize) -> bool {
        self.words[contact / 64] >> (contact % 64) & 1 == 1
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.words.iter().all(|&word| word == 0)
    }

    /// The number of contacts in the set.
    pub(crate) fn len(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether another set, for the same number of contacts, contains this one.
    pub(crate) fn is_within(&self, other: &Self) -> bool {
        self.words.iter().zip(&other.words).all(|(own, others)| own & !others == 0)
    }

    /// Whether no contact is in both sets, which are for the same number of contacts.
    pub(crate) fn is_disjoint(&self, other: &Self) -> bool {
        self.words.iter().zip(&other.words).all(|(own, others)| own & others == 0)
    }

    /// The contacts of the set in increasing order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> {
        (0..64 * self.words.len()).filter(|&contact| self.contains(contact))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_contacts_beyond_one_word() {
        let mut set = ContactSet::none_of(130);
        assert!(set.is_empty());
        for contact in [129, 0, 64] {
            set.insert(contact);
        }
        set.remove(64);
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 129]);
        assert!(set.contains(129) && !set.contains(64));
        assert_eq!(set.len(), 2);
        let mut more = set.clone();
        more.insert(70);
        assert!(set.is_within(&more) && set.is_within(&set) && !more.is_within(&set));
        more.remove(0);
        more.remove(129);
        assert!(more.is_disjoint(&set) && !set.is_disjoint(&set));
    }
}
