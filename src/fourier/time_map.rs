//! Maps of time that bring grid points closer together where a motion is sharp (docs/theory.md,
//! section 2.4).
//!
//! With phases `x = Ωt` of time and `σ = Ωs` of pseudo-time, in which grid points are equispaced,
//!
//! ```text
//! dσ/dx = (1 + Σ A_k P_k(x − x_k)) / (1 + Σ A_k),   P(y) = sinh w / (cosh w − cos y)
//! ```
//!
//! Poisson's kernels have the mean 1 and, for small `w`, the half-width `w`; `σ` is analytic in the
//! strip `|Im x| < min w_k`.

use crate::error::{Error, ErrorKind, Result, require_positive_number};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::ops::{Mul, Sub};

/// When a motion is sharp.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SharpEvent {
    /// Its time.
    pub time: f64,
    /// Time from there to where the additional density of grid points is half as large: about as
    /// long as the event lasts.
    pub width: f64,
    /// Grid points that are there for it, beside those spread equally over the period, which count
    /// as 1.
    pub share: f64,
}

/// What derivatives by time are made of those by pseudo-time with, at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// `1/g'`.
    pub rate: f64,
    /// `g''/g'²`.
    pub bend: f64,
}

impl Slope {
    /// First and second derivatives by time: `f'/g'` and `f''/g'² − f' g''/g'³`.
    pub fn by_time<V>(&self, first: V, second: V) -> [V; 2]
    where
        V: Copy + Mul<f64, Output = V> + Sub<Output = V>,
    {
        let second = (second * self.rate - first * self.bend) * self.rate;
        [first * self.rate, second]
    }

    /// Factors of first and second derivatives by pseudo-time, where these are the factors of
    /// derivatives by time: the transpose of [`Slope::by_time`].
    pub fn transposed<V>(&self, first: V, second: V) -> [V; 2]
    where
        V: Copy + Mul<f64, Output = V> + Sub<Output = V>,
    {
        let first = (first - second * self.bend) * self.rate;
        [first, second * (self.rate * self.rate)]
    }
}

/// Narrowest and widest event, in periods.
const WIDTHS: [f64; 2] = [1e-5, 0.5];
/// Largest share: of a hundred points one would be left for the rest.
const LARGEST_SHARE: f64 = 100.0;
/// Decrease of what is integrated, as a logarithm, that leaves rounding.
const VANISHING: f64 = 40.0;
/// Steps by which an inverse is found at most; by halving alone it would take 60.
const MOST_STEPS: usize = 100;

/// One Poisson kernel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Kernel {
    /// `x_k`, in radians.
    phase: f64,
    /// `w_k`, in radians.
    width: f64,
    /// `A_k`.
    share: f64,
    /// `tanh(w_k / 2)`.
    tangent: f64,
    /// Integral from the middle to time zero.
    start: f64,
}

impl Kernel {
    fn new(phase: f64, width: f64, share: f64) -> Self {
        let tangent = (0.5 * width).tanh();
        let mut kernel = Kernel {
            phase,
            width,
            share,
            tangent,
            start: 0.0,
        };
        kernel.start = kernel.rise(0.0)[0];
        kernel
    }

    /// Integral of the kernel from time zero to `x`, which counts turns, and the kernel there.
    fn rise(&self, x: f64) -> [f64; 2] {
        let y = x - self.phase;
        let turns = (y / TAU).round();
        let (sine, cosine) = (0.5 * (y - TAU * turns)).sin_cos();
        let flat = self.tangent * cosine;
        let integral = TAU * turns + 2.0 * sine.atan2(flat);
        let value = self.tangent / (sine * sine + flat * flat);
        [integral - self.start, value]
    }

    /// The kernel at `x`, and its first two derivatives.
    fn derivatives(&self, x: f64) -> [f64; 3] {
        let (sine, cosine) = (0.5 * (x - self.phase)).sin_cos();
        let flat = self.tangent * cosine;
        let spread = sine * sine + flat * flat;
        let steep = (1.0 - self.tangent * self.tangent) / spread;
        let value = self.tangent / spread;
        let slope = -sine * cosine * steep;
        let bend = 2.0 * slope * slope - 0.5 * (cosine - sine) * (cosine + sine) * steep;
        [value, value * slope, value * bend]
    }
}

