//! The figures of geodesic voting: 12 to 14 and 16 to 18.

use super::panels::{
    BLUE, RED, band, below, distance_panel, dot, draw_paths, grey_panel, ground, pixel,
};
use super::scenes::{ROOT, Scene, VESSEL_ROOT, catheter, on_the_catheter, tree, vessels};
use super::{alpha, assert_figure, beside, panel};
use heatpath_core::Exec;
use heatpath_core::evaluation::{CurveSet, Evaluation, evaluate};
use heatpath_core::grid::distance::normalized;
use heatpath_core::grid::filter::{self, Polarity, Tubes};
use heatpath_core::grid::heat::{Duration, Explicit, HeatOptions};
use heatpath_core::grid::medium::{self, Medium, PeronaMalikOptions};
use heatpath_core::grid::path::{Descent, PathOptions};
use heatpath_core::grid::voting::{
    FastMarchingVotingOptions, Growth, Method, Votes, VotingOptions, covered, front, vote,
    vote_by_fast_marching,
};
use heatpath_core::grid::{Grid, Mask, Sources};
use image::{Rgb, RgbImage};

pub(crate) fn exec() -> Exec<'static> {
    Exec::new(0).unwrap()
}

pub(crate) fn sources_in(medium: &Medium<2>, points: &[[f64; 2]]) -> Sources<2> {
    Sources::new(points, medium.mask()).unwrap()
}

/// How much each cell looks like a tube, and the medium of eq. (10) in which heat runs along them.
pub(crate) fn tubes(
    scene: &Scene,
    polarity: Polarity,
    source: [f64; 2],
) -> (Grid<f64, 2>, Medium<2>) {
    let tubes = Tubes { polarity, scales: vec![2.0, 3.0], ..Default::default() };
    let response = filter::vesselness(&scene.image, &tubes, &exec()).unwrap().response;
    let perona_malik = PeronaMalikOptions { contrast: 0.2, ..Default::default() };
    let reference = [response.sample(source)];
    let medium = medium::combined(&response, &reference, Default::default(), perona_malik).unwrap();
    (response, medium)
}

/// What is found against the middles of the tubes, within two pixels.
pub(crate) fn compare(found: &CurveSet<2>, scene: &Scene) -> Evaluation {
    let truth: Vec<&[[f64; 2]]> = scene.tubes.iter().map(|tube| &tube.points[..]).collect();
    let truth = CurveSet::of_polylines(&truth, [1.0; 2]).unwrap();
    let view = Mask::all_open(*scene.image.shape());
    evaluate(found, &truth, &[2.0], Some(&view)).unwrap()
}

/// The recall and precision of the middle of the kept cells.
fn score(votes: &Votes<2>, scene: &Scene) -> [f64; 2] {
    let score = compare(&CurveSet::of_mask(&votes.kept), scene).scores[0];
    [score.recall, score.precision]
}

fn centres(cells: &Grid<bool, 2>) -> Vec<[f64; 2]> {
    let chosen = (0..cells.values().len()).filter(|&cell| cells.values()[cell]);
    chosen.map(|cell| cells.shape().centre(cell)).collect()
}

// === Drawing

/// The kept cells, blue in the tubes and red elsewhere.
fn kept_panel(scene: &Scene, kept: &Grid<bool, 2>) -> RgbImage {
    let mut drawn = ground(scene);
    for centre in centres(kept) {
        let is_right = scene.outside.sample(centre) <= 1.0;
        dot(&mut drawn, pixel(centre), 1, if is_right { BLUE } else { RED });
    }
    drawn
}

/// The geodesic density by its logarithm, in each pixel the largest of its four cells.
fn density_panel(density: &Grid<u32, 2>) -> RgbImage {
    let most = f64::from(density.values().iter().copied().max().unwrap_or(0));
    let [width, height] = density.shape().size().map(|n| n as u32 / 2);
    RgbImage::from_fn(width, height, |x, y| {
        let [x, y] = [2 * x as usize, 2 * y as usize];
        let cells = [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]];
        let votes = cells.map(|cell| f64::from(density[cell])).into_iter().fold(0.0, f64::max);
        Rgb(band(votes.ln_1p() / most.ln_1p()))
    })
}

// === Figures 12 to 14

