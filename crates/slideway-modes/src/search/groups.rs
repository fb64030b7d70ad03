//! Groups of contacts that depend on one another.
//!
//! Contact `k` acts on equation `i` if `c_k^+`, `c_k^-`, `d_k^+` or `d_k^-` has an entry in row `i` that is
//! nonzero, or may be nonzero within the bounds of the data. The strongly connected components of that graph
//! are the diagonal blocks of a block-triangular problem: a group needs the solution of the groups that act
//! on it, and of no others (theory, section 4 (d)). A contact whose right-hand side jumps stays together with
//! all equations that the jump reaches, because its gap states depend on all of them.

use crate::problem::ProblemView;

/// Groups in an order in which each acts only on later ones.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Groups {
    /// The contacts of each group in increasing order.
    pub(super) members: Vec<Vec<usize>>,
    /// For each group, the later groups on which it acts, in increasing order.
    acts_on: Vec<Vec<usize>>,
}

impl Groups {
    pub(super) fn new(problem: ProblemView<'_>) -> Self {
        let single = Self {
            members: (0..problem.contacts()).map(|contact| vec![contact]).collect(),
            acts_on: coupling_graph(problem),
        };
        single.condensed()
    }

    /// Groups that act on one another in both directions become one.
    fn condensed(&self) -> Self {
        let mut components = strong_components(&self.acts_on);
        // Tarjan's algorithm finishes components before those that act on them.
        components.reverse();
        let mut component_of = vec![0; self.members.len()];
        for (component, groups) in components.iter().enumerate() {
            for &group in groups {
                component_of[group] = component;
            }
        }
        let sorted = |mut list: Vec<usize>| {
            list.sort_unstable();
            list.dedup();
            list
        };
        let members = components
            .iter()
            .map(|groups| sorted(groups.iter().flat_map(|&group| &self.members[group]).copied().collect()));
        let acts_on = components.iter().enumerate().map(|(component, groups)| {
            let targets = groups.iter().flat_map(|&group| &self.acts_on[group]);
            let targets = targets.map(|&target| component_of[target]);
            sorted(targets.filter(|&target| target != component).collect())
        });
        Self { members: members.collect(), acts_on: acts_on.collect() }
    }

    /// Only some of the groups, given in increasing order, renumbered.
    pub(super) fn restricted(&self, groups: &[usize]) -> Self {
        let members = groups.iter().map(|&group| self.members[group].clone());
        let acts_on = groups.iter().map(|&group| {
            self.acts_on[group].iter().filter_map(|target| groups.binary_search(target).ok()).collect()
        });
        Self { members: members.collect(), acts_on: acts_on.collect() }
    }

    /// The groups after each of `chosen` has become one with all groups that act on it in at most so many
    /// steps, with what these act on directly, and with all groups in between.
    pub(super) fn joined_with_ancestors(&self, chosen: &[usize], steps: usize) -> Self {
        let mut joined = self.clone();
        for &group in chosen {
            let mut reaches = vec![false; self.members.len()];
            reaches[group] = true;
            for _ in 0..steps {
                let further: Vec<usize> = (0..reaches.len())
                    .filter(|&at| !reaches[at] && self.acts_on[at].iter().any(|&target| reaches[target]))
                    .collect();
                // Groups become one if each acts on the other, perhaps by way of others.
                for ancestor in further {
                    reaches[ancestor] = true;
                    joined.acts_on[group].push(ancestor);
                    for &target in &self.acts_on[ancestor] {
                        joined.acts_on[target].push(group);
                    }
                }
            }
        }
        joined.condensed()
    }

    /// All contacts in one group.
    pub(super) fn whole(problem: ProblemView<'_>) -> Self {
        Self { members: vec![(0..problem.contacts()).collect()], acts_on: vec![Vec::new()] }
    }

    /// Splits some of the groups, given in increasing order, into parts that do not act on one another, each
    /// in increasing order.
    pub(super) fn independent_parts(&self, groups: &[usize]) -> Vec<Vec<usize>> {
        let mut part_of: Vec<usize> = (0..groups.len()).collect();
        for (at, &group) in groups.iter().enumerate() {
            for target in &self.acts_on[group] {
                if let Ok(other) = groups.binary_search(target) {
                    join(&mut part_of, at, other);
                }
            }
        }
        let mut parts: Vec<Vec<usize>> = vec![Vec::new(); groups.len()];
        for (at, &group) in groups.iter().enumerate() {
            parts[root(&mut part_of, at)].push(group);
        }
        parts.retain(|part| !part.is_empty());
        parts
    }
}

fn root(part_of: &mut [usize], mut at: usize) -> usize {
    while part_of[at] != at {
        part_of[at] = part_of[part_of[at]];
        at = part_of[at];
    }
    at
}

fn join(part_of: &mut [usize], one: usize, other: usize) {
    let (one, other) = (root(part_of, one), root(part_of, other));
    part_of[one.max(other)] = one.min(other);
}

