//! Plates and shells: their sections, elements, meshes and loads.

use super::call::Call;
use super::guard::{guard, init};
use super::id::Kind;
use super::load::{components, load_frame};
use super::model::{self, add_object, choose, element_count, number, pdn_model};
use super::options::Options;
use super::pointer::check_pointer;
use super::section::{read_struct, update_struct};
use super::signal::pdn_signal;
use super::status::pdn_status;
use super::surface::{self, pdn_surface};
use crate::elements::{
    IsotropicShell, Matrix12, ShellFrames, ShellLoadPlace, ShellSection, Vector12,
};
use crate::error::{Error, Result, require_finite};
use crate::model::{Model, QuadrilateralMesh, ShellLoadDefinition, ShellMesh, ShellPlacement};
use nalgebra::{Matrix6, Vector3};
use std::mem::offset_of;

/// Frames of a shell: along the normals of its surface at the nodes.
pub const PDN_SHELL_NORMALS: i32 = 1900;
/// Frames of a shell: parallel at all nodes of an element. Somewhat better on curved elements of
/// three and more nodes a side; thin warped elements of two nodes a side lock.
pub const PDN_SHELL_PARALLEL: i32 = 1901;
/// Frames of a shell: along the third axes of the nodes' own frames, as normals of a surface that
/// is known better than its elements show it; of use with two nodes a side.
pub const PDN_SHELL_NODE_AXES: i32 = 1902;
/// Frames of a shell: those of the nodes themselves, with their third axes for normals, if they are
/// known from elsewhere. Those of an element should turn from node to node no more than it does.
pub const PDN_SHELL_NODE_FRAMES: i32 = 1903;

/// Place of a load on a shell element: its edge where eta = -1, along xi.
pub const PDN_SHELL_EDGE_START_ETA: i32 = 2000;
/// Place of a load on a shell element: its edge where xi = 1, along eta.
pub const PDN_SHELL_EDGE_END_XI: i32 = 2001;
/// Place of a load on a shell element: its edge where eta = 1, along xi.
pub const PDN_SHELL_EDGE_END_ETA: i32 = 2002;
/// Place of a load on a shell element: its edge where xi = -1, along eta.
pub const PDN_SHELL_EDGE_START_XI: i32 = 2003;
/// Place of a load on a shell element: its surface.
pub const PDN_SHELL_SURFACE: i32 = 2004;

/// Stiffness, damping and mass of a shell, per unit of its reference area.
///
/// Strains are `[e11 e12 g1 k11 k12 k1n, e21 e22 g2 k21 k22 k2n]`: how position and frame of the
/// surface change along axis 1, then along axis 2, resolved in axes 1, 2 and the normal. Bending of
/// lines along axis 1 is k12, along axis 2 -k21; twist is -k11 and k22; e12 - e21 is the drilling
/// rotation against the surface. Forces and moments per length are in the same order. The matrices
/// are column-major and symmetric. Any consistent set of units.
///
/// Start with `PDN_INIT(pdn_shell_section, &section)`; then ::pdn_shell_section_set_isotropic, or
/// write the matrices yourself, as of laminates. A section without stiffness is refused where it is
/// used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_shell_section {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Forces and moments for unit strains, 12 x 12; positive definite.
    pub stiffness: [f64; 144],
    /// The same for unit rates of strain; positive semi-definite.
    pub damping: [f64; 144],
    /// Momenta for unit velocities, 6 x 6; positive semi-definite.
    pub mass: [f64; 36],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_shell_section {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] = &[offset_of!(pdn_shell_section, mass) + size_of::<[f64; 36]>()];
}

impl pdn_shell_section {
    pub(super) fn core(&self) -> ShellSection {
        ShellSection {
            stiffness: Matrix12::from_column_slice(&self.stiffness),
            damping: Matrix12::from_column_slice(&self.damping),
            mass: Matrix6::from_column_slice(&self.mass),
        }
    }

    fn set(&mut self, section: &ShellSection) {
        self.stiffness.copy_from_slice(section.stiffness.as_slice());
        self.damping.copy_from_slice(section.damping.as_slice());
        self.mass.copy_from_slice(section.mass.as_slice());
    }
}

