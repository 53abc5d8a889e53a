//! Quantities as one noun: what is asked of a solution, as values, harmonics, extremes or columns.

use super::call::Call;
use super::guard::{guard, init};
use super::id::Kind;
use super::joint::coordinate;
use super::load::{PDN_FRAME_MATERIAL, PDN_FRAME_SPACE, load_frame};
use super::options::Options;
use super::pointer::check_pointer;
use super::solution::{PDN_FRAME_FIRST, PDN_FRAME_SECOND, pdn_solution};
use super::status::pdn_status;
use super::table::{pdn_table, text_optional};
use crate::elements::{Coordinate, ShellPoint, ShellSide};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::PeriodicSeries;
use crate::memory;
use crate::output::{
    BeamQuantity, Extremes, ForceQuantity, JointQuantity, NodeQuantity, Quantity, ResolvedIn,
    Selection, ShellQuantity,
};
use libc::c_char;
use nalgebra::Vector3;

/// Kind of quantity: position of a node; 3 components \[length\].
pub const PDN_NODE_POSITION: i32 = 100;
/// Kind of quantity: rotation matrix of a node, column by column; 9 components.
pub const PDN_NODE_ROTATION: i32 = 101;
/// Kind of quantity: unit quaternion (w, x, y, z) of a node, of continuous sign; 4 components.
pub const PDN_NODE_QUATERNION: i32 = 102;
/// Kind of quantity: velocity and angular velocity of a node, in a frame; 6 components.
pub const PDN_NODE_VELOCITY: i32 = 103;
/// Kind of quantity: acceleration and angular acceleration of a node, in a frame; 6 components.
pub const PDN_NODE_ACCELERATION: i32 = 104;
/// Kind of quantity: a coordinate of a joint, angles followed through whole turns.
pub const PDN_JOINT_COORDINATE: i32 = 200;
/// Kind of quantity: rate of a coordinate of a joint.
pub const PDN_JOINT_RATE: i32 = 201;
/// Kind of quantity: second derivative in time of a coordinate of a joint.
pub const PDN_JOINT_ACCELERATION: i32 = 202;
/// Kind of quantity: force or torque that drives a prescribed coordinate of a joint.
pub const PDN_JOINT_DRIVING_EFFORT: i32 = 203;
/// Kind of quantity: force and moment of a joint on its second body, along axes; 6 components.
pub const PDN_JOINT_REACTION: i32 = 204;
/// Kind of quantity: strains and curvatures of a beam element; 6 components.
pub const PDN_BEAM_STRAIN: i32 = 300;
/// Kind of quantity: internal forces and moments of a beam element; 6 components.
pub const PDN_BEAM_FORCE: i32 = 301;
/// Kind of quantity: the same, at a node between two elements the mean of those of both.
pub const PDN_BEAM_FORCE_MEAN: i32 = 302;
/// Kind of quantity: at a node between two elements, internal forces of the one beyond it less
/// those of the one before it; zero elsewhere; 6 components.
pub const PDN_BEAM_FORCE_JUMP: i32 = 303;
/// Kind of quantity: effort of a force on its joint coordinate.
pub const PDN_FORCE_EFFORT: i32 = 400;
/// Kind of quantity: effort of a branch of a viscoelastic element.
pub const PDN_FORCE_BRANCH_EFFORT: i32 = 401;
/// Kind of quantity: elongation of the dashpot of a branch of a viscoelastic element.
pub const PDN_FORCE_BRANCH_ELONGATION: i32 = 402;
/// Kind of quantity: what a force exerts on one of its nodes, in a frame: force and moment; 6
/// components.
pub const PDN_FORCE_ON_NODE: i32 = 403;
/// Kind of quantity: the efforts of a bushing against its deformation, forces along the axes of its
/// first frame and moments; 6 components.
pub const PDN_FORCE_BUSHING_EFFORTS: i32 = 404;
/// Kind of quantity: effort of a controller on one of the coordinates that it acts on, towards
/// growth.
pub const PDN_FORCE_CONTROL_EFFORT: i32 = 405;
/// Kind of quantity: a state of a controller.
pub const PDN_FORCE_CONTROL_STATE: i32 = 406;
/// Kind of quantity: strains of a shell element, in the order of ::pdn_shell_section; 12
/// components.
pub const PDN_SHELL_STRAIN: i32 = 500;
/// Kind of quantity: forces and moments of a shell element per unit of reference length, in the
/// same order: N11 N12 Q1 M11 M12 M1n, N21 N22 Q2 M21 M22 M2n; 12 components.
pub const PDN_SHELL_RESULTANT: i32 = 501;
/// Kind of quantity: stresses 11, 22, 12 at the surface of an isotropic shell that its normal
/// points out of, and von Mises' stress of these \[force / length^2\]; 4 components.
pub const PDN_SHELL_STRESS_TOP: i32 = 502;
/// Kind of quantity: the same at the other surface; 4 components.
pub const PDN_SHELL_STRESS_BOTTOM: i32 = 503;
/// Kind of quantity: effort of a linear relation on one of its joint coordinates, towards growth.
pub const PDN_RELATION_EFFORT: i32 = 600;

