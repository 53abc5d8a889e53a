//! Products of the Jacobian without forming it: `Γ_v` and `Γ_a` by FFT (docs/theory.md, section
//! 4.3). `O(n N log N)` time, `O(n N)` memory.

use super::{Station, Tangent};
use crate::collocation::problem::Collocation;
use crate::collocation::rule::RuleWorkspace;
use crate::motion::{DualVector, product, vectorised};
use crate::workers::parts;
use nalgebra::{Matrix6, Vector6};

/// An increment of all unknowns, not scaled, and what it changes of their rates.
#[derive(Debug, Clone, Default)]
pub struct Increment {
    /// Of the unknowns.
    pub x: Vec<f64>,
    /// Changes of velocity and acceleration of node `a` at grid point `k`, at `a N + k`.
    pub rates: Vec<[Vector6<f64>; 2]>,
    /// Changes of the rates of own unknowns, in their order; zero for multipliers.
    pub own_rates: Vec<f64>,
}

impl Increment {
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.x[..]) + size_of_val(&self.rates[..]) + size_of_val(&self.own_rates[..])
    }

    fn resize(&mut self, equations: &Collocation) {
        let (system, points) = (equations.system(), equations.grid().points());
        self.x.resize(equations.size(), 0.0);
        self.rates
            .resize(points * system.nodes(), [Vector6::zeros(); 2]);
        self.own_rates.resize(points * system.own_unknowns(), 0.0);
    }
}

impl Tangent {
    /// Writes the product of the scaled Jacobian and `x`. Where `x` goes on with increments of
    /// stress resultants, so does `y` with what the equations of these ask for.
    ///
    /// Where motions of supports have to be alike, forces between these stand at the first part of
    /// the period, for all parts: their mean is meant.
    pub fn apply(&mut self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let (x, resultants) = x.split_at(equations.size());
        let (y, unbalance) = y.split_at_mut(equations.size());
        let mut increment = std::mem::take(&mut self.increment);
        let mut stresses = std::mem::take(&mut self.stresses);
        self.vary(equations, x, &mut increment);
        self.stress(
            equations,
            &increment,
            (resultants, unbalance),
            &mut stresses,
        );
        self.write_forces(equations, &increment, &stresses, y);
        if equations.is_regularised() {
            equations.compliance_of(x, &mut increment.x);
            y.iter_mut().zip(&increment.x).for_each(|(y, c)| *y += c);
        }
        (self.increment, self.stresses) = (increment, stresses);
    }

    /// Writes the product of what multiplies `μ^power`, 1 or 2, in the scaled Jacobian for
    /// increments `exp(μt) Δu`, and `x`, both as in [`Tangent::apply`]. On an even grid, where
    /// `equations` keep the state of these tangents: `D + μ` stands for `D` there.
    pub fn apply_power(&mut self, equations: &Collocation, power: usize, x: &[f64], y: &mut [f64]) {
        let (x, resultants) = x.split_at(equations.size());
        let (y, unbalance) = y.split_at_mut(equations.size());
        let mut increment = std::mem::take(&mut self.increment);
        let mut stresses = std::mem::take(&mut self.stresses);
        self.vary(equations, x, &mut increment);
        self.vary_by_power(equations, power, &mut increment);
        let none = vec![0.0; resultants.len()];
        self.stress(equations, &increment, (&none, unbalance), &mut stresses);
        self.write_forces(equations, &increment, &stresses, y);
        (self.increment, self.stresses) = (increment, stresses);
    }

    /// Writes the derivatives of the scaled equations of the grid by the logarithm of the
    /// frequency, with which rates go, and accelerations with its square. `equations` keep the
    /// state of these tangents; signals their values at the grid points.
    pub fn by_log_frequency(&mut self, equations: &Collocation, y: &mut [f64]) {
        let mut increment = std::mem::take(&mut self.increment);
        let mut stresses = std::mem::take(&mut self.stresses);
        increment.resize(equations);
        increment.x.fill(0.0);
        for (rates, state) in increment.rates.iter_mut().zip(equations.node_states()) {
            *rates = [state.twist, state.twist_rate * 2.0];
        }
        increment.own_rates.copy_from_slice(equations.own_rates());
        self.stress(equations, &increment, (&[], &mut []), &mut stresses);
        self.write_forces(equations, &increment, &stresses, y);
        (self.increment, self.stresses) = (increment, stresses);
    }

