//! Solves by iteration: with what preconditions, until none is left that does, and with what solves
//! before have found. See docs/theory.md, section 8.3.

use super::factors::Factors;
use super::first_part::FirstPart;
use super::gmres::GmresEnd;
use super::learnt::Learnt;
use super::operator::{Eliminated, Operator, is_solved};
use super::{GmresOptions, Iterative, KEPT, Parts, Preconditioner, RESTART, ROUGH, gmres};
use crate::collocation::Collocation;
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::report::Timings;
use std::time::Instant;

/// A solve that takes so many products more than the first with its preconditioner asks for a new
/// one.
const MANY: usize = 10;
/// Products of a solve from which those after it may learn, and how many times as many as theirs it
/// is to have taken, or it is forgotten.
const LONG: usize = 25;
const LITTLE: usize = 2;

impl Iterative {
    /// Solves the equations, or those between borders.
    pub(super) fn iterate(
        &mut self,
        (equations, borders): (&mut Collocation, Option<&Borders>),
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let size = equations.size();
        loop {
            let began = Instant::now();
            let Some(mut unknowns) = self.unknowns(rhs, size) else {
                return Ok(false);
            };
            let learnt = self.learnt.as_ref().map_or(0, Learnt::products);
            let end = self.iterate_once((equations, borders), &mut unknowns, accuracy)?;
            timings.substitution += began.elapsed();
            equations.workers().pulse()?;
            let Some(end) = end else {
                return Ok(false);
            };
            let solved = is_solved(&end, accuracy, equations);
            let first = *self.first_products.get_or_insert(end.iterations);
            self.learn(solved, end.iterations, unknowns.len());
            if solved {
                let scalars = rhs.len() - size;
                match &self.first_part {
                    Some(first_part) => {
                        unknowns.truncate(first_part.size);
                        first_part.write_unknowns(equations, &unknowns, rhs);
                    }
                    None => {
                        rhs[..size].copy_from_slice(&unknowns[..size]);
                        rhs[size..].copy_from_slice(&unknowns[unknowns.len() - scalars..]);
                    }
                }
                if self.is_old && end.iterations > first + MANY {
                    self.prepare(equations, timings)?;
                }
                return Ok(rhs.iter().all(|x| x.is_finite()));
            }
            // First without what was learnt elsewhere.
            if learnt > 0 {
                continue;
            }
            self.note_failure(end.error);
            if self.candidates.is_empty() || !self.prepare(equations, timings)? {
                return Ok(false);
            }
        }
    }

    /// The right side with room for stress resultants, if they are unknowns with the factors,
    /// between the grid's entries and those of scalars; none without factors.
    fn unknowns(&mut self, rhs: &[f64], size: usize) -> Option<Vec<f64>> {
        let factors = self.factors.as_mut()?;
        let resultants = match factors {
            Factors::Body(_) => self.tangent.resultants(),
            Factors::Local(_) => 0,
        };
        let (of_grid, scalars) = rhs.split_at(size);
        let mut unknowns = Vec::with_capacity(rhs.len() + resultants);
        unknowns.extend_from_slice(of_grid);
        unknowns.resize(size + resultants, 0.0);
        if !self.is_scaled {
            factors.scale_resultants(&mut self.tangent, &unknowns, size);
            self.is_scaled = true;
            self.eliminated = None;
            self.learnt = None;
        }
        if let Some(first_part) = &self.first_part {
            unknowns = first_part.gathered(&unknowns);
        }
        unknowns.extend_from_slice(scalars);
        let learnt = self.learnt.take();
        self.learnt = learnt.filter(|learnt| learnt.is_of(unknowns.len()));
        Some(unknowns)
    }

    /// Iterates with the factors that there are, from right side to solution in place; none if they
    /// cannot be had of the borders.
    fn iterate_once(
        &mut self,
        (equations, borders): (&Collocation, Option<&Borders>),
        unknowns: &mut [f64],
        accuracy: f64,
    ) -> Result<Option<GmresEnd>> {
        let Some(factors) = &mut self.factors else {
            return Ok(None);
        };
        if let (Some(borders), None) = (borders, &self.eliminated) {
            let of_grid = unknowns.len() - borders.count();
            self.eliminated = Eliminated::new(borders, factors, of_grid);
        }
        let borders = match (borders, &self.eliminated) {
            (Some(_), None) => return Ok(None),
            (Some(borders), Some(eliminated)) => Some((borders, eliminated)),
            (None, _) => None,
        };
        let learnt = self.learnt.as_ref();
        let kept = learnt.map_or(0, Learnt::products);
        let (leading, essential) = match &self.first_part {
            Some(first_part) => (first_part.motions, first_part.size),
            None => (equations.layout().motions().end, equations.size()),
        };
        let options = GmresOptions {
            tolerance: accuracy,
            leading,
            iteration_limit: self.limit,
            essential,
            parts: Parts::of(self.slenderness, accuracy),
            restart: (KEPT / size_of_val(unknowns))
                .saturating_sub(kept)
                .clamp(RESTART, self.limit.max(RESTART)),
            is_verified: accuracy < self.verified,
        };
        let mut operator = Operator {
            equations,
            tangent: &mut self.tangent,
            factors,
            first_part: self.first_part.as_mut(),
            borders,
            learnt,
        };
        let (workers, workspace) = (equations.workers(), &mut self.workspace);
        let end = gmres(&mut operator, unknowns, &options, workers, workspace)?;
        if options.is_verified && end.error <= accuracy {
            self.verified = self.verified.min(end.error);
        }
        self.record.products.push(end.iterations);
        self.count_bytes(kept + end.iterations.min(options.restart), unknowns.len());
        Ok(Some(end))
    }

    /// Keeps what a long solve has found, and forgets it once it no longer helps.
    fn learn(&mut self, solved: bool, products: usize, entries: usize) {
        match &self.learnt {
            None if solved && products >= LONG => self.learnt = self.workspace.learnt(entries),
            Some(learnt) if !solved || LITTLE * products > learnt.products() => self.learnt = None,
            _ => {}
        }
    }

    /// Leaves out what has failed with this error: none is left where it failed before.
    fn note_failure(&mut self, error: f64) {
        if !self.is_old
            && let Some(&failed) = self.candidates.first()
        {
            self.candidates.retain(|other| *other != failed);
            let far = error > ROUGH;
            self.fails_locally |= failed.0 == Preconditioner::TimeLocal && far;
        }
    }

    /// Counts what so many vectors of that size take beside all else.
    pub(super) fn count_bytes(&mut self, vectors: usize, size: usize) {
        let factors = self.factors.as_ref().map_or(0, Factors::bytes);
        let entries = (vectors + 4) * size + self.first_part.as_ref().map_or(0, FirstPart::entries);
        let bytes = self.tangent.bytes() + factors + entries * size_of::<f64>();
        self.record.bytes = self.record.bytes.max(bytes);
    }
}
