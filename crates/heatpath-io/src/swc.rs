//! Trees as SWC: one line a point, `id type x y z radius parent`, ids from 1, parent -1 at a root.

use crate::placement::World;
use crate::points::{Trouble, excerpt};
use crate::vtp::known;
use heatpath_core::grid::skeleton::{Branch, Graph};
use std::collections::{HashMap, VecDeque};
use std::io::{self, Write};

/// Writes points with the ids of their parents.
struct Writer<'a, const D: usize> {
    out: &'a mut dyn Write,
    world: World<D>,
    last: usize,
}

impl<'a, const D: usize> Writer<'a, D> {
    fn new(out: &'a mut dyn Write, world: World<D>) -> io::Result<Self> {
        writeln!(out, "# id type x y z radius parent, in physical units")?;
        Ok(Self { out, world, last: 0 })
    }

    /// Writes a point; its id.
    fn point(&mut self, point: [f64; D], radius: f64, parent: Option<usize>) -> io::Result<usize> {
        self.last += 1;
        let ([x, y, z], radius) = (self.world.point(point), known(radius));
        let parent = parent.map_or("-1".to_owned(), |parent| parent.to_string());
        writeln!(self.out, "{} 0 {x} {y} {z} {radius} {parent}", self.last)?;
        Ok(self.last)
    }
}

/// Writes paths, each as a tree of its own with the root at its last point, the source.
pub(crate) fn write_paths<'a, const D: usize>(
    out: &mut dyn Write,
    paths: impl Iterator<Item = &'a [[f64; D]]>,
    world: World<D>,
) -> io::Result<()> {
    let mut writer = Writer::new(out, world)?;
    for points in paths {
        let mut parent = None;
        for &point in points.iter().rev() {
            parent = Some(writer.point(point, 0.0, parent)?);
        }
    }
    Ok(())
}

/// Writes a graph as trees, each rooted at its node that is the nearest to any of `seeds`.
pub(crate) fn write_graph<const D: usize>(
    out: &mut dyn Write,
    graph: &Graph<D>,
    seeds: &[[f64; D]],
    world: World<D>,
) -> io::Result<()> {
    let distance = |node: usize| {
        let to = |&seed: &[f64; D]| graph.shape.physical_distance(seed, graph.nodes[node].point);
        seeds.iter().map(to).fold(f64::INFINITY, f64::min)
    };
    let mut order: Vec<usize> = (0..graph.nodes.len()).collect();
    order.sort_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    let mut at = vec![Vec::new(); graph.nodes.len()];
    for (number, branch) in graph.branches.iter().enumerate() {
        at[branch.from].push(number);
        at[branch.to].push(number);
    }
    let mut tree = Tree {
        graph,
        ids: vec![None; graph.nodes.len()],
        written: vec![false; graph.branches.len()],
        writer: Writer::new(out, world)?,
    };
    for root in order {
        if tree.ids[root].is_none() {
            tree.grow(root, &at)?;
        }
    }
    Ok(())
}

/// What has been written of a graph.
struct Tree<'a, const D: usize> {
    graph: &'a Graph<D>,
    /// The ids of nodes.
    ids: Vec<Option<usize>>,
    written: Vec<bool>,
    writer: Writer<'a, D>,
}

impl<const D: usize> Tree<'_, D> {
    fn grow(&mut self, root: usize, at: &[Vec<usize>]) -> io::Result<()> {
        let node = &self.graph.nodes[root];
        self.ids[root] = Some(self.writer.point(node.point, node.radius, None)?);
        let mut waiting = VecDeque::from([root]);
        while let Some(node) = waiting.pop_front() {
            for &number in &at[node] {
                if !std::mem::replace(&mut self.written[number], true) {
                    waiting.extend(self.branch(number, node)?);
                }
            }
        }
        Ok(())
    }

    /// Writes a branch from one of its nodes on; the other one if it is new.
    fn branch(&mut self, number: usize, start: usize) -> io::Result<Option<usize>> {
        let Branch { from, to, points, radii, .. } = &self.graph.branches[number];
        let forward = *from == start;
        let end = if forward { *to } else { *from };
        let is_new = self.ids[end].is_none();
        let mut places: Vec<usize> = (1..points.len() - usize::from(!is_new)).collect();
        if !forward {
            places.iter_mut().for_each(|place| *place = points.len() - 1 - *place);
        }
        if !is_new {
            writeln!(self.writer.out, "# a loop is cut: branch {number} ends before node {end}")?;
        }
        let mut id = self.ids[start];
        for place in places {
            id = Some(self.writer.point(points[place], radii[place], id)?);
        }
        if is_new {
            self.ids[end] = id;
        }
        Ok(is_new.then_some(end))
    }
}

/// Reads trees as polylines in physical units: one between each two ends or branching points.
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Vec<[f64; 3]>>, Trouble> {
    let mut places: HashMap<i64, usize> = HashMap::new();
    let (mut points, mut parents) = (Vec::new(), Vec::new());
    for (i, line) in bytes.split(|&c| c == b'\n').enumerate() {
        let line = line.trim_ascii();
        if line.is_empty() || line.starts_with(b"#") {
            continue;
        }
        let trouble = |reason: String| (format!("line {}", i + 1), reason);
        let text = String::from_utf8_lossy(line);
        let (id, point, parent) = sample(&text).ok_or_else(|| {
            let needed = "expected seven finite numbers: id type x y z radius parent";
            trouble(format!("{needed}, found \"{}\"", excerpt(&text)))
        })?;
        let parent = match parent {
            ..0 => None,
            _ => Some(
                *places
                    .get(&parent)
                    .ok_or_else(|| trouble(format!("the parent {parent} does not stand above")))?,
            ),
        };
        if places.insert(id, points.len()).is_some() {
            return Err(trouble(format!("the id {id} stands above already")));
        }
        points.push(point);
        parents.push(parent);
    }
    Ok(chains(&points, &parents))
}

/// The id, the point and the parent of a line.
fn sample(line: &str) -> Option<(i64, [f64; 3], i64)> {
    let cells: Vec<&str> = line.split_ascii_whitespace().collect();
    let [id, kind, x, y, z, radius, parent] = cells[..] else {
        return None;
    };
    let finite = |cell: &str| cell.parse::<f64>().ok().filter(|value| value.is_finite());
    finite(kind)?;
    finite(radius)?;
    Some((id.parse().ok()?, [finite(x)?, finite(y)?, finite(z)?], parent.parse().ok()?))
}

/// Each parent stands before its children.
fn chains(points: &[[f64; 3]], parents: &[Option<usize>]) -> Vec<Vec<[f64; 3]>> {
    let mut children = vec![0_usize; points.len()];
    parents.iter().flatten().for_each(|&parent| children[parent] += 1);
    let starts = (0..points.len()).filter(|&i| children[i] != 1);
    let chain = |start: usize| {
        let mut chain = vec![points[start]];
        let mut here = start;
        while let Some(parent) = parents[here] {
            chain.push(points[parent]);
            here = parent;
            if children[parent] != 1 {
                break;
            }
        }
        chain
    };
    starts.filter(|&i| parents[i].is_some() || children[i] == 0).map(chain).collect()
}
