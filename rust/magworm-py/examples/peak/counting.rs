//! An instruction set that counts: plain numbers in lanes, every operation tallied, and each number with the longest
//! chain of operations that it had to wait for.
//!
//! Chains go through memory: what is stored at a place and loaded from there goes on. Not followed are rows that are
//! copied without being loaded, a handful a step, and what a branch waits for, since branches are predicted.

use magworm::internals::lanes::{Isa, Mask, Real, Row};
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::marker::PhantomData;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Kinds of operations: their names, in the order of all arrays by kind.
pub const KINDS: [&str; 10] =
    ["add", "multiply", "divide", "root", "compare", "select", "bits", "mask", "load", "store"];

const ADD: usize = 0;
const MULTIPLY: usize = 1;
const DIVIDE: usize = 2;
const ROOT: usize = 3;
const COMPARE: usize = 4;
const SELECT: usize = 5;
/// Signs, exponents, mantissas.
const BITS: usize = 6;
/// Of truth values.
const MASK: usize = 7;
const LOAD: usize = 8;
const STORE: usize = 9;

/// A chain of operations, each of which waits for the one before.
#[derive(Clone, Copy, Default)]
pub struct Path {
    /// Time from its first to its last [ns].
    pub ns: f64,
    /// Operations in it by kind.
    pub operations: [u32; KINDS.len()],
}

impl Path {
    fn longer(self, other: Self) -> Self {
        if other.ns > self.ns { other } else { self }
    }
}

/// What was tallied.
#[derive(Clone, Default)]
pub struct Tally {
    /// Operations by kind, each of all lanes at once.
    pub operations: [u64; KINDS.len()],
    /// The longest chain.
    pub longest: Path,
    /// Addresses of the rows that were loaded or stored.
    pub rows: HashSet<usize>,
    latency_ns: [f64; KINDS.len()],
    /// Chains that end with what stands at an address.
    memory: HashMap<usize, Path>,
}

thread_local! {
    static TALLY: RefCell<Tally> = RefCell::default();
}

/// Tallies what some work does; chains begin with it. `latency_ns`: of each kind of operation [ns].
pub fn tallied(latency_ns: [f64; KINDS.len()], work: impl FnOnce()) -> Tally {
    TALLY.with_borrow_mut(|tally| *tally = Tally { latency_ns, ..Tally::default() });
    work();
    TALLY.take()
}

#[inline(never)]
fn done(kind: usize, waits: Path) -> Path {
    TALLY.with_borrow_mut(|tally| {
        tally.operations[kind] += 1;
        let mut path = waits;
        path.ns += tally.latency_ns[kind];
        path.operations[kind] += 1;
        tally.longest = tally.longest.longer(path);
        path
    })
}

/// The instruction set for rows of R.
#[derive(Clone, Copy)]
pub struct Counting<R>(pub PhantomData<R>);

/// Numbers in lanes.
#[derive(Clone, Copy)]
pub struct Numbers<R: Row<Number = f64>> {
    lanes: R,
    path: Path,
}

/// Truth values in lanes: 1 where true, else 0.
#[derive(Clone, Copy)]
pub struct Truths<R: Row<Number = f64>> {
    lanes: R,
    path: Path,
}

impl<R: Row<Number = f64>> Truths<R> {
    fn of(self, lane: usize) -> bool {
        self.lanes[lane] == 1.0
    }
}

fn numbers<R: Row<Number = f64>>(
    kind: usize,
    waits: Path,
    of_lane: impl FnMut(usize) -> f64,
) -> Numbers<R> {
    Numbers { lanes: R::of_lanes(of_lane), path: done(kind, waits) }
}

fn truths<R: Row<Number = f64>>(
    kind: usize,
    waits: Path,
    mut of_lane: impl FnMut(usize) -> bool,
) -> Truths<R> {
    let lanes = R::of_lanes(|k| f64::from(u8::from(of_lane(k))));
    Truths { lanes, path: done(kind, waits) }
}

macro_rules! arithmetic {
    ($($name:ident, $method:ident, $kind:ident, $sign:tt;)*) => {$(
        impl<R: Row<Number = f64>> $name for Numbers<R> {
            type Output = Self;
            #[inline(never)]
            fn $method(self, other: Self) -> Self {
                let waits = self.path.longer(other.path);
                numbers($kind, waits, |k| self.lanes[k] $sign other.lanes[k])
            }
        }
        impl<R: Row<Number = f64>> $name<f64> for Numbers<R> {
            type Output = Self;
            #[inline(never)]
            fn $method(self, other: f64) -> Self {
                numbers($kind, self.path, |k| self.lanes[k] $sign other)
            }
        }
    )*};
}

