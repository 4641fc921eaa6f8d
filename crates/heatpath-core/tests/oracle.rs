//! The scheduled engine against the simplest one: plain sweeps over the whole grid, formula first.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::exec::SimdLevel;
use heatpath_core::grid::heat::{
    Duration, Explicit, Heat, HeatError, HeatOptions, NoExposure, Step,
};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::{Grid, Mask, Shape, Sources};
use proptest::prelude::*;

/// `u' = u + step k div(D grad u)`, cell by cell, and the sum of all u.
fn sweep<const D: usize>(
    medium: &Medium<D>,
    u: &mut [f64],
    iterations: usize,
    step: f64,
) -> Vec<f64> {
    let shape = *medium.shape();
    let mut sum = u.to_vec();
    for _ in 0..iterations {
        let before = u.to_vec();
        for (cell, u) in u.iter_mut().enumerate() {
            let flux: f64 = (0..D)
                .map(|axis| {
                    let (stride, index) = (shape.stride(axis), shape.index(cell)[axis]);
                    let flux = |from: usize, to: usize| {
                        conductance(medium, axis, from, to) * (before[to] - before[from])
                    };
                    let last = index + 1 == shape.size()[axis];
                    let after = if last { 0.0 } else { flux(cell, cell + stride) };
                    let before = if index == 0 { 0.0 } else { flux(cell - stride, cell) };
                    after - before
                })
                .fold(0.0, |sum, flux| sum + flux);
            *u += medium.factor().map_or(step, |k| step * k.values()[cell]) * flux;
        }
        sum.iter_mut().zip(&*u).for_each(|(sum, u)| *sum += u);
    }
    sum
}

fn conductance<const D: usize>(medium: &Medium<D>, axis: usize, a: usize, b: usize) -> f64 {
    let shape = medium.shape();
    let open = medium.mask().is_open(a) && medium.mask().is_open(b);
    let harmonic = |x: f64, y: f64| 2.0 * x * y / (x + y);
    let mean = medium.diffusion().scalar().map_or(1.0, |d| harmonic(d.values()[a], d.values()[b]));
    let scale = (shape.smallest_spacing() / shape.spacing()[axis]).powi(2);
    if open { scale * mean } else { 0.0 }
}

fn engine<const D: usize>(medium: &Medium<D>, source: [f64; D], n: usize, exec: &Exec) -> Heat<D> {
    let options = HeatOptions {
        duration: Duration::Iterations(n),
        step: Step::Fixed(0.15),
        ..HeatOptions::default()
    };
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Explicit::new(medium, options).unwrap().flow(&sources, exec).unwrap()
}

fn assert_agrees<const D: usize>(medium: &Medium<D>, source: [usize; D], n: usize, exec: &Exec) {
    let shape = *medium.shape();
    let heat = engine(medium, source.map(|i| i as f64), n, exec);
    let mut u = vec![0.0; shape.cells()];
    u[shape.position(source)] = 1.0;
    let sum = sweep(medium, &mut u, n, heat.step());
    for cell in 0..shape.cells() {
        // Below this the plain sweep has lost bits, the engine has not.
        if u[cell] > 1e-290 {
            let ln_u = heat.ln_temperature().values()[cell];
            assert!((ln_u - u[cell].ln()).abs() <= 1e-13 * (1.0 + ln_u.abs()), "u of cell {cell}");
            let ln_sum = heat.ln_exposure().unwrap().values()[cell];
            assert!(
                (ln_sum - sum[cell].ln()).abs() < 1e-12 * (1.0 + ln_sum.abs()),
                "sum of {cell}"
            );
        } else if u[cell] == 0.0 && n < 150 {
            assert_eq!(heat.ln_temperature().values()[cell], f64::NEG_INFINITY, "cell {cell}");
        }
    }
}

/// A field that varies from cell to cell, with no pattern that a tile could hide behind.
fn rough<const D: usize>(shape: Shape<D>, low: f64) -> Grid<f64, D> {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    Grid::from_fn(shape, |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        low + (1.0 - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
    })
}

#[test]
fn plane_with_varying_diffusion() {
    let shape = Shape::with_spacing([150, 131], [1.0, 1.5]).unwrap();
    let medium = medium::given(rough(shape, 0.05), Form::Divergence).unwrap();
    for n in [1, 7, 8, 9, 100] {
        assert_agrees(&medium, [70, 64], n, &Exec::new(2).unwrap());
    }
}

#[test]
fn plane_with_varying_factor_and_walls() {
    let shape = Shape::new([131, 90]).unwrap();
    let walls = Grid::from_fn(shape, |[x, y]| !(x == 63 && y > 10) && (x + 2 * y) % 17 != 0);
    let medium = medium::given(rough(shape, 0.1), Form::Pointwise)
        .unwrap()
        .with_walls(Mask::new(walls))
        .unwrap();
    assert_agrees(&medium, [20, 42], 200, &Exec::single_threaded());
}

#[test]
fn plane_in_large_tiles() {
    let medium =
        medium::given(rough(Shape::new([520, 510]).unwrap(), 0.1), Form::Pointwise).unwrap();
    for n in [5, 50] {
        assert_agrees(&medium, [250, 255], n, &Exec::single_threaded());
    }
}

