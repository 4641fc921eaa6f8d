//! Trees of vessels.

use super::shared::{
    ANISOTROPY, CONTRAST, INPUT_VOLUME, MASK, POLARITY, RANGE, SCALE, SCALE_CHOICE, SOURCE,
    SOURCES_FILE, THREADS,
};
use crate::module::{Channel, FileKind, Group, Kind, Module, Parameter};

/// `heatpath vote` on tubes
pub const VESSEL_TREE: Module = Module {
    name: "HeatpathVesselTree",
    title: "Heatpath Vessel Tree",
    description: "The tree of vessels as curves with radii, found by the votes of many minimal paths; \
                  sources are optional.",
    command: &["heatpath", "vote", "--physical", "--medium", "vesselness"],
    groups: &[
        Group {
            label: "Volumes and points",
            advanced: false,
            parameters: &[
                INPUT_VOLUME,
                Parameter {
                    name: "outputTree",
                    label: "Tree",
                    description: "The branches as lines, with the radius at each point",
                    option: "--output",
                    kind: Kind::result(FileKind::Geometry),
                },
                SOURCE,
                SOURCES_FILE,
                MASK,
                Parameter {
                    name: "outputDensity",
                    label: "Votes",
                    description: "How many paths cross each voxel",
                    option: "--density",
                    kind: Kind::File {
                        kind: FileKind::Image,
                        channel: Channel::Output,
                        position: None,
                    },
                },
            ],
        },
        Group {
            label: "Vessels",
            advanced: false,
            parameters: &[POLARITY, SCALE, SCALE_CHOICE, RANGE, PRUNE],
        },
        Group {
            label: "Details",
            advanced: true,
            parameters: &[CONTRAST, ANISOTROPY, NORMALIZE, EXTENT, THREADS],
        },
    ],
};

const PRUNE: Parameter = Parameter {
    name: "prune",
    label: "Shortest branch",
    description: "Branches that end in the open are cut if they are shorter than this, in mm",
    option: "--prune",
    kind: Kind::Number { usual: 0.0 },
};

const NORMALIZE: Parameter = Parameter {
    name: "normalize",
    label: "Even contrast",
    description: "Makes the contrast the same everywhere, over this many mm; 0: leaves it",
    option: "--normalize",
    kind: Kind::Number { usual: 0.0 },
};

const EXTENT: Parameter = Parameter {
    name: "extent",
    label: "Shortest piece",
    description: "Without sources, each piece of vessel that is this many voxels long is followed; 0: a \
                  sixteenth of the longest side",
    option: "--extent",
    kind: Kind::Number { usual: 0.0 },
};
