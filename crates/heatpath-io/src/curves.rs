//! Curves to files: JSON, CSV, SVG, SWC and VTP.

use crate::output::{check_dimension, known_format, write_atomically};
use crate::placement::World;
use crate::points::AXES;
use crate::{Placement, WriteError, svg, swc, vtp};
use heatpath_core::grid::Shape;
use heatpath_core::grid::keypoints::KeyPoint;
use heatpath_core::grid::path::{Ending, Path as Curve};
use serde::Serialize;
use serde_json::Value;
use std::io::{self, Write};
use std::path::Path;

/// Minimal paths and what is needed to place them in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves<const D: usize> {
    /// The physical distance between neighbouring cell centres along each axis.
    pub spacing: [f64; D],
    /// Where the grid lies in the world; none: the first cell at 0, the axes along those of the world.
    pub placement: Option<Placement>,
    /// The paths, each from its end point to its source, in pixel coordinates.
    pub paths: Vec<Curve<D>>,
    /// The key points that the paths connect; none if there are no such.
    pub key_points: Vec<KeyPoint<D>>,
}

impl<const D: usize> Curves<D> {
    /// The endings by which [`write_curves`] chooses a format.
    pub const ENDINGS: [&'static str; 5] = ["json", "csv", "svg", "swc", "vtp"];
}

/// Writes curves in the given format, or else in the one that the ending of `path` stands for.
///
/// - `.json`: as [`curves_json`], in one line;
/// - `.csv`: one row a point with the columns `path,point,x,y,ended` (in volumes
///   `path,point,x,y,z,ended`), all counted from 0, with as many digits as are needed to read the
///   same numbers back;
/// - `.svg`, of pictures only: a drawing in pixel coordinates (the centre of the first pixel is at
///   0,0), as large as the picture of the given `shape`, to be laid over it;
/// - `.swc`: each path as a tree in the world, its source the root, the radii 0;
/// - `.vtp`: polylines in the world, for VTK and `ParaView`, with the arrays `end` (the path's
///   number), `source`, `length` (physical) and `distance`; the source and the distance are -1 where
///   there is none.
///
/// # Errors
/// The format is unknown or for pictures only, the folder is missing, the file exists and
/// `overwrite` is not set, or the operating system refuses.
pub fn write_curves<const D: usize>(
    path: impl AsRef<Path>,
    format: Option<&str>,
    overwrite: bool,
    curves: &Curves<D>,
    shape: &Shape<D>,
) -> Result<(), WriteError> {
    let format = known_format(path.as_ref(), format, &Curves::<D>::ENDINGS)?;
    check_dimension(&path, Some(format), D)?;
    let world = World::new(curves.spacing, curves.placement);
    write_atomically(path, overwrite, |out| match format {
        "json" => write_json(out, curves),
        "csv" => write_csv(out, curves),
        "swc" => swc::write_paths(out, points(curves), world),
        "vtp" => {
            let lines: Vec<_> = points(curves).map(|points| (points, &[][..])).collect();
            vtp::write(out, &lines, world, &arrays(curves))
        }
        _ => out.write_all(svg::drawing(curves, shape).as_bytes()),
    })
}

fn points<const D: usize>(curves: &Curves<D>) -> impl Iterator<Item = &[[f64; D]]> {
    curves.paths.iter().map(|path| path.points.as_slice())
}

/// What a polyline of VTK knows of its path.
fn arrays<const D: usize>(curves: &Curves<D>) -> [vtp::LineArray; 4] {
    let column = |value: &dyn Fn(&Curve<D>) -> f64| curves.paths.iter().map(value).collect();
    let source = |path: &Curve<D>| match path.ending {
        Ending::Source(source) => source as f64,
        _ => -1.0,
    };
    let distance = |path: &Curve<D>| if path.distance.is_finite() { path.distance } else { -1.0 };
    [
        ("end", (0..curves.paths.len()).map(|end| end as f64).collect()),
        ("source", column(&source)),
        ("length", column(&|path| path.physical_length)),
        ("distance", column(&distance)),
    ]
}

/// The curves as JSON:
///
/// ```json
/// { "version": 1, "dimension": 2, "spacing": [1.0, 1.0],
///   "paths": [ { "points": [[3.0, 4.0], [0.0, 0.0]], "length": 5.0, "physical_length": 5.0,
///                "ended": "source", "source": 0, "end": [3.0, 4.0], "distance": 5.0,
///                "cost": 5.0 } ],
///   "keypoints": [ { "point": [0.0, 0.0], "parent": null } ] }
/// ```
///
/// With a placement `origin` and `direction` (a unit vector for each axis) follow the spacing. `ended` is
/// `source`, `unreachable`, `not_reached` or `step_limit`; `source` is null unless the
/// path ended at one, `distance` is null where there is none, and `cost` also on meshes and of curves that
/// were found without ends. The key points are left out if there
/// are none; `parent` is the number of the key point at which one's path ends, null for seeds.
#[must_use]
pub fn curves_json<const D: usize>(curves: &Curves<D>) -> Value {
    // Numbers, strings and lists always convert.
    serde_json::to_value(Document::new(curves)).unwrap_or_default()
}

/// The name of an ending in files: `source`, `unreachable`, `not_reached` or `step_limit`.
#[must_use]
pub fn ending_name(ending: Ending) -> &'static str {
    match ending {
        Ending::Source(_) => "source",
        Ending::Unreachable => "unreachable",
        Ending::NotReached => "not_reached",
        Ending::StepLimit => "step_limit",
    }
}

