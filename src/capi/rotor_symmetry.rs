//! Rotors whose blades are alike.

use super::guard::guard;
use super::id::Kind;
use super::model::{self, number, pdn_model};
use super::status::pdn_status;
use crate::error::{Error, ErrorKind};
use nalgebra::Vector3;

/// Says that the blades of a rotor are alike, in place of what was said before: periodic solves,
/// also under conditions, then solve for one blade, the hub and the supports, and the others
/// follow.
///
/// The rotor turns once in a period about its axis, in the positive sense. In the reference
/// configuration each blade is where the one before it gets by a turn of 1/blades; in the motion it
/// is where that one gets a part 1/blades of the period later, and so are the hub, but for that
/// turn, and all that does not turn. What acts on the model has to be so: blades with the same
/// sections, masses, joints and springs, loads and prescribed motions that each blade has a part of
/// the period before the one before it, a hub that is the same after that turn. Supports and
/// gravity may be any. A solve refuses what is not alike, and says what tells blades apart.
///
/// Solutions are those of all blades, as without this. They are solved for so where the number of
/// grid points is a multiple of that of blades, as adaptive solves then choose it; not where time
/// is mapped, equations are oversampled, controllers act or beams are very slender, and only by
/// factors where blades act on each other. Loads and conditions that parameters make different at
/// the blades are solved for in whole. Nothing else takes notice: statics, modes, marches and
/// branches are those of the whole model; multipliers, too, but they are found over the part of
/// the period that one blade takes to the place of the next.
///
/// @param model  the model; not NULL
/// @param axis  array of length 3: direction of the axis, not zero
/// @param blades  number of blades, at least 2
/// @param nodes  array of length [count]: ids of the nodes of all blades, blade after blade, those
///     of each in the same order; all different
/// @param count  number of nodes, a multiple of blades
/// @param hub  array of length [hub_count]: ids of the nodes of the hub, and of whatever else turns
///     with the blades
/// @param hub_count  number of these, maybe 0
/// @param point  array of length 3: a point of the axis \[length\]; NULL for the origin
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE (no
///     direction, or a node twice)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_rotor_symmetry(
    model: *mut pdn_model,
    axis: *const f64,
    blades: i32,
    nodes: *const i32,
    count: usize,
    hub: *const i32,
    hub_count: usize,
    point: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let axis = call.array::<3>(axis, "axis")?;
        let point = call.array_optional::<3>(point, "point")?;
        let most = model.node_count();
        for (name, count) in [("count", count), ("hub_count", hub_count)] {
            if count > most {
                let expected = format!("at most {most} (the number of nodes)");
                return Err(Error::size(name, expected, count));
            }
        }
        let nodes = model::nodes(call, &model, (nodes, count), "nodes")?;
        let hub = model::nodes(call, &model, (hub, hub_count), "hub")?;
        let blades = usize::try_from(blades).unwrap_or(0);
        let of_blade = nodes.len().checked_div(blades).unwrap_or(0);
        if of_blade == 0 || of_blade * blades != nodes.len() {
            let expected = format!("a multiple of the number of blades, {blades}, at least that");
            return Err(Error::size("count", expected, count));
        }
        let blades: Vec<Vec<usize>> = nodes.chunks(of_blade).map(<[usize]>::to_vec).collect();
        let point = point.map_or(Vector3::zeros(), Vector3::from);
        model.set_rotor_symmetry(&Vector3::from(axis), &point, &hub, &blades)
    })
}

/// The rotor whose blades were said to be alike.
///
/// @param model  the model; not NULL
/// @param axis  array of length 3: direction of the axis, of length 1; written on success only
/// @param point  array of length 3: a point of the axis \[length\]; written on success only
/// @param blades  number of blades; written on success only
/// @param nodes_of_blade  number of nodes of each, for ::pdn_model_rotor_node; written on success
///     only
/// @param hub_nodes  number of nodes of the hub; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_AVAILABLE (nothing was said)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_rotor_symmetry(
    model: *const pdn_model,
    axis: *mut f64,
    point: *mut f64,
    blades: *mut i32,
    nodes_of_blade: *mut i32,
    hub_nodes: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let axis = call.out_slice(axis, 3, 3, "axis")?;
        let point = call.out_slice(point, 3, 3, "point")?;
        let blades = call.out(blades, "blades")?;
        let nodes_of_blade = call.out(nodes_of_blade, "nodes_of_blade")?;
        let hub_nodes = call.out(hub_nodes, "hub_nodes")?;
        let rotor = model.rotor_symmetry().ok_or_else(nothing_said)?;
        axis.set(rotor.axis().as_slice());
        point.set(rotor.point().as_slice());
        blades.set(rotor.blades().len() as i32);
        nodes_of_blade.set(rotor.blades()[0].len() as i32);
        hub_nodes.set(rotor.hub().len() as i32);
        Ok(())
    })
}

/// A node of a rotor whose blades were said to be alike.
///
/// @param model  the model; not NULL
/// @param blade  which blade, from 0 on; -1 for the hub
/// @param index  which of its nodes, from 0 on
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_NOT_AVAILABLE (nothing was said)
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_rotor_node(
    model: *const pdn_model,
    blade: i32,
    index: i32,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let rotor = model.rotor_symmetry().ok_or_else(nothing_said)?;
        let nodes = match blade {
            -1 => rotor.hub(),
            _ => {
                let blades = rotor.blades();
                &blades[self::number(blade, blades.len(), "blade", "a blade, or -1")?]
            }
        };
        let place = number(index, nodes.len(), "index", "one of its nodes")?;
        call.out(node, "node")?.set(Kind::Node.id(nodes[place]));
        Ok(())
    })
}

fn nothing_said() -> Error {
    let message = "model: nothing was said of like blades";
    Error::new(ErrorKind::NotAvailable, message)
}