    /// What is in proportion to `μ^power` where [`Tangent::vary`] has found what is not.
    ///
    /// ```text
    /// δv = δv₀ + μ u,   δv̇ = δv̇₀ + μ (2 δv₀ + u × v) + μ² u
    /// ```
    fn vary_by_power(&self, equations: &Collocation, power: usize, increment: &mut Increment) {
        let (motions, own) = increment.x.split_at_mut(self.unknowns.motions().end);
        let (states, own_rates) = (equations.node_states(), &mut increment.own_rates);
        let all = increment.rates.iter_mut().zip(motions.chunks_exact(6));
        for ((rates, u), state) in all.zip(states) {
            let u = Vector6::from_column_slice(u);
            let turned = DualVector::from_twist(&u).cross(&DualVector::from_twist(&state.twist));
            *rates = match power {
                1 => [u, rates[0] * 2.0 + turned.to_twist()],
                _ => [Vector6::zeros(), u],
            };
        }
        match power {
            1 => own_rates
                .iter_mut()
                .zip(own)
                .for_each(|(rate, x)| *rate = *x),
            _ => own_rates.fill(0.0),
        }
        increment.x.fill(0.0);
    }

    /// What a scaled increment changes.
    fn vary(&mut self, equations: &Collocation, x: &[f64], increment: &mut Increment) {
        increment.resize(equations);
        let (system, points) = (equations.system(), self.points);
        let rule = self.rule.as_deref().unwrap_or(&*equations.rule);
        let Increment {
            x: unscaled,
            rates,
            own_rates,
        } = increment;
        let layout = equations.layout();
        let (motions, own) = unscaled.split_at_mut(layout.motions().end);
        let unscale = |(to, (x, scale)): (&mut f64, (&f64, &f64))| *to = x * scale;
        let (x_motions, x_own) = x.split_at(motions.len());
        let (motion_scale, own_scale) = equations.column_scale().split_at(motions.len());
        let scaled = x_own.iter().zip(own_scale);
        own.iter_mut().zip(scaled).for_each(unscale);
        let rates = rates.chunks_mut(points);
        let mut nodes: Vec<_> = rates.zip(motions.chunks_mut(layout.of_node())).collect();
        equations.workers().for_each(
            &mut nodes,
            &mut self.variation,
            RuleWorkspace::default,
            |workspace, node, (rates, motions)| {
                let part = layout.node(node);
                let scaled = x_motions[part.clone()].iter().zip(&motion_scale[part]);
                motions.iter_mut().zip(scaled).for_each(unscale);
                // What repeats itself does so in its rates.
                let (told, _) = equations.told(&[node]);
                let (rates, others) = rates.split_at_mut(told);
                rule.vary(node, &motions[..6 * told], workspace, rates);
                let parts = others.chunks_exact_mut(told);
                parts.for_each(|part| part.copy_from_slice(rates));
            },
        );
        let mut workspace = RuleWorkspace::default();
        let mut series = [(); 2].map(|()| vec![0.0; points]);
        let [values, rates] = &mut series;
        for placed in system.elements().iter().filter(|p| p.has_states) {
            let count = placed.element.own_unknowns();
            for row in 0..count {
                let at = |k: usize| placed.own_at(points, k).start + row;
                (0..points).for_each(|k| values[k] = own[at(k)]);
                rule.vary_rates(values, &mut workspace, rates);
                (0..points).for_each(|k| own_rates[at(k)] = rates[k]);
            }
        }
    }

    /// Writes stress resultants that are apart: those that follow, or those given, of which what
    /// follows is then more is left over.
    fn stress(
        &self,
        equations: &Collocation,
        increment: &Increment,
        (resultants, unbalance): (&[f64], &mut [f64]),
        stresses: &mut [DualVector],
    ) {
        let scales = self.resultant_scales(equations.system());
        let counts = (0..self.layout.stations.len()).map(|s| self.layout.station_at.of(s).len());
        let counts = counts.collect::<Vec<_>>().into_iter();
        let mut unbalances = match unbalance.is_empty() {
            true => None,
            false => Some(parts(unbalance, counts.clone().map(|count| 6 * count))),
        };
        let mut stations: Vec<_> = parts(stresses, counts)
            .map(|stresses| (stresses, unbalances.as_mut().and_then(Iterator::next)))
            .collect();
        equations
            .workers()
            .each(&mut stations, |index, (stresses, unbalance)| {
                let station = &self.layout.stations[index];
                vectorised(
                    #[inline(always)]
                    || station.stresses(self, increment, stresses),
                );
                let Some(unbalance) = unbalance else {
                    return;
                };
                let given = resultants[self.resultants_of(index)].chunks_exact(6);
                let unbalance = unbalance.chunks_exact_mut(6);
                for ((stress, given), unbalance) in stresses.iter_mut().zip(given).zip(unbalance) {
                    let given = Vector6::from_column_slice(given);
                    let difference = stress.to_wrench().component_div(&scales) - given;
                    unbalance.copy_from_slice(difference.as_slice());
                    *stress = DualVector::from_wrench(&given.component_mul(&scales));
                }
            });
    }

