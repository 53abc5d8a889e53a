//! Compares the tangents that a user's function gives with differences of its forces.

use super::System;
use super::scales::coordinate_scales;
use crate::elements::{
    ControllerCall, CoordinateLaw, CoordinateState, Element, ForcePlace, NodeForceLaw, NodeState,
    SurfaceForceLaw, Tangent, UserForce,
};
use crate::error::{Error, ErrorKind, Result};
use crate::model::{ControllerDefinition, ForceDefinition, JointCoordinate, Model};
use nalgebra::{DMatrix, Matrix6, Vector6};
use std::f64::consts::TAU;

/// States that tangents are compared at.
const STATES: usize = 4;
/// Why a function that gives no tangents is not checked.
const DIFFERENCED: &str = "its tangents are found by differences: there is nothing to compare";

/// Where the tangents of a user's function differ most from differences of its forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentCheck {
    /// Largest difference, relative to the largest tangent; forces and motions are taken relative
    /// to what is characteristic of the model. What is right leaves some 1e-8, the error of the
    /// differences.
    pub error: f64,
    /// Time of the state that it was found at.
    pub time: f64,
    /// Which tangent.
    pub tangent: Tangent,
    /// Node and component of the force, of one on a shell point of the quadrature and component;
    /// none for an effort on a joint coordinate.
    pub row: Option<(usize, usize)>,
    /// Node and component of the motion or velocity; likewise.
    pub column: Option<(usize, usize)>,
    /// The derivative that the function gives.
    pub given: f64,
    /// That by differences.
    pub differenced: f64,
}

/// States near the reference configuration, as motions of a period have them; always the same.
pub(super) struct Probe {
    /// What motions are of the order of.
    length: f64,
    frequency: f64,
    count: usize,
}

impl Probe {
    pub(super) fn new(length: f64, frequency: f64) -> Self {
        Probe {
            length,
            frequency,
            count: 0,
        }
    }

    /// Reproducible numbers from −1 to 1 that are spread evenly.
    fn spread(&mut self) -> f64 {
        self.count += 1;
        2.0 * (self.count as f64 * 0.618_033_988_75).fract() - 1.0
    }

    /// A coordinate at time zero, and its rate, of the order of `scales`.
    pub(super) fn coordinate(&mut self, reference: f64, scales: [f64; 2]) -> CoordinateState {
        CoordinateState {
            time: 0.0,
            value: reference + 0.3 * scales[0] * self.spread(),
            rate: scales[1] * self.spread(),
        }
    }

    /// What a controller may be called with.
    pub(super) fn controller(
        &mut self,
        model: &Model,
        controller: &ControllerDefinition,
    ) -> ControllerCall {
        let mut call = ControllerCall::default();
        for at in &controller.inputs {
            let scales = coordinate_scales(at.coordinate, self.length, self.frequency);
            let state = self.coordinate(model.reference_coordinate(at), scales);
            call.values.push(state.value);
            call.rates.push(state.rate);
        }
        for state in &controller.states {
            call.states.push(state.size * self.spread());
        }
        call.resize(controller.outputs.len() + controller.states.len());
        call
    }

    /// Motions and velocities of nodes.
    pub(super) fn nodes(&mut self, model: &Model, nodes: &[usize]) -> Vec<NodeState> {
        let frequency = self.frequency;
        let mut random = |factor: f64| {
            Vector6::from_fn(|i, _| {
                let size = if i < 3 { self.length } else { 1.0 };
                factor * size * self.spread()
            })
        };
        let state = |&node: &usize| NodeState {
            twist: random(frequency),
            ..NodeState::at_rest(model.nodes[node].increment(&random(0.1)))
        };
        nodes.iter().map(state).collect()
    }
}

/// One tangent's derivatives, side by side.
struct Entries<'a> {
    tangent: Tangent,
    given: &'a DMatrix<f64>,
    differenced: &'a DMatrix<f64>,
}

/// A check on its way.
struct Check<'a> {
    model: &'a Model,
    length: f64,
    period: f64,
    probe: Probe,
    /// The worst entry so far.
    worst: Option<TangentCheck>,
    /// Its difference, and the largest tangent.
    difference: f64,
    largest: f64,
}

