//! Solutions: quantities of nodes, joints and beams at any time, their harmonics, and error
//! estimates.

mod beam;
mod diagnostics;
mod file;
mod force;
mod force_record;
mod joint;
mod modes;
mod node;
mod other_mesh;
mod poly_data;
mod report;
mod saved;
mod solution;
mod stability;
mod table;
mod trajectory;
mod vtk;
mod write;

pub use beam::BeamQuantity;
pub use diagnostics::Diagnostics;
pub use force::ForceQuantity;
pub use joint::{JointQuantity, ResolvedIn};
pub use modes::Modes;
pub use node::NodeQuantity;
pub use solution::Solution;
pub use table::Table;
