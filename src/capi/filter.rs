//! Solutions seen through a spectral filter.

use super::guard::guard;
use super::solution::pdn_solution;
use super::status::pdn_status;
use crate::error::Error;
use crate::fourier::{FilterKind, SpectralFilter};

/// Spectral filter: Lanczos' factors, (sin(x) / x)^order with x = pi j / (H + 1) for harmonic j of
/// H. Of order 1 they are running means over two grid intervals; order 2 or 3 removes more.
pub const PDN_FILTER_LANCZOS: i32 = 3100;
/// Spectral filter: exp(-36 (j / (H + 1))^order) for harmonic j of H. Order 2 smooths most; a high
/// order, as 8, spares all but the highest harmonics.
pub const PDN_FILTER_EXPONENTIAL: i32 = 3101;

/// A copy of a solution whose quantities are seen through a spectral filter.
///
/// Where a response has a kink or a narrow peak (PDN_DECAY_SLOW), forces oscillate about their
/// values over the whole period, as all Fourier sums do (Gibbs). A filter weakens the harmonics
/// towards the highest: the oscillations stay near the peak, which itself gets lower and wider.
/// Without one, nothing is filtered.
///
/// It acts on values at any time, on harmonics, tables and animations. The motions of nodes are
/// filtered as motions, and velocities follow from them. The solve, its diagnostics and report, and
/// what starts from the copy are those of the solution. A filter that the solution has already is
/// replaced.
///
/// @param solution  the solution; not NULL. The copy is one of its own, which may outlive it
/// @param filter  PDN_FILTER_LANCZOS or PDN_FILTER_EXPONENTIAL
/// @param order  from 1 to 32
/// @param out  the copy; free it with ::pdn_solution_free; written on success only
/// @return PDN_OK, PDN_ERR_NULL, PDN_ERR_VALUE, PDN_ERR_NOT_AVAILABLE (a march has no harmonics),
///     PDN_ERR_MEMORY
///
/// Threads: like a `const` use of `solution`.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pdn_solution_filtered(
    solution: *const pdn_solution,
    filter: i32,
    order: i32,
    out: *mut *mut pdn_solution,
) -> pdn_status {
    guard(|call| {
        let solution = call.shared(solution, "solution")?;
        let out = call.out(out, "out")?;
        let kind = match filter {
            PDN_FILTER_LANCZOS => FilterKind::Lanczos,
            PDN_FILTER_EXPONENTIAL => FilterKind::Exponential,
            _ => {
                let expected = "PDN_FILTER_LANCZOS or PDN_FILTER_EXPONENTIAL";
                return Err(Error::value("filter", expected, filter));
            }
        };
        let filter = u32::try_from(order)
            .ok()
            .and_then(|order| SpectralFilter::new(kind, order).ok());
        let filter = filter.ok_or_else(|| Error::value("order", "an order from 1 to 32", order))?;
        out.give(solution.filtered(filter)?);
        Ok(())
    })
}
