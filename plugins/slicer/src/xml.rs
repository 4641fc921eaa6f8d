//! How a module describes itself to Slicer.

use crate::module::{Channel, FileKind, Group, Kind, Module, Parameter};
use quick_xml::escape::partial_escape;
use std::fmt::Write;

/// The description of a module as XML of the Slicer Execution Model.
#[must_use]
pub fn description(module: &Module) -> String {
    let mut xml = Xml { text: "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n".into() };
    xml.element("category", "Heatpath");
    xml.element("title", module.title);
    xml.element("description", module.description);
    xml.element("version", env!("CARGO_PKG_VERSION"));
    xml.element("license", env!("CARGO_PKG_LICENSE"));
    xml.element("contributor", env!("CARGO_PKG_AUTHORS"));
    module.groups.iter().for_each(|group| xml.group(group));
    xml.line("</executable>");
    xml.text
}

struct Xml {
    text: String,
}

impl Xml {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn element(&mut self, name: &str, content: &str) {
        // Strings never refuse.
        let _ = writeln!(self.text, "<{name}>{}</{name}>", partial_escape(content));
    }

    fn group(&mut self, group: &Group) {
        self.line(if group.advanced { "<parameters advanced=\"true\">" } else { "<parameters>" });
        self.element("label", group.label);
        self.element("description", group.label);
        group.parameters.iter().for_each(|parameter| self.parameter(parameter));
        self.line("</parameters>");
    }

    /// Its children have the one order that CTK accepts.
    fn parameter(&mut self, parameter: &Parameter) {
        let (tag, attributes) = tag(&parameter.kind);
        self.line(&format!("<{tag}{attributes}>"));
        self.element("name", parameter.name);
        match parameter.kind {
            Kind::File { position: Some(position), .. } => {
                self.element("index", &position.to_string());
            }
            _ => self.element("longflag", parameter.name),
        }
        self.element("description", parameter.description);
        self.element("label", parameter.label);
        if let Some(usual) = usual(&parameter.kind) {
            self.element("default", &usual);
        }
        match parameter.kind {
            Kind::File { channel: Channel::Input, .. } => self.element("channel", "input"),
            Kind::File { channel: Channel::Output, .. } => self.element("channel", "output"),
            Kind::Choice { among } => among.iter().for_each(|word| self.element("element", word)),
            _ => (),
        }
        self.line(&format!("</{tag}>"));
    }
}

fn tag(kind: &Kind) -> (&'static str, &'static str) {
    match kind {
        Kind::File { kind: FileKind::Image, .. } => ("image", " fileExtensions=\".nrrd\""),
        Kind::File { kind: FileKind::LabelMap, .. } => {
            ("image", " type=\"label\" fileExtensions=\".nrrd\"")
        }
        Kind::File { kind: FileKind::Geometry, .. } => ("geometry", " fileExtensions=\".vtp\""),
        Kind::File { kind: FileKind::Any, .. } => ("file", ""),
        Kind::Points => ("point", " multiple=\"true\" coordinateSystem=\"lps\""),
        Kind::Number { .. } => ("double", ""),
        Kind::Integer { .. } => ("integer", ""),
        Kind::Numbers => ("double-vector", ""),
        Kind::Choice { .. } => ("string-enumeration", ""),
    }
}

fn usual(kind: &Kind) -> Option<String> {
    match kind {
        Kind::Number { usual } => Some(usual.to_string()),
        Kind::Integer { usual } => Some(usual.to_string()),
        Kind::Choice { among } => among.first().map(ToString::to_string),
        Kind::File { .. } | Kind::Points | Kind::Numbers => None,
    }
}
