//! A joint coordinate at the start of the period.

use super::Condition;
use crate::collocation::{Collocation, GridState};
use crate::elements::{Contribution, Element, InertialForces, Instant, Measure, Prescribed};
use crate::error::{Error, ErrorKind, Result};
use crate::model::JointCoordinate;
use nalgebra::Vector3;

/// A joint coordinate has this value at the start of the period: with [`Phase`](super::Phase) and a
/// start that turns back there, its amplitude.
#[derive(Debug, Clone, Copy)]
pub struct JointCoordinateIs {
    /// The coordinate.
    pub at: JointCoordinate,
    /// Its value.
    pub value: f64,
}

impl JointCoordinateIs {
    /// The coordinate less its value, and its derivatives by the joint's nodes.
    fn evaluate(&self, equations: &Collocation) -> Result<(f64, Vec<usize>, Contribution)> {
        let joints = equations.system().joints();
        let joint = joints.get(self.at.joint).ok_or_else(|| {
            let (count, got) = (joints.len(), self.at.joint);
            let message = format!("condition: expected a joint id below {count}, got {got}");
            Error::new(ErrorKind::Identifier, message)
        })?;
        if !joint.kind().coordinates().contains(&self.at.coordinate) {
            let (joint, coordinate) = (self.at.joint, self.at.coordinate);
            let message = format!("condition: joint {joint} has no {coordinate}");
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        let element = Prescribed::new(joint, self.at.coordinate, 0);
        let nodes = element.nodes().to_vec();
        let points = equations.grid().points();
        let all = equations.node_states();
        let states: Vec<_> = nodes.iter().map(|&node| all[node * points]).collect();
        let mut out = Contribution::new(nodes.len(), 1, true);
        let instant = Instant {
            time: 0.0,
            nodes: &states,
            multipliers: &[0.0],
            multiplier_rates: &[0.0],
            resultants: &[],
            signals: &[self.value],
            coordinates: &[],
            gravity: Vector3::zeros(),
            inertial: InertialForces::FULL,
        };
        element.evaluate(&instant, &mut out)?;
        Ok((out.constraint[0], nodes, out))
    }
}

impl Condition for JointCoordinateIs {
    fn name(&self) -> String {
        format!(
            "{} of joint {} at the start",
            self.at.coordinate, self.at.joint
        )
    }

    fn scale(&self, equations: &Collocation) -> f64 {
        match self.at.coordinate.measure() {
            Measure::Angle => 1.0,
            Measure::Length => equations.system().scales().length,
        }
    }

    fn value(&self, equations: &Collocation, _: &GridState) -> Result<f64> {
        Ok(self.evaluate(equations)?.0)
    }

    fn gradient(&self, equations: &Collocation, _: &GridState, row: &mut [f64]) -> Result<()> {
        let (_, nodes, out) = self.evaluate(equations)?;
        for (a, &node) in nodes.iter().enumerate() {
            let by = out.gradient.row(0);
            let row = &mut row[equations.layout().motion(node, 0)];
            row.iter_mut()
                .enumerate()
                .for_each(|(i, x)| *x += by[6 * a + i]);
        }
        Ok(())
    }
}
