//! Forward and backward substitution: of several threads each takes subtrees of the fronts, and
//! all share what these lead to.

use super::DirectSolver;
use crate::solve::linear::ordering::FrontPlan;
use crate::solve::linear::triangles::{solve_unit_lower, solve_upper, subtract_product};
use crate::work::SUBSTITUTION;
use crate::workers::{Workers, parts};
use std::ops::Range;

/// Most subtrees that fronts are divided into.
const SUBTREES: usize = 16;
/// What it takes threads that share rows to meet, as a factor of what they read.
const MEETING: f64 = 1.3;
/// Columns of a triangle after which the rows beyond are shared.
const BLOCK: usize = 256;

/// What threads go through one each, the largest first, and what together, in order.
#[derive(Debug)]
pub(super) struct Division {
    subtrees: Vec<Range<usize>>,
    above: Vec<usize>,
}

/// A subtree of fronts, with a right side of its own.
struct Subtree {
    fronts: Range<usize>,
    rhs: Vec<f64>,
    reduced: Vec<f64>,
}

impl DirectSolver {
    /// Solves in place. `false` if there are no factors or the result is not finite.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        self.factored && self.in_order(rhs, |rhs| self.substitute(rhs))
    }

    /// The same for unknowns in the order of the groups that are eliminated.
    fn substitute(&self, rhs: &mut [f64]) -> bool {
        let read = self.size_of_factors();
        self.workers.work().spend(SUBSTITUTION * read as f64);
        let workers = for_reading(&self.workers, read);
        if workers.threads() > 1 {
            let division = self.division.get_or_init(|| self.divided(&workers));
            self.solve_shared(rhs, division, &workers);
        } else {
            let mut reduced = Vec::with_capacity(rhs.len());
            self.forward(0..self.fronts.len(), rhs, &mut reduced, &workers);
            self.backward((0..self.fronts.len()).rev(), rhs, &mut reduced, &workers);
        }
        rhs.iter().all(|x| x.is_finite())
    }

    pub(super) fn solve_shared(&self, rhs: &mut [f64], division: &Division, workers: &Workers) {
        let above = &division.above;
        let subtree = |fronts: &Range<usize>| Subtree {
            fronts: fronts.clone(),
            rhs: Vec::new(),
            reduced: Vec::new(),
        };
        let mut subtrees: Vec<_> = division.subtrees.iter().map(subtree).collect();
        let alone = workers.alone();
        let all = &*rhs;
        workers.each(&mut subtrees, |_, subtree| {
            subtree.rhs.extend_from_slice(all);
            // What it adds to the equations of fronts above.
            for &g in self.boundary(subtree) {
                subtree.rhs[self.analysis.groups[g].clone()].fill(0.0);
            }
            let Subtree {
                fronts,
                rhs,
                reduced,
            } = subtree;
            self.forward(fronts.clone(), rhs, reduced, &alone);
        });
        for subtree in &subtrees {
            for &g in self.boundary(subtree) {
                let group = self.analysis.groups[g].clone();
                let added = rhs[group.clone()].iter_mut().zip(&subtree.rhs[group]);
                added.for_each(|(to, x)| *to += x);
            }
            for &row in &self.fronts[subtree.fronts.end - 1].delayed_rows {
                rhs[row] = subtree.rhs[row];
            }
        }
        let mut reduced = Vec::new();
        self.forward(above.iter().copied(), rhs, &mut reduced, workers);
        self.backward(above.iter().rev().copied(), rhs, &mut reduced, workers);
        let all = &*rhs;
        workers.each(&mut subtrees, |_, subtree| {
            for &g in self.boundary(subtree) {
                let group = self.analysis.groups[g].clone();
                subtree.rhs[group.clone()].copy_from_slice(&all[group]);
            }
            for &column in &self.fronts[subtree.fronts.end - 1].delayed_columns {
                subtree.rhs[column] = all[column];
            }
            let Subtree {
                fronts,
                rhs,
                reduced,
            } = subtree;
            self.backward(fronts.clone().rev(), rhs, reduced, &alone);
        });
        for subtree in &subtrees {
            for front in &self.fronts[subtree.fronts.clone()] {
                for &column in &front.columns {
                    rhs[column] = subtree.rhs[column];
                }
            }
        }
    }

    /// Groups of unknowns that a subtree leaves to fronts above.
    fn boundary(&self, subtree: &Subtree) -> &[usize] {
        &self.analysis.plans[subtree.fronts.end - 1].boundary
    }

    /// What each thread takes of the present factors.
    pub(super) fn divided(&self, workers: &Workers) -> Division {
        let plans = &self.analysis.plans;
        let mut costs: Vec<Cost> = Vec::with_capacity(plans.len());
        for (front, plan) in self.fronts.iter().zip(plans) {
            let below = plan.children.iter().map(|&child| costs[child]);
            let own = Cost::of(front.rows.len(), front.left_over(), workers);
            costs.push(below.fold(own, Cost::sum));
        }
        let (roots, mut above) =
            divided((plans, &costs), &self.analysis.roots(), workers.threads());
        above.sort_unstable();
        let subtree = |root: usize| root + 1 - self.analysis.subtrees[root].1..root + 1;
        Division {
            subtrees: roots.into_iter().map(subtree).collect(),
            above,
        }
    }

    /// Forward substitution by some fronts, in order; writes what each front's equations come to,
    /// one front after the other.
    fn forward(
        &self,
        fronts: impl Iterator<Item = usize>,
        rhs: &mut [f64],
        reduced: &mut Vec<f64>,
        workers: &Workers,
    ) {
        let mut local = Vec::new();
        for f in fronts {
            // Whether work is to end is asked where it may fail.
            let _ = workers.pulse();
            let (plan, front) = (&self.analysis.plans[f], &self.fronts[f]);
            let first = reduced.len();
            reduced.extend(front.rows.iter().map(|&row| rhs[row]));
            let y = &mut reduced[first..];
            if is_zero(y) {
                continue;
            }
            let (upper, below) = (front.upper().each_column(), front.lower().each_column());
            lower(workers, upper, y);
            self.gather(&front.delayed_rows, &plan.boundary, rhs, &mut local);
            let (delayed, boundary) = local.split_at_mut(front.delayed_rows.len());
            subtract(workers, delayed, |j| &upper(j)[front.rows.len()..], y);
            subtract(workers, boundary, below, y);
            self.scatter(&front.delayed_rows, &plan.boundary, &local, rhs);
        }
    }

    /// Backward substitution by the same fronts, in reverse order.
    fn backward(
        &self,
        fronts: impl Iterator<Item = usize>,
        rhs: &mut [f64],
        reduced: &mut Vec<f64>,
        workers: &Workers,
    ) {
        let mut local = Vec::new();
        for f in fronts {
            let _ = workers.pulse();
            let (plan, front) = (&self.analysis.plans[f], &self.fronts[f]);
            let count = front.rows.len();
            let first = reduced.len() - count;
            let y = &mut reduced[first..];
            self.gather(&front.delayed_columns, &plan.boundary, rhs, &mut local);
            if !(is_zero(y) && is_zero(&local)) {
                let of_front = front.upper().each_column();
                subtract(workers, y, |j| of_front(count + j), &local);
                upper(workers, of_front, y);
            }
            for (&column, x) in front.columns.iter().zip(&*y) {
                rhs[column] = *x;
            }
            reduced.truncate(first);
        }
    }

    /// `y −= A x` over all panels of a matrix, rows shared among threads.
    pub(super) fn subtract_panels(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        let structure = &self.structure;
        let sizes = structure.groups.iter().map(ExactSizeIterator::len);
        let mut groups: Vec<_> = parts(y, sizes).collect();
        let workers = for_reading(&self.workers, values.len());
        workers.each(&mut groups, |g, y| {
            for &panel in &structure.rows[g] {
                let panel = &structure.panels[panel];
                let column = structure.groups[panel.column.0].start + panel.column.1;
                subtract_product(
                    &mut y[panel.row.1..][..panel.rows],
                    |j| &values[panel.value + j * panel.stride..][..panel.rows],
                    &x[column..][..panel.columns],
                );
            }
        });
    }
}

