//! Triangle meshes from and to files.
//!
//! | format | read | written |
//! | --- | --- | --- |
//! | PLY | text and both binary orders; polygons, triangle strips; scalars, colours | binary, with scalars |
//! | OBJ | polygons, negative numbers; texture coordinates and normals never split vertices | bare |
//! | STL | text and binary | binary, bare |
//! | OFF | with or without colours, normals and texture coordinates | bare |
//! | VTK legacy | poly data, text and binary, old and new layout; strips; scalars | binary, with scalars |
//! | VTP | text, base64, appended, zlib; strips; scalars | base64, with scalars |
//! | GLB, glTF | triangles of the scene in its coordinates; buffers in the file itself | - |
//! | `FreeSurfer` | triangle surfaces; curvature files by [`read_mesh_values`] | - |
//!
//! ```
//! use heatpath_core::mesh::shapes::icosphere;
//! use heatpath_io::{read_mesh, write_mesh};
//!
//! # let folder = tempfile::tempdir()?;
//! let path = folder.path().join("sphere.ply");
//! let sphere = icosphere(2);
//! let heights: Vec<f64> = sphere.points().iter().map(|point| point[2]).collect();
//! write_mesh(&path, None, false, &sphere, &[("height", &heights)])?;
//!
//! let file = read_mesh(&path)?;
//! assert_eq!(file.arrays, [("height".to_owned(), heights)]);
//! let cleaned = file.clean(file.usual_options())?;
//! assert_eq!(cleaned.mesh, sphere);
//! assert_eq!(cleaned.report.to_string(), "components: 1\nEuler characteristic: 2");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod format;
pub mod picture;
mod read;
mod write;

pub use format::MeshFormat;
pub use picture::{MeshPicture, Up, View, render_mesh, write_mesh_picture};
pub use read::{MeshFile, read_mesh, read_mesh_from_bytes, read_mesh_values};
pub use write::{
    MESH_ENDINGS, PATH_ENDINGS, PointArray, mesh_curves, write_mesh, write_mesh_paths,
    write_mesh_values,
};
