//! Paths in volumes.

use super::shared::{DETAILS, INPUT_VOLUME, MASK, MEDIUM, METHOD, SOURCE, SOURCES_FILE};
use crate::module::{FileKind, Group, Kind, Module, Parameter};

/// `heatpath path`
pub const PATH: Module = Module {
    name: "HeatpathPath",
    title: "Heatpath Path",
    description: "Minimal paths from end points to the sources, along vessels, edges or regions.",
    command: &["heatpath", "path", "--physical"],
    groups: &[
        Group {
            label: "Volumes and points",
            advanced: false,
            parameters: &[
                INPUT_VOLUME,
                Parameter {
                    name: "outputPaths",
                    label: "Paths",
                    description: "The paths as lines, each from its end to a source",
                    option: "--output",
                    kind: Kind::result(FileKind::Geometry),
                },
                SOURCE,
                Parameter {
                    name: "end",
                    label: "Ends",
                    description: "Points from which paths begin",
                    option: "--end",
                    kind: Kind::Points,
                },
                SOURCES_FILE,
                Parameter {
                    name: "endsFile",
                    label: "File of ends",
                    description: "More ends from a file: CSV or JSON, in the same coordinates (LPS, mm)",
                    option: "--ends",
                    kind: Kind::input(FileKind::Any),
                },
                MASK,
            ],
        },
        MEDIUM,
        DETAILS,
        METHOD,
    ],
};
