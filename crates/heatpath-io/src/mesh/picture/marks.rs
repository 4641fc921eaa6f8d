//! Paths, end points and sources on the canvas.

use super::MeshPicture;
use super::canvas::{Canvas, SAMPLES};
use super::view::{Camera, Vector};
use crate::canvas::{BLACK, CYAN, ORANGE, RED, SHADOW, WHITE};
use heatpath_core::mesh::path::{Ending, Path};

pub(super) fn draw(canvas: &mut Canvas, camera: &Camera, picture: &MeshPicture<'_>) {
    let longest = picture.size[0].max(picture.size[1]) as f64;
    let line = SAMPLES as f64 * (longest / 300.0).clamp(2.0, 6.0);
    let pen = |width: f64, colour| Pen { width, colour, lift: 1.5 * line, dash: None };
    // All outlines first: where paths meet they run into one another.
    for (widening, is_outline) in [(1.6 * SAMPLES as f64, true), (0.0, false)] {
        for path in picture.paths {
            let colour = match reached_source(path) {
                _ if is_outline => SHADOW,
                true => CYAN,
                false => ORANGE,
            };
            let dash = (!reached_source(path)).then_some([4.0 * line, 3.0 * line]);
            let places: Vec<Vector> = path.positions.iter().map(|&p| camera.place(p)).collect();
            Pen { dash, ..pen(line + widening, colour) }.draw(canvas, &places);
        }
    }
    for end in picture.paths.iter().filter_map(|path| path.positions.first()) {
        let place = [camera.place(*end)];
        let radius = (1.3 * line).max(3.0);
        pen(2.0 * radius + 2.4 * SAMPLES as f64, BLACK).draw(canvas, &place);
        pen(2.0 * radius, WHITE).draw(canvas, &place);
    }
    for source in sources(picture) {
        let [x, y, height] = camera.place(source);
        let arm = 2.2 * line;
        for (width, colour) in [(line + 3.0 * SAMPLES as f64, WHITE), (line, RED)] {
            for sign in [-1.0, 1.0] {
                let ends = [[x - arm, y - sign * arm, height], [x + arm, y + sign * arm, height]];
                Pen { lift: 4.0 * line, ..pen(width, colour) }.draw(canvas, &ends);
            }
        }
    }
}

/// The sources, each once.
fn sources(picture: &MeshPicture<'_>) -> Vec<Vector> {
    let mut all = picture.sources.to_vec();
    let reached = picture.paths.iter().filter(|path| reached_source(path));
    for &source in reached.filter_map(|path| path.positions.last()) {
        if !all.contains(&source) {
            all.push(source);
        }
    }
    all
}

fn reached_source(path: &Path) -> bool {
    matches!(path.ending, Ending::Source(_))
}

/// What draws lines with round ends; all in samples.
#[derive(Clone, Copy)]
struct Pen {
    width: f64,
    colour: [u8; 4],
    /// How far lines are lifted towards the eye, so that the surface on which they lie does not
    /// hide them.
    lift: f64,
    /// The lengths of dashes and of gaps.
    dash: Option<[f64; 2]>,
}

impl Pen {
    /// A polyline, or a dot if it has one point.
    fn draw(&self, canvas: &mut Canvas, places: &[Vector]) {
        let mut is_done = Vec::new();
        match places {
            [place] => self.draw_segment(canvas, *place, *place, 0.0, &mut is_done),
            _ => {
                let mut length = 0.0;
                for pair in places.windows(2) {
                    self.draw_segment(canvas, pair[0], pair[1], length, &mut is_done);
                    length += (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
                }
            }
        }
        is_done.sort_unstable();
        is_done.dedup();
        for (y, x) in is_done {
            canvas.paint(x, y, self.colour);
        }
    }

    /// Notes the samples of a segment that are seen.
    fn draw_segment(
        &self,
        canvas: &Canvas,
        a: Vector,
        b: Vector,
        length_before: f64,
        seen: &mut Vec<(usize, usize)>,
    ) {
        let radius = 0.5 * self.width;
        let bounds = |axis: usize| (a[axis].min(b[axis]) - radius, a[axis].max(b[axis]) + radius);
        let ((left, right), (top, bottom)) = (bounds(0), bounds(1));
        let along = [b[0] - a[0], b[1] - a[1]];
        let length_sq = along[0] * along[0] + along[1] * along[1];
        for y in canvas.range(1, top, bottom) {
            for x in canvas.range(0, left, right) {
                let from = [x as f64 + 0.5 - a[0], y as f64 + 0.5 - a[1]];
                let part = from[0] * along[0] + from[1] * along[1];
                let part = if length_sq > 0.0 { (part / length_sq).clamp(0.0, 1.0) } else { 0.0 };
                let away = (from[0] - part * along[0]).hypot(from[1] - part * along[1]);
                let height = a[2] + part * (b[2] - a[2]) + self.lift;
                let is_gap = self.dash.is_some_and(|[dash, gap]| {
                    (length_before + part * length_sq.sqrt()) % (dash + gap) > dash
                });
                if away <= radius && !is_gap && canvas.is_free(x, y, height) {
                    seen.push((y, x));
                }
            }
        }
    }
}
