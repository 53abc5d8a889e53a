//! Strains, resultants and surface stresses of shells.

use super::history::History;
use super::samples::Samples;
use super::variation::Variation;
use super::{Dependence, Probe};
use crate::elements::{Element, Shell, ShellPoint, ShellSide, Vector12, surface_stress};
use crate::error::{Error, Result, require_id};
use crate::system::System;

/// What can be asked of a shell element at a place; components along the axes of that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShellQuantity {
    /// The twelve strains `[ε11 ε12 γ1 | κ11 κ12 κ1n | ε21 ε22 γ2 | κ21 κ22 κ2n]`, see
    /// [`ShellSection`](crate::elements::ShellSection).
    Strain,
    /// The resultants that do work on them, per unit of reference length:
    /// `[N11 N12 Q1 | M11 M12 M1n | N21 N22 Q2 | M21 M22 M2n]`.
    Resultant,
    /// Stresses at a surface of an isotropic shell, `[σ11 σ22 σ12]`, and von Mises' of these.
    SurfaceStress(ShellSide),
}

impl ShellQuantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            ShellQuantity::Strain | ShellQuantity::Resultant => 12,
            ShellQuantity::SurfaceStress(_) => 4,
        }
    }

    /// Finds it.
    pub(crate) fn probe(
        self,
        system: &System,
        element: usize,
        point: ShellPoint,
    ) -> Result<Box<dyn Probe>> {
        let shells = system.shells();
        require_id("element", "shell element", shells.len(), element)?;
        point.validate()?;
        let kind = match self {
            ShellQuantity::Strain => Kind::Strain,
            ShellQuantity::Resultant => Kind::Resultant,
            ShellQuantity::SurfaceStress(side) => {
                stress_factors(&shells[element], element, side)?;
                Kind::Stress(side)
            }
        };
        Ok(Box::new(ShellProbe {
            element,
            point,
            kind,
        }))
    }
}

#[derive(Debug)]
enum Kind {
    Strain,
    Resultant,
    Stress(ShellSide),
}

/// Of each stress at a side the factors of the resultants: of the system at hand, as parameters may
/// move its thickness.
fn stress_factors(shell: &Shell, element: usize, side: ShellSide) -> Result<[Vector12; 3]> {
    let thickness = shell.section().isotropic_thickness().ok_or_else(|| {
        let expected = "an element of an isotropic shell, whose thickness tells stresses";
        let got = format!("element {element} of another law");
        Error::value("element", expected, got)
    })?;
    Ok(surface_stress(thickness, side))
}

#[derive(Debug)]
struct ShellProbe {
    element: usize,
    point: ShellPoint,
    kind: Kind,
}

/// Von Mises' stress in the plane.
fn von_mises([first, second, shear]: [f64; 3]) -> f64 {
    // Squares that add up, none of which is negative.
    let (sum, difference) = (0.5 * (first + second), 0.5 * (first - second));
    let root = 3.0f64.sqrt();
    sum.hypot(root * difference).hypot(root * shear)
}

impl Probe for ShellProbe {
    fn dependence(&self) -> Dependence {
        match self.kind {
            Kind::Strain => Dependence::Nothing,
            Kind::Resultant | Kind::Stress(_) => Dependence::Parameters,
        }
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        let count = match self.kind {
            Kind::Strain | Kind::Resultant => 12,
            Kind::Stress(_) => 4,
        };
        let shell = &history.system.shells()[self.element];
        let factors = match self.kind {
            Kind::Stress(side) => stress_factors(shell, self.element, side)?,
            _ => [Vector12::zeros(); 3],
        };
        Samples::at_each(history, count, |k, row| {
            let states = history.nodes_of(&**shell, k);
            let [strain, resultant] = shell.strain_and_stress(&self.point, &states)?;
            match self.kind {
                Kind::Strain => row.extend(strain.iter()),
                Kind::Resultant => row.extend(resultant.iter()),
                Kind::Stress(_) => {
                    let stress = [0, 1, 2].map(|i| factors[i].dot(&resultant));
                    row.extend(stress);
                    row.push(von_mises(stress));
                }
            }
            Ok(())
        })
    }

    fn vary(
        &self,
        history: &History,
        (component, k): (usize, usize),
        samples: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        let shell = &history.system.shells()[self.element];
        let unit = || Vector12::ith(component, weight);
        let by = match self.kind {
            Kind::Strain => [unit(), Vector12::zeros()],
            Kind::Resultant => [Vector12::zeros(), unit()],
            Kind::Stress(side) if component < 3 => {
                let factors = stress_factors(shell, self.element, side)?;
                [Vector12::zeros(), factors[component] * weight]
            }
            Kind::Stress(side) => {
                let factors = stress_factors(shell, self.element, side)?;
                let [first, second, shear, mises] = [0, 1, 2, 3].map(|i| samples.columns[i][k]);
                let slopes = [first - 0.5 * second, second - 0.5 * first, 3.0 * shear];
                let mut by = Vector12::zeros();
                // Where there is no stress it has no slope; the mean of those around is zero.
                if mises > 0.0 {
                    for (factor, slope) in factors.iter().zip(slopes) {
                        by += factor * (weight * slope / mises);
                    }
                }
                [Vector12::zeros(), by]
            }
        };
        let states = history.nodes_of(&**shell, k);
        shell.vary_strain_and_stress(&self.point, &states, &by, |local, [motion, velocity]| {
            let rows = [motion, velocity, nalgebra::Vector6::zeros()];
            out.add(shell.nodes()[local], k, &rows);
        })
    }
}
