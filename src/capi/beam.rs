//! Beams: their elements and nodes.

use super::call::Call;
use super::guard::{guard, init};
use super::id::Kind;
use super::line::{self, Line, pdn_line};
use super::model::{self, pdn_model, vector};
use super::options::Options;
use super::pointer::check_pointer;
use super::section::{self, pdn_section, read_struct};
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::model::{BeamIds, Model, SectionStation};
use std::mem::offset_of;

/// What a beam was made of; written by the library. This struct will never change its size.
///
/// The nodes along the beam are first, first + 1, ... last; the elements are first_element,
/// ... first_element + elements - 1.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_beam {
    /// Id of the node at the start.
    pub first: i32,
    /// Id of the node at the end.
    pub last: i32,
    /// Id of the element at the start.
    pub first_element: i32,
    /// Number of elements.
    pub elements: i32,
    /// Zero.
    pub reserved: [i32; 4],
}

const _: () = assert!(size_of::<pdn_beam>() == 32);

/// Cross-sections along a beam, at stations; linear in between, entry by entry.
///
/// Start with `PDN_INIT(pdn_stations, &stations)`, then set the fields. The library reads the
/// arrays during the call that takes the stations.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_stations {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Number of stations; one alone stands for all of the beam.
    pub count: usize,
    /// Array of length [count]: places along the span, from 0 at the start to 1 at the end,
    /// ascending; two stations at the same place make a jump. May be NULL if count is 1.
    pub fractions: *const f64,
    /// Array of length [count]: the sections, each initialised.
    pub sections: *const pdn_section,
    /// Array of length [count]: structural twist, the angles by which axes 2 and 3 of the sections
    /// are turned about axis 1 from those of the line, right-handed, linear between stations
    /// [radian]. NULL for none. It has no jumps.
    pub twists: *const f64,
}

// SAFETY: numbers and pointers only, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_stations {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] = &[offset_of!(pdn_stations, twists) + size_of::<*const f64>()];
}

/// Makes stations that are still to be set. Use it as `PDN_INIT(pdn_stations, &stations)`.
///
/// @param stations  the stations; not NULL
/// @param struct_size  sizeof(pdn_stations)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_stations_init(stations: *mut pdn_stations, struct_size: usize) {
    init(stations, struct_size, "stations");
}

/// The stations that an argument gives; what they must be is for the core to check.
fn read_stations(call: &Call, stations: *const pdn_stations) -> Result<Vec<SectionStation>> {
    const MOST: usize = 100_000;
    let given = read_struct(call, stations, "stations")?;
    let count = given.count;
    let read = || -> Result<Vec<SectionStation>> {
        if !(1..=MOST).contains(&count) {
            return Err(Error::size("count", format!("1 to {MOST}"), count));
        }
        let fractions = if count == 1 && given.fractions.is_null() {
            &[0.0]
        } else {
            check_pointer(given.fractions, count, "fractions")?;
            call.numbers(given.fractions, count, "fractions")?
        };
        let twists = if given.twists.is_null() {
            &[]
        } else {
            call.numbers(given.twists, count, "twists")?
        };
        let sections = section::read_array(call, given.sections, count, "sections")?;
        Ok((0..count)
            .map(|i| SectionStation {
                fraction: fractions[i],
                section: sections[i],
                twist: twists.get(i).copied().unwrap_or(0.0),
            })
            .collect())
    };
    read().map_err(|error| error.within("stations"))
}

/// Meshes a beam, whose nodes and elements `add` makes, and gives its ids.
fn add_meshed(
    model: &mut Model,
    elements: usize,
    degree: usize,
    add: impl FnOnce(&mut Model) -> Result<BeamIds>,
) -> Result<pdn_beam> {
    Model::require_mesh(elements, degree)?;
    let first = Kind::Node.next(model, elements * degree + 1, "elements")?;
    let first_element = Kind::BeamElement.next(model, elements, "elements")?;
    let ids = add(model)?;
    // In range, as was found out.
    Ok(pdn_beam {
        first,
        last: Kind::Node.id(ids.last_node),
        first_element,
        elements: elements as i32,
        reserved: [0; 4],
    })
}

/// Meshes a beam along a line, as `add` says.
fn add_along(
    call: &Call,
    model: *mut pdn_model,
    (line, stations): (*const pdn_line, *const pdn_stations),
    (elements, degree): (usize, usize),
    beam: *mut pdn_beam,
    add: impl FnOnce(&mut Model, Line, &[SectionStation]) -> Result<BeamIds>,
) -> Result<()> {
    let mut model = call.exclusive(model, "model")?;
    let line = line::read(call, line, "line")?;
    let stations = read_stations(call, stations)?;
    let beam = call.out(beam, "beam")?;
    beam.set(add_meshed(&mut model, elements, degree, |model| {
        add(model, line, &stations)
    })?);
    Ok(())
}