    /// Writes the scaled equations' change.
    fn write_forces(
        &self,
        equations: &Collocation,
        increment: &Increment,
        stresses: &[DualVector],
        y: &mut [f64],
    ) {
        let places = equations.layout();
        let size = places.motions().end;
        let mut rows: Vec<_> = y[..size].chunks_mut(places.of_node()).collect();
        equations.workers().each(&mut rows, |node, forces| {
            vectorised(
                #[inline(always)]
                || self.write_forces_on(node, equations, (increment, stresses), forces),
            );
        });
        y[size..].fill(0.0);
        self.add_gradients(equations, &increment.x, y, false);
        self.add_feedback(equations, increment, &mut y[size..]);
        self.add_states(equations, increment, &mut y[size..]);
        let scales = equations.row_scale().iter();
        y.iter_mut().zip(scales).for_each(|(y, scale)| *y *= scale);
    }

    /// Writes the forces on a node.
    #[inline(always)]
    fn write_forces_on(
        &self,
        node: usize,
        equations: &Collocation,
        (increment, stresses): (&Increment, &[DualVector]),
        forces: &mut [f64],
    ) {
        let layout = &self.layout;
        forces.fill(0.0);
        for &pair in layout.couplings.of_row(node) {
            let coupling = &layout.couplings.all()[pair];
            let told = equations.told(&[coupling.row, coupling.column]);
            self.add_coupling(pair, told, increment, forces);
        }
        for &(station, strain) in &layout.acting[node] {
            let (_, parts) = equations.told(&layout.stations[station].nodes);
            let stresses = &stresses[layout.station_at.of(station)];
            let strains = &self.strains[layout.strain_at.of(strain)];
            let rows = forces.chunks_exact_mut(6);
            for ((force, strain), stress) in rows.zip(strains).zip(stresses) {
                let sum = (strain.strain.transpose() * *stress).to_wrench();
                force
                    .iter_mut()
                    .zip(&sum)
                    .for_each(|(y, f)| *y += parts * f);
            }
        }
    }

    /// Adds the forces of one coupling to those of its row, at so many grid points, for so many
    /// parts of the period.
    #[inline(always)]
    fn add_coupling(
        &self,
        pair: usize,
        (told, parts): (usize, f64),
        increment: &Increment,
        forces: &mut [f64],
    ) {
        let points = self.points;
        let coupling = &self.layout.couplings.all()[pair];
        let rates = &increment.rates[coupling.column * points..][..points];
        let motions = increment.x[self.unknowns.node(coupling.column)].chunks_exact(6);
        let rows = forces.chunks_exact_mut(6).zip(motions).zip(rates);
        for (k, ((force, u), rates)) in rows.enumerate().take(told) {
            let sum = self.pair(pair, k).force(coupling.moving, u, rates);
            force
                .iter_mut()
                .zip(&sum)
                .for_each(|(y, f)| *y += parts * f);
        }
    }

    /// Adds what own unknowns `λ` change of the forces, `Gᵀ λ` without feedback, and `G u` to the
    /// elements' own equations: for `x` and `y` with motions or forces first and own unknowns or
    /// equations behind. `transposed`: of the transposed matrix.
    pub(super) fn add_gradients(
        &self,
        equations: &Collocation,
        x: &[f64],
        y: &mut [f64],
        transposed: bool,
    ) {
        let (system, layout) = (equations.system(), equations.layout());
        let size = layout.motions().end;
        let (motions, own) = x.split_at(size);
        let (forces, constraints) = y.split_at_mut(size);
        for (placed, tangents) in system.elements().iter().zip(&self.own) {
            let count = placed.element.own_unknowns();
            let nodes = placed.element.nodes();
            if count == 0 {
                continue;
            }
            let (gradients, effects) = match (placed.has_feedback, transposed) {
                (false, _) => (&tangents.gradients, &tangents.gradients),
                (true, false) => (&tangents.gradients, &tangents.effects),
                (true, true) => (&tangents.effects, &tangents.gradients),
            };
            let size = 6 * nodes.len() * count;
            let both = gradients.chunks_exact(size).zip(effects.chunks_exact(size));
            for (k, (gradient, effect)) in both.enumerate() {
                let places = placed.own_at(self.points, k);
                let (lambda, violation) = (&own[places.clone()], &mut constraints[places]);
                let mut columns = gradient.chunks_exact(count).zip(effect.chunks_exact(count));
                for &node in nodes {
                    let at = layout.motion(node, k).start;
                    for (component, (column, effect)) in columns.by_ref().take(6).enumerate() {
                        let rows = violation
                            .iter_mut()
                            .zip(column)
                            .zip(effect.iter().zip(lambda));
                        for ((row, g), (e, l)) in rows {
                            *row += g * motions[at + component];
                            forces[at + component] += e * l;
                        }
                    }
                }
            }
        }
    }