/// How a shell lies on its nodes. Set the defaults by `PDN_INIT(pdn_shell_placement, &placement)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_shell_placement {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_SHELL_NORMALS, PDN_SHELL_PARALLEL, PDN_SHELL_NODE_AXES or PDN_SHELL_NODE_FRAMES.
    pub frames: i32,
    /// Leave it zero.
    pub reserved: i32,
    /// Distance of the surface that the section belongs to from the nodes, along the normal
    /// [length]; default: 0.
    pub offset: f64,
    /// Direction whose part in the surface is axis 1 of the section, global coordinates. If it is
    /// zero, the default, axes 1 and 2 are as close to xi and eta as they can be at a right angle.
    pub direction: [f64; 3],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_shell_placement {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] =
        &[offset_of!(pdn_shell_placement, direction) + size_of::<[f64; 3]>()];

    fn defaults() -> Self {
        pdn_shell_placement {
            frames: PDN_SHELL_NORMALS,
            ..Self::blank()
        }
    }
}

impl pdn_shell_placement {
    fn core(&self) -> Result<ShellPlacement> {
        if self.reserved != 0 {
            return Err(Error::value("reserved", "zero", self.reserved));
        }
        let table = [
            (PDN_SHELL_NORMALS, ShellFrames::Normals),
            (PDN_SHELL_PARALLEL, ShellFrames::Parallel),
            (PDN_SHELL_NODE_AXES, ShellFrames::NodeAxes),
            (PDN_SHELL_NODE_FRAMES, ShellFrames::NodeFrames),
        ];
        let names = "PDN_SHELL_NORMALS, PDN_SHELL_PARALLEL, PDN_SHELL_NODE_AXES or \
                     PDN_SHELL_NODE_FRAMES";
        let frames = choose(&table, self.frames, "frames", names)?;
        require_finite("offset", &[self.offset])?;
        require_finite("direction", &self.direction)?;
        let direction = Vector3::from(self.direction);
        Ok(ShellPlacement {
            frames,
            offset: self.offset,
            direction: (direction != Vector3::zeros()).then_some(direction),
        })
    }
}

/// What a shell over a surface was made of; written by the library. This struct will never change
/// its size.
///
/// Element i elements_v + j from the first on is the one at i along u and j along v; xi of each is
/// in the direction of u, eta in that of v. ::pdn_model_shell_patch_node tells the nodes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_shell {
    /// Id of the first element.
    pub first_element: i32,
    /// Number of elements along u.
    pub elements_u: i32,
    /// Number of elements along v.
    pub elements_v: i32,
    /// Number of nodes along u.
    pub nodes_u: i32,
    /// Number of nodes along v.
    pub nodes_v: i32,
    /// Zero.
    pub reserved: [i32; 3],
}

const _: () = assert!(size_of::<pdn_shell>() == 32);

/// Makes a section with no stiffness, mass or damping. Use it as
/// `PDN_INIT(pdn_shell_section, &section)`.
///
/// @param section  the section; not NULL
/// @param struct_size  sizeof(pdn_shell_section)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_shell_section_init(
    section: *mut pdn_shell_section,
    struct_size: usize,
) {
    init(section, struct_size, "section");
}

/// Makes a section that of one isotropic, linearly elastic material. Takes the damping away: give
/// that afterwards.
///
/// @param section  an initialised section; not NULL
/// @param thickness  thickness, positive [length]
/// @param young  Young's modulus, positive [force / length^2]
/// @param poisson  Poisson's ratio, more than -1 and less than 1/2
/// @param density  zero or more [mass / length^3]
/// @param drilling  stiffness of the drilling rotation against the surface, relative to shear: 0.1
///     to 1; usually 1
/// @param drilling_gradient  stiffness against gradients of the drilling rotation, which only
///     regularises; positive, usually 0.1
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `section`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_shell_section_set_isotropic(
    section: *mut pdn_shell_section,
    thickness: f64,
    young: f64,
    poisson: f64,
    density: f64,
    drilling: f64,
    drilling_gradient: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, section, "section", |section| {
            let material = IsotropicShell::new(
                call.number(thickness, "thickness")?,
                call.number(young, "young")?,
                call.number(poisson, "poisson")?,
                call.number(density, "density")?,
            );
            let shell = IsotropicShell {
                drilling: call.number(drilling, "drilling")?,
                drilling_gradient: call.number(drilling_gradient, "drilling_gradient")?,
                ..material
            };
            section.set(&shell.section()?);
            Ok(())
        })
    })
}

