//! What is asked of a vote.

use super::{Counting, Growth, check_threshold};
use crate::error::{ParameterError, check, check_positive};
use crate::grid::heat::{Duration, HeatOptions};

/// What heat does between two votes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// There is one vote, from the front of heat that has flowed for long (section 4.1.1).
    Front,
    /// Heat flows on from where it is, and the cells kept at all votes are put together (section
    /// 4.1.2).
    Multiple,
    /// Heat begins again from zero, with all cells kept up to now as sources of equal temperature
    /// (section 4.1.3): the paper's best.
    #[default]
    Accumulated,
}

/// The parameters of [`vote`](super::vote).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VotingOptions {
    /// What heat does between two votes; default [`Method::Accumulated`].
    pub method: Method,
    /// The time steps of heat before each vote, at least 1. `None`, the default, takes the paper's:
    /// for the front [`Duration::Usual`], which is 2N for a picture whose longest side has N cells;
    /// 100 for the other two. [`Method::Accumulated`] with [`Growth`] takes 200: on six
    /// retinas (CHASE, STARE) recall and precision within 3 cells are 0.72 and 0.86 for 100 steps, 0.75
    /// and 0.86 for 200, 0.76 and 0.86 for 400, which take 1.2 and 1.9 times as long.
    pub steps: Option<usize>,
    /// Cells are kept whose density is above this part of the largest one of the same round. From 0
    /// to below 1; `None`, the default, takes the paper's: 1/30 for the front, 1/7 for the other two,
    /// which trace fewer paths a round. With [`Growth`] [`Growth::least_votes`] applies instead.
    pub threshold: Option<f64>,
    /// How far below the highest temperature heat still [covers](super::covered) a cell, in
    /// logarithms. Positive; `None`, the default, takes 36 for [`Method::Accumulated`] and 240 for
    /// the other two.
    ///
    /// The paper does not say what is covered. Recall and precision within 2 cells on a generated
    /// tree (300 x 300 cells, branches 2.5 to 8 cells wide, noise), in per cent, without [`Growth`]
    /// and with it, for the [`conductivity`](crate::grid::medium::conductivity()) of eq. (6) and for
    /// [`vesselness`](crate::grid::medium::vesselness()):
    ///
    /// | method | level | conductivity | with growth | vesselness | with growth |
    /// | --- | --- | --- | --- | --- | --- |
    /// | front | 36 | 11, 80 | 12, 100 | 9, 99 | 10, 100 |
    /// | front | 240 | 79, 88 | 98, 100 | 76, 100 | 98, 100 |
    /// | front | 600 | 79, 82 | 98, 100 | 77, 91 | 98, 100 |
    /// | multiple | 36 | 9, 100 | 14, 99 | 8, 100 | 12, 100 |
    /// | multiple | 240 | 22, 95 | 98, 99 | 29, 100 | 98, 100 |
    /// | accumulated | 36 | 97, 48 | 98, 100 | 97, 50 | 98, 100 |
    /// | accumulated | 100 | 90, 46 | 98, 100 | 92, 49 | 99, 100 |
    /// | accumulated | 240 | 89, 46 | 98, 100 | 93, 45 | 98, 100 |
    ///
    /// Votes by fast marching with 500 random ends have 72, 98 and 74, 87. Without growth multiple
    /// votes stop early because cells that were kept before win again and few are new, the second
    /// rule.
    ///
    /// Up to a level of some 1200 heat may fall by any number of powers of ten; above it must stay in
    /// the range of [`Explicit`](crate::grid::heat::Explicit).
    pub level: Option<f64>,
    /// Voting stops when more than this share of the open cells is kept (Algorithm 1). From 0 to 1;
    /// default 1/30. Does not apply with [`Growth`], which knows where the structure ends: the centre
    /// lines of a retina are that share of its picture.
    pub largest_share: f64,
    /// Voting stops when more than this share of the kept cells was kept before (Algorithm 1).
    /// From 0 to 1; `None`, the default, takes the paper's 0.95, and 0.99 with [`Growth`]: of a large tree
    /// many branches have ended when one still grows, which is then few of the cells.
    pub settled_share: Option<f64>,
    /// The most rounds, at least 1; default 100. The front has one.
    pub rounds: usize,
    /// How paths are counted; `None`, the default, takes [`Counting::Flow`] with [`Growth`], which
    /// has many ends, and [`Counting::Traced`] without it.
    pub counting: Option<Counting>,
    /// Whether the structure votes; `None`, the default, is the paper's way: the front does.
    pub growth: Option<Growth>,
}

impl Default for VotingOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            steps: None,
            threshold: None,
            level: None,
            largest_share: 1.0 / 30.0,
            settled_share: None,
            rounds: 100,
            counting: None,
            growth: None,
        }
    }
}

impl VotingOptions {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        check_threshold(self.threshold())?;
        check_positive("level", self.level())?;
        let shares =
            [("largest_share", self.largest_share), ("settled_share", self.settled_share())];
        for (name, share) in shares {
            check(name, share, (0.0..=1.0).contains(&share), "from 0 to 1")?;
        }
        check("rounds", self.rounds as f64, self.rounds > 0, "at least 1")?;
        self.growth.as_ref().map_or(Ok(()), Growth::check)
    }

    pub(super) fn settled_share(&self) -> f64 {
        self.settled_share.unwrap_or(if self.growth.is_some() { 0.99 } else { 0.95 })
    }

    pub(super) fn level(&self) -> f64 {
        self.level.unwrap_or(if self.method == Method::Accumulated { 36.0 } else { 240.0 })
    }

    pub(super) fn threshold(&self) -> f64 {
        self.threshold.unwrap_or(if self.method == Method::Front { 1.0 / 30.0 } else { 1.0 / 7.0 })
    }

    /// The density above which a cell is kept in a round with this largest density.
    pub(super) fn least_votes(&self, largest_density: u32) -> f64 {
        let share = self.threshold() * f64::from(largest_density);
        self.growth.map_or(share, |growth| f64::from(growth.least_votes))
    }

    pub(super) fn counting(&self) -> Counting {
        let usual = if self.growth.is_some() { Counting::Flow } else { Counting::Traced };
        self.counting.unwrap_or(usual)
    }

    pub(super) fn most_rounds(&self) -> usize {
        if self.method == Method::Front { 1 } else { self.rounds }
    }

    /// Heat up to the first vote.
    pub(super) fn heat(&self) -> HeatOptions {
        let duration = match (self.steps, self.method) {
            (Some(steps), _) => Duration::Iterations(steps),
            (None, Method::Front) => Duration::Usual,
            (None, Method::Accumulated) if self.growth.is_some() => Duration::Iterations(200),
            (None, _) => Duration::Iterations(100),
        };
        HeatOptions { duration, ..HeatOptions::default() }
    }
}