/// A map between time and pseudo-time, both counted in periods; of no event, none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeMap {
    kernels: [Kernel; TimeMap::MOST_EVENTS],
    count: usize,
}

impl TimeMap {
    /// Most events there may be.
    pub const MOST_EVENTS: usize = 16;

    /// By events in a period, which repeat themselves; their order is that of `events`.
    ///
    /// # Errors
    /// If there are more than [`Self::MOST_EVENTS`], or one has no finite time, a width that is not
    /// from 1e-5 to half the period, or a share that is not above 0 and at most 100.
    pub fn new(events: &[SharpEvent], period: f64) -> Result<Self> {
        require_positive_number("period", period)?;
        if events.len() > Self::MOST_EVENTS {
            let expected = format!("at most {}", Self::MOST_EVENTS);
            return Err(Error::size("number of events", expected, events.len()));
        }
        let mut map = TimeMap::default();
        for (i, event) in events.iter().enumerate() {
            let invalid = |what: &str, expected: String, got: f64| {
                let message = format!("events[{i}].{what}: expected {expected}, got {got}");
                Err(Error::new(ErrorKind::Value, message))
            };
            if !event.time.is_finite() {
                return invalid("time", "a finite number".into(), event.time);
            }
            let width = event.width / period;
            if !(WIDTHS[0]..=WIDTHS[1]).contains(&width) {
                let [least, most] = WIDTHS.map(|width| width * period);
                let expected = format!("a time from {least:e} to {most:e}, half the period");
                return invalid("width", expected, event.width);
            }
            if !(event.share > 0.0 && event.share <= LARGEST_SHARE) {
                let expected = format!("a number above 0, at most {LARGEST_SHARE}");
                return invalid("share", expected, event.share);
            }
            let turns = event.time / period;
            let phase = TAU * (turns - turns.floor());
            map.kernels[i] = Kernel::new(phase, TAU * width, event.share);
            map.count = i + 1;
        }
        Ok(map)
    }

    /// The events, in a period of this length.
    pub fn events(&self, period: f64) -> Vec<SharpEvent> {
        let event = |kernel: &Kernel| SharpEvent {
            time: kernel.phase / TAU * period,
            width: kernel.width / TAU * period,
            share: kernel.share,
        };
        self.kernels().iter().map(event).collect()
    }

    /// Whether pseudo-time is time.
    pub fn is_identity(&self) -> bool {
        self.count == 0
    }

    fn kernels(&self) -> &[Kernel] {
        &self.kernels[..self.count]
    }

    fn weight(&self) -> f64 {
        1.0 + self.kernels().iter().map(|k| k.share).sum::<f64>()
    }

    /// Equispaced points of pseudo-time that integrate, to rounding, the product of its harmonics
    /// up to this one with those of time.
    ///
    /// Harmonics of time change by at most `1 + Σ A` times as many waves of pseudo-time. Time as a
    /// function of it is analytic up to where `dσ/dx` vanishes: for one narrow event
    /// `Im x = √(2Aw)`, and `Im σ` twice that over the sum of shares.
    pub fn resolving(&self, harmonic: usize) -> usize {
        let weight = self.weight();
        let strip = |k: &Kernel| 2.0 * (2.0 * k.share * k.width).sqrt().min(1.0) / weight;
        let strip = self.kernels().iter().map(strip).fold(1.0, f64::min);
        let waves = 2.0 * harmonic as f64 * (1.0 + weight);
        ((waves + VANISHING / strip) as usize) | 1
    }

    /// Pseudo-time at a time.
    pub fn pseudo(&self, time: f64) -> f64 {
        if self.is_identity() {
            return time;
        }
        let turns = time.floor();
        turns + self.phase_of(TAU * (time - turns))[0] / TAU
    }

    /// `σ(x)`, which vanishes at 0, and its slope.
    fn phase_of(&self, x: f64) -> [f64; 2] {
        let mut sums = [x, 1.0];
        for kernel in self.kernels() {
            let rise = kernel.rise(x);
            sums[0] += kernel.share * rise[0];
            sums[1] += kernel.share * rise[1];
        }
        sums.map(|sum| sum / self.weight())
    }

