//! Order in which the direct solver eliminates nodes and multipliers, and the fronts that follow.

use std::collections::BTreeSet;

/// What is eliminated together, and what it is coupled to at that time.
#[derive(Debug, Clone)]
pub(crate) struct FrontPlan {
    /// Groups eliminated here.
    pub own: Vec<usize>,
    /// Groups still to be eliminated that are coupled to them.
    pub boundary: Vec<usize>,
    /// Fronts whose Schur complements are added here.
    pub children: Vec<usize>,
    /// Front that this one's Schur complement is added to.
    pub parent: Option<usize>,
}

/// Fronts with fewer unknowns than this are merged with their parents: a dense kernel wants work.
const SMALLEST_FRONT: usize = 48;

/// Plans the elimination of groups of unknowns with the given `sizes` and couplings, children
/// first.
///
/// Minimum degree, weighted by size; of equals the one that has least to wait for, so that the tree
/// of fronts is bushy and threads find work. But groups from `first_multiplier` on wait until all
/// that they were coupled to is eliminated: their own diagonal is zero.
pub(crate) fn plan(
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    first_multiplier: usize,
) -> Vec<FrontPlan> {
    let waiting = coupled.iter().enumerate().map(|(g, neighbours)| {
        if g < first_multiplier {
            0
        } else {
            neighbours.iter().filter(|&&n| n != g).count()
        }
    });
    merge(sizes, elimination(sizes, coupled, waiting.collect()))
}

/// Has a group wait for ever.
pub(crate) const NEVER: usize = usize::MAX;

/// The order of elimination, one group in each front, not linked. Each group waits until so many of
/// those that it is coupled to are eliminated.
pub(crate) fn elimination(
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    mut waiting: Vec<usize>,
) -> Vec<FrontPlan> {
    let count = sizes.len();
    let mut graph = coupled.to_vec();
    for (group, neighbours) in graph.iter_mut().enumerate() {
        neighbours.remove(&group);
    }
    let mut left: BTreeSet<usize> = (0..count).collect();
    let mut fronts: Vec<FrontPlan> = Vec::new();
    let degree =
        |g: usize, graph: &[BTreeSet<usize>]| -> usize { graph[g].iter().map(|&n| sizes[n]).sum() };
    let mut degrees: Vec<usize> = (0..count).map(|g| degree(g, &graph)).collect();
    // Length of the longest way to each front from the leaves of the tree.
    let mut height = vec![0; count];
    while let Some(&next) = left
        .iter()
        .filter(|&&g| waiting[g] == 0)
        .min_by_key(|&&g| (degrees[g], height[g], g))
    {
        left.remove(&next);
        let boundary: Vec<usize> = graph[next].iter().copied().collect();
        for &a in &boundary {
            graph[a].remove(&next);
            graph[a].extend(boundary.iter().filter(|&&b| b != a));
            if coupled[a].contains(&next) && waiting[a] != NEVER {
                waiting[a] = waiting[a].saturating_sub(1);
            }
        }
        for &a in &boundary {
            degrees[a] = degree(a, &graph);
            height[a] = height[a].max(height[next] + 1);
        }
        fronts.push(FrontPlan {
            own: vec![next],
            boundary,
            children: Vec::new(),
            parent: None,
        });
    }
    fronts
}

