//! Order in which the direct solver eliminates nodes and multipliers, and the fronts that follow.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

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
/// The same where entries that are zero cost more, and the part of these that a larger front may
/// have.
const SMALL_FRONT: usize = 24;
const MOST_ZEROS: f64 = 0.1;

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
    plan_with_late(sizes, coupled, first_multiplier, &[])
}

/// The same where some groups, if any, come late: when of the others none is left that need not
/// wait for them.
pub(crate) fn plan_with_late(
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    first_multiplier: usize,
    late: &[usize],
) -> Vec<FrontPlan> {
    let waiting = coupled.iter().enumerate().map(|(g, neighbours)| {
        if g < first_multiplier {
            0
        } else {
            neighbours.iter().filter(|&&n| n != g).count()
        }
    });
    let order = elimination_with_late(sizes, coupled, waiting.collect(), late);
    merge(sizes, order, |joined| joined.own <= SMALLEST_FRONT)
}

/// Fronts that hardly have more entries than the elimination of one group after the other in this
/// `order`, in which some groups may be left.
pub(crate) fn joined_fronts(sizes: &[usize], order: Vec<FrontPlan>) -> Vec<FrontPlan> {
    merge(sizes, order, |joined| {
        let zeros = joined.zeros as f64;
        joined.own <= SMALL_FRONT || zeros <= MOST_ZEROS * joined.entries as f64
    })
}

/// Weight of what comes late: elimination is to go there, not to begin beside it.
const LATE: usize = 4;

/// Has a group wait for ever.
pub(crate) const NEVER: usize = usize::MAX;

/// The order of elimination, one group in each front, not linked. Each group waits until so many of
/// those that it is coupled to are eliminated.
pub(crate) fn elimination(
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    waiting: Vec<usize>,
) -> Vec<FrontPlan> {
    elimination_with_late(sizes, coupled, waiting, &[])
}

