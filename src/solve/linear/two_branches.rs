//! An order of elimination for several threads: minimum degree may go along a chain of bodies from
//! one end to the other, each front waiting for the one before; from both ends it is two branches.
//! See docs/theory.md, section 8.1.

use crate::solve::linear::front::{LARGE_FRONT, elimination_work};
use crate::solve::linear::ordering::{FrontPlan, plan, plan_with_late};
use std::collections::BTreeSet;

/// Parts of the work after which it is tried to leave what follows to another branch.
const PARTS: [f64; 3] = [0.4, 0.5, 0.6];
/// Work that is waited for, relative to that of the order of minimum degree, that is worth another;
const SHORTER: f64 = 0.75;
/// and all work at most.
const MORE: f64 = 1.15;

/// Plans the elimination as [`plan`] does, for one thread, or for several.
pub(crate) fn plan_for(
    threads: usize,
    sizes: &[usize],
    coupled: &[BTreeSet<usize>],
    first_multiplier: usize,
) -> Vec<FrontPlan> {
    let plain = plan(sizes, coupled, first_multiplier);
    let work = Work::of(&plain, sizes);
    if threads < 2 || work.all < LARGE_FRONT {
        return plain;
    }
    let mut best = None;
    let mut least = SHORTER * work.waited_for();
    for part in PARTS {
        let Some(front) = work.front_after(part * work.all, &plain) else {
            continue;
        };
        // What parts the fronts that lead there from all others.
        let late = &plain[front].boundary;
        let other = plan_with_late(sizes, coupled, first_multiplier, late);
        let of_other = Work::of(&other, sizes);
        if of_other.waited_for() < least && of_other.all <= MORE * work.all {
            least = of_other.waited_for();
            best = Some(other);
        }
    }
    best.unwrap_or(plain)
}

/// Multiply-adds of fronts.
struct Work {
    /// Of each with all that lead to it.
    subtrees: Vec<f64>,
    /// Of all.
    all: f64,
    /// On the longest way from a leaf to a root.
    longest: f64,
}

impl Work {
    fn of(fronts: &[FrontPlan], sizes: &[usize]) -> Self {
        let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
        let (mut subtrees, mut ways) = (Vec::new(), Vec::<f64>::new());
        let (mut all, mut longest) = (0.0, 0.0f64);
        for front in fronts {
            let own = elimination_work(size(&front.own), size(&front.boundary));
            let (subtree, way) = front
                .children
                .iter()
                .fold((0.0, 0.0), |(sum, way), &child| {
                    (sum + subtrees[child], f64::max(way, ways[child]))
                });
            subtrees.push(own + subtree);
            ways.push(own + way);
            all += own;
            longest = longest.max(own + way);
        }
        Work {
            subtrees,
            all,
            longest,
        }
    }

    /// What two threads wait for, if no front is shared.
    fn waited_for(&self) -> f64 {
        self.longest.max(self.all / 2.0)
    }

    /// The last front on the way of most work that has no more than this work, itself included;
    /// none if that is a leaf, or leaves nothing.
    fn front_after(&self, work: f64, fronts: &[FrontPlan]) -> Option<usize> {
        let more = |&a: &usize, &b: &usize| self.subtrees[a].total_cmp(&self.subtrees[b]);
        let roots = (0..fronts.len()).filter(|&f| fronts[f].parent.is_none());
        let mut front = roots.max_by(more)?;
        while self.subtrees[front] > work {
            front = fronts[front].children.iter().copied().max_by(more)?;
        }
        (!fronts[front].boundary.is_empty()).then_some(front)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of so many groups, with multipliers of this size at either end.
    fn chain(count: usize, multipliers: usize) -> (Vec<usize>, Vec<BTreeSet<usize>>) {
        let mut coupled = vec![BTreeSet::new(); count + 2];
        let mut couple = |a: usize, b: usize| {
            coupled[a].insert(b);
            coupled[b].insert(a);
        };
        (1..count).for_each(|i| couple(i - 1, i));
        couple(0, count);
        couple(count - 1, count + 1);
        let mut sizes = vec![300; count];
        sizes.extend([multipliers; 2]);
        (sizes, coupled)
    }

    #[test]
    fn a_chain_is_divided_for_several_threads_alone() {
        // With 300 an end is coupled with as much as any other group.
        for multipliers in [250, 300] {
            is_divided(multipliers);
        }
    }

    fn is_divided(multipliers: usize) {
        let (sizes, coupled) = chain(30, multipliers);
        let [one, two] = [1, 2].map(|threads| plan_for(threads, &sizes, &coupled, 30));
        let [by_one, by_two] = [&one, &two].map(|fronts| Work::of(fronts, &sizes));
        let one_after_the_other = plan(&sizes, &coupled, 30);
        assert_eq!(by_one.all, Work::of(&one_after_the_other, &sizes).all);
        assert!(by_one.longest > 0.9 * by_one.all);
        assert!(by_two.longest < 0.65 * by_one.longest && by_two.all < MORE * by_one.all);
        let mut all: Vec<usize> = two.iter().flat_map(|front| front.own.clone()).collect();
        all.sort_unstable();
        assert_eq!(all, (0..32).collect::<Vec<_>>());
        // Multipliers come behind what they hold.
        let order: Vec<usize> = two.iter().flat_map(|front| front.own.clone()).collect();
        let place = |group: usize| order.iter().position(|&g| g == group);
        assert!(place(30) > place(0) && place(31) > place(29));
    }

    #[test]
    fn small_matrices_and_trees_that_branch_are_left_as_they_are() {
        let (sizes, coupled) = chain(5, 250);
        let small: Vec<usize> = sizes.iter().map(|size| size / 10).collect();
        let own = |fronts: &[FrontPlan]| -> Vec<Vec<usize>> {
            fronts.iter().map(|front| front.own.clone()).collect()
        };
        let plain = plan(&small, &coupled, 5);
        assert_eq!(own(&plan_for(2, &small, &coupled, 5)), own(&plain));
        // Without multipliers both ends of a chain are of least degree.
        let (mut sizes, mut coupled) = chain(30, 250);
        sizes.truncate(30);
        coupled.truncate(30);
        coupled
            .iter_mut()
            .for_each(|others| others.retain(|&g| g < 30));
        let plain = plan(&sizes, &coupled, 30);
        assert_eq!(own(&plan_for(2, &sizes, &coupled, 30)), own(&plain));
    }
}
