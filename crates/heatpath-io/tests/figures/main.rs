//! The paper's figures 1 to 6 and 9 to 20 remade on generated pictures and a generated mesh.
//!
//! Each test holds what the figure shows as a number, and the figure itself: the pictures in
//! `docs/figures` are compared with what is drawn now. `HEATPATH_BLESS=1` draws them anew; a
//! difference leaves a picture of three panels (expected, drawn, difference) beside the build.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod automatic;
mod key_points;
mod meshes;
mod panels;
mod paths;
mod scenes;

use heatpath_core::Exec;
use heatpath_core::grid::heat::{Duration, Explicit, Heat, HeatOptions, Step};
use heatpath_core::grid::medium::{self, ConductivityOptions, Form, Medium, PeronaMalikOptions};
use heatpath_core::grid::{Grid, Sources};
use heatpath_io::colour::viridis;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};
use scenes::{ON_THE_CURVE, in_hexagon, is_on_the_curve, thin_line, thin_line_at, wide_curve};
use std::fs::File;
use std::path::{Path, PathBuf};

/// Heat below this part of the warmest point's is drawn as none: half a unit of f64's precision.
const VISIBLE: f64 = 36.0;

fn flow(medium: &Medium<2>, source: [f64; 2]) -> Heat<2> {
    flow_with(medium, source, HeatOptions::default())
}

/// Heat is slow by eq. (11): it gets larger steps, and more of them.
fn flow_long(medium: &Medium<2>, source: [f64; 2]) -> Heat<2> {
    let duration = Duration::Iterations(5000);
    flow_with(medium, source, HeatOptions { duration, step: Step::Auto, ..Default::default() })
}

fn flow_with(medium: &Medium<2>, source: [f64; 2], options: HeatOptions) -> Heat<2> {
    let sources = Sources::new(&[source], medium.mask()).unwrap();
    Explicit::new(medium, options).unwrap().flow(&sources, &Exec::new(0).unwrap()).unwrap()
}

/// The temperature relative to the warmest point.
fn temperature(heat: &Heat<2>) -> Grid<f64, 2> {
    let ln_u = heat.ln_temperature();
    let warmest = ln_u.values().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    ln_u.map(|ln_u| (ln_u - warmest).exp())
}

/// The part of the heat that lies where `inside` holds.
fn part_of_heat(heat: &Heat<2>, inside: impl Fn(f64, f64) -> bool) -> f64 {
    let u = temperature(heat);
    let total: f64 = u.values().iter().sum();
    let cells = (0..u.values().len()).filter(|&cell| {
        let [x, y] = u.shape().centre(cell);
        inside(x, y)
    });
    cells.map(|cell| u.values()[cell]).sum::<f64>() / total
}

fn alpha(image: &Grid<f64, 2>, source: [f64; 2], power: f64) -> Medium<2> {
    let options = ConductivityOptions { power, ..Default::default() };
    medium::conductivity(image, &[image.sample(source)], options).unwrap()
}

// === Drawing

/// Every second pixel of a grey picture, with a red dot at the source.
fn picture_panel(image: &Grid<f64, 2>, sources: &[[f64; 2]]) -> RgbImage {
    panel(image, |grey| [(255.0 * grey).round() as u8; 3], sources)
}

/// Every second pixel of the heat, by its logarithm.
fn heat_panel(heat: &Heat<2>, source: [f64; 2]) -> RgbImage {
    panel(&temperature(heat), |u| viridis(1.0 + u.ln() / VISIBLE), &[source])
}

fn panel(field: &Grid<f64, 2>, colour: impl Fn(f64) -> [u8; 3], sources: &[[f64; 2]]) -> RgbImage {
    let [width, height] = field.shape().size().map(|n| n as u32 / 2);
    RgbImage::from_fn(width, height, |x, y| {
        let cell = [2 * x as usize, 2 * y as usize];
        let near = |s: &[f64; 2]| (s[0] - cell[0] as f64).hypot(s[1] - cell[1] as f64) < 5.0;
        Rgb(if sources.iter().any(near) { [230, 20, 30] } else { colour(field[cell]) })
    })
}

/// Panels side by side with a white gap.
fn beside(panels: &[RgbImage]) -> RgbImage {
    const GAP: u32 = 4;
    let width = panels.iter().map(|panel| panel.width() + GAP).sum::<u32>() - GAP;
    let mut picture = RgbImage::from_pixel(width, panels[0].height(), Rgb([255; 3]));
    let mut left = 0;
    for panel in panels {
        image::imageops::replace(&mut picture, panel, i64::from(left), 0);
        left += panel.width() + GAP;
    }
    picture
}

/// Compares with the picture in `docs/figures`, or replaces it.
fn assert_figure(name: &str, panels: &[RgbImage]) {
    let drawn = beside(panels);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures").join(name);
    if std::env::var_os("HEATPATH_BLESS").is_some() {
        let encoder = PngEncoder::new_with_quality(
            File::create(&file).unwrap(),
            CompressionType::Best,
            FilterType::NoFilter,
        );
        drawn.write_with_encoder(encoder).unwrap();
        return;
    }
    let expected =
        image::open(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display())).to_rgb8();
    assert_eq!(expected.dimensions(), drawn.dimensions(), "{name} has another size");
    let mut difference = RgbImage::new(drawn.width(), drawn.height());
    for (pixel, (a, b)) in difference.pixels_mut().zip(expected.pixels().zip(drawn.pixels())) {
        *pixel = Rgb(std::array::from_fn(|i| a[i].abs_diff(b[i])));
    }
    // Logarithms and powers may differ in the last bit from one mathematical library to another.
    if difference.pixels().any(|pixel| pixel.0.iter().any(|&d| d > 3)) {
        let left: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        beside(&[expected, drawn, difference]).save(&left).unwrap();
        panic!("{name} is drawn differently; see {}", left.display());
    }
}

