//! What forces do: efforts, and what they exert on nodes.

use super::Probe;
use super::history::{Forces, History};
use super::record::ForceRecord;
use super::samples::Samples;
use super::variation::Variation;
use crate::elements::{InertialForces, LoadFrame, OutputVariation};
use crate::error::{Error, ErrorKind, Result, require_id};
use crate::motion::{halves, joined, turned};
use crate::system::{Conditions, ElementRole, Exerted, OwnValues, Placed, System};
use nalgebra::{Matrix3, Vector3, Vector6};

/// What can be asked of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceQuantity {
    /// Effort on its joint coordinate: of an actuator towards growth, of all others against it.
    Effort,
    /// Effort of a branch of a generalised Maxwell model, against the growth of its coordinate.
    BranchEffort(usize),
    /// Elongation (or turn) of the dashpot of such a branch.
    BranchElongation(usize),
    /// Force and moment that it exerts on one of its nodes, along the inertial axes or those of the
    /// node.
    OnNode(usize, LoadFrame),
    /// Forces and moments of a bushing, against its deformation.
    BushingEfforts,
    /// Effort of a controller on one of the coordinates that it acts on, towards growth.
    ControlEffort(usize),
    /// A state of a controller.
    ControlState(usize),
}

/// What one element does at all times of a motion, with these values of all signals, time by time.
///
/// # Errors
/// Those of functions of the user.
fn recorded(history: &History, placed: &Placed, signals: &[f64]) -> Result<ForceRecord> {
    let mut record = ForceRecord {
        nodes: placed.element.nodes().to_vec(),
        on_nodes: Vec::new(),
        outputs: Vec::new(),
        gain: match history.grid {
            Some(_) => state_gain(history, placed),
            None => 0.0,
        },
    };
    let count = history.system.signals();
    for k in 0..history.points() {
        let coordinates = history.state.tracked(history.system, k);
        let (signals, own) = (&signals[k * count..][..count], history.own_of(placed, k));
        let exerted = exerted(history, placed, k, coordinates, signals, own)?;
        record.on_nodes.push(exerted.on_nodes);
        record.outputs.push(exerted.outputs);
    }
    Ok(record)
}

/// The same of all forces; those that cannot be evaluated there tell why.
pub(crate) fn record_forces(history: &History, signals: &[f64]) -> Vec<Result<ForceRecord>> {
    let elements = history.system.elements().iter();
    elements
        .filter(|placed| matches!(placed.role, ElementRole::Force(_)))
        .map(|placed| recorded(history, placed, signals))
        .collect()
}

/// What the internal states of an element gain in a period.
pub(crate) fn state_gain(history: &History, placed: &Placed) -> f64 {
    match placed.has_states {
        true => history.state.gain(history.system, placed, 0),
        false => 0.0,
    }
}

/// What an element does at time `k`, for these coordinates, signals and own unknowns.
pub(crate) fn exerted(
    history: &History,
    placed: &Placed,
    k: usize,
    coordinates: &[f64],
    signals: &[f64],
    values: &[f64],
) -> Result<Exerted> {
    let conditions = Conditions {
        time: history.times[k],
        signals,
        coordinates,
        inertial: InertialForces::FULL,
    };
    let own = OwnValues {
        values,
        // What is read does not depend on them.
        rates: &vec![0.0; values.len()],
        resultants: &[],
    };
    let states = history.nodes_of(&*placed.element, k);
    history.system.outputs(placed, &states, &conditions, own)
}

