//! From the command line to the nouns of the engine.

use crate::args::{
    ChannelArg, EdgeStopArg, FormArg, MediumArg, MediumArgs, OptionalSourceArgs, PictureArgs,
};
use crate::failure::Failure;
use heatpath_core::grid::medium::{
    self, ConductivityOptions, EdgeStop, EdgesOptions, Form, Medium, PeronaMalikOptions,
};
use heatpath_core::grid::{Grid, Mask, Shape, check_points};
use heatpath_io::{Channel, PictureOptions, read_field, read_mask, read_picture, read_points};
use std::path::Path;

/// The picture and its walls.
pub(crate) struct Picture<'a> {
    args: &'a PictureArgs,
    pub(crate) image: Grid<f64, 2>,
    pub(crate) mask: Mask<2>,
}

impl<'a> Picture<'a> {
    pub(crate) fn read(args: &'a PictureArgs) -> Result<Self, Failure> {
        Shape::with_spacing([1, 1], args.spacing)?;
        let options = PictureOptions {
            channel: match args.channel {
                ChannelArg::Red => Channel::Red,
                ChannelArg::Green => Channel::Green,
                ChannelArg::Blue => Channel::Blue,
                ChannelArg::Luma => Channel::Luma,
            },
            range: args.range.map(|[low, high]| (low, high)),
            spacing: args.spacing,
        };
        let image = read_picture(&args.input, &options)?;
        let mask = match &args.mask {
            Some(file) => read_mask(file, args.spacing)?,
            None => Mask::all_open(*image.shape()),
        };
        check_size(args.mask.as_deref(), mask.shape(), image.shape())?;
        Ok(Self { args, image, mask })
    }

    /// The points given one by one and in a file, in pixel coordinates, checked.
    pub(crate) fn points(
        &self,
        role: &'static str,
        given: &[[f64; 2]],
        file: Option<&Path>,
    ) -> Result<Vec<[f64; 2]>, Failure> {
        let mut points = given.to_vec();
        if let Some(file) = file {
            points.extend(read_points(file)?);
        }
        if self.args.physical {
            let spacing = self.args.spacing;
            points = points.iter().map(|p| [p[0] / spacing[0], p[1] / spacing[1]]).collect();
        }
        check_points(role, &points, &self.mask)?;
        Ok(points)
    }

    /// The sources, of which there may be none.
    pub(crate) fn optional_sources(
        &self,
        args: &OptionalSourceArgs,
    ) -> Result<Vec<[f64; 2]>, Failure> {
        if args.source.is_empty() && args.sources.is_none() {
            return Ok(Vec::new());
        }
        self.points("source", &args.source, args.sources.as_deref())
    }

    /// The medium of this picture, with its walls.
    pub(crate) fn medium(
        &self,
        args: &MediumArgs,
        sources: &[[f64; 2]],
    ) -> Result<Medium<2>, Failure> {
        let image = &self.image;
        let divergence = form(args, Form::Divergence);
        let smoothing = self.smoothing(args.smooth);
        let conductivity = ConductivityOptions { power: args.power, floor: args.floor };
        let perona_malik = PeronaMalikOptions {
            contrast: args.contrast,
            edge_stop: match args.edge_stop {
                EdgeStopArg::Exponential => EdgeStop::Exponential,
                EdgeStopArg::Rational => EdgeStop::Rational,
            },
            smoothing,
            form: divergence,
        };
        let medium = match args.medium {
            MediumArg::Uniform => medium::uniform(*image.shape()),
            MediumArg::Conductivity => {
                medium::conductivity(image, &self.references(args, sources)?, conductivity)?
            }
            MediumArg::PeronaMalik => medium::perona_malik(image, perona_malik)?,
            MediumArg::Combined => {
                let references = self.references(args, sources)?;
                medium::combined(image, &references, conductivity, perona_malik)?
            }
            MediumArg::Edges => {
                let options = EdgesOptions { floor: args.floor, smoothing, form: divergence };
                medium::edges(image, options)?
            }
            MediumArg::File => self.given_medium(args)?,
        };
        Ok(medium.with_walls(self.mask.clone())?)
    }

    fn given_medium(&self, args: &MediumArgs) -> Result<Medium<2>, Failure> {
        let file = args.medium_file.as_deref();
        let Some(file) = file else {
            return Err(Failure::usage("`--medium file` needs --medium-file"));
        };
        let field = read_field(file, self.args.spacing)?;
        check_size(Some(file), field.shape(), self.image.shape())?;
        medium::given(field, form(args, Form::Pointwise))
            .map_err(|error| Failure::bad_input(format!("{}: {error}", file.display())))
    }

    /// The grey values that eq. (6) compares with.
    fn references(&self, args: &MediumArgs, sources: &[[f64; 2]]) -> Result<Vec<f64>, Failure> {
        match args.reference {
            Some(reference) => Ok(vec![reference]),
            None if sources.is_empty() => Err(Failure::usage(
                "this medium compares grey values with a source's: give --source or --reference",
            )),
            None => Ok(sources.iter().map(|&source| self.image.sample(source)).collect()),
        }
    }

    /// --smooth in cells.
    fn smoothing(&self, sigma: f64) -> f64 {
        let unit = if self.args.physical { self.image.shape().smallest_spacing() } else { 1.0 };
        sigma / unit
    }
}

fn form(args: &MediumArgs, usual: Form) -> Form {
    match args.form {
        Some(FormArg::Divergence) => Form::Divergence,
        Some(FormArg::Pointwise) => Form::Pointwise,
        None => usual,
    }
}

/// Checks that a second file fits the picture.
fn check_size(file: Option<&Path>, given: &Shape<2>, picture: &Shape<2>) -> Result<(), Failure> {
    let (given, picture) = (given.size(), picture.size());
    if given == picture {
        return Ok(());
    }
    Err(Failure::bad_input(format!(
        "{}: has {} x {} pixels but the picture has {} x {}",
        file.map(|file| file.display().to_string()).unwrap_or_default(),
        given[0],
        given[1],
        picture[0],
        picture[1]
    )))
}