/// For each contact, the equations on which it acts, and the contacts that must stay with it.
fn coupling_graph(problem: ProblemView<'_>) -> Vec<Vec<usize>> {
    let contacts = problem.contacts();
    let mut graph: Vec<Vec<usize>> = vec![Vec::new(); contacts];
    for contact in 0..contacts {
        for row in (0..contacts).filter(|&row| row != contact) {
            if problem.couples(contact, row) {
                graph[contact].push(row);
                if problem.jumps_in_row(contact, row) {
                    graph[row].push(contact);
                }
            }
        }
    }
    graph
}

/// Tarjan's strongly connected components, without recursion: a component comes after those that it reaches.
fn strong_components(graph: &[Vec<usize>]) -> Vec<Vec<usize>> {
    const NEW: usize = usize::MAX;
    let mut number = vec![NEW; graph.len()];
    let mut lowest = vec![0; graph.len()];
    let mut on_stack = vec![false; graph.len()];
    let (mut stack, mut components, mut next) = (Vec::new(), Vec::new(), 0);
    for start in 0..graph.len() {
        if number[start] != NEW {
            continue;
        }
        // Vertices on the path, with the number of their edges that have been followed.
        let mut way = vec![(start, 0)];
        while let Some(&mut (vertex, ref mut followed)) = way.last_mut() {
            if *followed == 0 {
                (number[vertex], lowest[vertex], on_stack[vertex]) = (next, next, true);
                next += 1;
                stack.push(vertex);
            }
            if let Some(&target) = graph[vertex].get(*followed) {
                *followed += 1;
                if number[target] == NEW {
                    way.push((target, 0));
                } else if on_stack[target] {
                    lowest[vertex] = lowest[vertex].min(number[target]);
                }
                continue;
            }
            way.pop();
            if let Some(&(parent, _)) = way.last() {
                lowest[parent] = lowest[parent].min(lowest[vertex]);
            }
            if lowest[vertex] == number[vertex] {
                let from = stack.iter().rposition(|&other| other == vertex).unwrap_or(0);
                let component = stack.split_off(from);
                for &member in &component {
                    on_stack[member] = false;
                }
                components.push(component);
            }
        }
    }
    components
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, dmatrix};

    use super::*;
    use crate::problem::ModeProblem;

    fn groups(coupling: &DMatrix<f64>, jumps: DMatrix<f64>) -> Groups {
        let contacts = coupling.nrows();
        let problem = ModeProblem::new(
            coupling.clone(),
            -coupling,
            jumps,
            DMatrix::zeros(contacts, contacts),
            DVector::zeros(contacts),
        );
        Groups::new((&problem.expect("shapes fit")).into())
    }

    #[test]
    fn blocks_come_in_the_order_of_their_action() {
        // 2 acts on 0; 0 and 1 act on each other; 3 acts on nothing.
        let coupling = dmatrix![
            1.0, 1.0, 1.0, 0.0;
            1.0, 1.0, 0.0, 0.0;
            0.0, 0.0, 1.0, 0.0;
            0.0, 0.0, 0.0, 1.0];
        let found = groups(&coupling, DMatrix::zeros(4, 4));
        let parts = found.independent_parts(&(0..found.members.len()).collect::<Vec<_>>());
        let contacts: Vec<Vec<Vec<usize>>> = parts
            .iter()
            .map(|part| part.iter().map(|&group| found.members[group].clone()).collect())
            .collect();
        assert_eq!(contacts.len(), 2);
        assert!(contacts.contains(&vec![vec![2], vec![0, 1]]));
        assert!(contacts.contains(&vec![vec![3]]));
    }

    #[test]
    fn groups_join_their_ancestors() {
        // 0 acts on 1, 1 on 2, 2 on 3 and 5, 4 on 3.
        let mut coupling = DMatrix::identity(6, 6);
        for (row, column) in [(1, 0), (2, 1), (3, 2), (5, 2), (3, 4)] {
            coupling[(row, column)] = 1.0;
        }
        let chain = groups(&coupling, DMatrix::zeros(6, 6));
        let last = chain.members.iter().position(|members| members == &[3]).expect("a group of its own");
        let joined = |steps| {
            let mut members = chain.joined_with_ancestors(&[last], steps).members;
            members.sort();
            members
        };
        assert_eq!(joined(1), [vec![0], vec![1], vec![2, 3, 4, 5]]);
        assert_eq!(joined(2), [vec![0], vec![1, 2, 3, 4, 5]]);
        assert_eq!(joined(3), [vec![0, 1, 2, 3, 4, 5]]);
    }

    #[test]
    fn a_jump_keeps_what_it_reaches_together() {
        let mut jumps = DMatrix::zeros(2, 2);
        jumps[(1, 0)] = 1.0;
        assert_eq!(groups(&DMatrix::identity(2, 2), jumps).members, [[0, 1]]);
        assert_eq!(groups(&DMatrix::identity(2, 2), DMatrix::zeros(2, 2)).members.len(), 2);
    }
}
