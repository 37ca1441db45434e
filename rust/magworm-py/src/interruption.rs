//! Long calls: Python's lock is released, and Ctrl-C stops them.

use magworm::{Interrupted, Interruption};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::cell::Cell;

thread_local! {
    /// Whether handlers of signals run now because a long call asked for it.
    static ASKING: Cell<bool> = const { Cell::new(false) };
}

/// Does work that can take long, without Python's lock. While it is done, handlers of signals run about every
/// hundredth of a second in the thread that called; where one raises, the work stops and that is raised.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Interruption<'_>) -> Result<T, Interrupted> + Send,
) -> PyResult<T> {
    let mut signal = Ok(());
    let outcome = py.detach(|| {
        let mut ask = || {
            if signal.is_ok() {
                signal = Python::attach(check_signals);
            }
            signal.is_err()
        };
        work(&Interruption::new(&mut ask))
    });
    signal?;
    outcome.map_err(|Interrupted| PyRuntimeError::new_err("stopped, though no signal asked for it"))
}

fn check_signals(py: Python<'_>) -> PyResult<()> {
    ASKING.set(true);
    let outcome = py.check_signals();
    ASKING.set(false);
    outcome
}

/// Whether a signal's handler runs now inside a call that stops, and changes nothing, where it raises.
#[pyfunction]
pub fn _stops_cleanly() -> bool {
    ASKING.get()
}
