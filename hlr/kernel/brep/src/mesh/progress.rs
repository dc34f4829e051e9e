//! Progress of the work on one face: the caller can read how far it is, can stop it at any step, and bounds its steps.
//!
//! A stop unwinds the stack to `Progress::watched`, out of any loop or library. So does a step too many: steps are
//! counted, as time would differ from machine to machine.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Units of progress that one face counts for.
pub const OF_A_FACE: usize = 1000;
/// Steps between two checks for a stop. A step takes less than 10 microseconds.
const OFTEN: u64 = 1 << 12;

pub struct Progress<'a> {
    stopped: &'a (dyn Fn() -> bool + Sync),
    told: Option<Done<'a>>,
    count: Cell<u64>,
    most: u64,
}

/// Why work ended before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupted {
    /// The caller stopped it.
    Stopped,
    /// It took more steps than it may take.
    TooMuch,
}

/// Units of progress done so far: on all faces, and on this face.
#[derive(Clone, Copy)]
pub struct Done<'a> {
    pub all: &'a AtomicUsize,
    pub face: &'a AtomicUsize,
}

impl<'a> Progress<'a> {
    /// `most`: the number of steps that the work may take.
    pub fn new(stopped: &'a (dyn Fn() -> bool + Sync), told: Option<Done<'a>>, most: u64) -> Progress<'a> {
        Progress { stopped, told, count: Cell::new(0), most }
    }

    /// Progress of work that may take so many steps, but has to end with what it has as soon as it can.
    pub fn half_spent(stopped: &'a (dyn Fn() -> bool + Sync), told: Option<Done<'a>>, most: u64) -> Progress<'a> {
        Progress { count: Cell::new(most + 1), ..Progress::new(stopped, told, 2 * most) }
    }

    /// Progress that is never stopped.
    pub fn free() -> Progress<'static> {
        Progress::new(&|| false, None, u64::MAX)
    }

    /// The result of `work`, unless it was interrupted.
    pub fn watched<T>(&self, work: impl FnOnce() -> T) -> Result<T, Interrupted> {
        catch_unwind(AssertUnwindSafe(work)).map_err(|reason| match reason.downcast_ref::<Interrupted>() {
            Some(&why) => why,
            None => resume_unwind(reason),
        })
    }

    /// The number of steps so far.
    pub fn count(&self) -> u64 {
        self.count.get()
    }

    /// Whether half of the steps that the work may take are taken. Work that can end with what it has ends then: the
    /// other half is for what has to come after it.
    pub fn is_half_spent(&self) -> bool {
        self.count.get() > self.most / 2
    }

    /// Counts one step; call it only within `watched`.
    pub fn step(&self) {
        self.steps(1);
    }

    /// Counts several steps.
    pub fn steps(&self, more: u64) {
        let before = self.count.get();
        let count = before + more;
        self.count.set(count);
        if count / OFTEN > before / OFTEN {
            // Unwinds without a panic hook: neither is an error.
            if count > self.most {
                resume_unwind(Box::new(Interrupted::TooMuch));
            }
            if (self.stopped)() {
                resume_unwind(Box::new(Interrupted::Stopped));
            }
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
        let steps = Progress::new(&|| true, Some(Done { all: &all, face: &face }), u64::MAX);
        let endless = steps.watched(|| {
            steps.reached(0.25);
            steps.reached(0.2);
            loop {
                steps.step();
            }
        });
        assert_eq!((endless, all.load(Ordering::Relaxed)), (Err::<(), _>(Interrupted::Stopped), 7 + OF_A_FACE / 4));
        assert_eq!(Progress::free().watched(|| 3), Ok(3));
    }

    #[test]
    fn a_step_too_many_ends_the_work_from_within() {
        for (each, most) in [(1, 100_000), (7, 100_000), (1_000_000, 100_000), (1, 0)] {
            let steps = Progress::new(&|| false, None, most);
            let endless = || loop {
                steps.steps(each);
            };
            assert_eq!(steps.watched::<()>(endless), Err(Interrupted::TooMuch));
            assert!(steps.count() > most && steps.count() <= most + OFTEN.max(each));
            assert_eq!(steps.watched(|| 3), Ok(3));
        }
    }
}
