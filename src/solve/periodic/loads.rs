//! Harmonics of loads and prescribed motions, and those that a grid cannot hold: it takes them for
//! lower ones. See docs/theory.md, section 10.3.

use crate::error::Result;
use crate::fourier::PeriodicSeries;
use crate::system::System;
use std::f64::consts::TAU;

/// The harmonics of one signal.
#[derive(Debug)]
struct Spectrum {
    series: PeriodicSeries,
    /// Amplitude of each harmonic, from 1, relative to the signal's size.
    amplitudes: Vec<f64>,
    /// Sum of what motions owe to each harmonic and all above it, relative to what they owe to all:
    /// to a motion that is prescribed its amplitude, to a load its amplitude over the square of its
    /// number, as inertia has it. From harmonic 1; ends with zero.
    remaining: Vec<f64>,
}

/// The harmonics of everything that drives a system.
#[derive(Debug)]
pub(crate) struct Loads {
    spectra: Vec<Spectrum>,
}

/// Functions are looked at at so many times as many times as a grid has points.
const SAMPLED: usize = 4;
/// Relative amplitudes that are rounding.
const ROUNDING: f64 = 1e-13;
/// Share of the motions that the first grid may do without.
const SHARE: f64 = 0.05;

impl Spectrum {
    fn new(series: PeriodicSeries, prescribed: bool) -> Self {
        let pairs = series.cosines.iter().zip(&series.sines);
        let mut amplitudes: Vec<f64> = pairs.map(|(c, s)| c.hypot(*s)).collect();
        let steady = series.mean.abs() + series.rate.abs() * series.period();
        let size = amplitudes.iter().fold(steady, |most, a| most.max(*a));
        for amplitude in &mut amplitudes {
            *amplitude /= if size > 0.0 { size } else { 1.0 };
            if *amplitude < ROUNDING {
                *amplitude = 0.0;
            }
        }
        let mut remaining = vec![0.0; amplitudes.len() + 1];
        for (j, amplitude) in amplitudes.iter().enumerate().rev() {
            let harmonic = (j + 1) as f64;
            let weight = if prescribed { 1.0 } else { harmonic * harmonic };
            remaining[j] = remaining[j + 1] + amplitude / weight;
        }
        let total = remaining[0] + if size > 0.0 { steady / size } else { 0.0 };
        if total > 0.0 {
            remaining.iter_mut().for_each(|sum| *sum /= total);
        }
        Spectrum {
            series,
            amplitudes,
            remaining,
        }
    }

    /// Of the harmonics above `harmonics`.
    fn above(&self, harmonics: usize) -> f64 {
        self.remaining.get(harmonics).copied().unwrap_or(0.0)
    }

    /// The fewest harmonics above which no more than `share` remains.
    fn enough(&self, share: f64) -> usize {
        self.remaining.partition_point(|sum| *sum > share)
    }
}

impl Loads {
    /// Samples that are taken of functions, at most, for a grid of so many points.
    pub fn samples(system: &System, points: usize) -> usize {
        system.function_signals().saturating_mul(SAMPLED * points)
    }

    /// Of `system`, whose functions are looked at for as many harmonics as twice the `points` of a
    /// grid have.
    pub fn of(system: &System, points: usize) -> Result<Self> {
        let prescribed = system.prescribed_measures().count();
        let spectra = system
            .spectra(SAMPLED * points + 1)?
            .into_iter()
            .enumerate();
        let spectra = spectra.map(|(i, series)| Spectrum::new(series, i < prescribed));
        Ok(Loads {
            spectra: spectra.collect(),
        })
    }

    /// Harmonics that motions owe most to, of those up to `most`.
    pub fn essential(&self, most: usize) -> usize {
        let of = |spectrum: &Spectrum| {
            // What no grid holds does not ask for a fine one.
            let share = SHARE * (1.0 - spectrum.above(most)) + spectrum.above(most);
            spectrum.enough(share)
        };
        self.spectra.iter().map(of).max().unwrap_or(0).min(most)
    }

    /// Whether anything has harmonics above these.
    pub fn has_above(&self, harmonics: usize) -> bool {
        self.spectra.iter().any(|s| s.above(harmonics) > 0.0)
    }

    /// Of all that have harmonics above these: the signal that needs most, and up to which
    /// harmonic, to leave the `fraction` of what motions owe to them.
    pub fn needed(&self, harmonics: usize, fraction: f64) -> Option<(usize, usize)> {
        let above = self.spectra.iter().map(|s| s.above(harmonics));
        let most = above.fold(0.0, f64::max);
        let needs = self.spectra.iter().map(|s| s.enough(fraction * most));
        let (signal, needed) = needs.enumerate().max_by_key(|(_, needed)| *needed)?;
        (needed > harmonics).then_some((signal, needed))
    }