    /// Adds what velocities change of the equations of states with feedback.
    fn add_feedback(
        &self,
        equations: &Collocation,
        increment: &Increment,
        constraints: &mut [f64],
    ) {
        let (system, points) = (equations.system(), self.points);
        let elements = system.elements().iter().enumerate();
        for (index, placed) in elements.filter(|(_, placed)| placed.has_feedback) {
            let count = placed.element.own_unknowns();
            for k in 0..points {
                let rows = &mut constraints[placed.own_at(points, k)];
                let mut columns = self.gradient_rate(system, index, k).chunks_exact(count);
                for &node in placed.element.nodes() {
                    let [velocity, _] = &increment.rates[node * points + k];
                    for (column, v) in columns.by_ref().take(6).zip(velocity) {
                        let pairs = rows.iter_mut().zip(column);
                        pairs.for_each(|(row, g)| *row += g * v);
                    }
                }
            }
        }
    }

    /// Adds what internal states and their rates change in their own equations.
    fn add_states(&self, equations: &Collocation, increment: &Increment, constraints: &mut [f64]) {
        let (system, points) = (equations.system(), self.points);
        let states = &increment.x[equations.layout().own()];
        for (index, placed) in system.elements().iter().enumerate() {
            if !placed.has_states {
                continue;
            }
            let count = placed.element.own_unknowns();
            for k in 0..points {
                let (own, own_rate) = self.own(system, index, k);
                let first = placed.own_at(points, k).start;
                for column in 0..count {
                    let (x, rate) = (states[first + column], increment.own_rates[first + column]);
                    for row in 0..count {
                        let place = column * count + row;
                        constraints[first + row] += own[place] * x + own_rate[place] * rate;
                    }
                }
            }
        }
    }
}

impl Station {
    /// Stress resultants by the motions and rates of the nodes, at all grid points.
    #[inline(always)]
    fn stresses(&self, tangent: &Tangent, increment: &Increment, stresses: &mut [DualVector]) {
        let law = &self.law;
        for (k, stress) in stresses.iter_mut().enumerate() {
            let mut wrench = Vector6::zeros();
            let own = (&law.stiffness, &law.damping);
            self.add_stress((tangent, self.first, k), increment, own, &mut wrench);
            for other in &law.others {
                let first = self.first_of(other.offset);
                let law = (&other.stiffness, &other.damping);
                self.add_stress((tangent, first, k), increment, law, &mut wrench);
            }
            *stress = DualVector::from_wrench(&wrench);
        }
    }

    /// Adds what follows from the strain tangents from the first on, at grid point `k`, by a law of
    /// stiffness and damping.
    #[inline(always)]
    fn add_stress(
        &self,
        (tangent, first, k): (&Tangent, usize, usize),
        increment: &Increment,
        (stiffness, damping): (&Matrix6<f64>, &Matrix6<f64>),
        wrench: &mut Vector6<f64>,
    ) {
        let unknowns = &tangent.unknowns;
        let (mut strain, mut strain_rate) = (DualVector::zeros(), DualVector::zeros());
        for (a, &node) in self.nodes.iter().enumerate() {
            let tangent = tangent.strain(first + a, k);
            let u = Vector6::from_column_slice(&increment.x[unknowns.motion(node, k)]);
            let u = DualVector::from_twist(&u);
            strain += tangent.strain * u;
            if self.damped {
                let v = DualVector::from_twist(&increment.rates[node * unknowns.points() + k][0]);
                strain_rate += tangent.strain * v + tangent.rate * u;
            }
        }
        *wrench += product(stiffness, &strain.to_twist());
        if self.damped {
            *wrench += product(damping, &strain_rate.to_twist());
        }
    }
}
