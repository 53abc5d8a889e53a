//! Sensitivities of periodic solutions.

use super::condition::{Conditions, feature, free_parameter, pdn_conditions};
use super::guard::{free, guard, init};
use super::handle::Handle;
use super::linear_solver::{PDN_LINEAR_AUTOMATIC, read_linear_solver};
use super::model::{self, choose};
use super::options::Options;
use super::parameter::any_parameter;
use super::quantity::{pdn_quantity, selection};
use super::solution::pdn_solution;
use super::stability::pdn_stability;
use super::status::pdn_status;
use crate::error::{Error, Result};
use crate::quantity::Peak;
use crate::solve::{
    Dependent, SensitivityMethod, SensitivityOptions, solve_multiplier_sensitivities,
    solve_sensitivities,
};
use nalgebra::Complex;

/// Feature of a quantity, for sensitivities: its largest value over the period.
pub const PDN_FEATURE_LARGEST: i32 = 2904;
/// Feature of a quantity, for sensitivities: its smallest value over the period.
pub const PDN_FEATURE_SMALLEST: i32 = 2905;

/// Sensitivities: with as few linear solves as can be, directly or adjoint.
pub const PDN_SENSITIVITY_AUTOMATIC: i32 = 3900;
/// Sensitivities: a linear solve for each parameter.
pub const PDN_SENSITIVITY_DIRECT: i32 = 3901;
/// Sensitivities: a transposed linear solve for each dependent, by factors of the whole Jacobian.
pub const PDN_SENSITIVITY_ADJOINT: i32 = 3902;

/// What is differentiated, by what. Made by ::pdn_sensitivities_new, freed by
/// ::pdn_sensitivities_free.
pub struct pdn_sensitivities {
    _private: [u8; 0],
}

/// What depends on parameters; ids of these are looked up later.
#[derive(Debug, Clone, Copy)]
enum Asked {
    Of(Dependent),
    Free(i32),
}

/// What a ::pdn_sensitivities holds.
#[derive(Debug, Clone, Default)]
pub struct Lists {
    dependents: Vec<Asked>,
    parameters: Vec<i32>,
}

impl Handle for pdn_sensitivities {
    type Core = Lists;
}

/// Options of ::pdn_solution_sensitivities. Set the defaults by `PDN_INIT(pdn_sensitivity_options,
/// &options)`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct pdn_sensitivity_options {
    /// Set by the initialiser.
    pub struct_size: usize,
    /// PDN_SENSITIVITY_AUTOMATIC, the default, PDN_SENSITIVITY_DIRECT or PDN_SENSITIVITY_ADJOINT.
    pub method: i32,
    /// How linear equations are solved: PDN_LINEAR_AUTOMATIC, ... Default PDN_LINEAR_AUTOMATIC.
    pub linear_solver: i32,
    /// Threads that share the work; 0 for as many as there are processors. Default 1.
    pub threads: i32,
    /// Zero.
    pub reserved: i32,
}

// SAFETY: all fields are plain numbers, `struct_size` is the first, no padding.
unsafe impl Options for pdn_sensitivity_options {
    const SIZES: &'static [usize] = &[24];

    fn defaults() -> Self {
        pdn_sensitivity_options {
            method: PDN_SENSITIVITY_AUTOMATIC,
            linear_solver: PDN_LINEAR_AUTOMATIC,
            threads: 1,
            ..Self::blank()
        }
    }
}

/// Sets default options; use `PDN_INIT(pdn_sensitivity_options, &options)`.
///
/// @param options  the options; not NULL
/// @param struct_size  `sizeof *options`
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivity_options_init(
    options: *mut pdn_sensitivity_options,
    struct_size: usize,
) {
    init(options, struct_size, "options");
}

/// Makes an empty list: nothing is differentiated.
///
/// It belongs to no model; ids are looked up when it is used.
///
/// @param out  the list; free it with ::pdn_sensitivities_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL
///
/// Threads: any.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivities_new(out: *mut *mut pdn_sensitivities) -> pdn_status {
    guard(|call| {
        let out = call.out(out, "out")?;
        out.give(Lists::default());
        Ok(())
    })
}

/// Frees a list; NULL does nothing.
///
/// @param sensitivities  the list, not to be used any more
///
/// Threads: exclusive use of `sensitivities`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivities_free(sensitivities: *mut pdn_sensitivities) {
    free(sensitivities);
}