// === The figures

/// Figure 1: the higher the power n of eq. (6), the more of the heat stays on the curve.
#[test]
fn figure_1_power() {
    let image = wide_curve();
    let heats =
        [1.0, 2.0, 3.0].map(|power| flow(&alpha(&image, ON_THE_CURVE, power), ON_THE_CURVE));
    // How warm the surroundings are, 30 cells beside the curve, next to the curve at its far end.
    let leak = heats.each_ref().map(|heat| {
        let ln_u = heat.ln_temperature();
        ln_u[[260, 60]] - ln_u[[97, 160]]
    });
    println!("ln(u beside the curve / u on it) for n = 1, 2, 3: {leak:.2?}");
    assert!(leak[0] > leak[1] && leak[1] > leak[2]);
    let mut panels = vec![picture_panel(&image, &[ON_THE_CURVE])];
    panels.extend(heats.iter().map(|heat| heat_panel(heat, ON_THE_CURVE)));
    assert_figure("figure_1_power.png", &panels);
}

/// Figure 2: the gradient term of eq. (9) keeps heat from leaking out of a region.
#[test]
fn figure_2_gradient_term() {
    let image = wide_curve();
    let heats = [Form::Pointwise, Form::Divergence].map(|form| {
        // The term is the slope of D: it shows on edges that are wider than a cell.
        let options =
            PeronaMalikOptions { contrast: 0.1, smoothing: 1.5, form, ..Default::default() };
        let medium = medium::perona_malik(&image, options).unwrap();
        flow(&medium, ON_THE_CURVE)
    });
    let outside = heats.each_ref().map(|heat| part_of_heat(heat, |x, y| !is_on_the_curve(x, y)));
    println!("part of the heat outside the curve, without and with the term: {outside:.4?}");
    assert!(outside[1] < 0.9 * outside[0]);
    let mut panels = vec![picture_panel(&image, &[ON_THE_CURVE])];
    panels.extend(heats.iter().map(|heat| heat_panel(heat, ON_THE_CURVE)));
    assert_figure("figure_2_gradient_term.png", &panels);
}

/// Figure 3: eq. (10), conductivity and Perona-Malik together, concentrates heat more than either.
#[test]
fn figure_3_combination() {
    let image = wide_curve();
    let perona_malik = PeronaMalikOptions { contrast: 0.15, ..Default::default() };
    let reference = [image.sample(ON_THE_CURVE)];
    let media = [
        alpha(&image, ON_THE_CURVE, 3.0),
        medium::perona_malik(&image, perona_malik).unwrap(),
        medium::combined(&image, &reference, Default::default(), perona_malik).unwrap(),
    ];
    let heats = media.each_ref().map(|medium| flow(medium, ON_THE_CURVE));
    let inside = heats.each_ref().map(|heat| part_of_heat(heat, is_on_the_curve));
    println!("part of the heat on the curve by eqs. (6), (8), (10): {inside:.4?}");
    assert!(inside[2] > inside[0] && inside[2] > inside[1]);
    let mut panels = vec![picture_panel(&image, &[ON_THE_CURVE])];
    panels.extend(heats.iter().map(|heat| heat_panel(heat, ON_THE_CURVE)));
    assert_figure("figure_3_combination.png", &panels);
}

/// Figure 4: eq. (11) runs along a thin line and along the edges of wide regions.
#[test]
fn figure_4_edges() {
    // === A thin line on a changing ground, by eqs. (6) and (11)
    let line = thin_line();
    let source = [20.0, thin_line_at(20.0).round()];
    let along_grey = flow(&alpha(&line, source, 3.0), source);
    let edges = |image| medium::edges(image, Default::default()).unwrap();
    let along_edges = flow_long(&edges(&line), source);
    // How much warmer the line is than the ground 25 cells beside it.
    let ahead = |heat: &Heat<2>| {
        let (x, y) = (200, thin_line_at(200.0).round() as usize);
        heat.ln_temperature()[[x, y]] - heat.ln_temperature()[[x, y + 25]]
    };
    println!(
        "ln(u on the line / u beside it): {:.2}, {:.2}",
        ahead(&along_grey),
        ahead(&along_edges)
    );
    assert!(ahead(&along_edges) > ahead(&along_grey) + 5.0);

    // === A wide curve and a hexagon: heat from the hexagon's edge, and from inside the curve
    let wide = wide_curve();
    let starts = [[47.0, 46.0], ON_THE_CURVE];
    let heats = starts.map(|start| flow_long(&edges(&wide), start));
    let at = |heat: &Heat<2>, cell: [usize; 2]| heat.ln_temperature()[cell];
    let (on_the_far_edge, in_the_middle) = ([70, 125], [70, 85]);
    assert!(in_hexagon(70.0, 85.0));
    let rim = at(&heats[0], on_the_far_edge) - at(&heats[0], in_the_middle);
    println!("ln(u on the far edge of the hexagon / u in its middle): {rim:.2}");
    assert!(rim > 5.0, "the edge is twice as far as the middle, but heat gets there first");

    assert_figure(
        "figure_4_edges.png",
        &[
            picture_panel(&line, &[source]),
            heat_panel(&along_grey, source),
            heat_panel(&along_edges, source),
            picture_panel(&wide, &starts),
            heat_panel(&heats[0], starts[0]),
            heat_panel(&heats[1], starts[1]),
        ],
    );
}