/// Compares the tangents of force `force`, at a few states near the reference configuration with
/// random velocities, as they are in motions of period `period`.
///
/// # Errors
/// [`ErrorKind::NotAvailable`] if the force is no function of the user that gives tangents, and
/// what [`System::new`] refuses.
pub fn check_tangents(model: &Model, force: usize, period: f64) -> Result<TangentCheck> {
    let definition = model.require_force("force", force)?;
    let length = System::new(model, period)?.scales().length;
    let mut check = Check {
        model,
        length,
        period,
        probe: Probe::new(length, TAU / period),
        worst: None,
        difference: 0.0,
        largest: 0.0,
    };
    let checked = match definition {
        ForceDefinition::CoordinateLaw { at, law, .. } => {
            law.get().and_then(|law| check.coordinate_law(at, law))
        }
        ForceDefinition::NodeForces {
            nodes, law, apart, ..
        } => law
            .get()
            .and_then(|law| check.node_forces(nodes, law, *apart)),
        ForceDefinition::Controller(controller) => check.controller(controller),
        ForceDefinition::SurfaceForces {
            element,
            place,
            law,
            ..
        } => law
            .get()
            .and_then(|law| check.surface_forces((*element, *place), law)),
        _ => Err(unavailable("it is not a function of the user")),
    };
    checked.map_err(|e| e.within(format!("force {force}")))?;
    let mut worst = check.worst.unwrap_or(TangentCheck {
        error: 0.0,
        time: 0.0,
        tangent: Tangent::Stiffness,
        row: None,
        column: None,
        given: 0.0,
        differenced: 0.0,
    });
    if check.largest > 0.0 {
        worst.error = check.difference / check.largest;
    }
    Ok(worst)
}

/// A square matrix of the blocks of six columns that are below each other.
fn side_by_side(blocks: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(blocks.nrows(), blocks.nrows());
    for first in (0..blocks.nrows()).step_by(6) {
        let block = blocks.fixed_view::<6, 6>(first, 0);
        all.fixed_view_mut::<6, 6>(first, first).copy_from(&block);
    }
    all
}

fn unavailable(why: &str) -> Error {
    Error::new(ErrorKind::NotAvailable, why)
}

