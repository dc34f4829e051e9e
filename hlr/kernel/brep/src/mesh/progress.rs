//! Progress of the work on one face: the caller can read how far it is, and can stop it at any step.
//!
//! A stop unwinds the stack to `Progress::watched`, out of any loop or library.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Units of progress that one face counts for.
pub const OF_A_FACE: usize = 1000;
/// Steps between two checks for a stop. A step takes less than 10 microseconds.
const OFTEN: u32 = 1 << 12;

pub struct Progress<'a> {
    stopped: &'a (dyn Fn() -> bool + Sync),
    told: Option<Done<'a>>,
    count: Cell<u32>,
}

/// Units of progress done so far: on all faces, and on this face.
#[derive(Clone, Copy)]
pub struct Done<'a> {
    pub all: &'a AtomicUsize,
    pub face: &'a AtomicUsize,
}

struct Stopped;

impl<'a> Progress<'a> {
    pub fn new(stopped: &'a (dyn Fn() -> bool + Sync), told: Option<Done<'a>>) -> Progress<'a> {
        Progress { stopped, told, count: Cell::new(0) }
    }

    /// Progress that is never stopped.
    pub fn free() -> Progress<'static> {
        Progress::new(&|| false, None)
    }

    /// The result of `work`; None if it was stopped.
    pub fn watched<T>(&self, work: impl FnOnce() -> T) -> Option<T> {
        match catch_unwind(AssertUnwindSafe(work)) {
            Ok(found) => Some(found),
            Err(reason) if reason.is::<Stopped>() => None,
            Err(reason) => resume_unwind(reason),
        }
    }

    /// Counts one step; call it only within `watched`.
    pub fn step(&self) {
        let count = self.count.get().wrapping_add(1);
        self.count.set(count);
        if count.is_multiple_of(OFTEN) && (self.stopped)() {
            // Unwinds without a panic hook: a stop is no error.
            resume_unwind(Box::new(Stopped));
        }
    }

    /// Reports the share (0 to 1) of the work on the face that is done. A smaller share than before changes nothing.
    pub fn reached(&self, share: f64) {
        let Some(Done { all, face }) = self.told else { return };
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
        let steps = Progress::new(&|| true, Some(Done { all: &all, face: &face }));
        let endless = steps.watched(|| {
            steps.reached(0.25);
            steps.reached(0.2);
            loop {
                steps.step();
            }
        });
        assert_eq!((endless, all.load(Ordering::Relaxed)), (None::<()>, 7 + OF_A_FACE / 4));
        assert_eq!(Progress::free().watched(|| 3), Some(3));
    }
}
