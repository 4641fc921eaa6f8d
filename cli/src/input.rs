//! From the command line to the nouns of the engine.

use crate::args::{
    AutoArg, ChannelArg, DirectionsArg, EdgeStopArg, FormArg, MediumArg, MediumArgs, Numbers,
    OptionalSourceArgs, PictureArgs, PolarityArg,
};
use crate::failure::Failure;
use crate::place::Place;
use heatpath_core::Exec;
use heatpath_core::grid::filter::{DEVIATION, Polarity, Tubes, even_grey};
use heatpath_core::grid::medium::{
    self, ConductivityOptions, Directions, EdgeStop, EdgesOptions, Form, Medium, MediumError,
    PeronaMalikOptions, TensorOptions, VesselnessOptions,
};
use heatpath_core::grid::{Grid, Mask, Shape, Structure, check_points, tube_scales};
use heatpath_io::{Channel, ImageFile, PictureOptions, Placement, read_points};
use std::path::Path;

/// The names of the coordinates.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The input, which is a picture or a volume: here ways part, and each command calls a function
/// that is generic over the dimension.
pub(crate) enum Input {
    Picture(ImageFile),
    Volume(ImageFile),
}

impl Input {
    /// Reads the file. Where it can be both, the numbers of `points` and of the spacing decide.
    pub(crate) fn read(args: &PictureArgs, points: &[&[Numbers]]) -> Result<Self, Failure> {
        let file = ImageFile::read_component(&args.input, args.component)?;
        let given = points.iter().copied().flatten().chain(&args.spacing).next();
        let dimensions = file.dimensions();
        let wanted = given.map(|numbers| numbers.0.len()).filter(|n| dimensions.contains(n));
        Ok(match wanted.unwrap_or(dimensions[0]) {
            2 => Self::Picture(file),
            _ => Self::Volume(file),
        })
    }
}

/// The picture or volume, its walls, and its place in the world, if its file names one.
pub(crate) struct Picture<'a, const D: usize> {
    args: &'a PictureArgs,
    pub(crate) image: Grid<f64, D>,
    pub(crate) mask: Mask<D>,
    pub(crate) placement: Option<Placement>,
}

impl<'a, const D: usize> Picture<'a, D> {
    pub(crate) fn new(args: &'a PictureArgs, file: ImageFile) -> Result<Self, Failure> {
        let spacing =
            args.spacing.as_ref().map(|given| coordinates("spacing", given)).transpose()?;
        if let Some(spacing) = spacing {
            Shape::with_spacing([1; D], spacing)?;
        }
        let placement = file.placement();
        let options = PictureOptions {
            channel: match args.channel {
                ChannelArg::Red => Channel::Red,
                ChannelArg::Green => Channel::Green,
                ChannelArg::Blue => Channel::Blue,
                ChannelArg::Luma => Channel::Luma,
            },
            range: args.range.map(|[low, high]| (low, high)),
            spacing,
        };
        let image = file.into_picture(&options)?;
        let mask = Mask::all_open(*image.shape());
        let mut picture = Self { args, image, mask, placement };
        if let Some(path) = &args.mask {
            let file = ImageFile::read(path)?;
            picture.check_place(path, &file)?;
            picture.mask = file.into_mask(picture.image.shape().spacing())?;
            check_size(path, picture.mask.shape(), picture.image.shape())?;
        }
        check_not_negative("--margin", args.margin)?;
        if args.margin > 0.0 {
            let unit = picture.image.shape().smallest_spacing();
            picture.mask = picture.mask.shrunk(unit * picture.smoothing(args.margin));
            if !picture.mask.open().values().contains(&true) {
                let message = format!("--margin {} leaves no pixel of --mask", args.margin);
                return Err(Failure::usage(message));
            }
        }
        if let Some(sigma) = args.normalize {
            let (sigma, exec) = (picture.smoothing(sigma), Exec::single_threaded());
            picture.image = even_grey(&picture.image, sigma, &picture.mask, &exec)
                .map_err(MediumError::from)?;
        }
        Ok(picture)
    }

    /// The points given one by one and in a file, in pixel coordinates, checked.
    pub(crate) fn points(
        &self,
        role: &'static str,
        given: &[Numbers],
        file: Option<&Path>,
    ) -> Result<Vec<[f64; D]>, Failure> {
        let given = given.iter().map(|numbers| coordinates(role, numbers));
        let mut points = given.collect::<Result<Vec<[f64; D]>, _>>()?;
        if let Some(file) = file {
            points.extend(read_points::<D>(file)?);
        }
        if self.args.physical {
            let (spacing, place) =
                (self.image.shape().spacing(), self.placement.unwrap_or_default());
            for (number, point) in points.iter_mut().enumerate() {
                *point = place.to_pixels(*point, spacing).ok_or_else(|| {
                    Failure::bad_input(format!(
                        "{role} {number}: lies outside of the picture's plane; give it in pixels, \
                         without --physical"
                    ))
                })?;
            }
        }
        check_points(role, &points, &self.mask)?;
        Ok(points)
    }

