//! What a shell resists: resultants by strains, and inertia, per unit of its reference area.

use crate::error::{Error, Result, require_finite, require_positive_number};
use nalgebra::{Matrix6, SMatrix, SVector, Vector6};
use serde::{Deserialize, Serialize};

/// Law of the twelve strains of a shell, or their stress resultants.
pub type Matrix12 = SMatrix<f64, 12, 12>;
/// Strains of a shell, or stress resultants.
pub type Vector12 = SVector<f64, 12>;

/// A shell per unit of its reference area, along axes 1 and 2 in its surface and the normal.
///
/// The strains are `[ε11 ε12 γ1 | κ11 κ12 κ1n | ε21 ε22 γ2 | κ21 κ22 κ2n]`: how the surface's
/// position and its frame change along axis 1, then along axis 2, resolved in axes 1, 2 and the
/// normal. Bending of lines along axis 1 is `κ12`, along axis 2 `−κ21`; twist is `−κ11` and `κ22`.
/// Resultants `[N11 N12 Q1 | M11 M12 M1n | N21 N22 Q2 | M21 M22 M2n]` do work on them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShellSection {
    /// Stiffness: resultants for unit strains.
    pub stiffness: Matrix12,
    /// Damping: resultants for unit strain rates.
    pub damping: Matrix12,
    /// Mass: momentum for unit velocity `[linear; angular]`.
    pub mass: Matrix6<f64>,
}

/// A shell of one isotropic, linearly elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsotropicShell {
    /// Thickness.
    pub thickness: f64,
    /// Young's modulus.
    pub young: f64,
    /// Poisson's ratio, from −1 (excluded) to below 1/2.
    pub poisson: f64,
    /// Mass per volume.
    pub density: f64,
    /// Stiffness `k_d` of the drilling rotation against the surface, relative to shear: from 0.1 to
    /// 1. Less is too soft for thick curved strips.
    pub drilling: f64,
    /// Stiffness `k_t` against gradients of the drilling rotation; it regularises only.
    pub drilling_gradient: f64,
    /// Damping as stiffness times so many units of time.
    pub damping_time: f64,
}

impl IsotropicShell {
    /// Without damping, and with the usual stiffness of the drilling rotation.
    pub fn new(thickness: f64, young: f64, poisson: f64, density: f64) -> Self {
        IsotropicShell {
            thickness,
            young,
            poisson,
            density,
            drilling: 1.0,
            drilling_gradient: 0.1,
            damping_time: 0.0,
        }
    }

    /// The section (docs/theory.md, section 6.14).
    ///
    /// # Errors
    /// If a number is out of its range.
    pub fn section(&self) -> Result<ShellSection> {
        let IsotropicShell {
            thickness: h,
            young,
            poisson: nu,
            density,
            drilling: kd,
            drilling_gradient: kt,
            damping_time,
        } = *self;
        require_positive_number("thickness", h)?;
        require_positive_number("young", young)?;
        require_finite("poisson", &[nu])?;
        if !(nu > -1.0 && nu < 0.5) {
            return Err(Error::value(
                "poisson",
                "more than −1 and less than 1/2",
                nu,
            ));
        }
        require_not_negative("density", density)?;
        require_finite("drilling", &[kd])?;
        if !(0.1..=1.0).contains(&kd) {
            return Err(Error::value("drilling", "a number from 0.1 to 1", kd));
        }
        require_positive_number("drilling_gradient", kt)?;
        require_not_negative("damping_time", damping_time)?;
        let stretching = young * h / (1.0 - nu * nu);
        let bending = stretching * h * h / 12.0;
        let shear = young * h / (2.0 * (1.0 + nu));
        let turning = kt * shear * h * h / 12.0;
        let mut k = Matrix12::zeros();
        let mut set = |i: usize, j: usize, value: f64| {
            k[(i, j)] = value;
            k[(j, i)] = value;
        };
        for (i, value) in [
            (0, stretching),
            (7, stretching),
            (1, shear * (1.0 + kd)),
            (6, shear * (1.0 + kd)),
            (2, SHEAR_FACTOR * shear),
            (8, SHEAR_FACTOR * shear),
            (3, bending * (1.0 - nu)),
            (4, bending),
            (5, turning),
            (9, bending),
            (10, bending * (1.0 - nu)),
            (11, turning),
        ] {
            set(i, i, value);
        }
        set(0, 7, nu * stretching);
        set(1, 6, shear * (1.0 - kd));
        set(4, 9, -nu * bending);
        let (mass, gyration) = (density * h, density * h * h * h / 12.0);
        let mass = Vector6::new(mass, mass, mass, gyration, gyration, gyration);
        require_finite("stiffness of the shell", k.as_slice())?;
        require_finite("mass of the shell", mass.as_slice())?;
        Ok(ShellSection {
            stiffness: k,
            damping: k * damping_time,
            mass: Matrix6::from_diagonal(&mass),
        })
    }
}

/// Share of the thickness that counts against transverse shear.
const SHEAR_FACTOR: f64 = 5.0 / 6.0;

fn require_not_negative(name: &str, value: f64) -> Result<()> {
    require_finite(name, &[value])?;
    if value < 0.0 {
        return Err(Error::value(name, "zero or more", value));
    }
    Ok(())
}

impl ShellSection {
    /// The same with factors of stiffness, mass and damping.
    pub fn scaled(&self, [stiffness, mass, damping]: &[f64; 3]) -> Self {
        ShellSection {
            stiffness: self.stiffness * *stiffness,
            damping: self.damping * *damping,
            mass: self.mass * *mass,
        }
    }

    /// The same of a shell that is `factor` times as thick, all its layers alike: what stretches
    /// grows with the thickness, what bends with its cube, what couples both with its square.
    pub fn thickened(&self, factor: f64) -> Self {
        // Rows of forces and of velocities first, in each of the sixes.
        let half_power = |i: usize| if i % 6 < 3 { 1 } else { 3 };
        let power = |i: usize, j: usize| factor.powi((half_power(i) + half_power(j)) / 2);
        ShellSection {
            stiffness: self.stiffness.map_with_location(|i, j, x| x * power(i, j)),
            damping: self.damping.map_with_location(|i, j, x| x * power(i, j)),
            mass: self.mass.map_with_location(|i, j, x| x * power(i, j)),
        }
    }

    /// The 6×6 part of stiffness or damping that gives the resultants of direction `row` by the
    /// strains of direction `column`.
    pub(super) fn part(law: &Matrix12, row: usize, column: usize) -> Matrix6<f64> {
        law.fixed_view::<6, 6>(6 * row, 6 * column).into_owned()
    }
}
