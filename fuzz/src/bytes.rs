//! Choices and numbers that are read off bytes. When these end, all that is read is zero.

/// Bytes that are read from the front.
pub struct Bytes<'a>(pub &'a [u8]);

/// Numbers that arithmetic may stumble over.
const ODD: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    -0.0,
    1e308,
    1e300,
    1e160,
    1e154,
    -1e160,
    1e-160,
    1e-300,
    1e16,
];

impl Bytes<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else {
            return 0;
        };
        self.0 = rest;
        first
    }

    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// One in so many times.
    pub fn rarely(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    /// A number of moderate size, mostly.
    pub fn number(&mut self) -> f64 {
        let byte = self.byte();
        match byte {
            0..=31 => f64::from(byte) - 8.0,
            32..=63 => (f64::from(byte) - 47.0) / 8.0,
            64..=71 => 10f64.powi(i32::from(byte) - 64),
            72..=79 => 10f64.powi(71 - i32::from(byte)),
            250..=255 => ODD[self.below(ODD.len())],
            _ => {
                let fine = f64::from(self.byte()) / 256.0;
                (f64::from(byte - 80) + fine) / 85.0 - 1.0
            }
        }
    }

    /// The same, positive unless it is odd.
    pub fn positive(&mut self) -> f64 {
        match self.number() {
            x if x < 0.0 => -x,
            0.0 if !self.rarely(8) => 1.0,
            x => x,
        }
    }

    pub fn numbers<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.number())
    }

    pub fn positives<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.positive())
    }

    /// The number of one of `count` things, or now and then of none.
    pub fn index(&mut self, count: usize) -> i32 {
        match self.byte() {
            250..=255 => [-1, -2, i32::MAX, i32::MIN, count as i32, 99][self.below(6)],
            byte => (usize::from(byte) % count.max(1)) as i32,
        }
    }

    /// One of so many constants or ids from `first` on, or now and then none.
    pub fn constant(&mut self, first: i32, count: usize) -> i32 {
        match self.index(count) {
            index @ 0.. if (index as usize) < count => first + index,
            other => other,
        }
    }

    /// A vector of length one along an axis, or any.
    pub fn axis(&mut self) -> [f64; 3] {
        let mut axis = [0.0; 3];
        match self.below(8) {
            k @ 0..=5 => axis[k % 3] = 1.0,
            _ => axis = self.numbers(),
        }
        axis
    }
}