arithmetic! {
    Add, add, ADD, +;
    Sub, sub, ADD, -;
    Mul, mul, MULTIPLY, *;
    Div, div, DIVIDE, /;
}

impl<R: Row<Number = f64>> Neg for Numbers<R> {
    type Output = Self;
    #[inline(never)]
    fn neg(self) -> Self {
        numbers(BITS, self.path, |k| -self.lanes[k])
    }
}

impl<R: Row<Number = f64>> BitAnd for Truths<R> {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        truths(MASK, self.path.longer(other.path), |k| self.of(k) & other.of(k))
    }
}

impl<R: Row<Number = f64>> BitOr for Truths<R> {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        truths(MASK, self.path.longer(other.path), |k| self.of(k) | other.of(k))
    }
}

impl<R: Row<Number = f64>> Not for Truths<R> {
    type Output = Self;
    fn not(self) -> Self {
        truths(MASK, self.path, |k| !self.of(k))
    }
}

impl<R: Row<Number = f64>> Mask for Truths<R> {
    fn any(self) -> bool {
        done(MASK, self.path);
        (0..R::LANES).any(|k| self.of(k))
    }
    fn all(self) -> bool {
        done(MASK, self.path);
        (0..R::LANES).all(|k| self.of(k))
    }
}

impl<R: Row<Number = f64>> Real for Numbers<R> {
    type Mask = Truths<R>;
    type Number = f64;

    fn splat(self, value: f64) -> Self {
        Numbers { lanes: R::of_lanes(|_| value), path: Path::default() }
    }
    #[inline(never)]
    fn sqrt(self) -> Self {
        numbers(ROOT, self.path, |k| self.lanes[k].sqrt())
    }
    #[inline(never)]
    fn abs(self) -> Self {
        numbers(BITS, self.path, |k| self.lanes[k].abs())
    }
    #[inline(never)]
    fn copysign(self, sign: Self) -> Self {
        let waits = self.path.longer(sign.path);
        numbers(BITS, waits, |k| self.lanes[k].copysign(sign.lanes[k]))
    }
    #[inline(never)]
    fn lt(self, other: Self) -> Truths<R> {
        truths(COMPARE, self.path.longer(other.path), |k| self.lanes[k] < other.lanes[k])
    }
    #[inline(never)]
    fn le(self, other: Self) -> Truths<R> {
        truths(COMPARE, self.path.longer(other.path), |k| self.lanes[k] <= other.lanes[k])
    }
    #[inline(never)]
    fn eq(self, other: Self) -> Truths<R> {
        truths(COMPARE, self.path.longer(other.path), |k| self.lanes[k] == other.lanes[k])
    }
    #[inline(never)]
    fn select(mask: Truths<R>, a: Self, b: Self) -> Self {
        let waits = mask.path.longer(a.path).longer(b.path);
        numbers(SELECT, waits, |k| if mask.of(k) { a.lanes[k] } else { b.lanes[k] })
    }
    /// Two operations on bits for the mantissa; two and a subtraction for the exponent.
    #[inline(never)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let parts = |k| Real::mantissa_exponent(self.lanes[k]);
        let twice = done(BITS, done(BITS, self.path));
        let shifted = done(BITS, done(BITS, self.path));
        let mantissa = Numbers { lanes: R::of_lanes(|k| parts(k).0), path: twice };
        (mantissa, numbers(ADD, shifted, |k| parts(k).1))
    }
}

impl<R: Row<Number = f64>> Isa for Counting<R> {
    type Row = R;
    type F = Numbers<R>;
    type M = Truths<R>;

    fn splat(self, value: f64) -> Numbers<R> {
        Numbers { lanes: R::of_lanes(|_| value), path: Path::default() }
    }
    #[inline(never)]
    fn load(self, row: &R) -> Numbers<R> {
        let place = std::ptr::from_ref(row) as usize;
        let stored = TALLY.with_borrow_mut(|tally| {
            tally.rows.insert(place);
            tally.memory.get(&place).copied()
        });
        numbers(LOAD, stored.unwrap_or_default(), |k| row[k])
    }
    #[inline(never)]
    fn store(self, value: Numbers<R>, row: &mut R) {
        *row = value.lanes;
        let path = done(STORE, value.path);
        let place = std::ptr::from_ref(row) as usize;
        TALLY.with_borrow_mut(|tally| {
            tally.rows.insert(place);
            tally.memory.insert(place, path)
        });
    }
    fn vectorize<T>(self, f: impl FnOnce() -> T) -> T {
        f()
    }
}
