//! One station of a beam element: its place in the reference, and its section.

use crate::elements::line_station::LineStation;
use crate::elements::section::Section;
use crate::motion::{DualVector, rotation_from_vector};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// One quadrature point, or any other station, of a beam element.
#[derive(Debug, Clone)]
pub(in crate::elements) struct Station {
    /// Shape functions and their derivatives in ξ.
    pub line: LineStation,
    /// Quadrature weight in ξ.
    pub(super) weight: f64,
    /// Reference length for each unit of ξ.
    pub(super) stretch: f64,
    /// In the axes that the element's nodes give it.
    pub(super) section: Section,
    /// Angle by which the section's own axes are turned about axis 1 from these: where twist has a
    /// corner.
    pub turn: f64,
    /// "Velocity in ξ" of the reference configuration.
    pub(super) reference: Vector6<f64>,
}

impl Station {
    /// Shape functions alone.
    pub(super) fn bare(shapes: Vec<(f64, f64)>) -> Self {
        Station {
            line: LineStation { shapes },
            weight: 0.0,
            stretch: 0.0,
            section: Section {
                stiffness: Matrix6::zeros(),
                mass: Matrix6::zeros(),
                damping: Matrix6::zeros(),
            },
            turn: 0.0,
            reference: Vector6::zeros(),
        }
    }

    /// Strain, for the "velocity in ξ" `e`.
    pub(super) fn strain(&self, e: &DualVector) -> Vector6<f64> {
        (e.to_twist() - self.reference) / self.stretch
    }

    /// Stiffness and damping of the resultants, integrated.
    pub(super) fn own_law(&self) -> (Matrix6<f64>, Matrix6<f64>) {
        let factor = self.weight / self.stretch;
        (
            self.section.stiffness * factor,
            self.section.damping * factor,
        )
    }
}

/// A turn about axis 1.
pub(in crate::elements) fn about_axis(angle: f64) -> Matrix3<f64> {
    rotation_from_vector(&(Vector3::x() * angle))
}
