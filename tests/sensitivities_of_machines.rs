//! Sensitivities of random machines: the direct and the adjoint method, by factors and by
//! iteration, find the same.

mod common;
#[path = "models/machines/mod.rs"]
mod machines;

use common::largest;
use machines::{FAMILIES, Machine, judge};
use periodyn::model::Target;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::quantity::{Feature, Quantity};
use periodyn::solve::{
    Dependent, Free, LinearMethod, SensitivityMethod, SensitivityOptions, solve_sensitivities,
};

const SEED: u64 = 77;
/// Machines of each family, and nodes of one that is small enough.
const SHARE: usize = 3;
const MOST_NODES: usize = 14;
/// Difference to what factors find by the direct method, relative to the largest derivative of a
/// dependent, and what is rounding: positions are of the order of 1, and loads may be of 1000.
const CLOSE: f64 = 1e-6;
const ROUNDING: f64 = 1e-12;
/// Machines for which a method that was asked for by name is refused, of all 33.
const MOST_REFUSED: usize = 2;

/// Gives a machine parameters of what it has.
fn release(machine: &mut Machine) -> Vec<Free> {
    let model = &mut machine.model;
    let mut targets = vec![Target::MassDamping];
    if model.beam_element_count() > 0 {
        targets.extend([Target::BeamStiffness(0), Target::BeamMass(0)]);
    }
    if model.inertias().count() > 0 {
        targets.push(Target::Inertia(0));
    }
    let mut release = |target: Target| {
        let parameter = model
            .add_parameter(&format!("{target:?}"), 1.0, 1.0)
            .unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        Free::Parameter(parameter)
    };
    targets.drain(..).map(&mut release).collect()
}

/// Positions of the first node, which may be driven, and of the last.
fn positions(nodes: usize) -> Vec<Dependent> {
    let of = |(node, component, feature)| {
        let position = Quantity::Node(node, NodeQuantity::Position).component(component);
        Dependent::Feature(position, feature)
    };
    [
        (0, 0, Feature::Cosine(1)),
        (nodes - 1, 0, Feature::Mean),
        (nodes - 1, 1, Feature::Cosine(1)),
        (nodes - 1, 2, Feature::Sine(1)),
    ]
    .map(of)
    .to_vec()
}

#[test]
fn all_ways_find_the_same_sensitivities() {
    let (mut known, mut refused) = (0, Vec::new());
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        for (index, mut machine) in machines::small(SEED, family, MOST_NODES).take(SHARE) {
            let parameters = release(&mut machine);
            let solution: Solution = judge::solve(&machine).unwrap();
            if !solution.outcome().is_solution() {
                continue;
            }
            let dependents = positions(machine.model.node_count());
            let find = |method, linear| {
                let options = SensitivityOptions {
                    method,
                    linear,
                    threads: 1,
                };
                let solved = (solution.model(), solution.details());
                let free = (&[][..], &[][..]);
                solve_sensitivities(solved, free, &dependents, &parameters, &options)
            };
            use SensitivityMethod::{Adjoint, Automatic, Direct};
            let what = format!("{name} {index} ({})", machine.what);
            let expected = find(Direct, LinearMethod::Direct);
            let expected = expected.unwrap_or_else(|error| panic!("{what}: {error}"));
            known += 1;
            for (method, linear) in [
                (Automatic, LinearMethod::Automatic),
                (Direct, LinearMethod::Iterative(None)),
                (Adjoint, LinearMethod::Direct),
                (Adjoint, LinearMethod::Iterative(None)),
            ] {
                let found = match find(method, linear) {
                    Ok(found) => found.derivatives,
                    Err(error) => {
                        assert!(method != Automatic, "{what}: {error}");
                        refused.push(format!("{what}: {method:?}, {linear:?}: {error}"));
                        continue;
                    }
                };
                for (found, row) in found.row_iter().zip(expected.derivatives.row_iter()) {
                    let error = largest((found - row).iter().copied());
                    let size = largest(row.iter().copied());
                    assert!(
                        error <= CLOSE * size + ROUNDING,
                        "{what}: {method:?}, {linear:?}: {found} {row}"
                    );
                }
            }
        }
    }
    println!("{known} machines, refused: {}", refused.join("\n"));
    assert!(known >= 25, "{known}");
    assert!(refused.len() <= MOST_REFUSED, "{}", refused.join("\n"));
}
