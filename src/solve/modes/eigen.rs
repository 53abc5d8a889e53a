//! Eigenvalues of the quadratic pencil near a shift.
//! See docs/theory.md, section 11.4.

use crate::error::Result;
use crate::memory;
use crate::solve::memory::bytes_of_space;
use crate::solve::modes::krylov::{Map, Ritz, Space};
use crate::solve::modes::pencil::{C64, Inverse, Pencil};

/// Vectors that the space grows from at once: eigenvalues of this multiplicity are found at once.
const BLOCK: usize = 4;
/// Vectors added when all seems found, to find what hides behind equal eigenvalues.
const SECOND_BLOCK: usize = 2;
/// Steps taken with these at least.
const SECOND_STEPS: usize = 16;
/// Relative residual of an eigenvalue that is found.
const CONVERGED: f64 = 1e-13;

/// Units of frequency for the rates in states, over the shift, one after the other until all modes
/// are found. What is far slower than a unit is badly scaled; but of what is far faster, as most
/// motions of thin shells, vectors not yet followed seem to have eigenvalues of the size of the
/// shift over the square of the unit, which hide those sought.
const UNITS: [f64; 2] = [1.0, 32.0];

/// Relative residual of the equations of a mode that needs no polishing.
const ACCURATE: f64 = 1e-14;
/// Distance of the shift for polishing, relative to the eigenvalue.
const NEXT_TO: f64 = 1e-7;
/// Most that polishing may change an eigenvalue, relative to it.
const NEARBY: f64 = 1e-6;
const POLISHING_STEPS: usize = 4;
/// Slower modes than this, relative to the highest frequency, are not told from free motions.
const SLOWEST: f64 = 1e-7;

/// An eigenvalue with its vector of all unknowns.
pub(crate) struct EigenPair {
    pub value: C64,
    pub vector: Vec<C64>,
}

/// Which eigenvalues are sought.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Target {
    /// Those of least size.
    Smallest,
    /// Those nearest to `iω`.
    Near(f64),
}

impl Target {
    /// What is to be small.
    pub fn distance(self, s: C64) -> f64 {
        match self {
            Target::Smallest => s.norm(),
            Target::Near(frequency) => {
                (C64::new(s.re, s.im.abs()) - C64::new(0.0, frequency)).norm()
            }
        }
    }
}

/// The search for eigenvalues of one pencil.
pub(crate) struct Search<'a> {
    pub pencil: &'a Pencil,
    x: Vec<usize>,
    y: Vec<usize>,
    highest: f64,
    /// Inverse at the highest frequency, to make vectors obey the constraints with little loss of
    /// high modes.
    cleaner: Option<Inverse>,
}

/// Eigenvalues found, and whether they are all that were sought.
pub(crate) struct Found {
    pub pairs: Vec<EigenPair>,
    /// Whether the wanted number was found, or there are no more.
    pub complete: bool,
}

impl<'a> Search<'a> {
    pub fn new(pencil: &'a Pencil) -> Result<Self> {
        let (x, y) = pencil.dynamic_unknowns();
        let highest = pencil.highest_frequency();
        let cleaner = Inverse::new(pencil, C64::from(highest))?;
        Ok(Search {
            pencil,
            x,
            y,
            highest,
            cleaner,
        })
    }

    /// About the highest frequency.
    pub fn highest(&self) -> f64 {
        self.highest
    }

    /// Number of unknowns that move against inertia or damping.
    pub fn motions(&self) -> usize {
        self.x.len()
    }

    /// A shift near the lowest frequencies but not zero, so that free motions do no harm.
    pub fn shift_for_smallest(&self) -> Result<f64> {
        let first = 1e-3 * self.highest;
        let mut shift = first;
        while shift > SLOWEST * self.highest {
            let lowest = match Inverse::new(self.pencil, C64::from(shift))? {
                Some(inverse) => self.lowest(&inverse, shift)?,
                None => None,
            };
            // What is slower than the shift is not told apart from there.
            match lowest {
                Some(lowest) if lowest > 2.5 * shift => return Ok(0.314 * lowest),
                Some(lowest) => shift = (0.314 * lowest).min(0.5 * shift),
                None => shift *= 0.1,
            }
        }
        Ok(first)
    }

    /// Roughly the smallest eigenvalue that is not far below the shift, as those of free motions
    /// are, if a few steps show any.
    fn lowest(&self, inverse: &Inverse, shift: f64) -> Result<Option<f64>> {
        let map = self.map(inverse, shift);
        let mut space = self.space()?;
        for _ in 0..10 {
            for _ in 0..6 * BLOCK {
                if space.columns.len() < space.basis.len() {
                    space.grow(&map)?;
                }
            }
            let (values, _) = space.ritz(1e-2)?;
            let lowest = values
                .iter()
                .map(|r| (C64::from(shift) + r.theta.inv()).norm())
                .filter(|s| *s > 0.1 * shift)
                .reduce(f64::min);
            if lowest.is_some() || space.columns.len() == space.basis.len() {
                return Ok(lowest);
            }
        }
        Ok(None)
    }