/// Adds a beam element over nodes that are there; it may be curved and twisted.
///
/// The nodes stand, in order, at the Gauss-Lobatto points along the beam; two are its ends. Axis 1
/// of each node is along the beam (to within 60 degrees, for curved ones), axes 2 and 3 are those
/// of the section. The element's reference shape interpolates them, and is free of stress.
///
/// Elements may share end nodes, in chains and where beams branch, but not otherwise; elements that
/// would lie on each other are refused.
///
/// @param model  the model; not NULL
/// @param nodes  array of length [count]: ids of the nodes, all different
/// @param count  2 to 25
/// @param section  cross-section, with positive-definite stiffness; not NULL
/// @param element  the element's id; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_SIZE, PDN_ERR_ID, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE,
///     PDN_ERR_VALUE, PDN_ERR_MODEL (nodes that turn too much from one to the next)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_beam_element(
    model: *mut pdn_model,
    nodes: *const i32,
    count: usize,
    section: *const pdn_section,
    element: *mut i32,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        check_pointer(nodes, 1, "nodes")?;
        Model::require_element_size("count", count)?;
        let nodes = model::nodes(call, &model, (nodes, count), "nodes")?;
        let section = section::read(call, section, "section")?;
        let element = call.out(element, "element")?;
        let id = Kind::BeamElement.next(&model, 1, "element")?;
        model.add_beam_element(&nodes, &section)?;
        element.set(id);
        Ok(())
    })
}

/// Adds a straight beam: its nodes and elements.
///
/// Axis 1 of every node is along the beam, from start to end; axis 2 is the part of axis_2 that is
/// perpendicular to it; axis 3 = axis 1 * axis 2. Beams are joined by joints between their nodes,
/// or by ::pdn_model_add_rigid_joint.
///
/// @param model  the model; not NULL
/// @param start  array of length 3: where the beam starts, global coordinates [length]
/// @param end  array of length 3: where it ends, not at start
/// @param axis_2  array of length 3: direction of axis 2 of the section, global coordinates, of any
///     nonzero length, not along the beam
/// @param section  cross-section, with positive-definite stiffness; not NULL
/// @param elements  number of elements, 1 to 1000000
/// @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
/// @param beam  ids of what was made; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
///     PDN_ERR_VALUE
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_straight_beam(
    model: *mut pdn_model,
    start: *const f64,
    end: *const f64,
    axis_2: *const f64,
    section: *const pdn_section,
    elements: usize,
    degree: usize,
    beam: *mut pdn_beam,
) -> pdn_status {
    guard(|call| {
        let mut model = call.exclusive(model, "model")?;
        let start = vector(call, start, "start")?;
        let end = vector(call, end, "end")?;
        let axis_2 = vector(call, axis_2, "axis_2")?;
        let section = section::read(call, section, "section")?;
        let beam = call.out(beam, "beam")?;
        beam.set(add_meshed(&mut model, elements, degree, |model| {
            model.add_straight_beam(&start, &end, &axis_2, &section, elements, degree)
        })?);
        Ok(())
    })
}

/// Adds a beam along a line, with sections that may vary: its nodes and elements.
///
/// Axis 1 of every node is along the line; axes 2 and 3 are those of the line, turned by the twist.
/// The mesh is even but for jumps of the section, where an element ends and the next begins; so
/// there must be more elements than jumps. Stations may lie anywhere: elements are integrated from
/// each to the next. Where slopes of section or twist jump inside an element, degrees gain less
/// accuracy all the same.
///
/// Beams are joined by joints between their nodes. To fix a beam's end to a body at a distance, use
/// ::pdn_model_add_rigid_joint between the two nodes: they need not be at the same place.
///
/// @param model  the model; not NULL
/// @param line  reference line; not NULL
/// @param stations  cross-sections along it; not NULL
/// @param elements  number of elements, 1 to 1000000
/// @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
/// @param beam  ids of what was made; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
///     PDN_ERR_VALUE, PDN_ERR_CALLBACK, PDN_ERR_MODEL (nodes that turn too much from one to the
///     next)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_beam(
    model: *mut pdn_model,
    line: *const pdn_line,
    stations: *const pdn_stations,
    elements: usize,
    degree: usize,
    beam: *mut pdn_beam,
) -> pdn_status {
    guard(|call| {
        let mesh = (elements, degree);
        add_along(
            call,
            model,
            (line, stations),
            mesh,
            beam,
            |model, line, stations| model.add_beam_along(line, stations, elements, degree),
        )
    })
}

/// Adds a beam along a line as ::pdn_model_add_beam does, with elements between given places.
///
/// For meshes that follow the stations of a section, give their fractions, each once; an element
/// ends and the next begins at every jump of the section.
///
/// @param model  the model; not NULL
/// @param line  reference line; not NULL
/// @param stations  cross-sections along it; not NULL
/// @param boundaries  array of length [count]: places along the span where elements begin and end,
///     from 0 at the start to 1 at the end, ascending, with all jumps among them
/// @param count  number of boundaries, 2 to 1000001: one more than there are elements
/// @param degree  polynomial degree of the elements, 1 to 24; an element has degree + 1 nodes
/// @param beam  ids of what was made; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_SIZE, PDN_ERR_STRUCT_SIZE,
///     PDN_ERR_VALUE, PDN_ERR_CALLBACK, PDN_ERR_MODEL (nodes that turn too much from one to the
///     next)
///
/// Threads: exclusive use of `model`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_model_add_beam_between(
    model: *mut pdn_model,
    line: *const pdn_line,
    stations: *const pdn_stations,
    boundaries: *const f64,
    count: usize,
    degree: usize,
    beam: *mut pdn_beam,
) -> pdn_status {
    guard(|call| {
        if count < 2 {
            return Err(Error::size("count", "at least 2", count));
        }
        let mesh = (count - 1, degree);
        add_along(
            call,
            model,
            (line, stations),
            mesh,
            beam,
            |model, line, stations| {
                let boundaries = call.numbers(boundaries, count, "boundaries")?;
                model.add_beam_between(line, stations, boundaries, degree)
            },
        )
    })
}
