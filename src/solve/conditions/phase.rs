//! What tells the time of a motion that nothing else tells.

use super::{Condition, InnerProduct};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The motion is not ahead of that which the solve starts from: in the mean over the period it is
/// away from it across its course only.
#[derive(Debug, Clone, Copy, Default)]
pub struct Phase;

/// A course below this is none, relative to the size of the mechanism, or in radians.
const STANDSTILL: f64 = 1e-9;

impl Phase {
    const NAME: &'static str = "the phase";
}

/// Of a condition that is one relative to the start.
pub(super) fn unknown_start(condition: &dyn Condition) -> Error {
    let message = format!(
        "{}: expected a solve that tells where it starts",
        condition.name()
    );
    Error::new(ErrorKind::Value, message)
}

impl Condition for Phase {
    fn name(&self) -> String {
        Phase::NAME.into()
    }

    fn scale(&self, _: &Collocation) -> f64 {
        1.0
    }

    fn value(&self, _: &Collocation, _: &GridState) -> Result<f64> {
        Err(unknown_start(self))
    }

    fn gradient(&self, _: &Collocation, _: &GridState, _: &mut [f64]) -> Result<()> {
        Err(unknown_start(self))
    }

    fn at_start(
        &self,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Arc<dyn Condition>>> {
        let frequency = TAU / equations.grid().period();
        let states = equations.node_states().iter();
        let course = states
            .flat_map(|s| (s.twist / frequency).data.0[0])
            .collect::<Vec<f64>>();
        let why = "the motion that the solve starts from stands still, so that nothing tells its \
                   phase: expected one that moves";
        let along = PhaseAlong::new(equations, state, Phase::NAME, &course);
        let along = along.ok_or_else(|| {
            let message = format!("{}: {why}", Phase::NAME);
            Error::new(ErrorKind::Value, message)
        })?;
        Ok(Some(Arc::new(along)))
    }
}

/// How far a motion is along a course from another one.
#[derive(Debug)]
pub(super) struct PhaseAlong {
    name: String,
    from: GridState,
    /// The course's twists for a unit, over their square.
    course: Vec<f64>,
}

impl PhaseAlong {
    /// Along `course`, material increments of all motions, from the state `from`; none if it leads
    /// nowhere.
    pub fn new(
        equations: &Collocation,
        from: &GridState,
        name: &str,
        course: &[f64],
    ) -> Option<Self> {
        let product = InnerProduct::new(equations, 1.0);
        let square = product.of(equations.layout(), course, course);
        // Written so that NaN is none either.
        (square.sqrt() > STANDSTILL).then(|| PhaseAlong {
            name: name.into(),
            from: from.clone(),
            course: course.iter().map(|x| x / square).collect(),
        })
    }
}

impl Condition for PhaseAlong {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn scale(&self, _: &Collocation) -> f64 {
        1.0
    }

    fn value(&self, equations: &Collocation, state: &GridState) -> Result<f64> {
        let product = InnerProduct::new(equations, 1.0);
        Ok(product.along(equations.layout(), &self.course, &self.from, state))
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        let product = InnerProduct::new(equations, 1.0);
        let states = (&self.from, state);
        let (motions, _) = row.split_at_mut(equations.layout().motions().end);
        product.add_gradient(equations.layout(), &self.course, states, motions);
        Ok(())
    }
}