/// Gives a section damping in proportion to its stiffness, which must have been set.
///
/// A vibration of circular frequency w then has the damping ratio seconds * w / 2.
///
/// @param section  an initialised section with stiffness; not NULL
/// @param seconds  damping = seconds * stiffness; zero or more [time]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `section`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_shell_section_set_proportional_damping(
    section: *mut pdn_shell_section,
    seconds: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, section, "section", |section| {
            let seconds = call.number(seconds, "seconds")?;
            let mut damped = section.core();
            damped.damp_proportionally(seconds)?;
            section.set(&damped);
            Ok(())
        })
    })
}

/// Sets the defaults. Use it as `PDN_INIT(pdn_shell_placement, &placement)`.
///
/// @param placement  the placement; not NULL
/// @param struct_size  sizeof(pdn_shell_placement)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_shell_placement_init(
    placement: *mut pdn_shell_placement,
    struct_size: usize,
) {
    init(placement, struct_size, "placement");
}

/// Section and placement that arguments give; what matrices must be is for the core to check.
fn read_shell(
    call: &Call,
    section: *const pdn_shell_section,
    placement: *const pdn_shell_placement,
) -> Result<(ShellSection, ShellPlacement)> {
    let section = read_struct(call, section, "section")?.core();
    let placement = call.options(placement, "placement")?.core();
    Ok((section, placement.map_err(|e| e.within("placement"))?))
}

/// Adds a shell element over a grid of nodes that are there.
///
/// The nodes stand at the Gauss-Lobatto points in both directions: node i n_eta + j of the array at
/// (xi_i, eta_j). How their frames are turned does not matter. The normal is that of the tangents
/// along xi and eta, in this order. The element's reference shape interpolates the nodes, and is
/// free of stress.
///
/// Elements may share whole edges, with the same nodes along them, and single nodes; beams, bodies
/// and joints may share their nodes. Do not let a couple about the normal act on one node, such as
/// that of a beam that ends there: it turns the node the further, the finer the mesh. Connect
/// through an edge instead.
///
/// @param model  the model; not NULL
/// @param nodes  array of length [count]: ids of the nodes, all different
/// @param count  number of nodes: n_xi n_eta
/// @param n_xi  nodes along xi, 2 to 16; so are those along eta, count / n_xi
/// @param section  the section; not NULL
/// @param placement  how it lies on the nodes; NULL for the defaults
/// @param element  the element's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (nodes that turn too
///     much from one to the next)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_shell_element(
    model: *mut pdn_model,
    nodes: *const i32,
    count: usize,
    n_xi: usize,
    section: *const pdn_shell_section,
    placement: *const pdn_shell_placement,
    element: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        check_pointer(nodes, 1, "nodes")?;
        if n_xi == 0 || !count.is_multiple_of(n_xi) {
            let expected = format!("one that {count} nodes are a multiple of");
            return Err(Error::size("n_xi", expected, n_xi));
        }
        let sides = [n_xi, count / n_xi];
        Model::require_shell_sides(sides)?;
        let nodes = model::nodes(call, &model, (nodes, count), "nodes")?;
        let (section, placement) = read_shell(call, section, placement)?;
        let element = call.out(element, "element")?;
        let id = Kind::ShellElement.next(&model, 1, "element")?;
        model.add_shell_element(&nodes, sides, &section, &placement)?;
        element.set(id);
        Ok(())
    })
}