    fn map<'b>(&'b self, inverse: &'b Inverse, unit: f64) -> Map<'b> {
        Map {
            pencil: self.pencil,
            inverse,
            unit,
            x: &self.x,
            y: &self.y,
        }
    }

    /// A space of random vectors that obey the constraints.
    fn space(&self) -> Result<Space> {
        let mut space = Space::empty();
        self.seed(&mut space, BLOCK)?;
        Ok(space)
    }

    fn seed(&self, space: &mut Space, count: usize) -> Result<bool> {
        let Some(cleaner) = &self.cleaner else {
            return Ok(false);
        };
        let start = self.map(cleaner, self.highest);
        let mut any = false;
        for _ in 0..count {
            any |= space.seed(&start)?;
        }
        Ok(any)
    }

    /// Finds `count` modes or more, if there are: twice as many eigenvalues, as most are conjugate
    /// pairs.
    ///
    /// # Errors
    /// If memory runs out, or numbers overflow.
    pub fn run(&self, target: Target, count: usize) -> Result<Found> {
        let shift = match target {
            Target::Smallest => C64::from(self.shift_for_smallest()?),
            Target::Near(frequency) => C64::new(0.0, frequency),
        };
        // Off an eigenvalue that is hit by chance.
        let mut inverse = None;
        for disturbance in [1.0, 1.003, 0.9917] {
            inverse = Inverse::new(self.pencil, shift * disturbance)?;
            if inverse.is_some() {
                break;
            }
        }
        let Some(inverse) = inverse else {
            return Ok(Found {
                pairs: Vec::new(),
                complete: false,
            });
        };
        let mut best: Option<Found> = None;
        for unit in UNITS {
            let found = self.run_with(&inverse, unit * shift.norm(), (target, count))?;
            if found.complete {
                return Ok(found);
            }
            if best
                .as_ref()
                .is_none_or(|b| b.pairs.len() < found.pairs.len())
            {
                best = Some(found);
            }
        }
        Ok(best.unwrap_or(Found {
            pairs: Vec::new(),
            complete: false,
        }))
    }

    /// The same about one shift, with a unit of frequency.
    fn run_with(
        &self,
        inverse: &Inverse,
        unit: f64,
        (target, count): (Target, usize),
    ) -> Result<Found> {
        let map = self.map(inverse, unit);
        let mut space = self.space()?;
        let most = (240 + 12 * count).min(self.x.len() + self.y.len());
        let (mut next_check, mut verified_at) = (3 * BLOCK, None);
        loop {
            let exhausted =
                space.columns.len() == space.basis.len() && !self.seed(&mut space, SECOND_BLOCK)?;
            let size = space.columns.len();
            if size >= next_check || exhausted || size >= most {
                // Until it is looked at again.
                let length = self.x.len() + self.y.len();
                let bytes = bytes_of_space(size + (size / 4).max(BLOCK), length);
                memory::require("the space that modes are found in", bytes)?;
                let found = self.found(&map, &space, target, exhausted)?;
                let enough = found.len() >= 2 * count;
                if exhausted || size >= most {
                    let complete = exhausted || enough;
                    return self.pairs(&map, &space, found, complete);
                }
                match (enough, verified_at) {
                    (true, None) => {
                        self.seed(&mut space, SECOND_BLOCK)?;
                        verified_at = Some(size + SECOND_STEPS);
                    }
                    (true, Some(at)) if size >= at => {
                        return self.pairs(&map, &space, found, true);
                    }
                    _ => {}
                }
                next_check = size + (size / 4).max(BLOCK);
            }
            if !exhausted {
                space.grow(&map)?;
            }
        }
    }

