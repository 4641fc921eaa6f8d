//! Parameters of several modules.

use crate::module::{Channel, FileKind, Group, Kind, Parameter};

pub(super) const INPUT_VOLUME: Parameter = Parameter {
    name: "inputVolume",
    label: "Input volume",
    description: "The picture or volume that makes the medium",
    option: "",
    kind: Kind::File { kind: FileKind::Image, channel: Channel::Input, position: Some(0) },
};

pub(super) const SOURCE: Parameter = Parameter {
    name: "source",
    label: "Sources",
    description: "Points from which distances count",
    option: "--source",
    kind: Kind::Points,
};

pub(super) const SOURCES_FILE: Parameter = Parameter {
    name: "sourcesFile",
    label: "File of sources",
    description: "More sources from a file: CSV or JSON, in the same coordinates (LPS, mm)",
    option: "--sources",
    kind: Kind::input(FileKind::Any),
};

pub(super) const MASK: Parameter = Parameter {
    name: "mask",
    label: "Mask",
    description: "A label map of the same size whose zeros are walls",
    option: "--mask",
    kind: Kind::input(FileKind::LabelMap),
};

pub(super) const RANGE: Parameter = Parameter {
    name: "range",
    label: "Range of values",
    description: "The two values that become grey values 0 and 1; none: the full range of 8 and 16 \
                  bit without sign, else that of the volume",
    option: "--range",
    kind: Kind::Numbers,
};

pub(super) const SCALE: Parameter = Parameter {
    name: "scale",
    label: "Half widths of tubes",
    description: "Half widths, in mm, of the tubes that vesselness looks for, or the one of a tensor; \
                  none: 2, 3 and 4.5 voxels, of a tensor 2",
    option: "--scale",
    kind: Kind::Numbers,
};

pub(super) const SCALE_CHOICE: Parameter = Parameter {
    name: "scaleChoice",
    label: "Choice of half widths",
    description: "given: those above; auto: one to three, from the tubes of the volume itself (vesselness \
                  only)",
    option: "--scale",
    kind: Kind::Choice { among: &["given", "auto"] },
};

pub(super) const CONTRAST: Parameter = Parameter {
    name: "contrast",
    label: "Contrast",
    description: "The change of grey value per voxel that holds heat back (perona-malik, combined), or \
                  the contrast of a full tube (vesselness); 0: 0.03, or the largest of the volume",
    option: "--contrast",
    kind: Kind::Number { usual: 0.0 },
};

pub(super) const POLARITY: Parameter = Parameter {
    name: "polarity",
    label: "Tubes are",
    description: "Which tubes vesselness and tensor look for; automatic: bright ones, and of a tensor \
                  both",
    option: "--polarity",
    kind: Kind::Choice { among: &["automatic", "bright", "dark", "both"] },
};

pub(super) const ANISOTROPY: Parameter = Parameter {
    name: "anisotropy",
    label: "Anisotropy",
    description: "How much faster heat is along tubes than across, 0 to 0.9998; -1: 0.9, with \
                  vesselness 0",
    option: "--anisotropy",
    kind: Kind::Number { usual: -1.0 },
};

pub(super) const FARTHEST: Parameter = Parameter {
    name: "farthest",
    label: "Farthest",
    description: "Distances end here, in volumes those of eikonal; 0: no end",
    option: "--farthest",
    kind: Kind::Number { usual: 0.0 },
};

pub(super) const THREADS: Parameter = Parameter {
    name: "threads",
    label: "Threads",
    description: "How many threads work; 0: one per processor",
    option: "--threads",
    kind: Kind::Integer { usual: 0 },
};

pub(super) const MEDIUM: Group = Group {
    label: "Medium",
    advanced: false,
    parameters: &[
        Parameter {
            name: "medium",
            label: "Heat flows",
            description: "conductivity: where values resemble the source's; uniform: everywhere alike; \
                          perona-malik: inside regions without edges; combined: both; edges: along \
                          edges and lines; tensor: along directions; vesselness: through tubes",
            option: "--medium",
            kind: Kind::Choice {
                among: &[
                    "conductivity",
                    "uniform",
                    "perona-malik",
                    "combined",
                    "edges",
                    "tensor",
                    "vesselness",
                ],
            },
        },
        RANGE,
        POLARITY,
        SCALE,
        SCALE_CHOICE,
    ],
};

pub(super) const DETAILS: Group = Group {
    label: "Details of the medium",
    advanced: true,
    parameters: &[
        Parameter {
            name: "power",
            label: "Power",
            description: "How strongly unlike grey values are held back; 0: 3, with vesselness 2",
            option: "--power",
            kind: Kind::Number { usual: 0.0 },
        },
        Parameter {
            name: "floor",
            label: "Floor",
            description: "What keeps the medium above zero; 0: 0.001, with vesselness 0.0001",
            option: "--floor",
            kind: Kind::Number { usual: 0.0 },
        },
        Parameter {
            name: "reference",
            label: "Reference",
            description: "The grey value, 0 to 1, that conductivity compares with; -1: that of the \
                          sources",
            option: "--reference",
            kind: Kind::Number { usual: -1.0 },
        },
        CONTRAST,
        Parameter {
            name: "smooth",
            label: "Smoothing",
            description: "The standard deviation, in mm, of the Gaussian before derivatives",
            option: "--smooth",
            kind: Kind::Number { usual: 0.0 },
        },
        ANISOTROPY,
    ],
};

pub(super) const METHOD: Group = Group {
    label: "Distance",
    advanced: true,
    parameters: &[
        Parameter {
            name: "estimator",
            label: "Estimator",
            description: "normalized: read from heat; varadhan: the same without correction; \
                          heat-method: by the directions of heat; eikonal: exactly, by fast marching",
            option: "--estimator",
            kind: Kind::Choice { among: &["normalized", "varadhan", "heat-method", "eikonal"] },
        },
        Parameter {
            name: "solver",
            label: "Solver",
            description: "explicit: many small steps of heat; implicit: one long one, for small volumes",
            option: "--solver",
            kind: Kind::Choice { among: &["explicit", "implicit"] },
        },
        Parameter {
            name: "iterations",
            label: "Iterations",
            description: "Steps of heat; 0: three times the longest side of a volume",
            option: "--iterations",
            kind: Kind::Integer { usual: 0 },
        },
        FARTHEST,
        THREADS,
    ],
};
