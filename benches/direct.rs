//! From model to solution by the direct solver on one thread, and where the time goes.
//!
//! Times are medians; beside them stands the time of 10⁹ multiply-adds of the machine's own matrix
//! product on one core, measured in the same run, so that machines can be compared.

mod common;

use common::models::beams::{forced_cantilever, rotor_blade, slider_crank};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use common::timing::{TITLES, product_time, solve_and_print};
use std::f64::consts::TAU;

fn main() {
    let product = product_time();
    println!(
        "10⁹ multiply-adds of a matrix product: {:.1} ms",
        1e3 * product.as_secs_f64()
    );
    println!("Times in ms:\n{:32}{TITLES}", "model");
    for (elements, points) in [(8, &[11, 21, 41][..]), (32, &[21])] {
        let name = format!("spatial four-bar, 3 × {elements} × 1");
        let model = spatial_four_bar(elements, 1);
        solve_and_print(&name, &model, FOUR_BAR_PERIOD, points, product);
    }
    for (elements, degree) in [(2, 4), (4, 4)] {
        let mesh = format!("{elements} × {degree}");
        let (rod, period) = forced_cantilever(elements, degree);
        let points = [21, 41];
        solve_and_print(
            &format!("forced cantilever, {mesh}"),
            &rod,
            period,
            &points,
            product,
        );
        let (blade, period) = rotor_blade(elements, degree);
        solve_and_print(
            &format!("rotor blade, {mesh}"),
            &blade,
            period,
            &points,
            product,
        );
        let period = TAU / 120.0;
        let crank = slider_crank(elements, degree, period);
        solve_and_print(
            &format!("slider-crank, {mesh}"),
            &crank,
            period,
            &points,
            product,
        );
    }
}