/// All components of a quantity.
pub const PDN_ALL_COMPONENTS: i32 = -2;

/// What is asked of a solution: of a node, a joint, a beam, a shell, a force or a relation.
/// Initialise with
/// `PDN_INIT(pdn_quantity, &quantity)`; fields that its kind does not have stay as they are.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_quantity {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_NODE_POSITION, ...; there is no default.
    pub kind: i32,
    /// Id of the node, joint, beam element, shell element, force or relation that it is of.
    pub object: i32,
    /// The component, from 0, or PDN_ALL_COMPONENTS, the default. Of coordinates and driving
    /// efforts, the coordinate: PDN_DISPLACEMENT, ..., PDN_ROTATION_3; of relations which of their
    /// coordinates, from 0.
    pub component: i32,
    /// PDN_FRAME_SPACE, the default, or PDN_FRAME_MATERIAL; of reactions PDN_FRAME_SPACE,
    /// PDN_FRAME_FIRST or PDN_FRAME_SECOND.
    pub frame: i32,
    /// Of what a force exerts on one of its nodes, the node.
    pub node: i32,
    /// Of viscoelastic elements, the branch, from 0; of controllers, which of the coordinates that
    /// they act on, or which state, from 0.
    pub branch: i32,
    /// Of beams, the place along the element, from -1 at its first to 1 at its last node; of
    /// shells, xi, from -1 to 1.
    pub station: f64,
    /// Of shells, eta, from -1 to 1.
    pub station_eta: f64,
    /// Of shells, a direction in the reference configuration, global coordinates, whose part in the
    /// surface is axis 1. If it is zero, the default, axes are those of the section. They move with
    /// the shell.
    pub direction: [f64; 3],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_quantity {
    const SIZES: &'static [usize] = &[40, 72];

    fn defaults() -> Self {
        pdn_quantity {
            component: PDN_ALL_COMPONENTS,
            frame: PDN_FRAME_SPACE,
            ..Self::blank()
        }
    }
}

/// Prepares a struct that tells a quantity; use `PDN_INIT(pdn_quantity, &quantity)`.
///
/// @param quantity  the struct; not NULL
/// @param struct_size  `sizeof *quantity`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_quantity_init(quantity: *mut pdn_quantity, struct_size: usize) {
    init(quantity, struct_size, "quantity");
}

