//! The C ABI: the only unsafe code of the crate, and nothing but a thin face on it.
//!
//! A function here checks what C gave, calls the core, and hands back the answer. What the library
//! *does* belongs in the core. One file per noun; cbindgen writes `include/periodyn.h` from them,
//! in the order that `tests/header.rs` lists (`cbindgen.toml` holds the rest).
//!
//! # Adding a function
//!
//! ```ignore
//! /// Adds a revolute joint between two nodes. (First sentence: what it does.)
//! ///
//! /// Units, frames, shapes, equation of the paper.
//! ///
//! /// @param model  the model; not NULL
//! /// @param node_i  id of the first node
//! /// @param node_j  id of the second node
//! /// @param point  array of length 3: a point of the axis, inertial frame \[length\]
//! /// @param axis  array of length 3: direction of the axis, inertial frame, any nonzero length
//! /// @param out  the joint's id; written on success only
//! /// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_NOT_FINITE, PDN_ERR_ID, PDN_ERR_VALUE
//! ///
//! /// Threads: exclusive use of `model`.
//! /// @since 0.1
//! #[unsafe(no_mangle)]
//! pub unsafe extern "C" fn pdn_model_add_revolute(
//!     model: *mut pdn_model,
//!     node_i: i32,
//!     node_j: i32,
//!     point: *const f64,
//!     axis: *const f64,
//!     out: *mut i32,
//! ) -> pdn_status {
//!     guard(|call| {
//!         let mut model = call.exclusive(model, "model")?;
//!         let point = call.array::<3>(point, "point")?;
//!         let axis = call.array::<3>(axis, "axis")?;
//!         let out = call.out(out, "out")?;
//!         out.set(model.add_revolute(node_i, node_j, point, axis)?);
//!         Ok(())
//!     })
//! }
//! ```
//!
//! Then `PDN_BLESS=1 cargo test --test header` rewrites the header, and
//! `PDN_BLESS=1 ctest -R symbols` appends to `tests/abi/symbols.txt`. `script/cpp_interface`,
//! `script/fortran_interface` and `script/python_interface` bind it in C++, Fortran and Python, by
//! the words of its comment for shapes and lengths, what may be NULL, what a number usually is (it
//! may then be left out), and which function or field tells a number of entries.
//!
//! * Read *every* argument, outputs included, before the core is called; set outputs last. So a
//!   failed call has written nothing.
//! * The core's errors name its own arguments; where the names differ, or a deeper place matters,
//!   use [`crate::error::Error::within`].
//! * Handles: declare an opaque type as in [`handle`]. `const` functions take `call.shared(…)`,
//!   all others `call.exclusive(…)`; a child keeps the `Arc` that `shared` gave it, so the order of
//!   freeing does not matter.
//! * Options: a `#[repr(C)]` struct implementing [`options::Options`].
//! * Callbacks: [`callback::Callback`] keeps function, `user_data` and destructor together.
//! * A function that returns no status uses [`guard::guard_or`]; a destructor [`guard::free`].
//! * Integers are `i32` or `usize`, reals `f64`; never `bool` or a Rust enum, which C could give a
//!   value that Rust takes for impossible.

#![allow(unsafe_code)]
// C spells types in lower case.
#![allow(non_camel_case_types)]
// The `@param` lines say what the caller owes; a `# Safety` section would repeat them in the
// header.
#![allow(clippy::missing_safety_doc)]
// C has no named arguments to group them by.
#![allow(clippy::too_many_arguments)]
// `[n]`, `::pdn_…` and the like are meant for Doxygen.
#![allow(rustdoc::broken_intra_doc_links, rustdoc::private_intra_doc_links)]

pub mod beam;
pub mod bind;
pub mod branch;
pub mod bushing;
pub mod callback;
pub mod change;
pub mod condition;
pub mod contents;
pub mod controller;
pub mod equations;
pub mod files;
pub mod filter;
pub mod force;
pub mod guard;
pub mod id;
pub mod joint;
pub mod label;
pub mod last_error;
pub mod line;
pub mod linear_solver;
pub mod load;
pub mod load_contents;
pub mod march;
pub mod memory;
pub mod model;
pub mod modes;
pub mod motion;
pub mod parameter;
pub mod periodic;
pub mod quantity;
pub mod relation;
pub mod rigid_edge;
pub mod rotor_symmetry;
pub mod section;
pub mod sensitivity;
pub mod shell;
pub mod shooting;
pub mod signal;
pub mod solution;
pub mod spin;
pub mod stability;
pub mod statics;
pub mod status;
pub mod summary;
pub mod surface;
pub mod surface_force;
pub mod table;
pub mod turning_frame;
pub mod user_force;
pub mod version;

mod call;
mod handle;
#[cfg(test)]
mod old_structs_test;
mod options;
#[cfg(test)]
mod panic_test;
mod pointer;
mod ranks;
#[cfg(test)]
mod tests;
