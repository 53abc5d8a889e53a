//! Branches saved in files, loaded, and followed on.

mod common;

use common::models::oscillators::*;
use common::*;
use periodyn::error::ErrorKind;
use periodyn::solve::{
    Branch, BranchEnd, BranchOptions, Event, Free, StabilityOptions, continue_branch,
    follow_branch, follow_locus,
};
use std::f64::consts::TAU;
use std::path::PathBuf;

fn path(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("pdn_{name}_{}.pdb", std::process::id()))
}

fn response(to: f64) -> BranchOptions {
    BranchOptions {
        periodic: options(31),
        range: [0.5, to],
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    }
}

fn follow(options: &BranchOptions) -> Branch {
    let frequency = Free::Frequency;
    follow_branch(&duffing(), TAU / 0.9, frequency, options, &mut |_, _| true).unwrap()
}

/// Saved and loaded.
fn loaded(branch: &Branch, name: &str) -> Branch {
    let path = path(name);
    branch.save(&path).unwrap();
    let loaded = Branch::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    loaded
}

fn assert_same(a: &Branch, b: &Branch) {
    assert_eq!((a.end, a.points.len()), (b.end, b.points.len()));
    assert_eq!(a.report(), b.report());
    for (index, (p, q)) in a.points.iter().zip(&b.points).enumerate() {
        assert_eq!((&p.values, p.slope, p.event), (&q.values, q.slope, q.event));
        assert_eq!((&p.state, p.grid), (&q.state, q.grid));
        assert_eq!((&p.increments, p.stability), (&q.increments, q.stability));
        let [p, q] = [a, b].map(|branch| branch.solved(index).unwrap().1);
        assert_eq!((p.grid, p.state.motions), (q.grid, q.state.motions));
    }
}

#[test]
fn a_loaded_branch_is_what_it_was() {
    let branch = follow(&response(1.4));
    assert_same(&branch, &loaded(&branch, "branch"));
    // One without points, too.
    let mut hopeless = response(1.4);
    hopeless.periodic.newton.iteration_limit = 1;
    let none = follow(&hopeless);
    let again = loaded(&none, "no_points");
    assert_eq!((again.end, again.points.len()), (BranchEnd::NoStart, 0));
    assert_eq!(again.explanation, none.explanation);
    let end = continue_branch(&again, &response(1.4), &mut |_, _| true);
    assert_eq!(end.unwrap_err().kind(), ErrorKind::NotAvailable);
}

#[test]
fn a_loaded_branch_goes_on_through_the_folds() {
    // Cut off between the folds, where the frequency falls.
    let whole = follow(&response(1.6));
    let fold = whole.points.iter().position(|p| p.event.is_some()).unwrap();
    let part = BranchOptions {
        point_limit: fold + 4,
        ..response(1.6)
    };
    let part = loaded(&follow(&part), "part");
    assert_eq!(part.end, BranchEnd::PointLimit);
    let mut told = Vec::new();
    let more = continue_branch(&part, &response(1.6), &mut |number, point| {
        told.push((number, point.values[0]));
        true
    });
    let more = more.unwrap();
    assert_eq!(more.end, BranchEnd::Range, "{}", more.explanation);
    assert_eq!(told[0].0, fold + 5);
    assert!(told[0].1 < part.points.last().unwrap().values[0]);
    let folds = |branch: &Branch| -> Vec<f64> {
        let folds = branch
            .points
            .iter()
            .filter(|p| p.event == Some(Event::Fold));
        folds.map(|p| p.values[0]).collect()
    };
    let exact = [1.269_601_955_546, 1.115_700_251_771];
    assert_eq!(folds(&more).len(), 2);
    for (found, exact) in folds(&more).into_iter().zip(exact) {
        assert!((found - exact).abs() < 2e-12);
    }
    assert_eq!(more.points.last().unwrap().values[0], 1.6);

    // Where its range had ended, over a wider one; not beyond the same one.
    let short = follow(&response(1.0));
    assert_eq!(short.end, BranchEnd::Range);
    let same = continue_branch(&short, &response(1.0), &mut |_, _| true).unwrap();
    assert_eq!(
        (same.end, same.points.len()),
        (BranchEnd::Range, short.points.len())
    );
    let wider = continue_branch(&short, &response(1.2), &mut |_, _| true).unwrap();
    assert_eq!(wider.end, BranchEnd::Range);
    assert_eq!(wider.points.last().unwrap().values[0], 1.2);
    let narrow = BranchOptions {
        range: [0.5, 0.95],
        ..response(1.0)
    };
    let end = continue_branch(&short, &narrow, &mut |_, _| true);
    assert!(
        end.unwrap_err()
            .to_string()
            .contains("between 0.5 and 0.95")
    );
}

#[test]
fn a_locus_is_saved_but_not_continued() {
    let (model, load) = duffing_with_load();
    let frequency = Free::Frequency;
    let branch = follow_branch(&model, TAU / 0.9, frequency, &response(1.4), &mut |_, _| {
        true
    });
    let branch = loaded(&branch.unwrap(), "with_load");
    let fold = branch
        .points
        .iter()
        .position(|p| p.event.is_some())
        .unwrap();
    let range = BranchOptions {
        range: [0.1, 0.3],
        point_limit: 3,
        ..response(1.4)
    };
    let load = Free::Parameter(load);
    let locus = follow_locus(&branch, fold, load, &range, &mut |_, _| true).unwrap();
    let again = loaded(&locus, "locus");
    assert_same(&locus, &again);
    assert_eq!(again.locus, Some(Event::Fold));
    let end = continue_branch(&again, &range, &mut |_, _| true);
    assert_eq!(end.unwrap_err().kind(), ErrorKind::NotAvailable);
}

#[test]
fn damaged_files_are_refused() {
    let few = BranchOptions {
        point_limit: 2,
        ..response(1.4)
    };
    let path = path("damaged");
    follow(&few).save(&path).unwrap();
    let whole = std::fs::read(&path).unwrap();
    let refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let error = Branch::load(&path).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Format, "{error}");
        error.to_string()
    };
    for at in (0..whole.len()).step_by(37) {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x10;
        refused(&bytes);
    }
    for length in [0, 5, 20, 24, whole.len() / 2, whole.len() - 1] {
        refused(&whole[..length]);
    }
    let longer: Vec<u8> = whole.iter().copied().chain([0]).collect();
    assert!(refused(&longer).contains("goes on after its end"));
    // A model is no branch.
    duffing().save(&path).unwrap();
    let model = std::fs::read(&path).unwrap();
    assert!(refused(&model).contains("is not a saved branch"));
    std::fs::remove_file(&path).unwrap();
    let missing = Branch::load(&path).unwrap_err();
    assert_eq!(missing.kind(), ErrorKind::Io);
}
