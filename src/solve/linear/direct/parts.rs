//! of it: groups are divided into parts, which elimination never couples.
//! See docs/theory.md, section 8.1.

use super::structure::Structure;
use crate::collocation::Panel;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Which components of groups act on each other at any two instants, by others too.
#[derive(Debug, Clone)]
pub(super) struct Parts {
    /// First component of each group.
    first: Vec<usize>,
    /// Of each component another one of its part; of one itself.
    other: Vec<usize>,
}

impl Parts {
    /// Each component is a part of its own.
    pub fn new(structure: &Structure) -> Self {
        let mut first = vec![0];
        for group in 0..structure.groups.len() {
            first.push(first[group] + structure.components(group));
        }
        let count = first.last().copied().unwrap_or(0);
        Parts {
            other: (0..count).collect(),
            first,
        }
    }

    /// The first component of a part.
    fn root(&self, mut component: usize) -> usize {
        while self.other[component] != component {
            component = self.other[component];
        }
        component
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.other[a.max(b)] = a.min(b);
    }

    /// The components of a group.
    fn of_group(&self, group: usize) -> Range<usize> {
        self.first[group]..self.first[group + 1]
    }

    /// Whether all components of each group are of one part.
    pub fn are_whole(&self) -> bool {
        let is_whole = |group: usize| {
            let root = self.root(self.first[group]);
            self.of_group(group).all(|c| self.root(c) == root)
        };
        (0..self.first.len() - 1).all(is_whole)
    }

    /// Joins what entries of a matrix couple.
    pub fn join_coupled(&mut self, structure: &Structure, values: &[f64]) {
        // In space that is told by the columns of one instant.
        let mut by_first = self.clone();
        by_first.join_blocks(&blocks(structure, values, 1));
        if by_first.are_whole() {
            *self = by_first;
        } else {
            self.join_blocks(&blocks(structure, values, structure.instants));
        }
    }

    fn join_blocks(&mut self, blocks: &BTreeMap<[usize; 2], Coupled>) {
        for (&[row, column], block) in blocks {
            for (i, j) in block.pairs() {
                self.join(self.first[row] + i, self.first[column] + j);
            }
        }
    }

    /// The parts of a group: the first component of each, and those of the group.
    fn parts(&self, group: usize) -> BTreeMap<usize, Vec<usize>> {
        let mut parts = BTreeMap::<usize, Vec<usize>>::new();
        for component in self.of_group(group) {
            let part = parts.entry(self.root(component)).or_default();
            part.push(component - self.first[group]);
        }
        parts
    }
}

/// What is coupled of groups, but for those of borders, in the columns of so many instants.
fn blocks(structure: &Structure, values: &[f64], instants: usize) -> BTreeMap<[usize; 2], Coupled> {
    let mut blocks = BTreeMap::new();
    for panel in &structure.panels {
        let groups = [panel.row.0, panel.column.0];
        let [rows, columns] = groups.map(|group| structure.components(group));
        let count = (instants * columns).saturating_sub(panel.column.1);
        if count > 0 && groups.iter().all(|&group| !structure.is_border(group)) {
            let block = blocks.entry(groups);
            let block = block.or_insert_with(|| Coupled::new(rows, columns));
            block.add(panel, count.min(panel.columns), values);
        }
    }
    blocks
}

/// Which components of two groups have entries that are not zero, at any instants.
struct Coupled {
    rows: usize,
    /// Of one column after the other: bits that an entry has.
    bits: Vec<u64>,
}

impl Coupled {
    fn new(rows: usize, columns: usize) -> Self {
        Coupled {
            rows,
            bits: vec![0; rows * columns],
        }
    }

    /// Looks at the first columns of a panel, so many.
    fn add(&mut self, panel: &Panel, count: usize, values: &[f64]) {
        let columns = self.bits.len() / self.rows;
        for j in 0..count {
            let component = (panel.column.1 + j) % columns;
            let bits = &mut self.bits[component * self.rows..][..self.rows];
            let entries = &values[panel.value + j * panel.stride..][..panel.rows];
            // Up to the end of an instant, and then whole ones.
            let first = panel.row.1 % self.rows;
            let (begun, whole) = entries.split_at(entries.len().min(self.rows - first));
            add_bits(&mut bits[first..], begun);
            for rows in whole.chunks(self.rows) {
                add_bits(bits, rows);
            }
        }
    }

