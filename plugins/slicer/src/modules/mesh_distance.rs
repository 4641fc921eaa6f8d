//! Distances on meshes.

use super::shared::{FARTHEST, SOURCE, SOURCES_FILE, THREADS};
use crate::module::{Channel, FileKind, Group, Kind, Module, Parameter};

/// `heatpath mesh distance`
pub const MESH_DISTANCE: Module = Module {
    name: "HeatpathMeshDistance",
    title: "Heatpath Mesh Distance",
    description: "The geodesic distance of each vertex of a model from the sources.",
    command: &["heatpath", "mesh", "distance"],
    groups: &[
        Group {
            label: "Models and points",
            advanced: false,
            parameters: &[
                Parameter {
                    name: "inputModel",
                    label: "Input model",
                    description: "The surface, of any polygons",
                    option: "",
                    kind: Kind::File {
                        kind: FileKind::Geometry,
                        channel: Channel::Input,
                        position: Some(0),
                    },
                },
                Parameter {
                    name: "outputModel",
                    label: "Output model",
                    description: "The surface with the array distance",
                    option: "--output",
                    kind: Kind::result(FileKind::Geometry),
                },
                SOURCE,
                SOURCES_FILE,
            ],
        },
        Group {
            label: "Medium",
            advanced: false,
            parameters: &[
                Parameter {
                    name: "medium",
                    label: "Ways are short",
                    description: "uniform: everywhere alike; curvature: where the surface bends; crease: \
                                  along ridges and valleys, but not across them",
                    option: "--medium",
                    kind: Kind::Choice { among: &["uniform", "curvature", "crease"] },
                },
                Parameter {
                    name: "bend",
                    label: "Bends",
                    description: "Which bends of the surface are fast",
                    option: "--bend",
                    kind: Kind::Choice { among: &["both", "convex", "concave"] },
                },
            ],
        },
        Group {
            label: "Distance",
            advanced: true,
            parameters: &[
                Parameter {
                    name: "method",
                    label: "Method",
                    description: "auto: exact for up to 20,000 faces, else eikonal; heat: smooth; eikonal: \
                                  fast marching; exact: exact to rounding",
                    option: "--method",
                    kind: Kind::Choice { among: &["auto", "heat", "eikonal", "exact"] },
                },
                FARTHEST,
                THREADS,
            ],
        },
    ],
};
