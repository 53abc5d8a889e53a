//! Forces of a shell element: from strains at the samples to resultants at the Gauss points, and
//! back.

use super::scratch::{Damping, Scratch};
use super::{Axes, Shell, ShellSection};
use crate::elements::line_station::rate_variations;
use crate::elements::{Contribution, Element, Instant, NodeState, OtherStation, StressLaw};
use crate::error::Result;
use crate::motion::{DualVector, product, turned};
use nalgebra::Vector6;

impl Element for Shell {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn has_damping(&self) -> bool {
        self.damped
    }

    /// Two at each Gauss point: of the strains along axis 1 and along axis 2.
    fn stress_laws(&self) -> Vec<StressLaw> {
        let law = |point: usize, row: usize| {
            let area = self.points[point].area;
            let part = |column| {
                let ShellSection {
                    stiffness, damping, ..
                } = &self.section;
                let [stiffness, damping] =
                    [stiffness, damping].map(|law| ShellSection::part(law, row, column) * area);
                (stiffness, damping)
            };
            let (stiffness, damping) = part(row);
            let other = part(1 - row);
            StressLaw {
                stiffness,
                damping,
                others: vec![OtherStation {
                    offset: if row == 0 { 1 } else { -1 },
                    stiffness: other.0,
                    damping: other.1,
                }],
            }
        };
        (0..2 * self.points.len())
            .map(|station| law(station / 2, station % 2))
            .collect()
    }

    fn stress_resultants(
        &self,
        nodes: &[NodeState],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        let scratch = &mut scratch.scratch.shell;
        self.find_strains(nodes, scratch)?;
        self.write_resultants(&scratch.at_points, out);
        Ok(())
    }

    fn extrapolate_resultants(
        &self,
        nodes: &[NodeState],
        increments: &[[Vector6<f64>; 2]],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        let scratch = &mut scratch.scratch.shell;
        self.find_strains(nodes, scratch)?;
        let damping = self.damping(nodes);
        for sample in 0..self.samples.len() {
            self.find_terms(sample, damping, scratch);
            let [mut strain, mut rate] = [DualVector::zeros(); 2];
            let frames = scratch.terms.iter().zip(&self.dual_frames);
            for ((node, frame), increments) in frames.zip(increments) {
                let back = frame.transpose();
                let [motion, velocity] =
                    increments.map(|increment| back * DualVector::from_twist(&increment));
                strain += node.strain * motion;
                rate += node.strain * velocity;
                if damping.rates_vary {
                    rate += node.rate * motion;
                }
            }
            scratch.at_samples[0][sample] += strain.to_twist();
            scratch.at_samples[1][sample] += rate.to_twist();
        }
        self.interpolate(&scratch.at_samples, &mut scratch.at_points);
        self.write_resultants(&scratch.at_points, out);
        Ok(())
    }

    fn add_forces_of_resultants(
        &self,
        nodes: &[NodeState],
        resultants: &[Vector6<f64>],
        out: &mut Contribution,
    ) -> Result<()> {
        let mut scratch = std::mem::take(&mut out.scratch.shell);
        let found = self.find_strains(nodes, &mut scratch);
        if found.is_ok() {
            self.collect(resultants, &mut scratch.at_samples[0]);
            self.add_forces(&mut scratch, out);
        }
        out.scratch.shell = scratch;
        found
    }

    fn potential(&self, instant: &Instant, scratch: &mut Contribution) -> Result<Option<f64>> {
        let scratch = &mut scratch.scratch.shell;
        self.find_strains(instant.nodes, scratch)?;
        scratch.at_points[1].fill(Vector6::zeros());
        let mut resultants = std::mem::take(&mut scratch.resultants);
        resultants.resize(2 * self.points.len(), Vector6::zeros());
        self.write_resultants(&scratch.at_points, &mut resultants);
        let all = scratch.at_points[0].iter().zip(&resultants).enumerate();
        let energy = all
            .map(|(i, (strain, stress))| {
                // The energy of the prestress is linear in the strains.
                let stress = stress + self.prestress.fixed_rows::<6>(6 * (i % 2));
                0.5 * self.points[i / 2].area * strain.dot(&stress)
            })
            .sum();
        scratch.resultants = resultants;
        Ok(Some(energy))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.shell);
        let found = self.find_strains(instant.nodes, &mut scratch);
        if found.is_ok() {
            self.add_to(instant, &mut scratch, out);
        }
        out.scratch.shell = scratch;
        found
    }
}

impl Shell {
    fn add_to(&self, instant: &Instant, scratch: &mut Scratch, out: &mut Contribution) {
        let mut resultants = std::mem::take(&mut scratch.resultants);
        resultants.resize(2 * self.points.len(), Vector6::zeros());
        self.write_resultants(&scratch.at_points, &mut resultants);
        self.collect(&resultants, &mut scratch.at_samples[0]);
        scratch.resultants = resultants;
        self.add_forces(scratch, out);
        if out.with_tangents {
            if !instant.resultants.is_empty() {
                self.collect(instant.resultants, &mut scratch.at_samples[0]);
                self.find_forces(scratch);
            }
            self.add_tangents(self.damping(instant.nodes), scratch, out);
        }
    }

    pub(super) fn damping(&self, states: &[NodeState]) -> Damping {
        let moves = states.iter().any(|state| state.twist != Vector6::zeros());
        Damping {
            damped: self.damped,
            rates_vary: self.damped && moves,
        }
    }

