//! Long work beside the interpreter: other Python threads run on, Ctrl-C ends it, a callback reports progress.
//!
//! The work has a thread of its own, and the caller's waits for it without the interpreter's lock. It wakes
//! [`OFTEN`] to let Python handle signals, so an interrupt does not wait for the work to notice.
//!
//! Parallel work has threads of this process. A process that was forked, as `multiprocessing` does, has none of those of its
//! parent, and would wait for them for ever: it gets its own.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// How often signals are looked for.
const OFTEN: Duration = Duration::from_millis(20);

/// What the work says and hears.
#[derive(Default)]
pub struct Watch {
    stopped: AtomicBool,
    until: OnceLock<Instant>,
    done: AtomicUsize,
    most: AtomicUsize,
    stage: Mutex<Cow<'static, str>>,
}

impl Watch {
    /// Ends the work after a time from now, whatever it does.
    pub fn end_after(&self, time: Duration) {
        if let Some(until) = Instant::now().checked_add(time) {
            let _ = self.until.set(until);
        }
    }

    /// Says how far the work is; breaks if it shall end.
    pub fn tell(
        &self,
        done: usize,
        most: usize,
        stage: impl Into<Cow<'static, str>>,
    ) -> ControlFlow<()> {
        self.done.store(done, Ordering::Relaxed);
        self.most.store(most, Ordering::Relaxed);
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) = stage.into();
        self.flow()
    }

    /// Counts some more of `most`; breaks if the work shall end.
    pub fn count(&self, more: usize, most: usize, stage: &'static str) -> ControlFlow<()> {
        self.done.fetch_add(more, Ordering::Relaxed);
        self.most.store(most, Ordering::Relaxed);
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) = stage.into();
        self.flow()
    }

    /// Breaks if the work shall end.
    pub fn flow(&self) -> ControlFlow<()> {
        let late = self.until.get().is_some_and(|until| Instant::now() >= *until);
        match late || self.stopped.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// Whether the work shall end, as it is asked often.
    pub fn stop(&self) -> impl Fn() -> bool + Sync {
        || self.flow().is_break()
    }

    fn state(&self) -> (usize, usize, Cow<'static, str>) {
        let stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner).clone();
        (self.done.load(Ordering::Relaxed), self.most.load(Ordering::Relaxed), stage)
    }
}

/// The threads for parallel work, and the process that they belong to.
static THREADS: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of this process for parallel work; `None` if the system gives no more.
fn threads() -> Option<Arc<ThreadPool>> {
    let mut known = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((owner, threads)) = &*known
        && *owner == process
    {
        return Some(Arc::clone(threads));
    }
    let made = Arc::new(ThreadPoolBuilder::new().build().ok()?);
    // those of the parent are not here to be ended
    std::mem::forget(known.replace((process, Arc::clone(&made))));
    Some(made)
}

/// Does work that may be parallel with the threads of this process, without the interpreter's lock.
pub fn parallel<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
    py.detach(|| match threads() {
        Some(threads) => threads.install(work),
        None => work(),
    })
}

/// Does the work and returns what it found; `progress(done, most, stage)` is called when that has changed.
///
/// # Errors
/// What a signal handler or `progress` raises, at once; the work is asked to end and left to do so by itself.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (send, receive) = sync_channel(1);
    let watched = Arc::clone(&watch);
    std::thread::Builder::new()
        .name("plydrape".into())
        .spawn(move || {
            // nobody listens any more where the caller was interrupted
            let _ = send.send(match threads() {
                Some(threads) => threads.install(|| work(&watched)),
                None => work(&watched),
            });
        })
        .map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;

    let mut told = (0, 0, Cow::Borrowed(""));
    let receive = Mutex::new(receive);
    loop {
        let found = py
            .detach(|| receive.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(OFTEN));
        let state = watch.state();
        let call = progress.filter(|_| state != told && state.1 > 0);
        told = state.clone();
        let heard =
            py.check_signals().and_then(|()| call.map_or(Ok(()), |f| f.call1(state).map(drop)));
        if let Err(error) = heard {
            watch.stopped.store(true, Ordering::Relaxed);
            return Err(error);
        }
        match found {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "plydrape has failed in a way that it should not: please report the scene",
                ));
            }
        }
    }
}