#[test]
fn combined_medium() {
    let image = rough(Shape::new([80, 70]).unwrap(), 0.8);
    let perona_malik = medium::PeronaMalikOptions { contrast: 0.2, ..Default::default() };
    let medium =
        medium::combined(&image, &[0.9], medium::ConductivityOptions::default(), perona_malik);
    assert_agrees(&medium.unwrap(), [79, 0], 60, &Exec::single_threaded());
}

#[test]
fn space() {
    let shape = Shape::with_spacing([40, 29, 51], [1.0, 1.0, 2.0]).unwrap();
    let medium = medium::given(rough(shape, 0.2), Form::Divergence).unwrap();
    assert_agrees(&medium, [30, 3, 25], 30, &Exec::new(2).unwrap());
}

#[test]
fn long_space() {
    let shape = Shape::new([150, 21, 37]).unwrap();
    let medium = medium::given(rough(shape, 0.2), Form::Pointwise).unwrap();
    assert_agrees(&medium, [120, 3, 25], 30, &Exec::new(2).unwrap());
}

#[test]
fn space_in_large_tiles() {
    for form in [Form::Divergence, Form::Pointwise] {
        let field = rough(Shape::new([270, 90, 90]).unwrap(), 0.2);
        let medium = medium::given(field, form).unwrap();
        assert_agrees(&medium, [134, 46, 47], 11, &Exec::new(2).unwrap());
    }
}

#[test]
fn the_temperature_does_not_depend_on_the_exposure() {
    let medium =
        medium::given(rough(Shape::new([150, 90]).unwrap(), 0.1), Form::Pointwise).unwrap();
    let sources = Sources::new(&[[100.0, 20.0]], medium.mask()).unwrap();
    let flow = |exposure| {
        let options = HeatOptions { exposure, ..HeatOptions::default() };
        let explicit = Explicit::new(&medium, options).unwrap();
        explicit.flow(&sources, &Exec::single_threaded()).unwrap()
    };
    let (with, without) = (flow(true), flow(false));
    assert_eq!(with.ln_temperature(), without.ln_temperature());
    assert!(with.ln_exposure().is_ok());
    assert_eq!(without.ln_exposure(), Err(NoExposure));
}

#[test]
fn narrow_grids() {
    for size in [[1, 1], [1, 200], [200, 1], [65, 2]] {
        let shape = Shape::new(size).unwrap();
        assert_agrees(&medium::uniform(shape), [0, 0], 90, &Exec::single_threaded());
    }
}

#[test]
fn the_result_does_not_depend_on_threads() {
    let shape = Shape::new([300, 200]).unwrap();
    let medium = medium::given(rough(shape, 1e-3), Form::Divergence).unwrap();
    let once = engine(&medium, [10.0, 10.0], 250, &Exec::single_threaded());
    for threads in [2, 3, 8] {
        let again = engine(&medium, [10.0, 10.0], 250, &Exec::new(threads).unwrap());
        assert_eq!(once.ln_temperature(), again.ln_temperature());
        assert_eq!(once.ln_exposure(), again.ln_exposure());
    }
}

#[test]
fn the_result_does_not_depend_on_vector_instructions() {
    let shape = Shape::new([170, 140]).unwrap();
    let divergence = medium::given(rough(shape, 1e-3), Form::Divergence).unwrap();
    let pointwise = medium::given(rough(shape, 1e-3), Form::Pointwise).unwrap();
    let space =
        medium::given(rough(Shape::new([40, 33, 21]).unwrap(), 0.1), Form::Divergence).unwrap();
    let level = |level| Exec::single_threaded().with_simd(level);
    let plain =
        [&divergence, &pointwise].map(|m| engine(m, [9.0, 70.0], 90, &level(SimdLevel::Baseline)));
    let plain_space = engine(&space, [9.0, 7.0, 3.0], 40, &level(SimdLevel::Baseline));
    println!("best level here: {}", SimdLevel::best().name());
    for simd in [SimdLevel::Avx2, SimdLevel::Avx512] {
        for (medium, plain) in [&divergence, &pointwise].into_iter().zip(&plain) {
            let heat = engine(medium, [9.0, 70.0], 90, &level(simd));
            assert_eq!(heat.ln_temperature(), plain.ln_temperature());
            assert_eq!(heat.ln_exposure(), plain.ln_exposure());
        }
        let heat = engine(&space, [9.0, 7.0, 3.0], 40, &level(simd));
        assert_eq!(heat.ln_temperature(), plain_space.ln_temperature());
    }
}

/// A float with an exponent of its own for every cell: slow, but without limits.
#[derive(Clone, Copy)]
struct Wide {
    value: f64,
    exponent: i64,
}

impl Wide {
    fn new(value: f64, exponent: i64) -> Self {
        if value == 0.0 {
            return Self { value, exponent: i64::MIN / 2 };
        }
        let shift = i64::from((value.to_bits() >> 52 & 0x7ff) as i32 - 1023);
        Self { value: value * 2_f64.powi(-shift as i32), exponent: exponent + shift }
    }

