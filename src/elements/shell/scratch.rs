//! What the evaluation of a shell element finds, kept from one to the next.

use super::products::Products;
use crate::elements::line_station::{NodePlace, NodeTerms, StationMotion};
use crate::motion::{DualMatrix, DualVector};
use nalgebra::Vector6;

/// Scratch for what the element finds.
#[derive(Debug, Clone, Default)]
pub(in crate::elements) struct Scratch {
    /// Motions of the element's frames relative to the first.
    pub(super) relative: Vec<DualMatrix>,
    /// The same entry by entry, primal and then dual: a row of the nodes for each.
    pub(super) relative_rows: Vec<f64>,
    /// Velocities of the element's frames.
    pub(super) twists: Vec<DualVector>,
    pub(super) motions: Vec<StationMotion>,
    /// Of the nodes, at one sample.
    pub(super) places: Vec<NodePlace>,
    /// Of the nodes, at one sample.
    pub(super) terms: Vec<NodeTerms>,
    /// Rates at the samples.
    pub(super) rates: Vec<DualVector>,
    /// Of the samples: strains, and their rates; then integrated resultants.
    pub(super) at_samples: [Vec<Vector6<f64>>; 2],
    /// Of the Gauss points, two each: strains, and their rates.
    pub(super) at_points: [Vec<Vector6<f64>>; 2],
    pub(super) resultants: Vec<Vector6<f64>>,
    /// On the frames, component by component: a row of the nodes for each.
    pub(super) forces: Vec<f64>,
    pub(super) products: Products,
}

/// What of rates matters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Damping {
    pub damped: bool,
    /// Whether rates vary with the motion.
    pub rates_vary: bool,
}