impl ForceQuantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            ForceQuantity::OnNode(..) | ForceQuantity::BushingEfforts => 6,
            _ => 1,
        }
    }

    pub(super) fn probe(self, system: &System, force: usize) -> Result<Box<dyn Probe>> {
        let elements = system.elements().iter();
        let is_force = |placed: &&Placed| matches!(placed.role, ElementRole::Force(_));
        require_id(
            "force",
            "force",
            elements.clone().filter(is_force).count(),
            force,
        )?;
        let mut elements = elements.enumerate();
        let (element, placed) = elements
            .find(|(_, placed)| placed.role == ElementRole::Force(force))
            .ok_or_else(|| Error::new(ErrorKind::NotAvailable, "the solution has no such force"))?;
        let branches = if placed.has_states && !placed.has_feedback {
            placed.element.own_unknowns()
        } else {
            0
        };
        let branch_output = |branch: usize| {
            if branch < branches {
                return Ok(1 + 2 * branch);
            }
            let message =
                format!("branch: force {force} has {branches} Maxwell branches, got {branch}");
            Err(Error::new(ErrorKind::NotAvailable, message))
        };
        let part = match self {
            ForceQuantity::Effort => {
                if placed.element.acted_measure().is_none() {
                    let message =
                        format!("force {force} is not on a joint coordinate: it has no effort");
                    return Err(Error::new(ErrorKind::NotAvailable, message));
                }
                Part::Outputs(0, 1)
            }
            ForceQuantity::BushingEfforts => {
                if placed.element.is_bushing() {
                    Part::Outputs(0, 6)
                } else {
                    let message = format!("force {force} is no bushing");
                    return Err(Error::new(ErrorKind::NotAvailable, message));
                }
            }
            ForceQuantity::ControlEffort(output) => {
                let [outputs, _] = controlled(placed, force)?;
                require_one("outputs", force, outputs, output)?;
                Part::Outputs(output, 1)
            }
            ForceQuantity::ControlState(state) => {
                let [outputs, states] = controlled(placed, force)?;
                require_one("states", force, states, state)?;
                Part::Outputs(outputs + state, 1)
            }
            ForceQuantity::BranchEffort(branch) => Part::Outputs(branch_output(branch)?, 1),
            ForceQuantity::BranchElongation(branch) => Part::Dashpot(branch_output(branch)? + 1),
            ForceQuantity::OnNode(node, frame) => {
                require_id("node", "node", system.nodes(), node)?;
                let local = placed.element.nodes().iter().position(|&n| n == node);
                let local = local.ok_or_else(|| {
                    let message = format!("force {force} does not act on node {node}");
                    Error::new(ErrorKind::NotAvailable, message)
                })?;
                Part::OnNode(local, frame)
            }
        };
        Ok(Box::new(ForceProbe {
            force,
            element,
            part,
        }))
    }
}

/// Numbers of outputs and states of a controller.
fn controlled(placed: &Placed, force: usize) -> Result<[usize; 2]> {
    let counts = placed.element.as_controller();
    let counts = counts.map(|of| [of.outputs().len(), of.states().len()]);
    counts.ok_or_else(|| {
        let message = format!("force {force} is no controller");
        Error::new(ErrorKind::NotAvailable, message)
    })
}

fn require_one(what: &str, force: usize, count: usize, number: usize) -> Result<()> {
    if number < count {
        return Ok(());
    }
    let message = format!("{what}: the controller force {force} has {count}, got number {number}");
    Err(Error::new(ErrorKind::NotAvailable, message))
}

/// What of a force is asked for.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// Outputs of its element, from one of them on.
    Outputs(usize, usize),
    /// The same, where it gains what the internal states do.
    Dashpot(usize),
    /// What it exerts on one of its nodes.
    OnNode(usize, LoadFrame),
}

#[derive(Debug)]
struct ForceProbe {
    force: usize,
    element: usize,
    part: Part,
}

impl ForceProbe {
    /// What is by the force on a node along axes that is by it along its own; adds what comes with
    /// the turn of these, ψ, as `Δ(R f) = R (Δf + ψ × f)`.
    fn by_own_force(
        &self,
        (history, k): (&History, usize),
        (node, frame): (usize, LoadFrame),
        by_force: &Vector6<f64>,
        samples: &Samples,
        out: &mut Variation,
    ) -> Vector6<f64> {
        if frame == LoadFrame::Follower {
            return *by_force;
        }
        let back = history.node(node, k).motion.rotation.transpose();
        let force = Vector6::from_fn(|i, _| samples.columns[i][k]);
        let (f, m) = halves(&turned(&back, &force));
        let by_force = turned(&back, by_force);
        let (by_f, by_m) = halves(&by_force);
        let turn = joined(&Vector3::zeros(), &(f.cross(&by_f) + m.cross(&by_m)));
        out.add(node, k, &[turn, Vector6::zeros(), Vector6::zeros()]);
        by_force
    }
}