/// Adds a shell over a surface, with elements in equal parts of u and v: its nodes and elements.
///
/// Axis 1 of each new node's frame is along u, axis 3 along the normal.
///
/// @param model  the model; not NULL
/// @param surface  the surface; not NULL
/// @param elements_u  number of elements along u, 1 to 100000
/// @param elements_v  number of elements along v, likewise
/// @param degree_u  polynomial degree along u, 1 to 15: nodes of an element, less one; 3 to 5 are
///     good choices
/// @param degree_v  polynomial degree along v, likewise
/// @param join  1: nodes on the edges of the surface at the same place as nodes of shells that are
///     there, or on another of its own edges, are these, so that shells are joined and closed; 0:
///     all nodes are new; usually 1
/// @param section  the section; not NULL
/// @param placement  how it lies on the nodes; NULL for the defaults
/// @param shell  the shell's elements and numbers of nodes; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_CALLBACK, PDN_ERR_MODEL
///     (elements that turn too much)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_shell(
    model: *mut pdn_model,
    surface: *const pdn_surface,
    elements_u: usize,
    elements_v: usize,
    degree_u: usize,
    degree_v: usize,
    join: i32,
    section: *const pdn_shell_section,
    placement: *const pdn_shell_placement,
    shell: *mut pdn_shell,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let surface = surface::read(call, surface, "surface")?;
        let mesh = read_mesh([elements_u, elements_v], [degree_u, degree_v], join)?;
        let (section, placement) = read_shell(call, section, placement)?;
        let shell = call.out(shell, "shell")?;
        let made = new_shell(&model, &mesh)?;
        model.add_shell_patch(surface, &mesh, &section, &placement)?;
        shell.set(made);
        Ok(())
    })
}

/// Adds a shell over given positions of its nodes, as ::pdn_model_add_shell does over a surface.
///
/// The nodes of each element stand at the Gauss-Lobatto points in both directions: with degrees of
/// 1 and 2 evenly.
///
/// @param model  the model; not NULL
/// @param points  array of shape 3 x [count]: positions of the nodes, global coordinates, those
///     along v first [length]
/// @param count  number of nodes: (elements_u degree_u + 1) (elements_v degree_v + 1)
/// @param elements_u  number of elements along u, 1 to 100000
/// @param elements_v  number of elements along v, likewise
/// @param degree_u  polynomial degree along u, 1 to 15
/// @param degree_v  polynomial degree along v, likewise
/// @param join  0 or 1, as ::pdn_model_add_shell has it; usually 1
/// @param section  the section; not NULL
/// @param placement  how it lies on the nodes; NULL for the defaults
/// @param shell  the shell's elements and numbers of nodes; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (elements that turn too
///     much)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_shell_grid(
    model: *mut pdn_model,
    points: *const f64,
    count: usize,
    elements_u: usize,
    elements_v: usize,
    degree_u: usize,
    degree_v: usize,
    join: i32,
    section: *const pdn_shell_section,
    placement: *const pdn_shell_placement,
    shell: *mut pdn_shell,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let mesh = read_mesh([elements_u, elements_v], [degree_u, degree_v], join)?;
        let [nodes_u, nodes_v] = mesh.lines()?;
        if count != nodes_u * nodes_v {
            let expected = format!("{nodes_u} times {nodes_v} nodes");
            return Err(Error::size("count", expected, count));
        }
        let points = read_points(call, (points, "points"), count, "count")?;
        let (section, placement) = read_shell(call, section, placement)?;
        let shell = call.out(shell, "shell")?;
        let made = new_shell(&model, &mesh)?;
        model.add_shell_grid(&points, &mesh, &section, &placement)?;
        shell.set(made);
        Ok(())
    })
}

