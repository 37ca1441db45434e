//! Long calls that whoever made them may stop.

use rayon::ThreadPool;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

/// How often the caller is asked.
const EVERY: Duration = Duration::from_millis(10);

/// The call was stopped; what it works on is as before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the call was stopped")]
pub struct Interrupted;

/// Asks the thread that made a call, and no other, whether to stop: only there signals are learnt of. Work looks
/// here between pieces of some milliseconds.
pub struct Interruption<'a> {
    stop: AtomicBool,
    caller: ThreadId,
    asking: Option<Mutex<Asking<'a>>>,
}

struct Asking<'a> {
    last: Instant,
    ask: &'a mut (dyn FnMut() -> bool + Send),
}

impl<'a> Interruption<'a> {
    /// Of a call from this thread. `ask` says whether to stop.
    pub fn new(ask: &'a mut (dyn FnMut() -> bool + Send)) -> Self {
        let asking = Mutex::new(Asking { last: Instant::now(), ask });
        Self { asking: Some(asking), ..Self::never() }
    }

    /// A call that nothing stops.
    pub fn never() -> Self {
        Self { stop: AtomicBool::new(false), caller: thread::current().id(), asking: None }
    }

    /// Whether the call can be stopped at all.
    pub fn is_possible(&self) -> bool {
        self.asking.is_some()
    }

    /// Whether to stop. The caller is asked where this is its thread and it is time to.
    pub fn stops(&self) -> bool {
        self.asked_after(EVERY)
    }

    /// Asks a last time, in the caller's thread, before what was done is kept.
    ///
    /// # Errors
    /// The call was stopped.
    pub fn last_asked(&self) -> Result<(), Interrupted> {
        if self.asked_after(Duration::ZERO) { Err(Interrupted) } else { Ok(()) }
    }

    fn asked_after(&self, wait: Duration) -> bool {
        if let Some(asking) = self.asking.as_ref().filter(|_| thread::current().id() == self.caller)
        {
            let mut asking = asking.lock().unwrap_or_else(PoisonError::into_inner);
            if asking.last.elapsed() >= wait {
                self.stop.fetch_or((asking.ask)(), Relaxed);
                asking.last = Instant::now();
            }
        }
        self.stop.load(Relaxed)
    }

    /// Does the work on the threads of a pool, while the caller is asked here; on this thread where there is none.
    pub(crate) fn run(&self, pool: Option<&ThreadPool>, work: impl FnOnce() + Send) {
        match pool {
            None => work(),
            Some(pool) if !self.is_possible() => pool.install(work),
            Some(pool) => self.watch(pool, work),
        }
    }

    fn watch(&self, pool: &ThreadPool, work: impl FnOnce() + Send) {
        let (working, ended) = channel::<()>();
        pool.in_place_scope(|scope| {
            scope.spawn(|_| {
                work();
                drop(working);
            });
            while ended.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                self.stops();
            }
        });
    }
}