/// Whether there is nothing to do for a right side, as out of the plane of a planar motion.
fn is_zero(x: &[f64]) -> bool {
    x.iter().all(|x| *x == 0.0)
}

/// What it takes to go through fronts, by the numbers that are read.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cost {
    /// By one thread.
    alone: f64,
    /// By all, which share the rows of each front.
    together: f64,
}

impl Cost {
    /// Of a front with so many unknowns of its own, and others in their rows and columns.
    fn of(count: usize, others: usize, workers: &Workers) -> Self {
        let shared = |numbers: usize| match for_reading(workers, numbers).threads() {
            1 => numbers as f64,
            threads => MEETING * numbers as f64 / threads as f64,
        };
        let mut together = 2.0 * shared(count * others);
        for (start, end) in blocks(count) {
            let own = end - start;
            together += (own * own) as f64 + 2.0 * shared(own * (count - end));
        }
        Cost {
            alone: (count * (count + 2 * others)) as f64,
            together,
        }
    }

    fn sum(self, other: Cost) -> Self {
        Cost {
            alone: self.alone + other.alone,
            together: self.together + other.together,
        }
    }
}

/// Roots of subtrees that threads take one each, the largest first, and all other fronts, which
/// they go through together, in no order: as leaves them least to wait for. Where subtrees are
/// divided, it is the largest. `costs` are those of each front with all that lead to it.
fn divided(
    (plans, costs): (&[FrontPlan], &[Cost]),
    all: &[usize],
    threads: usize,
) -> (Vec<usize>, Vec<usize>) {
    let total: f64 = all.iter().map(|&root| costs[root].alone).sum();
    let (mut roots, mut above) = (all.to_vec(), Vec::new());
    let (mut best, mut least) = ((Vec::new(), Vec::new(), Vec::new()), f64::INFINITY);
    // What has been divided, by all threads.
    let mut divided = 0.0;
    loop {
        roots.sort_by(|&a, &b| costs[b].alone.total_cmp(&costs[a].alone).then(a.cmp(&b)));
        let mut left: f64 = roots.iter().map(|&root| costs[root].together).sum();
        let mut loads = vec![0.0f64; threads];
        for taken in 0..=roots.len() {
            let wait = divided + left + loads.iter().copied().fold(0.0, f64::max);
            if wait < least {
                least = wait;
                let (taken, others) = roots.split_at(taken);
                best = (taken.to_vec(), others.to_vec(), above.clone());
            }
            let Some(&next) = roots.get(taken) else { break };
            left -= costs[next].together;
            if let Some(load) = loads.iter_mut().min_by(|a, b| a.total_cmp(b)) {
                *load += costs[next].alone;
            }
        }
        let few = roots.len() < SUBTREES;
        let mut divisible = (0..roots.len()).filter(|&i| !plans[roots[i]].children.is_empty());
        let Some(largest) = divisible
            .next()
            .filter(|&i| few && costs[roots[i]].alone > total / SUBTREES as f64)
        else {
            break;
        };
        let root = roots.swap_remove(largest);
        let children = plans[root].children.iter();
        divided += children.fold(costs[root].together, |rest, &child| {
            rest - costs[child].together
        });
        roots.extend(&plans[root].children);
        above.push(root);
    }
    let (roots, mut others, mut above) = best;
    while let Some(front) = others.pop() {
        others.extend(&plans[front].children);
        above.push(front);
    }
    (roots, above)
}

