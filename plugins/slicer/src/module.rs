//! What a module is.

/// A program that Slicer can run.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The name of the program.
    pub name: &'static str,
    /// How it is called in Slicer.
    pub title: &'static str,
    /// What it does, in a sentence or two.
    pub description: &'static str,
    /// The first words of the command line of `heatpath`.
    pub command: &'static [&'static str],
    /// The parameters, in the order of the panel.
    pub groups: &'static [Group],
}

/// Parameters under one heading.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// The heading.
    pub label: &'static str,
    /// Whether it is folded away at first.
    pub advanced: bool,
    /// What stands under it.
    pub parameters: &'static [Parameter],
}

/// What the user can choose.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name, and that of the program's option: letters and digits only, as nipype and Slicer ask.
    pub name: &'static str,
    /// Its name on the panel.
    pub label: &'static str,
    /// The hint that explains it.
    pub description: &'static str,
    /// The option of the command `heatpath` that it becomes; empty for the input, which has none.
    pub option: &'static str,
    /// What values it takes.
    pub kind: Kind,
}

/// The values of a parameter. One that has its usual value is not passed on, so that the command
/// decides.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A file; one with a `position`, from 0 on, is required and has no option.
    File {
        /// What is in it.
        kind: FileKind,
        /// Whether it is read or written.
        channel: Channel,
        /// Its place among the words without option.
        position: Option<usize>,
    },
    /// Any number of points in the world, in LPS as in DICOM.
    Points,
    /// A number.
    Number {
        /// The usual one.
        usual: f64,
    },
    /// A whole number.
    Integer {
        /// The usual one.
        usual: i64,
    },
    /// Numbers with commas between them; usually none.
    Numbers,
    /// One word of several.
    Choice {
        /// All of them, the usual one first.
        among: &'static [&'static str],
    },
}

impl Kind {
    /// A file that may be read as well.
    pub(crate) const fn input(kind: FileKind) -> Self {
        Self::File { kind, channel: Channel::Input, position: None }
    }

    /// The file for the result, the second word.
    pub(crate) const fn result(kind: FileKind) -> Self {
        Self::File { kind, channel: Channel::Output, position: Some(1) }
    }
}

/// What is in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FileKind {
    /// A picture or volume.
    Image,
    /// A picture or volume whose values are names.
    LabelMap,
    /// A mesh or curves.
    Geometry,
    /// Anything else.
    Any,
}

/// Whether a file is read or written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Channel {
    /// It is read.
    Input,
    /// It is written.
    Output,
}
