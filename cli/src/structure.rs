//! Where the structure is, and where extraction begins, if nobody says so.

use crate::args::{MediumArg, MediumArgs, OptionalSourceArgs, PolarityArg, StructureArgs};
use crate::failure::Failure;
use crate::input::{Picture, check_not_negative};
use heatpath_core::grid::medium::Medium;
use heatpath_core::grid::skeleton::{Graph, radii, thin};
use heatpath_core::grid::{Grid, Sources, seeds, structure, structure_level};

/// What extraction needs to begin.
pub(crate) struct Structure<const D: usize> {
    pub(crate) medium: Medium<D>,
    pub(crate) sources: Sources<D>,
    /// The squared speed from which on a cell is part of the structure; none if the medium is the same
    /// everywhere.
    level: Option<f64>,
}

impl<const D: usize> Structure<D> {
    /// Takes the given sources or, if there are none, a seed in each long piece of the structure.
    pub(crate) fn find(
        picture: &Picture<'_, D>,
        sources: &OptionalSourceArgs,
        medium: &MediumArgs,
        args: &StructureArgs,
    ) -> Result<Self, Failure> {
        let mut points = picture.optional_sources(sources)?;
        let longest = picture.image.shape().longest_side() as f64;
        let least_extent = args.extent.unwrap_or(longest / 16.0);
        check_not_negative("--extent", least_extent)?;
        let compares = matches!(medium.medium, MediumArg::Conductivity | MediumArg::Combined);
        if points.is_empty() && compares && medium.reference.is_none() {
            // Tubes have seeds, and these the grey values to compare with.
            let tubes = picture.medium(&tubes(medium), &[], args.threads)?;
            let level = structure_level(&tubes).ok_or_else(no_structure)?;
            points = seeds(&tubes, level, least_extent);
        }
        let medium = picture.medium(medium, &points, args.threads)?;
        let level = args.structure.or_else(|| structure_level(&medium));
        if points.is_empty() {
            let level = level.ok_or_else(no_structure)?;
            points = seeds(&medium, level, least_extent);
            if points.is_empty() {
                return Err(Failure::no_answer(format!(
                    "no piece of the structure, where k D is {level:.4} or more, is \
                     {least_extent:.1} pixels long: give a --source, or lower --extent or --structure"
                )));
            }
        }
        let sources = Sources::new(&points, medium.mask())?;
        Ok(Self { medium, sources, level })
    }

    /// The squared speed from which on a cell is part of the structure.
    pub(crate) fn level(&self) -> Result<f64, Failure> {
        self.level.ok_or_else(no_structure)
    }

    /// The graph of cells that were found, with the radii of the structure around them.
    pub(crate) fn graph(&self, found: &Grid<bool, D>) -> Graph<D> {
        let Some(level) = self.level else { return Graph::of_mask(found) };
        let mut cells = structure(&self.medium, level);
        cells.values_mut().iter_mut().zip(found.values()).for_each(|(cell, &found)| *cell |= found);
        Graph::of_centreline(&thin(found), &radii(&cells)).expect("cells of one picture")
    }
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

fn no_structure() -> Failure {
    Failure::no_answer(
        "the medium is the same everywhere and shows no structure: choose another --medium",
    )
}