    /// Refuses a second file that says that it lies elsewhere. It says nothing if --spacing does.
    fn check_place(&self, path: &Path, file: &ImageFile) -> Result<(), Failure> {
        let theirs = Place::of(path, file).filter(|_| self.args.spacing.is_none());
        let (Some(placement), Some(theirs)) = (self.placement, theirs) else { return Ok(()) };
        let shape = self.image.shape();
        let ours = Place { file: &self.args.input, spacing: shape.spacing(), placement };
        ours.check(&theirs, shape.size())
    }

    /// The sources, of which there may be none.
    pub(crate) fn optional_sources(
        &self,
        args: &OptionalSourceArgs,
    ) -> Result<Vec<[f64; D]>, Failure> {
        if args.source.is_empty() && args.sources.is_none() {
            return Ok(Vec::new());
        }
        self.points("source", &args.source, args.sources.as_deref())
    }

    /// The medium of this picture, with its walls.
    pub(crate) fn medium(
        &self,
        args: &MediumArgs,
        sources: &[[f64; D]],
        threads: usize,
    ) -> Result<Medium<D>, Failure> {
        let image = &self.image;
        let divergence = form(args, Form::Divergence);
        let smoothing = self.smoothing(args.smooth);
        let usual = ConductivityOptions::default();
        let conductivity = ConductivityOptions {
            power: args.power.unwrap_or(usual.power),
            floor: args.floor.unwrap_or(usual.floor),
        };
        let perona_malik = PeronaMalikOptions {
            contrast: args.contrast.unwrap_or(PeronaMalikOptions::default().contrast),
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
                let options =
                    EdgesOptions { floor: conductivity.floor, smoothing, form: divergence };
                medium::edges(image, options)?
            }
            MediumArg::Tensor => {
                medium::tensor(image, self.tensor_options(args)?, &Exec::new(threads)?)?
            }
            MediumArg::Vesselness => {
                let options = self.vesselness_options(&self.with_scales(args, threads)?)?;
                medium::vesselness(image, &options, &Exec::new(threads)?)?
            }
            MediumArg::File => self.given_medium(args)?,
        };
        Ok(medium.with_walls(self.mask.clone())?)
    }

    fn tensor_options(&self, args: &MediumArgs) -> Result<TensorOptions, Failure> {
        let usual = TensorOptions::default();
        let sigma = match args.scale.as_slice() {
            [] => 2.0,
            [AutoArg::Fixed(sigma)] => self.smoothing(*sigma),
            _ => return Err(Failure::usage("--scale: `--medium tensor` takes one number")),
        };
        let directions = match args.tensor {
            DirectionsArg::Hessian => {
                Directions::Hessian { sigma, polarity: polarity(args).unwrap_or(Polarity::Both) }
            }
            DirectionsArg::Structure => Directions::Structure { sigma, rho: 2.0 * sigma },
            DirectionsArg::Gradient => Directions::Gradient { sigma },
        };
        let anisotropy = args.anisotropy.unwrap_or(usual.anisotropy);
        Ok(TensorOptions { directions, anisotropy, ..usual })
    }

    fn vesselness_options(&self, args: &MediumArgs) -> Result<VesselnessOptions, Failure> {
        let usual = VesselnessOptions::default();
        let sigma = |scale: &AutoArg| match scale {
            AutoArg::Fixed(sigma) => Ok(self.smoothing(*sigma)),
            AutoArg::Auto => Err(Failure::usage("--scale: `auto` stands alone")),
        };
        let scales: Vec<f64> = args.scale.iter().map(sigma).collect::<Result<_, _>>()?;
        Ok(VesselnessOptions {
            power: args.power.unwrap_or(usual.power),
            floor: args.floor.unwrap_or(usual.floor),
            anisotropy: args.anisotropy.unwrap_or(usual.anisotropy),
            tubes: Tubes {
                polarity: polarity(args).unwrap_or(usual.tubes.polarity),
                elongation: args.elongation.unwrap_or(usual.tubes.elongation),
                scales: if scales.is_empty() { usual.tubes.scales } else { scales },
                contrast: args.contrast.or(self.args.normalize.map(|_| DEVIATION)),
                ..usual.tubes
            },
            ..usual
        })
    }

    /// The options of a vesselness with numbers in place of `--scale auto`.
    pub(crate) fn with_scales(
        &self,
        args: &MediumArgs,
        threads: usize,
    ) -> Result<MediumArgs, Failure> {
        let [AutoArg::Auto] = args.scale[..] else { return Ok(args.clone()) };
        let usual = Tubes::default();
        let tubes = Tubes { polarity: polarity(args).unwrap_or(usual.polarity), ..usual };
        let (exec, extent) = (Exec::new(threads)?, Structure::usual_extent(self.image.shape()));
        let scales = tube_scales(&self.image, &tubes, &self.mask, extent, &exec)?;
        let Some(scales) = scales else {
            let message =
                format!("no tube is {extent:.1} pixels long: say which --scale they have");
            return Err(Failure::no_answer(message));
        };
        let unit = self.smoothing(1.0).recip();
        Ok(MediumArgs {
            scale: scales.iter().map(|scale| AutoArg::Fixed(scale * unit)).collect(),
            ..args.clone()
        })
    }

    fn given_medium(&self, args: &MediumArgs) -> Result<Medium<D>, Failure> {
        let Some(path) = args.medium_file.as_deref() else {
            return Err(Failure::usage("`--medium file` needs --medium-file"));
        };
        let shape = self.image.shape();
        let file = ImageFile::read(path)?;
        self.check_place(path, &file)?;
        let medium = if file.has_tensors(D) {
            if matches!(args.form, Some(FormArg::Pointwise)) {
                let message =
                    "--form pointwise needs a field of numbers, but this one is of tensors";
                return Err(Failure::usage(format!("{}: {message}", path.display())));
            }
            let field = file.into_tensors(shape.spacing())?;
            check_size(path, field.shape(), shape)?;
            medium::given_tensor(field)
        } else {
            let field = file.into_field(shape.spacing())?;
            check_size(path, field.shape(), shape)?;
            medium::given(field, form(args, Form::Pointwise))
        };
        medium.map_err(|error| Failure::bad_input(format!("{}: {error}", path.display())))
    }

    /// The grey values that eq. (6) compares with.
    fn references(&self, args: &MediumArgs, sources: &[[f64; D]]) -> Result<Vec<f64>, Failure> {
        match args.reference {
            Some(reference) => Ok(vec![reference]),
            None if sources.is_empty() => Err(Failure::usage(
                "this medium compares grey values with a source's: give --source or --reference",
            )),
            None => Ok(sources.iter().map(|&source| self.image.sample(source)).collect()),
        }
    }

    /// --smooth, --scale, --normalize and --margin in cells.
    fn smoothing(&self, sigma: f64) -> f64 {
        let unit = if self.args.physical { self.image.shape().smallest_spacing() } else { 1.0 };
        sigma / unit
    }
}