impl pdn_quantity {
    /// What C means.
    fn meant(&self) -> Result<Selection> {
        let object = |kind: Kind| kind.index(self.object, "quantity.object");
        let of_node = |quantity| Ok(Quantity::Node(object(Kind::Node)?, quantity));
        let in_frame = |space, material| of_node(self.in_frame(space, material)?);
        let of_joint = |quantity| Ok(Quantity::Joint(object(Kind::Joint)?, quantity));
        let of_beam = |quantity| {
            Ok(Quantity::Beam {
                element: object(Kind::BeamElement)?,
                station: self.station,
                quantity,
            })
        };
        let of_force = |quantity| Ok(Quantity::Force(object(Kind::Force)?, quantity));
        let branch = || place(self.branch, "quantity.branch");
        let quantity: Result<Quantity> = match self.kind {
            PDN_NODE_POSITION => of_node(NodeQuantity::Position),
            PDN_NODE_ROTATION => of_node(NodeQuantity::RotationMatrix),
            PDN_NODE_QUATERNION => of_node(NodeQuantity::Quaternion),
            PDN_NODE_VELOCITY => in_frame(NodeQuantity::Velocity, NodeQuantity::MaterialVelocity),
            PDN_NODE_ACCELERATION => in_frame(
                NodeQuantity::Acceleration,
                NodeQuantity::MaterialAcceleration,
            ),
            PDN_JOINT_REACTION => of_joint(self.reaction()?),
            PDN_BEAM_STRAIN => of_beam(BeamQuantity::Strain),
            PDN_BEAM_FORCE => of_beam(BeamQuantity::Force),
            PDN_BEAM_FORCE_MEAN => of_beam(BeamQuantity::MeanForce),
            PDN_BEAM_FORCE_JUMP => of_beam(BeamQuantity::ForceJump),
            PDN_SHELL_STRAIN => self.of_shell(ShellQuantity::Strain),
            PDN_SHELL_RESULTANT => self.of_shell(ShellQuantity::Resultant),
            PDN_SHELL_STRESS_TOP => self.of_shell(ShellQuantity::SurfaceStress(ShellSide::Top)),
            PDN_SHELL_STRESS_BOTTOM => {
                self.of_shell(ShellQuantity::SurfaceStress(ShellSide::Bottom))
            }
            PDN_FORCE_EFFORT => of_force(ForceQuantity::Effort),
            PDN_FORCE_BUSHING_EFFORTS => of_force(ForceQuantity::BushingEfforts),
            PDN_FORCE_BRANCH_EFFORT => of_force(ForceQuantity::BranchEffort(branch()?)),
            PDN_FORCE_BRANCH_ELONGATION => of_force(ForceQuantity::BranchElongation(branch()?)),
            PDN_FORCE_CONTROL_EFFORT => of_force(ForceQuantity::ControlEffort(branch()?)),
            PDN_FORCE_CONTROL_STATE => of_force(ForceQuantity::ControlState(branch()?)),
            PDN_FORCE_ON_NODE => {
                let node = Kind::Node.index(self.node, "quantity.node")?;
                let frame = load_frame(self.frame).map_err(|e| e.within("quantity"))?;
                of_force(ForceQuantity::OnNode(node, frame))
            }
            PDN_RELATION_EFFORT => {
                let quantity = Quantity::RelationEffort {
                    relation: object(Kind::Relation)?,
                    coordinate: place(self.component, "quantity.component")?,
                };
                return Ok(quantity.into());
            }
            // Their component is the coordinate.
            _ => return Ok(of_joint(self.of_coordinate()?)?.into()),
        };
        let quantity = quantity?;
        let component = match self.component {
            PDN_ALL_COMPONENTS => None,
            component => Some(place(component, "quantity.component")?),
        };
        if let Some(component) = component {
            let checked = quantity.require_component(component);
            checked.map_err(|e| e.within("quantity"))?;
        }
        Ok(Selection {
            quantity,
            component,
        })
    }

    /// Velocities and accelerations along the axes that are asked for.
    fn in_frame(&self, space: NodeQuantity, material: NodeQuantity) -> Result<NodeQuantity> {
        match self.frame {
            PDN_FRAME_SPACE => Ok(space),
            PDN_FRAME_MATERIAL => Ok(material),
            frame => {
                let expected = "PDN_FRAME_SPACE or PDN_FRAME_MATERIAL";
                Err(Error::value("quantity.frame", expected, frame))
            }
        }
    }

    fn reaction(&self) -> Result<JointQuantity> {
        let axes = match self.frame {
            PDN_FRAME_SPACE => ResolvedIn::Space,
            PDN_FRAME_FIRST => ResolvedIn::First,
            PDN_FRAME_SECOND => ResolvedIn::Second,
            frame => {
                let expected = "PDN_FRAME_SPACE, PDN_FRAME_FIRST or PDN_FRAME_SECOND";
                return Err(Error::value("quantity.frame", expected, frame));
            }
        };
        Ok(JointQuantity::Reaction(axes))
    }

    fn of_shell(&self, quantity: ShellQuantity) -> Result<Quantity> {
        let at = [self.station, self.station_eta];
        for (name, coordinate) in ["station", "station_eta"].iter().zip(at) {
            require_finite(&format!("quantity.{name}"), &[coordinate])?;
            if !(-1.0..=1.0).contains(&coordinate) {
                let name = format!("quantity.{name}");
                return Err(Error::value(&name, "a number from -1 to 1", coordinate));
            }
        }
        require_finite("quantity.direction", &self.direction)?;
        let direction = Vector3::from(self.direction);
        Ok(Quantity::Shell {
            element: Kind::ShellElement.index(self.object, "quantity.object")?,
            point: ShellPoint {
                at,
                axis: (direction != Vector3::zeros()).then_some(direction),
            },
            quantity,
        })
    }

