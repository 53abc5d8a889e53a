//! Motions as such, without a model: interpolation over a period, and its linearisation on the
//! grid.

use super::call::Call;
use super::guard::guard;
use super::model::{pdn_frame, vector};
use super::periodic::read_motion;
use super::status::pdn_status;
use crate::collocation::{KinematicsScratch, NodeKinematics};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{CardinalWeights, Differentiation, TimeGrid};
use crate::model::Model;
use crate::motion::{Motion, PeriodicMotion};

fn read_motions(
    call: &Call,
    positions: *const f64,
    rotations: *const f64,
    points: usize,
) -> Result<Vec<Motion>> {
    if points == 0 {
        return Err(Error::size("points", "at least 1", 0));
    }
    let positions = call.numbers(positions, points.saturating_mul(3), "positions")?;
    let rotations = call.numbers(rotations, points.saturating_mul(9), "rotations")?;
    (0..points)
        .map(|i| read_motion(positions, rotations, i, "rotations"))
        .collect()
}

fn grid(call: &Call, period: f64, points: usize) -> Result<TimeGrid> {
    let period = call.number(period, "period")?;
    TimeGrid::new(points, period).map_err(|e| {
        if e.kind() == ErrorKind::Size {
            Error::size("points", "an odd number", points)
        } else {
            e
        }
    })
}

/// Interpolates a periodic motion given at N equispaced times, by dual polar decomposition.
///
/// Exponentially accurate as N grows, for rotations and translations of any size (section 4 of Han
/// and Bauchau, Nonlinear Dynamics 92, 2018).
///
/// @param period  T, the period of the motion
/// @param positions  array of shape 3 x [points]: positions at t = k T / N
/// @param rotations  array of shape 9 x [points]: rotation matrices, each column by column
/// @param points  N, odd
/// @param times  array of length [count]: times wanted, anywhere
/// @param count  number of times
/// @param position  array of shape 3 x [count]; may be NULL
/// @param rotation  array of shape 9 x [count], each matrix column by column; may
///     be NULL
/// @param velocity  array of shape 6 x [count]: linear and angular velocity along the moving axes;
///     may be NULL
/// @param acceleration  array of shape 6 x [count]: time derivative of velocity; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE,
///     PDN_ERR_GRID_TOO_COARSE
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_motion_interpolate(
    period: f64,
    positions: *const f64,
    rotations: *const f64,
    points: usize,
    times: *const f64,
    count: usize,
    position: *mut f64,
    rotation: *mut f64,
    velocity: *mut f64,
    acceleration: *mut f64,
) -> pdn_status {
    guard(|call| {
        let grid = grid(call, period, points)?;
        let motions = read_motions(call, positions, rotations, points)?;
        let times = call.numbers(times, count, "times")?;
        let out = |pointer, components: usize, name| {
            call.out_slice_optional(pointer, count.saturating_mul(components), name)
        };
        let outputs = [
            out(position, 3, "position")?,
            out(rotation, 9, "rotation")?,
            out(velocity, 6, "velocity")?,
            out(acceleration, 6, "acceleration")?,
        ];

        let interpolation = PeriodicMotion::new(&motions);
        let mut weights = CardinalWeights::new(grid);
        let mut values: [Vec<f64>; 4] = Default::default();
        for &time in times {
            weights.move_to(time);
            let state = interpolation.at(&weights).ok_or_else(|| {
                let message = format!(
                    "points: {points} grid points are too coarse to interpolate this motion at t \
                     = {time}"
                );
                Error::new(ErrorKind::GridTooCoarse, message)
            })?;
            values[0].extend(state.motion.position.iter());
            values[1].extend(state.motion.rotation.iter());
            values[2].extend(state.twist.iter());
            values[3].extend(state.twist_rate.iter());
        }
        for (output, values) in outputs.into_iter().zip(&values) {
            if let Some(output) = output {
                output.set(values);
            }
        }
        Ok(())
    })
}

