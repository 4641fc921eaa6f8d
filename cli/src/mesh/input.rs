//! The mesh, and points on it.

use super::args::{MeshArgs, MeshSourceArgs, Place};
use crate::failure::Failure;
use heatpath_core::mesh::clean::{CleanError, CleanOptions, CleanReport};
use heatpath_core::mesh::{Locator, PointError, Source, Sources, SurfacePoint, TriMesh};
use heatpath_io::mesh::{MeshFile, read_mesh};
use heatpath_io::{ReadError, read_points};
use std::path::Path;
use std::sync::Arc;

/// A mesh from a file.
pub(super) struct Input {
    pub(super) mesh: Arc<TriMesh>,
    pub(super) report: CleanReport,
    /// The vertex that each of the file's became.
    vertices: Vec<u32>,
    file: MeshFile,
}

impl Input {
    pub(super) fn read(args: &MeshArgs) -> Result<Self, Failure> {
        let file = read_mesh(&args.input)?;
        let options = match (args.weld, args.no_weld) {
            (Some(distance), _) => CleanOptions { weld: Some(distance) },
            (None, true) => CleanOptions { weld: None },
            (None, false) => file.usual_options(),
        };
        let cleaned = file.clean(options).map_err(|error| match error {
            ReadError::Clean { source: CleanError::Parameter(error), .. } => Failure::usage(error),
            error => error.into(),
        })?;
        let (mesh, report) = (Arc::new(cleaned.mesh), cleaned.report);
        Ok(Self { mesh, report, vertices: cleaned.vertices, file })
    }

    /// The array of this name, for the vertices of the mesh.
    pub(super) fn array(&self, name: &str) -> Result<Vec<f64>, Failure> {
        let Some((_, values)) = self.file.arrays.iter().find(|(own, _)| own == name) else {
            let names: Vec<&str> = self.file.arrays.iter().map(|(own, _)| own.as_str()).collect();
            let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            return Err(Failure::bad_input(format!(
                "{}: has no values named `{name}`; there are: {there}",
                self.file.path.display()
            )));
        };
        if let Some(vertex) = values.iter().position(|value| !value.is_finite()) {
            return Err(Failure::bad_input(format!(
                "{}: the value of `{name}` at vertex {vertex} is {}; all must be finite",
                self.file.path.display(),
                values[vertex]
            )));
        }
        let mut array = vec![0.0; self.mesh.points().len()];
        let pairs = self.vertices.iter().zip(values).rev();
        pairs.for_each(|(&vertex, &value)| array[vertex as usize] = value);
        Ok(array)
    }

    /// Values of the vertices of the mesh for those of the file.
    pub(super) fn for_file(&self, values: &[f64]) -> Vec<f64> {
        self.vertices.iter().map(|&vertex| values[vertex as usize]).collect()
    }

    /// The points of the file.
    pub(super) fn file_points(&self) -> &[[f64; 3]] {
        self.file.soup.points()
    }

    /// The points that a user gave, in the file's numbers and in space.
    pub(super) fn points(
        &self,
        role: &'static str,
        places: &[Place],
        file: Option<&Path>,
    ) -> Result<Vec<SurfacePoint>, Failure> {
        let mut places = places.to_vec();
        if let Some(file) = file {
            places.extend(read_points::<3>(file)?.into_iter().map(Place::Space));
        }
        let is_in_space = |place: &Place| matches!(place, Place::Space(_));
        let locator = places.iter().any(is_in_space).then(|| Locator::new(&self.mesh));
        let point = |(number, place): (usize, &Place)| match (place, &locator) {
            (Place::Space(place), Some(locator)) => Ok(locator.nearest(*place).0),
            (Place::Vertex(vertex), _) => self.vertex(role, number, *vertex),
            (Place::Space(_), None) => Err(PointError::Missing { role }),
        };
        Ok(places.iter().enumerate().map(point).collect::<Result<_, _>>()?)
    }

    fn vertex(
        &self,
        role: &'static str,
        number: usize,
        vertex: u32,
    ) -> Result<SurfacePoint, PointError> {
        let Some(&own) = self.vertices.get(vertex as usize) else {
            return Err(PointError::Vertex { role, number, vertex, vertices: self.vertices.len() });
        };
        let named = |error| match error {
            PointError::Unused { .. } => PointError::Unused { role, number, vertex },
            error => error,
        };
        self.mesh.at_vertex(role, number, own).map_err(named)
    }

    /// The sources: points first, then curves, numbered in this order.
    pub(super) fn sources(&self, args: &MeshSourceArgs) -> Result<Sources, Failure> {
        let points = self.points("source", &args.source, args.sources.as_deref())?;
        let source = |point, label: usize| Source { point, offset: 0.0, label: label as u32 };
        let mut list: Vec<Source> =
            points.iter().enumerate().map(|(label, &point)| source(point, label)).collect();
        for (number, file) in args.curve.iter().enumerate() {
            let curve = Locator::new(&self.mesh).along(&read_points::<3>(file)?);
            list.extend(curve.into_iter().map(|point| source(point, points.len() + number)));
        }
        Ok(Sources::with_offsets(&self.mesh, list)?)
    }
}