    /// First to third derivatives of pseudo-time by time, at a time.
    pub fn pseudo_derivatives(&self, time: f64) -> [f64; 3] {
        if self.is_identity() {
            return [1.0, 0.0, 0.0];
        }
        self.derivatives_at(TAU * (time - time.floor()))
    }

    fn derivatives_at(&self, x: f64) -> [f64; 3] {
        let mut sums = [1.0, 0.0, 0.0];
        for kernel in self.kernels() {
            let all = kernel.derivatives(x);
            for (sum, value) in sums.iter_mut().zip(all) {
                *sum += kernel.share * value;
            }
        }
        let weight = self.weight();
        // Counted in periods, each derivative takes a factor of 2π.
        [0, 1, 2].map(|order| sums[order] * TAU.powi(order as i32) / weight)
    }

    /// Time at a pseudo-time.
    pub fn time(&self, pseudo: f64) -> f64 {
        if self.is_identity() {
            return pseudo;
        }
        let turns = pseudo.floor();
        let sigma = TAU * (pseudo - turns);
        turns + self.phase_at(sigma, (0.0, sigma)) / TAU
    }

    /// Times at so many equispaced pseudo-times from 0 on, each from the one before.
    pub fn times(&self, points: usize) -> Vec<f64> {
        let places = (0..points).map(|k| k as f64 / points as f64);
        if self.is_identity() {
            return places.collect();
        }
        let step = TAU / points as f64;
        let mut before = 0.0;
        let time = |pseudo: f64| {
            let guess = before + step / self.phase_of(before)[1];
            before = self.phase_at(TAU * pseudo, (before, guess));
            before / TAU
        };
        places.map(time).collect()
    }

    /// First and second derivative of time by pseudo-time, at a time.
    pub fn time_derivatives(&self, time: f64) -> [f64; 2] {
        let [first, second, _] = self.pseudo_derivatives(time);
        [1.0 / first, -second / (first * first * first)]
    }

