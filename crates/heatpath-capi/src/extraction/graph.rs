//! Curves as nodes and branches.

use crate::handles::{borrow, free};
use crate::status::{Failure, guard, hp_status};
use crate::structs::{self, Versioned};
use heatpath_core::grid::Shape;
use heatpath_core::grid::keypoints::KeyPoints;
use heatpath_core::grid::skeleton::{Branch, Graph};

/// All was found that there was to find.
pub const HP_STOP_COMPLETE: u32 = 0;
/// Votes kept as large a part of the image as they may.
pub const HP_STOP_LARGEST_SHARE: u32 = 1;
/// Another round of votes found little that was new.
pub const HP_STOP_SETTLED: u32 = 2;
/// These were all rounds of votes.
pub const HP_STOP_ROUNDS: u32 = 3;
/// There were as many key points as there may be, 10,000.
pub const HP_STOP_MOST: u32 = 4;

/// Curves as a graph: nodes, and branches between them.
///
/// Made by hp_votes_create(), hp_key_points_create() or hp_skeleton_create(), and freed by
/// hp_graph_free(). It does not change, so any number of threads may use it at once, and any thread
/// may free it once the others are done.
pub struct hp_graph {
    info: hp_graph_info,
    nodes: Vec<hp_graph_node>,
    branches: Vec<Curve>,
    /// The coordinates of all sources, one after the other.
    sources: Vec<f64>,
}

struct Curve {
    info: hp_graph_branch,
    coordinates: Vec<f64>,
    radii: Vec<f64>,
}

/// What is known about a graph. Set struct_size, then call hp_graph_describe().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_graph_info {
    /// sizeof(hp_graph_info).
    pub struct_size: u32,
    /// The number of coordinates of a point, 2 or 3.
    pub dimension: u32,
    /// The number of nodes.
    pub node_count: u64,
    /// The number of branches.
    pub branch_count: u64,
    /// The number of sources, given or found.
    pub source_count: u64,
    /// The length of all branches, in physical units.
    pub physical_length: f64,
    /// The rounds of votes; 0 without votes.
    pub rounds: u64,
    /// Why the search ended: one of HP_STOP_...
    pub stop: u32,
    /// 0.
    pub reserved: u32,
}

/// An end or a junction of branches, or a key point. Set struct_size, then call hp_graph_node_at().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_graph_node {
    /// sizeof(hp_graph_node).
    pub struct_size: u32,
    /// How many ends of branches meet here.
    pub degree: u32,
    /// x, y and, in a volume, z, in pixel coordinates; 0 otherwise.
    pub point: [f64; 3],
    /// The radius of the structure, in physical units; not a number for key points.
    pub radius: f64,
    /// The key point from which this one was found; -1 for sources, and if nodes are no key points.
    pub parent: i64,
}

/// A curve between two nodes. Set struct_size, then call hp_graph_branch_at().
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct hp_graph_branch {
    /// sizeof(hp_graph_branch).
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// The node at its first point.
    pub from: u64,
    /// The node at its last point; the same on a closed curve.
    pub to: u64,
    /// The number of points.
    pub point_count: u64,
    /// The length in pixels.
    pub length: f64,
    /// The length in physical units.
    pub physical_length: f64,
    /// The physical length over that of the straight line between the ends; infinite on a closed curve.
    pub tortuosity: f64,
    /// The mean of the radii along the curve, in physical units; not a number between key points.
    pub mean_radius: f64,
}

// SAFETY: integers and floats, 8-byte numbers or two 4-byte ones at the end.
unsafe impl Versioned for hp_graph_info {
    const NAME: &'static str = "hp_graph_info";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            dimension: 0,
            node_count: 0,
            branch_count: 0,
            source_count: 0,
            physical_length: 0.0,
            rounds: 0,
            stop: HP_STOP_COMPLETE,
            reserved: 0,
        }
    }
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_graph_node {
    const NAME: &'static str = "hp_graph_node";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        let struct_size = size_of::<Self>() as u32;
        Self { struct_size, degree: 0, point: [0.0; 3], radius: f64::NAN, parent: -1 }
    }
}

