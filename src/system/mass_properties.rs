//! Mass, centre and inertia of bodies, beams and shells.

use super::System;
use crate::elements::Element;
use crate::motion::skew;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::collections::BTreeMap;
use std::fmt;

/// Mass properties of a body, or of beams that are joined at nodes, in the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct MassProperties {
    /// Its nodes, ascending.
    pub nodes: Vec<usize>,
    /// Number of its beam elements.
    pub beam_elements: usize,
    /// Number of its shell elements.
    pub shell_elements: usize,
    /// Mass.
    pub mass: f64,
    /// Centre of mass, in the inertial frame.
    pub centre: Vector3<f64>,
    /// Inertia about the centre, along the axes of the inertial frame.
    pub inertia: Matrix3<f64>,
}

impl MassProperties {
    /// Of all members of a system that have mass: `members` gives, for each node, the node that
    /// stands for its member.
    pub(super) fn of_members(system: &System, members: &[usize]) -> Vec<Self> {
        let mut about_origin: BTreeMap<usize, Matrix6<f64>> = BTreeMap::new();
        for inertia in &system.inertias {
            let nodes = inertia.nodes();
            let motions: Vec<_> = nodes.iter().map(|&n| system.reference[n]).collect();
            *about_origin.entry(members[nodes[0]]).or_default() += inertia.about_origin(&motions);
        }
        let of = |(member, inertia): (usize, Matrix6<f64>)| {
            let nodes = (0..members.len()).filter(|&n| members[n] == member);
            let is_of = |nodes: &[usize]| members[nodes[0]] == member;
            let beams = system.beams.iter().filter(|beam| is_of(beam.nodes()));
            let shells = system.shells.iter().filter(|shell| is_of(shell.nodes()));
            let elements = [beams.count(), shells.count()];
            Self::about_centre(nodes.collect(), elements, &inertia)
        };
        about_origin.into_iter().filter_map(of).collect()
    }

    /// From the 6×6 inertia about the origin; none without mass, or with a centre beyond numbers.
    fn about_centre(
        nodes: Vec<usize>,
        [beam_elements, shell_elements]: [usize; 2],
        inertia: &Matrix6<f64>,
    ) -> Option<Self> {
        let mass = inertia.fixed_view::<3, 3>(0, 0).trace() / 3.0;
        // m c̃ below the mass.
        let moment = inertia.fixed_view::<3, 3>(3, 0);
        let moment = 0.5
            * Vector3::new(
                moment[(2, 1)] - moment[(1, 2)],
                moment[(0, 2)] - moment[(2, 0)],
                moment[(1, 0)] - moment[(0, 1)],
            );
        let centre = moment / mass;
        let c = skew(&centre);
        let about_origin: Matrix3<f64> = inertia.fixed_view::<3, 3>(3, 3).into();
        let is_some = mass > 0.0 && centre.iter().all(|x| x.is_finite());
        is_some.then(|| MassProperties {
            nodes,
            beam_elements,
            shell_elements,
            mass,
            centre,
            inertia: about_origin + mass * c * c,
        })
    }
}

/// A number with seven digits, without zeros at the end.
pub(super) fn readable(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 6 - x.abs().log10().floor() as i32;
    if !(0..=10).contains(&digits) {
        return format!("{x:.6e}");
    }
    let text = format!("{x:.*}", digits as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

/// Three numbers that belong together; those that are rounding beside the largest are zero.
pub(super) fn readable_all(numbers: [f64; 3], size: f64) -> String {
    let [a, b, c] = numbers.map(|x| readable(if x.abs() < 1e-12 * size { 0.0 } else { x }));
    format!("({a}, {b}, {c})")
}

impl fmt::Display for MassProperties {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, last) = (self.nodes[0], self.nodes[self.nodes.len() - 1]);
        match self.nodes.len() {
            1 => write!(f, "node {first}")?,
            count if last - first + 1 == count => write!(f, "nodes {first} to {last}")?,
            count => write!(f, "{count} nodes from {first} to {last}")?,
        }
        if self.beam_elements > 0 {
            write!(f, ", {} beam elements", self.beam_elements)?;
        }
        if self.shell_elements > 0 {
            write!(f, ", {} shell elements", self.shell_elements)?;
        }
        let j = &self.inertia;
        let size = j.amax();
        write!(
            f,
            ": mass {}, centre {}, inertia 11 22 33 {}, 23 13 12 {}",
            readable(self.mass),
            readable_all(self.centre.into(), self.centre.amax()),
            readable_all([j[(0, 0)], j[(1, 1)], j[(2, 2)]], size),
            readable_all([j[(1, 2)], j[(0, 2)], j[(0, 1)]], size)
        )
    }
}
