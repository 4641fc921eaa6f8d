//! `heatpath info`

use crate::args::InfoArgs;
use crate::failure::Failure;
use crate::input::size_text;
use crate::output;

pub(crate) fn info(args: &InfoArgs) -> Result<(), Failure> {
    let info = heatpath_io::info(&args.input)?;
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
    ))
}
