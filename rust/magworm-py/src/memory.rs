//! Memory is asked for before it is used: what is not there is a `MemoryError`, not the end of the process.

use pyo3::PyErr;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use sysinfo::System;

/// Requests below are made without being checked [bytes].
const SMALL: usize = 1 << 20;

/// From here on the machine is asked what it has [bytes].
const LARGE: usize = 64 << 20;

/// Most that is asked for beyond what pieces hold [bytes].
const PIECES: usize = 1 << 30;

/// What allocators reserve at a time for threads, whatever these ask for: four heaps of the GNU C library [bytes].
const HEAPS: usize = 4 << 26;

/// Checks that a call may use so many bytes in small pieces. An allocator that may not grow any more maps whole pages for
/// each, which takes several times as much.
///
/// # Errors
/// The machine has less to give, or a limit of the process is in the way.
pub fn check_room(what: &str, bytes: usize) -> PyResult<()> {
    check(what, bytes, HEAPS + bytes.saturating_mul(4).min(PIECES))
}

/// The same with another number of bytes that are spare.
fn check(what: &str, bytes: usize, spare: usize) -> PyResult<()> {
    if bytes < SMALL {
        return Ok(());
    }
    // Reserving is refused beyond a limit of the process, and nothing is written.
    let reserved = Vec::<u8>::new().try_reserve_exact(bytes.saturating_add(spare));
    if reserved.is_err() || (bytes >= LARGE && bytes > free_bytes()) {
        return Err(missing(what, bytes));
    }
    Ok(())
}

/// An empty vector with room for so many numbers.
pub fn reserved<T>(what: &str, count: usize) -> PyResult<Vec<T>> {
    let bytes = count.saturating_mul(size_of::<T>());
    check(what, bytes, 0)?;
    let mut numbers = Vec::new();
    numbers.try_reserve_exact(count).map_err(|_| missing(what, bytes))?;
    Ok(numbers)
}

/// So many zeros.
pub fn zeros<T: Clone + Default>(what: &str, count: usize) -> PyResult<Vec<T>> {
    let mut numbers = reserved(what, count)?;
    numbers.resize(count, T::default());
    Ok(numbers)
}

/// Number of things in a table of such sizes; as many as can be counted where it is more.
pub fn product(sizes: &[usize]) -> usize {
    sizes.iter().fold(1, |product: usize, &size| product.saturating_mul(size))
}

/// What this process may still take: of the machine, or of the control group that it runs in.
fn free_bytes() -> usize {
    let mut system = System::new();
    system.refresh_memory();
    let group = system.cgroup_limits().map(|group| group.total_memory.saturating_sub(group.rss));
    let free = system.available_memory().min(group.unwrap_or(u64::MAX));
    usize::try_from(free.saturating_add(system.free_swap())).unwrap_or(usize::MAX)
}

fn missing(what: &str, bytes: usize) -> PyErr {
    let (needed, free) = (bytes as f64 / 1e9, free_bytes() as f64 / 1e9);
    PyMemoryError::new_err(format!(
        "{what} needs {needed:.3} GB; the machine has {free:.3} GB to give, or less where the process is limited"
    ))
}