/// Adds a dependent: the mean, a harmonic, the value at a time, or a peak of a quantity.
///
/// @param sensitivities  the list; not NULL
/// @param quantity  one component of a quantity, initialised by PDN_INIT; not NULL
/// @param feature  PDN_FEATURE_MEAN, PDN_FEATURE_COSINE, PDN_FEATURE_SINE, PDN_FEATURE_VALUE,
///     PDN_FEATURE_LARGEST or PDN_FEATURE_SMALLEST
/// @param at  the number of the harmonic, from 1, or the time; usually 0 for all else, where it is
///     not looked at
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_STRUCT_SIZE, PDN_ERR_NOT_FINITE, PDN_ERR_ID,
///     PDN_ERR_VALUE
///
/// Threads: exclusive use of `sensitivities`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivities_add_quantity(
    sensitivities: *mut pdn_sensitivities,
    quantity: *const pdn_quantity,
    feature: i32,
    at: f64,
) -> pdn_status {
    guard(|call| {
        let mut lists = call.exclusive(sensitivities, "sensitivities")?;
        let of = selection(call, quantity)?;
        if of.components() != 1 {
            let got = of.components();
            return Err(Error::value("quantity.component", "a single one", got));
        }
        lists.dependents.push(Asked::Of(match feature {
            PDN_FEATURE_LARGEST => Dependent::Peak(of, Peak::Largest),
            PDN_FEATURE_SMALLEST => Dependent::Peak(of, Peak::Smallest),
            other => Dependent::Feature(of, self::feature(call, other, at)?),
        }));
        Ok(())
    })
}

/// Adds a dependent: the value of a free parameter, which conditions determine.
///
/// @param sensitivities  the list; not NULL
/// @param parameter  id of a parameter, or PDN_FREQUENCY
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: exclusive use of `sensitivities`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivities_add_found(
    sensitivities: *mut pdn_sensitivities,
    parameter: i32,
) -> pdn_status {
    guard(|call| {
        let mut lists = call.exclusive(sensitivities, "sensitivities")?;
        let parameter = any_parameter(parameter)?;
        lists.dependents.push(Asked::Free(parameter));
        Ok(())
    })
}

/// Adds a parameter that all is differentiated by.
///
/// @param sensitivities  the list; not NULL
/// @param parameter  id of a parameter, or PDN_FREQUENCY
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_ID
///
/// Threads: exclusive use of `sensitivities`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_sensitivities_add_parameter(
    sensitivities: *mut pdn_sensitivities,
    parameter: i32,
) -> pdn_status {
    guard(|call| {
        let mut lists = call.exclusive(sensitivities, "sensitivities")?;
        let parameter = any_parameter(parameter)?;
        lists.parameters.push(parameter);
        Ok(())
    })
}

/// Derivatives of what comes out of a periodic solution by parameters of its model.
///
/// All else stays, but for the free parameters of `conditions`, which follow so that these go on to
/// be met: sensitivities at trim, or along an unknown period. A condition on the phase is that of
/// this solution; values that conditions ask for are not looked at but as those of the solution. A
/// parameter that moves nothing has zeros. Peaks vary as the value at their time does; a quantity
/// that has its peak at two times has no sensitivity. The equations are linearised and factored
/// once; each parameter, or each dependent, takes a solve with the factors.
///
/// @param solution  a converged solution of ::pdn_solve_periodic, ::pdn_solve_conditioned or one
///     like it; not NULL
/// @param sensitivities  what is differentiated, by what; not NULL
/// @param conditions  free parameters and as many conditions; NULL for none
/// @param options  may be NULL for the defaults
/// @param derivatives  array of shape [dependents] x [parameters], those by a parameter together
/// @param dependents  number of the dependents
/// @param parameters  number of the parameters
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_SIZE; PDN_ERR_ID; PDN_ERR_VALUE (a
///     parameter twice, or free); PDN_ERR_NOT_PERIODIC (PDN_FREQUENCY, and something has a
///     frequency of its own); PDN_ERR_NOT_AVAILABLE (no periodic solution or one that has not
///     converged, a fold, nothing that determines the phase, two equal peaks, what constraints that
///     depend on each other leave open); PDN_ERR_CALLBACK; PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `solution`, `sensitivities` and `conditions`. Functions of yours
/// are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_sensitivities(
    solution: *const pdn_solution,
    sensitivities: *const pdn_sensitivities,
    conditions: *const pdn_conditions,
    options: *const pdn_sensitivity_options,
    derivatives: *mut f64,
    dependents: usize,
    parameters: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let lists = call.shared(sensitivities, "sensitivities")?;
        let none = std::sync::Arc::new(Conditions::default());
        let conditions = match conditions.is_null() {
            true => none,
            false => call.shared(conditions, "conditions")?,
        };
        let given = call.options(options, "options")?;
        let counts = (lists.dependents.len(), lists.parameters.len());
        if dependents != counts.0 {
            return Err(Error::size("dependents", counts.0, dependents));
        }
        let length = dependents.saturating_mul(parameters);
        let out = match parameters == counts.1 {
            true => call.out_slice(derivatives, length, length, "derivatives")?,
            false => return Err(Error::size("parameters", counts.1, parameters)),
        };
        let model = solution.model();
        let (free, conditions) = conditions.of(model)?;
        let of = lists.dependents.iter().map(|asked| {
            Ok(match *asked {
                Asked::Of(dependent) => dependent,
                Asked::Free(id) => Dependent::Free(free_parameter(model, id)?),
            })
        });
        let by = lists.parameters.iter().map(|&id| free_parameter(model, id));
        let options = read_options(&given)?;
        let found = solve_sensitivities(
            (model, solution.details()),
            (&free, &conditions),
            &of.collect::<Result<Vec<_>>>()?,
            &by.collect::<Result<Vec<_>>>()?,
            &options,
        )?;
        out.set(found.derivatives.as_slice());
        Ok(())
    })
}

