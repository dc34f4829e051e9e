//! Runs Rust code without the interpreter lock on a limited number of threads, and stops it on Ctrl-C.
//!
//! Starting threads takes 0.2 milliseconds, more than many calls on small models take. So thread pools are kept, and
//! work of about a millisecond runs on the calling thread.

use std::cell::{Cell, OnceCell};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::spread::Spread;

/// Number of items (triangles, points) up to which a call takes about a millisecond at most.
pub const FEW: usize = 1000;

/// Triangles or points that count as one item of `run`: each takes a tenth of a microsecond. For fewer items starting
/// other threads costs more than the work.
pub const CHEAP: usize = 8;

/// So many triangles are released as quickly as one face of a B-rep.
pub const AT_ONCE: usize = 16;

/// Pools by number of threads, and the process that they belong to: a fork has none of its parent's threads.
static POOLS: Mutex<(u32, BTreeMap<usize, Arc<Pool>>)> = Mutex::new((0, BTreeMap::new()));

struct Pool {
    threads: ThreadPool,
    spread: Spread,
}

thread_local! {
    /// The calling thread itself as a pool.
    static HERE: OnceCell<ThreadPool> = const { OnceCell::new() };
    /// Threads for calls of this thread; 0: all cores.
    static LIMIT: Cell<usize> = const { Cell::new(0) };
}

/// Sets how many threads the calls of this thread use; 0: all cores. Returns the number that it was before.
#[pyfunction]
pub fn limit_threads(threads: usize) -> usize {
    LIMIT.replace(threads)
}

/// Calls `work` on as many threads as `limit_threads` says. `work` polls the function it is given: KeyboardInterrupt and
/// other exceptions of signal handlers stop it within milliseconds. Work on a `size` of FEW items at most runs on the
/// calling thread, and signals are checked afterwards.
pub fn run<T: Send>(
    py: Python<'_>,
    size: usize,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    run_telling(py, size, |_| Ok(()), work)
}

/// The same on one thread, for work whose memory is counted: that is done thread by thread.
pub fn run_on_one<T: Send>(py: Python<'_>, work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send) -> PyResult<T> {
    struct Before(usize);
    impl Drop for Before {
        fn drop(&mut self) {
            LIMIT.set(self.0);
        }
    }
    let _before = Before(LIMIT.replace(1));
    run(py, usize::MAX, work)
}

/// As `run`; while waiting it calls `tell` every few milliseconds, and stops the work where that fails.
pub fn run_telling<T: Send>(
    py: Python<'_>,
    size: usize,
    tell: impl Fn(Python<'_>) -> PyResult<()> + Send + Sync,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    if size > FEW {
        let pool = pool(LIMIT.get()).map_err(not_started)?;
        pool.spread.before_work(&pool.threads);
        let result = waited(py, &pool.threads, tell, work);
        pool.spread.after_work();
        return result;
    }
    let result = py.detach(|| {
        HERE.with(|here| {
            let pool = match here.get() {
                Some(pool) => pool,
                None => {
                    let own = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
                    here.get_or_init(|| own.expect("the calling thread belongs to no other pool"))
                }
            };
            pool.install(|| work(&|| false))
        })
    });
    py.check_signals()?;
    Ok(result)
}

/// What short work on many items gives, on all threads; the interpreter waits.
pub fn together<T: Send>(work: impl FnOnce() -> T + Send) -> PyResult<T> {
    Ok(pool(LIMIT.get()).map_err(not_started)?.threads.install(work))
}

/// Releases a value of `size` items on another thread: that of thousands of faces takes as long as some steps of a
/// drawing.
pub fn release_later<T: Send + 'static>(value: T, size: usize) {
    if size > FEW
        && let Ok(pool) = pool(LIMIT.get())
    {
        pool.threads.spawn(move || drop(value));
    }
}

fn not_started(error: rayon::ThreadPoolBuildError) -> PyErr {
    PyRuntimeError::new_err(format!("cannot start threads: {error}"))
}

fn pool(threads: usize) -> Result<Arc<Pool>, rayon::ThreadPoolBuildError> {
    let mut kept = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if kept.0 != process {
        // The threads of the parent's pools do not exist in a fork and cannot be waited for.
        std::mem::forget(std::mem::take(&mut kept.1));
        kept.0 = process;
    }
    if let Some(pool) = kept.1.get(&threads) {
        return Ok(pool.clone());
    }
    let made = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let made = Arc::new(Pool { spread: Spread::of(&made), threads: made });
    kept.1.insert(threads, made.clone());
    Ok(made)
}

fn waited<T: Send>(
    py: Python<'_>,
    pool: &ThreadPool,
    tell: impl Fn(Python<'_>) -> PyResult<()> + Send + Sync,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    py.detach(|| {
        let (sender, receiver) = channel();
        pool.in_place_scope(|scope| {
            let stop_flag = &stop;
            scope.spawn(move |_| {
                let stopped = || stop_flag.load(Ordering::Relaxed);
                // The receiver waits until this arrives or the work has failed.
                let _ = sender.send(work(&stopped));
            });
            let mut failure = None;
            loop {
                match receiver.recv_timeout(Duration::from_millis(20)) {
                    Ok(result) => return failure.map_or(Ok(result), Err),
                    Err(RecvTimeoutError::Timeout) => {
                        if failure.is_none()
                            && let Err(error) = Python::attach(|py| py.check_signals().and_then(|()| tell(py)))
                        {
                            stop.store(true, Ordering::Relaxed);
                            failure = Some(error);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("the kernel stopped unexpectedly"));
                    }
                }
            }
        })
    })
}
