//! A stiffness of all nodes against the ground, in the Jacobian alone.

use super::Collocation;

impl Collocation {
    /// Scaled stiffness of all nodes against the ground in the Jacobian, not in the residual.
    pub fn grounding(&self) -> f64 {
        self.grounding
    }

    /// Takes what it adds to the product of the Jacobian, or its transpose, and `x`.
    pub fn subtract_ground(&self, x: &[f64], y: &mut [f64]) {
        if self.grounding != 0.0 {
            for i in self.layout.motions() {
                y[i] -= self.grounding * x[i];
            }
        }
    }

    /// Gives the nodes such a stiffness, that the Jacobian is regular where nothing else holds
    /// them.
    pub fn ground(&mut self, stiffness: f64) {
        self.grounding = stiffness;
    }
}
