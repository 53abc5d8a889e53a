//! A motion over a period, by what it is at the points of a grid (docs/theory.md, section 3).

use super::dual::DualMatrix;
use super::interpolation::DualPolar;
use super::rigid::{Motion, NodeState};
use crate::fourier::{CardinalWeights, Resampling, SpectralFilter, TimeGrid};
use nalgebra::Vector3;

/// Motions at the points of a grid, as dual matrices to be summed with weights.
#[derive(Debug, Clone, Default)]
pub struct PeriodicMotion {
    /// With the mean position taken out.
    motions: Vec<DualMatrix>,
    mean: Vector3<f64>,
}

/// Mean position of motions, which is taken out before they are summed: a translation of
/// everything changes nothing.
pub fn mean_position(motions: &[Motion]) -> Vector3<f64> {
    motions.iter().map(|m| m.position).sum::<Vector3<f64>>() / motions.len() as f64
}

/// Appends motions as dual matrices, with their mean position taken out. Gives that mean.
pub fn append_centred(motions: &[Motion], to: &mut Vec<DualMatrix>) -> Vector3<f64> {
    let mean = mean_position(motions);
    to.extend(motions.iter().map(|m| m.translated(&-mean).to_dual()));
    mean
}

impl PeriodicMotion {
    /// By `motions` at the grid points.
    pub fn new(motions: &[Motion]) -> Self {
        let mut all = PeriodicMotion::default();
        all.set(motions);
        all
    }

    /// Takes other motions.
    pub fn set(&mut self, motions: &[Motion]) {
        self.motions.clear();
        self.mean = append_centred(motions, &mut self.motions);
    }

    /// The same with harmonics weakened by a filter; motions remain motions of rigid bodies.
    pub fn filtered(mut self, grid: TimeGrid, filter: &SpectralFilter) -> Self {
        let mut resampling = Resampling::new(grid, 0.0, grid.points());
        let mut samples = vec![0.0; grid.points()];
        for (part, entry) in DualMatrix::entries() {
            resampling.read(self.motions.iter_mut().map(|m| part(m)[entry]));
            resampling.filter(filter);
            resampling.write(0, 0, &mut samples);
            for (m, sample) in self.motions.iter_mut().zip(&samples) {
                part(m)[entry] = *sample;
            }
        }
        self
    }

    /// Motion, velocity and acceleration at the time of `weights`; `None` if the grid is too
    /// coarse.
    pub fn at(&self, weights: &CardinalWeights) -> Option<NodeState> {
        let mut sums = [DualMatrix::zeros(); 3];
        for (k, m) in self.motions.iter().enumerate() {
            sums[0] += *m * weights.value[k];
            sums[1] += *m * weights.first[k];
            sums[2] += *m * weights.second[k];
        }
        self.state(&sums)
    }

    /// The motion alone at the time of `weights`; `None` if the grid is too coarse.
    pub fn motion_at(&self, weights: &CardinalWeights) -> Option<Motion> {
        let mut sum = DualMatrix::zeros();
        for (m, weight) in self.motions.iter().zip(&weights.value) {
            sum += *m * *weight;
        }
        Some(self.placed(&DualPolar::new(&sum)?))
    }

    /// The motion that was found with the mean position taken out.
    fn placed(&self, polar: &DualPolar) -> Motion {
        let mut motion = polar.motion();
        motion.position += self.mean;
        motion
    }

    /// Writes the sums, with their first and second derivatives, at the points of another grid;
    /// `column` is as long.
    pub fn resample(
        &mut self,
        resampling: &mut Resampling,
        column: &mut [f64],
        sums: &mut [[DualMatrix; 3]],
    ) {
        for (part, entry) in DualMatrix::entries() {
            resampling.read(self.motions.iter_mut().map(|m| part(m)[entry]));
            for order in 0..3 {
                resampling.write(order as u32, 0, column);
                for (sum, value) in sums.iter_mut().zip(&*column) {
                    part(&mut sum[order])[entry] = *value;
                }
            }
        }
    }

    /// Motion, velocity and acceleration, from sums and their derivatives; `None` if the grid is
    /// too coarse.
    pub fn state(&self, [value, first, second]: &[DualMatrix; 3]) -> Option<NodeState> {
        let polar = DualPolar::new(value)?;
        let velocity = polar.velocity(first);
        let acceleration = polar.acceleration(&velocity, first, second);
        Some(NodeState {
            motion: self.placed(&polar),
            twist: velocity.to_twist(),
            twist_rate: acceleration.to_twist(),
        })
    }
}
