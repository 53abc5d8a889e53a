//! Inertia that is constant in the material frames of its nodes: rigid bodies and beams
//! (docs/theory.md, section 6.1).

use super::{Contribution, Element, InertialForces, Instant, NodeState};
use crate::error::{Result, require_finite};
use crate::motion::{Motion, halves, joined, product, skew, transposed_product, vectorised};
use nalgebra::{DVector, Matrix3, Matrix6, Matrix6x3, Vector3, Vector6};

/// Inertial forces `M V̇ − Ṽᵀ M (V + S)` with `M` constant, and the weight. What is symmetric about
/// an axis may spin about it, with a constant twist `S` relative to the node.
///
/// Each node bears its share of the mass, carried with its own frame. So the weight has a potential
/// and its sum is exact, however much a beam bends.
#[derive(Debug, Clone)]
pub struct Inertia {
    nodes: Vec<usize>,
    /// The mass matrix, block by block: that of nodes `a` and `b` of `n` at `a n + b`.
    blocks: Vec<Matrix6<f64>>,
    /// Inertial force of each node if all move as a rigid body, for a unit acceleration in its
    /// frame.
    shares: Vec<Matrix6x3<f64>>,
    /// Twist of what spins relative to each node, and its momentum; empty if nothing does.
    spins: Vec<[Vector6<f64>; 2]>,
}

/// 6×6 inertia `[m I, −m c̃; m c̃, J − m c̃ c̃]` about a frame, for a mass `m` whose centre is at
/// `c` and whose inertia about its centre is `J`, all in that frame.
pub fn rigid_body_inertia(
    mass: f64,
    centre: &Vector3<f64>,
    inertia: &Matrix3<f64>,
) -> Matrix6<f64> {
    let c = skew(centre);
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(mass);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-mass * c));
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(&(mass * c));
    m.fixed_view_mut::<3, 3>(3, 3)
        .copy_from(&(inertia - mass * c * c));
    m
}

impl Inertia {
    /// Rigid body at `node`: `inertia` is about and resolved in a frame at `offset` from the node.
    pub fn rigid_body(node: usize, offset: &Motion, inertia: &Matrix6<f64>) -> Self {
        let carry = offset.inverse().adjoint();
        let at_node = carry.transpose() * inertia * carry;
        Self::consistent(vec![node], vec![at_node], &[Motion::identity()])
    }

    /// Inertia with a mass matrix of these 6×6 blocks, row by row, over `n` nodes at `reference`
    /// motions.
    pub fn consistent(nodes: Vec<usize>, blocks: Vec<Matrix6<f64>>, reference: &[Motion]) -> Self {
        let count = nodes.len();
        debug_assert_eq!(blocks.len(), count * count);
        let share = |(a, blocks): (usize, &[Matrix6<f64>])| {
            let of_node = |(b, block): (usize, &Matrix6<f64>)| {
                let carry = reference[b].relative(&reference[a]).adjoint();
                block * carry.fixed_columns::<3>(0)
            };
            blocks.iter().enumerate().map(of_node).sum()
        };
        let shares = blocks.chunks_exact(count).enumerate().map(share).collect();
        Inertia {
            nodes,
            blocks,
            shares,
            spins: Vec::new(),
        }
    }

    /// Lets it move with these constant twists relative to its nodes, along their axes. By such
    /// motions the mass matrix must not change.
    pub fn spinning(mut self, twists: &[Vector6<f64>]) -> Self {
        let momentum = |a: usize| self.row(a).iter().zip(twists).map(|(m, v)| m * v).sum();
        self.spins = (0..twists.len())
            .map(|a| [twists[a], momentum(a)])
            .collect();
        self
    }

    /// Checks the momenta of what spins.
    ///
    /// # Errors
    /// If they are too large to be numbers.
    pub fn require_finite(&self) -> Result<()> {
        let mut momenta = self.spins.iter().map(|[_, momentum]| momentum);
        momenta.try_for_each(|it| require_finite("inertia times spin", it.as_slice()))
    }

    /// Momentum at node `a` of what spins relative to the nodes.
    pub fn momentum_of_spin(&self, a: usize) -> Vector6<f64> {
        self.spins
            .get(a)
            .map_or(Vector6::zeros(), |[_, momentum]| *momentum)
    }