/// These threads, if to read so many numbers is worth sharing among them, or one.
fn for_reading(workers: &Workers, numbers: usize) -> Workers {
    workers.for_work((SUBSTITUTION * numbers as f64) as usize)
}

/// Where parts of a triangle begin and end: beyond each its rows are shared.
fn blocks(count: usize) -> impl DoubleEndedIterator<Item = (usize, usize)> {
    let starts = (0..count).step_by(BLOCK);
    starts.map(move |start| (start, (start + BLOCK).min(count)))
}

/// `y −= A x`, for the matrix with these columns, rows shared among threads.
fn subtract<'a>(
    workers: &Workers,
    y: &mut [f64],
    column: impl Fn(usize) -> &'a [f64] + Sync,
    x: &[f64],
) {
    let workers = for_reading(workers, y.len() * x.len());
    if workers.threads() == 1 {
        return subtract_product(y, column, x);
    }
    let length = y.len().div_ceil(workers.threads());
    let mut parts: Vec<_> = y.chunks_mut(length).collect();
    workers.each(&mut parts, |i, part| {
        subtract_product(part, |j| &column(j)[i * length..], x);
    });
}

/// `y ← L⁻¹ y`, for the unit lower triangle below the diagonal of the matrix with these columns.
fn lower<'a>(workers: &Workers, column: impl Fn(usize) -> &'a [f64] + Sync, y: &mut [f64]) {
    let count = y.len();
    if workers.threads() == 1 {
        return solve_unit_lower(column, y);
    }
    for (start, end) in blocks(count) {
        let (found, rest) = y.split_at_mut(end);
        let found = &mut found[start..];
        solve_unit_lower(|j| &column(start + j)[start..end], found);
        subtract(workers, rest, |j| &column(start + j)[end..count], found);
    }
}

