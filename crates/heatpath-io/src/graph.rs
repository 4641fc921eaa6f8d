//! Skeleton graphs to files: JSON, CSV, SWC and VTP.

use crate::WriteError;
use crate::output::{known_format, write_atomically};
use crate::points::AXES;
use crate::{swc, vtp};
use heatpath_core::grid::skeleton::{Branch, Graph, Node};
use serde::Serialize;
use serde_json::Value;
use std::io::{self, Write};
use std::path::Path;

/// The endings by which [`write_graph`] chooses a format.
pub const GRAPH_ENDINGS: [&str; 4] = ["json", "csv", "swc", "vtp"];

/// Writes a graph in the given format, or else in the one that the ending of `path` stands for.
///
/// - `.json`: as [`graph_json`], in one line;
/// - `.csv`: one row a branch, counted from 0, with its nodes, lengths, tortuosity, mean radius and the
///   points of its ends in pixel coordinates:
///   `branch,from,to,length,physical_length,tortuosity,mean_radius,from_x,from_y,to_x,to_y`;
/// - `.swc`: trees in physical units, each rooted at its node that is the nearest to `root` (pixel
///   coordinates; its first node if there is none); a branch that would close a loop ends before its
///   last point, which a comment line says;
/// - `.vtp`: polylines in physical units with the radius at each point, for VTK and `ParaView`.
///
/// In SWC and VTP the centre of the first cell is the origin, and radii that are not known are 0.
///
/// # Errors
/// The format is unknown, the folder is missing, the file exists and `overwrite` is not set, or the
/// operating system refuses.
pub fn write_graph<const D: usize>(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    graph: &Graph<D>,
    root: Option<[f64; D]>,
) -> Result<(), WriteError> {
    let format = known_format(path.as_ref(), format, &GRAPH_ENDINGS)?;
    write_atomically(path, overwrite, |out| match format {
        "json" => {
            serde_json::to_writer(&mut *out, &Document::new(graph))?;
            writeln!(out)
        }
        "csv" => write_csv(out, graph),
        "swc" => swc::write_graph(out, graph, root),
        _ => {
            let lines = graph.branches.iter();
            let lines = lines.map(|branch| (branch.points.as_slice(), branch.radii.as_slice()));
            vtp::write(out, &lines.collect::<Vec<_>>(), graph.shape.spacing())
        }
    })
}

/// The graph as JSON:
///
/// ```json
/// { "version": 1, "dimension": 2, "spacing": [1.0, 1.0],
///   "nodes": [ { "point": [0.0, 0.0], "degree": 1, "radius": 0.5 } ],
///   "branches": [ { "from": 0, "to": 1, "points": [[0.0, 0.0], [3.0, 4.0]], "length": 5.0,
///                   "physical_length": 5.0, "tortuosity": 1.0, "mean_radius": 0.5,
///                   "radii": [0.5, 0.5] } ] }
/// ```
///
/// Points are in pixel coordinates. What is infinite, such as the tortuosity of a closed curve, is
/// null.
#[must_use]
pub fn graph_json<const D: usize>(graph: &Graph<D>) -> Value {
    // Numbers, strings and lists always convert.
    serde_json::to_value(Document::new(graph)).unwrap_or_default()
}

/// The layout of the JSON file.
#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    dimension: usize,
    spacing: Vec<f64>,
    nodes: Vec<NodeEntry<'a>>,
    branches: Vec<BranchEntry<'a>>,
}

#[derive(Serialize)]
struct NodeEntry<'a> {
    point: &'a [f64],
    degree: usize,
    radius: f64,
}

#[derive(Serialize)]
struct BranchEntry<'a> {
    from: usize,
    to: usize,
    points: Vec<&'a [f64]>,
    length: f64,
    physical_length: f64,
    tortuosity: f64,
    mean_radius: f64,
    radii: &'a [f64],
}

impl<'a> Document<'a> {
    fn new<const D: usize>(graph: &'a Graph<D>) -> Self {
        let node = |node: &'a Node<D>| NodeEntry {
            point: &node.point,
            degree: node.degree,
            radius: node.radius,
        };
        let branch = |branch: &'a Branch<D>| BranchEntry {
            from: branch.from,
            to: branch.to,
            points: branch.points.iter().map(<[f64; D]>::as_slice).collect(),
            length: branch.length,
            physical_length: branch.physical_length,
            tortuosity: branch.tortuosity,
            mean_radius: branch.mean_radius,
            radii: &branch.radii,
        };
        Self {
            version: 1,
            dimension: D,
            spacing: graph.shape.spacing().to_vec(),
            nodes: graph.nodes.iter().map(node).collect(),
            branches: graph.branches.iter().map(branch).collect(),
        }
    }
}

fn write_csv<const D: usize>(out: &mut dyn Write, graph: &Graph<D>) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let names = "branch,from,to,length,physical_length,tortuosity,mean_radius".split(',');
    let ends = ["from", "to"].into_iter();
    let ends = ends.flat_map(|end| AXES[..D].iter().map(move |axis| format!("{end}_{axis}")));
    writer.write_record(names.map(str::to_owned).chain(ends))?;
    for (number, branch) in graph.branches.iter().enumerate() {
        let Branch { from, to, length, physical_length, tortuosity, mean_radius, .. } = branch;
        let values = (number, from, to, length, physical_length, tortuosity, mean_radius);
        let ends = [*from, *to].map(|node| graph.nodes[node].point.as_slice());
        writer.serialize((values, ends))?;
    }
    writer.flush()
}