    fn of_coordinate(&self) -> Result<JointQuantity> {
        let kind: fn(Coordinate) -> JointQuantity = match self.kind {
            PDN_JOINT_COORDINATE => JointQuantity::Coordinate,
            PDN_JOINT_RATE => JointQuantity::Rate,
            PDN_JOINT_ACCELERATION => JointQuantity::Acceleration,
            PDN_JOINT_DRIVING_EFFORT => JointQuantity::DrivingEffort,
            kind => {
                let expected = "PDN_NODE_POSITION, ...";
                return Err(Error::value("quantity.kind", expected, kind));
            }
        };
        Ok(kind(coordinate(self.component, "quantity.component")?))
    }
}

/// A place in a list whose length the core knows.
fn place(given: i32, name: &str) -> Result<usize> {
    usize::try_from(given).map_err(|_| {
        let message = format!("{name}: expected a number from 0 on, got {given}");
        Error::new(ErrorKind::Identifier, message)
    })
}

/// Reads what is asked for, which has no default.
pub(super) fn selection(call: &Call, quantity: *const pdn_quantity) -> Result<Selection> {
    check_pointer(quantity, 1, "quantity")?;
    call.options(quantity, "quantity")?.meant()
}

/// Reads a list of what is asked for.
pub(super) fn selections(
    call: &Call,
    quantities: *const pdn_quantity,
    count: usize,
) -> Result<Vec<Selection>> {
    let all = call.structs(quantities, count, "quantities")?;
    let meant = all.iter().enumerate().map(|(i, quantity)| {
        let meant = quantity.meant();
        meant.map_err(|e| e.within(format!("quantities[{i}]")))
    });
    meant.collect()
}

/// Number of components that are asked for: of values at a time, of means and of harmonics.
///
/// @param quantity  initialised by PDN_INIT; not NULL
/// @return the number; negative, as a ::pdn_status (PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_ID,
///     PDN_ERR_VALUE), if there is no such quantity
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_quantity_components(quantity: *const pdn_quantity) -> i32 {
    let mut count = 0;
    let status = guard(|call| {
        // No more than 12.
        count = selection(call, quantity)?.components() as i32;
        Ok(())
    });
    if status < 0 { status } else { count }
}

/// A quantity of a solution at any times.
///
/// Motions of nodes are interpolated over the whole period by dual polar decomposition, all else
/// from its values at the grid points.
///
/// @param solution  the solution; not NULL
/// @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
/// @param times  array of length [count]: times, also outside the first period
/// @param count  number of times
/// @param out  array of shape C x [count], components of each time together
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE, PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_sample(
    solution: *const pdn_solution,
    quantity: *const pdn_quantity,
    times: *const f64,
    count: usize,
    out: *mut f64,
) -> pdn_status {
    // Times and place are checked before anything is computed.
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let times = call.numbers(times, count, "times")?;
        let quantity = selection(call, quantity)?;
        let length = count.checked_mul(quantity.components());
        let length =
            length.ok_or_else(|| Error::size("count", "a length that fits in memory", count))?;
        let out = call.out_slice(out, length, length, "out")?;
        out.set(&solution.sample(quantity, times)?);
        Ok(())
    })
}

/// Far more than any grid has; lengths of arrays do not overflow.
const MOST_HARMONICS: usize = 1 << 20;

