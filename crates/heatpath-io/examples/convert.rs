//! Reads a picture or a volume and writes its raw values, as 64-bit floats, with its place in the
//! world: `cargo run -p heatpath-io --example convert -- CT.dcm ct.nii.gz [COMPONENT]`.

use heatpath_io::{FieldStyle, ImageFile, write_field};
use std::error::Error;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    match convert() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            drop(writeln!(std::io::stderr(), "{error}"));
            ExitCode::FAILURE
        }
    }
}

fn convert() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (input, output, component) = match &arguments[..] {
        [input, output] => (input, output, None),
        [input, output, component] => (input, output, Some(component.parse()?)),
        _ => return Err("usage: convert INPUT OUTPUT [COMPONENT]".into()),
    };
    let file = ImageFile::read_component(input, component)?;
    match file.dimensions() {
        [2, ..] => write::<2>(file, output),
        _ => write::<3>(file, output),
    }
}

fn write<const D: usize>(file: ImageFile, output: &str) -> Result<(), Box<dyn Error>> {
    let style = FieldStyle { placement: file.placement(), ..FieldStyle::default() };
    Ok(write_field(output, None, true, &file.into_field::<D>(None)?, &style)?)
}
