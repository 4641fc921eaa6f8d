//! Voting: the paper's rules in numbers, and trees of which the centrelines are known.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod support;
#[path = "support/tree.rs"]
mod tree;

use heatpath_core::Exec;
use heatpath_core::exec::Cancelled;
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::heat::{Duration, Explicit, Heat, HeatError, HeatOptions};
use heatpath_core::grid::medium::{self, Form, Medium};
use heatpath_core::grid::path::{Descent, Ending, PathOptions};
use heatpath_core::grid::voting::{
    Counting, Ends, FastMarchingVotingOptions, Growth, Method, Stop, Votes, VotingError,
    VotingOptions, covered, density, front, vote, vote_by_fast_marching,
};
use heatpath_core::grid::{Grid, Mask, Shape, Sources, structure};
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use support::{euclidean, random, rough};
use tree::{Branch, picture, recall_and_precision, tree};

fn options(method: Method) -> VotingOptions {
    VotingOptions { method, ..VotingOptions::default() }
}

fn heat<const D: usize>(medium: &Medium<D>, points: &[[f64; D]], steps: usize) -> Heat<D> {
    let duration = Duration::Iterations(steps);
    let explicit = Explicit::new(medium, HeatOptions { duration, ..Default::default() }).unwrap();
    let sources = Sources::new(points, medium.mask()).unwrap();
    explicit.flow(&sources, &Exec::single_threaded()).unwrap()
}

fn ends_on_front<const D: usize>(heat: &Heat<D>, level: f64) -> Vec<[f64; D]> {
    let front = front(&covered(heat, level));
    front.into_iter().map(|cell| heat.shape().centre(cell)).collect()
}

fn ends_in_structure(heat: &Heat<2>, medium: &Medium<2>, growth: Growth) -> Vec<[f64; 2]> {
    let covered = covered(heat, 400.0);
    let is_end =
        |&cell: &usize| covered.values()[cell] && medium.speed_sq(cell) >= growth.least_speed_sq;
    (0..heat.shape().cells()).filter(is_end).map(|cell| heat.shape().centre(cell)).collect()
}

/// Equation (23) as it is written: a set of cells for each path, found by walking along it in tiny
/// steps.
fn brute_force<const D: usize>(
    descent: &Descent<'_, D>,
    heat: &Heat<D>,
    ends: &[[f64; D]],
) -> Grid<u32, D> {
    let distances = normalized(heat);
    let mut density = Grid::from_fn(*heat.shape(), |_| 0);
    for &end in ends {
        let path = descent.path(end, &distances, PathOptions::default()).unwrap();
        if !matches!(path.ending, Ending::Source(_)) {
            continue;
        }
        let mut cells = HashSet::from([heat.shape().cell_at(end)]);
        for pair in path.points.windows(2) {
            for i in 1..=400 {
                let s = f64::from(i) / 400.0;
                let point =
                    std::array::from_fn(|axis| pair[0][axis] + s * (pair[1][axis] - pair[0][axis]));
                cells.insert(heat.shape().cell_at(point));
            }
        }
        cells.into_iter().for_each(|cell| density[cell] += 1);
    }
    density
}

fn check_density<const D: usize>(medium: &Medium<D>, points: &[[f64; D]], level: f64) {
    let heat = heat(medium, points, 60);
    let descent = Descent::new(&heat, medium).unwrap();
    let ends = ends_on_front(&heat, level);
    let exec = Exec::single_threaded();
    let found = density(&descent, &ends, Counting::Traced, None, &exec).unwrap();
    let expected = brute_force(&descent, &heat, &ends);
    // A corner of a cell cut by less than a tiny step is all that the oracle may miss.
    let pairs = found.values().iter().zip(expected.values());
    assert!(pairs.clone().all(|(found, expected)| found >= expected));
    let [total, missed] = [
        pairs.clone().map(|(found, _)| u64::from(*found)).sum::<u64>(),
        pairs.map(|(found, expected)| u64::from(found - expected)).sum(),
    ];
    assert!(ends.len() > 20 && missed * 200 < total, "{missed} of {total}");
}

