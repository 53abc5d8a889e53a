//! Random numbers that are the same on every machine.

use nalgebra::{Matrix6, Vector3, Vector6};

pub struct Random(pub u64);

impl Random {
    /// A stream of its own for each list of numbers, well mixed: nearby lists have nothing in
    /// common.
    pub fn of(numbers: &[u64]) -> Self {
        let mix = |x: u64| {
            let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            x ^ (x >> 31)
        };
        let add = |sum: u64, n: &u64| mix(sum.wrapping_add(0x9e37_79b9_7f4a_7c15) ^ mix(*n));
        Random(numbers.iter().fold(0, add))
    }

    pub fn below(&mut self, n: usize) -> usize {
        let next = self.0.wrapping_mul(6364136223846793005);
        self.0 = next.wrapping_add(1442695040888963407);
        ((self.0 >> 33) as usize) % n
    }

    /// From -1 to 1.
    pub fn number(&mut self) -> f64 {
        self.below(2_000_001) as f64 / 1e6 - 1.0
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + 0.5 * (high - low) * (1.0 + self.number())
    }

    /// From `low` to `high`, each decade as likely.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// True in so many of a hundred cases.
    pub fn percent(&mut self, share: usize) -> bool {
        self.below(100) < share
    }

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number())
    }

    /// Symmetric, with eigenvalues from 1/2 to 3/2 times the products of `sizes`.
    pub fn coupled(&mut self, sizes: &Vector6<f64>) -> Matrix6<f64> {
        let half = Matrix6::from_fn(|_, _| self.number() / 24.0);
        let coupling = Matrix6::identity() + half + half.transpose();
        Matrix6::from_fn(|i, j| coupling[(i, j)] * (sizes[i] * sizes[j]).sqrt())
    }
}
