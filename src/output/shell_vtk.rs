//! Shells in animations: each element as a curved quadrilateral of its own order.

use super::poly_data::{Cells, Field, PolyData};
use super::vtk::{frame_data, positions};
use super::{ShellQuantity, Solution};
use crate::elements::{Element, ShellPoint, ShellSide};
use crate::error::Result;
use crate::motion::Motion;

/// What is known of a shell element at its points: six or fewer components of each time together.
struct ShellPoints {
    frames: Vec<Motion>,
    strains: Vec<Vec<f64>>,
    resultants: Vec<Vec<f64>>,
    /// At top and bottom, if the shell is isotropic.
    stresses: Option<[Vec<Vec<f64>>; 2]>,
}

/// Places in a grid of points at equal distances, `sides` along ξ and η, in the order of VTK's
/// Lagrange quadrilaterals: corners around, insides of the edges, inside.
fn lagrange_places(sides: [usize; 2]) -> Vec<[usize; 2]> {
    let [p, q] = sides.map(|side| side - 1);
    let mut places = vec![[0, 0], [p, 0], [p, q], [0, q]];
    places.extend((1..p).map(|i| [i, 0]));
    places.extend((1..q).map(|j| [p, j]));
    places.extend((1..p).map(|i| [i, q]));
    places.extend((1..q).map(|j| [0, j]));
    places.extend((1..q).flat_map(|j| (1..p).map(move |i| [i, j])));
    places
}

impl Solution {
    /// Frames of a shell element at places `(ξ, η)`, each from −1 to 1: position, and axes 1, 2 of
    /// its section with the normal; those of each time together.
    ///
    /// # Errors
    /// An unknown element, or a motion that cannot be interpolated.
    pub fn shell_frames(
        &self,
        element: usize,
        places: &[[f64; 2]],
        times: &[f64],
    ) -> Result<Vec<Motion>> {
        // Checks the element and the places.
        for &at in places {
            let point = ShellPoint::new(at);
            ShellQuantity::Strain.probe(&self.solve.system, element, point)?;
        }
        let Some(shell) = self.solve.system.shells().get(element) else {
            return Ok(Vec::new());
        };
        let nodes = shell.nodes().iter();
        let nodes: Vec<Vec<Motion>> = nodes
            .map(|&n| self.node_motions(n, times))
            .collect::<Result<_>>()?;
        let mut frames = Vec::with_capacity(places.len() * times.len());
        for k in 0..times.len() {
            let motions: Vec<Motion> = nodes.iter().map(|node| node[k]).collect();
            for &at in places {
                let frame = shell.section_motion(at, &motions);
                frames.push(frame.map_err(|e| e.within(format!("shell element {element}")))?);
            }
        }
        Ok(frames)
    }

    pub(super) fn shells_drawn(&self, times: &[f64]) -> Result<Vec<PolyData>> {
        let shells = self.solve.system.shells();
        if shells.is_empty() {
            return Ok(Vec::new());
        }
        let (mut reference, mut drawn, mut sides) = (Vec::new(), Vec::new(), Vec::new());
        for (element, shell) in shells.iter().enumerate() {
            let of_element = shell.sides();
            let places: Vec<[f64; 2]> = lagrange_places(of_element)
                .into_iter()
                .map(|place| {
                    let along = |d: usize| 2.0 * place[d] as f64 / (of_element[d] - 1) as f64 - 1.0;
                    [along(0), along(1)]
                })
                .collect();
            for &at in &places {
                reference.push(shell.section_motion(at, shell.reference())?);
            }
            let each = |quantity: ShellQuantity| -> Result<Vec<Vec<f64>>> {
                let at = |&at: &[f64; 2]| self.shell(element, ShellPoint::new(at), quantity, times);
                places.iter().map(at).collect()
            };
            let is_isotropic = shell.section().isotropic_thickness().is_some();
            let sides_of = [ShellSide::Top, ShellSide::Bottom].map(ShellQuantity::SurfaceStress);
            drawn.push(ShellPoints {
                frames: self.shell_frames(element, &places, times)?,
                strains: each(ShellQuantity::Strain)?,
                resultants: each(ShellQuantity::Resultant)?,
                stresses: match is_isotropic {
                    true => Some([each(sides_of[0])?, each(sides_of[1])?]),
                    false => None,
                },
            });
            sides.push(of_element);
        }
        let piece = |k: usize| self.shells_at(k, (&reference, &drawn), &sides);
        Ok((0..times.len()).map(piece).collect())
    }

