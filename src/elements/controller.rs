//! Laws of the user that read joint coordinates, have internal states, and exert efforts on joint
//! coordinates: controllers, gas forces, inflow. See docs/theory.md, section 6.10.

use super::coordinate_force::{ActedCoordinate, ActedState, Effort, difference_step};
use super::{Contribution, Element, Instant, Measure, OutputVariation, Unknown};
use crate::error::{Error, ErrorKind, Result};
use nalgebra::{DMatrix, Vector6};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// What a [`ControllerFunction`] may depend on.
#[derive(Debug, Clone, Copy)]
pub struct ControllerInput<'a> {
    /// Time.
    pub time: f64,
    /// The coordinates that it reads, angles with their whole turns.
    pub values: &'a [f64],
    /// Their rates.
    pub rates: &'a [f64],
    /// Its states.
    pub states: &'a [f64],
}

/// Where a [`ControllerFunction`] writes; everything is zero at first.
#[derive(Debug)]
pub struct ControllerOutput<'a> {
    /// Efforts on the coordinates that it acts on, towards growth.
    pub efforts: &'a mut [f64],
    /// Rates of the states.
    pub state_rates: &'a mut [f64],
    /// Derivatives of efforts and then of state rates, row by row, by coordinates, by their rates
    /// and by states, if wanted.
    pub tangents: Option<[&'a mut DMatrix<f64>; 3]>,
}

/// A user's function of a controller.
pub type ControllerFunction =
    Arc<dyn Fn(&ControllerInput, &mut ControllerOutput) -> Result<()> + Send + Sync>;

/// A user's function, and how its derivatives are had.
#[derive(Clone)]
pub struct ControllerLaw {
    /// The function.
    pub function: ControllerFunction,
    /// Whether it gives tangents; otherwise they are differenced.
    pub gives_tangents: bool,
}

impl fmt::Debug for ControllerLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ControllerLaw")
            .field("gives_tangents", &self.gives_tangents)
            .finish_non_exhaustive()
    }
}

/// An internal state of a controller.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ControllerState {
    /// Its value where a march begins.
    pub initial: f64,
    /// What it is of the order of, positive.
    pub size: f64,
}

impl Default for ControllerState {
    fn default() -> Self {
        ControllerState {
            initial: 0.0,
            size: 1.0,
        }
    }
}

/// Arguments and results of a function; kept between evaluations.
#[derive(Debug, Clone, Default)]
pub struct ControllerCall {
    /// Coordinates that are read.
    pub values: Vec<f64>,
    /// Their rates.
    pub rates: Vec<f64>,
    /// States.
    pub states: Vec<f64>,
    /// Efforts and state rates.
    pub results: Vec<f64>,
    /// Derivatives of the results by values, rates and states.
    pub tangents: [DMatrix<f64>; 3],
    /// Results to either side, for differences.
    sides: [Vec<f64>; 2],
}

impl ControllerCall {
    /// Makes room for so many results.
    pub(crate) fn resize(&mut self, results: usize) {
        self.results.resize(results, 0.0);
        self.sides.iter_mut().for_each(|s| s.resize(results, 0.0));
        let columns = [self.values.len(), self.rates.len(), self.states.len()];
        for (tangent, columns) in self.tangents.iter_mut().zip(columns) {
            if tangent.shape() != (results, columns) {
                *tangent = DMatrix::zeros(results, columns);
            }
        }
    }

    /// The argument of a column of one of the tangents.
    fn argument(&mut self, which: usize, column: usize) -> &mut f64 {
        let lists = [&mut self.values, &mut self.rates, &mut self.states];
        let [values, rates, states] = lists;
        match which {
            0 => &mut values[column],
            1 => &mut rates[column],
            _ => &mut states[column],
        }
    }
}

const KINDS: [&str; 3] = ["input", "rate of input", "state"];

/// What result `row` is, of a controller with so many efforts.
fn name_of_result(row: usize, efforts: usize) -> String {
    match row.checked_sub(efforts) {
        None => format!("effort {row}"),
        Some(state) => format!("rate of state {state}"),
    }
}

