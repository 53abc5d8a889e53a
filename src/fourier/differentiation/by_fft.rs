//! Derivatives of grid functions by FFT (docs/theory.md, section 2.2).

use crate::fourier::TimeGrid;
use crate::fourier::transform::{Complex, Plan};

/// `D` and `T`, which are diagonal in harmonics.
#[derive(Debug, Clone)]
pub(super) struct ByFft {
    forward: Plan,
    backward: Plan,
    /// `jΩ / N` and `−(jΩ)² / N` of harmonics 0, 1, and so on up to −1.
    factors: Vec<[f64; 2]>,
    /// Pairs of functions that are not zero everywhere; the last of a group may be alone.
    active: Vec<(usize, Option<usize>)>,
    /// Pairs of functions as complex ones, and others or derivatives of these.
    values: [Vec<Complex<f64>>; 2],
}

impl ByFft {
    pub fn new(grid: TimeGrid) -> Self {
        let (n, omega) = (grid.points(), grid.frequency());
        let size = n as f64;
        let rate = |m: usize| match m <= grid.harmonics() {
            true => m as f64 * omega,
            false => -((n - m) as f64) * omega,
        };
        // What has a cosine alone has no slope at the points.
        let has_slope = |m: usize| f64::from(2 * m != n);
        let factors = (0..n).map(|m| [has_slope(m) * rate(m) / size, -rate(m) * rate(m) / size]);
        ByFft {
            forward: Plan::forward(n),
            backward: Plan::backward(n),
            factors: factors.collect(),
            active: Vec::new(),
            values: Default::default(),
        }
    }

    /// Writes `D X` and `T X`, two real functions at a time, as real and imaginary part of a
    /// complex one: `D` and `T` are real. What is zero everywhere stays so.
    pub fn apply(&mut self, [groups, count]: [usize; 2], x: &[f64], out: [&mut [f64]; 2]) {
        self.find_active([groups, count], &[x]);
        let all = groups * count;
        self.gather(0, all, x);
        let n = self.factors.len();
        let [values, products] = &mut self.values;
        products.resize(values.len(), Complex::default());
        self.forward.transform(values);
        let columns = products.chunks_exact_mut(n).zip(values.chunks_exact_mut(n));
        for (firsts, seconds) in columns {
            let harmonics = firsts.iter_mut().zip(seconds).zip(&self.factors);
            for ((first, second), factors) in harmonics {
                *first = Complex::new(-second.im, second.re) * factors[0];
                *second *= factors[1];
            }
        }
        let [first, second] = out;
        self.scatter(1, all, first);
        self.scatter(0, all, second);
    }

    /// Writes `T Y − D X`.
    pub fn apply_transposed(
        &mut self,
        [groups, count]: [usize; 2],
        [x, y]: [&[f64]; 2],
        sum: &mut [f64],
    ) {
        self.find_active([groups, count], &[x, y]);
        let all = groups * count;
        self.gather(0, all, x);
        self.gather(1, all, y);
        let n = self.factors.len();
        let [xs, ys] = &mut self.values;
        self.forward.transform(xs);
        self.forward.transform(ys);
        for (xs, ys) in xs.chunks_exact(n).zip(ys.chunks_exact_mut(n)) {
            for ((x, y), factors) in xs.iter().zip(ys).zip(&self.factors) {
                *y = *y * factors[1] - Complex::new(-x.im, x.re) * factors[0];
            }
        }
        self.scatter(1, all, sum);
    }

    /// Pairs up what is not zero everywhere in any of these.
    fn find_active(&mut self, [groups, count]: [usize; 2], of: &[&[f64]]) {
        let all = groups * count;
        let is_active = |function: &usize| {
            of.iter().any(|x| {
                let mut values = x[*function..].iter().step_by(all);
                values.any(|x| *x != 0.0)
            })
        };
        self.active.clear();
        for group in 0..groups {
            let mut functions = (group * count..(group + 1) * count).filter(is_active);
            while let Some(first) = functions.next() {
                self.active.push((first, functions.next()));
            }
        }
    }

    /// The functions as complex ones.
    fn gather(&mut self, place: usize, all: usize, x: &[f64]) {
        let n = self.factors.len();
        let values = &mut self.values[place];
        values.resize(n * self.active.len(), Complex::default());
        for (pair, column) in self.active.iter().zip(values.chunks_exact_mut(n)) {
            let points = column.iter_mut().zip(x.chunks_exact(all));
            match *pair {
                (a, Some(b)) => points.for_each(|(z, x)| *z = Complex::new(x[a], x[b])),
                (a, None) => points.for_each(|(z, x)| *z = Complex::new(x[a], 0.0)),
            }
        }
    }

    /// Harmonics back to functions.
    fn scatter(&mut self, place: usize, all: usize, out: &mut [f64]) {
        let n = self.factors.len();
        let values = &mut self.values[place];
        self.backward.transform(values);
        let of_pair = |pair: &(usize, Option<usize>)| 1 + usize::from(pair.1.is_some());
        if self.active.iter().map(of_pair).sum::<usize>() < all {
            out.fill(0.0);
        }
        for (pair, column) in self.active.iter().zip(values.chunks_exact(n)) {
            let points = out.chunks_exact_mut(all).zip(column);
            match *pair {
                (a, Some(b)) => points.for_each(|(y, z)| (y[a], y[b]) = (z.re, z.im)),
                (a, None) => points.for_each(|(y, z)| y[a] = z.re),
            }
        }
    }
}
