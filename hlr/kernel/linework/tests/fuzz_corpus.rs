//! Runs the fuzz targets' checks on their saved inputs and on some random ones, without libFuzzer, on any toolchain.

#[path = "../../fuzz/src/lib.rs"]
mod fuzz;

use std::fs;
use std::path::Path;

/// Number of random inputs. A source distribution comes without the saved inputs and has only these.
const RANDOM: usize = 300;

fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let mut paths: Vec<_> = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let data = fs::read(&path).expect("a readable file");
        let outcome = std::panic::catch_unwind(|| run(&data));
        assert!(outcome.is_ok(), "{}", path.display());
    }
    let mut state = 1u64;
    for length in 0..RANDOM {
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 56) as u8
        };
        let data: Vec<u8> = (0..length).map(|_| next()).collect();
        run(&data);
    }
}

#[test]
fn visibility() {
    replay("visibility", fuzz::visibility::run);
}

#[test]
fn clash() {
    replay("clash", fuzz::clash::run);
}

#[test]
fn linework() {
    replay("linework", fuzz::linework::run);
}

#[test]
fn meshfile() {
    replay("meshfile", fuzz::meshfile::run);
}

#[test]
fn topology() {
    replay("topology", fuzz::topology::run);
}

#[test]
fn brep() {
    replay("brep", fuzz::brep::run);
}

#[test]
fn brepfile() {
    replay("brepfile", fuzz::brepfile::run);
}

/// The comparison fails where it must: an answer is compared with the same scene seen from behind.
#[test]
fn a_wrong_answer_would_be_noticed() {
    use fuzz::oracle::{HIDDEN, VISIBLE, shadow, states};
    let triangle = [[0, 0, 0], [8, 0, 0], [0, 8, 0]];
    let state = |a, b, delta| {
        let plain = Vec::from_iter(shadow(a, b, triangle, 0));
        states(&plain, &Vec::from_iter(shadow(a, b, triangle, delta))).iter().map(|i| i.2).collect::<Vec<_>>()
    };
    assert_eq!(state([1, 1, 3], [2, 1, 3], 0), [HIDDEN]);
    assert_eq!(state([1, 1, -3], [2, 1, -3], 0), [VISIBLE]);
    assert_eq!(state([1, 1, 3], [20, 1, 3], 0), [HIDDEN, VISIBLE]);
    assert_eq!(state([1, 1, 3], [2, 1, 3], 3), [fuzz::oracle::WITHIN]);
    assert_eq!(state([1, 1, 0], [2, 1, 0], 0), [VISIBLE]);
}