/// What a vote sees: the region that heat covers, its distances, and the paths from its front.
struct View {
    region: Grid<bool, 2>,
    distances: Grid<f64, 2>,
    paths: Vec<Vec<[f64; 2]>>,
}

fn view(medium: &Medium<2>, sources: &[[f64; 2]], steps: usize, level: f64) -> View {
    let options = HeatOptions { duration: Duration::Iterations(steps), ..Default::default() };
    let sources = sources_in(medium, sources);
    let heat = Explicit::new(medium, options).unwrap().flow(&sources, &exec()).unwrap();
    let (region, distances) = (covered(&heat, level), normalized(&heat));
    let descent = Descent::new(&heat, medium).unwrap();
    let path = |cell| {
        let end = heat.shape().centre(cell);
        descent.path(end, &distances, PathOptions::default()).unwrap().points
    };
    let paths = front(&region).into_iter().map(path).collect();
    View { region, distances: distances.into_field(), paths }
}

/// The distances with the front in blue, the paths from it, and the cells that are kept.
fn vote_row(scene: &Scene, view: &View, votes: &Votes<2>) -> RgbImage {
    let mut distances = distance_panel(&view.distances, &view.region);
    view.paths.iter().for_each(|path| dot(&mut distances, pixel(path[0]), 2, BLUE));
    let mut paths = ground(scene);
    draw_paths(&mut paths, view.paths.iter().map(Vec::as_slice));
    beside(&[distances, paths, kept_panel(scene, &votes.kept)])
}

/// The part of a region at most two pixels outside of the tubes.
fn part_on_the_tubes(region: &Grid<bool, 2>, scene: &Scene) -> f64 {
    let centres = centres(region);
    let near = centres.iter().filter(|&&centre| scene.outside.sample(centre) <= 2.0).count();
    near as f64 / centres.len() as f64
}

/// Figure 12: votes from the front find more of a tree, the longer heat flows.
#[test]
fn figure_12_front() {
    let scene = tree();
    let medium = alpha(&scene.image, ROOT, 3.0);
    let mut rows = Vec::new();
    let recall = [300, 600].map(|steps| {
        let options =
            VotingOptions { method: Method::Front, steps: Some(steps), ..Default::default() };
        let votes = vote(&medium, &sources_in(&medium, &[ROOT]), &options, &exec()).unwrap();
        rows.push(vote_row(&scene, &view(&medium, &[ROOT], steps, 240.0), &votes));
        let [recall, precision] = score(&votes, &scene);
        println!("after {steps} steps: recall {recall:.3}, precision {precision:.3}");
        recall
    });
    assert!(recall[0] > 0.5 && recall[1] > recall[0] + 0.3, "{recall:?}");
    assert_figure("figure_12_front.png", &[below(&rows)]);
}

/// Draws the first two rounds, and returns of each recall, precision and the part of the region on the
/// tubes.
fn two_rounds(name: &str, method: Method, level: f64) -> [[f64; 3]; 2] {
    let scene = tree();
    let medium = alpha(&scene.image, ROOT, 3.0);
    let (mut rows, mut kept) = (Vec::new(), vec![ROOT]);
    let numbers = [1, 2].map(|rounds| {
        let options = VotingOptions { method, rounds, ..Default::default() };
        let votes = vote(&medium, &sources_in(&medium, &[ROOT]), &options, &exec()).unwrap();
        let view = match method {
            Method::Accumulated => view(&medium, &kept, 100, level),
            _ => view(&medium, &[ROOT], 100 * rounds, level),
        };
        let last = votes.rounds[rounds - 1];
        assert_eq!([last.covered, last.ends], [centres(&view.region).len(), view.paths.len()]);
        kept = centres(&votes.kept);
        rows.push(vote_row(&scene, &view, &votes));
        let [recall, precision] = score(&votes, &scene);
        let part = part_on_the_tubes(&view.region, &scene);
        [recall, precision, part]
    });
    assert_figure(&format!("{name}.png"), &[below(&rows)]);
    numbers
}