    /// Row and column of each pair of them.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        let coupled = self.bits.iter().enumerate().filter(|(_, bits)| **bits != 0);
        coupled.map(|(k, _)| (k % self.rows, k / self.rows))
    }
}

/// Those of zeros are none, whatever their sign; NaN has some.
fn bits(x: f64) -> u64 {
    x.abs().to_bits()
}

fn add_bits(to: &mut [u64], entries: &[f64]) {
    for (to, x) in to.iter_mut().zip(entries) {
        *to |= bits(*x);
    }
}

/// Some components of a group at some instants, one after the other.
#[derive(Debug, Clone)]
pub(super) struct Picked {
    /// Components that there are, those that are picked, and the others.
    of: usize,
    components: Arc<[usize]>,
    others: Arc<[usize]>,
    /// How many are picked at all instants.
    pub count: usize,
}

impl Picked {
    /// All of so many.
    fn all(count: usize) -> Self {
        Picked {
            of: 1,
            components: Arc::new([0]),
            others: Arc::new([]),
            count,
        }
    }

    /// None of any.
    fn none() -> Self {
        Picked {
            of: 1,
            components: Arc::new([]),
            others: Arc::new([0]),
            count: 0,
        }
    }

    /// Place of one of them among all.
    pub fn at(&self, i: usize) -> usize {
        let each = self.components.len();
        match each == self.of {
            true => i,
            false => i / each * self.of + self.components[i % each],
        }
    }

    /// Copies what is picked of `entries`. `false` if another one is not zero.
    pub fn copy(&self, entries: &[f64], to: &mut [f64]) -> bool {
        let mut rest = 0;
        match (&self.components[..], &self.others[..]) {
            (_, []) => to.copy_from_slice(entries),
            ([], _) => rest = entries.iter().fold(0, |rest, x| rest | bits(*x)),
            // In a plane and out of it: three components of six.
            (&[a, b, c], &[d, e, f]) => {
                let (all, _) = entries.as_chunks::<6>();
                let (to, _) = to.as_chunks_mut::<3>();
                for (to, all) in to.iter_mut().zip(all) {
                    *to = [all[a], all[b], all[c]];
                    rest |= bits(all[d]) | bits(all[e]) | bits(all[f]);
                }
            }
            (components, others) => {
                let to = to.chunks_exact_mut(components.len());
                for (to, all) in to.zip(entries.chunks_exact(self.of)) {
                    for (to, &component) in to.iter_mut().zip(components) {
                        *to = all[component];
                    }
                    rest = others.iter().fold(rest, |rest, &o| rest | bits(all[o]));
                }
            }
        }
        rest == 0
    }
}

/// Entries of a panel in the columns of one part.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Group of the rows, and the first one within it.
    pub row: (usize, usize),
    /// Group of the columns, and the first one within it.
    pub column: (usize, usize),
    /// Of the panel's rows, those of the part.
    pub rows: Picked,
    /// Of its columns, those of the part.
    pub columns: Picked,
    /// Number of the panel's rows.
    pub length: usize,
    /// Position of the panel's first value.
    pub value: usize,
    /// Values from one column to the next.
    pub stride: usize,
    /// Whether rows of other parts have to be zero.
    pub alone: bool,
}

/// Groups that are eliminated: parts of those of a matrix.
#[derive(Debug)]
pub(super) struct Divided {
    pub groups: Vec<Range<usize>>,
    /// How many of the groups, the first, are parts of nodes.
    pub nodes: usize,
    pub pieces: Vec<Piece>,
    /// Place of each unknown among those of the groups, where these are divided.
    pub places: Option<Vec<usize>>,
}

/// A part of a group: its number among those that are eliminated, and its components.
struct PartOfGroup {
    number: usize,
    root: usize,
    components: Arc<[usize]>,
    others: Arc<[usize]>,
}

impl PartOfGroup {
    /// How many of its unknowns come before one of the group's, `of` of which are of an instant.
    fn before(&self, unknown: usize, of: usize) -> usize {
        let (instants, component) = (unknown / of, unknown % of);
        let at_last = self.components.iter().filter(|&&c| c < component).count();
        instants * self.components.len() + at_last
    }

