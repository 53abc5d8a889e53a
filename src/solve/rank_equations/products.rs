//! Products of the linearised equations and vectors of a rank.

use super::RankEquations;
use crate::error::{Error, Result};

impl RankEquations {
    /// Writes the product of the scaled Jacobian and `x`. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, or numbers cannot be told.
    pub fn product(&mut self, x: &[f64], out: &mut [f64]) -> Result<()> {
        self.spread_out(x, out)?;
        self.tangent.apply(&self.equations, &self.x, &mut self.y);
        Self::take(&self.owned, &self.y, out);
        Ok(())
    }

    /// Writes the product of the transposed scaled Jacobian and `x`. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, or numbers cannot be told.
    pub fn transposed_product(&mut self, x: &[f64], out: &mut [f64]) -> Result<()> {
        self.spread_out(x, out)?;
        self.tangent
            .apply_transposed(&self.equations, &self.x, &mut self.y);
        Self::take(&self.owned, &self.y, out);
        Ok(())
    }

    /// Writes the product of `x` and what multiplies `μ^power`, 1 or 2, in the scaled Jacobian for
    /// disturbances `exp(μt) Δu`, whose exponents are the `μ` where it is singular. By all ranks.
    ///
    /// # Errors
    /// If sizes or the power do not fit, or numbers cannot be told.
    pub fn power_product(&mut self, power: usize, x: &[f64], out: &mut [f64]) -> Result<()> {
        if power != 1 && power != 2 {
            return Err(Error::value("power", "1 or 2", power));
        }
        self.spread_out(x, out)?;
        // The residual may have been asked for elsewhere.
        self.equations.update_kinematics(&self.base);
        self.tangent
            .apply_power(&self.equations, power, &self.x, &mut self.y);
        Self::take(&self.owned, &self.y, out);
        Ok(())
    }

    /// Puts a vector of the rank to its places in that of its part, with its halo.
    fn spread_out(&mut self, x: &[f64], out: &[f64]) -> Result<()> {
        self.require_linear()?;
        self.require_length("x", x.len())?;
        self.require_length("out", out.len())?;
        self.put(x);
        self.halo.fill(&*self.ranks, &mut self.x)
    }
}
