//! Skeleton graphs to files: JSON, CSV, SWC and VTP.

use crate::WriteError;
use crate::output::{known_format, write_atomically};
use crate::placement::World;
use crate::points::AXES;
use crate::{Placement, swc, vtp};
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
/// - `.swc`: trees in the world, each rooted at its node that is the nearest to any of the
///   `seeds` (pixel coordinates; its first node if there are none); a branch that would close a loop
///   ends before its last point, which a comment line says;
/// - `.vtp`: polylines in the world with the radius at each point, for VTK and `ParaView`.
///
/// Without a `placement` the centre of the first cell is the origin of the world. In SWC and VTP radii
/// that are not known are 0.
///
/// # Errors
/// The format is unknown, the folder is missing, the file exists and `overwrite` is not set, or the
/// operating system refuses.
pub fn write_graph<const D: usize>(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    graph: &Graph<D>,
    seeds: &[[f64; D]],
    placement: Option<Placement>,
) -> Result<(), WriteError> {
    let world = World::new(graph.shape.spacing(), placement);
    let format = known_format(path.as_ref(), format, &GRAPH_ENDINGS)?;
    write_atomically(path, overwrite, |out| match format {
        "json" => {
            serde_json::to_writer(&mut *out, &Document::new(graph, seeds, placement))?;
            writeln!(out)
        }
        "csv" => write_csv(out, graph),
        "swc" => swc::write_graph(out, graph, seeds, world),
        _ => {
            let lines = graph.branches.iter();
            let lines = lines.map(|branch| (branch.points.as_slice(), branch.radii.as_slice()));
            vtp::write(out, &lines.collect::<Vec<_>>(), world, &[])
        }
    })
}

/// The graph as JSON:
///
/// ```json
/// { "version": 1, "dimension": 2, "spacing": [1.0, 1.0],
///   "nodes": [ { "point": [0.0, 0.0], "degree": 1, "radius": 0.5 } ],
///   "paths": [ { "points": [[0.0, 0.0], [3.0, 4.0]], "length": 5.0, "physical_length": 5.0,
///                "ended": "source", "source": 0, "end": [0.0, 0.0], "from": 0, "to": 1,
///                "tortuosity": 1.0, "mean_radius": 0.5, "radii": [0.5, 0.5] } ] }
/// ```
///
/// The paths are the branches, `from` and `to` their nodes. A path `ended` at `source` if one of the
/// `seeds`, that with the lowest number, is the nearest to a node of its piece of the graph; if none is,
/// it is `unreachable` from them, and `source` is null. Points are in pixel coordinates. With a placement
/// `origin` and `direction` (a unit vector for each axis) follow the spacing. What is infinite,
/// such as the tortuosity of a closed curve, is null.
#[must_use]
pub fn graph_json<const D: usize>(
    graph: &Graph<D>,
    seeds: &[[f64; D]],
    placement: Option<Placement>,
) -> Value {
    // Numbers, strings and lists always convert.
    serde_json::to_value(Document::new(graph, seeds, placement)).unwrap_or_default()
}

/// The layout of the JSON file.
#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    dimension: usize,
    spacing: Vec<f64>,
    #[serde(flatten)]
    placement: Option<Placement>,
    nodes: Vec<NodeEntry<'a>>,
    paths: Vec<BranchEntry<'a>>,
}

#[derive(Serialize)]
struct NodeEntry<'a> {
    point: &'a [f64],
    degree: usize,
    radius: f64,
}

#[derive(Serialize)]
struct BranchEntry<'a> {
    points: Vec<&'a [f64]>,
    length: f64,
    physical_length: f64,
    ended: &'static str,
    source: Option<usize>,
    end: Option<&'a [f64]>,
    from: usize,
    to: usize,
    tortuosity: f64,
    mean_radius: f64,
    radii: &'a [f64],
}

impl<'a> Document<'a> {
    fn new<const D: usize>(
        graph: &'a Graph<D>,
        seeds: &[[f64; D]],
        placement: Option<Placement>,
    ) -> Self {
        let sources = sources(graph, seeds);
        let node = |node: &'a Node<D>| NodeEntry {
            point: &node.point,
            degree: node.degree,
            radius: node.radius,
        };
        let branch = |branch: &'a Branch<D>| BranchEntry {
            points: branch.points.iter().map(<[f64; D]>::as_slice).collect(),
            length: branch.length,
            physical_length: branch.physical_length,
            ended: if sources[branch.from].is_some() { "source" } else { "unreachable" },
            source: sources[branch.from],
            end: branch.points.first().map(<[f64; D]>::as_slice),
            from: branch.from,
            to: branch.to,
            tortuosity: branch.tortuosity,
            mean_radius: branch.mean_radius,
            radii: &branch.radii,
        };
        Self {
            version: 1,
            dimension: D,
            spacing: graph.shape.spacing().to_vec(),
            placement,
            nodes: graph.nodes.iter().map(node).collect(),
            paths: graph.branches.iter().map(branch).collect(),
        }
    }
}

/// The lowest number of a seed in the piece of the graph around each node.
fn sources<const D: usize>(graph: &Graph<D>, seeds: &[[f64; D]]) -> Vec<Option<usize>> {
    let mut sources = vec![None; graph.nodes.len()];
    for (number, &seed) in seeds.iter().enumerate() {
        let distance = |node: &usize| graph.shape.physical_distance(seed, graph.nodes[*node].point);
        let nearest = (0..graph.nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(node) = nearest.filter(|&node| sources[node].is_none()) {
            spread(graph, node, number, &mut sources);
        }
    }
    sources
}

/// Gives a number to all nodes that branches connect with one.
fn spread<const D: usize>(
    graph: &Graph<D>,
    node: usize,
    number: usize,
    numbers: &mut [Option<usize>],
) {
    numbers[node] = Some(number);
    let mut is_growing = true;
    while is_growing {
        is_growing = false;
        for Branch { from, to, .. } in &graph.branches {
            if numbers[*from] != numbers[*to] {
                (numbers[*from], numbers[*to]) = (Some(number), Some(number));
                is_growing = true;
            }
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
