//! A right-hand side: its time with each kernel, its arithmetic, and how near that comes to what the core can do.
//!
//! `cargo bench -p brinell-bench --bench kernel`. Operations are counted by running the equations in lanes that count;
//! a fused product and sum is two, as is usual; comparisons and moves of bits are named apart. Work on single numbers
//! (rings, cages, damage under a roller) is not counted. The peak is a loop of independent fused products and sums on
//! the same core at the same moment.

mod common;

use brinell::lanes::{Lanes, Portable, functions};
use brinell::model::{Kernel, Model, Workspace};
use common::{Moment, moments, off_and_on_damage, rectangle};
use criterion::Criterion;
use std::cell::Cell;
use std::hint::black_box;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
use std::time::Instant;

/// Counted operations on groups.
#[derive(Debug, Clone, Copy, Default)]
struct Operations {
    sums: u64,
    products: u64,
    fused: u64,
    quotients: u64,
    others: u64,
}

impl Operations {
    /// Floating-point operations on single numbers.
    fn flops(&self) -> u64 {
        Portable::COUNT as u64 * (self.sums + self.products + 2 * self.fused + self.quotients)
    }
}

thread_local! {
    static COUNTED: Cell<Operations> = const { Cell::new(Operations { sums: 0, products: 0, fused: 0, quotients: 0, others: 0 }) };
}

fn count(add: impl FnOnce(&mut Operations)) {
    let mut counted = COUNTED.get();
    add(&mut counted);
    COUNTED.set(counted);
}

/// Portable lanes that count what is asked of them.
#[derive(Debug, Clone, Copy)]
struct Counting(Portable);

macro_rules! operator {
    ($trait:ident, $method:ident, $count:ident) => {
        impl $trait for Counting {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                count(|c| c.$count += 1);
                Self($trait::$method(self.0, other.0))
            }
        }
    };
}
operator!(Add, add, sums);
operator!(Sub, sub, sums);
operator!(Mul, mul, products);
operator!(Div, div, quotients);

impl Neg for Counting {
    type Output = Self;
    fn neg(self) -> Self {
        count(|c| c.others += 1);
        Self(-self.0)
    }
}

impl AddAssign for Counting {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Counting {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// Methods that are neither sum nor product.
macro_rules! others {
    ($($method:ident($($arg:ident: $type:ty),*);)*) => {
        $(fn $method(self, $($arg: $type),*) -> Self {
            count(|c| c.others += 1);
            Self(self.0.$method($($arg.inner()),*))
        })*
    };
}

/// What the portable lanes are given for an argument.
trait Inner {
    type Of;
    fn inner(self) -> Self::Of;
}
impl Inner for Counting {
    type Of = Portable;
    fn inner(self) -> Portable {
        self.0
    }
}
impl Inner for u64 {
    type Of = u64;
    fn inner(self) -> u64 {
        self
    }
}

impl Lanes for Counting {
    fn sin_cos(self) -> (Self, Self) {
        functions::sin_cos(self)
    }

    fn exp(self) -> Self {
        functions::exp(self)
    }

    fn tanh(self) -> Self {
        functions::tanh(self)
    }

    fn ten_ninths(self) -> Self {
        functions::ten_ninths(self)
    }

    const COUNT: usize = Portable::COUNT;
    type Group = <Portable as Lanes>::Group;
    type Pair = Self;