fn read_options(given: &pdn_sensitivity_options) -> Result<SensitivityOptions> {
    let methods = [
        (PDN_SENSITIVITY_AUTOMATIC, SensitivityMethod::Automatic),
        (PDN_SENSITIVITY_DIRECT, SensitivityMethod::Direct),
        (PDN_SENSITIVITY_ADJOINT, SensitivityMethod::Adjoint),
    ];
    let expected = "a constant PDN_SENSITIVITY_...";
    let threads = usize::try_from(given.threads);
    Ok(SensitivityOptions {
        method: choose(&methods, given.method, "options.method", expected)?,
        linear: read_linear_solver(given.linear_solver)?,
        threads: threads
            .map_err(|_| Error::value("options.threads", "zero or more", given.threads))?,
    })
}

/// Derivatives of a Floquet multiplier of a periodic solution by parameters of its model.
///
/// The solution follows the parameters, and so do the free parameters of `conditions`, so that
/// these go on to be met. The multiplier is first found once more, from the equations on the grid
/// of the solution, whose derivatives these are: that takes a complex factorisation for each of a
/// few iterations. A multiplier that is not the only one of its value, or that is 1 because its
/// mode moves the solution in time or space, has no derivatives.
///
/// @param solution  a converged solution of ::pdn_solve_periodic, ::pdn_solve_conditioned or one
///     like it; not NULL
/// @param sensitivities  the parameters; what else it lists is of no account; not NULL
/// @param stability  the multipliers of this solution; not NULL
/// @param number  number of the multiplier among these, from 0
/// @param conditions  free parameters and as many conditions; NULL for none
/// @param options  may be NULL for the defaults; the method is of no account
/// @param re  array of length [parameters]: derivatives of the real part
/// @param im  array of length [parameters]: those of the imaginary part
/// @param parameters  number of the parameters
/// @return PDN_OK; PDN_ERR_NULL; PDN_ERR_STRUCT_SIZE; PDN_ERR_SIZE; PDN_ERR_ID; PDN_ERR_VALUE (a
///     parameter twice, or free; multipliers of another period); PDN_ERR_NOT_PERIODIC
///     (PDN_FREQUENCY, and something has a frequency of its own); PDN_ERR_NOT_AVAILABLE (as of
///     ::pdn_solution_sensitivities; a multiplier that has no derivatives, or whose mode the grid
///     does not resolve); PDN_ERR_CALLBACK; PDN_ERR_OVERFLOW; PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `solution`, `sensitivities`, `stability` and `conditions`.
/// Functions of yours are called on this thread.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_multiplier_sensitivities(
    solution: *const pdn_solution,
    sensitivities: *const pdn_sensitivities,
    stability: *const pdn_stability,
    number: i32,
    conditions: *const pdn_conditions,
    options: *const pdn_sensitivity_options,
    re: *mut f64,
    im: *mut f64,
    parameters: usize,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let lists = call.shared(sensitivities, "sensitivities")?;
        let stability = call.shared(stability, "stability")?;
        let none = std::sync::Arc::new(Conditions::default());
        let conditions = match conditions.is_null() {
            true => none,
            false => call.shared(conditions, "conditions")?,
        };
        let given = call.options(options, "options")?;
        let count = stability.multipliers.len();
        let number = model::number(number, count, "number", "a multiplier's number")?;
        if parameters != lists.parameters.len() {
            return Err(Error::size(
                "parameters",
                lists.parameters.len(),
                parameters,
            ));
        }
        let re = call.out_slice(re, parameters, parameters, "re")?;
        let im = call.out_slice(im, parameters, parameters, "im")?;
        let model = solution.model();
        let (free, conditions) = conditions.of(model)?;
        let by = lists.parameters.iter().map(|&id| free_parameter(model, id));
        let found = solve_multiplier_sensitivities(
            (model, solution.details()),
            (&free, &conditions),
            (&stability, &[number]),
            &by.collect::<Result<Vec<_>>>()?,
            &read_options(&given)?,
        )?;
        let part = |of: fn(&Complex<f64>) -> f64| -> Vec<f64> {
            found.derivatives.iter().map(of).collect()
        };
        re.set(&part(|z| z.re));
        im.set(&part(|z| z.im));
        Ok(())
    })
}
