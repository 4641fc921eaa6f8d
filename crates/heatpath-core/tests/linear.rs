//! The sparse solver against the simplest one: a dense factorisation with floats of any range.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_core::Exec;
use heatpath_core::linear::{Analysis, Cholesky, LinearError, Wide};
use proptest::prelude::*;
use std::sync::Arc;

/// A small system with couplings that are not positive.
#[derive(Clone, Debug)]
struct System {
    diagonal: Vec<f64>,
    pairs: Vec<[usize; 2]>,
    couplings: Vec<f64>,
}

impl System {
    fn cholesky(&self) -> Cholesky {
        let analysis = Analysis::new(self.diagonal.len(), self.pairs.clone(), 1 << 28).unwrap();
        let exec = Exec::single_threaded();
        Cholesky::new(Arc::new(analysis), &self.diagonal, &self.couplings, &exec).unwrap()
    }

    /// Gaussian elimination without a thought for zeros.
    fn dense_solution(&self, source: usize) -> Vec<Wide> {
        let n = self.diagonal.len();
        let mut a = vec![vec![Wide::ZERO; n]; n];
        let mut x = vec![Wide::ZERO; n];
        x[source] = Wide::from(1.0);
        self.diagonal.iter().enumerate().for_each(|(i, &value)| a[i][i] = Wide::from(value));
        for (&[i, j], &value) in self.pairs.iter().zip(&self.couplings) {
            a[i][j] = a[i][j].plus(Wide::from(value));
            a[j][i] = a[i][j];
        }
        let over = |value: Wide| value.ln();
        for pivot in 0..n {
            for row in pivot + 1..n {
                let factor = ratio(a[row][pivot], a[pivot][pivot]);
                let above = a[pivot].clone();
                for (entry, above) in a[row].iter_mut().zip(above).skip(pivot) {
                    *entry = entry.plus(negative(product(factor, above)));
                }
                x[row] = x[row].plus(negative(product(factor, x[pivot])));
            }
        }
        for row in (0..n).rev() {
            for column in row + 1..n {
                x[row] = x[row].plus(negative(product(a[row][column], x[column])));
            }
            x[row] = ratio(x[row], a[row][row]);
            assert!(x[row].is_zero() || over(x[row]).is_finite());
        }
        x
    }
}

fn negative(a: Wide) -> Wide {
    a.times(-1.0)
}

/// The product of two floats, one of which has its range taken apart.
fn product(a: Wide, b: Wide) -> Wide {
    let (value, exponent) = b.parts();
    a.times(value).shifted(exponent)
}

fn ratio(a: Wide, b: Wide) -> Wide {
    let (value, exponent) = b.parts();
    a.times(1.0 / value).shifted(-exponent)
}

fn assert_solves(system: &System, source: usize) {
    let exec = Exec::single_threaded();
    let solution = system.cholesky().solve(&[vec![(source, Wide::from(1.0))]], &exec);
    for (i, (x, exact)) in solution[0].iter().zip(system.dense_solution(source)).enumerate() {
        assert_eq!(x.is_zero(), exact.is_zero(), "unknown {i}");
        if !x.is_zero() {
            let error = (x.ln() - exact.ln()).abs();
            assert!(error < 1e-12 * (1.0 + exact.ln().abs()), "unknown {i}: {error:e}");
        }
    }
}

/// A chain of unknowns, each coupled to the next, whose solution falls by `decay` from one to the
/// next.
fn chain(n: usize, decay: f64) -> System {
    let pairs: Vec<[usize; 2]> = (1..n).map(|i| [i - 1, i]).collect();
    System { diagonal: vec![decay + 1.0 / decay; n], couplings: vec![-1.0; pairs.len()], pairs }
}

#[test]
fn a_chain_far_beyond_the_range_of_f64() {
    let system = chain(300, 1e10);
    assert_solves(&system, 40);
    let exec = Exec::single_threaded();
    let x = &system.cholesky().solve(&[vec![(0, Wide::from(1.0))]], &exec)[0];
    assert!((x[299].ln() + 300.0 * 1e10_f64.ln()).abs() < 1e-9, "{}", x[299].ln());
}

#[test]
fn unknowns_of_very_different_size() {
    let mut system = chain(60, 3.0);
    for i in 0..60 {
        let scale = 10_f64.powi(i as i32 % 7 * 20 - 60);
        system.diagonal[i] *= scale * scale;
        for (pair, coupling) in system.pairs.iter().zip(&mut system.couplings) {
            if pair.contains(&i) {
                *coupling *= scale;
            }
        }
    }
    assert_solves(&system, 31);
}

