//! Shells' sections, edges and checks, apart from what their tests of motions see.

use super::{IsotropicShell, Shell};
use crate::motion::Motion;
use nalgebra::{Matrix3, Vector3};

#[test]
fn an_isotropic_section_has_the_mass_of_its_thickness() {
    let (thickness, density) = (0.02, 1100.0);
    let section = IsotropicShell::new(thickness, 2e8, 0.3, density)
        .section()
        .unwrap();
    let (mass, gyration) = (density * thickness, density * thickness.powi(3) / 12.0);
    for i in 0..6 {
        let exact = if i < 3 { mass } else { gyration };
        assert!((section.mass[(i, i)] / exact - 1.0).abs() < 1e-15, "{i}");
    }
    // Stretching and bending alone, by the factor of plane stress.
    let plate = 2e8 / (1.0 - 0.09);
    for (i, exact) in [
        (0, plate * thickness),
        (4, plate * thickness.powi(3) / 12.0),
    ] {
        assert!(
            (section.stiffness[(i, i)] / exact - 1.0).abs() < 1e-14,
            "{i}"
        );
    }
}

#[test]
fn as_many_frames_as_nodes_are_wanted() {
    let section = IsotropicShell::new(0.02, 2e8, 0.3, 1100.0)
        .section()
        .unwrap();
    let at = |i: usize| {
        let place = Vector3::new((i / 2) as f64, (i % 2) as f64, 0.0);
        Motion::new(Matrix3::identity(), place)
    };
    let new = |references: usize, frames: usize| {
        let reference = (0..references).map(at).collect();
        let frames = vec![Motion::identity(); frames];
        Shell::new(
            ((0..4).collect(), [2, 2]),
            (reference, frames),
            section,
            None,
        )
    };
    assert!(new(4, 4).is_ok());
    for (references, frames) in [(3, 4), (4, 3), (4, 5)] {
        let error = new(references, frames).unwrap_err().to_string();
        assert!(error.starts_with("frames: expected 4"), "{error}");
    }
}
