//! Sections of beams that turn from node to node: how far they may, as nodes alone cannot tell.

mod common;

use common::*;
use nalgebra::Vector3;
use periodyn::error::{ErrorKind, Result};
use periodyn::model::*;
use std::f64::consts::PI;

const SPAN: f64 = 2.0;

fn stations(twists: &[f64]) -> Vec<SectionStation> {
    let section =
        SectionInput::diagonal(&[1e6, 4e5, 4e5, 50.0, 60.0, 90.0], &[3.0, 0.1, 0.04, 0.06]);
    let last = (twists.len() - 1).max(1) as f64;
    let station = |(i, &twist): (usize, &f64)| SectionStation {
        fraction: i as f64 / last,
        section: section.clone().unwrap(),
        twist,
    };
    twists.iter().enumerate().map(station).collect()
}

/// A straight beam of these twists at equally far stations.
fn twisted(model: &mut Model, twists: &[f64], elements: usize, degree: usize) -> Result<BeamIds> {
    let line = straight_line(&Vector3::zeros(), &(Vector3::x() * SPAN), &Vector3::y())?;
    model.add_beam_along(line, &stations(twists), elements, degree)
}

/// A straight beam whose axis 2 turns by this angle.
fn turned(model: &mut Model, angle: f64, elements: usize, degree: usize) -> Result<BeamIds> {
    let line = smooth_curve(move |s| {
        let (sine, cosine) = (angle * s).sin_cos();
        Ok((Vector3::x() * (SPAN * s), Vector3::new(0.0, cosine, sine)))
    });
    model.add_beam_along(
        line,
        &SectionStation::uniform(&stations(&[0.0])[0].section),
        elements,
        degree,
    )
}

fn assert_has_its_mass(model: &Model, what: &str) {
    let (mass, moment) = model.mass_and_moment().unwrap();
    let exact = 3.0 * SPAN;
    assert!((mass - exact).abs() < 1e-13 * exact, "{what}: {mass}");
    let error = (moment - Vector3::x() * (0.5 * SPAN * exact)).amax();
    assert!(error < 1e-12 * exact, "{what}: {error:e}");
}

#[test]
fn stations_turn_by_less_than_half_a_turn_from_node_to_node() {
    for (elements, degree) in [(1, 1), (4, 1), (3, 2), (2, 3), (1, 8)] {
        for sign in [1.0f64, -1.0] {
            let widest = {
                let mut model = Model::new();
                let ids = twisted(&mut model, &[0.0], elements, degree).unwrap();
                let places: Vec<f64> = (ids.first_node..=ids.last_node)
                    .map(|node| model.node(node).unwrap().position.x / SPAN)
                    .collect();
                largest(places.windows(2).map(|pair| pair[1] - pair[0]))
            };
            let mut model = Model::new();
            ball(&mut model, 1.0, 1.0, &Vector3::zeros());
            let over = sign * 1.001 * PI / widest;
            let error = twisted(&mut model, &[0.3, 0.3 + over], elements, degree).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Value);
            let text = error.to_string();
            let expected = "twists: expected less than half a turn (3.1416) from each node to the \
                            next, got 3.1447 from fraction ";
            assert!(text.starts_with(expected), "{text}");
            assert_eq!((model.node_count(), model.beam_element_count()), (1, 0));
            // Of the first degree nearly half a turn is followed, of others as much as their
            // polynomials can.
            let most = if degree == 1 { 0.99 } else { 0.5 };
            let mut model = Model::new();
            let under = sign * most * PI / widest;
            twisted(&mut model, &[0.3, 0.3 + under], elements, degree).unwrap();
            assert_has_its_mass(&model, &format!("{elements} elements of degree {degree}"));
        }
    }
    // There and back between two nodes, which are alike.
    let mut model = Model::new();
    let error = twisted(&mut model, &[0.0, 3.2, 0.0], 1, 1)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("got 3.2000 from fraction 0.000000 to 1.000000"),
        "{error}"
    );
    twisted(&mut model, &[0.0, 3.1, 0.0], 1, 1).unwrap();
    assert_has_its_mass(&model, "there and back");
}

#[test]
fn whole_turns_of_all_stations_are_nothing() {
    // The nearest numbers to so many radians are further apart than a radian: the twist is what the
    // number given says all the same.
    for offset in [1e16f64, -1e16, 1e300, 40.0] {
        let mut model = Model::new();
        let later = offset + if offset.abs() > 1e17 { 0.0 } else { 2.0 };
        twisted(&mut model, &[offset, later], 2, 2).unwrap();
        assert_has_its_mass(&model, &format!("turned by {offset:e}"));
        for (node, twist) in [(0, offset), (4, later)] {
            let (sine, cosine) = f64::sin_cos(twist);
            let across = model.node(node).unwrap().rotation.column(1).into_owned();
            let error = (across - Vector3::new(0.0, cosine, sine)).amax();
            assert!(error < 1e-15 * 10.0, "{offset:e}: {error:e}");
        }
    }
    let mut model = Model::new();
    for twists in [[0.0, 1e16], [1e16, 0.0], [-1e16, 1e16], [1e308, -1e308]] {
        let error = twisted(&mut model, &twists, 2, 2).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value, "{error}");
        assert!(error.to_string().starts_with("twists"), "{error}");
    }
    assert_eq!(model.node_count(), 0);
}

#[test]
fn lines_turn_by_less_than_half_a_turn_from_node_to_node() {
    for (elements, degree) in [(1, 1), (4, 1), (3, 2), (2, 3), (1, 6)] {
        let (mut accepted, mut refused) = (0.0f64, f64::INFINITY);
        for k in 1..200 {
            let angle = 0.05 * PI * f64::from(k) * (degree * elements) as f64;
            let mut model = Model::new();
            match turned(&mut model, angle, elements, degree) {
                Ok(_) => {
                    accepted = angle;
                    // Coarse, but not beyond recognition.
                    let mass = model.mass_and_moment().unwrap().0;
                    let error = mass / (3.0 * SPAN) - 1.0;
                    assert!(
                        (-0.2..0.25).contains(&error),
                        "{elements}, {degree}: {angle} {mass}"
                    );
                }
                Err(error) => {
                    refused = refused.min(angle);
                    let text = error.to_string();
                    assert!(
                        text.contains("frames that turn little from each node to the next")
                            || text.contains("sections that turn by less than half a turn")
                            || text.contains("turns by more than its order can follow"),
                        "{text}"
                    );
                    assert_eq!(model.node_count(), 0);
                }
            }
        }
        // None beyond the first that is refused.
        let per_gap = accepted / (degree * elements) as f64;
        assert!(
            accepted < refused,
            "{elements}, {degree}: {accepted} {refused}"
        );
        assert!(
            (0.2 * PI..0.6 * PI).contains(&per_gap),
            "{elements}, {degree}: {per_gap}"
        );
    }
}
