//! How near the direct solver is to the machine's limits: dense kernels' share of the time of a
//! solve, and their rate as a fraction of the machine's own matrix product.

mod common;

use common::models::beams::{forced_cantilever, planar_four_bar, rotor_blade, slider_crank};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use common::table::Table;
use common::timing::{bandwidth, median, product_time};
use periodyn::model::Model;
use periodyn::solve::{
    LinearMethod, Outcome, PeriodicOptions, Solved, solve_periodic, try_direct_solve,
};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

const REPETITIONS: usize = 9;

struct Case {
    name: &'static str,
    model: Model,
    period: f64,
    points: usize,
    linear: LinearMethod,
}

fn main() {
    let mut machine = Table::new("machine", &["quantity", "value", "unit"]);
    let product = product_time();
    let rate = 1e9 / product.as_secs_f64();
    machine.row(cells![
        "10⁹ multiply-adds of a matrix product",
        format!("{:.1}", 1e3 * product.as_secs_f64()),
        "ms"
    ]);
    machine.row(cells![
        "matrix product",
        format!("{:.1}", 2e-9 * rate),
        "GFLOP/s"
    ]);
    machine.row(cells![
        "memory bandwidth",
        format!("{:.1}", 1e-9 * bandwidth()),
        "GB/s"
    ]);

    let direct = LinearMethod::Direct;
    let case = |name, (model, period), points, linear| Case {
        name,
        model,
        period,
        points,
        linear,
    };
    let four_bar = |elements| (spatial_four_bar(elements, 1), FOUR_BAR_PERIOD);
    let crank = TAU / 120.0;
    let cases = [
        case(
            "spatial four-bar, 8",
            four_bar(8),
            21,
            LinearMethod::Automatic,
        ),
        case("spatial four-bar, 8", four_bar(8), 21, direct),
        case("spatial four-bar, 8", four_bar(8), 63, direct),
        case("spatial four-bar, 32", four_bar(32), 21, direct),
        case(
            "planar four-bar, 5 × 2",
            planar_four_bar(5, 2, 1e-3),
            101,
            direct,
        ),
        case(
            "slider-crank, 4 × 4",
            (slider_crank(4, 4, crank), crank),
            41,
            direct,
        ),
        case(
            "forced cantilever, 4 × 4",
            forced_cantilever(4, 4),
            41,
            direct,
        ),
        case("rotor blade, 4 × 4", rotor_blade(4, 4), 41, direct),
    ];
    let mut table = Table::new(
        "floors",
        &[
            "model",
            "N",
            "method",
            "unknowns",
            "total ms",
            "total / product",
            "guess %",
            "assembly %",
            "dense %",
            "dense / GEMM rate",
        ],
    );
    for case in &cases {
        let options = PeriodicOptions {
            linear: case.linear,
            ..PeriodicOptions::with_grid_points(case.points)
        };
        let runs: Vec<(Duration, Solved)> = (0..REPETITIONS)
            .map(|_| {
                let start = Instant::now();
                let solve =
                    solve_periodic(&case.model, case.period, &options, &mut |_, _| true).unwrap();
                assert_eq!(solve.report.outcome, Outcome::Converged);
                (start.elapsed(), solve)
            })
            .collect();
        let seconds = |part: &dyn Fn(&Solved) -> Duration| {
            median(runs.iter().map(|r| part(&r.1))).as_secs_f64()
        };
        let total = median(runs.iter().map(|r| r.0)).as_secs_f64();
        let solve = &runs[0].1;
        let dense = seconds(&|s| s.timings.factorisation) + seconds(&|s| s.timings.substitution);
        let is_direct = solve.periodic().unwrap().iterative.is_none();
        // The substitutions that refine a solution read memory; the rate is that of the factors.
        let trials: Vec<_> = (0..REPETITIONS)
            .filter(|_| is_direct)
            .map(|_| try_direct_solve(solve, 1).unwrap())
            .collect();
        let fraction = trials.first().map(|trial| {
            let factorisation = median(trials.iter().map(|t| t.timings.factorisation));
            trial.cost.work / factorisation.as_secs_f64() / rate
        });
        let percent = |part: f64| format!("{:.0}", 100.0 * part / total);
        table.row(cells![
            case.name,
            case.points,
            if is_direct { "direct" } else { "iterative" },
            (6 * solve.system.nodes() + solve.system.own_unknowns()) * case.points,
            format!("{:.2}", 1e3 * total),
            format!("{:.2}", total / product.as_secs_f64()),
            percent(seconds(&|s| s.guess_time)),
            percent(seconds(&|s| s.timings.assembly)),
            percent(dense),
            fraction.map_or("-".into(), |f| format!("{f:.2}")),
        ]);
    }
}
