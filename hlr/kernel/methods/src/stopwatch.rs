//! Measures the processor time of this thread, so that a method's cost does not depend on other load.
//!
//! Linux reports it in nanoseconds; elsewhere elapsed time is used.

use std::time::Instant;

pub struct Stopwatch {
    started: Instant,
    worked: Option<u64>,
}

impl Stopwatch {
    pub fn start() -> Stopwatch {
        Stopwatch { started: Instant::now(), worked: worked() }
    }

    pub fn seconds(&self) -> f64 {
        match (self.worked, worked()) {
            (Some(before), Some(now)) => now.saturating_sub(before) as f64 * 1e-9,
            _ => self.started.elapsed().as_secs_f64(),
        }
    }
}

/// Processor time in nanoseconds: the first number of the scheduler's statistics. A call to yield makes the scheduler
/// update them.
fn worked() -> Option<u64> {
    std::thread::yield_now();
    std::fs::read_to_string("/proc/thread-self/schedstat").ok()?.split(' ').next()?.parse().ok()
}
