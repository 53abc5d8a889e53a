//! How hub and supports of a rotor of like blades may move (docs/theory.md, section 8.10).

use crate::system::{Layout, Placed};
use nalgebra::{Complex, DMatrix, Matrix6, Vector6};
use std::f64::consts::TAU;

/// Motions that are alike: `u(t) = T u(t + T/B)`, scaled, of the nodes of hub and supports; none of
/// those of the blade, which are any.
#[derive(Debug, Clone)]
pub struct AlikeMotions {
    blades: usize,
    nodes: Vec<Option<Step>>,
    /// Of each node: whether it is of supports, whose increments are the same in all parts.
    still: Vec<bool>,
    /// Of each node: whether it is such a one on which no blade acts.
    apart: Vec<bool>,
    /// Of own unknowns of each element that acts on hub and supports alone.
    own: Vec<Option<OwnStep>>,
    /// Of each element: whether it does the same in all parts of the period.
    repeats: Vec<bool>,
}

/// `T` and `T⁻¹` of own unknowns; none where they are the same.
pub(super) type OwnStep = Option<[DMatrix<f64>; 2]>;

/// What a part of the period makes of the increments of a node.
#[derive(Debug, Clone)]
pub struct Step {
    /// `T`.
    pub forth: Matrix6<f64>,
    /// `T⁻¹`.
    pub back: Matrix6<f64>,
}

impl AlikeMotions {
    /// Of so many blades, with the steps of the nodes of hub and supports, and of the own unknowns
    /// of these elements.
    pub(super) fn new(
        blades: usize,
        nodes: Vec<Option<Step>>,
        own: Vec<Option<OwnStep>>,
        elements: &[Placed],
    ) -> Self {
        let is_still = |step: &Option<Step>| {
            step.as_ref()
                .is_some_and(|step| step.forth == Matrix6::identity())
        };
        let still: Vec<bool> = nodes.iter().map(is_still).collect();
        let repeats = elements.iter().map(|placed| {
            let element = &placed.element;
            element.own_unknowns() == 0 && element.nodes().iter().all(|&node| still[node])
        });
        let mut apart = still.clone();
        for placed in elements {
            let all = placed.element.nodes();
            if all.iter().any(|&node| nodes[node].is_none()) {
                all.iter().for_each(|&node| apart[node] = false);
            }
        }
        AlikeMotions {
            repeats: repeats.collect(),
            apart,
            still,
            blades,
            nodes,
            own,
        }
    }

    /// Number of blades.
    pub fn blades(&self) -> usize {
        self.blades
    }

    /// Whether a node is of supports, whose increments are the same in all parts of the period.
    pub fn is_still(&self, node: usize) -> bool {
        self.still[node]
    }

    /// Grid points, of so many from the first on, that tell what acts between these nodes; and how
    /// many parts of the period these stand for.
    pub fn told(&self, nodes: &[usize], points: usize) -> (usize, f64) {
        match nodes.iter().all(|&node| self.apart[node]) {
            true => (points / self.blades, self.blades as f64),
            false => (points, 1.0),
        }
    }

    /// Grid points, of so many, after which an element does the same again: it acts on supports
    /// alone, and has no own unknowns.
    pub(in crate::collocation) fn repeats_after(&self, element: usize, points: usize) -> usize {
        match self.repeats[element] {
            true => points / self.blades,
            false => points,
        }
    }

    /// That of a node of hub and supports.
    pub fn of_node(&self, node: usize) -> Option<&Step> {
        self.nodes[node].as_ref()
    }

    /// What harmonic `h` of functions `u(t) = S u(t + T/B)` may be: the projection on it,
    /// `(1/B) Σ (S exp(2πi h/B))^q`.
    pub fn projection(&self, step: &DMatrix<f64>, harmonic: usize) -> DMatrix<Complex<f64>> {
        let turn = Complex::from_polar(1.0, TAU * harmonic as f64 / self.blades as f64);
        let step = step.map(|x| turn * x);
        let mut power = DMatrix::identity(step.nrows(), step.ncols());
        let mut sum = DMatrix::zeros(step.nrows(), step.ncols());
        for _ in 0..self.blades {
            sum += &power;
            power *= &step;
        }
        sum / Complex::from(self.blades as f64)
    }

    /// Takes from forces on the nodes what does no work on motions that are alike.
    pub fn average(&self, layout: Layout, forces: &mut [f64]) {
        // f(t) = T⁻ᵀ f(t + T/B)
        self.average_nodes(layout, forces, |step, later| step.back.tr_mul(later));
        self.repeat(layout, forces);
    }

