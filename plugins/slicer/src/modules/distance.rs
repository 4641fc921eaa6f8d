//! Distances in volumes.

use super::shared::{DETAILS, INPUT_VOLUME, MASK, MEDIUM, METHOD, SOURCE, SOURCES_FILE};
use crate::module::{FileKind, Group, Kind, Module, Parameter};

/// `heatpath distance`
pub const DISTANCE: Module = Module {
    name: "HeatpathDistance",
    title: "Heatpath Distance",
    description: "The geodesic distance of each voxel from the sources, by letting heat flow.",
    command: &["heatpath", "distance", "--physical"],
    groups: &[
        Group {
            label: "Volumes and points",
            advanced: false,
            parameters: &[
                INPUT_VOLUME,
                Parameter {
                    name: "outputVolume",
                    label: "Distances",
                    description: "The distances; infinite where nothing was reached",
                    option: "--output",
                    kind: Kind::result(FileKind::Image),
                },
                SOURCE,
                SOURCES_FILE,
                MASK,
            ],
        },
        MEDIUM,
        DETAILS,
        METHOD,
    ],
};
