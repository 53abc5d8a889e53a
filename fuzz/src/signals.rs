//! Signals and sections as users give them: what is accepted is what was given, at any time and
//! station, and weighs what it is said to.

use super::bytes::Bytes;
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::model::{Model, SectionInput, SectionStation, Signal, straight_line};

/// Error of sums of harmonics, relative to the sum of their sizes: rounding of phases.
const ROUNDING: f64 = 1e-9;
/// Sizes up to which arithmetic neither overflows nor loses all digits.
const PLAIN: std::ops::Range<f64> = 1e-60..1e60;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    match bytes.below(2) {
        0 => signal(&mut bytes),
        _ => beam(&mut bytes),
    }
}

fn many(bytes: &mut Bytes, most: usize) -> Vec<f64> {
    let count = bytes.below(most + 1);
    (0..count).map(|_| bytes.number()).collect()
}

fn size(values: &[f64]) -> f64 {
    values.iter().map(|x| x.abs()).sum()
}

fn is_plain(x: f64) -> bool {
    x == 0.0 || PLAIN.contains(&x.abs())
}

fn signal(bytes: &mut Bytes) {
    let rate = bytes.number();
    let period = bytes.positive();
    let time = bytes.number();
    let by_samples = bytes.below(2) == 0;
    let (samples, mean) = (many(bytes, 96), bytes.number());
    let (mut cosines, mut sines) = (many(bytes, 40), many(bytes, 40));
    if !bytes.rarely(16) {
        let count = cosines.len().min(sines.len());
        cosines.truncate(count);
        sines.truncate(count);
    }
    let signal = match by_samples {
        true => Signal::samples(rate, &samples),
        false => Signal::harmonics(mean, rate, &cosines, &sines),
    };
    let given: Vec<f64> = match by_samples {
        true => [&samples[..], &[rate]].concat(),
        false => [&cosines[..], &sines, &[mean, rate]].concat(),
    };
    let finite = given.iter().all(|x| x.is_finite());
    let sizes_fit = if by_samples {
        !samples.is_empty()
    } else {
        cosines.len() == sines.len()
    };
    assert_eq!(
        signal.is_ok(),
        finite && sizes_fit,
        "{signal:?} of {given:?}"
    );
    let Ok(signal) = signal else {
        return;
    };
    let all_plain = given.iter().chain([&period, &time]).all(|x| is_plain(*x));
    if !all_plain || period == 0.0 || (time / period).abs() > 1e3 || rate.abs() > 1e6 {
        return;
    }
    let bound = signal.bind(period);
    let at = |time: f64| bound.value(time).expect("no function, no failure");
    let most = ROUNDING * (size(&given) + (rate * time).abs() + (rate * period).abs());
    let close = |a: f64, b: f64, what: &str| {
        assert!(
            (a - b).abs() <= most,
            "{what}: {a:e} for {b:e}, of {given:?}"
        );
    };
    let later = at(time + period) - rate * period;
    close(later, at(time), "a period later");
    if by_samples {
        for (k, sample) in samples.iter().enumerate() {
            let time = k as f64 * period / samples.len() as f64;
            close(at(time), sample + rate * time, "at a sample");
        }
    } else {
        let phase = std::f64::consts::TAU * (time / period).fract();
        let mut sum = mean + rate * time;
        for (j, (cosine, sine)) in cosines.iter().zip(&sines).enumerate() {
            let (s, c) = ((j + 1) as f64 * phase).sin_cos();
            sum += cosine * c + sine * s;
        }
        close(at(time), sum, "the sum of harmonics");
    }
}

/// A section that may be one.
fn section(bytes: &mut Bytes) -> SectionInput {
    let diagonal = |bytes: &mut Bytes, scale: f64| {
        Matrix6::from_fn(|i, j| {
            if i == j {
                scale * bytes.positive()
            } else {
                0.0
            }
        })
    };
    let mut section = SectionInput {
        stiffness: diagonal(bytes, 100.0),
        mass: {
            let mut mass = diagonal(bytes, 1.0);
            let line = mass[(0, 0)];
            (mass[(1, 1)], mass[(2, 2)]) = (line, line);
            mass
        },
        damping: diagonal(bytes, 0.1),
    };
    for _ in 0..bytes.below(4) {
        let matrix = match bytes.below(3) {
            0 => &mut section.stiffness,
            1 => &mut section.mass,
            _ => &mut section.damping,
        };
        let (i, j, x) = (bytes.below(6), bytes.below(6), bytes.number());
        matrix[(i, j)] = x;
        if !bytes.rarely(4) {
            matrix[(j, i)] = x;
        }
    }
    section
}

fn beam(bytes: &mut Bytes) {
    let count = 1 + bytes.below(6);
    let stations: Vec<SectionStation> = (0..count)
        .map(|k| SectionStation {
            fraction: match bytes.rarely(12) {
                true => bytes.number(),
                false => k as f64 / (count.max(2) - 1) as f64,
            },
            section: section(bytes),
            twist: if bytes.rarely(3) { bytes.number() } else { 0.0 },
        })
        .collect();
    let (start, along) = (
        Vector3::from(bytes.numbers()),
        Vector3::from(bytes.numbers()),
    );
    let axis = Vector3::from(bytes.axis());
    let (elements, degree) = (bytes.below(5), bytes.below(6));
    let mut model = Model::new();
    let nodes = bytes.below(2);
    for _ in 0..nodes {
        let ball = Matrix3::identity();
        model
            .add_rigid_body(1.0, &Vector3::zeros(), &ball)
            .expect("a body");
    }
    let end = start + along;
    let line = straight_line(&start, &end, &axis);
    let added = line.and_then(|line| model.add_beam_along(line, &stations, elements, degree));
    let Ok(beam) = added else {
        assert_eq!(model.node_count(), nodes, "a beam, or nothing");
        return;
    };
    assert!(beam.elements >= elements);
    assert_eq!(model.node_count(), nodes + beam.elements * degree + 1);
    let Ok((mass, moment)) = model.mass_and_moment() else {
        return;
    };
    assert!(mass.is_finite() && moment.iter().all(|x| x.is_finite()));
    let lines: Vec<f64> = stations.iter().map(|s| s.section.mass[(0, 0)]).collect();
    let length = along.norm();
    // The same in all directions.
    let is_mass = |station: &SectionStation| {
        let block = station.section.mass.fixed_view::<3, 3>(0, 0);
        is_plain(block[(0, 0)]) && (block - Matrix3::identity() * block[(0, 0)]).amax() == 0.0
    };
    // Nodes that are far away are rounded, and fractions beyond the beam cancel in the sum below.
    let is_line = start.amax() < 1e3 * length
        && (stations.iter()).all(|station| (0.0..=1.0).contains(&station.fraction));
    if !is_plain(length) || !is_line || !stations.iter().all(is_mass) {
        return;
    }
    // Linear between stations, as the first and the last beyond them.
    let mut expected = 0.0;
    let mut before = (0.0, lines[0]);
    for (station, line) in stations.iter().zip(&lines) {
        expected += (station.fraction - before.0) * 0.5 * (line + before.1);
        before = (station.fraction, *line);
    }
    expected = length * (expected + (1.0 - before.0) * before.1);
    let beam_mass = mass - nodes as f64;
    let most = 1e-9 * (expected.abs() + nodes as f64);
    assert!(
        (beam_mass - expected).abs() <= most,
        "a beam of {expected:e} has {beam_mass:e}"
    );
}