/// `y ← U⁻¹ y`, for the upper triangle of the matrix with these columns.
fn upper<'a>(workers: &Workers, column: impl Fn(usize) -> &'a [f64] + Sync, y: &mut [f64]) {
    if workers.threads() == 1 {
        return solve_upper(column, y);
    }
    for (start, end) in blocks(y.len()).rev() {
        let (rest, found) = y.split_at_mut(start);
        let found = &mut found[..end - start];
        solve_upper(|j| &column(start + j)[start..end], found);
        subtract(workers, rest, |j| &column(start + j)[..start], found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::linear::dense::largest;

    #[test]
    fn triangles_are_the_same_by_several_threads() {
        let count = 1500;
        let entry = |i: usize, j: usize| {
            let off = (1.3 * i as f64 - 0.7 * j as f64).cos() / count as f64;
            off + f64::from(i == j)
        };
        let columns: Vec<Vec<f64>> = (0..count)
            .map(|j| (0..count).map(|i| entry(i, j)).collect())
            .collect();
        let rhs: Vec<f64> = (0..count).map(|i| (0.3 * i as f64).sin() + 0.5).collect();
        let workers = Workers::new(3).unwrap();
        let by = |workers: &Workers| {
            let (mut below, mut above) = (rhs.clone(), rhs.clone());
            lower(workers, |j| &columns[j], &mut below);
            upper(workers, |j| &columns[j], &mut above);
            [below, above]
        };
        for (alone, shared) in by(&workers.alone()).iter().zip(&by(&workers)) {
            let off: Vec<f64> = alone.iter().zip(shared).map(|(a, b)| a - b).collect();
            assert!(largest(&off) < 1e-13 * largest(alone));
        }
    }

    /// Chains of so many fronts, each with two small ones before its first, and a last front that
    /// all lead to.
    fn chains(chains: usize, count: usize, shared: f64) -> (Vec<FrontPlan>, Vec<Cost>, Vec<usize>) {
        let mut plans: Vec<FrontPlan> = Vec::new();
        let mut costs: Vec<Cost> = Vec::new();
        let mut add = |children: &[usize], own: f64| {
            let own = Cost {
                alone: own,
                together: shared * own,
            };
            costs.push(
                children
                    .iter()
                    .fold(own, |sum, &child| sum.sum(costs[child])),
            );
            plans.push(FrontPlan {
                own: Vec::new(),
                boundary: Vec::new(),
                children: children.to_vec(),
                parent: None,
            });
            plans.len() - 1
        };
        let mut chain = || {
            let leaves = [add(&[], 1.0), add(&[], 1.0)];
            (0..count).fold(add(&leaves, 100.0), |last, _| add(&[last], 100.0))
        };
        let ends: Vec<usize> = (0..chains).map(|_| chain()).collect();
        add(&ends, 100.0);
        (plans, costs, ends)
    }

    #[test]
    fn chains_are_divided_where_they_meet_and_no_farther() {
        let (plans, costs, ends) = chains(2, 40, 1.0);
        let last = plans.len() - 1;
        for threads in [2, 4] {
            let (roots, above) = divided((&plans, &costs), &[last], threads);
            assert_eq!((&roots[..], &above[..]), (&ends[..], &[last][..]));
        }
    }

    #[test]
    fn two_threads_share_what_is_left_of_three_chains() {
        let (plans, costs, ends) = chains(3, 40, 0.5 * MEETING);
        let last = plans.len() - 1;
        let (roots, mut above) = divided((&plans, &costs), &[last], 2);
        above.sort_unstable();
        assert_eq!(roots, ends[..2]);
        let third: Vec<usize> = (ends[1] + 1..=last).collect();
        assert_eq!(above, third);
        // By three there is nothing left.
        let (roots, above) = divided((&plans, &costs), &[last], 3);
        assert_eq!((&roots[..], &above[..]), (&ends[..], &[last][..]));
    }
}
