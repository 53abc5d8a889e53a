//! Solutions: quantities of nodes, joints and beams at any time, their harmonics, and error
//! estimates.

mod branch;
mod campbell;
mod diagnostics;
mod file;
mod force;
mod modes;
mod nodal_content;
mod other_mesh;
mod poly_data;
mod quantities;
mod report;
mod report_json;
mod saved;
mod saved_branch;
mod shell_vtk;
mod solution;
mod stability;
mod table;
mod trajectory;
mod version;
mod vtk;
mod write;

pub use crate::quantity::{
    BeamQuantity, Extremes, ForceQuantity, JointQuantity, NodeQuantity, Quantity, ResolvedIn,
    Selection, ShellQuantity,
};
pub use diagnostics::Diagnostics;
pub use modes::Modes;
pub use nodal_content::{NodalContent, Whirl};
pub use solution::Solution;
pub use table::Table;