    /// Takes from unknowns what is not alike: the mean of what all parts of the period say.
    pub(in crate::collocation) fn project(
        &self,
        layout: Layout,
        elements: &[Placed],
        x: &mut [f64],
    ) {
        self.average_nodes(layout, x, |step, later| step.forth * later);
        let part = layout.points() / self.blades;
        for (placed, step) in elements.iter().zip(&self.own) {
            let count = placed.element.own_unknowns();
            let (Some(step), true) = (step, count > 0) else {
                continue;
            };
            let (mut sum, mut next) = (vec![0.0; count], vec![0.0; count]);
            for k in 0..part {
                sum.fill(0.0);
                for q in (0..self.blades).rev() {
                    if let Some([forth, _]) = step {
                        for (i, next) in next.iter_mut().enumerate() {
                            *next = forth.row(i).iter().zip(&sum).map(|(c, x)| c * x).sum();
                        }
                        sum.copy_from_slice(&next);
                    }
                    let here = &x[layout.element_at(placed, k + q * part)];
                    sum.iter_mut().zip(here).for_each(|(sum, x)| *sum += x);
                }
                let mean = sum.iter().map(|sum| sum / self.blades as f64);
                let here = &mut x[layout.element_at(placed, k)];
                here.iter_mut().zip(mean).for_each(|(x, mean)| *x = mean);
            }
        }
        self.repeat_unknowns(layout, elements, x);
    }

    /// Whether the own unknowns of an element are alike in all parts of the period, as it acts on
    /// hub and supports alone.
    pub fn repeats_own(&self, element: usize) -> bool {
        self.own[element].is_some()
    }

    /// Lets the unknowns of hub and supports be alike in all parts of the period, from the first.
    pub(in crate::collocation) fn repeat_unknowns(
        &self,
        layout: Layout,
        elements: &[Placed],
        x: &mut [f64],
    ) {
        self.repeat_nodes(layout, x, |step, before| step.back * before);
        self.repeat_own(layout, elements, x, |[_, back], i, j| back[(i, j)]);
    }

    /// Lets the equations of hub and supports be alike in all parts of the period, from the first.
    pub(in crate::collocation) fn repeat_equations(
        &self,
        layout: Layout,
        elements: &[Placed],
        rows: &mut [f64],
    ) {
        self.repeat(layout, rows);
        // Their work on unknowns is.
        self.repeat_own(layout, elements, rows, |[forth, _], i, j| forth[(j, i)]);
    }

    /// Writes what belongs to own unknowns of elements on hub and supports, part by part of the
    /// period from the first, by the entries of what carries it from one to the next.
    fn repeat_own(
        &self,
        layout: Layout,
        elements: &[Placed],
        x: &mut [f64],
        entry: impl Fn(&[DMatrix<f64>; 2], usize, usize) -> f64,
    ) {
        let part = layout.points() / self.blades;
        for (placed, step) in elements.iter().zip(&self.own) {
            let count = placed.element.own_unknowns();
            let (Some(step), true) = (step, count > 0) else {
                continue;
            };
            for k in part..layout.points() {
                let before = layout.element_at(placed, k - part);
                let here = layout.element_at(placed, k).start;
                match step {
                    None => x.copy_within(before, here),
                    Some(step) => {
                        for i in 0..count {
                            let terms = (0..count).map(|j| entry(step, i, j) * x[before.start + j]);
                            x[here + i] = terms.sum();
                        }
                    }
                }
            }
        }
    }

    /// Lets the forces on hub and supports be alike in all parts of the period, from the first.
    pub(super) fn repeat(&self, layout: Layout, forces: &mut [f64]) {
        self.repeat_nodes(layout, forces, |step, before| step.forth.tr_mul(before));
    }

    /// Nodes of hub and supports, each with what it does from one part of the period to the next;
    /// none where it is still.
    fn of_hub_and_supports(&self) -> impl Iterator<Item = (usize, Option<&Step>)> {
        let nodes = self.nodes.iter().zip(&self.still).enumerate();
        nodes.filter_map(|(node, (step, is_still))| {
            let step = step.as_ref()?;
            Some((node, (!is_still).then_some(step)))
        })
    }

    /// Writes means of what belongs to nodes of hub and supports to the first part of the period,
    /// where this carries what is one part later.
    fn average_nodes(
        &self,
        layout: Layout,
        x: &mut [f64],
        carry: impl Fn(&Step, &Vector6<f64>) -> Vector6<f64>,
    ) {
        let part = layout.points() / self.blades;
        for (node, step) in self.of_hub_and_supports() {
            for k in 0..part {
                let mut sum = Vector6::zeros();
                for q in (0..self.blades).rev() {
                    let at = layout.motion(node, k + q * part);
                    let carried = step.map_or(sum, |step| carry(step, &sum));
                    sum = carried + Vector6::from_column_slice(&x[at]);
                }
                let mean = sum / self.blades as f64;
                x[layout.motion(node, k)].copy_from_slice(mean.as_slice());
            }
        }
    }

    /// Writes what belongs to nodes of hub and supports, part by part of the period from the first,
    /// where this carries it from one to the next.
    fn repeat_nodes(
        &self,
        layout: Layout,
        x: &mut [f64],
        carry: impl Fn(&Step, &Vector6<f64>) -> Vector6<f64>,
    ) {
        let part = layout.points() / self.blades;
        for (node, step) in self.of_hub_and_supports() {
            for k in part..layout.points() {
                let before = Vector6::from_column_slice(&x[layout.motion(node, k - part)]);
                let here = step.map_or(before, |step| carry(step, &before));
                x[layout.motion(node, k)].copy_from_slice(here.as_slice());
            }
        }
    }
}