    /// Part of all signals at `time` that is above these harmonics.
    pub fn rest(&self, time: f64, harmonics: usize, values: &mut [f64]) {
        for (value, spectrum) in values.iter_mut().zip(&self.spectra) {
            *value = 0.0;
            let phase = TAU * (time / spectrum.series.period()).fract();
            for (j, amplitude) in spectrum.amplitudes.iter().enumerate().skip(harmonics) {
                if *amplitude > 0.0 {
                    let (sin, cos) = ((j + 1) as f64 * phase).sin_cos();
                    *value += spectrum.series.cosines[j] * cos + spectrum.series.sines[j] * sin;
                }
            }
        }
    }

    /// The `count` strongest harmonics above these, and the part of what motions owe to those above
    /// that they stand for.
    pub fn strongest(&self, harmonics: usize, count: usize) -> (Vec<usize>, f64) {
        let last = self.spectra.iter().map(|s| s.amplitudes.len()).max();
        let strength = |j: usize, of: &dyn Fn(&Spectrum) -> f64| {
            let having = self.spectra.iter().filter(|s| j <= s.amplitudes.len());
            having.map(of).fold(0.0, f64::max)
        };
        let mut found: Vec<(usize, f64, f64)> = (harmonics + 1..=last.unwrap_or(0))
            .map(|j| {
                let amplitude = strength(j, &|s| s.amplitudes[j - 1]);
                let share = strength(j, &|s| s.remaining[j - 1] - s.remaining[j]);
                (j, amplitude, share)
            })
            .filter(|(_, amplitude, _)| *amplitude > 0.0)
            .collect();
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        let sum = |found: &[(usize, f64, f64)]| found.iter().map(|(_, _, s)| s).sum::<f64>();
        let all = sum(&found);
        found.truncate(count);
        let part = if all > 0.0 { sum(&found) / all } else { 1.0 };
        (found.into_iter().map(|(j, _, _)| j).collect(), part)
    }

    /// Adds to the values of all signals the cosine that they have of harmonic `j`, and to others
    /// of all the sine.
    pub fn add_wave(&self, j: usize, cosines: &mut [f64], sines: &mut [f64]) {
        for ((cosine, sine), spectrum) in cosines.iter_mut().zip(sines).zip(&self.spectra) {
            if spectrum.amplitudes.get(j - 1).is_some_and(|a| *a > 0.0) {
                *cosine += spectrum.series.cosines[j - 1];
                *sine += spectrum.series.sines[j - 1];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loads(cosines: &[f64], prescribed: bool) -> Loads {
        let sines = vec![0.0; cosines.len()];
        let series = PeriodicSeries::new(2.0, 0.0, 0.0, cosines.to_vec(), sines);
        Loads {
            spectra: vec![Spectrum::new(series, prescribed)],
        }
    }

    #[test]
    fn what_is_needed_goes_with_inertia_or_with_the_motion_itself() {
        let one = loads(&[0.0, 0.0, 0.0, 2.0], false);
        assert_eq!(one.essential(10), 4);
        // None that no grid holds.
        assert_eq!(one.essential(3), 0);
        assert!(one.has_above(3) && !one.has_above(4));
        assert_eq!(one.needed(2, 0.1), Some((0, 4)));
        assert_eq!(one.needed(4, 0.1), None);
        // 1, 1/4, 1/9, 1/16 of 1.42: a twentieth is above the third.
        assert_eq!(loads(&[1.0; 4], false).essential(10), 3);
        assert_eq!(loads(&[1.0; 4], true).essential(10), 4);
        let (strongest, part) = loads(&[1.0, 0.5, 0.0, 1.0, 1e-15], false).strongest(1, 1);
        assert_eq!(strongest, [4]);
        assert!((part - 0.0625 / (0.125 + 0.0625)).abs() < 1e-14);
    }

    #[test]
    fn the_rest_is_the_signal_without_its_low_harmonics() {
        let loads = loads(&[3.0, 0.5, 0.25], false);
        let mut rest = [0.0];
        loads.rest(0.3, 1, &mut rest);
        let phase = TAU * 0.15;
        let exact = 0.5 * (2.0 * phase).cos() + 0.25 * (3.0 * phase).cos();
        assert!((rest[0] - exact).abs() < 1e-15);
    }
}
