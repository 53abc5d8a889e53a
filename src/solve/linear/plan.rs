//! Which solver is to solve Newton's linear equations. See docs/theory.md, section 8.7.

use crate::collocation::Collocation;
use crate::solve::linear::cost::{AFFORDABLE, DirectCost, iteration_bytes, tangent_bytes};
use crate::solve::linear::freedoms::FreedomSolver;
use crate::solve::linear::iterative::{ITERATION_LIMIT, LARGEST_ITERATION_LIMIT, Preconditioner};
use crate::solve::linear::like_blades::OfLikeBlades;
use crate::work::PRODUCT;

/// How linear equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinearMethod {
    /// Directly where that is cheap, by iteration otherwise.
    #[default]
    Automatic,
    /// By factors of the whole Jacobian.
    Direct,
    /// By iteration, with the preconditioner that suits, or with this one.
    Iterative(Option<Preconditioner>),
}

/// Factors that take more than this, in bytes, are avoided.
pub(super) const LARGE: f64 = 1.5e9;
/// Factors that take more than this are not tried, even where iteration fails.
const TOO_LARGE: f64 = 6e9;
/// Multiply-adds that take as long as a value of the Jacobian does to be assembled.
const VALUE: f64 = 50.0;
/// The same of few freedoms, all in all: a few seconds. Turning joints have as many in the dense
/// system that iteration solves.
const AFFORDABLE_FREEDOMS: f64 = 1e10;
/// Factors with pivots that wait take more than was planned, by so much.
pub(super) const DELAYED: f64 = 1.2;
/// Products of a linear solve on a mapped grid after which factors are tried instead, and more if
/// these take longer: preconditioners that average over time are good there, or not at all.
const LIMIT_IF_MAPPED: usize = 40;
/// Products after which iteration takes longer at a point of a branch than factors that are made
/// anew for each of its solutions.
const OF_POINT: usize = 70;
/// Factors of parts that do not act on each other take so many times less at best, of two.
const TWO_PARTS: usize = 4;
/// Multiply-adds of dense kernels that take as long as one of those that products are counted by.
const DENSE: usize = 12;
/// So few numbers are not worth the trouble.
pub(super) const SMALL: f64 = 1500.0;

/// Which solver it is to be.
pub(super) enum Choice {
    /// Factors of the whole Jacobian, or of few freedoms.
    Direct,
    /// Factors of what is left of one blade.
    LikeBlades(Box<OfLikeBlades>),
    /// Iteration alone.
    Iterative(Option<Preconditioner>),
    /// Iteration, which gives up for factors of so many multiply-adds after so many products.
    IterativeFirst { work: f64, limit: usize },
}

/// What is going to solve some equations.
pub(crate) struct Plan {
    pub(super) choice: Choice,
    pub(super) method: LinearMethod,
    pub(super) falls_back: bool,
    pub(super) most_products: usize,
    /// What factors of the whole Jacobian would take.
    pub(super) cost: DirectCost,
    /// Bytes of it, at most about; of iteration without a system of joints that turn.
    pub bytes: f64,
}

impl Plan {
    /// For `equations`, as `method` says, with at most so many bytes where it says nothing.
    pub fn of(equations: &Collocation, method: LinearMethod, most_bytes: f64) -> Self {
        let cost = DirectCost::of(equations.system(), equations.grid().points());
        Self::of_cost(equations, method, (most_bytes, cost))
    }

    /// The same where it is known what factors of the whole Jacobian take.
    pub(super) fn of_cost(
        equations: &Collocation,
        method: LinearMethod,
        (most_bytes, cost): (f64, DirectCost),
    ) -> Self {
        let (system, points) = (equations.system(), equations.grid().points());
        let mut falls_back = false;
        let mut most_products = usize::MAX;
        let choice = match method {
            LinearMethod::Direct => Choice::Direct,
            LinearMethod::Iterative(preconditioner) => Choice::Iterative(preconditioner),
            LinearMethod::Automatic => {
                let (large, too_large) = (LARGE.min(most_bytes), TOO_LARGE.min(most_bytes));
                falls_back = cost.bytes < too_large;
                let numbers = equations.layout().motions().len() as f64;
                let products = (cost.work / (PRODUCT * numbers)) as usize;
                most_products = products_of(cost, numbers);
                let cheap = numbers < SMALL || cost.work < AFFORDABLE * numbers;
                let few_freedoms = || {
                    let work = FreedomSolver::work(equations);
                    work.is_some_and(|work| work < AFFORDABLE_FREEDOMS)
                };
                if cost.bytes < large && cheap || falls_back && few_freedoms() {
                    Choice::Direct
                } else if falls_back {
                    let limit = match equations.grid().map().is_identity() {
                        true => products.clamp(ITERATION_LIMIT, LARGEST_ITERATION_LIMIT),
                        false => (products / DENSE).clamp(LIMIT_IF_MAPPED, LARGEST_ITERATION_LIMIT),
                    };
                    Choice::IterativeFirst {
                        work: cost.work,
                        limit,
                    }
                } else {
                    Choice::Iterative(None)
                }
            }
        };
        let bytes = match choice {
            Choice::Direct => tangent_bytes(system, points) + DELAYED * cost.bytes,
            Choice::LikeBlades(_) | Choice::Iterative(_) | Choice::IterativeFirst { .. } => {
                iteration_bytes(system, points, cost)
            }
        };
        Plan {
            choice,
            method,
            falls_back,
            most_products,
            cost,
            bytes,
        }
    }

    /// The same where equations are solved at one point of a branch after the other.
    pub fn along_branch(self) -> Self {
        match self.choice {
            Choice::IterativeFirst { .. } if self.most_products <= OF_POINT => Plan {
                choice: Choice::Direct,
                ..self
            },
            _ => self,
        }
    }
}

/// Products of iteration that take as long as to assemble the Jacobian and factor it.
fn products_of(factors: DirectCost, numbers: f64) -> usize {
    let with_assembly = factors.work + VALUE * factors.values();
    (with_assembly / (PRODUCT * numbers)) as usize
}

/// Whether factors that take so many products may serve along a branch if there are parts that do
/// not act on each other.
pub(super) fn may_serve_in_parts(products: usize) -> bool {
    products <= TWO_PARTS * OF_POINT
}

/// Whether these factors serve along a branch of these equations.
pub(super) fn serve_along_branch(equations: &Collocation, factors: DirectCost) -> bool {
    let numbers = equations.layout().motions().len() as f64;
    products_of(factors, numbers) <= OF_POINT
}
