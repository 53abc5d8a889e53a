//! The energy of a motion.

use super::{Condition, add_by_parameters};
use crate::collocation::{Collocation, GridState};
use crate::error::Result;

/// The mean over the period of the kinetic and the potential energy is this. Weights have no energy
/// at the origin; of springs on joint coordinates, beams and weights alone the energy is known.
#[derive(Debug, Clone, Copy)]
pub struct Energy {
    /// The energy.
    pub value: f64,
}

impl Condition for Energy {
    fn name(&self) -> String {
        "the energy".into()
    }

    fn scale(&self, equations: &Collocation) -> f64 {
        let scales = equations.system().scales();
        match self.value.abs() {
            size if size > 0.0 => size,
            _ => scales.force * scales.length,
        }
    }

    fn value(&self, equations: &Collocation, state: &GridState) -> Result<f64> {
        Ok(equations.mean_energy(state)? - self.value)
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        equations.add_energy_gradient(state, row)?;
        add_by_parameters(self, equations, state, row)
    }
}

#[cfg(test)]
mod tests {
    use crate::elements::{Coordinate, JointKind};
    use crate::model::{JointCoordinate, Signal, SpringDefinition};
    use crate::solve::test_models::Linearised;
    use crate::test_models::small::one_blade;

    #[test]
    fn the_gradient_is_that_of_the_energy() {
        let (mut model, period) = one_blade(2);
        let frame = crate::motion::Motion::identity();
        let last = model.node_count() - 1;
        let joint = model.add_joint(JointKind::Free, None, Some(last), &frame, &frame);
        let spring = SpringDefinition {
            at: JointCoordinate {
                joint: joint.unwrap(),
                coordinate: Coordinate::Displacement1,
            },
            stiffness: 30.0,
            damping: 0.7,
            rest: 0.1,
        };
        model.add_spring_damper(spring).unwrap();
        model.loads.clear();
        model.distributed_loads.clear();
        model.set_gravity([1.0, -2.0, 3.0].map(|g| Signal::constant(g).unwrap()));
        let mut at = Linearised::new(&model, period, 5, |_| 0.0);
        let size = at.equations.size();
        let wave: Vec<f64> = (0..size).map(|i| 0.02 * (0.9 * i as f64).sin()).collect();
        at.state = at.state.incremented(at.equations.system(), &wave, 1.0);
        let mut row = vec![0.0; size];
        at.equations.update_kinematics(&at.state);
        at.equations
            .add_energy_gradient(&at.state, &mut row)
            .unwrap();
        let system = at.equations.system().clone();
        let scale = row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for i in (0..at.equations.layout().motions().end).step_by(7) {
            let mut energy = |h: f64| {
                let mut increment = vec![0.0; size];
                increment[i] = 1.0;
                let beside = at.state.incremented(&system, &increment, h);
                at.equations.update_kinematics(&beside);
                at.equations.mean_energy(&beside).unwrap()
            };
            let h = 1e-3;
            let slope = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h)))
                / (12.0 * h);
            let error = (slope - row[i]).abs() / scale;
            assert!(error < 1e-8, "{i}: {slope} {}", row[i]);
        }
    }
}
