//! Modes of square plates, thin and thick, with the figures of an independent program for the same
//! meshes. Finer ones take minutes: `cargo bench --bench shells -- --modes`.

mod models;

use models::shells::square_plate;
use periodyn::output::Modes;
use periodyn::solve::{ModesOptions, Outcome};

/// The lowest frequencies of a square plate, `ω a² √(ρh/D)`.
fn plate_modes(h: f64, nodes: usize, elements: usize, clamped: bool, count: usize) -> Vec<f64> {
    let (model, unit) = square_plate(h, nodes, elements, clamped);
    let options = ModesOptions {
        count,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged, "{}", modes.report());
    let found = modes.modes().iter();
    found.map(|mode| mode.eigenvalue.im / unit).collect()
}

/// Leissa's frequencies of thin plates (1973), clamped along an edge and free: upper bounds, by up
/// to one percent.
const LEISSA: [[f64; 6]; 2] = [
    [3.4917, 8.5246, 21.429, 27.331, 31.111, 54.443],
    [13.489, 19.789, 24.432, 35.024, 35.024, 61.526],
];

/// Checks the six lowest frequencies to a unit of the last digit that is given.
fn require_modes(h: f64, nodes: usize, elements: usize, clamped: bool, given: [f64; 6]) {
    let rigid = if clamped { 0 } else { 6 };
    let found = plate_modes(h, nodes, elements, clamped, rigid + 6);
    assert_eq!(found.len(), rigid + 6);
    assert!(found[..rigid].iter().all(|&x| x == 0.0));
    let what = format!("h/a = {h}, {nodes} nodes, {elements}², clamped {clamped}");
    println!("{what}: {:?}, given {given:?}", &found[rigid..]);
    for (found, given) in found[rigid..].iter().zip(&given) {
        // Six digits each.
        let unit = if *given < 10.0 { 1e-5 } else { 1e-4 };
        assert!((found - given).abs() <= unit, "{what}: {found} {given}");
    }
    if h < 0.01 {
        for (found, bound) in found[rigid..].iter().zip(&LEISSA[usize::from(!clamped)]) {
            let below = (bound - found) / bound;
            assert!((0.0..0.01).contains(&below), "{what}: {found} {bound}");
        }
    }
}

#[test]
fn clamped_plates_have_their_natural_frequencies() {
    for (h, nodes, elements, given) in [
        (
            1e-3,
            5,
            4,
            [3.47208, 8.50939, 21.2908, 27.1994, 30.9658, 54.1949],
        ),
        (
            1e-3,
            8,
            2,
            [3.47137, 8.50784, 21.2867, 27.1978, 30.9602, 54.1745],
        ),
        (
            0.1,
            7,
            2,
            [3.43368, 8.13680, 20.1210, 21.7970, 25.6268, 28.5156],
        ),
    ] {
        require_modes(h, nodes, elements, true, given);
    }
}

#[test]
fn free_plates_have_their_natural_frequencies() {
    for (h, nodes, elements, given) in [
        (
            1e-3,
            5,
            4,
            [13.4676, 19.5960, 24.2700, 34.7995, 34.7995, 61.0898],
        ),
        (
            1e-3,
            8,
            2,
            [13.4677, 19.5959, 24.2696, 34.7958, 34.7958, 61.0898],
        ),
        (
            0.1,
            7,
            2,
            [12.8858, 18.9482, 23.3378, 32.3069, 32.3069, 55.4008],
        ),
    ] {
        require_modes(h, nodes, elements, false, given);
    }
}
