//! Generated pictures like those of the paper's figures: 300 x 300, grey values from 0 to 1.

use heatpath_core::grid::{Grid, Shape};
use std::f64::consts::{PI, TAU};

const SIDE: usize = 300;

/// The source on the wide curve, as in figure 1.
pub(crate) const ON_THE_CURVE: [f64; 2] = [187.0, 36.0];

/// Half the width of the wide curve.
const HALF_WIDTH: f64 = 13.0;

fn draw(grey: impl Fn(f64, f64) -> f64) -> Grid<f64, 2> {
    let shape = Shape::new([SIDE, SIDE]).expect("a fixed size");
    Grid::from_fn(shape, |[x, y]| grey(x as f64, y as f64))
}

/// The x of the middle of the wide curve.
fn middle(y: f64) -> f64 {
    150.0 + 60.0 * (TAU * (y - 36.0) / 260.0 + 0.665).sin()
}

/// The distance from the middle of the wide curve, about.
fn off_the_curve(x: f64, y: f64) -> f64 {
    let slope = (middle(y + 0.5) - middle(y - 0.5)).abs();
    (x - middle(y)).abs() / slope.hypot(1.0)
}

pub(crate) fn is_on_the_curve(x: f64, y: f64) -> bool {
    off_the_curve(x, y) <= HALF_WIDTH
}

/// Whether a point lies in the regular polygon around `centre`.
fn in_polygon(x: f64, y: f64, centre: [f64; 2], radius: f64, sides: f64) -> bool {
    let (dx, dy) = (x - centre[0], y - centre[1]);
    let sector = TAU / sides;
    let angle = dy.atan2(dx).rem_euclid(sector) - 0.5 * sector;
    dx.hypot(dy) * angle.cos() <= radius * (0.5 * sector).cos()
}

/// The hexagon beside the wide curve.
pub(crate) fn in_hexagon(x: f64, y: f64) -> bool {
    in_polygon(x, y, [70.0, 85.0], 46.0, 6.0)
}

/// A wide black curve among polygons of several greys.
pub(crate) fn wide_curve() -> Grid<f64, 2> {
    draw(|x, y| {
        if is_on_the_curve(x, y) {
            0.1
        } else if in_hexagon(x, y) {
            0.45
        } else if in_polygon(x, y, [235.0, 205.0], 44.0, 4.0) {
            0.35
        } else if in_polygon(x, y, [60.0, 230.0], 42.0, 3.0) {
            0.6
        } else {
            0.75
        }
    })
}

/// The y of the thin line.
pub(crate) fn thin_line_at(x: f64) -> f64 {
    150.0 + 40.0 * (TAU * x / 300.0).sin()
}

/// A line of one or two pixels, a little darker than its ground, whose left half is a shade darker
/// than its right half.
pub(crate) fn thin_line() -> Grid<f64, 2> {
    draw(|x, y| {
        let ground = if x < 150.0 { 0.5 } else { 0.6 };
        if (y - thin_line_at(x)).abs() < 1.0 { ground - 0.3 } else { ground }
    })
}

/// The middle of the pictures of figures 5 and 10.
pub(crate) const CENTRE: [f64; 2] = [149.5; 2];

/// The point at `radius` and `angle` around the middle.
pub(crate) fn around([x, y]: [f64; 2], radius: f64, angle: f64) -> [f64; 2] {
    [x + radius * angle.cos(), y + radius * angle.sin()]
}

/// A Gaussian around the middle.
pub(crate) fn gaussian() -> Grid<f64, 2> {
    draw(|x, y| (-0.5 * ((x - CENTRE[0]).hypot(y - CENTRE[1]) / 60.0).powi(2)).exp())
}

/// The ends of the U-tube's legs.
pub(crate) const U_ENDS: [[f64; 2]; 2] = [[74.5, 100.0], [224.5, 100.0]];

/// A U-tube: two legs 150 pixels apart and a half circle.
pub(crate) fn u_tube() -> Grid<f64, 2> {
    draw(|x, y| {
        let from_middle = (x - 149.5).hypot((y - 180.0).max(0.0));
        tube((from_middle - 75.0) / 20.0)
    })
}

/// The ends of four fifths of a turn of the spiral, the outer one first.
pub(crate) fn spiral_ends() -> [[f64; 2]; 2] {
    [-0.1, -0.1 - 0.8 * TAU].map(|angle| around(CENTRE, spiral_radius(angle), angle))
}

/// A logarithmic spiral.
fn spiral_radius(angle: f64) -> f64 {
    130.0 * (0.3 * angle).exp()
}