fn elimination_with_late(
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    mut waiting: Vec<usize>,
    late: &[usize],
) -> Vec<FrontPlan> {
    let mut is_late = vec![false; sizes.len()];
    let mut weights = sizes.to_vec();
    for &g in late {
        (is_late[g], weights[g]) = (true, LATE * sizes[g]);
    }
    // Of equals the one farthest from what comes late, if anything does.
    let far: Vec<_> = distances(coupled, late).into_iter().map(Reverse).collect();
    let mut graph = QuotientGraph::new(&weights, coupled);
    // Length of the longest way to each front from the leaves of the tree.
    let mut height = vec![0; sizes.len()];
    // Those that do not wait, least first; what has changed since it was put here is there again.
    let ready = (0..sizes.len()).filter(|&g| waiting[g] == 0);
    let mut queue: BinaryHeap<_> = ready
        .map(|g| Reverse((is_late[g], graph.degrees[g], far[g], height[g], g)))
        .collect();
    let mut fronts: Vec<FrontPlan> = Vec::new();
    while let Some(Reverse((_, degree, _, high, next))) = queue.pop() {
        if graph.eliminated[next] || (degree, high) != (graph.degrees[next], height[next]) {
            continue;
        }
        let boundary = graph.eliminate(next);
        for &a in &boundary {
            if waiting[a] != NEVER && coupled[a].contains(&next) {
                waiting[a] = waiting[a].saturating_sub(1);
            }
            height[a] = height[a].max(high + 1);
            if waiting[a] == 0 {
                queue.push(Reverse((
                    is_late[a],
                    graph.degrees[a],
                    far[a],
                    height[a],
                    a,
                )));
            }
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

/// Couplings from some groups to each; 0 too where none lead there.
fn distances(coupled: &[BTreeSet<usize>], from: &[usize]) -> Vec<usize> {
    let mut distances = vec![0; coupled.len()];
    let mut met = vec![false; coupled.len()];
    let mut reached = from.to_vec();
    reached.iter().for_each(|&g| met[g] = true);
    let mut next = 0;
    while let Some(&group) = reached.get(next) {
        next += 1;
        for &other in &coupled[group] {
            if !std::mem::replace(&mut met[other], true) {
                distances[other] = distances[group] + 1;
                reached.push(other);
            }
        }
    }
    distances
}

/// Which groups are coupled with each other as elimination goes on: those that were at first, and
/// all those of the boundary of an eliminated one, told by the list of these.
struct QuotientGraph<'a> {
    sizes: &'a [usize],
    /// Of each group: others that it was coupled with at first, unless they share a boundary.
    others: Vec<Vec<usize>>,
    /// Of each group: the eliminated ones in whose boundaries it is.
    boundaries_with: Vec<Vec<usize>>,
    /// Boundaries of eliminated groups, as far as they are not part of later ones.
    boundaries: Vec<Vec<usize>>,
    eliminated: Vec<bool>,
    /// Unknowns of all that each group is coupled with.
    degrees: Vec<usize>,
    /// Of each group: when it was met last.
    met: Vec<usize>,
    now: usize,
}

impl<'a> QuotientGraph<'a> {
    fn new(sizes: &'a [usize], coupled: &[BTreeSet<usize>]) -> Self {
        let others = coupled.iter().enumerate().map(|(group, neighbours)| {
            let others = neighbours.iter().copied();
            others.filter(|&n| n != group).collect::<Vec<_>>()
        });
        let others: Vec<_> = others.collect();
        let degree = |others: &Vec<usize>| others.iter().map(|&n| sizes[n]).sum();
        QuotientGraph {
            degrees: others.iter().map(degree).collect(),
            others,
            boundaries_with: vec![Vec::new(); sizes.len()],
            boundaries: vec![Vec::new(); sizes.len()],
            eliminated: vec![false; sizes.len()],
            met: vec![0; sizes.len()],
            now: 0,
            sizes,
        }
    }

    /// All that a group is coupled with, in no order; none twice.
    fn neighbours(&mut self, group: usize, mut visit: impl FnMut(usize)) {
        self.now += 1;
        self.met[group] = self.now;
        let lists = self.boundaries_with[group].iter();
        let boundaries = &self.boundaries;
        let lists = lists.map(|&b| &boundaries[b]);
        let (met, eliminated, now) = (&mut self.met, &self.eliminated, self.now);
        for &n in lists.chain([&self.others[group]]).flatten() {
            if !eliminated[n] && met[n] != now {
                met[n] = now;
                visit(n);
            }
        }
    }

    /// Eliminates a group; what it was coupled with, in ascending order.
    fn eliminate(&mut self, group: usize) -> Vec<usize> {
        let mut boundary = Vec::new();
        self.neighbours(group, |n| boundary.push(n));
        boundary.sort_unstable();
        self.eliminated[group] = true;
        self.others[group] = Vec::new();
        // Parts of the new boundary.
        for part in std::mem::take(&mut self.boundaries_with[group]) {
            self.boundaries[part] = Vec::new();
        }
        // The group and its boundary are those met now.
        for &a in &boundary {
            let (met, now) = (&self.met, self.now);
            self.others[a].retain(|&n| met[n] != now);
            let boundaries = &self.boundaries;
            self.boundaries_with[a].retain(|&b| !boundaries[b].is_empty());
            self.boundaries_with[a].push(group);
        }
        self.boundaries[group] = boundary.clone();
        for &a in &boundary {
            let (mut degree, sizes) = (0, self.sizes);
            self.neighbours(a, |n| degree += sizes[n]);
            self.degrees[a] = degree;
        }
        boundary
    }
}

/// What a front and its parent are as one.
struct Joined {
    /// Unknowns that are eliminated.
    own: usize,
    /// Entries of the factors.
    entries: usize,
    /// How many of them would not be there if groups were eliminated one by one.
    zeros: usize,
}

/// Links fronts to their parents, the next of their boundary to be eliminated, and merges those
/// that are to be `joined`.
fn merge(
    sizes: &[usize],
    fronts: Vec<FrontPlan>,
    joined: impl Fn(Joined) -> bool,
) -> Vec<FrontPlan> {
    let mut step = vec![usize::MAX; sizes.len()];
    for (i, front) in fronts.iter().enumerate() {
        step[front.own[0]] = i;
    }
    // What is left is never eliminated.
    let next = |front: &FrontPlan| front.boundary.iter().map(|&g| step[g]).min();
    let parent: Vec<Option<usize>> = fronts
        .iter()
        .map(|front| next(front).filter(|&step| step != usize::MAX))
        .collect();
    let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
    let entries = |own: usize, boundary: &[usize]| own * (own + 2 * size(boundary));
    let mut fronts = fronts;
    let mut own: Vec<usize> = fronts.iter().map(|front| size(&front.own)).collect();
    let mut zeros = vec![0; fronts.len()];
    let mut merged = vec![false; fronts.len()];
    for i in 0..fronts.len() {
        let Some(p) = parent[i] else { continue };
        let both = [i, p].map(|f| entries(own[f], &fronts[f].boundary));
        let all = entries(own[i] + own[p], &fronts[p].boundary);
        let new = Joined {
            own: own[i] + own[p],
            entries: all,
            zeros: (all + zeros[i] + zeros[p]).saturating_sub(both[0] + both[1]),
        };
        let (count, more) = (new.own, new.zeros);
        if joined(new) {
            let groups = std::mem::take(&mut fronts[i].own);
            fronts[p].own.splice(0..0, groups);
            (own[p], zeros[p], merged[i]) = (count, more, true);
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

/// Adds a group that is coupled with all others, to be eliminated last: in the front that comes
/// last of all, if there is one that does, or else in one of its own.
pub(crate) fn with_last(mut fronts: Vec<FrontPlan>, group: usize) -> Vec<FrontPlan> {
    let mut last = FrontPlan {
        own: vec![group],
        boundary: Vec::new(),
        children: Vec::new(),
        parent: None,
    };
    let is_root = |front: &FrontPlan| front.parent.is_none();
    if fronts.iter().filter(|front| is_root(front)).count() == 1
        && let Some(root) = fronts.pop_if(|front| is_root(front))
    {
        last.own = root.own;
        last.own.push(group);
    }
    let parent = fronts.len();
    for front in &mut fronts {
        front.parent = front.parent.or(Some(parent));
        front.boundary.push(group);
    }
    fronts.push(last);
    link_children(&mut fronts);
    fronts
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

    /// The order by its definition, with all couplings that elimination makes.
    fn by_definition(
        sizes: &[usize],
        coupled: &[BTreeSet<usize>],
        mut waiting: Vec<usize>,
    ) -> Vec<(usize, Vec<usize>)> {
        let mut graph = coupled.to_vec();
        for (group, neighbours) in graph.iter_mut().enumerate() {
            neighbours.remove(&group);
        }
        let mut left: BTreeSet<usize> = (0..sizes.len()).collect();
        let mut height = vec![0; sizes.len()];
        let mut order = Vec::new();
        loop {
            let degree = |g: usize| graph[g].iter().map(|&n| sizes[n]).sum::<usize>();
            let ready = left.iter().copied().filter(|&g| waiting[g] == 0);
            let Some(next) = ready.min_by_key(|&g| (degree(g), height[g], g)) else {
                return order;
            };
            left.remove(&next);
            let boundary: Vec<usize> = graph[next].iter().copied().collect();
            for &a in &boundary {
                graph[a].remove(&next);
                graph[a].extend(boundary.iter().filter(|&&b| b != a));
                height[a] = height[a].max(height[next] + 1);
                if coupled[a].contains(&next) && waiting[a] != NEVER {
                    waiting[a] = waiting[a].saturating_sub(1);
                }
            }
            order.push((next, boundary));
        }
    }

    #[test]
    fn elimination_is_that_of_the_least_degree() {
        let mut last = 1u64;
        let mut random = |below: usize| {
            last = last
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (last >> 33) as usize % below
        };
        for case in 0..300 {
            let count = 1 + random(30);
            let mut coupled = vec![BTreeSet::new(); count];
            for _ in 0..random(3 * count) {
                let (a, b) = (random(count), random(count));
                coupled[a].insert(b);
                coupled[b].insert(a);
            }
            let sizes: Vec<usize> = (0..count).map(|_| [1, 3, 6, 6, 12][random(5)]).collect();
            let others = |g: usize| coupled[g].iter().filter(|&&n| n != g).count();
            let waiting: Vec<usize> = (0..count)
                .map(|g| match random(5) {
                    0 => others(g),
                    1 if case % 2 == 0 => NEVER,
                    _ => 0,
                })
                .collect();
            let found = elimination(&sizes, &coupled, waiting.clone());
            let found = found
                .into_iter()
                .map(|front| (front.own[0], front.boundary));
            let found: Vec<_> = found.collect();
            assert_eq!(found, by_definition(&sizes, &coupled, waiting), "{case}");
        }
    }

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
