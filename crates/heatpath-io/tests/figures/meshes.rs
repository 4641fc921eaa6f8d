//! The figure of a mesh: 11.

use super::assert_figure;
use heatpath_core::Exec;
use heatpath_core::mesh::path::{Ending, Path};
use heatpath_core::mesh::shapes::{BLOCK_DIVISION, Block, block};
use heatpath_core::mesh::{
    Curvature, CurvatureMediumOptions, CurvatureOptions, Geodesics, GeodesicsOptions, Medium,
    Method, Sources, SurfacePoint, TriMesh,
};
use heatpath_io::{MeshPicture, Up, View, render_mesh};
use image::{Rgb, RgbImage};
use std::collections::BTreeSet;
use std::sync::Arc;

/// How far the curvature of a vertex reaches, in mean edges: to no other vertex.
const RADIUS: f64 = 0.6;
/// The squared speed where the block is flat.
const FLOOR: f64 = 0.001;

fn mean_edge(mesh: &TriMesh) -> f64 {
    let lengths = mesh.edge_lengths();
    lengths.iter().sum::<f64>() / lengths.len() as f64
}

/// Speed by curvature.
fn medium(mesh: &Arc<TriMesh>, exec: &Exec) -> Arc<Medium> {
    let radius = Some(RADIUS * mean_edge(mesh));
    let options = CurvatureOptions { radius, ..Default::default() };
    let curvature = Curvature::new(mesh, options, exec).unwrap();
    let options = CurvatureMediumOptions { floor: FLOOR, ..Default::default() };
    Medium::curvature(Arc::clone(mesh), &curvature, options).unwrap().into()
}

fn length([a, b]: [[f64; 3]; 2]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The two vertices between which a point of a path lies; the same twice if it is one itself.
fn ends_of_edge(mesh: &TriMesh, point: &SurfacePoint) -> BTreeSet<u32> {
    let corners = mesh.faces()[point.face as usize].into_iter().zip(point.weights);
    corners.filter(|(_, weight)| *weight > 0.0).map(|(vertex, _)| vertex).collect()
}

/// The pieces of paths that do not run along sharp edges.
fn off_edges(mesh: &TriMesh, sharp: &BTreeSet<Vec<u32>>, paths: &[Path]) -> Vec<[[f64; 3]; 2]> {
    let mut off = Vec::new();
    for path in paths {
        for (points, positions) in path.points.windows(2).zip(path.positions.windows(2)) {
            let [a, b] = [0, 1].map(|i| ends_of_edge(mesh, &points[i]));
            if !sharp.contains(&a.union(&b).copied().collect::<Vec<_>>()) {
                off.push([positions[0], positions[1]]);
            }
        }
    }
    off
}

/// The vertices at which more than two sharp edges meet.
fn corners(mesh: &TriMesh, sharp: &[[u32; 2]]) -> Vec<[f64; 3]> {
    let mut count = vec![0; mesh.points().len()];
    sharp.iter().flatten().for_each(|&vertex| count[vertex as usize] += 1);
    let corners = (0..count.len()).filter(|&vertex| count[vertex] > 2);
    corners.map(|vertex| mesh.points()[vertex]).collect()
}

/// On white.
fn mesh_panel(mesh: &TriMesh, picture: &MeshPicture<'_>) -> RgbImage {
    let view = View::Angles { up: Up::Z, azimuth: -32.0, elevation: 35.0 };
    let drawn =
        render_mesh(mesh, &MeshPicture { size: [300, 220], view, smooth: false, ..*picture });
    let drawn = drawn.unwrap();
    RgbImage::from_fn(drawn.width(), drawn.height(), |x, y| {
        let [r, g, b, alpha] = drawn.get_pixel(x, y).0.map(u32::from);
        Rgb([r, g, b].map(|part| ((part * alpha + 255 * (255 - alpha)) / 255) as u8))
    })
}

/// Figure 11: in the metric of curvature, paths run along the edges of a block.
#[test]
fn figure_11_block() {
    let exec = Exec::new(0).unwrap();
    let Block { mesh, sharp_edges } = block(BLOCK_DIVISION);
    let mesh = Arc::new(mesh);
    let on_edges: BTreeSet<u32> = sharp_edges.iter().flatten().copied().collect();
    let on_edges: Vec<u32> = on_edges.into_iter().collect();
    let sources = [100, 400, 700].map(|i| on_edges[i]);
    let sources = Sources::at_vertices(&mesh, &sources).unwrap();
    let ends = (0..10).map(|i| on_edges[(i * 7919 + 4711) % on_edges.len()]);
    let ends: Vec<_> = ends.map(|end| mesh.at_vertex("end", 0, end).unwrap()).collect();

    let options = GeodesicsOptions { method: Method::Eikonal, ..Default::default() };
    let geodesics = Geodesics::new(medium(&mesh, &exec), options, &exec).unwrap();
    let (distances, paths) = geodesics.paths(&sources, &ends, &exec).unwrap();
    assert!(paths.iter().all(|path| matches!(path.ending, Ending::Source(_))));

    let sharp = sharp_edges.iter().map(|edge| edge.to_vec()).collect();
    let off = off_edges(&mesh, &sharp, &paths);
    let all: f64 = paths.iter().map(|path| path.length).sum();
    let part = 1.0 - off.iter().map(|&piece| length(piece)).sum::<f64>() / all;
    let corners = corners(&mesh, &sharp_edges);
    let beside = |&a: &[f64; 3]| corners.iter().map(|&b| length([a, b])).fold(f64::MAX, f64::min);
    let farthest = off.iter().flatten().map(beside).fold(0.0, f64::max) / mean_edge(&mesh);
    println!("{} faces, {:.2} % on edges", mesh.faces().len(), 100.0 * part);
    println!("off edges only at {} corners, up to {farthest:.2} mean edges away", corners.len());
    assert!(part > 0.97 && farthest < 2.0, "{part}, {farthest}");

    let places: Vec<_> = sources.list().iter().map(|s| mesh.position(&s.point)).collect();
    let block = MeshPicture { sources: &places, ..Default::default() };
    let map = MeshPicture { values: Some(distances.values()), isolines: 12, ..block };
    let panels = [block, map, MeshPicture { paths: &paths, ..block }];
    assert_figure("figure_11_block.png", &panels.map(|picture| mesh_panel(&mesh, &picture)));
}