impl ControllerLaw {
    /// Calls the function for the arguments of `call`; of its results `efforts` are efforts.
    ///
    /// # Errors
    /// Those of the function; if a result is not finite.
    pub fn evaluate(
        &self,
        time: f64,
        efforts: usize,
        call: &mut ControllerCall,
        with_tangents: bool,
    ) -> Result<()> {
        let mut results = std::mem::take(&mut call.results);
        let done = self.call(time, efforts, call, &mut results, with_tangents);
        call.results = results;
        done
    }

    fn call(
        &self,
        time: f64,
        efforts: usize,
        call: &mut ControllerCall,
        results: &mut [f64],
        with_tangents: bool,
    ) -> Result<()> {
        results.fill(0.0);
        let ControllerCall {
            values,
            rates,
            states,
            tangents,
            ..
        } = call;
        if with_tangents {
            tangents.iter_mut().for_each(|m| m.fill(0.0));
        }
        let input = ControllerInput {
            time,
            values,
            rates,
            states,
        };
        let (effort_results, state_rates) = results.split_at_mut(efforts);
        let mut output = ControllerOutput {
            efforts: effort_results,
            state_rates,
            tangents: with_tangents.then(|| tangents.each_mut()),
        };
        (self.function)(&input, &mut output)?;
        let refuse = |what: String, got: f64| {
            let message = format!("callback: expected a finite {what} at t = {time}, got {got}");
            Err(Error::new(ErrorKind::Callback, message))
        };
        if let Some(row) = results.iter().position(|x| !x.is_finite()) {
            return refuse(name_of_result(row, efforts), results[row]);
        }
        if !with_tangents {
            return Ok(());
        }
        for (m, kind) in tangents.iter().zip(KINDS) {
            if let Some(at) = m.iter().position(|x| !x.is_finite()) {
                let (row, column) = (at % m.nrows(), at / m.nrows());
                let row = name_of_result(row, efforts);
                return refuse(format!("derivative of {row} by {kind} {column}"), m[at]);
            }
        }
        Ok(())
    }

    /// Writes tangents by central differences, where the arguments are of the order that `sizes`
    /// tell: of values, rates and states.
    ///
    /// # Errors
    /// Those of the function; if a result is not finite.
    pub fn difference(
        &self,
        time: f64,
        efforts: usize,
        call: &mut ControllerCall,
        sizes: impl Fn(usize, usize) -> f64,
    ) -> Result<()> {
        for which in 0..3 {
            for column in 0..call.tangents[which].ncols() {
                let here = *call.argument(which, column);
                let size = match which {
                    0 => sizes(which, column),
                    _ => sizes(which, column).max(here.abs()),
                };
                let h = difference_step(size);
                let (up, down) = (here + h, here - h);
                for (side, value) in [up, down].into_iter().enumerate() {
                    *call.argument(which, column) = value;
                    let mut results = std::mem::take(&mut call.sides[side]);
                    let done = self.call(time, efforts, call, &mut results, false);
                    call.sides[side] = results;
                    done?;
                }
                *call.argument(which, column) = here;
                let [above, below] = &call.sides;
                let slopes = above.iter().zip(below).map(|(a, b)| (a - b) / (up - down));
                let column = &mut call.tangents[which].column_mut(column);
                column.iter_mut().zip(slopes).for_each(|(to, x)| *to = x);
            }
        }
        Ok(())
    }

    /// Tangents, as given or by differences.
    fn linearise(
        &self,
        time: f64,
        efforts: usize,
        call: &mut ControllerCall,
        sizes: impl Fn(usize, usize) -> f64,
    ) -> Result<()> {
        self.evaluate(time, efforts, call, self.gives_tangents)?;
        match self.gives_tangents {
            true => Ok(()),
            false => self.difference(time, efforts, call, sizes),
        }
    }
}

