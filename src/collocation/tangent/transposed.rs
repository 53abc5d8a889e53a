//! Products of the transposed Jacobian without forming it (docs/theory.md, section 5.3).

use super::Tangent;
use crate::collocation::problem::Collocation;
use crate::collocation::rule::RuleWorkspace;
use crate::motion::{DualVector, transposed_product, vectorised};
use nalgebra::Vector6;

/// Scratch of one thread.
#[derive(Default)]
struct Scratch {
    /// What a node's velocity and acceleration are multiplied by, at the grid points.
    by_rates: Vec<[Vector6<f64>; 2]>,
    rule: RuleWorkspace,
}

impl Tangent {
    /// Writes the product of the transposed scaled Jacobian and `x`. Where `x` goes on with the
    /// equations of stress resultants, so does `y` with their unknowns, as in [`Tangent::apply`].
    /// With `x` that is 1 for one equation and 0 for all others it is the row of that one.
    pub fn apply_transposed(&self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let layout = equations.layout();
        let size = layout.motions().end;
        let (x, unbalance) = x.split_at(equations.size());
        let (y, resultants) = y.split_at_mut(equations.size());
        let scaled = x.iter().zip(equations.row_scale());
        let forces: Vec<f64> = scaled.map(|(x, scale)| x * scale).collect();
        let scales = self.resultant_scales(equations.system());
        let stretched = vectorised(
            #[inline(always)]
            || self.stretch(&forces, &scales, (unbalance, &mut *resultants)),
        );
        let mut columns: Vec<&mut [f64]> = y[..size].chunks_mut(layout.of_node()).collect();
        equations.workers().for_each(
            &mut columns,
            &mut Vec::new(),
            Scratch::default,
            |scratch, node, y| {
                vectorised(
                    #[inline(always)]
                    || self.write_column(equations, node, (&forces, &stretched), scratch, y),
                );
            },
        );
        y[size..].fill(0.0);
        self.add_gradients(equations, &forces, y, true);
        self.add_transposed_states(equations, &forces[size..], &mut y[size..]);
        let scales = equations.column_scale().iter();
        y.iter_mut().zip(scales).for_each(|(y, scale)| *y *= scale);
        if equations.is_regularised() {
            let mut compliance = forces;
            equations.compliance_of(x, &mut compliance);
            y.iter_mut().zip(&compliance).for_each(|(y, c)| *y += c);
        }
    }

    /// What strains and strain rates of station `s` at grid point `k` are multiplied by, at
    /// `s N + k`: the laws' transposes of what resultants are. Where these are unknowns, that is
    /// their equations' `unbalance`, and what they are multiplied by is written to `resultants`.
    #[inline(always)]
    fn stretch(
        &self,
        forces: &[f64],
        scales: &Vector6<f64>,
        (unbalance, resultants): (&[f64], &mut [f64]),
    ) -> Vec<[DualVector; 2]> {
        let points = self.points;
        let mut unknown = unbalance
            .chunks_exact(6)
            .zip(resultants.chunks_exact_mut(6));
        let mut all = vec![[DualVector::zeros(); 2]; points * self.layout.stations.len()];
        for (s, station) in self.layout.stations.iter().enumerate() {
            for k in 0..points {
                let mut by_resultants = DualVector::zeros();
                for (a, node) in station.nodes.iter().enumerate() {
                    let force = Vector6::from_column_slice(&forces[self.unknowns.motion(*node, k)]);
                    let strain = &self.strain(station.first + a, k).strain;
                    by_resultants += *strain * DualVector::from_twist(&force);
                }
                let mut by_resultants = by_resultants.to_twist();
                if let Some((unbalance, resultant)) = unknown.next() {
                    let unbalance = Vector6::from_column_slice(unbalance);
                    let sum = by_resultants.component_mul(scales) - unbalance;
                    resultant.copy_from_slice(sum.as_slice());
                    by_resultants = unbalance.component_div(scales);
                }
                let law = &station.law;
                let others = law.others.iter();
                let others = others.map(|other| (other.offset, &other.stiffness, &other.damping));
                let own = [(0, &law.stiffness, &law.damping)];
                for (offset, stiffness, damping) in own.into_iter().chain(others) {
                    let sums = &mut all[s.saturating_add_signed(offset) * points + k];
                    let wrench = |law: &nalgebra::Matrix6<f64>| {
                        DualVector::from_wrench(&transposed_product(law, &by_resultants))
                    };
                    sums[0] += wrench(stiffness);
                    if station.damped {
                        sums[1] += wrench(damping);
                    }
                }
            }
        }
        all
    }

