//! Keeps the threads of a pool on cores of their own, while the machine has nothing else to do.
//!
//! Linux wakes a thread on the core where it ran last, unless it finds an idle one at once. On a machine of two cores it
//! does not look for one after a single thread has been busy for a while, as a script is before its drawing. Then all
//! threads of the pool share one core while the other is idle, and calls of milliseconds end before the system moves
//! them: drawings of small parts took up to a third longer. Where other programs run as well, the system knows better.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::ThreadPool;

/// With more cores there are idle ones that the system finds.
const FEW_CORES: usize = 4;

/// After so long the threads of a pool that has no work are asleep: what runs then are others.
const SETTLED: Duration = Duration::from_micros(200);

/// Binds the threads of one pool to cores, and frees them.
pub struct Spread {
    /// The core of each thread; empty where all is left to the system.
    cores: Vec<usize>,
    state: Mutex<State>,
}

struct State {
    /// Whether each thread is bound to its core.
    bound: bool,
    /// When the last work of the pool ended.
    ended: Instant,
}

impl Spread {
    /// For a pool of all cores, if they are few.
    pub fn of(pool: &ThreadPool) -> Spread {
        let cores = system::cores();
        let all = (2..=FEW_CORES).contains(&cores.len()) && cores.len() == pool.current_num_threads();
        let state = Mutex::new(State { bound: false, ended: Instant::now() });
        Spread { cores: if all { cores } else { Vec::new() }, state }
    }

    /// Before work of the pool: binds its threads if nothing else runs on the machine, else frees them.
    pub fn before_work(&self, pool: &ThreadPool) {
        if self.cores.is_empty() {
            return;
        }
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if state.ended.elapsed() < SETTLED {
            return;
        }
        let idle = system::running() == Some(1);
        if state.bound != idle {
            state.bound = idle;
            let cores = self.cores.clone();
            pool.spawn_broadcast(move |thread| {
                system::stay_on(if idle { &cores[thread.index()..=thread.index()] } else { &cores });
            });
        }
    }

    /// After work of the pool.
    pub fn after_work(&self) {
        if !self.cores.is_empty() {
            self.state.lock().unwrap_or_else(PoisonError::into_inner).ended = Instant::now();
        }
    }
}

#[cfg(target_os = "linux")]
mod system {
    use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

    /// The cores that this process may use.
    pub fn cores() -> Vec<usize> {
        sched_getaffinity(None)
            .map_or_else(|_| Vec::new(), |set| (0..CpuSet::MAX_CPU).filter(|&core| set.is_set(core)).collect())
    }

    /// How many threads of the machine run or wait for a core; the one that asks is among them.
    pub fn running() -> Option<usize> {
        let all = std::fs::read_to_string("/proc/loadavg").ok()?;
        all.split(' ').nth(3)?.split('/').next()?.parse().ok()
    }

    /// The calling thread runs on these cores alone. Where that is refused, the system chooses.
    pub fn stay_on(cores: &[usize]) {
        let mut set = CpuSet::new();
        cores.iter().for_each(|&core| set.set(core));
        let _ = sched_setaffinity(None, &set);
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    pub fn cores() -> Vec<usize> {
        Vec::new()
    }

    pub fn running() -> Option<usize> {
        None
    }

    pub fn stay_on(_cores: &[usize]) {}
}