/// Adds a shell element for each cell of a mesh of quadrilaterals, as mesh generators make them.
///
/// A cell has four points, its corners in a row around it, seen from the side that the normal
/// points to; or nine: these, then the middles of its sides from the first corner to the second and
/// so on, then its centre. That is the order of Gmsh and VTK. With nine it is curved. xi is from
/// the first corner to the second, eta from there to the third. Cells that share a side have the
/// same nodes there; points that belong to no cell are left out. ::pdn_model_shell_node tells the
/// nodes.
///
/// @param model  the model; not NULL
/// @param points  array of shape 3 x [point_count]: positions, global coordinates [length]
/// @param point_count  number of points
/// @param cells  array of length [count]: numbers of the points of each cell from 0 on, one cell
///     after the other
/// @param count  how many these are: points_of_cell for each cell
/// @param points_of_cell  4 or 9
/// @param degree  polynomial degree of the elements in both directions, 1 to 15
/// @param section  the section; not NULL
/// @param placement  how it lies on the nodes; NULL for the defaults
/// @param first_element  id of the first element; the others follow in the order of the cells;
///     written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE (inverted or overlapping elements, too), PDN_ERR_MODEL (elements that turn too
///     much)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_shell_quadrilaterals(
    model: *mut pdn_model,
    points: *const f64,
    point_count: usize,
    cells: *const i32,
    count: usize,
    points_of_cell: usize,
    degree: usize,
    section: *const pdn_shell_section,
    placement: *const pdn_shell_placement,
    first_element: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let points = read_points(call, (points, "points"), point_count, "point_count")?;
        check_pointer(cells, 1, "cells")?;
        let cells = call.slice(cells, count, "cells")?.iter().enumerate();
        let there = points.len();
        let cells = cells
            .map(|(i, &k)| number(k, there, &format!("cells[{i}]"), "a number of a point"))
            .collect::<Result<Vec<_>>>()?;
        let mesh = QuadrilateralMesh {
            points: &points,
            cells: &cells,
            points_of_cell,
            degree,
        };
        let elements = mesh.count()?;
        let (section, placement) = read_shell(call, section, placement)?;
        let first_element = call.out(first_element, "first_element")?;
        let nodes = elements.saturating_mul((degree + 1) * (degree + 1));
        Kind::Node.next(&model, nodes, "cells")?;
        let first = Kind::ShellElement.next(&model, elements, "cells")?;
        model.add_shell_quadrilaterals(&mesh, &section, &placement)?;
        first_element.set(first);
        Ok(())
    })
}

/// The mesh that arguments give.
fn read_mesh(elements: [usize; 2], degrees: [usize; 2], join: i32) -> Result<ShellMesh> {
    let mesh = ShellMesh {
        elements,
        degrees,
        join: choose(&[(0, false), (1, true)], join, "join", "0 or 1")?,
    };
    mesh.lines()?;
    Ok(mesh)
}

/// Positions that arguments give.
fn read_points(
    call: &Call,
    (points, name): (*const f64, &str),
    count: usize,
    count_name: &str,
) -> Result<Vec<Vector3<f64>>> {
    let length = count.checked_mul(3);
    let length = length.ok_or_else(|| Error::size(count_name, "fewer points", count))?;
    check_pointer(points, 1, name)?;
    let points = call.numbers(points, length, name)?;
    Ok(points
        .chunks_exact(3)
        .map(Vector3::from_column_slice)
        .collect())
}

/// What a shell with such a mesh will be made of in the model.
fn new_shell(model: &Model, mesh: &ShellMesh) -> Result<pdn_shell> {
    let [nodes_u, nodes_v] = mesh.lines()?;
    let [elements_u, elements_v] = mesh.elements;
    let nodes = nodes_u.saturating_mul(nodes_v);
    Kind::Node.next(model, nodes, "elements")?;
    let elements = elements_u.saturating_mul(elements_v);
    let first_element = Kind::ShellElement.next(model, elements, "elements")?;
    // In range, as their products are.
    let [elements_u, elements_v, nodes_u, nodes_v] =
        [elements_u, elements_v, nodes_u, nodes_v].map(|n| n as i32);
    Ok(pdn_shell {
        first_element,
        elements_u,
        elements_v,
        nodes_u,
        nodes_v,
        reserved: [0; 3],
    })
}

