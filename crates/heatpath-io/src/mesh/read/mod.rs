//! From a mesh file's bytes to points and polygons: one file per format, all with the same result.

mod cursor;
mod freesurfer;
mod gltf;
mod obj;
mod off;
mod ply;
mod stl;
mod values;
mod vtk;
mod vtp;
mod xml_data;

pub use values::read_mesh_values;

use super::MeshFormat;
use crate::ReadError;
use crate::decode::one_line;
use crate::picture::read_bytes;
use heatpath_core::mesh::clean::{CleanOptions, Cleaned, Soup, clean};
use std::path::{Path, PathBuf};

/// A mesh as its file holds it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshFile {
    /// The file.
    pub path: PathBuf,
    /// Its format.
    pub format: MeshFormat,
    /// Points and polygons; their numbers are those of the file, counted from 0.
    pub soup: Soup,
    /// Values of the points by name, such as `quality` or `distance`: one a point.
    pub arrays: Vec<(String, Vec<f64>)>,
    /// The colour of each point: red, green, blue; none if the file has none.
    pub colours: Option<Vec<[u8; 3]>>,
}

/// Reads a mesh. The content decides the format; the ending of the name decides where the content
/// does not say it (OBJ, binary STL of a wrong length, OFF without its first word).
///
/// # Errors
/// The file cannot be read, is no mesh, or is damaged.
pub fn read_mesh(path: impl AsRef<Path>) -> Result<MeshFile, ReadError> {
    read_mesh_from_bytes(&read_bytes(path.as_ref())?, path)
}

/// [`read_mesh`] of a file whose content is `bytes`; `name` stands in messages, and its ending
/// counts.
///
/// # Errors
/// As [`read_mesh`].
pub fn read_mesh_from_bytes(bytes: &[u8], name: impl AsRef<Path>) -> Result<MeshFile, ReadError> {
    let path = name.as_ref().to_owned();
    if bytes.is_empty() {
        return Err(ReadError::Empty { path });
    }
    let Some(format) = MeshFormat::recognise(bytes, &path) else {
        return Err(ReadError::UnrecognisedMesh { path });
    };
    let found = match format {
        MeshFormat::Ply => ply::read(bytes),
        MeshFormat::Obj => obj::read(bytes),
        MeshFormat::Stl => stl::read(bytes),
        MeshFormat::Off => off::read(bytes),
        MeshFormat::Vtk => vtk::read(bytes),
        MeshFormat::Vtp => vtp::read(bytes),
        MeshFormat::Gltf => gltf::read(bytes),
        MeshFormat::FreeSurfer => freesurfer::read(bytes),
    };
    match found.map(Found::with_full_arrays) {
        Ok(found) if found.soup.points().is_empty() => {
            Err(ReadError::Mesh { path, format, reason: "has no points".to_owned() })
        }
        Ok(Found { soup, arrays, colours }) => Ok(MeshFile { path, format, soup, arrays, colours }),
        Err(reason) => Err(ReadError::Mesh { path, format, reason: one_line(&reason) }),
    }
}

/// Positions in files of 32-bit floats that differ by less than this part of the largest coordinate
/// are meant to be one: a few units in the last place.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

impl MeshFile {
    /// How files of this format need to be cleaned. STL and glTF write vertices more than once, and
    /// not always to the last bit: they are welded within 4.8e-7 of the largest coordinate. Others
    /// keep their vertices.
    #[must_use]
    pub fn usual_options(&self) -> CleanOptions {
        let largest =
            self.soup.points().iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let distance = if largest > 1e-90 { ROUNDING * largest } else { 0.0 };
        CleanOptions { weld: self.format.is_torn().then_some(distance) }
    }

    /// The mesh, with [`usual_options`](Self::usual_options) or others.
    ///
    /// # Errors
    /// What the file holds is no mesh.
    pub fn clean(&self, options: CleanOptions) -> Result<Cleaned, ReadError> {
        clean(&self.soup, options)
            .map_err(|source| ReadError::Clean { path: self.path.clone(), source })
    }
}

/// What a reader found, or in a few words why it found nothing.
type Reading = Result<Found, String>;

#[derive(Default)]
struct Found {
    soup: Soup,
    arrays: Vec<(String, Vec<f64>)>,
    colours: Option<Vec<[u8; 3]>>,
}

impl Found {
    fn new(soup: Soup) -> Self {
        Self { soup, ..Self::default() }
    }

    /// Drops arrays that do not have a value for each point.
    fn with_full_arrays(mut self) -> Self {
        let points = self.soup.points().len();
        self.arrays.retain(|(_, values)| values.len() == points);
        self.colours = self.colours.filter(|colours| colours.len() == points);
        self
    }
}

/// The number of a vertex, counted from 0; whether there is such a one is seen later.
fn vertex(number: f64) -> Result<u32, String> {
    let is_number = number >= 0.0 && number <= f64::from(u32::MAX) && number.fract() == 0.0;
    is_number.then_some(number as u32).ok_or_else(|| format!("a face uses vertex {number}"))
}

/// Adds the triangles of a strip, each second one turned round.
fn push_strip(soup: &mut Soup, strip: &[u32]) {
    for (number, triangle) in strip.windows(3).enumerate() {
        let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
        soup.push(if number % 2 == 0 { [a, b, c] } else { [b, a, c] });
    }
}
