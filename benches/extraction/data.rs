//! Pictures of the retina with an observer's centrelines.

use crate::Failure;
use heatpath_core::grid::filter::gaussian;
use heatpath_core::grid::{Grid, Mask, Shape};
use heatpath_io::{Channel, PictureOptions, read_mask, read_picture};
use std::fs;
use std::path::Path;

/// A set of pictures.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DataSet {
    pub(crate) name: &'static str,
    folder: &'static str,
    ending: &'static str,
    /// The pictures by which options were chosen begin with one of these.
    chosen_by: &'static [&'static str],
}

/// The sets, as folders of the data's folder.
pub(crate) const SETS: [DataSet; 2] = [
    DataSet {
        name: "CHASE_DB1",
        folder: "retina_chase",
        ending: "jpg",
        chosen_by: &["Image_01", "Image_03", "Image_05", "Image_07"],
    },
    DataSet {
        name: "STARE",
        folder: "retina_stare",
        ending: "ppm",
        chosen_by: &["im0002", "im0004", "im0044", "im0081"],
    },
];

/// A picture at half size.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) chosen_by: bool,
    /// The negative of the green channel, in which vessels are bright.
    pub(crate) grey: Grid<f64, 2>,
    /// The same, relative to its surroundings.
    pub(crate) contrast: Grid<f64, 2>,
    /// The first observer's centrelines, in full size.
    pub(crate) centrelines: Mask<2>,
}

/// The standard deviation of the surroundings, in cells of the halved picture.
const SURROUNDINGS: f64 = 20.0;

/// What is added to the deviation of grey values, so that flat parts do not become noise.
const LEAST_DEVIATION: f64 = 0.01;

impl DataSet {
    /// The names of the pictures, in order.
    pub(crate) fn names(&self, data: &Path) -> Result<Vec<String>, Failure> {
        let mut names = Vec::new();
        for entry in fs::read_dir(data.join(self.folder).join("images"))? {
            let path = entry?.path();
            names.extend(path.file_stem().map(|name| name.to_string_lossy().into_owned()));
        }
        names.sort();
        Ok(names)
    }

    pub(crate) fn read(&self, data: &Path, name: &str) -> Result<Picture, Failure> {
        let folder = data.join(self.folder);
        let options = PictureOptions { channel: Channel::Green, ..PictureOptions::default() };
        let image = folder.join("images").join(format!("{name}.{}", self.ending));
        let green = read_picture::<2>(image, &options)?;
        let mask = |part: &str| read_mask(folder.join(part).join(format!("{name}.png")), [1.0; 2]);
        let view = mask("fov_png")?;
        let grey = halved(&green.map(|value| 1.0 - value))?;
        let view = halved(&view.open().map(|&open| f64::from(u8::from(open))))?;
        Ok(Picture {
            chosen_by: self.chosen_by.iter().any(|beginning| name.starts_with(beginning)),
            contrast: contrast(&grey, &view.map(|&share| f64::from(u8::from(share == 1.0))))?,
            grey,
            centrelines: mask("centerline")?,
        })
    }
}

/// The means of two by two cells; the last row and column may have fewer.
fn halved(image: &Grid<f64, 2>) -> Result<Grid<f64, 2>, Failure> {
    let size = image.shape().size();
    let shape = Shape::new(size.map(|n| n.div_ceil(2)))?;
    Ok(Grid::from_fn(shape, |[x, y]| {
        let rows = 2 * y..(2 * y + 2).min(size[1]);
        let cells = rows.flat_map(|y| (2 * x..(2 * x + 2).min(size[0])).map(move |x| [x, y]));
        let (sum, count) = cells.fold((0.0, 0.0), |(sum, n), cell| (sum + image[cell], n + 1.0));
        sum / count
    }))
}

/// The difference from the mean of the surroundings in view, over the deviation there; 0 out of view.
fn contrast(grey: &Grid<f64, 2>, view: &Grid<f64, 2>) -> Result<Grid<f64, 2>, Failure> {
    let shape = *grey.shape();
    let weights = gaussian(view, SURROUNDINGS)?;
    let mean = |values: &Grid<f64, 2>| -> Result<Grid<f64, 2>, Failure> {
        let sums = gaussian(&Grid::from_fn(shape, |i| values[i] * view[i]), SURROUNDINGS)?;
        Ok(Grid::from_fn(shape, |i| if view[i] > 0.0 { sums[i] / weights[i] } else { 0.0 }))
    };
    let means = mean(grey)?;
    let differences = Grid::from_fn(shape, |i| (grey[i] - means[i]) * view[i]);
    let variances = mean(&differences.map(|difference| difference * difference))?;
    Ok(Grid::from_fn(shape, |i| differences[i] / (variances[i].sqrt() + LEAST_DEVIATION)))
}
