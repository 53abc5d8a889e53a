//! Cross-sections of beams, by value.

use super::call::Call;
use super::guard::{guard, init};
use super::options::Options;
use super::pointer::null;
use super::status::pdn_status;
use crate::error::{Error, ErrorKind, Result};
use crate::model::SectionInput;
use nalgebra::Matrix6;
use std::mem::offset_of;

/// Cross-section of a beam, per unit of length.
///
/// The matrices are 6 x 6, column-major, symmetric (damping need not be), and resolved in the axes
/// of the section: axis 1 is along the beam. Rows and columns are in the order force 1, 2, 3,
/// moment 1, 2, 3, which is axial, shear 2, shear 3, torsion, bending about axis 2, bending about
/// axis 3. Any consistent set of units.
///
/// Start with `PDN_INIT(pdn_section, &section)`; then ::pdn_section_set_diagonal, or write the
/// matrices yourself. A section without stiffness is refused where it is used.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_section {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// Forces and moments for unit strains and curvatures; positive definite.
    pub stiffness: [f64; 36],
    /// Momenta for unit velocities; positive semi-definite.
    pub mass: [f64; 36],
    /// Forces and moments for unit rates of strain and curvature. It may be unsymmetric, as a
    /// diagonal matrix of times times the stiffness is for coupled sections; its symmetric part is
    /// positive semi-definite, so that no motion gains energy.
    pub damping: [f64; 36],
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, and there is no padding.
unsafe impl Options for pdn_section {
    // A release that adds a field adds where that field ends.
    const SIZES: &'static [usize] = &[offset_of!(pdn_section, damping) + size_of::<[f64; 36]>()];
}

impl pdn_section {
    fn input(&self) -> SectionInput {
        SectionInput {
            stiffness: Matrix6::from_column_slice(&self.stiffness),
            mass: Matrix6::from_column_slice(&self.mass),
            damping: Matrix6::from_column_slice(&self.damping),
        }
    }

    fn set(&mut self, input: &SectionInput) {
        self.fill([&input.stiffness, &input.mass, &input.damping]);
    }

    /// Sets stiffness, mass and damping.
    pub(super) fn fill(&mut self, [stiffness, mass, damping]: [&Matrix6<f64>; 3]) {
        self.stiffness.copy_from_slice(stiffness.as_slice());
        self.mass.copy_from_slice(mass.as_slice());
        self.damping.copy_from_slice(damping.as_slice());
    }
}

/// The section that an argument gives; what its matrices must be is for the core to check.
pub(super) fn read(call: &Call, section: *const pdn_section, name: &str) -> Result<SectionInput> {
    Ok(read_struct(call, section, name)?.input())
}

/// An array of sections: those of a caller compiled with another release have another size.
pub(super) fn read_array(
    call: &Call,
    sections: *const pdn_section,
    count: usize,
    name: &str,
) -> Result<Vec<SectionInput>> {
    let sections = read_structs(call, sections, count, name, |s| s.struct_size)?;
    Ok(sections.iter().map(pdn_section::input).collect())
}

/// An array of at least one struct: those of a caller compiled with another release have another
/// size.
pub(super) fn read_structs<T: Options>(
    call: &Call,
    first: *const T,
    count: usize,
    name: &str,
    struct_size: impl Fn(&T) -> usize,
) -> Result<Vec<T>> {
    let size = struct_size(&read_struct(call, first, name)?);
    (0..count)
        .map(|i| {
            let name = format!("{name}[{i}]");
            let given = read_struct(call, first.wrapping_byte_add(i * size), &name)?;
            let got = struct_size(&given);
            if got != size {
                let message =
                    format!("{name}: expected struct_size {size} as the first, got {got}");
                return Err(Error::new(ErrorKind::StructSize, message));
            }
            Ok(given)
        })
        .collect()
}

/// A struct with a `struct_size` that must be given.
pub(super) fn read_struct<T: Options>(call: &Call, pointer: *const T, name: &str) -> Result<T> {
    if pointer.is_null() {
        return Err(null(name));
    }
    call.options(pointer, name)
}

/// Changes an initialised struct of the caller; leaves it as it was if that fails.
pub(super) fn update_struct<T: Options>(
    call: &Call,
    pointer: *mut T,
    name: &str,
    change: impl FnOnce(&mut T) -> Result<()>,
) -> Result<()> {
    let out = call.out_struct(pointer, name)?;
    let mut value = read_struct(call, pointer, name)?;
    change(&mut value)?;
    out.set(value);
    Ok(())
}

/// Makes a section with no stiffness, mass or damping. Use it as `PDN_INIT(pdn_section, &section)`.
///
/// @param section  the section; not NULL
/// @param struct_size  sizeof(pdn_section)
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_section_init(section: *mut pdn_section, struct_size: usize) {
    init(section, struct_size, "section");
}

/// Describes a section without couplings: centroid, shear centre and centre of mass lie on the
/// beam's line, and axes 2 and 3 are principal.
///
/// Sets stiffness and mass, and takes the damping away: give that afterwards.
///
/// @param section  an initialised section; not NULL
/// @param stiffness  array of length 6, all positive: axial EA, shear 2, shear 3 [force], torsion,
///     bending about axis 2, bending about axis 3 [force * length^2]
/// @param mass  array of length 4, none negative: mass [mass / length], and moments of inertia m11
///     (about the beam's axis), m22, m33 [mass * length], all per unit of length
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `section`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_section_set_diagonal(
    section: *mut pdn_section,
    stiffness: *const f64,
    mass: *const f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, section, "section", |section| {
            let stiffness = call.array::<6>(stiffness, "stiffness")?;
            let mass = call.array::<4>(mass, "mass")?;
            section.set(&SectionInput::diagonal(&stiffness, &mass)?);
            Ok(())
        })
    })
}

/// Gives a section damping with one time for each force and moment: damping = diag(seconds) *
/// stiffness, which must have been set.
///
/// For coupled sections that is no symmetric matrix. It is taken if no motion gains energy by it:
/// if its symmetric part is positive semi-definite.
///
/// @param section  an initialised section with stiffness; not NULL
/// @param seconds  array of length 6: times of axial force, shear 2, shear 3, torsion, bending 2,
///     bending 3; none negative [time]
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_VALUE
///
/// Threads: exclusive use of `section`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_section_set_component_damping(
    section: *mut pdn_section,
    seconds: *const f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, section, "section", |section| {
            let mut input = section.input();
            input.damp_by_component(&call.array::<6>(seconds, "seconds")?)?;
            section.set(&input);
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
pub unsafe extern "C" fn pdn_section_set_proportional_damping(
    section: *mut pdn_section,
    seconds: f64,
) -> pdn_status {
    guard(|call| {
        update_struct(call, section, "section", |section| {
            let mut input = section.input();
            input.damp_proportionally(call.number(seconds, "seconds")?)?;
            section.set(&input);
            Ok(())
        })
    })
}