    /// What is picked of so many unknowns of the group from one on; none if it is not told by
    /// whole instants.
    fn picked(&self, first: usize, count: usize, of: usize) -> Option<Picked> {
        if self.others.is_empty() {
            return Some(Picked::all(count));
        }
        let picked = |count: usize| Picked {
            of,
            components: self.components.clone(),
            others: self.others.clone(),
            count,
        };
        if first.is_multiple_of(of) && count.is_multiple_of(of) {
            return Some(picked(count / of * self.components.len()));
        }
        let is_own = count == 1 && self.components.contains(&(first % of));
        (count == 1).then(|| match is_own {
            true => Picked::all(1),
            false => Picked::none(),
        })
    }
}

impl Divided {
    /// Groups as they are.
    pub fn whole(structure: &Structure) -> Self {
        let pieces = structure.panels.iter().map(|panel| Piece {
            row: panel.row,
            column: panel.column,
            rows: Picked::all(panel.rows),
            columns: Picked::all(panel.columns),
            length: panel.rows,
            value: panel.value,
            stride: panel.stride,
            alone: false,
        });
        Divided {
            groups: structure.groups.clone(),
            nodes: structure.nodes,
            pieces: pieces.collect(),
            places: None,
        }
    }

    /// Groups in these parts; none if panels cannot be.
    pub fn new(structure: &Structure, parts: &Parts) -> Option<Self> {
        let mut groups: Vec<Range<usize>> = Vec::new();
        let mut nodes = 0;
        let mut places = vec![0; structure.groups.last().map_or(0, |group| group.end)];
        let mut of_groups: Vec<Vec<PartOfGroup>> = Vec::new();
        for (g, group) in structure.groups.iter().enumerate() {
            let of = structure.components(g);
            let mut of_group = Vec::new();
            for (root, components) in parts.parts(g) {
                let start = groups.last().map_or(0, |group| group.end);
                let mut end = start;
                for instant in group.clone().step_by(of) {
                    for component in &components {
                        places[instant + component] = end;
                        end += 1;
                    }
                }
                let others = (0..of).filter(|c| !components.contains(c));
                of_group.push(PartOfGroup {
                    number: groups.len(),
                    root,
                    others: others.collect(),
                    components: components.into(),
                });
                groups.push(start..end);
            }
            of_groups.push(of_group);
            if g < structure.nodes {
                nodes = groups.len();
            }
        }
        let mut pieces = Vec::new();
        for panel in &structure.panels {
            pieces.extend(pieces_of(structure, &of_groups, panel)?);
        }
        Some(Divided {
            groups,
            nodes,
            pieces,
            places: Some(places),
        })
    }
}

/// The pieces of a panel; none if it cannot be divided.
fn pieces_of(
    structure: &Structure,
    of_groups: &[Vec<PartOfGroup>],
    panel: &Panel,
) -> Option<Vec<Piece>> {
    let (row, column) = (panel.row.0, panel.column.0);
    let [of_row, of_column] = [row, column].map(|group| structure.components(group));
    let between = structure.is_border(row) || structure.is_border(column);
    let mut pieces = Vec::new();
    for columns in &of_groups[column] {
        let picked = columns.picked(panel.column.1, panel.columns, of_column)?;
        if picked.count == 0 {
            continue;
        }
        let mut add = |row: (usize, usize), rows: Picked| {
            pieces.push(Piece {
                row,
                column: (columns.number, columns.before(panel.column.1, of_column)),
                rows,
                columns: picked.clone(),
                length: panel.rows,
                value: panel.value,
                stride: panel.stride,
                alone: !between,
            });
        };
        let acts = |rows: &&PartOfGroup| between || rows.root == columns.root;
        let mut count = 0;
        for rows in of_groups[row].iter().filter(acts) {
            count += 1;
            let first = rows.before(panel.row.1, of_row);
            let of_rows = rows.picked(panel.row.1, panel.rows, of_row)?;
            add((rows.number, first), of_rows);
        }
        // Nothing of it may be there.
        if count == 0 {
            add((columns.number, 0), Picked::none());
        }
    }
    Some(pieces)
}

