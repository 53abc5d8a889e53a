//! Vectors of the equations of one blade of several: the first part of the period tells all of hub
//! and supports (docs/theory.md, section 8.10).

use crate::collocation::Collocation;
use std::ops::Range;

/// Where what is told is among all unknowns, and room for vectors of all of them.
pub(super) struct FirstPart {
    /// Of each node, and of own unknowns of each element: all of it, and how much of that is told.
    regions: Vec<(Range<usize>, usize)>,
    /// What is told counts so often: lengths of vectors are those of all unknowns.
    weight: f64,
    /// Motions that are told, and all that is, of the equations.
    pub motions: usize,
    pub size: usize,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl FirstPart {
    /// Of equations of one blade of several; none of others.
    pub fn of(equations: &Collocation) -> Option<Self> {
        let alike = equations.alike()?;
        let (system, layout) = (equations.system(), equations.layout());
        let part = |all: Range<usize>, repeats: bool| {
            let told = all.len() / if repeats { alike.blades() } else { 1 };
            (all, told)
        };
        let nodes =
            (0..system.nodes()).map(|node| part(layout.node(node), alike.of_node(node).is_some()));
        let own = (system.elements().iter().enumerate())
            .map(|(index, placed)| part(layout.element(placed), alike.repeats_own(index)));
        let regions: Vec<_> = nodes.chain(own).collect();
        let told = |regions: &[(Range<usize>, usize)]| regions.iter().map(|(_, told)| told).sum();
        Some(FirstPart {
            weight: (alike.blades() as f64).sqrt(),
            motions: told(&regions[..system.nodes()]),
            size: told(&regions),
            regions,
            x: Vec::new(),
            y: Vec::new(),
        })
    }

    /// What tells a vector of all that is alike.
    pub fn gathered(&self, all: &[f64]) -> Vec<f64> {
        let of_grid = self.regions.last().map_or(0, |(all, _)| all.end);
        let mut told = vec![0.0; self.size + all.len() - of_grid];
        self.gather(all, &mut told);
        told
    }

    /// Writes it.
    fn gather(&self, all: &[f64], told: &mut [f64]) {
        let (mut first, mut rest) = (0, 0);
        for (region, count) in &self.regions {
            let from = &all[region.start..][..*count];
            let to = &mut told[first..][..*count];
            match *count < region.len() {
                true => to
                    .iter_mut()
                    .zip(from)
                    .for_each(|(to, x)| *to = self.weight * x),
                false => to.copy_from_slice(from),
            }
            (first, rest) = (first + count, region.end);
        }
        told[first..].copy_from_slice(&all[rest..]);
    }

    /// Writes what is told where it is among all.
    fn scatter(&self, told: &[f64], all: &mut [f64]) {
        let (mut first, mut rest) = (0, 0);
        for (region, count) in &self.regions {
            let from = &told[first..][..*count];
            let to = &mut all[region.start..][..*count];
            match *count < region.len() {
                true => to
                    .iter_mut()
                    .zip(from)
                    .for_each(|(to, x)| *to = x / self.weight),
                false => to.copy_from_slice(from),
            }
            (first, rest) = (first + count, region.end);
        }
        all[rest..].copy_from_slice(&told[first..]);
    }

    /// Writes all unknowns.
    pub fn write_unknowns(&self, equations: &Collocation, told: &[f64], all: &mut [f64]) {
        self.scatter(told, all);
        equations.repeat_unknowns(all);
    }

    /// `y = A x`, where `product` gives that of vectors of all unknowns.
    pub fn product(
        &mut self,
        equations: &Collocation,
        x: &[f64],
        y: &mut [f64],
        product: impl FnOnce(&[f64], &mut [f64]),
    ) {
        let [mut all, mut products] = self.take(equations, x);
        self.write_unknowns(equations, x, &mut all);
        product(&all, &mut products);
        self.gather(&products, y);
        (self.x, self.y) = (all, products);
    }

    /// `y = P⁻¹ y`, likewise.
    pub fn precondition(
        &mut self,
        equations: &Collocation,
        y: &mut [f64],
        precondition: impl FnOnce(&mut [f64]),
    ) {
        let [mut all, unused] = self.take(equations, y);
        self.scatter(y, &mut all);
        equations.repeat_equations(&mut all);
        precondition(&mut all);
        self.gather(&all, y);
        (self.x, self.y) = (all, unused);
    }

    /// Room for vectors of all unknowns, and of what is behind those of the equations in `told`.
    fn take(&mut self, equations: &Collocation, told: &[f64]) -> [Vec<f64>; 2] {
        let size = equations.size() + told.len() - self.size;
        [&mut self.x, &mut self.y].map(|room| {
            let mut room = std::mem::take(room);
            room.resize(size, 0.0);
            room
        })
    }

    /// Entries of the vectors of all unknowns.
    pub fn entries(&self) -> usize {
        self.x.len() + self.y.len()
    }

    /// Gives up the memory of vectors of all unknowns.
    pub fn release(&mut self) {
        (self.x, self.y) = (Vec::new(), Vec::new());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{LikeBlades, OneBlade, require_like_blades};
    use crate::fourier::TimeGrid;
    use crate::system::System;
    use crate::test_models::rotors::{RotorKind, bladed_rotor};
    use std::sync::Arc;

    /// Of a rotor whose hub turns, with joints that do and that do not.
    #[test]
    fn the_first_part_tells_all_that_is_alike() {
        let rotor = bladed_rotor(&RotorKind::new(3, 1, true));
        let system = Arc::new(System::new(&rotor.symmetric(), rotor.period).unwrap());
        require_like_blades(&system).unwrap();
        let grid = TimeGrid::new(9, rotor.period).unwrap();
        let whole = Collocation::new(system.clone(), grid).unwrap();
        let left = LikeBlades::of(&whole).unwrap();
        let one = OneBlade::of(&whole, system.symmetry().unwrap(), &left);
        let equations = one.unwrap().unwrap().equations;
        let told = FirstPart::of(&equations).unwrap();
        assert!(told.size < equations.size() && told.motions < told.size);

        let any: Vec<f64> = (0..equations.size())
            .map(|i| (0.7 * i as f64).sin())
            .collect();
        let mut unknowns = any.clone();
        equations.project(&mut unknowns);
        let mut forces = any;
        equations.average(&mut forces);
        let largest = |x: &[f64]| x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let off = |a: &[f64], b: &[f64]| {
            let off: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            largest(&off) / largest(a)
        };
        let mut again = vec![0.0; unknowns.len()];
        told.write_unknowns(&equations, &told.gathered(&unknowns), &mut again);
        // Of rounding, and turns of the hub by three thirds.
        assert!(off(&unknowns, &again) < 1e-14);
        let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [all, part] = [length(&unknowns), length(&told.gathered(&unknowns))];
        assert!((all - part).abs() < 1e-13 * all, "{all} {part}");

        told.scatter(&told.gathered(&forces), &mut again);
        equations.repeat_equations(&mut again);
        let motions = equations.layout().motions();
        assert!(off(&forces[motions.clone()], &again[motions.clone()]) < 1e-14);
        // Work of equations on unknowns is the same in all parts of the period.
        let points = grid.points();
        for (index, placed) in equations.system().elements().iter().enumerate() {
            if !equations.alike().unwrap().repeats_own(index) {
                continue;
            }
            let work = |k: usize| {
                let at = equations.layout().element_at(placed, k);
                let pairs = unknowns[at.clone()].iter().zip(&again[at]);
                pairs.map(|(x, c)| x * c).sum::<f64>()
            };
            for k in points / 3..points {
                assert!(
                    (work(k) - work(k % (points / 3))).abs() < 1e-13,
                    "{index} {k}"
                );
            }
        }
    }
}