    /// The inverse of `σ(x)` over a turn, by Newton's method within bounds: not below `low`, and
    /// perhaps near `guess`.
    fn phase_at(&self, sigma: f64, (mut low, guess): (f64, f64)) -> f64 {
        if sigma <= 0.0 {
            return 0.0;
        }
        let mut high = TAU;
        let mut x = guess.clamp(low, high);
        // What a step of Newton's method leaves is at most its square over four of the least
        // `tanh(w/2)`, as `|σ''| ≤ σ' / (2 tanh(w/2))`.
        let tangents = self.kernels().iter().map(|kernel| kernel.tangent);
        let narrowest = tangents.fold(1.0, f64::min);
        for _ in 0..MOST_STEPS {
            let [phase, slope] = self.phase_of(x);
            let error = phase - sigma;
            if error > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let next = x - error / slope;
            let is_newton = (low..=high).contains(&next);
            let next = if is_newton { next } else { 0.5 * (low + high) };
            let moved = (next - x).abs();
            x = next;
            let left = moved * moved / (4.0 * narrowest);
            if moved <= f64::EPSILON * PI || (is_newton && left <= 0.1 * f64::EPSILON) {
                break;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> TimeMap {
        let event = |time: f64, width: f64, share: f64| SharpEvent { time, width, share };
        let events = [event(0.3, 0.002, 2.0), event(1.99, 0.05, 0.7)];
        TimeMap::new(&events, 2.0).unwrap()
    }

    #[test]
    fn pseudo_time_is_inverted_and_grows_by_a_period_each_period() {
        let map = map();
        assert_eq!((map.pseudo(0.0), map.time(0.0)), (0.0, 0.0));
        for i in -20..=40 {
            let time = 0.0973 * f64::from(i);
            let pseudo = map.pseudo(time);
            assert!((map.pseudo(time + 1.0) - pseudo - 1.0).abs() < 1e-14);
            // Rounding of pseudo-time, where it is steep times as much.
            assert!((map.time(pseudo) - time).abs() < 1e-14);
        }
        let none = TimeMap::default();
        assert!(none.is_identity());
        assert_eq!((none.pseudo(0.37), none.time(-1.2)), (0.37, -1.2));
        assert_eq!(none.time_derivatives(0.4), [1.0, 0.0]);
    }

    #[test]
    fn times_in_a_row_are_those_of_each() {
        for (k, time) in map().times(57).into_iter().enumerate() {
            let alone = map().time(k as f64 / 57.0);
            assert!((time - alone).abs() < 1e-14, "{k}: {time} {alone}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_map() {
        let map = map();
        for time in [0.0, 0.1495, 0.15, 0.1513, 0.5, 0.98, 0.999] {
            let h = 2e-5;
            let at = |i: i32| map.pseudo(time + h * f64::from(i));
            let exact = map.pseudo_derivatives(time);
            let first = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
            let slope =
                |i: i32, order: usize| map.pseudo_derivatives(time + h * f64::from(i))[order];
            let next = |order: usize| {
                let far = slope(2, order) - slope(-2, order);
                (8.0 * (slope(1, order) - slope(-1, order)) - far) / (12.0 * h)
            };
            // Of fourth order, for a width of 1e-3: (h / width)⁴ / 30 times the next factors.
            for (order, (exact, found)) in exact.iter().zip([first, next(0), next(1)]).enumerate() {
                let size = 300.0 * 1e3f64.powi(order as i32);
                assert!(
                    (exact - found).abs() < 1e-5 * size,
                    "{time} {order}: {exact} {found}"
                );
            }
            let [first, second] = map.time_derivatives(time);
            let s = map.pseudo(time);
            let h = 1e-4 * exact[0].min(1.0) + 1e-5;
            let at = |i: i32| map.time(s + h * f64::from(i));
            let slope = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
            assert!((slope - first).abs() < 1e-6, "{time}: {slope} {first}");
            let curve = (at(1) - 2.0 * at(0) + at(-1)) / (h * h);
            assert!(
                (curve - second).abs() < 1e-3 * (1.0 + second.abs()),
                "{curve} {second}"
            );
        }
    }

    #[test]
    fn shares_of_points_are_where_they_are_wanted() {
        // Half of a Poisson kernel is within its half-width, for small ones.
        let map = map();
        let within = map.pseudo(0.151) - map.pseudo(0.149);
        assert!((within - 0.5 * 2.0 / 3.7).abs() < 2e-3, "{within}");
    }

    #[test]
    fn what_is_no_event_is_refused_by_name() {
        let good = SharpEvent {
            time: 0.3,
            width: 0.1,
            share: 1.0,
        };
        let refused = |change: &dyn Fn(&mut SharpEvent), name: &str| {
            let mut bad = good;
            change(&mut bad);
            let error = TimeMap::new(&[good, bad], 2.0).unwrap_err().to_string();
            assert!(error.contains(name), "{error}");
        };
        for value in [f64::NAN, f64::INFINITY] {
            refused(&|e| e.time = value, "events[1].time");
        }
        for value in [0.0, -1.0, 1e-6, 1.01, f64::NAN, f64::INFINITY] {
            refused(&|e| e.width = value, "events[1].width");
        }
        for value in [0.0, -1.0, 101.0, f64::NAN, f64::INFINITY] {
            refused(&|e| e.share = value, "events[1].share");
        }
        assert!(TimeMap::new(&[good; 17], 2.0).is_err());
        assert!(TimeMap::new(&[good], 0.0).is_err());
        let events = [SharpEvent { time: -0.5, ..good }];
        let back = TimeMap::new(&events, 2.0).unwrap().events(2.0)[0];
        assert!((back.time - 1.5).abs() < 1e-15 && (back.width - 0.1).abs() < 1e-15);
    }

    #[test]
    fn narrow_events_take_points_by_the_root_of_share_and_width() {
        // Of one narrow event alone `Im x = √(2Aw)`, and `Im σ` twice that over the weight.
        let points = |width: f64, share: f64| {
            let event = SharpEvent {
                time: 0.5,
                width,
                share,
            };
            TimeMap::new(&[event], 1.0).unwrap().resolving(0) as f64
        };
        for share in [0.25, 0.5, 1.0] {
            for width in [1e-4, 1e-3] {
                let exact = 0.5 * VANISHING * (1.0 + share) / (2.0 * share * TAU * width).sqrt();
                let found = points(width, share);
                assert!(
                    (found / exact - 1.0).abs() < 0.1,
                    "{width} {share}: {found} {exact}"
                );
            }
        }
    }
}