    /// Writes the rows of a node's motions.
    #[inline(always)]
    fn write_column(
        &self,
        equations: &Collocation,
        node: usize,
        (forces, stretched): (&[f64], &[[DualVector; 2]]),
        scratch: &mut Scratch,
        y: &mut [f64],
    ) {
        let points = self.points;
        y.fill(0.0);
        let add = |y: &mut [f64], sum: &Vector6<f64>| {
            y.iter_mut().zip(sum).for_each(|(y, f)| *y += f);
        };
        let Scratch { by_rates, rule } = scratch;
        by_rates.clear();
        by_rates.resize(points, [Vector6::zeros(); 2]);
        let mut moving = false;
        for pair in self.layout.couplings.of_column(node) {
            let coupling = &self.layout.couplings.all()[pair];
            moving |= coupling.moving;
            let forces = forces[self.unknowns.node(coupling.row)].chunks_exact(6);
            let rows = forces.zip(y.chunks_exact_mut(6)).zip(&mut *by_rates);
            for (k, ((force, y), by_rates)) in rows.enumerate() {
                let (force, tangent) = (Vector6::from_column_slice(force), self.pair(pair, k));
                add(y, &transposed_product(tangent.stiffness, &force));
                if coupling.moving {
                    by_rates[0] += transposed_product(tangent.damping, &force);
                    by_rates[1] += transposed_product(tangent.mass, &force);
                }
            }
        }
        for &(station, strain) in &self.layout.acting[node] {
            let damped = self.layout.stations[station].damped;
            moving |= damped;
            let stretched = &stretched[station * points..][..points];
            let rows = y.chunks_exact_mut(6).zip(stretched).zip(&mut *by_rates);
            for (k, ((y, [by_strain, by_rate]), by_rates)) in rows.enumerate() {
                let tangent = self.strain(strain, k);
                let spread = tangent.strain.transpose();
                let mut sum = spread * *by_strain;
                if damped {
                    sum += tangent.rate.transpose() * *by_rate;
                    by_rates[0] += (spread * *by_rate).to_wrench();
                }
                add(y, &sum.to_wrench());
            }
        }
        moving |= self.add_feedback_by_rates(equations, node, forces, by_rates);
        if moving {
            self.rule(equations)
                .vary_transposed(node, by_rates, rule, y);
        }
    }

    /// Adds what the equations of states with feedback multiply a node's velocity by. `false` if
    /// there are none.
    fn add_feedback_by_rates(
        &self,
        equations: &Collocation,
        node: usize,
        x: &[f64],
        by_rates: &mut [[Vector6<f64>; 2]],
    ) -> bool {
        let (system, points) = (equations.system(), self.points);
        let own = &x[equations.layout().own()];
        let mut any = false;
        for (index, placed) in system.elements().iter().enumerate() {
            let nodes = placed.element.nodes();
            let local = nodes.iter().position(|&other| other == node);
            let (true, Some(local)) = (placed.has_feedback, local) else {
                continue;
            };
            any = true;
            let count = placed.element.own_unknowns();
            for (k, by_rates) in by_rates.iter_mut().enumerate() {
                let x = &own[placed.own_at(points, k)];
                let all = self.gradient_rate(system, index, k).chunks_exact(count);
                let columns = all.skip(6 * local).take(6);
                for (sum, column) in by_rates[0].iter_mut().zip(columns) {
                    *sum += column.iter().zip(x).map(|(g, x)| g * x).sum::<f64>();
                }
            }
        }
        any
    }

    /// Adds what internal states and their rates change in their own equations.
    fn add_transposed_states(&self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let (system, points) = (equations.system(), self.points);
        let mut workspace = RuleWorkspace::default();
        let mut by_rates = vec![0.0; points];
        for (index, placed) in system.elements().iter().enumerate() {
            if !placed.has_states {
                continue;
            }
            let count = placed.element.own_unknowns();
            let first = |k: usize| placed.own_at(points, k).start;
            for column in 0..count {
                for (k, by_rate) in by_rates.iter_mut().enumerate() {
                    let (own, own_rate) = self.own(system, index, k);
                    let entries = column * count..(column + 1) * count;
                    let x = &x[first(k)..first(k) + count];
                    let sum = |column: &[f64]| -> f64 {
                        column.iter().zip(x).map(|(entry, x)| entry * x).sum()
                    };
                    y[first(k) + column] += sum(&own[entries.clone()]);
                    *by_rate = sum(&own_rate[entries]);
                }
                let mut values = vec![0.0; points];
                let rule = self.rule(equations);
                rule.vary_rates_transposed(&by_rates, &mut workspace, &mut values);
                for (k, value) in values.iter().enumerate() {
                    y[first(k) + column] += value;
                }
            }
        }
    }
}