#[test]
fn the_density_is_that_of_the_paths() {
    for (seed, walls) in [(1, 0.0), (2, 0.15), (3, 0.3)] {
        let shape = Shape::with_spacing([48, 40], [1.0, 1.5]).unwrap();
        let (medium, source) = rough(shape, 1.0, Form::Pointwise, walls, seed);
        check_density(&medium, &[source], 60.0);
        let (medium, source) =
            rough(Shape::new([14, 13, 12]).unwrap(), 1.0, Form::Pointwise, walls, seed);
        check_density(&medium, &[source], 20.0);
    }
    let uniform = medium::uniform(Shape::new([60, 50]).unwrap());
    check_density(&uniform, &[[20.0, 20.5], [44.3, 30.0], [44.0, 31.0]], 20.0);
}

#[test]
fn all_paths_meet_in_the_source() {
    let medium = medium::uniform(Shape::new([41, 41]).unwrap());
    let heat = heat(&medium, &[[20.0, 20.0]], 60);
    let ends = ends_on_front(&heat, 3.0);
    for counting in [Counting::Traced, Counting::Flow] {
        let descent = Descent::new(&heat, &medium).unwrap();
        let votes = density(&descent, &ends, counting, None, &Exec::single_threaded()).unwrap();
        assert_eq!(votes[[20, 20]], ends.len() as u32);
        assert_eq!(votes.values().iter().max(), Some(&votes[[20, 20]]));
        ends.iter().for_each(|&end| assert!(votes[heat.shape().cell_at(end)] >= 1));
    }
}

/// A tree of 300 x 300 cells with its picture.
fn generated_tree() -> (Vec<Branch<2>>, Grid<f64, 2>) {
    let mut random = random(7);
    let branches = tree(300, &mut random);
    let image = picture(Shape::new([300, 300]).unwrap(), &branches, 0.05, &mut random);
    (branches, image)
}