/// Fourier coefficients of a quantity: mean + rate t + sum of cosines[j] cos jwt + sines[j] sin
/// jwt.
///
/// Those of the trigonometric polynomial through the values at the grid points.
///
/// @param solution  the solution; not NULL
/// @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
/// @param harmonics  number of harmonics wanted; those above (N - 1) / 2 are zero
/// @param mean  array of length C; may be NULL
/// @param rate  array of length C: growth per unit of time, of what gains turns; may be NULL
/// @param cosines  array of shape C x [harmonics], components of each harmonic together; may be
///     NULL
/// @param sines  array of shape C x [harmonics], components of each harmonic together; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (of a trajectory; the quaternion of a node that makes
///     an odd number of turns), PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_harmonics(
    solution: *const pdn_solution,
    quantity: *const pdn_quantity,
    harmonics: usize,
    mean: *mut f64,
    rate: *mut f64,
    cosines: *mut f64,
    sines: *mut f64,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        solution.require_harmonics()?;
        if harmonics > MOST_HARMONICS {
            let expected = format!("at most {MOST_HARMONICS}");
            return Err(Error::size("harmonics", expected, harmonics));
        }
        let quantity = selection(call, quantity)?;
        let single = quantity.components();
        let many = single * harmonics;
        memory::require_items("harmonics", many, 2 * size_of::<f64>())?;
        let mean = call.out_slice_optional(mean, single, "mean")?;
        let rate = call.out_slice_optional(rate, single, "rate")?;
        let cosines = call.out_slice_optional(cosines, many, "cosines")?;
        let sines = call.out_slice_optional(sines, many, "sines")?;
        let series = solution.series(quantity)?;
        let each = |of: fn(&PeriodicSeries) -> f64| series.iter().map(of).collect::<Vec<f64>>();
        // There are none above those of the grid.
        let by_harmonic = |coefficients: fn(&PeriodicSeries) -> &[f64]| -> Vec<f64> {
            let of = |j: usize| {
                let all = series.iter().map(coefficients);
                all.map(move |x| x.get(j).copied().unwrap_or(0.0))
            };
            (0..harmonics).flat_map(of).collect()
        };
        if let Some(out) = mean {
            out.set(&each(|s| s.mean));
        }
        if let Some(out) = rate {
            out.set(&each(|s| s.rate));
        }
        if let Some(out) = cosines {
            out.set(&by_harmonic(|s| &s.cosines));
        }
        if let Some(out) = sines {
            out.set(&by_harmonic(|s| &s.sines));
        }
        Ok(())
    })
}

/// Smallest and largest values of a quantity, and their times.
///
/// Over the period, of the trigonometric polynomial through the values at the grid points; of a
/// trajectory, among its times.
///
/// @param solution  the solution; not NULL
/// @param quantity  what is asked for, C components; initialised by PDN_INIT; not NULL
/// @param smallest  array of length C; may be NULL
/// @param time_of_smallest  array of length C; may be NULL
/// @param largest  array of length C; may be NULL
/// @param time_of_largest  array of length C; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE, PDN_ERR_OVERFLOW
///
/// Threads: like `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_extremes(
    solution: *const pdn_solution,
    quantity: *const pdn_quantity,
    smallest: *mut f64,
    time_of_smallest: *mut f64,
    largest: *mut f64,
    time_of_largest: *mut f64,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let quantity = selection(call, quantity)?;
        let count = quantity.components();
        type Value = fn(&Extremes) -> f64;
        let columns: [(_, Value); 4] = [
            (call.out_slice_optional(smallest, count, "smallest")?, |e| {
                e.smallest
            }),
            (
                call.out_slice_optional(time_of_smallest, count, "time_of_smallest")?,
                |e| e.time_of_smallest,
            ),
            (call.out_slice_optional(largest, count, "largest")?, |e| {
                e.largest
            }),
            (
                call.out_slice_optional(time_of_largest, count, "time_of_largest")?,
                |e| e.time_of_largest,
            ),
        ];
        let found = solution.extremes(quantity)?;
        for (out, value) in columns {
            if let Some(out) = out {
                out.set(&found.iter().map(value).collect::<Vec<f64>>());
            }
        }
        Ok(())
    })
}

/// Adds the columns of a quantity of a solution, named by the label and the component; or that of
/// one component, named by the label alone.
///
/// @param table  the table; not NULL
/// @param solution  the solution; not NULL
/// @param quantity  what is asked for; one column for each component; initialised by PDN_INIT; not
///     NULL
/// @param label  columns are called `label.x` and so on; NULL for a name such as `node3.position`
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE (also of a name that a column has already), PDN_ERR_NOT_AVAILABLE,
///     PDN_ERR_GRID_TOO_COARSE, PDN_ERR_OVERFLOW
///
/// Threads: exclusive use of `table`; like `const` of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_table_add_quantity(
    table: *mut pdn_table,
    solution: *const pdn_solution,
    quantity: *const pdn_quantity,
    label: *const c_char,
) -> pdn_status {
    guard(|call| {
        let mut table = call.exclusive(table, "table")?;
        let solution = call.shared(solution, "solution")?;
        let label = text_optional(call, label, "label")?;
        table.add(&solution, selection(call, quantity)?, label)
    })
}
