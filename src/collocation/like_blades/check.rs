//! Whether blades are alike in all that acts on them, and what carries constraint forces from one
//! to the next: both are found by evaluating the elements.

use super::{Leaders, LikeBlades, scaled_adjoint};
use crate::collocation::problem::Collocation;
use crate::collocation::state::GridState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::system::{ElementRole, Placed, Symmetry, System, describe_role, not_alike};
use nalgebra::{DMatrix, DVector, Vector6};
use std::collections::HashMap;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

/// Grid points of each part of the period at which elements are looked at.
const POINTS: usize = 3;
/// Differences of forces, relative to these, that are none.
const ALIKE: f64 = 1e-7;
/// Forces that small, relative to the largest of all, are none.
const NOTHING: f64 = 1e-12;
/// Turns, and displacements relative to the size of the model, of the motion that is tried.
const TRIED: f64 = 0.01;

/// Checks that blades are alike, if they are said to be. From then on what is left of them can be
/// asked for.
///
/// # Errors
/// If they are not, which says what tells them apart.
pub fn require_like_blades(system: &Arc<System>) -> Result<()> {
    match system.symmetry() {
        Some(symmetry) => {
            let carries = checked_carries(system, symmetry)?;
            symmetry.carries_of_own.get_or_init(|| carries);
            Ok(())
        }
        None => Ok(()),
    }
}

/// What carries the own unknowns of each element to its image; none if not all that acts on them is
/// understood: laws of the user with internal states of their own.
///
/// # Errors
/// If what acts on the next blade does not act on this one a `B`-th of the period later, or
/// elements cannot be evaluated.
pub(super) fn checked_carries(
    system: &Arc<System>,
    symmetry: &Symmetry,
) -> Result<Option<Vec<Option<DMatrix<f64>>>>> {
    if system.elements().iter().any(|placed| placed.has_feedback) {
        return Ok(None);
    }
    let grid = TimeGrid::even_or_odd(POINTS * symmetry.blades, system.period())?;
    let mut equations = Collocation::new(system.clone(), grid)?;
    let mut state = GridState::reference(system, grid);
    let count = grid.points();
    for (node, reference) in system.reference().iter().enumerate() {
        for k in 0..count {
            let fraction = k as f64 / count as f64;
            state.motions[node * count + k] = symmetry.turned(node, reference, fraction);
        }
    }
    state.track_through(system);
    let carries = carries(&mut equations, symmetry, &state)?;
    let tried = LikeBlades::new(system, symmetry, count, &carries);
    let leaders = Arc::new(Leaders::new(system, &tried));

    // Constraint forces, where constraints are met; then everything else, anywhere.
    let mut loaded = state.clone();
    let force = system.scales().force;
    for (i, x) in loaded.multipliers.iter_mut().enumerate() {
        *x = force * spread(i);
    }
    for placed in system.elements().iter().filter(|p| p.has_states) {
        for k in 0..count {
            loaded.own_of_mut(placed, k).fill(0.0);
        }
    }
    tried.make_alike(system, equations.column_scale(), &mut loaded);
    equations.update_kinematics_by(Some(leaders.clone()), &loaded);
    require_alike(&mut equations, symmetry, &carries, (&loaded, true))?;
    let length = system.scales().length;
    for (i, motion) in state.motions.iter_mut().enumerate() {
        if !leaders.leads(i / count) {
            continue;
        }
        let step = Vector6::from_fn(|j, _| TRIED * spread(6 * i + j));
        let scale = Vector6::new(length, length, length, 1.0, 1.0, 1.0);
        *motion = motion.increment(&step.component_mul(&scale));
    }
    tried.make_alike(system, equations.column_scale(), &mut state);
    equations.update_kinematics_by(Some(leaders), &state);
    require_alike(&mut equations, symmetry, &carries, (&state, false))?;
    Ok(Some(carries))
}

/// So much later a blade is where the next one is.
fn later(symmetry: &Symmetry) -> String {
    format!("1/{} of the period later", symmetry.blades)
}

/// Numbers between −1 and 1 without structure.
fn spread(i: usize) -> f64 {
    2.0 * (i as f64 * 0.618_033_988_75 + 0.3).fract() - 1.0
}

/// `∂constraint/∂u` of each element that has multipliers, at one grid point after the other, with
/// scaled rows and columns.
fn gradients(equations: &mut Collocation, state: &GridState) -> Result<Vec<Vec<DMatrix<f64>>>> {
    let system = equations.system().clone();
    let (points, layout) = (state.points(), equations.layout());
    equations.update_kinematics(state);
    let mut workspace = system.workspace(true);
    let columns = equations.column_scale();
    let of_element = |placed: &Placed| {
        let has_multipliers = placed.element.own_unknowns() > 0 && !placed.has_states;
        let at_point = |k: usize| {
            let out = (equations.instants).evaluate(placed, k, state, &mut workspace)?;
            let rows = &equations.row_scale()[layout.element_at(placed, k)];
            let mut matrix = out.gradient.clone();
            for (j, mut column) in matrix.column_iter_mut().enumerate() {
                let entries = column.iter_mut().zip(rows);
                entries.for_each(|(x, row)| *x *= row * columns[j % 6]);
            }
            Ok(matrix)
        };
        (0..if has_multipliers { points } else { 0 })
            .map(at_point)
            .collect()
    };
    system.elements().iter().map(of_element).collect()
}

