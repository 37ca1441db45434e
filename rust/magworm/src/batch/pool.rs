//! A thread pool that survives `fork`.

use crate::interruption::{Interrupted, Interruption};
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuilder};
use std::io;
use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

/// Rows that are written between two looks at an interruption.
const ROWS: usize = 64;

/// Threads of one batch. A forked child inherits the object but not the threads, and joining threads
/// that do not exist hangs; so the pool remembers its process and an inherited one is left alone.
#[derive(Debug)]
pub struct Pool {
    threads: usize,
    running: Mutex<Running>,
}

/// The threads, once they are needed, and the process that has them.
#[derive(Debug)]
struct Running {
    owner: u32,
    threads: Option<Threads>,
}

/// Threads that run. The last owner to let go of them waits for their end: a thread that has not ended keeps its
/// memory, and the next batch's threads would ask for theirs beside it.
#[derive(Clone, Debug)]
pub struct Threads(Arc<Started>);

/// Fields are dropped in their order: threads are told to end, then waited for.
#[derive(Debug)]
struct Started {
    pool: ThreadPool,
    _ends: Ends,
}

#[derive(Debug, Default)]
struct Ends(Vec<JoinHandle<()>>);

impl Pool {
    /// A pool of `threads` threads (none: one per core), started when it is first needed; one thread
    /// needs none.
    pub fn new(threads: Option<usize>) -> Self {
        let cores = || std::thread::available_parallelism().map_or(1, |n| n.get());
        let threads = threads.unwrap_or_else(cores).max(1);
        Self { threads, running: Mutex::new(Running { owner: std::process::id(), threads: None }) }
    }

    /// A pool whose threads run already and have taken the memory that threads take.
    pub fn started(threads: Option<usize>) -> Self {
        let pool = Self::new(threads);
        if let Some(running) = pool.get() {
            running.broadcast(|_| ());
        }
        pool
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// The threads of this process; none where one thread does it all, or no thread can be started.
    pub fn get(&self) -> Option<Threads> {
        if self.threads == 1 {
            return None;
        }
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        running.leave_inherited();
        if running.threads.is_none() {
            running.threads = Threads::start(self.threads);
        }
        running.threads.clone()
    }

    /// Does the work on each piece of a table, which it is given with its index; on some of them where it is stopped.
    pub fn each<T: Send>(
        &self,
        interruption: &Interruption<'_>,
        table: &mut [T],
        piece: usize,
        work: impl Fn(usize, &mut [T]) + Sync,
    ) {
        let pool = if table.len() > piece { self.get() } else { None };
        let work = |(index, entries): (usize, &mut [T])| {
            if !interruption.stops() {
                work(index, entries);
            }
        };
        interruption.run(pool.as_deref(), || match pool {
            None => table.chunks_mut(piece).enumerate().for_each(work),
            Some(_) => table.par_chunks_mut(piece).enumerate().for_each(work),
        });
    }

    /// Writes each row of `width` entries of a table, which `write` is given with its index.
    ///
    /// # Errors
    /// The call was stopped; some rows have been written.
    pub fn fill<T: Send>(
        &self,
        interruption: &Interruption<'_>,
        table: &mut [T],
        width: usize,
        write: impl Fn(usize, &mut [T]) + Sync,
    ) -> Result<(), Interrupted> {
        self.each(interruption, table, ROWS * width.max(1), |index, rows| {
            let rows = rows.chunks_mut(width).enumerate();
            rows.for_each(|(k, row)| write(ROWS * index + k, row));
        });
        interruption.last_asked()
    }
}

impl Running {
    /// Forgets the threads of the process that this one was forked from.
    fn leave_inherited(&mut self) {
        if self.owner != std::process::id() {
            self.owner = std::process::id();
            std::mem::forget(self.threads.take());
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.leave_inherited();
    }
}

impl Threads {
    /// None where they cannot be started.
    fn start(count: usize) -> Option<Self> {
        let mut ends = Ends::default();
        let spawn = |thread| ends.spawn(thread);
        let pool = ThreadPoolBuilder::new().num_threads(count).spawn_handler(spawn).build().ok()?;
        Some(Self(Arc::new(Started { pool, _ends: ends })))
    }
}

impl Deref for Threads {
    type Target = ThreadPool;

    fn deref(&self) -> &ThreadPool {
        &self.0.pool
    }
}

impl Ends {
    fn spawn(&mut self, thread: ThreadBuilder) -> io::Result<()> {
        self.0.push(thread::Builder::new().spawn(|| thread.run())?);
        Ok(())
    }
}

impl Drop for Ends {
    fn drop(&mut self) {
        for end in self.0.drain(..) {
            let _ = end.join();
        }
    }
}
