//! The steps of the work on one face: counted, so that it can be stopped amid them, and told how far it is.
//!
//! A stop unwinds the stack to `Steps::watched`, out of whatever loop or library is at work.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What one face adds to the work that is told.
pub const OF_A_FACE: usize = 1000;
/// Steps between two questions: a step takes less than 10 microseconds.
const OFTEN: u32 = 1 << 12;

pub struct Steps<'a> {
    stopped: &'a (dyn Fn() -> bool + Sync),
    told: Option<Told<'a>>,
    count: Cell<u32>,
}

/// How far the work is: on all faces, and on this one.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    pub all: &'a AtomicUsize,
    pub face: &'a AtomicUsize,
}

struct Stopped;

impl<'a> Steps<'a> {
    pub fn new(stopped: &'a (dyn Fn() -> bool + Sync), told: Option<Told<'a>>) -> Steps<'a> {
        Steps { stopped, told, count: Cell::new(0) }
    }

    /// Nobody stops it.
    pub fn free() -> Steps<'static> {
        Steps::new(&|| false, None)
    }

    /// What `work` finds; None where it was stopped.
    pub fn watched<T>(&self, work: impl FnOnce() -> T) -> Option<T> {
        match catch_unwind(AssertUnwindSafe(work)) {
            Ok(found) => Some(found),
            Err(reason) if reason.is::<Stopped>() => None,
            Err(reason) => resume_unwind(reason),
        }
    }

    /// One step more; only within `watched`.
    pub fn step(&self) {
        let count = self.count.get().wrapping_add(1);
        self.count.set(count);
        if count.is_multiple_of(OFTEN) && (self.stopped)() {
            // No panic: nothing is wrong, and no hook is called.
            resume_unwind(Box::new(Stopped));
        }
    }

    /// So much of the work on the face is done, of 1. What was told before is not taken back.
    pub fn reached(&self, share: f64) {
        let Some(Told { all, face }) = self.told else { return };
        let now = (share * OF_A_FACE as f64) as usize;
        let before = face.fetch_max(now, Ordering::Relaxed);
        all.fetch_add(now.saturating_sub(before), Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_ends_the_work_from_within() {
        let (all, face) = (AtomicUsize::new(7), AtomicUsize::new(0));
        let steps = Steps::new(&|| true, Some(Told { all: &all, face: &face }));
        let endless = steps.watched(|| {
            steps.reached(0.25);
            steps.reached(0.2);
            loop {
                steps.step();
            }
        });
        assert_eq!((endless, all.load(Ordering::Relaxed)), (None::<()>, 7 + OF_A_FACE / 4));
        assert_eq!(Steps::free().watched(|| 3), Some(3));
    }
}
