//! What a beam element leaves of the equations, told by one of a higher degree in its place.
//!
//! The finer element moves as the coarse one does. What then is left of its equations bends it
//! further, by functions that vanish at the nodes of the coarse one (bubbles): they are found
//! element by element, and what holds them there are forces on the coarse nodes, which is how much
//! the coarse equations are wrong. See docs/theory.md, section 10.5.

use super::beam::{Beam, Station, about_axis};
use super::line_station::relative_to_first;
use super::shape::lobatto_points;
use super::{Contribution, Element, NodeState};
use crate::error::Result;
use crate::motion::{DualVector, Motion, turned};
use nalgebra::{DMatrix, DVector, Vector6};

/// Degrees that are added: bending by one more needs a deflection by one more than that, or shear
/// would lock it.
const MORE: usize = 2;

/// Between a beam element and one of a higher degree.
#[derive(Debug, Clone)]
pub struct Raised {
    /// The coarse element at the nodes of the finer.
    stations: Vec<Station>,
    /// Values of the bubbles at these.
    bubbles: Vec<[f64; MORE]>,
    nodes: usize,
}

impl Beam {
    /// How an element of a higher degree, with the same reference shape and sections, and this one
    /// hang together.
    ///
    /// # Errors
    /// If its shape is too distorted.
    pub(crate) fn raised(&self) -> Result<Raised> {
        let count = self.nodes().len();
        let (coarse, fine) = (lobatto_points(count), lobatto_points(count + MORE));
        let stations = fine.iter().map(|&xi| self.station(xi, 0.0));
        let bubbles = fine.iter().map(|&xi| {
            let first: f64 = coarse.iter().map(|x| xi - x).product();
            std::array::from_fn(|power| first * xi.powi(power as i32))
        });
        Ok(Raised {
            stations: stations.collect::<Result<_>>()?,
            bubbles: bubbles.collect(),
            nodes: count,
        })
    }
}

impl Raised {
    /// Motions of the nodes of the finer element, as the coarse one has them.
    ///
    /// # Errors
    /// If they cannot be interpolated.
    pub fn motions(&self, motions: &[Motion]) -> Result<Vec<Motion>> {
        let relative: Vec<_> = relative_to_first(motions.iter()).collect();
        let at = |station: &Station| {
            let here = motions[0].compose(&station.line.polar(&relative)?.motion());
            let rotation = here.rotation * about_axis(station.turn);
            Ok(Motion::new(rotation, here.position))
        };
        self.stations.iter().map(at).collect()
    }

    /// Increments of the nodes of the finer element by its bubbles, which with its tangents balance
    /// the `forces` on its nodes; and the forces that are left on these then.
    pub fn bent(&self, fine: &Contribution, forces: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let size = 6 * self.bubbles.len();
        let modes = DMatrix::from_fn(size, 6 * MORE, |row, column| {
            let same = row % 6 == column % 6;
            if same {
                self.bubbles[row / 6][column / 6]
            } else {
                0.0
            }
        });
        let by_modes = &fine.stiffness * &modes;
        let own = modes.tr_mul(&by_modes);
        match own.lu().solve(&modes.tr_mul(forces)) {
            Some(bent) => (-(modes * &bent), forces - by_modes * bent),
            None => (DVector::zeros(size), forces.clone()),
        }
    }

    /// Forces on the nodes of the coarse element, at `states`, that do the same work as these on
    /// those of the finer.
    ///
    /// # Errors
    /// As [`Raised::motions`].
    pub fn on_coarse_nodes(
        &self,
        states: &[NodeState],
        forces: &DVector<f64>,
    ) -> Result<DVector<f64>> {
        let motions = states.iter().map(|state| &state.motion);
        let relative: Vec<_> = relative_to_first(motions).collect();
        let mut sums = DVector::zeros(6 * self.nodes);
        for (i, station) in self.stations.iter().enumerate() {
            let turn = about_axis(station.turn);
            let force: Vector6<f64> = forces.fixed_rows::<6>(6 * i).into_owned();
            let force = DualVector::from_wrench(&turned(&turn, &force));
            let at = station.line.motion(&relative)?;
            for (a, node) in at
                .node_terms(station.line.places(&at, &relative))
                .enumerate()
            {
                let mut rows = sums.fixed_rows_mut::<6>(6 * a);
                rows += (node.turn.transpose() * force).to_wrench();
            }
        }
        Ok(sums)
    }
}