    fn plus(self, other: Self) -> Self {
        let top = self.exponent.max(other.exponent);
        let at = |x: Self| x.value * 2_f64.powi((x.exponent - top).max(-1000) as i32);
        Self::new(at(self) + at(other), top)
    }

    fn times(self, factor: f64) -> Self {
        Self::new(self.value * factor, self.exponent)
    }

    fn ln(self) -> f64 {
        self.value.ln() + self.exponent as f64 * std::f64::consts::LN_2
    }
}

/// Far beyond the range of f64: slow media, in which u falls to exp(-8000).
#[test]
fn range_without_limits() {
    let shape = Shape::new([260, 70]).unwrap();
    // After 330 steps heat has just come to the furthest corner.
    // Heat that comes along the fast lanes makes up for what the slow ones lost at the front.
    let lanes = Grid::from_fn(shape, |[_, y]| if y / 12 % 2 == 0 { 2e-3 } else { 1.0 });
    let fields = [(1e-3, 2e-3, 330), (1e-2, 1.0, 520), (1e-6, 1e-5, 400)]
        .map(|(low, high, n)| (low, high, n, rough(shape, low / high).map(|v| v * high)));
    let walled = lanes.map(|_| 1.0);
    let lanes = [(2e-3, 1.0, 620, lanes), (1.0, 1.0, 2000, walled)];
    for (low, high, n, field) in fields.into_iter().chain(lanes) {
        // The last has walls between its lanes, with gaps at alternate ends.
        let gap = |y: usize| if y.is_multiple_of(24) { 0 } else { 259 };
        let is_open =
            |[x, y]: [usize; 2]| n < 2000 || !y.is_multiple_of(12) || y == 0 || x == gap(y);
        let medium = medium::given(field, Form::Divergence).unwrap();
        let medium = medium.with_walls(Mask::new(Grid::from_fn(shape, is_open))).unwrap();
        let heat = engine(&medium, [2.0, 3.0], n, &Exec::new(2).unwrap());
        let mut u = vec![Wide::new(0.0, 0); shape.cells()];
        u[shape.position([2, 3])] = Wide::new(1.0, 0);
        for _ in 0..n {
            let before = u.clone();
            for (cell, u) in u.iter_mut().enumerate() {
                let index = shape.index(cell);
                let mut kept = 1.0;
                let mut inflow = Wide::new(0.0, 0);
                for next in shape.neighbours(cell) {
                    let axis = usize::from(shape.index(next)[0] == index[0]);
                    let weight = heat.step() * conductance(&medium, axis, cell, next);
                    kept -= weight;
                    inflow = inflow.plus(before[next].times(weight));
                }
                *u = before[cell].times(kept).plus(inflow);
            }
        }
        let mut worst: f64 = 0.0;
        for (cell, exact) in u.iter().enumerate() {
            let ln_u = heat.ln_temperature().values()[cell];
            if exact.value == 0.0 {
                assert_eq!(ln_u, f64::NEG_INFINITY);
                continue;
            }
            assert!(ln_u.is_finite(), "cell {:?} was lost (medium from {low})", shape.index(cell));
            worst = worst.max((ln_u - exact.ln()).abs() / exact.ln().abs().max(1.0));
        }
        let least = u.iter().map(|u| u.ln()).filter(|ln| ln.is_finite()).fold(0.0, f64::min);
        println!("medium {low} to {high}: ln u down to {least:.0}, error {worst:.1e}");
        // Distances are the square root of the logarithm: half of this relative error.
        assert!(worst < 1e-6, "{worst}");
    }
}

/// Wherever the range of numbers ends, heat says so; it never leaves a hole.
#[test]
fn a_medium_beyond_any_range_is_refused() {
    let shape = Shape::new([40, 12]).unwrap();
    let slow = |value: f64| {
        let field = Grid::from_fn(shape, |[x, _]| if (10..20).contains(&x) { value } else { 1.0 });
        let medium = medium::given(field, Form::Divergence).unwrap();
        let sources = Sources::new(&[[3.0, 3.0]], medium.mask()).unwrap();
        Explicit::new(&medium, HeatOptions::default())
            .unwrap()
            .flow(&sources, &Exec::single_threaded())
            .map(|heat| heat.ln_temperature().values().iter().all(|ln| ln.is_finite()))
    };
    assert_eq!(slow(1e-12), Ok(true));
    assert_eq!(slow(1e-100), Err(HeatError::Range));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    #[test]
    fn any_picture(
        width in 1_usize..90, height in 1_usize..90, n in 1_usize..40,
        x in 0.0..1.0, y in 0.0..1.0, low in 0.01..1.0, pointwise: bool,
    ) {
        let shape = Shape::new([width, height]).unwrap();
        let form = if pointwise { Form::Pointwise } else { Form::Divergence };
        let medium = medium::given(rough(shape, low), form).unwrap();
        let source = [(x * width as f64) as usize, (y * height as f64) as usize];
        assert_agrees(&medium, source, n, &Exec::single_threaded());
    }
}