impl Check<'_> {
    fn times(&self) -> impl Iterator<Item = f64> + use<> {
        let period = self.period;
        (0..STATES).map(move |s| period * (s as f64 + 0.37) / STATES as f64)
    }

    fn coordinate_law(&mut self, at: &JointCoordinate, law: &CoordinateLaw) -> Result<()> {
        if !law.gives_derivatives {
            return Err(unavailable(DIFFERENCED));
        }
        let reference = self.model.reference_coordinate(at);
        let scales = coordinate_scales(at.coordinate, self.length, TAU / self.period);
        for time in self.times() {
            let state = CoordinateState {
                time,
                ..self.probe.coordinate(reference, scales)
            };
            let effort = law.call(&state)?;
            let found = law.differenced(&state, CoordinateLaw::steps(&state, scales))?;
            let pairs = [
                (Tangent::Stiffness, effort.by_coordinate, found[0]),
                (Tangent::Damping, effort.by_rate, found[1]),
            ];
            for ((tangent, given, found), scale) in pairs.into_iter().zip(scales) {
                let entries = Entries {
                    tangent,
                    given: &DMatrix::from_element(1, 1, given),
                    differenced: &DMatrix::from_element(1, 1, found),
                };
                self.compare(time, &entries, |_, _| scale, |_| None);
            }
        }
        Ok(())
    }

    fn node_forces(&mut self, nodes: &[usize], law: &NodeForceLaw, apart: bool) -> Result<()> {
        if !law.gives_tangents {
            return Err(unavailable(DIFFERENCED));
        }
        let (length, frequency) = (self.length, TAU / self.period);
        let element = UserForce::new(nodes.to_vec(), law.clone(), length, frequency);
        let element = element.with_nodes_apart(apart);
        let sizes = |component: usize| if component < 3 { length } else { 1.0 };
        for time in self.times() {
            let states = self.probe.nodes(self.model, nodes);
            let pairs = element.tangent_pairs(time, &states)?;
            let tangents = [(Tangent::Stiffness, 1.0), (Tangent::Damping, frequency)];
            for (i, (tangent, rate)) in tangents.into_iter().enumerate() {
                let all = [&pairs.given[i], &pairs.differenced[i]];
                let all = all.map(|tangents| match apart {
                    true => side_by_side(tangents),
                    false => tangents.clone(),
                });
                let entries = Entries {
                    tangent,
                    given: &all[0],
                    differenced: &all[1],
                };
                let weight = |row: usize, column: usize| {
                    let force = if row % 6 < 3 { 1.0 } else { 1.0 / length };
                    force * sizes(column % 6) * rate
                };
                let place = |at: usize| Some((nodes[at / 6], at % 6));
                self.compare(time, &entries, weight, place);
            }
        }
        Ok(())
    }

    fn controller(&mut self, controller: &ControllerDefinition) -> Result<()> {
        let law = controller.law.get()?;
        if !law.gives_tangents {
            return Err(unavailable(DIFFERENCED));
        }
        let (length, frequency) = (self.length, TAU / self.period);
        let scales = controller.inputs.iter();
        let scales = scales.map(|at| coordinate_scales(at.coordinate, length, frequency));
        let scales: Vec<[f64; 2]> = scales.collect();
        let efforts = controller.outputs.len();
        for time in self.times() {
            let mut call = self.probe.controller(self.model, controller);
            law.evaluate(time, efforts, &mut call, true)?;
            let given = call.tangents.clone();
            let sizes = |which: usize, column: usize| match which {
                0 | 1 => scales[column][which],
                _ => controller.states[column].size,
            };
            law.difference(time, efforts, &mut call, sizes)?;
            // Efforts and state rates are compared apart: nothing relates their sizes.
            for rows in [0..efforts, efforts..efforts + controller.states.len()] {
                let row_size = |row: usize| match row.checked_sub(efforts) {
                    Some(state) => controller.states[state].size,
                    None => 1.0,
                };
                for (which, given) in given.iter().enumerate() {
                    let entries = Entries {
                        tangent: match which {
                            1 => Tangent::Damping,
                            _ => Tangent::Stiffness,
                        },
                        given: &given.rows(rows.start, rows.len()).into_owned(),
                        differenced: &call.tangents[which]
                            .rows(rows.start, rows.len())
                            .into_owned(),
                    };
                    let weight = |row: usize, column: usize| {
                        sizes(which, column) / row_size(row + rows.start)
                    };
                    self.compare(time, &entries, weight, |_| None);
                }
            }
        }
        Ok(())
    }

    fn surface_forces(
        &mut self,
        (element, place): (usize, ForcePlace),
        law: &SurfaceForceLaw,
    ) -> Result<()> {
        if !law.gives_tangents {
            return Err(unavailable(DIFFERENCED));
        }
        let (length, frequency) = (self.length, TAU / self.period);
        let force = self
            .model
            .surface_force((element, place), law, [length, frequency])?;
        let sizes = |component: usize| if component < 3 { length } else { 1.0 };
        for time in self.times() {
            let states = self.probe.nodes(self.model, force.nodes());
            let found = force.tangent_pairs(time, &states)?;
            let tangents = [(Tangent::Stiffness, 1.0), (Tangent::Damping, frequency)];
            for (i, (tangent, rate)) in tangents.into_iter().enumerate() {
                let pairs = found.given[i].iter().zip(&found.differenced[i]);
                for (point, (given, differenced)) in pairs.enumerate() {
                    let dense = |m: &Matrix6<f64>| DMatrix::from_fn(6, 6, |i, j| m[(i, j)]);
                    let entries = Entries {
                        tangent,
                        given: &dense(given),
                        differenced: &dense(differenced),
                    };
                    let weight = |row: usize, column: usize| {
                        let force = if row < 3 { 1.0 } else { 1.0 / length };
                        force * sizes(column) * rate
                    };
                    self.compare(time, &entries, weight, |at| Some((point, at)));
                }
            }
        }
        Ok(())
    }

    /// Compares derivatives; `weights` of rows and columns make them comparable.
    fn compare(
        &mut self,
        time: f64,
        entries: &Entries,
        weights: impl Fn(usize, usize) -> f64,
        place: impl Fn(usize) -> Option<(usize, usize)>,
    ) {
        for (row, column) in
            (0..entries.given.nrows()).flat_map(|i| (0..entries.given.ncols()).map(move |j| (i, j)))
        {
            let given = entries.given[(row, column)];
            let differenced = entries.differenced[(row, column)];
            let weight = weights(row, column);
            let difference = (given - differenced).abs() * weight;
            self.largest = self
                .largest
                .max(given.abs().max(differenced.abs()) * weight);
            if difference >= self.difference {
                self.difference = difference;
                self.worst = Some(TangentCheck {
                    error: 0.0,
                    time,
                    tangent: entries.tangent,
                    row: place(row),
                    column: place(column),
                    given,
                    differenced,
                });
            }
        }
    }
}
