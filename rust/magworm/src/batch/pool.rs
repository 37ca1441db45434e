//! A thread pool that survives `fork`.

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Threads of one batch. A forked child inherits the object but not the threads, and joining threads
/// that do not exist hangs; so the pool remembers its process and an inherited one is left alone.
#[derive(Debug)]
pub struct Pool {
    threads: usize,
    owner: u32,
    pool: Option<ThreadPool>,
}

impl Pool {
    /// A pool of `threads` threads (none: one per core), started when it is first needed; one thread
    /// needs none.
    pub fn new(threads: Option<usize>) -> Self {
        let cores = || std::thread::available_parallelism().map_or(1, |n| n.get());
        let threads = threads.unwrap_or_else(cores).max(1);
        Self { threads, owner: std::process::id(), pool: None }
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// The threads of this process; none where one thread does it all, or no thread can be started.
    pub fn get(&mut self) -> Option<&ThreadPool> {
        if self.threads == 1 {
            return None;
        }
        if self.owner != std::process::id() {
            self.abandon();
            self.owner = std::process::id();
        }
        if self.pool.is_none() {
            self.pool = ThreadPoolBuilder::new().num_threads(self.threads).build().ok();
        }
        self.pool.as_ref()
    }

    fn abandon(&mut self) {
        if let Some(inherited) = self.pool.take() {
            std::mem::forget(inherited);
        }
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        if self.owner != std::process::id() {
            self.abandon();
        }
    }
}
