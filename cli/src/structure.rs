//! Where the structure is, and where extraction begins, if nobody says so.

use crate::args::{MediumArg, MediumArgs, OptionalSourceArgs, PolarityArg, StructureArgs};
use crate::failure::Failure;
use crate::input::{Picture, check_not_negative};
use heatpath_core::grid::Structure;

/// Takes the given sources or, if there are none, a seed in each long piece of the structure.
pub(crate) fn find<const D: usize>(
    picture: &Picture<'_, D>,
    sources: &OptionalSourceArgs,
    medium: &MediumArgs,
    args: &StructureArgs,
) -> Result<Structure<D>, Failure> {
    let mut points = picture.optional_sources(sources)?;
    let usual_extent = Structure::usual_extent(picture.image.shape());
    let least_extent = args.extent.unwrap_or(usual_extent);
    check_not_negative("--extent", least_extent)?;
    let compares = matches!(medium.medium, MediumArg::Conductivity | MediumArg::Combined);
    if points.is_empty() && compares && medium.reference.is_none() {
        // Tubes have seeds, and these the grey values to compare with.
        let tubes = picture.medium(&tubes(medium), &[], args.threads)?;
        points = Structure::new(tubes, &[], None, least_extent)?.sources.points().to_vec();
    }
    let medium = picture.medium(medium, &points, args.threads)?;
    Ok(Structure::new(medium, &points, args.structure, least_extent)?)
}

/// The options of a medium of tubes in the same picture.
fn tubes(medium: &MediumArgs) -> MediumArgs {
    MediumArgs {
        medium: MediumArg::Vesselness,
        power: None,
        floor: None,
        polarity: medium.polarity.or(Some(PolarityArg::Both)),
        ..medium.clone()
    }
}
