//! Work on the faces of a model, shared out among the threads.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::edges::Polyline;
use crate::model::Model;

const PLANE: u8 = 1;

/// Calls `work` for the faces, those with the longest borders first, and returns its results in the faces' order; None
/// where it was stopped.
pub fn each_face<T: Send + Sync>(
    wanted: &mut [usize],
    model: &Model,
    lines: &[Option<Polyline>],
    work: impl Fn(usize) -> Option<T> + Sync,
    stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<(usize, T)>> {
    let corners = |i: usize| -> usize {
        let face = &model.faces[i];
        let border: usize = face
            .wires
            .iter()
            .flatten()
            .map(|used| lines[used.edge as usize].as_ref().map_or(0, |line| line.points.len()))
            .sum();
        let curved = face.record.as_ref().is_some_and(|r| r.kind > PLANE);
        border * if curved { 10 } else { 1 }
    };
    wanted.sort_by_cached_key(|&i| (std::cmp::Reverse(corners(i)), i));
    let results: Vec<OnceLock<T>> = (0..wanted.len()).map(|_| OnceLock::new()).collect();
    let next = AtomicUsize::new(0);
    let take = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= wanted.len() || stopped() {
                return;
            }
            let Some(result) = work(wanted[k]) else { return };
            let _ = results[k].set(result);
        }
    };
    if wanted.len() == 1 || rayon::current_num_threads() == 1 {
        take();
    } else {
        rayon::scope(|scope| (0..rayon::current_num_threads()).for_each(|_| scope.spawn(|_| take())));
    }
    let found: Option<Vec<T>> = results.into_iter().map(OnceLock::into_inner).collect();
    let mut found: Vec<(usize, T)> = wanted.iter().copied().zip(found?).collect();
    found.sort_by_key(|(i, _)| *i);
    Some(found)
}