/// Links fronts to their parents, the next of their boundary to be eliminated, and merges small
/// ones.
fn merge(sizes: &[usize], fronts: Vec<FrontPlan>) -> Vec<FrontPlan> {
    let mut step = vec![0; sizes.len()];
    for (i, front) in fronts.iter().enumerate() {
        step[front.own[0]] = i;
    }
    let parent: Vec<Option<usize>> = fronts
        .iter()
        .map(|f| f.boundary.iter().map(|&g| step[g]).min())
        .collect();
    let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
    // Front i is merged into its parent: `into[i]` leads there, transitively.
    let mut fronts = fronts;
    let mut merged = vec![false; fronts.len()];
    for i in 0..fronts.len() {
        let Some(p) = parent[i] else { continue };
        if size(&fronts[i].own) + size(&fronts[p].own) <= SMALLEST_FRONT {
            let own = std::mem::take(&mut fronts[i].own);
            fronts[p].own.splice(0..0, own);
            merged[i] = true;
        }
    }
    let survivor = |mut i: usize| {
        while merged[i] {
            match parent[i] {
                Some(p) => i = p,
                None => break,
            }
        }
        i
    };
    let mut number = vec![usize::MAX; fronts.len()];
    let mut kept = 0;
    for i in 0..fronts.len() {
        if !merged[i] {
            number[i] = kept;
            kept += 1;
        }
    }
    let links: Vec<Option<usize>> = (0..fronts.len())
        .map(|i| parent[i].map(|p| number[survivor(p)]))
        .collect();
    let mut result: Vec<FrontPlan> = Vec::with_capacity(kept);
    for (i, mut front) in fronts.into_iter().enumerate() {
        if !merged[i] {
            front.parent = links[i];
            result.push(front);
        }
    }
    link_children(&mut result);
    subtree_by_subtree(result)
}

/// Tells fronts of their children, in order.
fn link_children(fronts: &mut [FrontPlan]) {
    fronts.iter_mut().for_each(|front| front.children.clear());
    for i in 0..fronts.len() {
        if let Some(p) = fronts[i].parent {
            fronts[p].children.push(i);
        }
    }
}

/// The same fronts in an order in which all those that lead to one come just before it.
fn subtree_by_subtree(fronts: Vec<FrontPlan>) -> Vec<FrontPlan> {
    // Parents before children, and then backwards.
    let roots = (0..fronts.len()).filter(|&i| fronts[i].parent.is_none());
    let mut to_visit: Vec<usize> = roots.collect();
    let mut order = Vec::with_capacity(fronts.len());
    while let Some(i) = to_visit.pop() {
        order.push(i);
        to_visit.extend(&fronts[i].children);
    }
    order.reverse();
    let mut number = vec![0; fronts.len()];
    for (new, &old) in order.iter().enumerate() {
        number[old] = new;
    }
    let mut result: Vec<FrontPlan> = order.iter().map(|&old| fronts[old].clone()).collect();
    for front in &mut result {
        front.parent = front.parent.map(|p| number[p]);
    }
    link_children(&mut result);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_is_eliminated_once_and_boundaries_come_later() {
        // A chain of nine large groups, and two multipliers that close it.
        let mut coupled = vec![BTreeSet::new(); 11];
        let mut couple = |a: usize, b: usize| {
            coupled[a].insert(b);
            coupled[b].insert(a);
        };
        for i in 0..8 {
            couple(i, i + 1);
        }
        couple(9, 0);
        couple(10, 8);
        couple(10, 0);
        for unit in [1, 60] {
            let fronts = plan(&[unit; 11], &coupled, 9);
            let mut order = Vec::new();
            // Fronts that lead to each, itself among them: the ones just before it.
            let mut leading = vec![1; fronts.len()];
            for (i, front) in fronts.iter().enumerate() {
                assert!(front.parent.is_none_or(|p| p > i));
                for &child in &front.children {
                    assert_eq!(fronts[child].parent, Some(i));
                    leading[i] += leading[child];
                }
                let first = i + 1 - leading[i];
                let inside = |f: usize| (first..=i).contains(&f);
                assert!((first..i).all(|f| fronts[f].parent.is_some_and(inside)));
                assert!(front.boundary.iter().all(|b| !order.contains(b)));
                order.extend(&front.own);
            }
            let mut all = order.clone();
            all.sort_unstable();
            assert_eq!(all, (0..11).collect::<Vec<_>>());
            let place = |g: usize| order.iter().position(|&x| x == g).unwrap();
            assert!(place(9) > place(0) && place(10) > place(8) && place(10) > place(0));
        }
    }
}
