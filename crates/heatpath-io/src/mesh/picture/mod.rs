//! Pictures of meshes, drawn without a graphics card.

mod canvas;
mod marks;
mod surface;
mod view;

pub use view::{Up, View};

use crate::WriteError;
use crate::colour::finite_range_of;
use crate::field::write_png;
use crate::legend::with_bar;
use crate::output::{known_format, write_atomically};
use canvas::Canvas;
use heatpath_core::mesh::TriMesh;
use heatpath_core::mesh::path::Path as MeshPath;
use image::{Rgb, RgbImage, RgbaImage};
use std::io;
use std::path::Path;
use thiserror::Error;
use view::Camera;

/// The longest side of a picture.
const MOST_PIXELS: usize = 4096;

/// What is drawn, and how.
#[derive(Clone, Copy, Debug)]
pub struct MeshPicture<'a> {
    /// Columns and rows of pixels, each up to 4096. Default: 800 x 600.
    pub size: [usize; 2],
    /// Where from. Default: [`View::Automatic`] with y upwards.
    pub view: View,
    /// Whether the light changes smoothly across edges of less than 30 degrees. Default: yes.
    pub smooth: bool,
    /// A value for each vertex, in colours from the smallest to the largest finite one; faces with
    /// a corner that is not finite are grey. Default: none, and the mesh is light grey.
    pub values: Option<&'a [f64]>,
    /// The number of intervals into which dark lines of equal value part the range. Default: 0, no
    /// lines.
    pub isolines: usize,
    /// Paths: cyan if they ended at a source, else dashed and orange; with white dots at their end
    /// points and red crosses at the sources at which they ended. Default: none.
    pub paths: &'a [MeshPath],
    /// Further sources, drawn as red crosses too. Default: none.
    pub sources: &'a [[f64; 3]],
}

impl Default for MeshPicture<'_> {
    fn default() -> Self {
        Self {
            size: [800, 600],
            view: View::default(),
            smooth: true,
            values: None,
            isolines: 0,
            paths: &[],
            sources: &[],
        }
    }
}

/// Why a mesh cannot be drawn.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PictureError {
    /// A side of the picture has no pixels or too many.
    #[error("a picture of {} x {} pixels; from 1 to {MOST_PIXELS} a side can be drawn", size[0], size[1])]
    Size {
        /// Columns and rows.
        size: [usize; 2],
    },
    /// There are more or fewer values than vertices.
    #[error("{given} values were given for {expected} vertices")]
    Values {
        /// How many values there are.
        given: usize,
        /// How many there should be.
        expected: usize,
    },
    /// An angle of the view is not finite.
    #[error("the view has the angles {angles:?}; they must be finite")]
    Angles {
        /// Azimuth and elevation.
        angles: [f64; 2],
    },
}

/// Draws a mesh in parallel projection, lit from the eye, on a transparent ground.
///
/// Both sides of faces are drawn alike. What lies behind the surface is hidden, paths and crosses
/// too. Edges are smoothed by 2 x 2 samples a pixel.
///
/// # Errors
/// The size is out of range, there is not one value a vertex, or an angle is not finite.
pub fn render_mesh(mesh: &TriMesh, picture: &MeshPicture<'_>) -> Result<RgbaImage, PictureError> {
    check(mesh, picture)?;
    let mut canvas = Canvas::new(picture.size);
    let camera = Camera::new(mesh, picture.view, canvas.size());
    surface::draw(&mut canvas, mesh, &camera, picture);
    marks::draw(&mut canvas, &camera, picture);
    Ok(canvas.into_picture())
}

/// Writes the picture of a mesh as PNG, on white, with a colour bar if there are values.
///
/// # Errors
/// As [`render_mesh`]; the ending is not `.png`, the folder is missing, the file exists and
/// `overwrite` is not set, or the operating system refuses.
pub fn write_mesh_picture(
    path: impl AsRef<Path>,
    overwrite: bool,
    mesh: &TriMesh,
    picture: &MeshPicture<'_>,
    title: Option<&str>,
) -> Result<(), WriteError> {
    known_format(path.as_ref(), None, &["png"])?;
    write_atomically(path, overwrite, |out| {
        let map = on_white(&render_mesh(mesh, picture).map_err(io::Error::other)?);
        write_png(out, &with_bar(&map, picture.values.and_then(finite_range_of), title))
    })
}

fn check(mesh: &TriMesh, picture: &MeshPicture<'_>) -> Result<(), PictureError> {
    if !picture.size.iter().all(|side| (1..=MOST_PIXELS).contains(side)) {
        return Err(PictureError::Size { size: picture.size });
    }
    let (given, expected) = (picture.values.map(<[f64]>::len), mesh.points().len());
    if let Some(given) = given.filter(|&given| given != expected) {
        return Err(PictureError::Values { given, expected });
    }
    if let View::Angles { azimuth, elevation, .. } = picture.view
        && !(azimuth.is_finite() && elevation.is_finite())
    {
        return Err(PictureError::Angles { angles: [azimuth, elevation] });
    }
    Ok(())
}

fn on_white(picture: &RgbaImage) -> RgbImage {
    RgbImage::from_fn(picture.width(), picture.height(), |x, y| {
        let [r, g, b, a] = picture.get_pixel(x, y).0.map(u32::from);
        Rgb([r, g, b].map(|c| ((c * a + 255 * (255 - a) + 127) / 255) as u8))
    })
}