impl Probe for ForceProbe {
    fn samples(&self, history: &History) -> Result<Samples> {
        let placed = &history.system.elements()[self.element];
        let found;
        let record = match history.forces {
            Forces::Recorded(records) => records[self.force].as_ref().map_err(Error::clone)?,
            Forces::Evaluated(signals) => {
                found = recorded(history, placed, signals)?;
                &found
            }
        };
        match self.part {
            Part::Outputs(first, count) => Samples::at_each(history, count, |k, row| {
                let places = first..first + count;
                row.extend(record.part(&record.outputs, k, places)?);
                Ok(())
            }),
            Part::Dashpot(place) => {
                let samples = Samples::at_each(history, 1, |k, row| {
                    row.push(record.part(&record.outputs, k, place..place + 1)?[0]);
                    Ok(())
                })?;
                // One on an angle that gains turns gains them too.
                let gain = record.gain;
                Ok(Samples {
                    rate: history.grid.map_or(0.0, |grid| gain / grid.period()),
                    ..samples
                })
            }
            Part::OnNode(local, frame) => Samples::at_each(history, 6, |k, row| {
                let places = 6 * local..6 * local + 6;
                let own = record.part(&record.on_nodes, k, places)?;
                let own = Vector6::from_column_slice(own);
                let node = placed.element.nodes()[local];
                let turn = match frame {
                    LoadFrame::Space => history.node(node, k).motion.rotation,
                    LoadFrame::Follower => Matrix3::identity(),
                };
                row.extend(turned(&turn, &own).iter());
                Ok(())
            }),
        }
    }

    fn vary(
        &self,
        history: &History,
        (component, k): (usize, usize),
        samples: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        let Forces::Evaluated(signals) = history.forces else {
            let message = "forces that are known from records cannot be varied";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        };
        let (system, count) = (history.system, history.system.signals());
        let placed = &system.elements()[self.element];
        let nodes = placed.element.nodes();
        let values = history.own_of(placed, k);
        let conditions = Conditions {
            time: history.times[k],
            signals: &signals[k * count..][..count],
            coordinates: history.state.tracked(system, k),
            inertial: InertialForces::FULL,
        };
        let own = OwnValues {
            values,
            rates: &vec![0.0; values.len()],
            resultants: &[],
        };
        let (local, frame) = match self.part {
            Part::OnNode(local, frame) => (local, frame),
            Part::Outputs(first, _) | Part::Dashpot(first) => {
                let place = first + component;
                let states = history.nodes_of(&*placed.element, k);
                let mut found = OutputVariation::new(nodes.len(), values.len());
                system.vary_output(placed, &states, &conditions, own, (place, &mut found))?;
                for (&node, [motion, velocity]) in nodes.iter().zip(&found.nodes) {
                    let rows = [motion * weight, velocity * weight, Vector6::zeros()];
                    out.add(node, k, &rows);
                }
                for (index, factor) in found.own.iter().enumerate() {
                    out.add_own(placed, index, k, factor * weight);
                }
                return Ok(());
            }
        };
        let unit = Vector6::ith(component, weight);
        let by_force = self.by_own_force((history, k), (nodes[local], frame), &unit, samples, out);
        let mut workspace = std::mem::take(&mut out.workspace);
        let node_state = |node: usize| *history.node(node, k);
        let evaluated = system.evaluate(placed, node_state, &conditions, own, &mut workspace);
        // Forces count on the left-hand side of the equations.
        if let Ok(tangents) = &evaluated {
            for (b, &other) in nodes.iter().enumerate() {
                let rows = [&tangents.stiffness, &tangents.damping, &tangents.mass];
                let rows = rows.map(|matrix| {
                    let block = matrix.fixed_view::<6, 6>(6 * local, 6 * b);
                    -block.tr_mul(&by_force)
                });
                out.add(other, k, &rows);
            }
            for index in 0..values.len() {
                let column = tangents.by_own().fixed_view::<1, 6>(index, 6 * local);
                out.add_own(placed, index, k, -(column * by_force)[0]);
            }
        }
        let result = evaluated.map(|_| ());
        out.workspace = workspace;
        result
    }
}
