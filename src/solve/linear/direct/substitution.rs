//! Forward and backward substitution: of several threads each takes subtrees of the fronts, and
//! all share what these lead to.

use super::DirectSolver;
use crate::collocation::Panel;
use crate::solve::linear::dense::{solve_unit_lower, solve_upper, subtract_product};
use crate::solve::linear::ordering::FrontPlan;
use crate::work::SUBSTITUTION;
use crate::workers::Workers;
use std::ops::Range;

/// Most subtrees that fronts are divided into.
const SUBTREES: usize = 16;
/// Columns of a triangle after which the rows beyond are shared.
const BLOCK: usize = 256;

/// A subtree of fronts, with a right side of its own.
struct Subtree {
    fronts: Range<usize>,
    rhs: Vec<f64>,
    reduced: Vec<f64>,
}

impl DirectSolver {
    /// Solves in place. `false` if there are no factors or the result is not finite.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        if !self.factored {
            return false;
        }
        let read = self.size_of_factors();
        self.workers.work().spend(SUBSTITUTION * read as f64);
        let workers = self.workers.for_work(read);
        if workers.threads() > 1 {
            self.solve_shared(rhs, &workers);
        } else {
            let mut reduced = Vec::with_capacity(rhs.len());
            self.forward(0..self.fronts.len(), rhs, &mut reduced, &workers);
            self.backward((0..self.fronts.len()).rev(), rhs, &mut reduced, &workers);
        }
        rhs.iter().all(|x| x.is_finite())
    }

    pub(super) fn solve_shared(&self, rhs: &mut [f64], workers: &Workers) {
        let (mut subtrees, above) = self.divided(workers.threads());
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

    /// Subtrees that so many threads share, and the fronts that they lead to, in order.
    fn divided(&self, threads: usize) -> (Vec<Subtree>, Vec<usize>) {
        let plans = &self.analysis.plans;
        let mut numbers: Vec<usize> = Vec::with_capacity(plans.len());
        for (front, plan) in self.fronts.iter().zip(plans) {
            let below: usize = plan.children.iter().map(|&child| numbers[child]).sum();
            numbers.push(below + front.numbers());
        }
        let (mut roots, mut above) = divided((plans, &numbers), &self.analysis.roots(), threads);
        roots.sort_unstable();
        above.sort_unstable();
        let subtree = |root: usize| Subtree {
            fronts: root + 1 - self.analysis.subtrees[root].1..root + 1,
            rhs: Vec::new(),
            reduced: Vec::new(),
        };
        (roots.into_iter().map(subtree).collect(), above)
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
            lower(workers, |j| front.upper.col_as_slice(j), y);
            self.gather(&front.delayed_rows, &plan.boundary, rhs, &mut local);
            let (delayed, boundary) = local.split_at_mut(front.delayed_rows.len());
            for (rows, part) in [delayed, boundary].into_iter().enumerate() {
                subtract(workers, part, |j| front.below(j)[rows], y);
            }
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
            subtract(workers, y, |j| front.upper.col_as_slice(count + j), &local);
            upper(workers, |j| front.upper.col_as_slice(j), y);
            for (&column, x) in front.columns.iter().zip(&*y) {
                rhs[column] = *x;
            }
            reduced.truncate(first);
        }
    }

    /// `y −= A x` over all panels of a matrix, by several threads.
    pub(super) fn subtract_panels(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        let analysis = &self.analysis;
        let panels: Vec<_> = analysis.panels.iter().flatten().collect();
        let subtract = |panel: &Panel, y: &mut [f64]| {
            let row = analysis.groups[panel.row.0].start + panel.row.1;
            let column = analysis.groups[panel.column.0].start + panel.column.1;
            subtract_product(
                &mut y[row..][..panel.rows],
                |j| &values[panel.value + j * panel.stride..][..panel.rows],
                &x[column..][..panel.columns],
            );
        };
        let workers = self.workers.for_work(values.len());
        if workers.threads() == 1 {
            panels.iter().for_each(|panel| subtract(panel, y));
            return;
        }
        let length = panels.len().div_ceil(workers.threads()).max(1);
        let mut parts: Vec<_> = panels.chunks(length).map(|p| (p, Vec::new())).collect();
        workers.each(&mut parts, |_, (panels, sum)| {
            sum.resize(x.len(), 0.0);
            panels.iter().for_each(|panel| subtract(panel, sum));
        });
        for (_, sum) in parts {
            y.iter_mut().zip(sum).for_each(|(y, x)| *y += x);
        }
    }
}