#[cfg(test)]
mod tests {
    use crate::collocation::Tangent;
    use crate::elements::{Coordinate, JointKind};
    use crate::model::{JointCoordinate, Model, SectionInput, Signal};
    use crate::solve::linear::borders::Borders;
    use crate::solve::linear::direct::{Columns, DirectSolver, WithBorders};
    use crate::solve::linear::solver::Side;
    use crate::solve::test_models::Linearised;
    use crate::workers::Workers;
    use faer::Mat;
    use faer::linalg::solvers::Solve;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::TAU;

    const POINTS: usize = 7;
    const NODES: usize = 5;

    /// A driven crank, a flexible link and a slider, all about axis 3.
    fn mechanism() -> Model {
        let mut model = Model::new();
        let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        let inertia = Matrix3::identity() * 0.1;
        let crank = model.add_rigid_body(2.0, &at(0.0, 0.0), &inertia).unwrap();
        let slider = model.add_rigid_body(1.0, &at(0.9, 0.0), &inertia).unwrap();
        let section = SectionInput::diagonal(&[1e4, 4e3, 4e3, 50.0, 80.0, 80.0], &[1.0; 4]);
        let link = model
            .add_straight_beam(
                &at(0.0, 0.3),
                &at(0.9, 0.0),
                &Vector3::z(),
                &section.unwrap(),
                2,
                1,
            )
            .unwrap();
        let mut join = |kind, first, second, x: f64, y: f64, axis: Vector3<f64>| {
            let frame = Model::frame_at("axis", &at(x, y), &axis).unwrap();
            model
                .add_joint(kind, first, second, &frame, &frame)
                .unwrap()
        };
        let z = Vector3::z();
        let (first, last) = (Some(link.first_node), Some(link.last_node));
        let shaft = join(JointKind::Revolute, None, Some(crank), 0.0, 0.0, z);
        join(JointKind::Revolute, Some(crank), first, 0.0, 0.3, z);
        join(JointKind::Revolute, last, Some(slider), 0.9, 0.0, z);
        join(
            JointKind::Prismatic,
            None,
            Some(slider),
            0.9,
            0.0,
            Vector3::x(),
        );
        let turn = Signal::harmonics(0.0, 3.0, &[], &[]).unwrap();
        let coordinate = Coordinate::Rotation1;
        let driven = JointCoordinate {
            joint: shaft,
            coordinate,
        };
        model.prescribe(driven, &turn).unwrap();
        model
    }

    /// Where nodes have moved by these components of their own axes; links have axis 2 out of the
    /// plane.
    fn moved(moves: impl Fn(usize, usize) -> bool) -> Linearised {
        let wave = |i: usize| (0.7 * i as f64).sin();
        let mut at = Linearised::new(&mechanism(), TAU / 3.0, POINTS, |_| 0.0);
        let system = at.equations.system().clone();
        let size = at.equations.size();
        let mut increment = vec![0.0; size];
        for i in at.equations.layout().motions() {
            if moves(i / (6 * POINTS), i % 6) {
                increment[i] = 0.05 * wave(i);
            }
        }
        at.state = at.state.incremented(&system, &increment, 1.0);
        let mut tangent = Tangent::new(&system, POINTS);
        let Linearised {
            equations,
            state,
            pattern,
            values,
        } = &mut at;
        equations
            .jacobian(state, pattern, &mut tangent, values)
            .unwrap();
        at
    }

    fn in_plane() -> Linearised {
        moved(|node, component| match node {
            // Bodies have the axes of space.
            0 | 1 => [0, 1, 5].contains(&component),
            _ => [0, 2, 4].contains(&component),
        })
    }

    fn right_side(size: usize) -> Vec<f64> {
        (0..size).map(|i| (0.9 * i as f64).cos()).collect()
    }

    /// The largest difference from the solution with a dense matrix, relative to that.
    fn error(matrix: &Mat<f64>, found: &[f64]) -> f64 {
        let size = found.len();
        let rhs = Mat::from_fn(size, 1, |i, _| right_side(size)[i]);
        let exact = matrix.partial_piv_lu().solve(&rhs);
        let most = (0..size).fold(0.0, |most: f64, i| most.max(exact[(i, 0)].abs()));
        let error = |i: usize| (found[i] - exact[(i, 0)]).abs();
        (0..size).fold(0.0, |most: f64, i| most.max(error(i))) / most
    }