/// Efforts `e(t, q, q̇, x)` on joint coordinates, towards growth, of joint coordinates `q` that are
/// read and states `x`, with `ẋ = f(t, q, q̇, x)`.
#[derive(Debug, Clone)]
pub struct Controller {
    nodes: Vec<usize>,
    inputs: Vec<ActedCoordinate>,
    outputs: Vec<ActedCoordinate>,
    states: Vec<ControllerState>,
    law: ControllerLaw,
    /// What each input and its rate are of the order of.
    scales: Vec<[f64; 2]>,
}

/// Scratch of controllers.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    call: ControllerCall,
    inputs: Vec<ActedState>,
    outputs: Vec<ActedState>,
}

impl Controller {
    /// Reads `inputs`, which are of the order of `scales`, as are their rates, and acts on
    /// `outputs`.
    pub fn new(
        inputs: Vec<ActedCoordinate>,
        outputs: Vec<ActedCoordinate>,
        states: Vec<ControllerState>,
        law: ControllerLaw,
        scales: Vec<[f64; 2]>,
    ) -> Self {
        let all = inputs.iter().chain(&outputs);
        let mut nodes: Vec<usize> = all.flat_map(|at| at.nodes()).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let among = |list: Vec<ActedCoordinate>| {
            let list = list.into_iter();
            list.map(|at| at.among(&nodes)).collect()
        };
        Controller {
            inputs: among(inputs),
            outputs: among(outputs),
            states,
            law,
            scales,
            nodes,
        }
    }

    /// What each coordinate that it acts on measures.
    pub fn outputs(&self) -> impl ExactSizeIterator<Item = Measure> + '_ {
        self.outputs.iter().map(ActedCoordinate::measure)
    }

    /// Its states.
    pub fn states(&self) -> &[ControllerState] {
        &self.states
    }

    fn load(&self, instant: &Instant, scratch: &mut Scratch) -> Result<()> {
        let Scratch {
            call,
            inputs,
            outputs,
        } = scratch;
        inputs.clear();
        outputs.clear();
        call.values.clear();
        call.rates.clear();
        call.states.clear();
        for at in &self.inputs {
            let state = at.state(instant)?;
            call.values.push(state.q.value);
            call.rates.push(state.rate);
            inputs.push(state);
        }
        for at in &self.outputs {
            outputs.push(at.state(instant)?);
        }
        let states = self.states.iter().zip(instant.multipliers);
        call.states.extend(states.map(|(state, x)| state.size * x));
        call.resize(self.outputs.len() + self.states.len());
        Ok(())
    }

    /// Calls the law there.
    fn call(&self, time: f64, scratch: &mut Scratch, with_tangents: bool) -> Result<()> {
        let (efforts, call) = (self.outputs.len(), &mut scratch.call);
        if !with_tangents {
            return self.law.evaluate(time, efforts, call, false);
        }
        let sizes = |which: usize, column: usize| match which {
            0 | 1 => self.scales[column][which],
            _ => self.states[column].size,
        };
        self.law.linearise(time, efforts, call, sizes)
    }

    fn add(&self, instant: &Instant, scratch: &mut Scratch, out: &mut Contribution) -> Result<()> {
        self.load(instant, scratch)?;
        self.call(instant.time, scratch, out.with_tangents)?;
        let efforts = self.outputs.len();
        for (state, effort) in scratch.outputs.iter().zip(&scratch.call.results) {
            // Against growth, as forces count on the left-hand side.
            let effort = Effort {
                value: -effort,
                ..Effort::default()
            };
            state.add_effort(&effort, out);
        }
        let rates = &scratch.call.results[efforts..];
        for (k, (state, rate)) in self.states.iter().zip(rates).enumerate() {
            out.constraint[k] += instant.multiplier_rates[k] - rate / state.size;
        }
        if out.with_tangents {
            self.add_by_inputs(scratch, out);
            self.add_by_states(scratch, out);
        }
        Ok(())
    }

    /// What efforts and state rates vary by with the inputs.
    fn add_by_inputs(&self, scratch: &Scratch, out: &mut Contribution) {
        let [by_value, by_rate, _] = &scratch.call.tangents;
        let efforts = self.outputs.len();
        for (j, input) in scratch.inputs.iter().enumerate() {
            input.vary(|b, [coordinate, rate]| {
                for (i, output) in scratch.outputs.iter().enumerate() {
                    let (value, slope) = (by_value[(i, j)], by_rate[(i, j)]);
                    let by_motion = (coordinate * value + rate * slope).transpose();
                    let by_velocity = (coordinate * slope).transpose();
                    output.vary(|a, [direction, _]| {
                        out.add_stiffness(a, b, &-(direction * by_motion));
                        out.add_damping(a, b, &-(direction * by_velocity));
                    });
                }
                for (k, state) in self.states.iter().enumerate() {
                    let at = (efforts + k, j);
                    let (value, slope) = (by_value[at] / state.size, by_rate[at] / state.size);
                    let by_motion: Vector6<f64> = coordinate * value + rate * slope;
                    let mut row = out.gradient.fixed_view_mut::<1, 6>(k, 6 * b);
                    row -= by_motion.transpose();
                    let mut row = out.gradient_rate.fixed_view_mut::<1, 6>(k, 6 * b);
                    row -= (coordinate * slope).transpose();
                }
            });
        }
    }

    /// What they vary by with the states.
    fn add_by_states(&self, scratch: &Scratch, out: &mut Contribution) {
        let by_state = &scratch.call.tangents[2];
        let efforts = self.outputs.len();
        for (l, column) in self.states.iter().enumerate() {
            for (i, output) in scratch.outputs.iter().enumerate() {
                let factor = by_state[(i, l)] * column.size;
                output.vary(|a, [direction, _]| {
                    let mut row = out.effect.fixed_view_mut::<1, 6>(l, 6 * a);
                    row -= (direction * factor).transpose();
                });
            }
            for (k, row) in self.states.iter().enumerate() {
                out.own[(k, l)] -= by_state[(efforts + k, l)] * column.size / row.size;
            }
            out.own_rate[(l, l)] += 1.0;
        }
    }
}

