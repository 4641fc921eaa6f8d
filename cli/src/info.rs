//! `heatpath info`

use crate::args::InfoArgs;
use crate::failure::Failure;
use crate::output;

pub(crate) fn info(args: &InfoArgs) -> Result<(), Failure> {
    let info = heatpath_io::info(&args.input)?;
    if args.json {
        return output::print_json(&info);
    }
    let [width, height] = info.size;
    let values = match (info.min, info.max) {
        (Some(min), Some(max)) => format!("values from {min} to {max}"),
        _ => "no finite values".to_owned(),
    };
    output::print(&format!(
        "{}: {}, {width} x {height} pixels, channels: {}, type: {}, {values}",
        args.input.display(),
        info.format,
        info.channels,
        info.sample,
    ))
}