    /// All shells at the time of this number.
    fn shells_at(
        &self,
        k: usize,
        (reference, drawn): (&[Motion], &[ShellPoints]),
        sides: &[[usize; 2]],
    ) -> PolyData {
        let frames_of = |shell: &ShellPoints| {
            let count = shell.strains.len();
            shell.frames[k * count..][..count].to_vec()
        };
        let frames: Vec<Motion> = drawn.iter().flat_map(frames_of).collect();
        type Values<'a> = &'a dyn Fn(&ShellPoints) -> &[Vec<f64>];
        let part = |of: Values, first: usize| -> Vec<f64> {
            let points = drawn.iter().flat_map(of);
            points
                .flat_map(|x| &x[12 * k + first..][..3])
                .copied()
                .collect()
        };
        let (strains, resultants): (Values, Values) = (&|s| &s.strains, &|s| &s.resultants);
        let mut data = frame_data(reference, &frames);
        data.extend([
            Field::vectors("force_1", part(resultants, 0)),
            Field::vectors("moment_1", part(resultants, 3)),
            Field::vectors("force_2", part(resultants, 6)),
            Field::vectors("moment_2", part(resultants, 9)),
            Field::vectors("strain_1", part(strains, 0)),
            Field::vectors("curvature_1", part(strains, 3)),
            Field::vectors("strain_2", part(strains, 6)),
            Field::vectors("curvature_2", part(strains, 9)),
        ]);
        // Of what has no such stresses they are zero, unless nothing has.
        if drawn.iter().any(|shell| shell.stresses.is_some()) {
            let names = [
                ("stress_top", "von_mises_top"),
                ("stress_bottom", "von_mises_bottom"),
            ];
            for (side, (stress, mises)) in names.into_iter().enumerate() {
                let rows: Vec<[f64; 4]> = (drawn.iter())
                    .flat_map(|shell| {
                        let of_point = move |point: usize| match &shell.stresses {
                            Some(stresses) => {
                                std::array::from_fn(|i| stresses[side][point][4 * k + i])
                            }
                            None => [0.0; 4],
                        };
                        (0..shell.strains.len()).map(of_point)
                    })
                    .collect();
                let vectors = rows.iter().flat_map(|row| row[..3].to_vec()).collect();
                data.push(Field::vectors(stress, vectors));
                data.push(Field::numbers(mises, rows.iter().map(|r| r[3]).collect()));
            }
        }
        PolyData {
            positions: positions(&frames),
            point_data: data,
            cell_data: vec![
                Field::ids("element", 0..sides.len()),
                Field::degrees(sides.iter().map(|s| s.map(|side| side - 1))),
            ],
            cells: Cells::Quadrilaterals(sides.to_vec()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::lagrange_places;

    #[test]
    fn points_are_in_the_order_of_vtk() {
        // vtkHigherOrderQuadrilateral::PointIndexFromIJK for the degrees 3 and 2, worked out by
        // hand: corners, then edges, then the inside with i running first.
        let index = |i: usize, j: usize| {
            let (p, q) = (3, 2);
            let (on_i, on_j) = (i == 0 || i == p, j == 0 || j == q);
            match (on_i, on_j) {
                (true, true) => match (i > 0, j > 0) {
                    (false, false) => 0,
                    (true, false) => 1,
                    (true, true) => 2,
                    (false, true) => 3,
                },
                (false, true) => 4 + (i - 1) + if j > 0 { p - 1 + q - 1 } else { 0 },
                (true, false) => 4 + (j - 1) + if i > 0 { p - 1 } else { 2 * (p - 1) + q - 1 },
                (false, false) => 4 + 2 * (p - 1 + q - 1) + (i - 1) + (p - 1) * (j - 1),
            }
        };
        let places = lagrange_places([4, 3]);
        assert_eq!(places.len(), 12);
        for (number, &[i, j]) in places.iter().enumerate() {
            assert_eq!(index(i, j), number, "{i} {j}");
        }
        assert_eq!(lagrange_places([2, 2]), [[0, 0], [1, 0], [1, 1], [0, 1]]);
    }
}
