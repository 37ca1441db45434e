//! What one core does at best: arithmetic on eight lanes by kind, in chains that wait for nothing of each other and in
//! one that does, on each instruction set; the passage through memory; and the clock.

use magworm::internals::Rows;
use magworm::internals::lanes::{InstructionSet, Isa, Real, WIDE, WideTask, run_wide_on};
use std::hint::black_box;
use std::time::Instant;

/// Rounds of a run: a fraction of a millisecond.
const ROUNDS: usize = 20_000;
/// Rows that operands are loaded from: 4 kB, a part of any cache of the first level.
const ROWS: usize = 64;
/// Rows beyond such a cache, within the one behind it: 256 kB.
const FAR: usize = 4096;

/// What is done in a round, once in each chain.
#[derive(Clone, Copy)]
enum Kernel {
    /// x + c.
    Add,
    /// x · d.
    Multiply,
    /// x + c, and y · d in a chain of its own.
    Both,
    /// x + a b, both operands loaded: a multiplication and an addition.
    Dot,
    /// c/x.
    Divide,
    /// √(x + c): an addition too.
    Root,
    /// b where x < a, else c: a comparison and a selection.
    Choose,
    /// |x − c|: a subtraction too.
    Magnitude,
    /// Stored, loaded again, and c added.
    Memory,
    /// Loaded, c added, stored elsewhere.
    Copy,
    /// Loaded from beyond the first cache, and added.
    FarLoad,
    /// Stored beyond the first cache.
    FarStore,
}

const KERNELS: [(Kernel, &str); 12] = [
    (Kernel::Add, "add"),
    (Kernel::Multiply, "multiply"),
    (Kernel::Both, "add beside multiply"),
    (Kernel::Dot, "load, load, multiply, add"),
    (Kernel::Divide, "divide"),
    (Kernel::Root, "add, root"),
    (Kernel::Choose, "compare, select"),
    (Kernel::Magnitude, "add, bits"),
    (Kernel::Memory, "store, load, add"),
    (Kernel::Copy, "load, add, store"),
    (Kernel::FarLoad, "far load, add"),
    (Kernel::FarStore, "far store"),
];

/// Numbers of chains that are tried: processors have room for different ones.
const CHAINS: [usize; 7] = [1, 2, 3, 4, 6, 8, 12];

struct Run<'a> {
    kernel: Kernel,
    chains: usize,
    /// c, d, a, b.
    constants: [f64; 4],
    rows: &'a mut Rows<[f64; WIDE]>,
    /// Where a number is stored and loaded again: equal, which the compiler does not know.
    place: [usize; 2],
}

impl WideTask for Run<'_> {
    type Output = [f64; WIDE];
    fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) -> [f64; WIDE] {
        isa.vectorize(
            #[inline(always)]
            || match self.chains {
                1 => rounds::<I, 1>(isa, self),
                2 => rounds::<I, 2>(isa, self),
                3 => rounds::<I, 3>(isa, self),
                4 => rounds::<I, 4>(isa, self),
                6 => rounds::<I, 6>(isa, self),
                8 => rounds::<I, 8>(isa, self),
                _ => rounds::<I, 12>(isa, self),
            },
        )
    }
}