// SAFETY: integers and floats, 8-byte numbers at the end.
unsafe impl Versioned for hp_graph_branch {
    const NAME: &'static str = "hp_graph_branch";
    const SHORTEST: usize = 8;

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            from: 0,
            to: 0,
            point_count: 0,
            length: 0.0,
            physical_length: 0.0,
            tortuosity: f64::INFINITY,
            mean_radius: f64::NAN,
        }
    }
}

impl hp_graph {
    pub(super) fn of_skeleton<const D: usize>(
        graph: &Graph<D>,
        sources: &[[f64; D]],
        stop: u32,
        rounds: usize,
    ) -> Self {
        let node = |node: &heatpath_core::grid::skeleton::Node<D>| hp_graph_node {
            degree: node.degree as u32,
            radius: node.radius,
            ..node_at(node.point)
        };
        let branch = |branch: &Branch<D>| Curve {
            info: hp_graph_branch {
                from: branch.from as u64,
                to: branch.to as u64,
                point_count: branch.points.len() as u64,
                length: branch.length,
                physical_length: branch.physical_length,
                tortuosity: branch.tortuosity,
                mean_radius: branch.mean_radius,
                ..hp_graph_branch::defaults()
            },
            coordinates: branch.points.as_flattened().to_vec(),
            radii: branch.radii.clone(),
        };
        let nodes = graph.nodes.iter().map(node).collect();
        let branches = graph.branches.iter().map(branch).collect();
        Self::new::<D>(nodes, branches, sources, (stop, rounds))
    }

    pub(super) fn of_key_points<const D: usize>(
        found: &KeyPoints<D>,
        shape: &Shape<D>,
        sources: &[[f64; D]],
        stop: u32,
    ) -> Self {
        let node = |key_point: &heatpath_core::grid::keypoints::KeyPoint<D>| hp_graph_node {
            parent: key_point.parent.map_or(-1, |parent| parent as i64),
            ..node_at(key_point.point)
        };
        let mut nodes: Vec<_> = found.points.iter().map(node).collect();
        let mut branches = Vec::with_capacity(found.links.len());
        for link in &found.links {
            nodes[link.from].degree += 1;
            nodes[link.to].degree += 1;
            let (path, ends) = (&link.path, [link.from, link.to].map(|i| found.points[i].point));
            let chord = shape.physical_distance(ends[0], ends[1]);
            branches.push(Curve {
                info: hp_graph_branch {
                    from: link.from as u64,
                    to: link.to as u64,
                    point_count: path.points.len() as u64,
                    length: path.length,
                    physical_length: path.physical_length,
                    tortuosity: path.physical_length / chord,
                    ..hp_graph_branch::defaults()
                },
                coordinates: path.points.as_flattened().to_vec(),
                radii: vec![f64::NAN; path.points.len()],
            });
        }
        Self::new::<D>(nodes, branches, sources, (stop, 0))
    }

    fn new<const D: usize>(
        nodes: Vec<hp_graph_node>,
        branches: Vec<Curve>,
        sources: &[[f64; D]],
        (stop, rounds): (u32, usize),
    ) -> Self {
        let info = hp_graph_info {
            dimension: D as u32,
            node_count: nodes.len() as u64,
            branch_count: branches.len() as u64,
            source_count: sources.len() as u64,
            physical_length: branches
                .iter()
                .fold(0.0, |sum, branch| sum + branch.info.physical_length),
            rounds: rounds as u64,
            stop,
            ..hp_graph_info::defaults()
        };
        Self { info, nodes, branches, sources: sources.as_flattened().to_vec() }
    }
}

fn node_at<const D: usize>(point: [f64; D]) -> hp_graph_node {
    let mut node = hp_graph_node::defaults();
    node.point[..D].copy_from_slice(&point);
    node
}

/// Frees a graph; NULL is fine.
///
/// # Safety
/// `graph` is NULL or comes from one of the functions that make graphs, and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_free(graph: *mut hp_graph) {
    // SAFETY: the caller's promise.
    guard(|| unsafe { free(graph, "graph") });
}