    /// Momenta at the nodes, and twists, of the material where the nodes have these twists.
    pub fn momenta(&self, mut twists: DVector<f64>) -> [DVector<f64>; 2] {
        for (a, [spin, _]) in self.spins.iter().enumerate() {
            let mut twist = twists.fixed_rows_mut::<6>(6 * a);
            twist += spin;
        }
        [self.times_mass(&twists), twists]
    }

    /// Blocks of the mass matrix in the rows of node `a`: one for each node.
    pub fn row(&self, a: usize) -> &[Matrix6<f64>] {
        let count = self.nodes.len();
        &self.blocks[a * count..(a + 1) * count]
    }

    /// The mass matrix times `6 n` numbers.
    pub fn times_mass(&self, twists: &DVector<f64>) -> DVector<f64> {
        let mut momenta = DVector::zeros(twists.len());
        for a in 0..self.nodes.len() {
            let mut momentum = momenta.fixed_rows_mut::<6>(6 * a);
            for (b, block) in self.row(a).iter().enumerate() {
                momentum += block * twists.fixed_rows::<6>(6 * b);
            }
        }
        momenta
    }
}

/// `−Ṽᵀ P = (ω × p_l, v × p_l + ω × p_a)`.
fn gyroscopic(twist: &Vector6<f64>, momentum: &Vector6<f64>) -> Vector6<f64> {
    let (v, w) = halves(twist);
    let (pl, pa) = halves(momentum);
    let linear = w.cross(&pl);
    let angular = v.cross(&pl) + w.cross(&pa);
    joined(&linear, &angular)
}

/// `𝒫 = [0 p̃_l; p̃_l p̃_a]`.
fn momentum_matrix(momentum: &Vector6<f64>) -> Matrix6<f64> {
    let (pl, pa) = halves(momentum);
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(&pl));
    m.fixed_view_mut::<3, 3>(3, 0).copy_from(&skew(&pl));
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&skew(&pa));
    m
}

impl Element for Inertia {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn has_mass(&self) -> bool {
        true
    }

    fn has_damping(&self) -> bool {
        true
    }

    /// Of the weight: zero at the origin.
    fn potential(&self, instant: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        let all = instant.nodes.iter().zip(&self.shares);
        let of_node = |(node, share): (&NodeState, &Matrix6x3<f64>)| {
            // The mass, and its first moment in the node's frame.
            let mass = share.fixed_view::<3, 3>(0, 0).trace() / 3.0;
            let moment = Vector3::new(share[(5, 1)], share[(3, 2)], share[(4, 0)]);
            let place = node.motion.position * mass + node.motion.rotation * moment;
            -instant.gravity.dot(&place)
        };
        Ok(Some(all.map(of_node).sum()))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        vectorised(
            #[inline(always)]
            || self.add(instant, out),
        );
        Ok(())
    }
}

impl Inertia {
    /// Adds forces, and tangents if these are wanted.
    #[inline(always)]
    fn add(&self, instant: &Instant, out: &mut Contribution) {
        let InertialForces { factor, damping } = instant.inertial;
        let zero = Vector6::zeros();
        for (a, node) in instant.nodes.iter().enumerate() {
            let blocks = self.row(a);
            let (mut force, mut momentum) = (zero, zero);
            // What is at rest adds nothing.
            for (block, other) in blocks.iter().zip(instant.nodes) {
                if other.twist_rate != zero {
                    force += product(block, &other.twist_rate);
                }
                if other.twist != zero {
                    momentum += product(block, &other.twist);
                }
            }
            let whole = momentum + self.momentum_of_spin(a);
            force = (force + gyroscopic(&node.twist, &whole)) * factor + momentum * damping;
            let gravity = transposed_product(&node.motion.rotation, &instant.gravity);
            force -= product(&self.shares[a], &gravity);
            out.add_force(a, &force);
            if !out.with_tangents {
                continue;
            }
            let mut stiffness = out.stiffness.fixed_view_mut::<6, 3>(6 * a, 6 * a + 3);
            stiffness -= product(&self.shares[a], &skew(&gravity));
            for (b, block) in blocks.iter().enumerate() {
                out.add_mass(a, b, &(block * factor));
                if node.twist == zero && damping == 0.0 {
                    continue;
                }
                let mut by_velocity = block * damping;
                let columns = by_velocity.column_iter_mut().zip(block.column_iter());
                for (mut to, column) in columns {
                    to += gyroscopic(&node.twist, &column.into()) * factor;
                }
                out.add_damping(a, b, &by_velocity);
            }
            if whole != zero {
                out.add_damping(a, a, &(momentum_matrix(&whole) * -factor));
            }
        }
    }

