use super::*;
use crate::ranks::threads::on_ranks;
use crate::test_models::elements::all_elements;
use crate::test_models::small::moving_models;

const POINTS: usize = 11;

/// Numbers that are all different.
fn wave(i: usize) -> f64 {
    (0.37 * i as f64 + 0.2).sin()
}

/// A motion of all nodes, with own unknowns that are not zero, and the whole system.
fn moved(model: &Model, period: f64) -> (Arc<System>, Collocation, GridState) {
    let system = Arc::new(System::new(model, period).unwrap());
    let grid = TimeGrid::new(POINTS, period).unwrap();
    let equations = Collocation::new(system.clone(), grid).unwrap();
    let scales = equations.column_scale().iter().enumerate();
    let increment: Vec<f64> = scales.map(|(i, s)| 0.03 * wave(i) * s).collect();
    let state = GridState::reference(&system, grid).incremented(&system, &increment, 1.0);
    (system, equations, state)
}

fn models() -> Vec<(Model, f64)> {
    let mut models = moving_models();
    models.push(all_elements());
    models
}

fn options(ranks: Arc<dyn Ranks>, start: &GridState, which: Preconditioner) -> RankOptions {
    RankOptions {
        ranks,
        owners: None,
        preconditioner: Some(which),
        threads: 1,
        start: Some(start.clone()),
    }
}

/// Largest difference, relative to the largest of what is expected.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let largest = |x: &[f64]| x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let differences: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    largest(&differences) / largest(expected)
}

/// What all ranks find, at its places in a vector of all.
fn together(parts: Vec<(Vec<usize>, Vec<f64>)>) -> Vec<f64> {
    let size = parts.iter().map(|(numbers, _)| numbers.len()).sum();
    let mut all = vec![f64::NAN; size];
    for (number, value) in parts.into_iter().flat_map(|(n, x)| n.into_iter().zip(x)) {
        assert!(all[number].is_nan(), "{number} belongs to two ranks");
        all[number] = value;
    }
    all
}

#[test]
fn ranks_have_the_equations_of_the_whole() {
    for (model, period) in models() {
        let (system, mut equations, state) = moved(&model, period);
        let mut residual = vec![0.0; equations.size()];
        equations.residual(&state, &mut residual).unwrap();
        let mut tangent = Tangent::with_resultants_apart(&system, POINTS);
        tangent.evaluate(&mut equations, &state).unwrap();
        for which in [Preconditioner::TimeLocal, Preconditioner::BodyCirculant] {
            let apart = SpreadFactors::keeps_resultants(which);
            let behind = if apart { tangent.resultants() } else { 0 };
            let x: Vec<f64> = (0..equations.size() + behind)
                .map(|i| wave(3 * i))
                .collect();
            let mut product = vec![0.0; x.len()];
            tangent.apply(&equations, &x, &mut product);
            let mut transposed = vec![0.0; x.len()];
            tangent.apply_transposed(&equations, &x, &mut transposed);
            let powers = [1, 2].map(|power| {
                let mut product = vec![0.0; x.len()];
                tangent.apply_power(&equations, power, &x, &mut product);
                product
            });
            for count in [1, 2, 3, 4] {
                let found = on_ranks(count, |ranks| {
                    let options = options(ranks, &state, which);
                    let mut own = RankEquations::new(&model, period, POINTS, options).unwrap();
                    assert_eq!(own.total(), x.len());
                    let numbers = own.numbers();
                    let own_x: Vec<f64> = numbers.iter().map(|&i| x[i]).collect();
                    let mut all = [(); 5].map(|()| vec![0.0; own.size()]);
                    own.residual(&mut all[0]).unwrap();
                    own.linearise().unwrap();
                    own.product(&own_x, &mut all[1]).unwrap();
                    own.transposed_product(&own_x, &mut all[2]).unwrap();
                    own.power_product(1, &own_x, &mut all[3]).unwrap();
                    own.power_product(2, &own_x, &mut all[4]).unwrap();
                    assert_eq!(own.halo_size() > 0, count > 1);
                    all.map(|values| (numbers.clone(), values))
                });
                // Sums over elements are in another order where they are divided.
                let of = |i: usize| together(found.iter().map(|all| all[i].clone()).collect());
                let size = equations.size();
                assert!(difference(&of(0)[..size], &residual) < 1e-13);
                let error = difference(&of(1), &product);
                assert!(error < 1e-13, "{count} ranks: {error:e}");
                assert!(difference(&of(2), &transposed) < 1e-13);
                for (power, expected) in powers.iter().enumerate() {
                    assert!(difference(&of(3 + power), expected) < 1e-13);
                }
            }
        }
    }
}

