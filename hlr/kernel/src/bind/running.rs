//! Run Rust without the interpreter lock, on so many threads, and stop when Python has been interrupted.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// `work` is called on a pool of `threads` (0: all cores) and polls the function it is given; KeyboardInterrupt and other
/// signals' exceptions stop it within milliseconds.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: usize,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| PyRuntimeError::new_err(format!("cannot start threads: {e}")))?;
    py.detach(|| {
        std::thread::scope(|scope| {
            let (sender, receiver) = channel();
            let (stop_flag, pool) = (&stop, &pool);
            scope.spawn(move || {
                let stopped = || stop_flag.load(Ordering::Relaxed);
                let result = pool.install(|| work(&stopped));
                // The receiver waits until this arrives or the thread dies.
                let _ = sender.send(result);
            });
            let mut failure = None;
            loop {
                match receiver.recv_timeout(Duration::from_millis(20)) {
                    Ok(result) => return failure.map_or(Ok(result), Err),
                    Err(RecvTimeoutError::Timeout) => {
                        if failure.is_none()
                            && let Err(error) = Python::attach(|py| py.check_signals())
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