/// Velocities and accelerations of a motion at its own grid points, and their exact linearisation.
///
/// With the material increments u = (R^T dr, dpsi) of the motions, ordered as 6 for each point, d
/// velocity = velocity_tangent u and d acceleration = acceleration_tangent u (eqs. 24 to 29 of the
/// paper).
///
/// @param period  T, the period of the motion
/// @param positions  array of shape 3 x [points]: positions at t = k T / N
/// @param rotations  array of shape 9 x [points]: rotation matrices, each column by column
/// @param points  N, odd
/// @param velocity  array of shape 6 x [points]: linear and angular velocity along the moving axes;
///     may be NULL
/// @param acceleration  array of shape 6 x [points]: time derivative of velocity; may be NULL
/// @param velocity_tangent  array of shape [6 * points] x [6 * points]: derivatives of
///     velocity by u, column by column; may be NULL
/// @param acceleration_tangent  array of shape [6 * points] x [6 * points]: derivatives of
///     acceleration by u, column by column; may be NULL
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_VALUE
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_motion_grid_kinematics(
    period: f64,
    positions: *const f64,
    rotations: *const f64,
    points: usize,
    velocity: *mut f64,
    acceleration: *mut f64,
    velocity_tangent: *mut f64,
    acceleration_tangent: *mut f64,
) -> pdn_status {
    guard(|call| {
        let grid = grid(call, period, points)?;
        let motions = read_motions(call, positions, rotations, points)?;
        let size = 6 * points;
        let square = size.saturating_mul(size);
        let outputs = [
            call.out_slice_optional(velocity, size, "velocity")?,
            call.out_slice_optional(acceleration, size, "acceleration")?,
            call.out_slice_optional(velocity_tangent, square, "velocity_tangent")?,
            call.out_slice_optional(acceleration_tangent, square, "acceleration_tangent")?,
        ];

        let mut operators = Differentiation::new(grid);
        let mut node = NodeKinematics::default();
        node.evaluate(&mut operators, &motions, &mut KinematicsScratch::default());
        let mut values: [Vec<f64>; 4] = Default::default();
        for l in 0..points {
            values[0].extend(node.velocity(l).to_twist().iter());
            values[1].extend(node.acceleration(l).to_twist().iter());
        }
        if outputs[2].is_some() || outputs[3].is_some() {
            values[2].resize(square, 0.0);
            values[3].resize(square, 0.0);
            for k in 0..points {
                for l in 0..points {
                    let weights = (operators.first(l, k), operators.second(l, k));
                    let [gamma_v, gamma_a] = node.tangent(weights, l, k);
                    for (target, gamma) in [(2, gamma_v), (3, gamma_a)] {
                        let block = gamma.to_twist_matrix();
                        for c in 0..6 {
                            let first = (6 * k + c) * size + 6 * l;
                            values[target][first..first + 6]
                                .copy_from_slice(block.column(c).as_slice());
                        }
                    }
                }
            }
        }
        for (output, values) in outputs.into_iter().zip(&values) {
            if let Some(output) = output {
                output.set(values);
            }
        }
        Ok(())
    })
}

/// A frame from a point and two directions, such as that of a joint or a bushing.
///
/// @param point  array of length 3: its origin, global coordinates [length]
/// @param axis_3  array of length 3: direction of its axis 3, global coordinates, of any nonzero
///     length
/// @param axis_1  array of length 3: direction whose part across axis 3 is its axis 1, global
///     coordinates; not along axis 3
/// @param frame  the frame; axis 2 is what makes it right-handed; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_joint_frame(
    point: *const f64,
    axis_3: *const f64,
    axis_1: *const f64,
    frame: *mut pdn_frame,
) -> pdn_status {
    guard(|call| {
        let point = vector(call, point, "point")?;
        let axis_3 = vector(call, axis_3, "axis_3")?;
        let axis_1 = vector(call, axis_1, "axis_1")?;
        let frame = call.out(frame, "frame")?;
        frame.set((&Model::frame_with_axes(&point, &axis_3, &axis_1)?).into());
        Ok(())
    })
}