    /// The 6×6 inertia about the origin of the inertial frame, resolved in it, of the nodes at
    /// `motions` if all move as a rigid body.
    pub fn about_origin(&self, motions: &[Motion]) -> Matrix6<f64> {
        let carry: Vec<Matrix6<f64>> = motions.iter().map(|m| m.inverse().adjoint()).collect();
        let mut sum = Matrix6::zeros();
        for (a, left) in carry.iter().enumerate() {
            for (block, right) in self.row(a).iter().zip(&carry) {
                sum += left.tr_mul(&(block * right));
            }
        }
        sum
    }

    /// Mass and centre-of-mass moment `Σ m r`, in the inertial frame, of the nodes at `motions`.
    pub fn mass_and_moment(&self, motions: &[Motion]) -> (f64, Vector3<f64>) {
        // Momentum of a unit translation along each axis, and its moment.
        let size = 6 * self.nodes.len();
        let mut mass = 0.0;
        let mut moment = Vector3::zeros();
        for axis in 0..3 {
            let mut twist = DVector::zeros(size);
            for (a, m) in motions.iter().enumerate() {
                twist
                    .fixed_rows_mut::<3>(6 * a)
                    .copy_from(&m.rotation.row(axis).transpose());
            }
            let momentum = self.times_mass(&twist);
            mass += twist.dot(&momentum) / 3.0;
            for (a, m) in motions.iter().enumerate() {
                let force = m.rotation * momentum.fixed_rows::<3>(6 * a);
                let couple = m.rotation * momentum.fixed_rows::<3>(6 * a + 3);
                // Momentum m e_axis at r has the moment m r × e_axis.
                let about_origin = m.position.cross(&force) + couple;
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                moment[k] += 0.5 * about_origin[j];
                moment[j] -= 0.5 * about_origin[k];
            }
        }
        (mass, moment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::rotation_from_vector;

    #[test]
    fn mass_and_centre_of_a_body_at_an_offset() {
        let inertia = rigid_body_inertia(
            3.0,
            &Vector3::new(0.1, -0.2, 0.3),
            &Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5)),
        );
        let turn = |x, y, z| rotation_from_vector(&Vector3::new(x, y, z));
        let offset = Motion::new(turn(0.3, 0.1, -0.4), Vector3::new(1.0, 0.5, 0.0));
        let node = Motion::new(turn(-1.0, 0.2, 0.7), Vector3::new(5.0, 6.0, -7.0));
        let body = Inertia::rigid_body(0, &offset, &inertia);
        let (mass, moment) = body.mass_and_moment(&[node]);
        let frame = node.compose(&offset);
        let centre = frame.position + frame.rotation * Vector3::new(0.1, -0.2, 0.3);
        assert!((mass - 3.0).abs() < 1e-14);
        assert!((moment / mass - centre).amax() < 1e-14);
    }

    #[test]
    fn inertia_about_a_node_is_by_the_parallel_axis_theorem() {
        let (mass, centre) = (3.0, Vector3::new(0.1, -0.2, 0.3));
        let own = Matrix3::new(1.0, 0.1, 0.2, 0.1, 2.0, -0.3, 0.2, -0.3, 2.5);
        let found = rigid_body_inertia(mass, &centre, &own);
        let parallel = Matrix3::identity() * centre.norm_squared() - centre * centre.transpose();
        let about_node = found.fixed_view::<3, 3>(3, 3) - own - parallel * mass;
        assert!(about_node.amax() < 1e-15);
        assert!((found - found.transpose()).amax() < 1e-15);
    }
}
