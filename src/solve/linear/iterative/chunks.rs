//! Which harmonics are worked on side by side, and what moves in them.

use super::lanes::LANES;
use std::ops::Range;

/// Harmonics in the order of lanes, one chunk of these after the other.
///
/// Of one blade of several, supports have none but multiples of the number of blades
/// (docs/theory.md, section 8.10). These come first, so that the matrices of most chunks can do
/// without supports.
#[derive(Debug, Clone)]
pub(super) struct Chunks {
    order: Vec<usize>,
    /// Of each harmonic, from the first on.
    places: Vec<usize>,
    first: usize,
    /// Harmonics in which everything moves.
    whole: usize,
}

impl Chunks {
    /// In which everything moves.
    pub fn of_all(harmonics: Range<usize>) -> Self {
        let order: Vec<usize> = harmonics.collect();
        let whole = order.len();
        Self::new(order, whole)
    }

    /// So many harmonics, from 0 on, of one of so many blades.
    pub fn of_one_blade(harmonics: usize, blades: usize) -> Self {
        let is_whole = |harmonic: &usize| harmonic.is_multiple_of(blades);
        let (mut order, others): (Vec<_>, Vec<_>) = (0..harmonics).partition(is_whole);
        let whole = order.len();
        order.extend(others);
        Self::new(order, whole)
    }

    fn new(order: Vec<usize>, whole: usize) -> Self {
        let first = order.iter().copied().min().unwrap_or(0);
        let mut places = vec![0; order.len()];
        for (place, harmonic) in order.iter().enumerate() {
            places[harmonic - first] = place;
        }
        Chunks {
            order,
            places,
            first,
            whole,
        }
    }

    /// Number of chunks.
    pub fn count(&self) -> usize {
        self.order.len().div_ceil(LANES)
    }

    /// Lanes of a chunk and of those after it that have harmonics of their own.
    pub fn used(&self, chunk: usize) -> usize {
        self.order.len() - LANES * chunk
    }

    /// Whether everything moves in some of a chunk's harmonics.
    pub fn is_whole(&self, chunk: usize) -> bool {
        LANES * chunk < self.whole
    }

    /// The harmonic of a lane of a chunk: behind the last it is the last again.
    pub fn harmonic(&self, chunk: usize, lane: usize) -> usize {
        self.order[(LANES * chunk + lane).min(self.order.len() - 1)]
    }

    /// Chunk and lane of a harmonic.
    pub fn place(&self, harmonic: usize) -> (usize, usize) {
        let place = self.places[harmonic - self.first];
        (place / LANES, place % LANES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_harmonic_has_one_place_and_those_of_supports_come_first() {
        for (harmonics, blades) in [(23, 5), (23, 3), (23, 4), (8, 3), (1, 3), (3, 5)] {
            let chunks = Chunks::of_one_blade(harmonics, blades);
            for harmonic in 0..harmonics {
                let (chunk, lane) = chunks.place(harmonic);
                assert_eq!(chunks.harmonic(chunk, lane), harmonic);
                assert!(chunk < chunks.count() && lane < chunks.used(chunk));
                assert!(chunks.is_whole(chunk) || harmonic % blades != 0);
            }
            assert!(chunks.is_whole(0));
        }
        let chunks = Chunks::of_all(5..20);
        for harmonic in 5..20 {
            let (chunk, lane) = chunks.place(harmonic);
            assert_eq!(LANES * chunk + lane, harmonic - 5);
            assert_eq!(chunks.harmonic(chunk, lane), harmonic);
        }
        let last = chunks.count() - 1;
        assert_eq!(chunks.harmonic(last, LANES - 1), 19);
        assert!(chunks.is_whole(last));
    }
}
