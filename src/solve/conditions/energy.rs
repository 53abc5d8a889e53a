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
    use super::*;
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
        // The hub spins, and what damps that has no energy.
        let axis = nalgebra::Vector3::new(0.3, 0.4, -1.0);
        model.set_spin(0, &axis, 3.1).unwrap();
        model.set_mass_damping(0.4).unwrap();
        let mut at = Linearised::new(&model, period, 5, |_| 0.0);
        at.check_gradient(&Energy { value: 0.0 });
    }
}