/// Writes what is known about a graph to *info, whose struct_size must be set.
///
/// # Safety
/// `graph` is NULL or comes from one of the functions that make graphs; `info` is NULL or points to
/// as many bytes as its `struct_size` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_describe(
    graph: *const hp_graph,
    info: *mut hp_graph_info,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe { structs::answer(info, &borrow(graph, "graph")?.info, "info") })
}

/// Writes what is known about a node to *node, whose struct_size must be set.
///
/// # Safety
/// As hp_graph_describe().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_node_at(
    graph: *const hp_graph,
    index: u64,
    node: *mut hp_graph_node,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let nodes = &borrow(graph, "graph")?.nodes;
        structs::answer(node, one_of(nodes, index, "node")?, "node")
    })
}

/// Writes what is known about a branch to *branch, whose struct_size must be set.
///
/// # Safety
/// As hp_graph_describe().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_branch_at(
    graph: *const hp_graph,
    index: u64,
    branch: *mut hp_graph_branch,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let branches = &borrow(graph, "graph")?.branches;
        structs::answer(branch, &one_of(branches, index, "branch")?.info, "branch")
    })
}

/// Copies the points of a branch, in pixel coordinates, and the radii there.
///
/// coordinates: receives x, y or x, y, z of each point: hp_graph_info.dimension times as many doubles as
/// hp_graph_branch.point_count says.
///
/// radii: receives a radius for each point, in physical units, not a number between key points. NULL
/// if they are not wanted.
///
/// capacity: for how many points there is room.
///
/// # Safety
/// `graph` is NULL or comes from one of the functions that make graphs; `coordinates` and `radii` are
/// NULL or have room for `capacity` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_branch_points(
    graph: *const hp_graph,
    index: u64,
    coordinates: *mut f64,
    radii: *mut f64,
    capacity: u64,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let branch = one_of(&borrow(graph, "graph")?.branches, index, "branch")?;
        check_room(branch.info.point_count, capacity)?;
        copy(&branch.coordinates, coordinates, "coordinates")?;
        if radii.is_null() { Ok(()) } else { copy(&branch.radii, radii, "radii") }
    })
}

/// Copies the sources, given or found, in pixel coordinates.
///
/// coordinates: receives x, y or x, y, z of each: hp_graph_info.dimension times as many doubles as
/// hp_graph_info.source_count says.
///
/// capacity: for how many points there is room.
///
/// # Safety
/// `graph` is NULL or comes from one of the functions that make graphs; `coordinates` is NULL or has
/// room for `capacity` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hp_graph_sources(
    graph: *const hp_graph,
    coordinates: *mut f64,
    capacity: u64,
) -> hp_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe {
        let graph = borrow(graph, "graph")?;
        check_room(graph.info.source_count, capacity)?;
        copy(&graph.sources, coordinates, "coordinates")
    })
}

fn one_of<'a, T>(items: &'a [T], index: u64, name: &str) -> Result<&'a T, Failure> {
    let found = usize::try_from(index).ok().and_then(|index| items.get(index));
    found.ok_or_else(|| {
        let count = items.len();
        Failure::argument(format!("{name} {index} does not exist: there are {count}, from 0"))
    })
}

fn check_room(points: u64, capacity: u64) -> Result<(), Failure> {
    if points <= capacity {
        return Ok(());
    }
    Err(Failure::argument(format!("capacity is {capacity}, but there are {points} points")))
}

/// # Safety
/// `target` is NULL or has room for the numbers; it need not be aligned.
unsafe fn copy(numbers: &[f64], target: *mut f64, name: &str) -> Result<(), Failure> {
    if target.is_null() {
        return Err(Failure::argument(format!("{name} is NULL")));
    }
    // SAFETY: the caller's promise; bytes need no alignment.
    unsafe {
        let bytes = size_of_val(numbers);
        target.cast::<u8>().copy_from_nonoverlapping(numbers.as_ptr().cast(), bytes);
    }
    Ok(())
}