    /// Finds the kinematics of all samples, and strains with their rates, if resultants depend on
    /// them, at samples and Gauss points.
    pub(super) fn find_strains(&self, states: &[NodeState], scratch: &mut Scratch) -> Result<()> {
        let Damping { rates_vary, .. } = self.damping(states);
        self.begin(states, scratch);
        for sample in &self.samples {
            let at = sample.line.motion(&scratch.relative)?;
            let rate = if rates_vary {
                let places = sample.line.places(&at, &scratch.relative);
                scratch.places.clear();
                scratch.places.extend(places);
                at.strain_rate(&scratch.places, |a| scratch.twists[a])
            } else {
                DualVector::zeros()
            };
            scratch.at_samples[0].push(at.e.to_twist() - sample.reference);
            scratch.at_samples[1].push(rate.to_twist());
            scratch.motions.push(at);
            scratch.rates.push(rate);
        }
        self.interpolate(&scratch.at_samples, &mut scratch.at_points);
        Ok(())
    }

    /// Begins anew with the nodes at `states`.
    fn begin(&self, states: &[NodeState], scratch: &mut Scratch) {
        scratch.relative.clear();
        scratch.twists.clear();
        scratch.motions.clear();
        scratch.rates.clear();
        scratch.at_samples.iter_mut().for_each(Vec::clear);
        let first = states[0].motion.compose(&self.frames[0]);
        for ((state, frame), dual) in states.iter().zip(&self.frames).zip(&self.dual_frames) {
            let carried = first.relative(&state.motion.compose(frame));
            scratch.relative.push(carried.to_dual());
            let twist = DualVector::from_twist(&state.twist);
            scratch.twists.push(dual.transpose() * twist);
        }
        let relative = &scratch.relative;
        let entry = |i: usize| {
            relative.iter().map(move |y| match i < 9 {
                true => y.primal[i],
                false => y.dual[i - 9],
            })
        };
        scratch.relative_rows.clear();
        scratch.relative_rows.extend((0..18).flat_map(entry));
    }

    /// Strains, and their rates, of the Gauss points by those of the samples.
    fn interpolate(&self, samples: &[Vec<Vector6<f64>>; 2], points: &mut [Vec<Vector6<f64>>; 2]) {
        for (values, out) in samples.iter().zip(points) {
            out.clear();
            for (index, point) in self.points.iter().enumerate() {
                let both = [0, 1].map(|direction| -> Vector6<f64> {
                    let samples = self.sampling.of_point(direction, index);
                    samples.map(|(t, weight)| values[t] * weight).sum()
                });
                out.extend(point.axes.strains(&both));
            }
        }
    }

    /// Integrated resultants at the samples, which do the work that resultants at the Gauss points
    /// do.
    fn collect(&self, resultants: &[Vector6<f64>], samples: &mut [Vector6<f64>]) {
        samples.fill(Vector6::zeros());
        for (index, (point, here)) in self.points.iter().zip(resultants.chunks(2)).enumerate() {
            let by = [0, 1].map(|axis| here[axis] * point.area);
            for (direction, sum) in point.axes.spread(&by).iter().enumerate() {
                for (t, weight) in self.sampling.of_point(direction, index) {
                    samples[t] += sum * weight;
                }
            }
        }
    }

    /// Writes the resultants at all Gauss points, for strains and rates that were found.
    fn write_resultants(&self, at_points: &[Vec<Vector6<f64>>; 2], out: &mut [Vector6<f64>]) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = self.prestress.fixed_rows::<6>(6 * (i % 2)).into_owned();
        }
        let laws = [&self.section.stiffness, &self.section.damping];
        let counts = [true, self.damped];
        for ((law, values), _) in laws.iter().zip(at_points).zip(counts).filter(|x| x.1) {
            let parts = [0, 1].map(|row| [0, 1].map(|column| ShellSection::part(law, row, column)));
            for (out, values) in out.chunks_mut(2).zip(values.chunks(2)) {
                for (out, parts) in out.iter_mut().zip(&parts) {
                    *out += product(&parts[0], &values[0]) + product(&parts[1], &values[1]);
                }
            }
        }
    }

    /// Adds the forces of the integrated resultants at the samples.
    fn add_forces(&self, scratch: &mut Scratch, out: &mut Contribution) {
        self.find_forces(scratch);
        let count = self.nodes.len();
        for (a, frame) in self.dual_frames.iter().enumerate() {
            let wrench = Vector6::from_fn(|i, _| scratch.forces[i * count + a]);
            let force = DualVector::from_wrench(&wrench);
            out.add_force(a, &(*frame * force).to_wrench());
        }
    }

    /// Finds the terms of a sample, for strains that were found: what these vary by.
    pub(super) fn find_terms(&self, sample: usize, damping: Damping, scratch: &mut Scratch) {
        let at = &scratch.motions[sample];
        let places = self.samples[sample].line.places(at, &scratch.relative);
        scratch.places.clear();
        scratch.places.extend(places);
        let places = &scratch.places;
        scratch.terms.clear();
        scratch.terms.extend(at.node_terms(places.iter().copied()));
        if damping.rates_vary {
            let (rate, twists) = (&scratch.rates[sample], &scratch.twists);
            rate_variations(at, rate, |a| twists[a], places, &mut scratch.terms);
        }
    }
}

impl Axes {
    /// Strains along axes 1 and 2 by "velocities" in ξ and η.
    pub(super) fn strains(&self, [xi, eta]: &[Vector6<f64>; 2]) -> [Vector6<f64>; 2] {
        let back = self.turn.transpose();
        self.slopes.map(|[a, b]| turned(&back, &(xi * a + eta * b)))
    }

    /// The transposed: factors of "velocities" in ξ and η by those of strains.
    pub(super) fn spread(&self, by: &[Vector6<f64>; 2]) -> [Vector6<f64>; 2] {
        let [first, second] = by.each_ref().map(|by| turned(&self.turn, by));
        [0, 1].map(|i| first * self.slopes[0][i] + second * self.slopes[1][i])
    }
}