/// Roots of subtrees, and the fronts above them, in no order: the largest is divided as long as
/// that leaves threads less to wait for, fronts above included, which they go through together.
/// `numbers` are those of each front with all that lead to it.
fn divided(
    (plans, numbers): (&[FrontPlan], &[usize]),
    all: &[usize],
    threads: usize,
) -> (Vec<usize>, Vec<usize>) {
    let total: usize = all.iter().map(|&root| numbers[root]).sum();
    let divide = |roots: &mut Vec<usize>, above: &mut Vec<usize>| {
        let divisible = (0..roots.len()).filter(|&i| !plans[roots[i]].children.is_empty());
        let largest = divisible.max_by_key(|&i| numbers[roots[i]]);
        let few = roots.len() < SUBTREES;
        let large = largest.filter(|&i| few && numbers[roots[i]] > total / SUBTREES);
        large.map(|i| {
            let root = roots.swap_remove(i);
            roots.extend(&plans[root].children);
            above.push(root);
        })
    };
    let (mut roots, mut above) = (all.to_vec(), Vec::new());
    let (mut best, mut least) = (0, f64::INFINITY);
    loop {
        let below: usize = roots.iter().map(|&root| numbers[root]).sum();
        let largest = roots.iter().map(|&root| numbers[root]).max();
        let (below, largest) = (below as f64, largest.unwrap_or(0) as f64);
        // Of subtrees the largest may come last.
        let share = 1.0 / threads as f64;
        let wait = total as f64 - below + share * below + (1.0 - share) * largest;
        if wait < least {
            (best, least) = (above.len(), wait);
        }
        if divide(&mut roots, &mut above).is_none() {
            break;
        }
    }
    (roots, above) = (all.to_vec(), Vec::new());
    while above.len() < best && divide(&mut roots, &mut above).is_some() {}
    (roots, above)
}

/// `y −= A x`, for the matrix with these columns, rows shared among threads.
fn subtract<'a>(
    workers: &Workers,
    y: &mut [f64],
    column: impl Fn(usize) -> &'a [f64] + Sync,
    x: &[f64],
) {
    let workers = workers.for_work(y.len() * x.len());
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
    for start in (0..count).step_by(BLOCK) {
        let end = (start + BLOCK).min(count);
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
    let mut end = y.len();
    while end > 0 {
        let start = end.saturating_sub(BLOCK);
        let (rest, found) = y.split_at_mut(start);
        let found = &mut found[..end - start];
        solve_upper(|j| &column(start + j)[start..end], found);
        subtract(workers, rest, |j| &column(start + j)[..start], found);
        end = start;
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
    /// A last front that two chains of so many lead to, each with a small one beside its first.
    #[test]
    fn chains_are_divided_where_they_meet_and_no_farther() {
        let count = 40;
        let mut plans: Vec<FrontPlan> = Vec::new();
        let mut numbers = Vec::new();
        let mut add = |children: &[usize], own: usize| {
            numbers.push(own + children.iter().map(|&c| numbers[c]).sum::<usize>());
            plans.push(FrontPlan {
                own: Vec::new(),
                boundary: Vec::new(),
                children: children.to_vec(),
                parent: None,
            });
            plans.len() - 1
        };
        let mut chain = || {
            let leaves = [add(&[], 1), add(&[], 1)];
            (0..count).fold(add(&leaves, 100), |last, _| add(&[last], 100))
        };
        let ends = [chain(), chain()];
        let last = add(&ends, 100);
        for threads in [2, 4] {
            let (roots, above) = divided((&plans, &numbers), &[last], threads);
            assert_eq!((&roots[..], &above[..]), (&ends[..], &[last][..]));
        }
    }
}