    fn groups(list: &[f64]) -> &[Self::Group] {
        Portable::groups(list)
    }
    fn groups_mut(list: &mut [f64]) -> &mut [Self::Group] {
        Portable::groups_mut(list)
    }
    fn splat(x: f64) -> Self {
        Self(Portable::splat(x))
    }
    fn new(x: Self::Group) -> Self {
        Self(Portable::new(x))
    }
    fn array(self) -> Self::Group {
        self.0.array()
    }
    fn sum(self) -> f64 {
        count(|c| c.sums += Portable::COUNT.ilog2() as u64);
        self.0.sum()
    }
    fn times_plus(self, b: Self, c: Self) -> Self {
        count(|n| n.fused += 1);
        Self(self.0.times_plus(b.0, c.0))
    }
    fn minus_times(self, b: Self, c: Self) -> Self {
        count(|n| n.fused += 1);
        Self(self.0.minus_times(b.0, c.0))
    }
    fn above(self, other: Self) -> u8 {
        count(|n| n.others += 1);
        self.0.above(other.0)
    }
    fn shift_up<const N: i32>(self) -> Self {
        count(|n| n.others += 1);
        Self(self.0.shift_up::<N>())
    }
    fn shift_down<const N: i32>(self) -> Self {
        count(|n| n.others += 1);
        Self(self.0.shift_down::<N>())
    }
    others! {
        abs();
        sqrt();
        with_sign(sign: Self);
        if_above(other: Self, x: Self, y: Self);
        and_bits(bits: u64);
        or_bits(bits: u64);
        and(other: Self);
        xor(other: Self);
        add_bits(bits: u64);
        minus_bits();
        positive_part();
        at_least(other: Self);
        at_most(other: Self);
    }
}

fn counted(model: &Model, (t, y): &Moment) -> Operations {
    let mut ws = Workspace::new(model);
    let mut a = vec![0.0; y.len() / 2];
    COUNTED.set(Operations::default());
    model.accelerations_in::<Counting>(*t, y, &mut a, &mut ws);
    COUNTED.get()
}

/// Registers with independent chains of x * a + b.
#[cfg(target_arch = "x86_64")]
const REGISTERS: usize = 12;

/// Defines a function of `rounds` rounds of the chains in [`REGISTERS`] of one kind of register.
#[cfg(target_arch = "x86_64")]
macro_rules! chains {
    ($name:ident, $features:literal, $splat:ident, $fused:ident) => {
        #[target_feature(enable = $features)]
        fn $name(rounds: u64, a: f64, b: f64) {
            use std::arch::x86_64::{$fused, $splat};
            let (a, b) = ($splat(a), $splat(b));
            let mut x = [b; REGISTERS];
            for (k, x) in x.iter_mut().enumerate() {
                *x = $splat(k as f64);
            }
            for _ in 0..rounds {
                for x in &mut x {
                    *x = $fused(*x, a, b);
                }
            }
            black_box(x);
        }
    };
}

#[cfg(target_arch = "x86_64")]
chains!(chains_avx512, "avx512f", _mm512_set1_pd, _mm512_fmadd_pd);
#[cfg(target_arch = "x86_64")]
chains!(chains_avx2, "avx2,fma", _mm256_set1_pd, _mm256_fmadd_pd);

/// Best of several, s: what a machine does when nobody else is at it.
fn shortest(mut what: impl FnMut()) -> f64 {
    (0..20)
        .map(|_| {
            let begin = Instant::now();
            what();
            begin.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

/// Floating-point operations a second of independent fused products and sums with a kernel's instructions.
fn peak(kernel: Kernel) -> f64 {
    const ROUNDS: u64 = 1_000_000;
    let (a, b) = (black_box(0.999_999), black_box(1e-6));
    /// Chains of single numbers.
    const CHAINS: usize = 24;
    let of = |chains: usize, seconds: f64| (2 * chains) as f64 * ROUNDS as f64 / seconds;
    match kernel {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: asked for only where the processor has these instructions.
        Kernel::Avx512 => of(
            8 * REGISTERS,
            shortest(|| {
                unsafe { chains_avx512(ROUNDS, a, b) };
            }),
        ),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Kernel::Avx2 => of(
            4 * REGISTERS,
            shortest(|| {
                unsafe { chains_avx2(ROUNDS, a, b) };
            }),
        ),
        // As `Portable` they would go through memory.
        _ => of(
            CHAINS,
            shortest(|| {
                let mut x: [f64; CHAINS] = std::array::from_fn(|k| k as f64);
                for _ in 0..ROUNDS {
                    for x in &mut x {
                        *x = *x * a + b;
                    }
                }
                black_box(x);
            }),
        ),
    }
}

fn kernels() -> impl Iterator<Item = Kernel> {
    Kernel::ALL.into_iter().filter(|k| k.is_there())
}

/// Time of one right-hand side, s: the mean over moments.
fn time(model: &Model, kernel: Kernel, moments: &[Moment]) -> f64 {
    let rounds = 20_000 / moments.len();
    let mut ws = Workspace::with_kernel(model, kernel);
    let mut a = vec![0.0; moments[0].1.len() / 2];
    shortest(|| {
        for _ in 0..rounds {
            for (t, y) in moments {
                model.accelerations(*t, black_box(y), &mut a, &mut ws);
            }
        }
    }) / (rounds * moments.len()) as f64
}

fn bound(model: &Model, moments: &[Moment; 2]) {
    for (place, moment) in ["off damage", "on damage"].into_iter().zip(moments) {
        let n = counted(model, moment);
        println!(
            "{place}: {} flops a right-hand side, {} rollers in {} slots; groups of {}: {} fused, {} products, {} sums, {} quotients, \
             {} comparisons and moves of bits",
            n.flops(),
            model.layout.rollers(),
            model.layout.slots,
            Portable::COUNT,
            n.fused,
            n.products,
            n.sums,
            n.quotients,
            n.others
        );
        for kernel in kernels() {
            let (peak, seconds) = (peak(kernel), time(model, kernel, std::slice::from_ref(moment)));
            let rate = n.flops() as f64 / seconds;
            println!(
                "  {kernel:?}: {:.0} ns, {:.1} GFLOP/s of a peak of {:.1}: {:.0} %",
                1e9 * seconds,
                1e-9 * rate,
                1e-9 * peak,
                100.0 * rate / peak
            );
        }
    }
}

/// Twice the rollers: at most twice the time. Without damage, over many moments: how many groups of contacts are open
/// differs from one to the next.
fn rollers() {
    let mut before: Option<f64> = None;
    for rollers_per_row in [19, 38, 76, 152] {
        let mut s = rectangle();
        s.defects.clear();
        s.bearing.rollers_per_row = rollers_per_row;
        s.bearing.row_stagger_deg = 180.0 / rollers_per_row as f64;
        let model = Model::new(&s).expect("a model");
        let seconds = time(&model, Kernel::fastest(), &moments(&model));
        let ratio = before.map_or(String::new(), |b| format!(", {:.2} times", seconds / b));
        println!("{} rollers: {:.0} ns{ratio}", model.layout.rollers(), 1e9 * seconds);
        before = Some(seconds);
    }
}

/// What an element costs: of the paper's rollers, and of balls in bearings that fill their slots and in one that does
/// not. Bodies that are there once (rings, cage) count with the elements.
fn balls() {
    let healthy = |preset: &str| {
        let mut s = rectangle();
        if preset != "NN3007" {
            let text = format!("[bearing]\npreset = \"{preset}\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n");
            s = brinell::document::read(&text, &[]).expect("sound").scenario;
        }
        s.defects.clear();
        Model::new(&s).expect("a model")
    };
    for kernel in kernels() {
        let mut roller = f64::NAN;
        for preset in ["NN3007", "NU206", "6204", "6205", "6207"] {
            let model = healthy(preset);
            let moments = moments(&model);
            let nanoseconds = 1e9 * time(&model, kernel, &moments);
            let layout = &model.layout;
            let each = nanoseconds / layout.rollers() as f64;
            if roller.is_nan() {
                roller = each;
            }
            println!(
                "{kernel:?}, {preset}: {nanoseconds:.0} ns, {} elements in {} slots: {each:.2} ns an element, {:.2} times the NN3007's; {:.2} ns a slot",
                layout.rollers(),
                layout.slots,
                each / roller,
                nanoseconds / layout.slots as f64
            );
        }
    }
}

fn main() {
    let mut criterion: Criterion = common::criterion();
    let model = Model::new(&rectangle()).expect("a model");
    let places = off_and_on_damage(&model);
    // `cargo test --benches` only wants to see that it runs.
    if !std::env::args().any(|a| a == "--test") {
        bound(&model, &places);
        rollers();
        balls();
    }
    let mut group = criterion.benchmark_group("right-hand side");
    for kernel in kernels() {
        for (place, (t, y)) in ["off damage", "on damage"].into_iter().zip(&places) {
            let mut ws = Workspace::with_kernel(&model, kernel);
            let mut a = vec![0.0; y.len() / 2];
            group.bench_function(format!("{kernel:?}, {place}"), |b| {
                b.iter(|| model.accelerations(*t, black_box(y), &mut a, &mut ws));
            });
        }
    }
    group.finish();
    criterion.final_summary();
}
