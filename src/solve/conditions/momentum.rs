//! The momentum of a motion.

use super::{Condition, RigidMotion, add_by_parameters};
use crate::collocation::{Collocation, GridState};
use crate::error::Result;

/// The mean over the period of the momentum in the inertial frame is this: in a direction, or about
/// an axis. Of a free body it is the same at all times.
#[derive(Debug, Clone, Copy)]
pub struct Momentum {
    /// The motion that it belongs to.
    pub motion: RigidMotion,
    /// The momentum.
    pub value: f64,
}

impl Condition for Momentum {
    fn name(&self) -> String {
        match self.motion.is_translation {
            true => "the momentum".into(),
            false => "the angular momentum".into(),
        }
    }

    fn scale(&self, equations: &Collocation) -> f64 {
        let scales = equations.system().scales();
        let momentum = scales.force * equations.grid().period();
        match (self.value.abs(), self.motion.is_translation) {
            (size, _) if size > 0.0 => size,
            (_, true) => momentum,
            (_, false) => momentum * scales.length,
        }
    }

    fn value(&self, equations: &Collocation, _: &GridState) -> Result<f64> {
        Ok(equations.mean_momentum(&self.motion.twist) - self.value)
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        equations.add_momentum_gradient(&self.motion.twist, row);
        add_by_parameters(self, equations, state, row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Signal;
    use crate::solve::test_models::Linearised;
    use crate::test_models::small::one_blade;
    use nalgebra::Vector3;

    #[test]
    fn the_gradient_is_that_of_the_momentum_in_a_frame_that_turns_too() {
        let (mut model, period) = one_blade(2);
        let origin = Vector3::zeros();
        model
            .set_turning_frame(&Vector3::new(0.3, -0.2, 1.0), 2.3, &origin)
            .unwrap();
        model.set_gravity([0.0; 3].map(|g| Signal::constant(g).unwrap()));
        // The hub spins.
        model
            .set_spin(0, &Vector3::new(0.3, 0.4, -1.0), 3.1)
            .unwrap();
        let mut at = Linearised::new(&model, period, 5, |_| 0.0);
        let (axis, point) = (Vector3::new(0.2, 1.0, 0.5), Vector3::new(0.3, -0.1, 0.7));
        for motion in [
            RigidMotion::translation(&axis).unwrap(),
            RigidMotion::rotation(&axis, &point).unwrap(),
        ] {
            at.check_gradient(&Momentum { motion, value: 1.7 });
        }
    }
}