/// A spiral tube that widens outwards in proportion to its radius.
pub(crate) fn spiral() -> Grid<f64, 2> {
    draw(|x, y| {
        let (dx, dy) = (x - CENTRE[0], y - CENTRE[1]);
        let angle_there = (dx.hypot(dy).max(1.0) / spiral_radius(0.0)).ln() / 0.3;
        let off = (angle_there - dy.atan2(dx) + PI).rem_euclid(TAU) - PI;
        tube(off / 0.8)
    })
}

/// The grey value across a bright tube.
fn tube(off: f64) -> f64 {
    0.3 + 0.45 * (-0.5 * off * off).exp()
}

/// Inside the tubes the grey value is above this, half way between the middle and the ground.
pub(crate) const TUBE: f64 = 0.525;

/// The ends of the road.
pub(crate) const ROAD_ENDS: [[f64; 2]; 2] = [[ROAD_X, 4.0], [ROAD_X, 295.0]];

/// The x of the road at its ends.
const ROAD_X: f64 = 150.0;

/// The points of the road, half a pixel apart or less, from top to bottom.
pub(crate) fn road_points() -> Vec<[f64; 2]> {
    let [top, bottom] = ROAD_ENDS.map(|end| end[1]);
    let at = |i: i32| top + (bottom - top) * f64::from(i) / 1200.0;
    let x = |y: f64| {
        let part = (y - top) / (bottom - top);
        ROAD_X + 35.0 * (TAU * part).sin() - 15.0 * (2.0 * TAU * part).sin()
    };
    (0..=1200).map(|i| [x(at(i)), at(i)]).collect()
}

/// A thin bright road between fields of several greys; everything a little uneven.
pub(crate) fn road() -> Grid<f64, 2> {
    let points = road_points();
    let mut random = random(7);
    let greys: Vec<f64> = (0..64).map(|_| 0.1 + 0.55 * random()).collect();
    let fields = draw(|x, y| {
        let (across, down) = (x + 0.35 * y, y - 0.2 * x + 60.0);
        greys[(across / 52.0) as usize % 8 * 8 + (down / 47.0) as usize % 8]
    });
    let shape = *fields.shape();
    let road = Grid::from_fn(shape, |[x, y]| {
        let off = |&[a, b]: &[f64; 2]| (x as f64 - a).hypot(y as f64 - b);
        points.iter().map(off).fold(f64::INFINITY, f64::min)
    });
    Grid::from_fn(shape, |cell| {
        let part = (1.6 - road[cell]).clamp(0.0, 1.0);
        let grey = fields[cell] + part * (0.9 - fields[cell]);
        (grey + 0.08 * (random() - 0.5)).clamp(0.0, 1.0)
    })
}

/// The ends of the noisy curve.
pub(crate) const CURVE_ENDS: [[f64; 2]; 2] = [[20.0, 150.0], [280.0, 150.0]];

/// The distance from the noisy curve, one period of a sine.
pub(crate) fn off_the_noisy_curve([x, y]: [f64; 2]) -> f64 {
    let points = (0..=1300).map(|i| 20.0 + 0.2 * f64::from(i));
    let off = |at: f64| (x - at).hypot(y - 150.0 - 70.0 * (TAU * (at - 20.0) / 260.0).sin());
    points.map(off).fold(f64::INFINITY, f64::min)
}

/// A thin dark curve on white ground, of whose pixels 13.3 % are replaced by random grey values.
pub(crate) fn noisy_curve(clean: &Grid<f64, 2>, seed: u64) -> Grid<f64, 2> {
    let mut random = random(seed);
    clean.map(|&grey| if random() < 0.133 { random() } else { grey })
}

/// The noisy curve without noise: one or two pixels wide.
pub(crate) fn clean_curve() -> Grid<f64, 2> {
    draw(|x, y| if off_the_noisy_curve([x, y]) <= 0.7 { 0.6 } else { 1.0 })
}

/// Numbers from 0 to 1.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2685821657736338717) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

// === Trees and curves with known centrelines

/// A tube around the line through `points`, at most two pixels apart.
pub(crate) struct Tube {
    pub(crate) points: Vec<[f64; 2]>,
    half_width: f64,
}

impl Tube {
    /// The tube around the line `at(s)` for s from 0 to 1.
    fn new(half_width: f64, at: impl Fn(f64) -> [f64; 2]) -> Self {
        Self { points: (0..=400).map(|i| at(f64::from(i) / 400.0)).collect(), half_width }
    }

    /// A point's distance from the tube's wall, negative inside.
    fn outside(&self, [x, y]: [f64; 2]) -> f64 {
        let from = |&[a, b]: &[f64; 2]| (x - a).powi(2) + (y - b).powi(2);
        self.points.iter().map(from).fold(f64::INFINITY, f64::min).sqrt() - self.half_width
    }
}

