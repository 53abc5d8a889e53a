//! The one loop over elements that fills their tangents.

use super::layout::TangentLayout;
use super::{Evaluation, Part};
use crate::collocation::division::Share;
use crate::elements::Contribution;
use crate::error::Result;
use crate::system::Workspace;
use nalgebra::Matrix6;

impl TangentLayout {
    /// Sums the tangents of the couplings of a share's columns; writes those of strains and of own
    /// unknowns of the elements that have these there.
    pub(super) fn evaluate(
        &self,
        at: &Evaluation,
        share: &Share,
        workspace: &mut Workspace,
        part: &mut Part,
    ) -> Result<()> {
        let points = at.state.points();
        part.forces.fill(0.0);
        for (&index, own) in share.elements.iter().zip(&mut part.own) {
            at.workers.pulse()?;
            let placed = &at.instants.system().elements()[index];
            let element = &placed.element;
            let nodes = element.nodes();
            let has_mass = element.has_mass();
            let is_elastic = at.rule.is_elastic(has_mass);
            let has_damping = element.has_damping() && is_elastic;
            let held = placed.has_states && at.rule.holds_states();
            if let Some(((_, own), _)) = own {
                own.gradients.clear();
                own.effects.clear();
                own.gradient_rates.clear();
                own.own.clear();
            }
            let wanted = at.wanted.get(index).copied().unwrap_or(points);
            let repeats = match at.alike {
                _ if at.is_constant => 1,
                Some(alike) => alike.repeats_after(index, points),
                None => points,
            };
            let counts = [is_elastic, has_damping, has_mass];
            for k in 0..wanted.min(repeats) {
                let out = at.instants.evaluate(placed, k, at.state, workspace)?;
                for k in (k..points).step_by(repeats) {
                    self.add_pairs((index, nodes, out), counts, k, share, &mut part.pairs);
                    share.add_forces(out, nodes, (k, points), part.forces);
                    let Some(((strains, own), asked)) = own else {
                        continue;
                    };
                    let places = &self.places[index].strains;
                    let begins = self.strain_at.of_all(places.clone()).start;
                    for (strain, place) in out.strains.iter().zip(places.clone()) {
                        let at = self.strain_at.of(place);
                        if k < at.len() {
                            strains[at.start - begins + k] = *strain;
                        }
                    }
                    let count = out.constraint.len();
                    asked[count * k..][..count].copy_from_slice(out.constraint.as_slice());
                    own.push(out, placed.has_states, held);
                }
            }
        }
        Ok(())
    }

    /// Adds the tangents of an element at grid point `k` that count to those of the couplings of a
    /// share's columns.
    fn add_pairs(
        &self,
        (index, nodes, out): (usize, &[usize], &Contribution),
        [is_elastic, has_damping, has_mass]: [bool; 3],
        k: usize,
        share: &Share,
        pairs: &mut [&mut [Matrix6<f64>]; 3],
    ) {
        let columns = self.couplings.of_columns(share.nodes.clone());
        let base = self.coupling_at.of_all(columns).start;
        let blocks = [
            (&out.stiffness, is_elastic),
            (&out.damping, has_damping),
            (&out.mass, has_mass),
        ];
        for &((a, b), coupling, begins) in &self.places[index].couplings {
            let Some(at) = out.place(a, b) else { continue };
            let told = self.coupling_at.of(coupling);
            if !share.nodes.contains(&nodes[b]) || k >= told.len() {
                continue;
            }
            for (sums, (all, counts)) in pairs.iter_mut().zip(blocks) {
                let sum = &mut sums[told.start - base + k];
                let block = all.fixed_view::<6, 6>(at.0, at.1);
                match (begins, counts) {
                    (true, true) => sum.copy_from(&block),
                    (true, false) => sum.fill(0.0),
                    (false, true) => *sum += block,
                    (false, false) => {}
                }
            }
        }
    }
}
