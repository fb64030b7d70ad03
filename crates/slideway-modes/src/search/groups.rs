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
        let graph = coupling_graph(problem);
        let mut members = strong_components(&graph);
        // Tarjan's algorithm finishes components before those that act on them.
        members.reverse();
        for group in &mut members {
            group.sort_unstable();
        }
        let mut group_of = vec![0; problem.contacts()];
        for (group, contacts) in members.iter().enumerate() {
            for &contact in contacts {
                group_of[contact] = group;
            }
        }
        let acts_on = members.iter().enumerate().map(|(group, contacts)| {
            let mut targets: Vec<usize> =
                contacts.iter().flat_map(|&contact| &graph[contact]).map(|&row| group_of[row]).collect();
            targets.sort_unstable();
            targets.dedup();
            targets.retain(|&target| target != group);
            targets
        });
        let acts_on = acts_on.collect();
        Self { members, acts_on }
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
    fn a_jump_keeps_what_it_reaches_together() {
        let mut jumps = DMatrix::zeros(2, 2);
        jumps[(1, 0)] = 1.0;
        assert_eq!(groups(&DMatrix::identity(2, 2), jumps).members, [[0, 1]]);
        assert_eq!(groups(&DMatrix::identity(2, 2), DMatrix::zeros(2, 2)).members.len(), 2);
    }
}