    /// Converged eigenvalues that nothing nearer to the target can precede, nearest first; both of
    /// each conjugate pair.
    fn found(
        &self,
        map: &Map,
        space: &Space,
        target: Target,
        exhausted: bool,
    ) -> Result<Vec<(C64, Vec<C64>)>> {
        // What is not converged is no larger than `open`.
        let most = if exhausted { f64::INFINITY } else { CONVERGED };
        let (mut candidates, open) = space.ritz(most)?;
        candidates.retain(|ritz| ritz.residual <= CONVERGED);
        let sigma = map.inverse.shift();
        let mut found = Vec::new();
        for ritz in candidates {
            let s = self.eigenvalue(map, space, &ritz);
            let distance = target.distance(s);
            let safe = match target {
                Target::Smallest => distance <= 1.0 / open - sigma.norm(),
                Target::Near(frequency) => {
                    distance >= frequency
                        || 0.5 * (1.0 / distance - 1.0 / (2.0 * frequency - distance)) >= open
                }
            };
            // Constraints are infinitely far.
            let finite = s.norm() < 1e3 * self.highest;
            if (safe || open == 0.0) && finite {
                found.push((s, ritz.y));
            }
        }
        found.sort_by(|a, b| target.distance(a.0).total_cmp(&target.distance(b.0)));
        Ok(found)
    }

    /// `s` from `θ`.
    fn eigenvalue(&self, map: &Map, space: &Space, ritz: &Ritz) -> C64 {
        let sigma = map.inverse.shift();
        if sigma.im == 0.0 {
            return sigma + ritz.theta.inv();
        }
        // θ s² − (2θ Re σ + 1) s + θ|σ|² + Re σ = 0; of its roots that which y = s x / ω tells.
        let z = space.combine(&ritz.y);
        let (zx, zy) = z.split_at(self.x.len());
        let (mut product, mut square) = (C64::default(), 0.0);
        let mut at = 0;
        for (&i, y) in self.y.iter().zip(zy) {
            while self.x[at] != i {
                at += 1;
            }
            product += zx[at].conj() * y;
            square += zx[at].norm_sqr();
        }
        let rough = product * map.unit / square;
        let theta = ritz.theta;
        let half = theta * sigma.re + 0.5;
        let root = (half * half - theta * (theta * sigma.norm_sqr() + sigma.re)).sqrt();
        let roots = [(half + root) / theta, (half - root) / theta];
        if !rough.norm().is_finite() || (roots[0] - rough).norm() < (roots[1] - rough).norm() {
            roots[0]
        } else {
            roots[1]
        }
    }

    /// Eigenvectors of what was found, one of each conjugate pair.
    fn pairs(
        &self,
        map: &Map,
        space: &Space,
        found: Vec<(C64, Vec<C64>)>,
        complete: bool,
    ) -> Result<Found> {
        let mut pairs = Vec::new();
        for (value, y) in found.into_iter().filter(|(value, _)| value.im >= 0.0) {
            let state = space.combine(&y);
            let (u, _) = map.image(&state)?;
            let mut pair = Candidate::new(self.pencil, value, u);
            if pair.residual > ACCURATE {
                pair = self.polished(pair)?;
            }
            pairs.push(EigenPair {
                value: pair.value,
                vector: pair.vector,
            });
        }
        Ok(Found { pairs, complete })
    }

    /// The pair after inverse iteration at a shift next to it.
    ///
    /// The common shift enlarges what a vector has of modes that are nearer to it.
    fn polished(&self, start: Candidate) -> Result<Candidate> {
        let shift = start.value * (1.0 + NEXT_TO);
        let Some(inverse) = Inverse::new(self.pencil, shift)? else {
            return Ok(start);
        };
        let map = self.map(&inverse, shift.norm());
        // The state in the unit of this map.
        let x = self.x.iter().map(|&i| start.vector[i]);
        let y = self
            .y
            .iter()
            .map(|&i| start.vector[i] * start.value / map.unit);
        let mut state: Vec<C64> = x.chain(y).collect();
        let first = start.value;
        let mut best = start;
        for _ in 0..POLISHING_STEPS {
            let (u, next) = map.image(&state)?;
            let square = state.iter().map(|z| z.norm_sqr()).sum::<f64>();
            let product: C64 = state.iter().zip(&next).map(|(z, n)| z.conj() * n).sum();
            let value = shift + C64::from(square) / product;
            let pair = Candidate::new(self.pencil, value, u);
            // Written so that NaN ends it.
            let nearby = (value - first).norm() <= NEARBY * first.norm();
            if !(nearby && pair.residual < best.residual) {
                break;
            }
            best = pair;
            if best.residual <= ACCURATE {
                break;
            }
            let size = next.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
            state = next.iter().map(|z| z / size).collect();
        }
        Ok(best)
    }
}

/// A pair with what it leaves of the equations.
struct Candidate {
    value: C64,
    vector: Vec<C64>,
    residual: f64,
}

impl Candidate {
    fn new(pencil: &Pencil, value: C64, mut vector: Vec<C64>) -> Self {
        let largest = vector.iter().fold(0.0, |m: f64, x| m.max(x.norm()));
        vector.iter_mut().for_each(|x| *x /= largest);
        Candidate {
            residual: pencil.relative_residual(value, &vector),
            value,
            vector,
        }
    }
}