/// What carries the own unknowns of each element to its image, scaled: the forces that they make
/// have to be those of the image, at all times.
fn carries(
    equations: &mut Collocation,
    symmetry: &Symmetry,
    state: &GridState,
) -> Result<Vec<Option<DMatrix<f64>>>> {
    let system = equations.system().clone();
    let points = state.points();
    let part = points / symmetry.blades;
    let gradients = gradients(equations, state)?;
    let length = system.scales().length;
    let mut carries = Vec::with_capacity(system.elements().len());
    for (index, placed) in system.elements().iter().enumerate() {
        if placed.element.own_unknowns() == 0 || placed.has_states {
            carries.push(None);
            continue;
        }
        let image = symmetry.elements[index];
        let refuse = || {
            let (one, other) = (describe_role(placed.role), system.elements()[image].role);
            not_alike(&format!(
                "{} constrains other motions than {one} does {}",
                describe_role(other),
                later(symmetry)
            ))
        };
        let mut found: Option<DMatrix<f64>> = None;
        for k in 0..points {
            let here = &gradients[image][k];
            let mut there = gradients[index][(k + part) % points].clone();
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let carry = scaled_adjoint(&symmetry.carries[node], length);
                let carried = there.columns(6 * local, 6) * carry;
                there.columns_mut(6 * local, 6).copy_from(&carried);
            }
            let carry = match &found {
                Some(carry) => carry,
                None => {
                    let square = here * here.transpose();
                    let inverse = square.try_inverse().ok_or_else(refuse)?;
                    found.insert(inverse * here * there.transpose())
                }
            };
            let off = here.transpose() * carry - there.transpose();
            // Written so that NaN is refused too.
            let is_alike = off.amax() <= ALIKE * here.amax();
            if !is_alike {
                return Err(refuse());
            }
        }
        carries.push(found);
    }
    Ok(carries)
}

/// What elements of one kind on the same nodes do, at each grid point.
struct Acting {
    role: ElementRole,
    nodes: Vec<usize>,
    /// Whether it is a matter of motions alone, which tell as much at one time as at others: then
    /// forces are those at the first point of two parts of the period.
    is_by_motions: bool,
    /// Forces on the nodes, scaled, at each grid point.
    forces: Vec<DVector<f64>>,
}

/// What elements that act together have in common: their kind, their nodes, and whether what they
/// do is a matter of motions alone.
type Key = (Discriminant<ElementRole>, Vec<usize>, bool);

/// What all elements do.
struct All {
    /// Those of one kind on the same nodes.
    acting: Vec<Acting>,
    /// Place of each kind on its nodes.
    places: HashMap<Key, usize>,
    /// Of each element, at each grid point: what is asked of its own unknowns, scaled.
    asked: Vec<Vec<DVector<f64>>>,
}

impl All {
    /// At a state, of which the equations have the kinematics; of own unknowns, of multipliers
    /// where constraints are `met`, of internal states elsewhere.
    fn at(
        equations: &mut Collocation,
        symmetry: &Symmetry,
        (state, met): (&GridState, bool),
    ) -> Result<Self> {
        let system = equations.system().clone();
        let (points, layout) = (state.points(), equations.layout());
        let part = points / symmetry.blades;
        let mut workspace = system.workspace(false);
        let mut all = All {
            acting: Vec::new(),
            places: HashMap::new(),
            asked: Vec::with_capacity(system.elements().len()),
        };
        let is_plain = equations.instants.is_gravity_constant();
        for placed in system.elements() {
            let has_own = placed.element.own_unknowns() > 0;
            if met && !has_own {
                // All that matters are forces of constraints.
                all.asked.push(Vec::new());
                continue;
            }
            let nodes = placed.element.nodes();
            let is_by_motions = match placed.role {
                ElementRole::Inertia | ElementRole::Beam(_) | ElementRole::Shell(_) => {
                    is_plain && !has_own
                }
                _ => false,
            };
            let key = (discriminant(&placed.role), nodes.to_vec(), is_by_motions);
            let place = *all.places.entry(key).or_insert(all.acting.len());
            if place == all.acting.len() {
                all.acting.push(Acting {
                    role: placed.role,
                    nodes: nodes.to_vec(),
                    is_by_motions,
                    forces: vec![DVector::zeros(6 * nodes.len()); points],
                });
            }
            let mut own = Vec::new();
            let forces = all.acting[place].forces.iter_mut().enumerate();
            for (k, sum) in forces {
                if is_by_motions && k != 0 && k != part {
                    continue;
                }
                let out = (equations.instants).evaluate(placed, k, state, &mut workspace)?;
                for (i, (sum, x)) in sum.iter_mut().zip(&out.force).enumerate() {
                    *sum += x * equations.row_scale()[i % 6];
                }
                if has_own && placed.has_states != met {
                    let rows = &equations.row_scale()[layout.element_at(placed, k)];
                    let scaled = out.constraint.iter().zip(rows).map(|(x, s)| x * s);
                    own.push(DVector::from_iterator(rows.len(), scaled));
                }
            }
            all.asked.push(own);
        }
        Ok(all)
    }
}

