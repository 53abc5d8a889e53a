//! How long factorisations take that several workers share, counted in multiply-adds.

use crate::solve::linear::front::{LARGE_FRONT, elimination_work};
use crate::solve::linear::ordering::FrontPlan;

/// What is done in one piece: a front, or a subtree of small ones.
struct Task {
    left: f64,
    /// Whether several workers may share it.
    is_shared: bool,
    /// The front that it leads to.
    parent: Option<usize>,
    /// Tasks that lead to it, and are not done.
    waits_for: usize,
}

/// Multiply-adds, one after the other, of a factorisation by so many workers: fronts wait for those
/// that lead to them, small subtrees are not divided, and large fronts are shared by all who have
/// nothing else to do.
pub(super) fn path(plans: &[FrontPlan], size: impl Fn(&[usize]) -> usize, workers: usize) -> f64 {
    let mut tasks = tasks(plans, size);
    let mut ready: Vec<usize> = (0..tasks.len())
        .filter(|&f| tasks[f].left > 0.0 && tasks[f].waits_for == 0)
        .collect();
    let workers = workers as f64;
    let mut time = 0.0;
    while !ready.is_empty() {
        let whole = ready.iter().filter(|&&f| !tasks[f].is_shared).count() as f64;
        let shared = ready.len() as f64 - whole;
        let whole_rate = (workers / whole.max(1.0)).min(1.0);
        let shared_rate = match workers > whole {
            true => (workers - whole) / shared.max(1.0),
            false => 0.0,
        };
        let rate = |task: &Task| match task.is_shared {
            true => shared_rate,
            false => whole_rate,
        };
        let times = ready.iter().map(|&f| tasks[f].left / rate(&tasks[f]));
        let step = times.fold(f64::INFINITY, f64::min);
        time += step;
        let mut next = Vec::new();
        for f in ready {
            let done = step * rate(&tasks[f]);
            // The last leaves rounding.
            if tasks[f].left > done * (1.0 + 1e-9) {
                tasks[f].left -= done;
                next.push(f);
                continue;
            }
            let Some(parent) = tasks[f].parent else {
                continue;
            };
            tasks[parent].waits_for -= 1;
            if tasks[parent].waits_for == 0 {
                next.push(parent);
            }
        }
        ready = next;
    }
    time
}

/// What is done in one piece, at the places of its last fronts; nothing at those of others.
fn tasks(plans: &[FrontPlan], size: impl Fn(&[usize]) -> usize) -> Vec<Task> {
    let own: Vec<f64> = plans
        .iter()
        .map(|plan| elimination_work(size(&plan.own), size(&plan.boundary)))
        .collect();
    let mut subtrees = own.clone();
    for (f, plan) in plans.iter().enumerate() {
        subtrees[f] += plan.children.iter().map(|&c| subtrees[c]).sum::<f64>();
    }
    let is_small = |f: usize| subtrees[f] <= LARGE_FRONT;
    let all = plans.iter().enumerate().map(|(f, plan)| {
        let inside = is_small(f) && plan.parent.is_some_and(is_small);
        Task {
            left: match (inside, is_small(f)) {
                (true, _) => 0.0,
                (false, true) => subtrees[f],
                (false, false) => own[f],
            },
            is_shared: own[f] >= LARGE_FRONT,
            parent: plan.parent,
            waits_for: if is_small(f) { 0 } else { plan.children.len() },
        }
    });
    all.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front(own: usize, boundary: usize, children: &[usize], parent: Option<usize>) -> FrontPlan {
        FrontPlan {
            own: vec![own],
            boundary: vec![boundary],
            children: children.to_vec(),
            parent,
        }
    }

    /// Two branches of one large front each, which lead to a third.
    #[test]
    fn branches_side_by_side_and_what_they_lead_to() {
        let plans = [
            front(600, 300, &[], Some(2)),
            front(600, 300, &[], Some(2)),
            front(300, 0, &[0, 1], None),
        ];
        let size = |groups: &[usize]| groups.iter().sum();
        let all = 2.0 * elimination_work(600, 300) + elimination_work(300, 0);
        let by = |workers: usize| path(&plans, size, workers);
        assert!((by(1) / all - 1.0).abs() < 1e-9);
        // The last front is small, and not divided.
        let last = elimination_work(300, 0);
        assert!(last < LARGE_FRONT);
        for workers in [2, 4] {
            let expected = (all - last) / workers as f64 + last;
            assert!((by(workers) / expected - 1.0).abs() < 1e-9);
        }
    }

    /// Of small branches no more than there are are worked on at a time.
    #[test]
    fn small_subtrees_are_not_divided() {
        let plans = [
            front(200, 100, &[], Some(3)),
            front(200, 100, &[], Some(3)),
            front(200, 100, &[], Some(3)),
            front(300, 0, &[0, 1, 2], None),
        ];
        let size = |groups: &[usize]| groups.iter().sum();
        let (branch, last) = (elimination_work(200, 100), elimination_work(300, 0));
        assert!(3.0 * branch + last > LARGE_FRONT);
        assert!((path(&plans, size, 8) / (branch + last) - 1.0).abs() < 1e-9);
    }
}