/// A picture with the tubes in it.
pub(crate) struct Scene {
    pub(crate) image: Grid<f64, 2>,
    pub(crate) tubes: Vec<Tube>,
    /// The distance of each cell from the nearest tube's wall, negative inside.
    pub(crate) outside: Grid<f64, 2>,
}

impl Scene {
    /// The picture whose grey value at a point is that of `grey` for the part of the cell in a tube.
    fn new(tubes: Vec<Tube>, mut grey: impl FnMut(f64, f64, f64) -> f64) -> Self {
        let nearest = |x, y| tubes.iter().map(|t| t.outside([x, y])).fold(f64::INFINITY, f64::min);
        let outside = draw(nearest);
        let image = Grid::from_fn(*outside.shape(), |[x, y]| {
            let part = (0.5 - outside[[x, y]]).clamp(0.0, 1.0);
            grey(x as f64, y as f64, part).clamp(0.0, 1.0)
        });
        Self { image, tubes, outside }
    }
}

/// A bent branch from `start` and those into which it forks, in the order in which they grow.
fn branches(start: [f64; 2], angle: f64, length: f64, half_width: f64, forks: u32) -> Vec<Tube> {
    let bend = if forks.is_multiple_of(2) { 0.25 } else { -0.25 };
    let at = |s: f64| {
        // The mean heading from the start to there, as of an arc.
        let (chord, heading) = (s * length, angle + 0.5 * bend * s);
        [start[0] + chord * heading.cos(), start[1] - chord * heading.sin()]
    };
    let mut tubes = vec![Tube::new(half_width, at)];
    if forks > 0 {
        for turn in [-0.55, 0.5] {
            let (shorter, thinner) = (0.75 * length, 0.8 * half_width);
            tubes.extend(branches(at(1.0), angle + bend + turn, shorter, thinner, forks - 1));
        }
    }
    tubes
}

/// The root of the tree.
pub(crate) const ROOT: [f64; 2] = [150.0, 285.0];

/// A tree of 15 branches, the trunk nine pixels wide, with a little noise.
pub(crate) fn tree() -> Scene {
    let mut random = random(1);
    let tubes = branches([150.0, 290.0], 0.5 * PI, 85.0, 4.5, 3);
    Scene::new(tubes, |_, _, part| 0.2 + 0.6 * part + 0.1 * (random() - 0.5))
}

/// The root of the vessels.
pub(crate) const VESSEL_ROOT: [f64; 2] = [130.0, 285.0];

/// Bright vessels, two trees and two more that cross them, on a ground with texture and noise.
pub(crate) fn vessels() -> Scene {
    let mut random = random(2);
    let mut tubes = branches([130.0, 290.0], 0.45 * PI, 90.0, 4.0, 3);
    tubes.extend(branches([8.0, 215.0], 0.1, 95.0, 3.0, 2));
    tubes.push(Tube::new(2.0, |s| [20.0 + 265.0 * s, 120.0 - 50.0 * (4.0 * s).sin()]));
    tubes.push(Tube::new(1.6, |s| [225.0 + 30.0 * (3.0 * s).sin(), 20.0 + 250.0 * s]));
    Scene::new(tubes, |x, y, part| {
        let texture =
            (x / 9.0 + 2.0 * (y / 31.0).sin()).sin() * (y / 13.0 + (x / 23.0).sin()).cos();
        0.25 + 0.06 * texture + 0.4 * part + 0.2 * (random() - 0.5)
    })
}

/// A point of the catheter, s from 0 to 1.
fn catheter_at(s: f64) -> [f64; 2] {
    let t = 7.2 * s - 3.6;
    [150.0 + 30.0 * t - 70.0 * t.sin(), 165.0 - 90.0 * t.cos()]
}

/// The source on the catheter.
pub(crate) fn on_the_catheter() -> [f64; 2] {
    catheter_at(0.35)
}

/// A thin dark curve with a loop, over broad dark bands and noise.
pub(crate) fn catheter() -> Scene {
    let mut random = random(3);
    Scene::new(vec![Tube::new(1.5, catheter_at)], |x, y, part| {
        let bands = ((0.9 * y + 0.3 * x + 8.0 * (x / 40.0).sin()) / 11.0).sin();
        let lungs = if (x - 150.0).abs() < 55.0 { -0.12 } else { 0.0 };
        0.6 + 0.08 * bands + lungs - 0.3 * part + 0.24 * (random() - 0.5)
    })
}