/// Node of a shell over a surface or a grid.
///
/// @param model  the model; not NULL
/// @param shell  the shell, as the function that added it has written it; not NULL
/// @param u  number of the node along u, from 0 to nodes_u - 1
/// @param v  number of the node along v, from 0 to nodes_v - 1
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_shell_patch_node(
    model: *const pdn_model,
    shell: *const pdn_shell,
    u: i32,
    v: i32,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let shell = *call.reference(shell, "shell")?;
        place(u, shell.nodes_u, "u")?;
        place(v, shell.nodes_v, "v")?;
        let out = call.out(node, "node")?;
        out.set(Kind::Node.id(patch_node(&model, &shell, [u, v])?));
        Ok(())
    })
}

/// The node of a shell at these numbers along u and v.
pub(super) fn patch_node(model: &Model, shell: &pdn_shell, [u, v]: [i32; 2]) -> Result<usize> {
    let u = place(u, shell.nodes_u, "u")?;
    let v = place(v, shell.nodes_v, "v")?;
    let numbers = [
        ("elements_u", shell.elements_u),
        ("elements_v", shell.elements_v),
    ];
    for (name, count) in numbers {
        if count < 1 {
            return Err(Error::value(name, "1 or more", count).within("shell"));
        }
    }
    let degree = |nodes: i32, elements: i32| ((nodes - 1) / elements) as usize;
    let degrees = [
        degree(shell.nodes_u, shell.elements_u),
        degree(shell.nodes_v, shell.elements_v),
    ];
    let last = [shell.elements_u, shell.elements_v].map(|n| n as usize - 1);
    let [i, j] = [0, 1].map(|d| ([u, v][d] / degrees[d].max(1)).min(last[d]));
    let first = Kind::ShellElement.index_in(model, shell.first_element, "first_element");
    let first = first.map_err(|e| e.within("shell"))?;
    let element = first.saturating_add(i.saturating_mul(last[1] + 1).saturating_add(j));
    let [xi, eta] = [
        u.saturating_sub(i.saturating_mul(degrees[0])),
        v.saturating_sub(j.saturating_mul(degrees[1])),
    ];
    let definition = model.shells.get(element);
    let found = definition.filter(|d| d.sides == degrees.map(|degree| degree + 1));
    let found = found.and_then(|d| d.nodes.get(xi * (degrees[1] + 1) + eta));
    found.copied().ok_or_else(|| {
        let expected = "a shell of this model, as the function that added it wrote it";
        Error::value("shell", expected, "another")
    })
}

/// Number of a node along a side.
fn place(given: i32, count: i32, name: &str) -> Result<usize> {
    match usize::try_from(given) {
        Ok(at) if given < count => Ok(at),
        _ => Err(Error::value(
            name,
            format!("0 to {}", i64::from(count) - 1),
            given,
        )),
    }
}

/// Number of shell elements; their ids follow each other from PDN_FIRST_SHELL_ELEMENT on.
///
/// @param model  the model; not NULL
/// @param count  the number; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_shell_element_count(
    model: *const pdn_model,
    count: *mut i32,
) -> pdn_status {
    super::model::count(model, count, Model::shell_element_count)
}

/// Node of a shell element.
///
/// @param model  the model; not NULL
/// @param element  id of the shell element
/// @param xi  number of the node along xi, from 0 where xi = -1
/// @param eta  number of the node along eta, from 0 where eta = -1
/// @param node  the node's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID, PDN_ERR_VALUE
///
/// Threads: `model` is `const`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_shell_node(
    model: *const pdn_model,
    element: i32,
    xi: i32,
    eta: i32,
    node: *mut i32,
) -> pdn_status {
    guard(|call| {
        let model = call.shared(model, "model")?;
        let element = Kind::ShellElement.index_in(&model, element, "element")?;
        let shell = &model.shells[element];
        let along = place(xi, shell.sides[0] as i32, "xi")?;
        let across = place(eta, shell.sides[1] as i32, "eta")?;
        let out = call.out(node, "node")?;
        out.set(Kind::Node.id(shell.nodes[along * shell.sides[1] + across]));
        Ok(())
    })
}