    fn solved(solver: &DirectSolver, matrix: &Mat<f64>) {
        let size = matrix.nrows();
        let mut found = right_side(size);
        assert!(solver.solve(&mut found));
        let mut transposed = right_side(size);
        assert!(solver.solve_transposed(&mut transposed));
        let mut columns = Mat::from_fn(size, 2, |i, j| [1.0, -2.0][j] * right_side(size)[i]);
        let mut memory = Columns::default();
        assert!(solver.solve_columns(columns.as_mut(), &mut memory).unwrap());
        let half: Vec<f64> = columns.col_as_slice(1).iter().map(|x| -0.5 * x).collect();
        let transpose = matrix.transpose().to_owned();
        for error in [
            error(matrix, &found),
            error(&transpose, &transposed),
            error(matrix, columns.col_as_slice(0)),
            error(matrix, &half),
        ] {
            // Rounding, times a condition of some ten thousands.
            assert!(error < 1e-11, "{error:e}");
        }
        let (sign, logarithm) = solver.determinant();
        let determinant = matrix.determinant();
        assert_eq!(sign, determinant.signum());
        assert!((logarithm - determinant.abs().ln()).abs() < 1e-8);
    }

    #[test]
    fn a_planar_motion_has_parts_in_its_plane_and_out_of_it() {
        let plane = in_plane();
        let mut solver = DirectSolver::new(&plane.pattern, Workers::default());
        let whole = solver.cost();
        assert!(solver.factor(&plane.values).unwrap());
        // Of each node three components and three others, and so with joints.
        let groups = &solver.analysis.groups;
        assert!(groups[..2 * NODES].iter().all(|g| g.len() == 3 * POINTS));
        assert!(solver.cost().work < 0.4 * whole.work);
        solved(&solver, &plane.dense());
        // Out of the plane, everything acts on everything.
        let space = moved(|_, _| true);
        assert!(solver.factor(&space.values).unwrap());
        assert_eq!(solver.cost(), whole);
        solved(&solver, &space.dense());
        // And so it is taken to go on.
        assert!(solver.factor(&plane.values).unwrap());
        assert_eq!(solver.cost(), whole);
        solved(&solver, &plane.dense());
    }

    #[test]
    fn what_moves_out_of_the_plane_is_left_at_rest_by_what_acts_in_it() {
        let plane = in_plane();
        let mut solver = DirectSolver::new(&plane.pattern, Workers::default());
        assert!(solver.factor(&plane.values).unwrap());
        let mut rhs = vec![0.0; plane.pattern.size()];
        // A force along axis 1 on the crank.
        rhs[0] = 1.0;
        assert!(solver.solve(&mut rhs));
        for k in 0..POINTS {
            let crank = &rhs[6 * k..][..6];
            assert!([2, 3, 4].iter().all(|&c| crank[c] == 0.0), "{crank:?}");
        }
    }

    #[test]
    fn borders_may_act_on_all_parts() {
        let plane = in_plane();
        let (size, count) = (plane.pattern.size(), 2);
        let border = |j: usize| -> Vec<f64> {
            let wave = |i: usize| (0.3 * (i + 5 * j) as f64).sin();
            (0..size + count).map(wave).collect()
        };
        let borders = Borders {
            columns: (0..count).map(|j| border(j)[..size].to_vec()).collect(),
            rows: (0..count).map(|j| border(j + 7)).collect(),
            ..Borders::default()
        };
        let mut factors = WithBorders::new(&plane.pattern, count, Workers::default());
        let mut values = plane.values.clone();
        values.resize(factors.entries(), 0.0);
        assert!(factors.factor(&mut values, &borders).unwrap());
        let inner = plane.dense();
        let matrix = Mat::from_fn(size + count, size + count, |i, j| {
            match (i < size, j < size) {
                (true, true) => inner[(i, j)],
                (true, false) => borders.columns[j - size][i],
                (false, _) => borders.rows[i - size][j],
            }
        });
        let mut found = right_side(size + count);
        assert!(factors.solve(&mut found, Side::Plain));
        let mut transposed = right_side(size + count);
        assert!(factors.solve(&mut transposed, Side::Transposed));
        let transpose = matrix.transpose().to_owned();
        for error in [error(&matrix, &found), error(&transpose, &transposed)] {
            assert!(error < 1e-10, "{error:e}");
        }
    }
}