/// The layout of the JSON file.
#[derive(Serialize)]
struct Document<'a> {
    version: u32,
    dimension: usize,
    spacing: &'a [f64],
    #[serde(flatten)]
    placement: Option<Placement>,
    paths: Vec<Entry<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    keypoints: Vec<KeyPointEntry<'a>>,
}

/// One key point in the JSON file.
#[derive(Serialize)]
struct KeyPointEntry<'a> {
    point: &'a [f64],
    parent: Option<usize>,
}

/// One path in the JSON file.
#[derive(Serialize)]
struct Entry<'a> {
    points: Vec<&'a [f64]>,
    length: f64,
    physical_length: f64,
    ended: &'static str,
    source: Option<usize>,
    end: Option<&'a [f64]>,
    /// Infinity becomes null.
    distance: f64,
    /// Infinity and NaN become null.
    cost: f64,
}

impl<'a> Document<'a> {
    fn new<const D: usize>(curves: &'a Curves<D>) -> Self {
        let key_point =
            |key: &'a KeyPoint<D>| KeyPointEntry { point: &key.point, parent: key.parent };
        Self {
            version: 1,
            dimension: D,
            spacing: &curves.spacing,
            placement: curves.placement,
            paths: curves.paths.iter().map(Entry::new).collect(),
            keypoints: curves.key_points.iter().map(key_point).collect(),
        }
    }
}

impl<'a> Entry<'a> {
    fn new<const D: usize>(path: &'a Curve<D>) -> Self {
        Self {
            points: path.points.iter().map(<[f64; D]>::as_slice).collect(),
            length: path.length,
            physical_length: path.physical_length,
            ended: ending_name(path.ending),
            source: match path.ending {
                Ending::Source(source) => Some(source),
                _ => None,
            },
            end: path.points.first().map(<[f64; D]>::as_slice),
            distance: path.distance,
            cost: path.cost,
        }
    }
}

fn write_json<const D: usize>(out: &mut dyn Write, curves: &Curves<D>) -> io::Result<()> {
    serde_json::to_writer(&mut *out, &Document::new(curves))?;
    writeln!(out)
}

fn write_csv<const D: usize>(out: &mut dyn Write, curves: &Curves<D>) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    let header = ["path", "point"].into_iter().chain(AXES[..D].iter().copied());
    writer.write_record(header.chain(["ended"]))?;
    for (i, path) in curves.paths.iter().enumerate() {
        for (j, point) in path.points.iter().enumerate() {
            writer.serialize((i, j, point.as_slice(), ending_name(path.ending)))?;
        }
    }
    writer.flush()
}