fn polarity(args: &MediumArgs) -> Option<Polarity> {
    args.polarity.map(|polarity| match polarity {
        PolarityArg::Bright => Polarity::Bright,
        PolarityArg::Dark => Polarity::Dark,
        PolarityArg::Both => Polarity::Both,
    })
}

fn form(args: &MediumArgs, usual: Form) -> Form {
    match args.form {
        Some(FormArg::Divergence) => Form::Divergence,
        Some(FormArg::Pointwise) => Form::Pointwise,
        None => usual,
    }
}

/// Refuses a length that is none.
pub(crate) fn check_not_negative(option: &str, value: f64) -> Result<(), Failure> {
    if value >= 0.0 {
        return Ok(());
    }
    Err(Failure::usage(format!("{option} is {value}; it must be 0 or more")))
}

/// As many numbers as the input has axes.
pub(crate) fn coordinates<const D: usize>(
    option: &str,
    given: &Numbers,
) -> Result<[f64; D], Failure> {
    given.0.as_slice().try_into().map_err(|_| {
        let text: Vec<String> = given.0.iter().map(f64::to_string).collect();
        let (numbers, needed) = (text.join(","), AXES[..D].join(","));
        let input = if D == 2 { "picture" } else { "volume" };
        Failure::usage(format!(
            "--{option} {numbers}: has {} numbers, but the input is a {input} and needs {D}: \
             {needed}",
            text.len()
        ))
    })
}

/// Checks that a second file fits the picture.
fn check_size<const D: usize>(
    file: &Path,
    given: &Shape<D>,
    picture: &Shape<D>,
) -> Result<(), Failure> {
    if given.size() == picture.size() {
        return Ok(());
    }
    Err(Failure::bad_input(format!(
        "{}: has {} pixels but the picture has {}",
        file.display(),
        size_text(given.size()),
        size_text(picture.size()),
    )))
}

/// A size in words: `5 x 4 x 3`.
pub(crate) fn size_text(size: impl AsRef<[usize]>) -> String {
    size.as_ref().iter().map(usize::to_string).collect::<Vec<_>>().join(" x ")
}
