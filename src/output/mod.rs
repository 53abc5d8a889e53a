//! Solutions: quantities of nodes, joints and beams at any time, their harmonics, and error estimates.

mod beam;
mod diagnostics;
mod joint;
mod node;
mod report;
mod solution;

pub use beam::BeamQuantity;
pub use diagnostics::Diagnostics;
pub use joint::{JointQuantity, ResolvedIn};
pub use node::NodeQuantity;
pub use solution::Solution;