/// Figures 13 and 14: multiple and accumulated votes grow from round to round, and heat keeps closer
/// to the tree where it begins anew.
#[test]
fn figures_13_and_14_rounds() {
    let multiple = two_rounds("figure_13_multiple", Method::Multiple, 240.0);
    let accumulated = two_rounds("figure_14_accumulated", Method::Accumulated, 36.0);
    println!("recall, precision and part on the tree: {multiple:.3?}, {accumulated:.3?}");
    for [first, second] in [multiple, accumulated] {
        assert!(first[0] > 0.0 && second[0] > 1.5 * first[0], "{first:?}, {second:?}");
    }
    for (multiple, accumulated) in multiple.into_iter().zip(accumulated) {
        assert!(accumulated[2] > 2.0 * multiple[2], "{accumulated:?}, {multiple:?}");
    }
    // Most of that is the level; at the same one, heat that has flowed on from the root has this part.
    let (scene, medium) = (tree(), alpha(&tree().image, ROOT, 3.0));
    let flowed_on = part_on_the_tubes(&view(&medium, &[ROOT], 200, 36.0).region, &scene);
    println!("{flowed_on:.3} of the cells covered at level 36, without beginning anew");
    assert!(accumulated[1][2] > flowed_on, "{accumulated:?}");
}

// === Figures 16 to 18

/// Votes by fast marching from 500 random ends, from the front, multiple, accumulated, and accumulated
/// with growth: their recall and precision.
fn five_votes(
    name: &str,
    scene: &Scene,
    (medium, least_speed_sq): (&Medium<2>, f64),
    source: [f64; 2],
) -> [[f64; 2]; 5] {
    let sources = sources_in(medium, &[source]);
    let heat = |method, growth| {
        let options = VotingOptions { method, growth, ..Default::default() };
        vote(medium, &sources, &options, &exec()).unwrap()
    };
    let random = FastMarchingVotingOptions::default();
    let votes = [
        vote_by_fast_marching(medium, &sources, &random, &exec()).unwrap(),
        heat(Method::Front, None),
        heat(Method::Multiple, None),
        heat(Method::Accumulated, None),
        heat(Method::Accumulated, Some(Growth::new(least_speed_sq))),
    ];
    let scores = votes.each_ref().map(|votes| score(votes, scene));
    let mut above = vec![grey_panel(&scene.image, source)];
    above.extend(votes.iter().map(|votes| density_panel(&votes.density)));
    let mut results = vec![panel(&medium.speed_sq_field(), |speed_sq| band(speed_sq.sqrt()), &[])];
    results.extend(votes.iter().map(|votes| kept_panel(scene, &votes.kept)));
    assert_figure(&format!("{name}.png"), &[below(&[beside(&above), beside(&results)])]);
    scores
}

/// The paper's finding: accumulated votes have the best recall. Growth keeps them to the structure.
fn assert_accumulated_finds_most(scores: &[[f64; 2]; 5], least: f64) {
    let others = scores[..3].iter().map(|score| score[0]).fold(0.0, f64::max);
    assert!(scores[3][0] > others && scores[3][0] > least, "{scores:?}");
    assert!(scores[4][0] > least && scores[4][1] > 0.99, "{scores:?}");
}

/// Figure 16: accumulated votes find all of the tree, and go on into the ground.
#[test]
fn figure_16_tree() {
    let scene = tree();
    let medium = alpha(&scene.image, ROOT, 3.0);
    let scores = five_votes("figure_16_tree", &scene, (&medium, 0.45), ROOT);
    println!("recall and precision: {scores:.3?}");
    assert_accumulated_finds_most(&scores, 0.98);
}

/// Figure 17: of vessels that cross, in texture and noise, only accumulated votes find nearly all.
#[test]
fn figure_17_vessels() {
    let scene = vessels();
    let (_, medium) = tubes(&scene, Polarity::Bright, VESSEL_ROOT);
    let scores = five_votes("figure_17_vessels", &scene, (&medium, 0.1), VESSEL_ROOT);
    println!("recall and precision: {scores:.3?}");
    assert_accumulated_finds_most(&scores, 0.9);
}

/// Figure 18: of a curve with a loop only accumulated votes find both ends.
#[test]
fn figure_18_catheter() {
    let scene = catheter();
    let (_, medium) = tubes(&scene, Polarity::Dark, on_the_catheter());
    let scores = five_votes("figure_18_catheter", &scene, (&medium, 0.1), on_the_catheter());
    println!("recall and precision: {scores:.3?}");
    assert_accumulated_finds_most(&scores, 0.95);
}
