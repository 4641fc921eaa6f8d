//! Pictures of the retina with an observer's centrelines.

use crate::Failure;
use heatpath_core::Exec;
use heatpath_core::grid::filter::normalize_contrast;
use heatpath_core::grid::{Grid, Mask};
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

/// A picture.
#[derive(Debug)]
pub(crate) struct Picture {
    pub(crate) chosen_by: bool,
    /// The negative of the green channel, in which vessels are bright.
    pub(crate) grey: Grid<f64, 2>,
    /// The same, relative to its surroundings in view.
    pub(crate) contrast: Grid<f64, 2>,
    /// The first observer's centrelines.
    pub(crate) centrelines: Mask<2>,
}

/// The standard deviation of the surroundings, in pixels.
const SURROUNDINGS: f64 = 15.0;

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

    pub(crate) fn read(&self, data: &Path, name: &str, exec: &Exec) -> Result<Picture, Failure> {
        let folder = data.join(self.folder);
        let options = PictureOptions { channel: Channel::Green, ..PictureOptions::default() };
        let image = folder.join("images").join(format!("{name}.{}", self.ending));
        let green = read_picture::<2>(image, &options)?;
        let mask = |part: &str| read_mask(folder.join(part).join(format!("{name}.png")), [1.0; 2]);
        let grey = green.map(|value| 1.0 - value);
        Ok(Picture {
            chosen_by: self.chosen_by.iter().any(|beginning| name.starts_with(beginning)),
            contrast: normalize_contrast(&grey, SURROUNDINGS, &mask("fov_png")?, exec)?,
            grey,
            centrelines: mask("centerline")?,
        })
    }
}