#[test]
fn several_entries_and_several_sides() {
    let system = chain(50, 2.0);
    let cholesky = system.cholesky();
    let exec = Exec::single_threaded();
    let side = |i: usize| vec![(i, Wide::from(1.0))];
    let one = |i: usize| cholesky.solve(&[side(i)], &exec).remove(0);
    let sides: Vec<_> = (0..50).map(side).collect();
    for threads in [1, 2, 3] {
        let many = cholesky.solve(&sides, &Exec::new(threads).unwrap());
        (0..50).for_each(|i| assert_eq!(many[i], one(i), "side {i}, {threads} threads"));
    }
    let both = cholesky.solve(&[vec![(3, Wide::from(2.0)), (30, Wide::from(1.0))]], &exec);
    for (i, x) in both[0].iter().enumerate() {
        let sum = one(3)[i].times(2.0).plus(one(30)[i]);
        assert!((x.ln() - sum.ln()).abs() < 1e-13);
    }
    assert_eq!(cholesky.solve(&[], &exec), Vec::<Vec<Wide>>::new());
    assert!(cholesky.solve(&[vec![]], &exec)[0].iter().all(|x| x.is_zero()));
}

#[test]
fn other_values_give_what_a_new_factor_gives() {
    let (first, second) = (chain(80, 2.0), chain(80, 7.0));
    let exec = Exec::single_threaded();
    let mut cholesky = first.cholesky();
    cholesky.refactor(&second.diagonal, &second.couplings, &exec).unwrap();
    let sides = [vec![(5, Wide::from(1.0))]];
    let fresh = second.cholesky().solve(&sides, &exec);
    assert_eq!(cholesky.solve(&sides, &exec), fresh);
}

#[test]
fn what_cannot_be_factored_is_refused() {
    let too_large = Analysis::new(1000, Vec::new(), 100).unwrap_err();
    assert!(matches!(too_large, LinearError::TooLarge { needed: 8000.., limit: 100 }));
    let message = LinearError::TooLarge { needed: 3 << 29, limit: 1 << 30 }.to_string();
    assert_eq!(message, "the factorisation needs 1.5 GiB of memory, 1.0 GiB are allowed");
    for ends in [[0, 0], [1, 3]] {
        let refused = LinearError::Coupling { number: 0, ends, unknowns: 3 };
        assert_eq!(Analysis::new(3, vec![ends], 1 << 20).unwrap_err(), refused);
    }
    let pair = Arc::new(Analysis::new(2, vec![[0, 1]], 1 << 20).unwrap());
    let exec = Exec::single_threaded();
    let factor = |diagonal: &[f64], couplings: &[f64]| {
        Cholesky::new(Arc::clone(&pair), diagonal, couplings, &exec).map(|_| ())
    };
    let not_definite = |unknown| Err(LinearError::NotPositiveDefinite(unknown));
    assert_eq!(factor(&[1.0, 1.0], &[-0.5]), Ok(()));
    assert_eq!(factor(&[1.0, 1.0], &[-2.0]), not_definite(1));
    assert_eq!(factor(&[0.0, 1.0], &[0.0]), not_definite(0));
    assert_eq!(factor(&[1.0, f64::NAN], &[0.0]), not_definite(1));
    assert!(matches!(
        factor(&[1.0], &[0.0]),
        Err(LinearError::Length { expected: 2, given: 1, .. })
    ));
    assert!(matches!(
        factor(&[1.0; 2], &[]),
        Err(LinearError::Length { expected: 1, given: 0, .. })
    ));
}

/// Both ends of a long chain last: all between them makes one entry that f64 cannot hold.
#[test]
fn what_the_factor_loses_is_made_up_for() {
    let n = 250;
    let mut system = chain(n, 1e9);
    assert_eq!(system.cholesky().lost(), 0);
    system.pairs = (1..n).map(|i| [(i + n - 2) % n, (i + n - 1) % n]).collect();
    assert!(system.cholesky().lost() > 0);
    for source in [n - 1, n - 2, 0, 100] {
        assert_solves(&system, source);
    }
}

fn any_system() -> impl Strategy<Value = System> {
    (2_usize..40, 0.0..20.0_f64).prop_flat_map(|(n, contrast)| {
        let pair = (0..n, 1..n).prop_map(move |(a, step)| [a, (a + step) % n]);
        let weight = (0.0..1.0_f64).prop_map(move |u| -10_f64.powf(-contrast * u));
        proptest::collection::vec((pair, weight), 0..3 * n).prop_map(move |edges| {
            let (pairs, couplings): (Vec<[usize; 2]>, Vec<f64>) = edges.into_iter().unzip();
            let mut diagonal = vec![1e-3; n];
            for (pair, coupling) in pairs.iter().zip(&couplings) {
                pair.iter().for_each(|&i| diagonal[i] -= coupling);
            }
            System { diagonal, pairs, couplings }
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn any_graph(system in any_system(), source in 0_usize..40) {
        assert_solves(&system, source % system.diagonal.len());
    }
}
