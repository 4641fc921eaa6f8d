//! Sparse symmetric positive definite systems `A x = b`: analysed once, factored for each set of
//! values, solved for many right-hand sides.
//!
//! This room knows neither grids nor heat. [`Analysis`] finds the pattern of the factor `L` of
//! `A = L L'` and how much memory it takes; [`Cholesky::new`] computes the factor; and
//! [`Cholesky::solve`] solves. Unknowns are numbered in the order in which they are eliminated: the
//! caller, who knows the geometry, chooses the order.
//!
//! Solutions are [`Wide`]: they may span thousands of orders of magnitude.
//!
//! ```
//! use heatpath_core::Exec;
//! use heatpath_core::linear::{Analysis, Cholesky, Wide};
//! use std::sync::Arc;
//!
//! // A chain of three: A = [[2, -1, 0], [-1, 2, -1], [0, -1, 2]].
//! let exec = Exec::single_threaded();
//! let chain = Arc::new(Analysis::new(3, vec![[0, 1], [1, 2]], 1 << 20)?);
//! let cholesky = Cholesky::new(chain, &[2.0; 3], &[-1.0; 2], &exec)?;
//! let x = cholesky.solve(&[vec![(0, Wide::from(1.0))]], &exec);
//! assert!((x[0][2].ln() - 0.25_f64.ln()).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod analysis;
mod block;
mod cholesky;
mod dissection;
mod pins;
mod plain;
mod refine;
mod solve;
mod wide;

pub use analysis::Analysis;
pub use cholesky::Cholesky;
pub use dissection::nested_dissection;
pub(crate) use pins::{Pin, Pinned};
pub use solve::Entries;
pub use wide::Wide;
pub(crate) use wide::power_of_two;

use crate::exec::Cancelled;
use thiserror::Error;

/// Why a system cannot be solved.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LinearError {
    /// The factor takes more memory than allowed; nothing of that size was allocated.
    #[error(
        "the factorisation needs {} of memory, {} are allowed",
        readable(*.needed),
        readable(*.limit)
    )]
    TooLarge {
        /// The bytes needed, or a part of them that is already too much.
        needed: usize,
        /// The bytes allowed.
        limit: usize,
    },
    /// The operating system refused the memory.
    #[error("{} of memory for the factorisation are not available", readable(*.0))]
    OutOfMemory(usize),
    /// A coupling is not between two different unknowns.
    #[error(
        "the coupling {number} between {ends:?} is not one of two different of {unknowns} unknowns"
    )]
    Coupling {
        /// Which coupling, counted from 0.
        number: usize,
        /// Its two unknowns.
        ends: [usize; 2],
        /// How many unknowns there are.
        unknowns: usize,
    },
    /// The values do not fit the pattern.
    #[error("{given} {what} were given for {expected}")]
    Length {
        /// What was counted: `diagonal values` or `couplings`.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        given: usize,
    },
    /// The matrix is not positive definite: not every diagonal value, or not enough of it, remains
    /// positive.
    #[error("the matrix is not positive definite at unknown {0}")]
    NotPositiveDefinite(usize),
    /// The caller cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

fn readable(bytes: usize) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    if mebibytes < 1024.0 {
        format!("{mebibytes:.1} MiB")
    } else {
        format!("{:.1} GiB", mebibytes / 1024.0)
    }
}