/// Checks that the forces of all elements at a state in which blades move alike, of which the
/// equations have the kinematics, are alike, and what is asked of their own unknowns: of
/// multipliers where constraints are `met`, of internal states elsewhere.
fn require_alike(
    equations: &mut Collocation,
    symmetry: &Symmetry,
    carries: &[Option<DMatrix<f64>>],
    (state, met): (&GridState, bool),
) -> Result<()> {
    let all = All::at(equations, symmetry, (state, met))?;
    require_like_demands(equations.system(), symmetry, carries, &all.asked)?;
    let forces = all.acting.iter().flat_map(|acting| &acting.forces);
    let largest = forces.fold(0.0f64, |most, forces| most.max(forces.amax()));
    let length = equations.system().scales().length;
    for acting in &all.acting {
        let images = acting.nodes.iter().map(|&node| symmetry.nodes[node]);
        let key = (
            discriminant(&acting.role),
            images.collect(),
            acting.is_by_motions,
        );
        let image = all.places.get(&key).map(|&i| &all.acting[i]);
        acting.require_like((image, largest), symmetry, length)?;
    }
    Ok(())
}

impl Acting {
    /// Checks that the forces are those of the image, if there is one, or else none; those that
    /// rounding leaves of the `largest` of all are none.
    fn require_like(
        &self,
        (image, largest): (Option<&Acting>, f64),
        symmetry: &Symmetry,
        length: f64,
    ) -> Result<()> {
        let Acting {
            role,
            nodes,
            is_by_motions,
            forces,
        } = self;
        let (points, later) = (forces.len(), later(symmetry));
        let carries: Vec<_> = (nodes.iter())
            .map(|&node| scaled_adjoint(&symmetry.carries[node], length))
            .collect();
        for k in 0..if *is_by_motions { 1 } else { points } {
            let there = &forces[(k + points / symmetry.blades) % points];
            let mut off = 0.0f64;
            for (local, carry) in carries.iter().enumerate() {
                let carried = carry.tr_mul(&there.fixed_rows::<6>(6 * local));
                let here = image.map_or(Vector6::zeros(), |image| {
                    image.forces[k].fixed_rows::<6>(6 * local).into_owned()
                });
                off = off.max((carried - here).amax());
            }
            // Written so that NaN is refused too.
            let is_alike = off <= ALIKE * there.amax() + NOTHING * largest;
            if is_alike {
                continue;
            }
            let one = describe_role(*role);
            return Err(not_alike(&match image {
                Some(image) if image.nodes == *nodes => {
                    format!("{one} on nodes {nodes:?} does not act as it does {later}")
                }
                Some(image) => format!(
                    "{} on nodes {:?} does not act as {one} on nodes {nodes:?} does {later}",
                    describe_role(image.role),
                    image.nodes
                ),
                None => {
                    format!("{one} on nodes {nodes:?} has no like on the nodes that follow them")
                }
            }));
        }
        Ok(())
    }
}

/// Checks that what is `asked` of the own unknowns of all elements is alike.
fn require_like_demands(
    system: &System,
    symmetry: &Symmetry,
    carries: &[Option<DMatrix<f64>>],
    asked: &[Vec<DVector<f64>>],
) -> Result<()> {
    for (index, placed) in system.elements().iter().enumerate() {
        let image = symmetry.elements[index];
        let (here, there) = (&asked[image], &asked[index]);
        let points = here.len();
        for (k, here) in here.iter().enumerate() {
            let there = &there[(k + points / symmetry.blades) % points];
            let here = match &carries[index] {
                Some(carry) => carry.tr_mul(here),
                None => here.clone(),
            };
            let is_alike = (here - there).amax() <= ALIKE * there.amax().max(1.0);
            if is_alike {
                continue;
            }
            let (one, other) = (placed.role, system.elements()[image].role);
            // Such as the drive.
            let hint = match image == index {
                true => ": a rotor turns about the axis in the positive sense, once in a period",
                false => "",
            };
            return Err(not_alike(&format!(
                "{} does not prescribe what {} does {}{hint}",
                describe_role(other),
                describe_role(one),
                later(symmetry)
            )));
        }
    }
    Ok(())
}