impl Element for Controller {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn own_unknowns(&self) -> usize {
        self.states.len()
    }

    fn unknown(&self, _index: usize) -> Unknown {
        Unknown::UserState
    }

    fn has_feedback(&self) -> bool {
        !self.states.is_empty()
    }

    fn initial_state(&self, index: usize) -> f64 {
        self.states[index].initial / self.states[index].size
    }

    fn has_damping(&self) -> bool {
        true
    }

    fn as_controller(&self) -> Option<&Controller> {
        Some(self)
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.controller);
        let result = self.add(instant, &mut scratch, out);
        out.scratch.controller = scratch;
        result
    }

    /// The efforts, towards growth, then the states.
    fn outputs(&self, instant: &Instant, out: &mut Vec<f64>) -> Result<()> {
        let mut scratch = Scratch::default();
        self.load(instant, &mut scratch)?;
        self.call(instant.time, &mut scratch, false)?;
        out.extend(&scratch.call.results[..self.outputs.len()]);
        out.extend(&scratch.call.states);
        Ok(())
    }

    fn vary_output(
        &self,
        instant: &Instant,
        index: usize,
        out: &mut OutputVariation,
    ) -> Result<()> {
        if let Some(state) = index.checked_sub(self.outputs.len()) {
            out.own[state] = self.states[state].size;
            return Ok(());
        }
        let mut scratch = Scratch::default();
        self.load(instant, &mut scratch)?;
        self.call(instant.time, &mut scratch, true)?;
        let [by_value, by_rate, by_state] = &scratch.call.tangents;
        for (j, input) in scratch.inputs.iter().enumerate() {
            let effort = Effort {
                by_coordinate: by_value[(index, j)],
                by_rate: by_rate[(index, j)],
                ..Effort::default()
            };
            input.vary_effort(&effort, out);
        }
        for (l, (own, state)) in out.own.iter_mut().zip(&self.states).enumerate() {
            *own += by_state[(index, l)] * state.size;
        }
        Ok(())
    }
}