#[test]
fn steps_are_those_of_the_whole_and_states_come_back() {
    for (model, period) in models() {
        let (system, equations, state) = moved(&model, period);
        let increment: Vec<f64> = (0..equations.size()).map(|i| 0.02 * wave(5 * i)).collect();
        let scales = equations.column_scale();
        let unscaled: Vec<f64> = increment.iter().zip(scales).map(|(x, s)| x * s).collect();
        let expected = state.incremented(&system, &unscaled, 0.5);
        for count in [1, 3] {
            on_ranks(count, |ranks| {
                let options = options(ranks, &state, Preconditioner::TimeLocal);
                let mut own = RankEquations::new(&model, period, POINTS, options).unwrap();
                let before = (own.motions(), own.own_unknowns());
                let x: Vec<f64> = own.numbers().iter().map(|&i| increment[i]).collect();
                let [motion, _] = own.norms(&x).unwrap();
                let largest = increment[..equations.layout().motions().end].iter();
                assert_eq!(motion, largest.fold(0.0f64, |m, x| m.max(x.abs())));
                own.update(&x, 0.5).unwrap();
                let places = own.nodes().into_iter();
                let moved = places.flat_map(|node| expected.node(node).iter().flat_map(numbers_of));
                let moved: Vec<f64> = moved.collect();
                assert_eq!(own.motions(), moved);
                let mut residual = vec![0.0; own.size()];
                own.residual(&mut residual).unwrap();
                own.set_state(&before.0, &before.1).unwrap();
                assert!(difference(&own.motions(), &before.0) < 1e-15);
                own.set_state(&moved, &own.own_unknowns()).unwrap();
                // Halos are as they were after the step, but for own unknowns.
                let mut again = residual.clone();
                own.residual(&mut again).unwrap();
                assert!(again != residual || own.own_unknowns() == before.1);
            });
        }
    }
}

#[test]
fn what_ranks_do_not_agree_on_is_an_error_on_all() {
    let (model, period) = &moving_models()[1];
    let (_, _, state) = moved(model, *period);
    let errors = on_ranks(3, |ranks| {
        let mut other = model.clone();
        if ranks.rank() == 1 {
            other
                .add_rigid_body(
                    1.0,
                    &nalgebra::Vector3::zeros(),
                    &nalgebra::Matrix3::identity(),
                )
                .unwrap();
        }
        let options = options(ranks, &state, Preconditioner::TimeLocal);
        RankEquations::new(&other, *period, POINTS, options)
            .unwrap_err()
            .to_string()
    });
    assert!(errors[0].contains("another one on rank 1"), "{}", errors[0]);
    assert!(errors.iter().all(|error| *error == errors[0]));
    // A vector of a wrong length on one rank alone.
    let errors = on_ranks(2, |ranks| {
        let length = ranks.rank();
        let options = options(ranks, &state, Preconditioner::TimeLocal);
        let mut own = RankEquations::new(model, *period, POINTS, options).unwrap();
        let mut out = vec![0.0; own.size() - length];
        own.residual(&mut out).unwrap_err().to_string()
    });
    assert!(
        errors[0].starts_with("rank 1: out: expected"),
        "{}",
        errors[0]
    );
    assert_eq!(errors[0], errors[1]);
}

#[test]
fn partitions_without_nodes_for_a_rank_are_refused() {
    let (model, period) = &moving_models()[1];
    let (system, _, state) = moved(model, *period);
    let nodes = system.nodes();
    let refused = |count: usize, owners: Option<Vec<usize>>| {
        let errors = on_ranks(count, |ranks| {
            let options = RankOptions {
                owners: owners.clone(),
                ..options(ranks, &state, Preconditioner::TimeLocal)
            };
            RankEquations::new(model, *period, POINTS, options)
                .unwrap_err()
                .to_string()
        });
        assert!(errors.iter().all(|error| *error == errors[0]));
        errors[0].clone()
    };
    let many = refused(nodes + 1, None);
    assert!(many.contains(&format!("at most {nodes}")), "{many}");
    let mut owners = vec![0; nodes];
    assert!(refused(2, Some(owners.clone())).contains("none for rank 1"));
    owners[1] = 2;
    assert!(refused(2, Some(owners.clone())).contains("owners[1]"));
    owners.pop();
    assert!(refused(2, Some(owners)).contains(&nodes.to_string()));
}
