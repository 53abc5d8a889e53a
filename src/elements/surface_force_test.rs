//! A user's forces on shells and beams, for the test of tangents.

use super::{LoadFrame, SurfaceForceInput, SurfaceForceLaw, SurfaceForceOutput};
use crate::error::Result;
use crate::motion::skew;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use std::sync::Arc;

/// Laws in both kinds of axes, with and without tangents, by their names.
pub fn laws() -> Vec<(String, SurfaceForceLaw)> {
    let mut laws = Vec::new();
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        for gives_tangents in [true, false] {
            let end = if gives_tangents { "" } else { ", differenced" };
            let function = move |input: &SurfaceForceInput, output: &mut SurfaceForceOutput| {
                forces(frame, input, output)
            };
            let law = SurfaceForceLaw {
                function: Arc::new(function),
                gives_tangents,
                frame,
            };
            laws.push((format!("{frame:?}{end}"), law));
        }
    }
    laws
}

/// With position `d` and `a = R e₁`: `[d² v + a × ω; (a·d) d + v² ω]`, whatever the axes.
fn forces(
    frame: LoadFrame,
    input: &SurfaceForceInput,
    output: &mut SurfaceForceOutput,
) -> Result<()> {
    let half = |v: &Vector6<f64>, first| -> Vector3<f64> { v.fixed_rows::<3>(first).into() };
    for (k, velocity) in input.velocities.iter().enumerate() {
        let (d, rotation) = (input.positions[k], input.rotations[k]);
        let a: Vector3<f64> = rotation.column(0).into();
        let (v, w) = (half(velocity, 0), half(velocity, 3));
        let force = v * d.dot(&d) + a.cross(&w);
        let moment = d * a.dot(&d) + w * v.dot(&v);
        let rows = output.forces[k].as_mut_slice();
        rows[..3].copy_from_slice(force.as_slice());
        rows[3..].copy_from_slice(moment.as_slice());
        let Some([stiffness, damping]) = &mut output.tangents else {
            continue;
        };
        // Increments along the point's axes are those in space, turned.
        let turn = match frame {
            LoadFrame::Follower => rotation,
            LoadFrame::Space => Matrix3::identity(),
        };
        let identity = Matrix3::identity();
        let set = |m: &mut Matrix6<f64>, row: usize, column: usize, block: Matrix3<f64>| {
            m.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        };
        let (by_motion, by_velocity) = (&mut stiffness[k], &mut damping[k]);
        set(by_motion, 0, 0, v * d.transpose() * turn * 2.0);
        set(by_motion, 0, 3, skew(&w) * skew(&a) * turn);
        let by_d = d * a.transpose() + identity * a.dot(&d);
        set(by_motion, 3, 0, by_d * turn);
        set(by_motion, 3, 3, d * a.cross(&d).transpose() * turn);
        set(by_velocity, 0, 0, identity * d.dot(&d));
        set(by_velocity, 0, 3, skew(&a));
        set(by_velocity, 3, 0, w * v.transpose() * 2.0);
        set(by_velocity, 3, 3, identity * v.dot(&v));
    }
    Ok(())
}
