//! Files to and from the nouns of `heatpath-core`.
//!
//! | direction | what | formats |
//! | --- | --- | --- |
//! | in | pictures, fields, masks ([`read_picture`], [`read_field`], [`read_mask`]) | PNG, JPEG, TIFF, PNM, NPY |
//! | in | the same of volumes | TIFF of several pages, NPY of three axes |
//! | in | pictures and volumes with their place in the world ([`Placement`]) | `NIfTI`, NRRD, `MetaImage`, DICOM |
//! | in | tensor fields ([`read_tensors`]) | NPY with one more axis |
//! | in | a picture or a volume, as the file says ([`ImageFile`]) | as these |
//! | in | points ([`read_points`]) | CSV, JSON |
//! | in | curves ([`CurveFile`]) | JSON, CSV, SWC |
//! | in | triangle meshes ([`read_mesh`]) | PLY, OBJ, STL, OFF, VTK, VTP, glTF, `FreeSurfer` |
//! | in | values of their vertices ([`read_mesh_values`]) | NPY, CSV, `FreeSurfer` |
//! | in | what a file holds ([`info`](fn@info)) | as pictures and volumes |
//! | out | fields and masks ([`write_field`], [`write_mask`]) | NPY, TIFF, PNG, `NIfTI`, NRRD, `MetaImage` |
//! | out | curves ([`write_curves`]) | JSON, CSV, SVG, SWC, VTP |
//! | out | skeleton graphs ([`write_graph`]) | JSON, CSV, SWC, VTP |
//! | out | meshes and values of their vertices ([`write_mesh`]) | PLY, VTP, VTK; bare OBJ, OFF, STL |
//! | out | the values alone ([`write_mesh_values`]) | CSV, NPY |
//! | out | paths on meshes ([`write_mesh_paths`]) | JSON, CSV, SWC, VTP |
//! | out | a mesh with values and paths ([`write_mesh_picture`]) | PNG |
//! | out | recall and precision ([`write_scores`]) | JSON, CSV |
//! | out | a result on its picture or on slices of its volume ([`write_overlay`]) | PNG |
//! | out | what was written, small ([`thumbnail`](fn@thumbnail)) | JPEG in memory |
//!
//! Of volumes PNG shows overlays only, and SVG nothing; all else is the same in two and three
//! dimensions.
//!
//! Inputs are recognised by their content, outputs by the ending of their name. Inputs are not
//! trusted: no size is believed before the file is long enough for it, and each error is one line
//! that names the file, what was wrong and what would have been accepted. Outputs appear complete
//! or not at all ([`write_atomically`]); a header and its data file do so each by itself. Well-kept
//! crates do the formats; this one holds what lies between them and a
//! [`Grid`](heatpath_core::grid::Grid), and the formats of meshes and medical volumes.
//!
//! ```
//! use heatpath_core::grid::{Grid, Shape};
//! use heatpath_io::{FieldStyle, PictureOptions, info, read_field, read_picture, write_field};
//!
//! # let folder = tempfile::tempdir()?;
//! let path = folder.path().join("ramp.npy");
//! let ramp = Grid::from_fn(Shape::new([3, 2])?, |[x, _]| x as f64);
//! write_field(&path, None, false, &ramp, &FieldStyle::default())?;
//!
//! assert_eq!(read_field(&path, [1.0, 1.0])?, ramp);
//! assert_eq!(read_picture::<2>(&path, &PictureOptions::default())?[[1, 0]], 0.5);
//! assert_eq!(info(&path)?.sample.to_string(), "float64");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod canvas;
pub mod colour;
pub mod curves;
mod decode;
mod encode;
mod error;
pub mod field;
pub mod graph;
mod info;
mod legend;
mod memory;
pub mod mesh;
pub mod output;
pub mod overlay;
pub mod picture;
mod placement;
mod points;
mod polylines;
mod sample;
pub mod scores;
mod slices;
mod svg;
mod swc;
mod text;
pub mod thumbnail;
mod vtp;

pub use colour::colour_map;
pub use curves::{Curves, curves_json, write_curves};
pub use decode::Format;
pub use error::{ReadError, WriteError};
pub use field::{FieldFormat, FieldStyle, write_field, write_mask};
pub use graph::{graph_json, write_graph};
pub use info::{Info, info};
pub use mesh::{
    MeshFile, MeshFormat, MeshPicture, Up, View, mesh_curves, read_mesh, read_mesh_from_bytes,
    read_mesh_values, render_mesh, write_mesh, write_mesh_paths, write_mesh_picture,
    write_mesh_values,
};
pub use output::{check_dimension, check_output, data_file, remove_leftovers, write_atomically};
pub use overlay::{Overlay, write_overlay};
pub use picture::{
    Channel, ImageFile, PictureOptions, read_field, read_mask, read_picture, read_tensors,
};
pub use placement::{Placement, gap_between};
pub use points::{read_points, read_points_from_bytes};
pub use polylines::CurveFile;
pub use sample::SampleType;
pub use scores::{scores_json, write_scores};
pub use thumbnail::{Thumbnail, thumbnail};