/// Two media for the picture of a tree, and where they are fast.
fn media(image: &Grid<f64, 2>) -> [(&'static str, Medium<2>, Growth); 2] {
    let exec = Exec::single_threaded();
    let conductivity = medium::conductivity(image, &[0.8], Default::default()).unwrap();
    let vesselness = medium::vesselness(image, &Default::default(), &exec).unwrap();
    [
        ("conductivity", conductivity, Growth::new(0.45)),
        ("vesselness", vesselness, Growth::new(0.15)),
    ]
}

#[test]
fn a_tree_is_found() {
    let (branches, image) = generated_tree();
    let exec = Exec::new(2).unwrap();
    for (name, medium, growth) in media(&image) {
        let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
        let measure = |votes: &Votes<2>| recall_and_precision(&votes.kept, &branches, 2.0);
        let mut found = Vec::new();
        for method in [Method::Front, Method::Multiple, Method::Accumulated] {
            for growth in [None, Some(growth)] {
                let options = VotingOptions { growth, ..options(method) };
                let votes = vote(&medium, &sources, &options, &exec).unwrap();
                let (recall, precision) = measure(&votes);
                println!(
                    "{name}, {method:?}, growth {}: recall {recall:.3}, precision {precision:.3}, \
                     {} rounds, {:?}",
                    growth.is_some(),
                    votes.rounds.len(),
                    votes.stopped
                );
                found.push((recall, precision));
            }
        }
        let recall = found[5].0;
        for (recall, precision) in [found[1], found[3], found[5]] {
            assert!(recall >= 0.95 && precision >= 0.95, "{name}: {recall}, {precision}");
        }
        assert!(found[4].1 < 0.6, "{name}: the paper's rules alone run on into the background");
        assert!(found[0].0 < 0.8 && found[2].0 < 0.4, "{name}: the front misses branches");
        let baseline =
            vote_by_fast_marching(&medium, &sources, &Default::default(), &exec).unwrap();
        println!("{name}, fast marching: {:.3?}", measure(&baseline));
        assert!(measure(&baseline).0 < recall, "{name}");
    }
}

#[test]
fn with_growth_votes_cross_the_structure_and_little_else() {
    let (branches, image) = generated_tree();
    for (name, medium, growth) in media(&image) {
        let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
        let options = VotingOptions { growth: Some(growth), ..Default::default() };
        let votes = vote(&medium, &sources, &options, &Exec::new(2).unwrap()).unwrap();
        let (crossed, structure) = (votes.crossed(), structure(&medium, growth.least_speed_sq));
        let cells = || crossed.values().iter().zip(structure.values());
        assert!(
            votes.kept.values().iter().zip(crossed.values()).all(|(kept, crossed)| kept <= crossed)
        );
        let both = cells().filter(|(a, b)| **a && **b).count() as f64;
        let parts = [&structure, &crossed]
            .map(|grid| both / grid.values().iter().filter(|&&inside| inside).count() as f64);
        println!("{name}: of the structure and of what is crossed both are {parts:.3?}");
        // Noise has made specks of structure that hang together with nothing.
        assert!(parts[0] > 0.9 && parts[1] > 0.95, "{name}: {parts:?}");
    }
}

/// The share of the cells in `a` with a cell of `b` at most one away.
fn share_within_one_cell(a: &Grid<bool, 2>, b: &Grid<bool, 2>) -> f64 {
    let shape = a.shape();
    let cells_of = |grid: &Grid<bool, 2>| -> Vec<[f64; 2]> {
        let cells = (0..shape.cells()).filter(|&cell| grid.values()[cell]);
        cells.map(|cell| shape.centre(cell)).collect()
    };
    let (a, b) = (cells_of(a), cells_of(b));
    let near = |p: &&[f64; 2]| b.iter().any(|&q| euclidean(**p, q) < 1.5);
    a.iter().filter(near).count() as f64 / a.len() as f64
}

#[test]
fn flowing_votes_agree_with_traced_ones() {
    let (branches, image) = generated_tree();
    let exec = Exec::new(2).unwrap();
    for (name, medium, growth) in media(&image) {
        let heat = heat(&medium, &[branches[0].from], 600);
        let descent = Descent::new(&heat, &medium).unwrap();
        for growth in [None, Some(growth)] {
            let ends = growth.map_or_else(
                || ends_on_front(&heat, 400.0),
                |growth| ends_in_structure(&heat, &medium, growth),
            );
            let kept = [Counting::Traced, Counting::Flow].map(|counting| {
                let votes = density(&descent, &ends, counting, growth, &exec).unwrap();
                let largest = f64::from(*votes.values().iter().max().unwrap());
                let least = growth.map_or(largest / 30.0, |growth| f64::from(growth.least_votes));
                votes.map(|&votes| f64::from(votes) > least)
            });
            let shares = [(0, 1), (1, 0)].map(|(a, b)| share_within_one_cell(&kept[a], &kept[b]));
            println!("{name}, {} ends, growth {}: {shares:.4?}", ends.len(), growth.is_some());
            // In the background, where no valley leads them, paths may join another way.
            let least = if growth.is_some() { 0.99 } else { 0.85 };
            assert!(shares.iter().all(|&share| share > least), "{name}: {shares:?}");
        }
    }
}

#[test]
fn rounds_keep_to_the_thresholds_and_to_algorithm_1() {
    let (branches, image) = generated_tree();
    let [(_, medium, _), _] = media(&image);
    let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
    let exec = Exec::new(2).unwrap();

    let front = vote(&medium, &sources, &options(Method::Front), &exec).unwrap();
    assert_eq!((front.rounds.len(), front.stopped), (1, Stop::Rounds));
    let heat = heat(&medium, sources.points(), 600);
    let ends = ends_on_front(&heat, 240.0);
    assert_eq!(front.rounds[0].ends, ends.len(), "2N steps");
    let largest = front.rounds[0].largest_density;
    for (cell, &kept) in front.kept.values().iter().enumerate() {
        let votes = front.density.values()[cell];
        assert_eq!(kept, 30 * votes > largest, "{votes} of {largest}");
    }

    let accumulated = vote(&medium, &sources, &options(Method::Accumulated), &exec).unwrap();
    let mut kept_before = 1;
    for (number, round) in accumulated.rounds.iter().enumerate() {
        assert_eq!(round.kept, kept_before + round.new);
        let is_last = number + 1 == accumulated.rounds.len();
        let settled = kept_before as f64 > 0.95 * round.kept as f64;
        assert_eq!(is_last, settled || 30 * round.kept > 90_000, "round {number}: {round:?}");
        kept_before = round.kept;
    }
    assert_eq!(accumulated.stopped, Stop::LargestShare);
    assert_eq!(accumulated.kept.values().iter().filter(|&&kept| kept).count(), kept_before);

    let multiple = vote(&medium, &sources, &options(Method::Multiple), &exec).unwrap();
    assert_eq!(multiple.stopped, Stop::Settled);
    let rounds = multiple.rounds.windows(2);
    rounds.for_each(|pair| assert!(pair[1].covered > pair[0].covered, "heat flows on"));

    let three = VotingOptions { rounds: 3, ..options(Method::Accumulated) };
    let three = vote(&medium, &sources, &three, &exec).unwrap();
    assert_eq!((&three.rounds[..], three.stopped), (&accumulated.rounds[..3], Stop::Rounds));
}

#[test]
fn with_growth_votes_are_the_cells_of_the_structure_beyond() {
    let speed_sq = |[x, y]: [usize; 2]| if y == 4 && x < 60 && x != 30 { 1.0 } else { 1e-2 };
    let shape = Shape::new([70, 9]).unwrap();
    let medium = medium::given(Grid::from_fn(shape, speed_sq), Form::Pointwise).unwrap();
    let sources = Sources::new(&[[0.0, 4.0]], medium.mask()).unwrap();
    for counting in [Counting::Traced, Counting::Flow] {
        let options = VotingOptions {
            counting: Some(counting),
            growth: Some(Growth { least_votes: 7, ..Growth::new(0.5) }),
            largest_share: 0.0,
            level: Some(1e6),
            steps: Some(200),
            ..VotingOptions::default()
        };
        let votes = vote(&medium, &sources, &options, &Exec::single_threaded()).unwrap();
        assert_eq!((votes.rounds[0].ends, votes.stopped), (59, Stop::Settled));
        let once = VotingOptions { rounds: 1, ..options };
        let once = vote(&medium, &sources, &once, &Exec::single_threaded()).unwrap();
        for cell in 0..shape.cells() {
            let [x, y] = shape.index(cell);
            let beyond = if y == 4 { 60_usize.saturating_sub(x) } else { 0 };
            let expected = if x > 30 || beyond == 0 { beyond } else { beyond - 1 };
            assert_eq!(once.density.values()[cell] as usize, expected, "{x}, {y}: {counting:?}");
            assert_eq!(once.kept.values()[cell], expected > 7, "{x}, {y}");
        }
        let growth = Some(Growth { gap: 0.5, ..Growth::new(0.5) });
        let cut = VotingOptions { growth, ..options };
        let cut = vote(&medium, &sources, &cut, &Exec::single_threaded()).unwrap();
        assert!(cut.kept[[18, 4]] && (30..60).all(|x| cut.density[[x, 4]] == 0), "cut at x = 30");
    }
}

#[test]
fn heat_that_flows_on_is_heat_that_flowed_longer() {
    let (branches, image) = generated_tree();
    let [(_, medium, _), _] = media(&image);
    let exec = Exec::new(2).unwrap();
    let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
    let options = VotingOptions { rounds: 3, ..options(Method::Multiple) };
    let votes = vote(&medium, &sources, &options, &exec).unwrap();
    let mut sum = image.map(|_| 0);
    for (number, round) in votes.rounds.iter().enumerate() {
        let heat = heat(&medium, sources.points(), 100 * (number + 1));
        let ends = ends_on_front(&heat, 240.0);
        assert_eq!(round.ends, ends.len());
        let descent = Descent::new(&heat, &medium).unwrap();
        let density = density(&descent, &ends, Counting::Traced, None, &exec).unwrap();
        sum.values_mut().iter_mut().zip(density.values()).for_each(|(sum, votes)| *sum += votes);
    }
    assert_eq!(votes.density, sum);
}

#[test]
fn far_below_the_level_heat_may_leave_the_range_of_numbers() {
    let is_line = |[_, y]: [usize; 2]| y == 20;
    let shape = Shape::new([150, 41]).unwrap();
    let speed_sq = Grid::from_fn(shape, |index| if is_line(index) { 1.0 } else { 1e-99 });
    let medium = medium::given(speed_sq, Form::Pointwise).unwrap();
    let sources = Sources::new(&[[0.0, 20.0]], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let heat = Explicit::new(&medium, HeatOptions::default()).unwrap().flow(&sources, &exec);
    assert_eq!(heat.err(), Some(HeatError::Range));
    for method in [Method::Front, Method::Multiple, Method::Accumulated] {
        let options = VotingOptions { growth: Some(Growth::new(0.5)), ..options(method) };
        let votes = vote(&medium, &sources, &options, &exec).unwrap();
        let far = if method == Method::Multiple { 60 } else { 130 };
        for cell in 0..shape.cells() {
            let index = shape.index(cell);
            let kept = votes.kept.values()[cell];
            assert!(if is_line(index) { kept || index[0] > far } else { !kept }, "{index:?}");
        }
    }
    let options = VotingOptions { level: Some(1e6), ..options(Method::Front) };
    let error = vote(&medium, &sources, &options, &exec).err();
    assert_eq!(error, Some(VotingError::Heat(HeatError::Range)));
}

#[test]
fn threads_change_nothing() {
    let (branches, image) = generated_tree();
    let [_, (_, medium, growth)] = media(&image);
    let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
    for counting in [Counting::Traced, Counting::Flow] {
        let (counting, growth) = (Some(counting), Some(growth));
        let options = VotingOptions { counting, growth, ..options(Method::Accumulated) };
        let votes = [1, 2, 3].map(|threads| {
            let exec = Exec::new(threads).unwrap();
            vote(&medium, &sources, &options, &exec).unwrap()
        });
        assert_eq!(votes[0], votes[1]);
        assert_eq!(votes[0], votes[2]);
    }
}

#[test]
fn walls_stop_votes() {
    let mut random = random(3);
    let shape = Shape::new([90, 60]).unwrap();
    let branch = |from, to| Branch { from, to, radius: 2.5 };
    let branches = [branch([10.0, 30.0], [80.0, 30.0]), branch([30.0, 30.0], [60.0, 8.0])];
    let image = picture(shape, &branches, 0.02, &mut random);
    let walls = Mask::new(Grid::from_fn(shape, |[x, _]| x != 50));
    let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
    let medium = medium.with_walls(walls).unwrap();
    let sources = Sources::new(&[[12.0, 30.0]], medium.mask()).unwrap();
    let growth = Some(Growth::new(0.45));
    for counting in [Counting::Traced, Counting::Flow] {
        let options =
            VotingOptions { counting: Some(counting), growth, ..VotingOptions::default() };
        let votes = vote(&medium, &sources, &options, &Exec::single_threaded()).unwrap();
        let reached = (0..50).filter(|&x| votes.kept[[x, 30]]).count();
        assert!(reached > 30, "{reached}");
        for cell in 0..shape.cells() {
            let beyond = shape.index(cell)[0] >= 50;
            assert!(!beyond || votes.density.values()[cell] == 0 && !votes.kept.values()[cell]);
        }
    }
}

#[test]
fn each_source_finds_its_own_tree() {
    let mut random = random(4);
    let shape = Shape::new([120, 80]).unwrap();
    let branch = |from, to| Branch { from, to, radius: 2.5 };
    let branches = [
        branch([10.0, 20.0], [110.0, 20.0]),
        branch([50.0, 20.0], [70.0, 5.0]),
        branch([10.0, 60.0], [110.0, 60.0]),
    ];
    let image = picture(shape, &branches, 0.02, &mut random);
    let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
    let growth = Some(Growth::new(0.45));
    let options = VotingOptions { growth, ..VotingOptions::default() };
    let recall = |points: &[[f64; 2]]| {
        let sources = Sources::new(points, medium.mask()).unwrap();
        let votes = vote(&medium, &sources, &options, &Exec::single_threaded()).unwrap();
        recall_and_precision(&votes.kept, &branches, 2.0)
    };
    let (one, both) = (recall(&[[12.0, 20.0]]), recall(&[[12.0, 20.0], [108.0, 60.0]]));
    println!("one source {one:.3?}, two {both:.3?}");
    assert!(one.0 < 0.6 && both.0 > 0.95 && both.1 > 0.9, "{one:?} {both:?}");
}

#[test]
fn tubes_that_branch_in_space_are_found() {
    let mut random = random(5);
    let shape = Shape::new([44, 40, 36]).unwrap();
    let branch = |from, to| Branch { from, to, radius: 2.0 };
    let fork = [22.0, 20.0, 16.0];
    let branches = [
        branch([22.0, 20.0, 3.0], fork),
        branch(fork, [8.0, 10.0, 30.0]),
        branch(fork, [37.0, 12.0, 30.0]),
        branch(fork, [24.0, 34.0, 31.0]),
    ];
    let image = picture(shape, &branches, 0.05, &mut random);
    let medium = medium::conductivity(&image, &[0.8], Default::default()).unwrap();
    let sources = Sources::new(&[branches[0].from], medium.mask()).unwrap();
    let growth = Some(Growth::new(0.45));
    for counting in [Counting::Traced, Counting::Flow] {
        let options =
            VotingOptions { counting: Some(counting), growth, ..VotingOptions::default() };
        let votes = vote(&medium, &sources, &options, &Exec::new(2).unwrap()).unwrap();
        let (recall, precision) = recall_and_precision(&votes.kept, &branches, 2.0);
        println!("{counting:?}: {recall:.3}, {precision:.3}, {:?}", votes.rounds.last());
        assert!(recall > 0.95 && precision > 0.95, "{recall}, {precision}");
    }
}

#[test]
fn a_picture_that_is_all_covered_votes_from_its_border() {
    let medium = medium::uniform(Shape::new([30, 20]).unwrap());
    let sources = Sources::new(&[[12.0, 9.0]], medium.mask()).unwrap();
    let options = VotingOptions { level: Some(1e6), ..options(Method::Front) };
    let votes = vote(&medium, &sources, &options, &Exec::single_threaded()).unwrap();
    let round = votes.rounds[0];
    assert_eq!((round.covered, round.ends), (600, 2 * 30 + 2 * 18));
    assert_eq!(round.largest_density, 96);
    let ends = Ends::Border;
    let options = FastMarchingVotingOptions { ends, ..FastMarchingVotingOptions::default() };
    let exec = Exec::single_threaded();
    let votes = vote_by_fast_marching(&medium, &sources, &options, &exec).unwrap();
    assert_eq!((votes.rounds[0].covered, votes.rounds[0].ends), (600, 96));
    assert_eq!(votes.density[[12, 9]], 96);
}

#[test]
fn one_cell_is_found_at_once() {
    fn check<const D: usize>() {
        let medium = medium::uniform(Shape::new([1; D]).unwrap());
        let sources = Sources::new(&[[0.2; D]], medium.mask()).unwrap();
        let exec = Exec::single_threaded();
        for method in [Method::Front, Method::Multiple, Method::Accumulated] {
            for counting in [Counting::Traced, Counting::Flow] {
                let options = VotingOptions { counting: Some(counting), ..options(method) };
                let votes = vote(&medium, &sources, &options, &exec).unwrap();
                assert_eq!((votes.density.values(), votes.kept.values()), (&[1][..], &[true][..]));
                assert_eq!(votes.stopped, Stop::LargestShare);
            }
        }
        let votes = vote_by_fast_marching(&medium, &sources, &Default::default(), &exec).unwrap();
        assert_eq!(votes.density.values(), [500]);
    }
    check::<2>();
    check::<3>();
}

#[test]
fn a_source_outside_of_the_structure_finds_nothing() {
    let medium = medium::uniform(Shape::new([30, 20]).unwrap());
    let sources = Sources::new(&[[12.0, 9.0]], medium.mask()).unwrap();
    for counting in [Counting::Traced, Counting::Flow] {
        let growth = Some(Growth::new(2.0));
        let options =
            VotingOptions { growth, counting: Some(counting), ..VotingOptions::default() };
        let votes = vote(&medium, &sources, &options, &Exec::single_threaded()).unwrap();
        assert_eq!(votes.kept.values().iter().filter(|&&kept| kept).count(), 1);
        assert_eq!((votes.rounds.len(), votes.stopped), (1, Stop::Settled));
    }
}

#[test]
fn random_ends_follow_their_seed() {
    let (medium, source) = rough(Shape::new([40, 30]).unwrap(), 1.0, Form::Pointwise, 0.2, 9);
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    let votes = |seed| {
        let ends = Ends::Random { count: 50, seed };
        let options = FastMarchingVotingOptions { ends, ..Default::default() };
        vote_by_fast_marching(&medium, &sources, &options, &Exec::single_threaded()).unwrap()
    };
    assert_eq!(votes(1), votes(1));
    assert_ne!(votes(1).density, votes(2).density);
    assert_eq!(votes(1).rounds[0].ends, 50);
}

#[test]
fn voting_can_be_cancelled_at_any_report() {
    let medium = medium::uniform(Shape::new([40, 30]).unwrap());
    let sources = Sources::new(&[[12.0, 9.0]], medium.mask()).unwrap();
    let reports = Mutex::new(Vec::new());
    let watching = Exec::single_threaded().with_watch(|part| {
        reports.lock().unwrap().push(part);
        ControlFlow::Continue(())
    });
    vote(&medium, &sources, &VotingOptions::default(), &watching).unwrap();
    let reports = reports.lock().unwrap().clone();
    assert!(reports.is_sorted() && reports.last() == Some(&1.0), "{reports:?}");
    for last in [0, 1, reports.len() / 2, reports.len() - 2] {
        let calls = AtomicUsize::new(0);
        let exec = Exec::single_threaded().with_watch(|_| {
            match calls.fetch_add(1, Ordering::Relaxed) < last {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        });
        let result = vote(&medium, &sources, &VotingOptions::default(), &exec);
        assert!(
            matches!(
                result,
                Err(VotingError::Cancelled(Cancelled)
                    | VotingError::Heat(HeatError::Cancelled(Cancelled)))
            ),
            "{last}: {result:?}"
        );
    }
}

#[test]
fn bad_parameters_are_named() {
    let medium = medium::uniform(Shape::new([4, 3]).unwrap());
    let sources = Sources::new(&[[1.0, 1.0]], medium.mask()).unwrap();
    let exec = Exec::single_threaded();
    let fine = VotingOptions::default();
    let growth = |least_speed_sq, gap| Some(Growth { gap, ..Growth::new(least_speed_sq) });
    let bad = [
        (VotingOptions { threshold: Some(1.0), ..fine }, "threshold is 1;"),
        (VotingOptions { threshold: Some(f64::NAN), ..fine }, "threshold is NaN;"),
        (VotingOptions { level: Some(0.0), ..fine }, "level is 0;"),
        (VotingOptions { level: Some(f64::INFINITY), ..fine }, "level is inf;"),
        (VotingOptions { largest_share: -0.1, ..fine }, "largest_share is -0.1;"),
        (VotingOptions { settled_share: Some(1.1), ..fine }, "settled_share is 1.1;"),
        (VotingOptions { rounds: 0, ..fine }, "rounds is 0;"),
        (VotingOptions { steps: Some(0), ..fine }, "the number of iterations is 0.0;"),
        (VotingOptions { growth: growth(0.0, 1.0), ..fine }, "least_speed_sq is 0;"),
        (VotingOptions { growth: growth(1.0, -1.0), ..fine }, "gap is -1;"),
    ];
    for (options, begins) in bad {
        let error = vote(&medium, &sources, &options, &exec).unwrap_err().to_string();
        assert!(error.starts_with(begins), "{error}");
    }
    let ends = Ends::Random { count: 0, seed: 1 };
    let bad = [
        (FastMarchingVotingOptions { ends, ..Default::default() }, "count is 0;"),
        (FastMarchingVotingOptions { threshold: -0.1, ..Default::default() }, "threshold is -0.1;"),
    ];
    for (options, begins) in bad {
        let error = vote_by_fast_marching(&medium, &sources, &options, &exec).unwrap_err();
        assert!(error.to_string().starts_with(begins), "{error}");
    }
    let heat = heat(&medium, &[[1.0, 1.0]], 10);
    let descent = Descent::new(&heat, &medium).unwrap();
    let error = density(&descent, &[[9.0, 1.0]], Counting::Traced, None, &exec).unwrap_err();
    assert!(error.to_string().starts_with("end 0 at [9.0, 1.0] lies outside"), "{error}");
    assert!(density(&descent, &[], Counting::Flow, None, &exec).is_err());
}