#[inline(always)]
fn rounds<I: Isa<Row = [f64; WIDE]>, const N: usize>(isa: I, run: Run<'_>) -> [f64; WIDE] {
    let [c, d, a, b] = run.constants;
    let (c, d, a, b) = (isa.splat(c), isa.splat(d), isa.splat(a), isa.splat(b));
    let mut x = [c; N];
    let mut y = [d; N];
    let rows = run.rows.first_chunk_mut::<FAR>().expect("so many were made");
    for round in 0..ROUNDS {
        for k in 0..N {
            match run.kernel {
                Kernel::Add => x[k] = x[k] + c,
                Kernel::Multiply => x[k] = x[k] * d,
                Kernel::Both => {
                    x[k] = x[k] + c;
                    y[k] = y[k] * d;
                }
                Kernel::Dot => {
                    let (left, right) = (&rows[(round + k) % ROWS], &rows[(round + 3 * k) % ROWS]);
                    x[k] = x[k] + isa.load(left) * isa.load(right);
                }
                Kernel::Divide => x[k] = c / x[k],
                Kernel::Root => x[k] = (x[k] + c).sqrt(),
                Kernel::Choose => x[k] = I::F::select(x[k].lt(a), b, c),
                Kernel::Magnitude => x[k] = (x[k] - c).abs(),
                Kernel::Memory => {
                    isa.store(x[k], &mut rows[(run.place[0] + k) % ROWS]);
                    x[k] = isa.load(&rows[(run.place[1] + k) % ROWS]) + c;
                }
                Kernel::Copy => {
                    let sum = isa.load(&rows[(round + k) % ROWS]) + c;
                    isa.store(sum, &mut rows[(round + k + ROWS / 2) % ROWS]);
                }
                Kernel::FarLoad => x[k] = x[k] + isa.load(&rows[(N * round + k) % FAR]),
                Kernel::FarStore => isa.store(c, &mut rows[(N * round + k) % FAR]),
            }
        }
    }
    let mut sum = x[0];
    for k in 0..N {
        sum = sum + x[k] + y[k];
    }
    let mut out = [0.0; WIDE];
    isa.store(sum, &mut out);
    out
}

/// Nanoseconds of a round in one chain.
fn time(set: InstructionSet, kernel: Kernel, chains: usize) -> f64 {
    let mut rows = Rows::zeros(FAR);
    let constants = black_box([1.7, 1.0, 0.9, 0.3]);
    let place = black_box([5, 5]);
    let begin = Instant::now();
    let run = Run { kernel, chains, constants, rows: &mut rows, place };
    black_box(run_wide_on(set, run));
    1e9 * begin.elapsed().as_secs_f64() / (ROUNDS * chains) as f64
}

/// Fused multiply-adds, which kernels do not use: on plain numbers, which the compiler puts into vectors.
struct Fused<'a>(&'a mut [f64; NUMBERS], [f64; 2]);

/// Numbers that are worked on, and operations on each before it is stored again.
const NUMBERS: usize = 512;
const DEPTH: usize = 16;

impl WideTask for Fused<'_> {
    type Output = ();
    #[allow(clippy::disallowed_methods, reason = "how fast it would be, not what it gives")]
    fn run<I: Isa<Row = [f64; WIDE]>>(self, isa: I) {
        let Fused(numbers, [c, d]) = self;
        isa.vectorize(
            #[inline(always)]
            || {
                for _ in 0..ROUNDS / NUMBERS {
                    for number in numbers.iter_mut() {
                        for _ in 0..DEPTH {
                            *number = number.mul_add(d, c);
                        }
                    }
                }
            },
        );
    }
}

/// Nanoseconds of eight.
fn time_fused(set: InstructionSet) -> f64 {
    let (mut numbers, constants) = (black_box([0.7; NUMBERS]), black_box([1.7, 0.3]));
    let begin = Instant::now();
    run_wide_on(set, Fused(&mut numbers, constants));
    let ns = 1e9 * begin.elapsed().as_secs_f64();
    black_box(numbers);
    ns * WIDE as f64 / (ROUNDS / NUMBERS * NUMBERS * DEPTH) as f64
}

/// Nanoseconds of a cycle: shifts and exclusive ors that wait for each other take one each.
fn time_cycle() -> f64 {
    const EACH: usize = 6;
    let mut x: u64 = black_box(88_172_645_463_325_252);
    let begin = Instant::now();
    for _ in 0..ROUNDS {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
    }
    black_box(x);
    1e9 * begin.elapsed().as_secs_f64() / (ROUNDS * EACH) as f64
}

/// Lines of instruction set, kernel, chains and nanoseconds of a round in one chain; every run is one line.
pub fn measure(runs: usize) {
    for _ in 0..runs {
        println!("all,cycle,1,{}", time_cycle());
        for set in InstructionSet::available() {
            for chains in CHAINS {
                for (kernel, name) in KERNELS {
                    println!("{},\"{name}\",{chains},{}", set.name(), time(set, kernel, chains));
                }
            }
            // Narrower sets have none; there it would be a function of the system.
            if set.name().starts_with("AVX") {
                println!("{},fused,1,{}", set.name(), time_fused(set));
            }
        }
    }
}