const PLACES: [(i32, ShellLoadPlace); 5] = [
    (PDN_SHELL_EDGE_START_ETA, ShellLoadPlace::Edge(0)),
    (PDN_SHELL_EDGE_END_XI, ShellLoadPlace::Edge(1)),
    (PDN_SHELL_EDGE_END_ETA, ShellLoadPlace::Edge(2)),
    (PDN_SHELL_EDGE_START_XI, ShellLoadPlace::Edge(3)),
    (PDN_SHELL_SURFACE, ShellLoadPlace::Surface),
];

/// Where a load is on an element.
pub(super) fn load_place(given: i32) -> Result<ShellLoadPlace> {
    let names = "PDN_SHELL_SURFACE or a constant PDN_SHELL_EDGE_...";
    choose(&PLACES, given, "place", names)
}

/// What C calls a place.
pub(super) fn place_code(place: ShellLoadPlace) -> i32 {
    let found = PLACES.iter().find(|(_, other)| *other == place);
    found.map_or(PDN_SHELL_SURFACE, |(code, _)| *code)
}

/// Adds one component of a force or moment on shell elements, in addition to those that are there:
/// for each unit of reference area, or of reference length of an edge.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first shell element
/// @param elements  number of elements, from the first on; at least 1
/// @param place  PDN_SHELL_SURFACE, PDN_SHELL_EDGE_START_ETA, PDN_SHELL_EDGE_END_XI,
///     PDN_SHELL_EDGE_END_ETA or PDN_SHELL_EDGE_START_XI, of each of them
/// @param frame  PDN_FRAME_SPACE: directions of the global axes; PDN_FRAME_MATERIAL: of axes that
///     follow the shell: on the surface those of the section, so that a pressure is PDN_FORCE_3, on
///     an edge 1 along it, in the direction of xi or eta, 3 along the normal, and 2 = 3 * 1
/// @param component  PDN_FORCE_1, PDN_FORCE_2, PDN_FORCE_3 [force / length^2, or / length],
///     PDN_MOMENT_1, PDN_MOMENT_2 or PDN_MOMENT_3 [times length]
/// @param signal  the component in time, copied; not NULL
/// @param load  the load's id, a shell load's; may be NULL if it is not wanted; written on success
///     only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_VALUE,
///     PDN_ERR_STRUCT_SIZE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_shell_load(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    place: i32,
    frame: i32,
    component: i32,
    signal: *const pdn_signal,
    load: *mut i32,
) -> pdn_status {
    let read = |call: &Call, model: &Model| {
        let first_element = Kind::ShellElement.index_in(model, first_element, "first_element")?;
        let elements = element_count(elements)?;
        let place = load_place(place)?;
        let frame = load_frame(frame)?;
        let components = components(call, component, signal)?;
        Ok(ShellLoadDefinition {
            first_element,
            elements,
            place,
            frame,
            components,
        })
    };
    let add = |model: &mut Model, load| model.add_shell_load(load);
    add_object(model, Kind::ShellLoad, (load, "load"), read, add)
}

/// Gives shell elements forces and moments where nothing is strained: initial stress, in place of
/// any before.
///
/// It makes them stiffer or softer, and moves them unless it is in equilibrium.
///
/// @param model  the model; not NULL
/// @param first_element  id of the first shell element
/// @param elements  number of elements, from the first on; at least 1
/// @param resultants  array of length 12: along the axes of the section, in the order of
///     ::pdn_shell_section [force / length, moment / length]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_ID
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_set_shell_prestress(
    model: *mut pdn_model,
    first_element: i32,
    elements: i32,
    resultants: *const f64,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let first = Kind::ShellElement.index_in(&model, first_element, "first_element")?;
        let most = model.shell_element_count() - first;
        let count = usize::try_from(elements).unwrap_or(0);
        if !(1..=most).contains(&count) {
            let expected = format!("1 to {most} from element {first} on");
            return Err(Error::size("elements", expected, elements));
        }
        let resultants = Vector12::from(call.array::<12>(resultants, "resultants")?);
        for element in first..first + count {
            model.set_shell_prestress(element, &resultants)?;
        }
        Ok(())
    })
}
