//! When to give up: the caller interrupts, or the time is over.

use std::cell::Cell;
use std::time::Instant;

pub struct Watch<'a> {
    stopped: &'a (dyn Fn() -> bool + Sync),
    deadline: Option<Instant>,
    countdown: Cell<u32>,
    over: Cell<bool>,
}

/// Looks at the clock are this many polls apart: a poll costs a few instructions, the clock many.
const PATIENCE: u32 = 64;

impl<'a> Watch<'a> {
    pub fn new(stopped: &'a (dyn Fn() -> bool + Sync), deadline: Option<Instant>) -> Watch<'a> {
        Watch { stopped, deadline, countdown: Cell::new(0), over: Cell::new(false) }
    }

    /// Poll: true once it is time to stop, and from then on.
    #[inline(always)]
    pub fn over(&self) -> bool {
        let left = self.countdown.get();
        if left > 0 {
            self.countdown.set(left - 1);
            return false;
        }
        self.look()
    }

    #[cold]
    fn look(&self) -> bool {
        if self.over.get() || (self.stopped)() || self.deadline.is_some_and(|d| Instant::now() >= d) {
            self.over.set(true);
            return true;
        }
        self.countdown.set(PATIENCE);
        false
    }
}
