//! Curves as a drawing.

use crate::Curves;
use crate::curves::ending_name;
use heatpath_core::grid::Shape;
use heatpath_core::grid::path::{Ending, Path as Curve};
use svg::Document;
use svg::node::element::{Circle, Polyline, Style};

/// Blue for paths that reached a source, dashed orange for others; strokes keep their width when the
/// drawing is enlarged.
const STYLE: &str = "polyline { fill: none; stroke: #0090d0; stroke-width: 1.5px; \
    stroke-linejoin: round; stroke-linecap: round; vector-effect: non-scaling-stroke } \
    polyline.open { stroke: #ff8c00; stroke-dasharray: 4 3 } \
    circle { stroke: #000; stroke-width: 0.3 } circle.end { fill: #fff } \
    circle.source { fill: #e00000 }";

/// The drawing in pixel coordinates, of which the first two count: the centre of the first pixel is
/// at 0,0 and the view is the picture's outline.
pub(crate) fn drawing<const D: usize>(curves: &Curves<D>, shape: &Shape<D>) -> String {
    let (width, height) = (shape.size()[0], shape.size()[1]);
    let radius = (shape.longest_side() as f64 / 150.0).clamp(0.5, 6.0);
    let mut document = Document::new()
        .set("viewBox", format!("-0.5 -0.5 {width} {height}"))
        .set("width", width)
        .set("height", height)
        .add(Style::new(STYLE));
    for (i, path) in curves.paths.iter().enumerate() {
        if path.points.len() > 1 {
            document = document.add(line(i, path));
        }
    }
    for path in &curves.paths {
        if let (Ending::Source(_), Some(&source)) = (path.ending, path.points.last()) {
            document = document.add(dot("source", source, radius));
        }
        if let Some(&end) = path.points.first() {
            document = document.add(dot("end", end, radius));
        }
    }
    format!("{document}\n")
}

fn line<const D: usize>(number: usize, path: &Curve<D>) -> Polyline {
    let points: Vec<_> = path
        .points
        .iter()
        .map(|point| format!("{},{}", number_text(point[0]), number_text(point[1])))
        .collect();
    let class = if matches!(path.ending, Ending::Source(_)) { "done" } else { "open" };
    Polyline::new()
        .set("id", format!("path-{number}"))
        .set("class", class)
        .set("data-ended", ending_name(path.ending))
        .set("points", points.join(" "))
}

fn dot<const D: usize>(class: &str, point: [f64; D], radius: f64) -> Circle {
    Circle::new()
        .set("class", class)
        .set("cx", number_text(point[0]))
        .set("cy", number_text(point[1]))
        .set("r", number_text(radius))
}

/// To a thousandth of a pixel: finer than any screen shows.
fn number_text(value: f64) -> String {
    // Adding 0 turns -0 into 0.
    format!("{}", (value * 1000.0).round() / 1000.0 + 0.0)
}
