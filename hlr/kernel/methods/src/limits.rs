//! Limits of work: stops it when the caller interrupts, the time is over, or too much memory is held.

use super::stopwatch::Stopwatch;
use crate::memory::held;
use std::cell::Cell;
use std::time::{Duration, Instant};

/// The most time and memory that a call may take.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub seconds: f64,
    /// Seconds are processor time of the thread, not elapsed time.
    pub worked: bool,
    /// Bytes that the thread may hold beyond those that it held at the beginning.
    pub bytes: f64,
}

impl Limits {
    pub const NONE: Limits = Limits { seconds: f64::INFINITY, worked: false, bytes: f64::INFINITY };
}

/// Why work was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    Stopped,
    Time,
    Memory,
}

/// A watch over one call: it starts when it is made, on the working thread.
pub struct Watch<'a> {
    stopped: &'a (dyn Fn() -> bool + Sync),
    limits: Limits,
    deadline: Cell<Option<Instant>>,
    stopwatch: Stopwatch,
    held: isize,
    countdown: Cell<u32>,
    why: Cell<Option<Why>>,
}

/// Polls between two looks at the clock: a poll costs a few instructions, the clock many.
const PATIENCE: u32 = 64;

fn later(seconds: f64) -> Option<Instant> {
    Duration::try_from_secs_f64(seconds).ok().and_then(|d| Instant::now().checked_add(d))
}

impl<'a> Watch<'a> {
    pub fn new(stopped: &'a (dyn Fn() -> bool + Sync), limits: Limits) -> Watch<'a> {
        Watch {
            stopped,
            limits,
            deadline: Cell::new(later(limits.seconds)),
            stopwatch: Stopwatch::start(),
            held: held(),
            countdown: Cell::new(0),
            why: Cell::new(None),
        }
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

    /// Whether this many more bytes are within the limit; if not, it is time to stop.
    pub fn has_room(&self, bytes: usize) -> bool {
        if (held() - self.held) as f64 + bytes as f64 > self.limits.bytes {
            self.give_up(Why::Memory);
        }
        self.why.get().is_none()
    }

    /// Why it was time to stop, if it was.
    pub fn why(&self) -> Option<Why> {
        self.why.get()
    }

    fn give_up(&self, why: Why) {
        if self.why.get().is_none() {
            self.why.set(Some(why));
        }
        self.countdown.set(0);
    }

    #[cold]
    fn look(&self) -> bool {
        if self.why.get().is_none() {
            if (self.stopped)() {
                self.give_up(Why::Stopped);
            } else if self.deadline.get().is_some_and(|d| Instant::now() >= d) && self.is_late() {
                self.give_up(Why::Time);
            } else if !self.has_room(0) {
                return true;
            } else {
                self.countdown.set(PATIENCE);
                return false;
            }
        }
        true
    }

    /// Called at the deadline: the thread may have waited for others and still have processor time left.
    fn is_late(&self) -> bool {
        let left = self.limits.seconds - self.stopwatch.seconds();
        if !self.limits.worked || left <= 0.0 {
            return true;
        }
        self.deadline.set(later(left));
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_ends_the_watch() {
        let never = || false;
        let watch = Watch::new(&never, Limits { bytes: 1e6, ..Limits::NONE });
        assert!(!watch.over() && watch.has_room(900_000) && !watch.has_room(2_000_000));
        assert!(watch.over() && watch.why() == Some(Why::Memory));
        let watch = Watch::new(&never, Limits { bytes: 1e6, ..Limits::NONE });
        let mut block = Vec::new();
        while !watch.over() {
            block.push([0u8; 1024]);
        }
        assert!(block.len() < 4096 && watch.why() == Some(Why::Memory));
    }

    #[test]
    fn time_that_passes_is_not_time_worked() {
        let never = || false;
        let both = [false, true].map(|worked| Watch::new(&never, Limits { seconds: 0.05, worked, bytes: 1e9 }));
        std::thread::sleep(Duration::from_millis(80));
        assert!(both[0].look());
        if std::fs::exists("/proc/thread-self/schedstat").unwrap_or(false) {
            assert!(!both[1].look());
        }
    }
}
