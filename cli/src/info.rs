//! `heatpath info`

use crate::args::InfoArgs;
use crate::failure::Failure;
use crate::input::size_text;
use crate::mesh::MeshFacts;
use crate::output;
use heatpath_io::mesh::read_mesh;
use heatpath_io::{ImageFile, Info, ReadError};
use serde::Serialize;

pub(crate) fn info(args: &InfoArgs) -> Result<(), Failure> {
    let info = match ImageFile::read_component(&args.input, args.component).map(|file| file.info())
    {
        Err(ReadError::Unrecognised { .. }) => return mesh_info(args),
        info => info?,
    };
    if args.json {
        return output::print_json(&info);
    }
    let values = match (info.min, info.max) {
        (Some(min), Some(max)) => format!("values from {min} to {max}"),
        _ => "no finite values".to_owned(),
    };
    output::print(&format!(
        "{}: {}, {} {}, channels: {}, type: {}, {values}",
        args.input.display(),
        info.format,
        size_text(&info.size),
        if info.size.len() == 2 { "pixels" } else { "voxels" },
        info.channels,
        info.sample,
    ))?;
    place(&info).iter().try_for_each(|line| output::print(line))
}

/// Where the file says that it lies in the world.
fn place(info: &Info) -> Option<String> {
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let (spacing, place) = (info.spacing.as_ref()?, info.placement?);
    let axes = place.direction.iter().take(info.size.len()).map(|axis| format!("({})", list(axis)));
    let axes: Vec<String> = axes.collect();
    Some(format!(
        "spacing {}, origin {} (LPS), axes along {}",
        list(spacing),
        list(&place.origin),
        axes.join(" ")
    ))
}

/// What `--json` prints of a mesh.
#[derive(Serialize)]
struct MeshInfo {
    format: String,
    /// The corners of the bounding box.
    bounds: [[f64; 3]; 2],
    mean_edge: f64,
    values: Vec<String>,
    mesh: MeshFacts,
}

fn mesh_info(args: &InfoArgs) -> Result<(), Failure> {
    let file = read_mesh(&args.input).map_err(|error| match error {
        ReadError::UnrecognisedMesh { path } => {
            let path = path.display();
            Failure::bad_input(format!("{path}: the content is no known picture and no known mesh"))
        }
        error => error.into(),
    })?;
    let cleaned = file.clean(file.usual_options())?;
    let values: Vec<String> = file.arrays.iter().map(|(name, _)| name.clone()).collect();
    let (vertices, faces) = (cleaned.mesh.points().len(), cleaned.mesh.faces().len());
    let (bounds, lengths) = (cleaned.mesh.bounds(), cleaned.mesh.edge_lengths());
    let mean_edge = lengths.iter().sum::<f64>() / lengths.len() as f64;
    if args.json {
        let mesh = MeshFacts::new(vertices, faces, &cleaned.report);
        let format = file.format.to_string();
        return output::print_json(&MeshInfo { format, bounds, mean_edge, values, mesh });
    }
    let named = if values.is_empty() { "none".to_owned() } else { values.join(", ") };
    let input = args.input.display();
    output::print(&format!(
        "{input}: {}, {vertices} vertices, {faces} triangles, values: {named}",
        file.format
    ))?;
    let [low, high] = bounds.map(|corner| corner.map(|x| x.to_string()).join(","));
    output::print(&format!("from {low} to {high}, mean edge {mean_edge:.6}"))?;
    cleaned.report.to_string().lines().try_for_each(output::print)
}
