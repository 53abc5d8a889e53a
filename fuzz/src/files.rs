//! Files that are damaged or forged: refused in their status, or of what can be asked and saved.

use super::bytes::Bytes;
use periodyn::error::ErrorKind;
use periodyn::model::Model;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::Branch;
use std::fs;
use std::path::Path;

const HEADER: usize = 24;

/// The bytes as they are, and as what is behind the header of `original`, with a length and a
/// checksum that fit.
fn forged(original: &[u8], body: &[u8]) -> Vec<u8> {
    let mut file = original[..HEADER.min(original.len())].to_vec();
    if file.len() < HEADER {
        return body.to_vec();
    }
    file[16..].copy_from_slice(&(body.len() as u64).to_le_bytes());
    let covered = [&file[8..12], &file[16..], body].concat();
    file[12..16].copy_from_slice(&crc32fast::hash(&covered).to_le_bytes());
    [&file, body].concat()
}

/// Changes `original` as the bytes say, and loads what has become of it, at `path`.
pub fn run(original: &[u8], bytes: &[u8], path: &Path) {
    let mut bytes = Bytes(bytes);
    let is_checked = !bytes.rarely(8);
    let from = if is_checked {
        HEADER.min(original.len())
    } else {
        0
    };
    let mut body = original[from..].to_vec();
    let number = |bytes: &mut Bytes| -> usize {
        (0..3).fold(0, |sum, _| sum << 8 | usize::from(bytes.byte()))
    };
    for _ in 0..=bytes.below(8) {
        let at = number(&mut bytes) % body.len().max(1);
        match bytes.below(8) {
            0..=2 if at < body.len() => body[at] = bytes.byte(),
            3..=4 if at < body.len() => body[at] ^= 1 << bytes.below(8),
            5 => body.truncate(at),
            6 if at < body.len() => {
                let count = bytes.below(64).min(body.len() - at);
                let copied = body[at..at + count].to_vec();
                body.splice(at..at, copied);
            }
            7 if at < body.len() => {
                let count = bytes.below(64).min(body.len() - at);
                body.drain(at..at + count);
            }
            _ => {}
        }
    }
    let file = if is_checked {
        forged(original, &body)
    } else {
        body
    };
    if fs::write(path, file).is_err() {
        return;
    }
    let is_plain = |kind| {
        matches!(
            kind,
            ErrorKind::Format | ErrorKind::OutOfMemory | ErrorKind::Io
        )
    };
    match Solution::load(path) {
        Ok(solution) => ask(&solution, path),
        Err(error) => assert!(is_plain(error.kind()), "{error}"),
    }
    match Model::load(path) {
        Ok(model) => again(&model, path),
        Err(error) => assert!(is_plain(error.kind()), "{error}"),
    }
    if let Err(error) = Branch::load(path) {
        assert!(is_plain(error.kind()), "{error}");
    }
}

/// What was loaded can be asked, in numbers, and saved and loaded again.
fn ask(solution: &Solution, path: &Path) {
    let _ = solution.report();
    for node in 0..solution.model().node_count().min(3) {
        if let Ok(values) = solution.node(node, NodeQuantity::Velocity, &[0.1]) {
            assert!(values.iter().all(|x| x.is_finite()), "{values:?}");
        }
    }
    solution.save(path).expect("what was loaded is saved");
    Solution::load(path).expect("what was saved is loaded");
    again(solution.model(), path);
}

fn again(model: &Model, path: &Path) {
    let _ = model.mass_and_moment();
    model.save(path).expect("what was loaded is saved");
    Model::load(path).expect("what was saved is loaded");
}
